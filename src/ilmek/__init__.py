"""ilmek: carpet in, loom out.

Designs, proves and runs machines that make carpets. The layers, from people down to factors, are listed in
`docs/explanation/architecture.md`; nothing is imported here, so that `import ilmek` costs nothing.
"""

__version__ = "0.1.0"
