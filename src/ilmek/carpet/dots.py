"""Dots: whether a small patch belongs to a pattern of dots at equal steps.

A step is the vector from a patch to the nearest patch of its yarn and of like size. The patch belongs to a row of dots
if dots follow at that step, to one or both sides, DOTS in all; a dot may lie off by a quarter of the step and at most
1.5 knots, as the dots of a drawing do whose steps are no whole knots.
"""

import math

import numpy as np

from ilmek.arrays import Indices, IntArray
from ilmek.carpet.patches import Marks, Members, fill, next_mark
from ilmek.num.compiled import uncounted

LARGEST_STEP = 12
"""Knots between two dots, along rows and columns."""

DOTS = 5
"""Dots of a row."""

REACH = DOTS * (LARGEST_STEP + 2)
"""Knots between a patch and the furthest dot that is looked for."""

_NEARLY = 1.2
"""A dot at this multiple of the least distance, and half a knot more, is tried as well: dots drawn at equal steps."""

_MOST_OFF = 3


def _offsets(odd_row: int, odd_column: int) -> IntArray:
    """The vectors from a middle to the knots around it, in half knots, in the order of their length."""
    down, right = np.mgrid[-2 * LARGEST_STEP : 2 * LARGEST_STEP + 1, -2 * LARGEST_STEP : 2 * LARGEST_STEP + 1]
    kept = ((down + odd_row) % 2 == 0) & ((right + odd_column) % 2 == 0) & ((down != 0) | (right != 0))
    order = np.argsort((down * down + right * right)[kept], kind="stable")
    short = np.stack([down[kept], right[kept]], axis=-1)[order]
    return np.concatenate([short, np.full(((2 * LARGEST_STEP + 1) ** 2 - len(short), 2), 1 << 14)])


_OFFSETS = np.stack([_offsets(row, column) for row in (0, 1) for column in (0, 1)]).astype(np.int16)
"""They stay in the nearest cache."""


@uncounted
def middle_of(members: Members, number: int) -> tuple[int, int]:
    """The middle of the rectangle around the knots of a patch, in half knots."""
    top, left = members[0]
    bottom, right = members[0]
    for k in range(1, number):
        y, x = members[k]
        top, bottom, left, right = min(top, y), max(bottom, y), min(left, x), max(right, x)
    return top + bottom, left + right


@uncounted
def _alike(  # noqa: PLR0917
    knots: Indices, i: int, j: int, yarn: int, number: int, least: int, members: Members, marks: Marks
) -> int:  # fmt: skip
    """The size of the patch of a knot if it is of a yarn and a small one of like size, else 0; writes its members."""
    if knots[i, j] != yarn:
        return 0
    size = fill(knots, i, j, least, False, members, marks, next_mark(marks))
    return size if size < least and 2 * abs(size - number) <= max(2, number) else 0


@uncounted
def _dot_at(  # noqa: PLR0917
    knots: Indices, row: int, column: int, off: int, yarn: int, number: int, least: int, members: Members, marks: Marks
) -> tuple[int, int, bool]:  # fmt: skip
    """The middle of the dot nearest to a position, at most `off` half knots from it, and whether there is just one."""
    best, found_row, found_column, clear = 1000, 0, 0, False
    for i in range(max(-((off + 1 - row) // 2), 0), min((row + off + 1) // 2 + 1, knots.shape[0])):
        for j in range(max(-((off + 1 - column) // 2), 0), min((column + off + 1) // 2 + 1, knots.shape[1])):
            size = _alike(knots, i, j, yarn, number, least, members, marks)
            if size > 0:
                y, x = middle_of(members, size)
                distance = max(abs(y - row), abs(x - column))
                if distance <= off and distance < best:
                    best, found_row, found_column, clear = distance, y, x, True
                elif distance == best and (y != found_row or x != found_column):
                    clear = False
    return found_row, found_column, clear


@uncounted
def _dots_along(  # noqa: PLR0917
    knots: Indices, row: int, column: int, down: int, right: int, yarn: int, number: int, least: int,
    members: Members, marks: Marks
) -> int:  # fmt: skip
    """How many dots follow at a step, at most DOTS - 1."""
    off = min(max(max(abs(down), abs(right)) // 4, 1), _MOST_OFF)
    for found in range(DOTS - 1):
        row, column, clear = _dot_at(knots, row + down, column + right, off, yarn, number, least, members, marks)
        if not clear:
            return found
    return DOTS - 1


@uncounted
def in_row(knots: Indices, own: Members, number: int, least: int, members: Members, marks: Marks) -> bool:  # noqa: PLR0917
    """Whether a patch of fewer than `least` knots belongs to a row of dots.

    own  knots of the patch      members, marks  room of a fill
    """
    yarn = knots[own[0, 0], own[0, 1]]
    row, column = middle_of(own, number)
    furthest = 8 * LARGEST_STEP * LARGEST_STEP
    offsets = _OFFSETS[2 * (row % 2) + column % 2]
    for k in range(len(offsets)):
        down, right = int(offsets[k, 0]), int(offsets[k, 1])
        if down * down + right * right > furthest:
            return False
        i, j = (row + down) // 2, (column + right) // 2
        if not (0 <= i < knots.shape[0] and 0 <= j < knots.shape[1] and knots[i, j] == yarn):
            continue
        if _is_own(own, number, i, j):
            continue
        size = _alike(knots, i, j, yarn, number, least, members, marks)
        if size == 0:
            continue
        nearly = int((_NEARLY * math.sqrt(down * down + right * right) + 1.0) ** 2)
        furthest = min(furthest, nearly)
        y, x = middle_of(members, size)
        down, right = y - row, x - column
        dots = 1 + _dots_along(knots, row, column, down, right, yarn, number, least, members, marks)
        if dots < DOTS:
            dots += _dots_along(knots, row, column, -down, -right, yarn, number, least, members, marks)
        if dots >= DOTS:
            return True
    return False


@uncounted
def _is_own(own: Members, number: int, i: int, j: int) -> bool:
    for k in range(number):  # noqa: SIM110 - `any` is not compiled
        if own[k, 0] == i and own[k, 1] == j:
            return True
    return False
