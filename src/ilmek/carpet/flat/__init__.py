"""Flat reading: drawings, with few colours and edges, onto the grid of knots.

picture -> whole chroma [`chroma`] -> sample [`survey`] -> true colours [`modes`, `true_colours`]
        -> true colour of each pixel [`labels`] -> symmetry [`symmetry`] -> true colour of each knot [`knots`]
"""

from ilmek.carpet.flat.decision import Flatness, looks_flat
from ilmek.carpet.flat.likeness import looks_like_itself
from ilmek.carpet.flat.reading import FlatDesign, flat_design

__all__ = ["FlatDesign", "Flatness", "flat_design", "looks_flat", "looks_like_itself"]
