"""Textile mechanics: warp, shed, fell, tension; the knots tied by a path of the yarn are in `ilmek.weaving.knots`.

The materials of yarns are in `ilmek.elements.yarns`, the kinds of knots in `ilmek.elements.knot_kinds`.

The names below are public; each is imported when it is first used.
"""

from ilmek.lazy import lazy_names

__all__, __getattr__, __dir__ = lazy_names(__name__, __file__)
