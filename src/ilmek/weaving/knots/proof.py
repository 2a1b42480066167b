"""Proof of the knot that a motion of the yarn's end ties.

A yarn that is fixed in the pile and guided by its other end follows the path of that end; pulled tight without crossing
a warp, it is that path without its loops. So the reduced word of the path (`knots.word`) identifies the knot. Equal
words are a proof, because the words distinguish all paths that cannot be deformed into each other. Where two grippers
guide one end each from one position, the yarn is the first path backwards, then the second: `joined_ends`.

The warps are at rest, and both ends must lie in the pile, in front of every warp; `pile` is its direction.
[derived from the free group of the warps: `knots.word`, Hatcher, Algebraic Topology, 1.2]
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, ComplexArray, FloatArray
from ilmek.errors import CarpetError
from ilmek.units import format_quantity
from ilmek.weaving.knots.crossings import WarpRow, check_points, crossings, sampled_curve
from ilmek.weaving.knots.word import Knot, Word, recognised, reduced, verdict


@dataclass(frozen=True, slots=True)
class TiedKnot:
    """The knot tied by a motion.

    knot      the knot, or None                           word   the reduced word of the path
    backward  the yarn runs through the knot from its     words  the knot's name, or the reason for no knot
              other end (its word is the knot's inverse)
    """

    knot: Knot | None
    word: Word
    backward: bool
    words: str


def no_knot(reason: str) -> TiedKnot:
    """The result where no knot is tied, with the reason in words."""
    return TiedKnot(None, (), False, f"no knot: {reason}")


def tied_knot(
    points: Complex[np.ndarray, " points"],
    warps: Complex[np.ndarray, " warps"],
    *,
    keep_out: float = 0.0,
    lengths: FloatArray | None = None,
    closed: bool = False,
    pile: complex = 1j,
) -> TiedKnot:
    """The knot that a path of the yarn's end ties on a row of warps, or the reason for no knot.

    points    corners of the path, or samples, in the order of the motion [m]
    warps     positions of the warps from left to right [m], seen with the pile upwards; they are numbered from 1
    keep_out  radius about each warp's axis that the path may not enter [m]
    lengths   upper bounds of the path's length between neighbouring samples [m], for example largest speed times time
              step, or the estimate `arc_lengths(points)`; default: the path is the polyline
    closed    the motion ends at its start: the first point is repeated
    pile      direction towards the pile, complex
    Raises CarpetError where the path touches a warp, and where the samples do not decide the side of a warp.

    >>> warps = np.array([0j, 2 + 0j])
    >>> tied_knot(np.array([1 + 5j, 1 - 2j, -2 - 2j, -2 + 2j, 4 + 2j, 4 - 2j, 1 - 2j, 1 + 5j]), warps).words
    'symmetric knot over warps 1 and 2'
    """
    check_points(points)
    turn = _upright(pile)
    if closed:
        points = np.append(points, points[0])
    row = WarpRow(_turned(warps, turn), keep_out)
    upright = _turned(points, turn)
    return _knot_of_word(row, upright, reduced(crossings(row, upright, lengths)))


def knot_of_curve(
    curve: Callable[[FloatArray], ComplexArray],
    speed: float,
    warps: Complex[np.ndarray, " warps"],
    *,
    keep_out: float = 0.0,
    pile: complex = 1j,
) -> TiedKnot:
    """The knot that a curve ties, sampled as finely as the proof requires.

    curve  positions [m] of the yarn's end for an array of parameters u in [0, 1]      speed  upper bound of |dz/du| [m]
    Other arguments as in `tied_knot`. Raises CarpetError where the curve touches a warp, or nearly.

    >>> ring = lambda u: 2.5j * np.exp(2j * np.pi * u)
    >>> knot_of_curve(ring, 16.0, np.array([0j, 2 + 0j])).words
    'no knot: the yarn only passes behind warps 1 and 2 from left to right'
    """
    turn = _upright(pile)
    row = WarpRow(_turned(warps, turn), keep_out)
    points, lengths = sampled_curve(row, lambda u: _turned(curve(u), turn), speed)
    return _knot_of_word(row, points, reduced(crossings(row, points, lengths)))


def joined_ends(
    first: Complex[np.ndarray, " first"], second: Complex[np.ndarray, " second"]
) -> Complex[np.ndarray, " both"]:
    """The path of a yarn whose two ends are guided from one position: the first motion backwards, then the second.

    first, second  paths of the ends [m]
    Raises CarpetError where the paths do not start at one position.

    >>> joined_ends(np.array([0j, -1 + 0j]), np.array([0j, 1 + 0j])).real.tolist()
    [-1.0, 0.0, 1.0]
    """
    check_points(first)
    check_points(second)
    gap = float(abs(first[0] - second[0]))
    if gap > 1e-9 * float(max(np.abs(np.diff(first)).sum(), np.abs(np.diff(second)).sum())):
        raise CarpetError(
            f"the two motions start {format_quantity(gap, 'mm')} apart",
            allowed="both ends start at one position of the yarn",
        )
    return np.concatenate([first[::-1], second[1:]])


def _upright(pile: complex) -> complex:
    """The rotation that turns the pile upwards; exact for the four directions of the axes."""
    if not np.isfinite(pile) or pile == 0:
        raise CarpetError(f"the pile lies in direction {pile}", allowed="a direction, such as 1j for upwards")
    turn = 1j * np.conj(pile) / abs(pile)
    return complex(turn)


def _turned(points: ComplexArray, turn: complex) -> ComplexArray:
    with np.errstate(invalid="ignore"):  # positions that are not finite raise a CarpetError later
        return np.asarray(points * turn, complex)


def _knot_of_word(row: WarpRow, points: ComplexArray, word: Word) -> TiedKnot:
    front = float(row.positions.imag.max())
    for end, name in ((points[0], "begins"), (points[-1], "ends")):
        if end.imag <= front:
            low = format_quantity(front - float(end.imag), "mm")
            return TiedKnot(
                None, word, False, f"no knot: the path {name} {low} behind the front of the warps, not in the pile"
            )
    known = recognised(word)
    return TiedKnot(known, word, known is not None and word != known.word, verdict(word))
