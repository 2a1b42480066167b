"""What `import ilmek` offers beyond the engine's own functions: verbs that take what a person types.

Paths may be texts, laws are given by name, a mechanism needs no plan, a quantity may be a text with its unit
(`ilmek.arguments`), and a value that was probably meant in millimetres or degrees is refused with the conversion. The
engine's functions of the same purpose take SI values and guess nothing.
"""
