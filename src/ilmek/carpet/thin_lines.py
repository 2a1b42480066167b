"""Thin lines: whether a small patch is a piece of a line.

The knots of a square around the patch that are alike lie along a line if their moments of second order say so: with the
greater and the lesser eigenvalue of their covariance, the line is thin (lesser <= 0.7 knots²; a line two knots wide has
0.25) and long (greater >= 2.5 knots², a line of 5.5 knots, and at least 8 times the lesser).
Knots are alike in two senses, and either will do: of the patch's yarn; and nearer to that yarn than to the one that the
patch would take, which joins the pieces of an anti-aliased line of several yarns.

A patch between two areas is no line but the blend of their edge, where its yarn lies between theirs.
"""

import math

from ilmek.arrays import FloatArray, Indices, IntArray
from ilmek.num.compiled import compiled, uncounted

RADIUS = 5
"""Knots from the middle of a patch to the side of the square."""

THICKEST, SHORTEST, SLENDER = 0.7, 2.5, 8.0
"""Greatest lesser eigenvalue [knots²], least greater one [knots²], and least ratio of a line."""

_LEAST = 4
"""Knots of a line beyond those of the patch."""


@uncounted
def between_areas(around: IntArray, ring: int, yarn: int, other: int, gap: FloatArray) -> bool:
    """Whether a patch has two areas around it whose yarns are further from each other than its own is from each.

    around  number of each yarn's knots around the patch, `ring` in all      other  the yarn that it would take
    gap     CIEDE2000 of each two yarns
    """
    for second in range(len(around)):
        wide = second != other and 8 * around[second] >= 3 * ring
        if wide and gap[second, other] > max(gap[yarn, other], gap[yarn, second]):
            return True
    return False


@compiled
def _along_a_line(  # noqa: PLR0917
    count: int, number: int, y: int, x: int, yy: int, xx: int, xy: int
) -> bool:
    """Whether `count` knots lie along a line, from the sums of their places in half knots and of the products."""
    # The moments are whole numbers, equal for a mirrored or turned chart.
    if count < number + _LEAST:
        return False
    along, across, mixed = count * yy - y * y, count * xx - x * x, count * xy - x * y
    half = 0.5 * (along + across)
    root = math.sqrt(0.25 * float(along - across) ** 2 + float(mixed) ** 2)
    unit = 4.0 * count * count
    greater, lesser = (half + root) / unit, (half - root) / unit
    return lesser <= THICKEST and greater >= SHORTEST and greater >= SLENDER * lesser


@uncounted
def on_line(  # noqa: PLR0917
    knots: Indices, row: int, column: int, number: int, yarn: int, other: int, gap: FloatArray
) -> bool:
    """Whether the knots around a patch of `number` knots lie along a line.

    row, column  middle of the patch in half knots      other  the yarn that it would take
    """
    alikes, ys, xs, yys, xxs, xys = 0, 0, 0, 0, 0, 0
    sames, y1, x1, yy1, xx1, xy1 = 0, 0, 0, 0, 0, 0
    for i in range(max(-((2 * RADIUS - row) // 2), 0), min((row + 2 * RADIUS) // 2 + 1, knots.shape[0])):
        for j in range(max(-((2 * RADIUS - column) // 2), 0), min((column + 2 * RADIUS) // 2 + 1, knots.shape[1])):
            one = knots[i, j]
            if one != other and gap[one, yarn] < gap[one, other]:
                y, x = 2 * i - row, 2 * j - column
                alikes, ys, xs, yys, xxs, xys = alikes + 1, ys + y, xs + x, yys + y * y, xxs + x * x, xys + x * y
                if one == yarn:
                    sames, y1, x1, yy1, xx1, xy1 = sames + 1, y1 + y, x1 + x, yy1 + y * y, xx1 + x * x, xy1 + x * y
    return _along_a_line(sames, number, y1, x1, yy1, xx1, xy1) or _along_a_line(alikes, number, ys, xs, yys, xxs, xys)
