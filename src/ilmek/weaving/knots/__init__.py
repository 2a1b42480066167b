"""The path of the yarn in a knot: its crossing word, its curve, and the proof of the knot that a motion ties."""

from ilmek.weaving.knots.led_yarn import SampledPath, end_path, knot_of_ends, yarn_between
from ilmek.weaving.knots.path import KnotDimensions, KnotPath, knot_path
from ilmek.weaving.knots.proof import TiedKnot, joined_ends, knot_of_curve, tied_knot
from ilmek.weaving.knots.two_hands import TwoHandKnot, knot_of_hands, pitch_range
from ilmek.weaving.knots.word import Knot, Word, knot

__all__ = [
    "Knot",
    "KnotDimensions",
    "KnotPath",
    "SampledPath",
    "TiedKnot",
    "TwoHandKnot",
    "Word",
    "end_path",
    "joined_ends",
    "knot",
    "knot_of_curve",
    "knot_of_ends",
    "knot_of_hands",
    "knot_path",
    "pitch_range",
    "tied_knot",
    "yarn_between",
]
