"""The path of the yarn in a knot: its crossing word, its curve, and the proof of the knot that a motion ties.

The names below are public; each is imported when it is first used.
"""

from ilmek.lazy import lazy_names

__all__, __getattr__, __dir__ = lazy_names(__name__, __file__)
