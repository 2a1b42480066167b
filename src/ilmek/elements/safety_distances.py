"""Safety distances of guards: reaching over a fence, through its openings, and past a door before the machine stands.

    reaching over      c(a, b): height a of the hazard, height b of the fence, high risk        [ISO 13857, table 2]
    reaching through   by the width of a square opening                                         [ISO 13857, table 4]
    door, light grid,  S = K T + C, K = 1.6 m/s, T from its opening, its interruption or the release of its buttons to
    two-hand control   the standstill; C = 0 for doors that nobody reaches through, and for buttons in shrouds, and
                       0.85 m for a grid of some beams                               [ISO 13855, approach of the body]

Between two rows or columns of a table the safer value counts, as the standard says. Arms of persons of 14 years and
older, without aids to climb on. The openings agree with a published extract of table 4 (edition of 2019); the rows of
table 2 could be compared with no published text.
"""

import bisect
import math
from collections.abc import Iterable

from ilmek.units import mm

APPROACH = 1.6
"""Speed K of a body that approaches [m/s]: ISO 13855."""

FENCES = tuple(high * mm for high in (1000, 1200, 1400, 1600, 1800, 2000, 2200, 2400, 2500, 2700))
"""Heights b of fences [m]."""

_OVER = """
2600 900 800 700 600 600 500 400 300 100 0
2400 1100 1000 900 800 700 600 400 300 100 0
2200 1300 1200 1000 900 800 600 400 300 0 0
2000 1400 1300 1100 900 800 600 400 0 0 0
1800 1500 1400 1100 900 800 600 0 0 0 0
1600 1500 1400 1100 900 800 500 0 0 0 0
1400 1500 1400 1100 900 800 0 0 0 0 0
1200 1500 1400 1100 900 700 0 0 0 0 0
1000 1500 1400 1000 800 0 0 0 0 0 0
800 1500 1300 900 600 0 0 0 0 0 0
600 1400 1300 800 0 0 0 0 0 0 0
400 1400 1200 400 0 0 0 0 0 0 0
200 1200 900 0 0 0 0 0 0 0 0
0 1100 500 0 0 0 0 0 0 0 0
"""

_ROWS = sorted(
    (heights[0] * mm, tuple(one * mm for one in heights[1:]))
    for heights in (tuple(map(float, line.split())) for line in _OVER.split("\n") if line)
)

HIGHEST = 2700 * mm
"""Height of a hazard above which nobody reaches it from the floor [m]."""

_SQUARES = ((4, 2), (6, 5), (8, 15), (10, 25), (12, 80), (20, 120), (30, 120), (40, 200), (120, 850))
"""Width of a square opening, and the distance of the hazard behind it [mm]."""


def over(hazard: float, fence: float) -> float:
    """Least horizontal distance [m] of a hazard at a height [m] from a fence of a height [m]; inf: none is enough.

    >>> [over(a, b) for a, b in ((1.8, 2.0), (2.0, 2.2), (1.9, 2.3), (2.8, 1.4), (1.0, 0.8))]
    [0.6, 0.4, 0.4, 0.0, inf]
    """
    if hazard >= HIGHEST:
        return 0.0
    column = bisect.bisect_right(FENCES, fence + _ROUNDING) - 1
    if column < 0:
        return math.inf
    heights = [height for height, _ in _ROWS]
    below = max(bisect.bisect_right(heights, hazard + _ROUNDING) - 1, 0)
    above = min(bisect.bisect_left(heights, hazard - _ROUNDING), len(_ROWS) - 1)
    return max(_ROWS[below][1][column], _ROWS[above][1][column])


def over_span(low: float, high: float, fence: float) -> float:
    """The same for a hazard from one height to another [m]: the farthest of all heights between."""
    between = [height for height, _ in _ROWS if low < height < high]
    return max(over(height, fence) for height in (low, *between, high))


def least_fence(hazards: Iterable[tuple[float, float, float]], least: float) -> float:
    """Height of the lowest fence of the table [m] that keeps hazards out of reach; the highest where none does.

    hazards  of each the heights of its lower and upper end, and its horizontal distance from the fence [m]
    least    height of the fence [m]
    """
    known = tuple(hazards)
    offered = [fence for fence in FENCES if fence >= least - _ROUNDING]
    kept = (fence for fence in offered if all(over_span(low, high, fence) <= far for low, high, far in known))
    return next(kept, FENCES[-1])


def through(opening: float) -> float:
    """Least distance [m] of a hazard behind square openings of a width [m]; inf: the body passes through them.

    >>> through(37e-3), through(0.2)
    (0.2, inf)
    """
    return next((far * mm for width, far in _SQUARES if opening <= width * mm + _ROUNDING), math.inf)


GRID_REACH = 0.85
"""How far an arm reaches between the beams of a light grid, or over them, before it stops [m]: ISO 13855, 6.3."""


def approach(stopping: float, reached: float = 0.0) -> float:
    """Least distance S = K T + C [m] of a guard from a hazard that stands T seconds after it is opened.

    reached  C: how far a hand is through it before [m]

    >>> round(approach(0.5), 9)
    0.8
    """
    return APPROACH * stopping + reached


_ROUNDING = 1e-9
