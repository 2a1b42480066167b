"""The path of the yarn in a knot: its crossing word, its curve, and the proof of the knot that a motion ties.

The names below are public; each is imported when it is first used.
"""

from typing import TYPE_CHECKING

from ilmek.lazy import lazy_names

PUBLIC = {
    "SampledPath": "ilmek.weaving.knots.led_yarn",
    "end_path": "ilmek.weaving.knots.led_yarn",
    "knot_of_ends": "ilmek.weaving.knots.led_yarn",
    "yarn_between": "ilmek.weaving.knots.led_yarn",
    "KnotDimensions": "ilmek.weaving.knots.path",
    "KnotPath": "ilmek.weaving.knots.path",
    "knot_path": "ilmek.weaving.knots.path",
    "TiedKnot": "ilmek.weaving.knots.proof",
    "joined_ends": "ilmek.weaving.knots.proof",
    "knot_of_curve": "ilmek.weaving.knots.proof",
    "tied_knot": "ilmek.weaving.knots.proof",
    "TwoHandKnot": "ilmek.weaving.knots.two_hands",
    "knot_of_hands": "ilmek.weaving.knots.two_hands",
    "pitch_range": "ilmek.weaving.knots.two_hands",
    "Knot": "ilmek.weaving.knots.word",
    "Word": "ilmek.weaving.knots.word",
    "knot": "ilmek.weaving.knots.word",
}

__all__ = list(PUBLIC)
__getattr__, __dir__ = lazy_names(__name__, PUBLIC)

if TYPE_CHECKING:
    from ilmek.weaving.knots.led_yarn import SampledPath as SampledPath
    from ilmek.weaving.knots.led_yarn import end_path as end_path
    from ilmek.weaving.knots.led_yarn import knot_of_ends as knot_of_ends
    from ilmek.weaving.knots.led_yarn import yarn_between as yarn_between
    from ilmek.weaving.knots.path import KnotDimensions as KnotDimensions
    from ilmek.weaving.knots.path import KnotPath as KnotPath
    from ilmek.weaving.knots.path import knot_path as knot_path
    from ilmek.weaving.knots.proof import TiedKnot as TiedKnot
    from ilmek.weaving.knots.proof import joined_ends as joined_ends
    from ilmek.weaving.knots.proof import knot_of_curve as knot_of_curve
    from ilmek.weaving.knots.proof import tied_knot as tied_knot
    from ilmek.weaving.knots.two_hands import TwoHandKnot as TwoHandKnot
    from ilmek.weaving.knots.two_hands import knot_of_hands as knot_of_hands
    from ilmek.weaving.knots.two_hands import pitch_range as pitch_range
    from ilmek.weaving.knots.word import Knot as Knot
    from ilmek.weaving.knots.word import Word as Word
    from ilmek.weaving.knots.word import knot as knot
