"""The knot that two hands tie on the two warps between them, from the crossing word of their yarn.

Both hands hold the yarn from the first pose on, straight between them; each guides its end along its path. So the yarn
follows the first hand's path backwards, the straight line, and the second hand's path. The warps are half a pitch on
either side of the mirror line. The poses do not give the height of the warps: every height at which the yarn begins and
ends in the pile is tried, with the pile above and below the warps. [derived; the proof is that of `knots.proof`]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.errors import CarpetError
from ilmek.units import format_quantity
from ilmek.weaving.knots.proof import TiedKnot, joined_ends, tied_knot

HEIGHTS = 24
"""Number of heights of the warps tried for either side of the pile, over the height of the paths."""

TRIED, HALVED = 32, 12
"""Number of pitches of the warps tried, and number of bisections of the step at a bound."""


@dataclass(frozen=True, slots=True, eq=False)
class TwoHandKnot:
    """The knot tied by two hands.

    name   the knot in words, or "no knot"                      why    where it is tied, or the reason for no knot
    tied   the knot; None: no knot
    warps  positions of the two warps [m]: of the knot, or at half of the height
    yarn   the yarn's path from end to end [m]
    """

    name: str
    why: str
    tied: TiedKnot | None
    warps: ComplexArray
    yarn: ComplexArray


def knot_of_hands(first: ComplexArray, second: ComplexArray, pitch: float) -> TwoHandKnot:
    """The knot that two hands tie on two warps of a pitch [m].

    first, second  paths of the two hands [m], mirror images about a vertical line, (points,) each

    >>> path = np.array([-3 + 0j, -1 + 2j])
    >>> knot_of_hands(path, -path.conj(), 1.0).why
    'at every height of the warps: the yarn only passes behind warps 1 and 2 from left to right'
    """
    yarn = np.asarray(joined_ends(*(np.append((first[0] + second[0]) / 2, path) for path in (first, second))))
    mirror, low, high = float((first[0] + second[0]).real) / 2, float(np.min(yarn.imag)), float(np.max(yarn.imag))
    share = (np.arange(HEIGHTS) + 0.5) / HEIGHTS
    rows = mirror + np.array([-0.5, 0.5]) * pitch + 1j * (low + (high - low) * share)[:, None]
    reasons: list[str] = []
    for pile in (1j, -1j):
        for warps in rows:
            found = _tied(yarn, warps, pile)
            if found is not None and found.knot is not None:
                height, side = format_quantity(float(warps[0].imag), "mm"), "above" if pile == 1j else "below"
                return TwoHandKnot(found.words, f"warps at y = {height}, the pile {side} them", found, warps, yarn)
            reasons += [] if found is None else [found.words.removeprefix("no knot: ")]
    why = "; ".join(dict.fromkeys(reasons)) or "nowhere are both its ends in the pile"
    return TwoHandKnot("no knot", f"at every height of the warps: {why}", None, rows[HEIGHTS // 2], yarn)


def pitch_range(first: ComplexArray, second: ComplexArray) -> tuple[float, float] | None:
    """Least and greatest pitch of the two warps [m] at which a knot is tied; None where none is found.

    first, second  paths of the two hands [m], as in `knot_of_hands`

    >>> round_one_warp = np.array([-3 + 0j, -3 + 3j, -0.5 + 3j, -0.5 + 0j])
    >>> least, most = pitch_range(round_one_warp, -round_one_warp.conj())
    >>> round(least, 3), round(most, 3)
    (1.0, 6.0)
    """
    most = 1.1 * float(np.max(np.abs(second - first)))
    tried = most * np.arange(1, TRIED + 1) / TRIED
    good = [knot_of_hands(first, second, float(one)).tied is not None for one in tried]
    if not any(good):
        return None
    ends = []
    for inner, step in ((good.index(True), -1), (TRIED - 1 - good[::-1].index(True), +1)):
        ties, fails = float(tried[inner]), float(tried[inner]) + step * most / TRIED
        for _ in range(HALVED):
            middle = (ties + fails) / 2
            ties, fails = (middle, fails) if knot_of_hands(first, second, middle).tied else (ties, middle)
        ends.append(ties)
    return ends[0], ends[1]


def _tied(yarn: ComplexArray, warps: ComplexArray, pile: complex) -> TiedKnot | None:
    """The knot on two warps; None where an end is not in the pile, or the yarn touches a warp."""
    if np.min(np.imag(yarn[[0, -1]] - warps[0]) * pile.imag) <= 0:
        return None
    try:
        return tied_knot(yarn, warps if pile == 1j else warps[::-1], pile=pile)
    except CarpetError:
        return None
