# ruff: noqa: PLR0917, C901 - compiled functions take their arguments by position
"""Local search in a family of pairs of guides: to the limits, and from there to the best merit; compiled kernels.

A pair is given by its parameters x: of three poses the pivots of both links (x1, y1, x2, y2), of four poses the
parameters of both links on their curves (t1, t2): a sample's index and the share of the step to the next.

To the limits: Levenberg-Marquardt steps on the margins that are below zero, with numerical derivatives. A step of it
intersects the family with the violated limits to first order, so that it ends on the intersection itself.
To the merit: the simplex method of Nelder and Mead within the limits.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray
from ilmek.num.compiled import compiled
from ilmek.synthesis.motion.measures import (
    BAD,
    CRANK_REGION,
    MARGINS,
    MOTION,
    ROCKER_REGION,
    SearchBounds,
    set_cranks,
    set_margins,
    set_pins,
    set_swept,
    violation,
)
from ilmek.synthesis.motion.regions import region_margin

SLACK = 1e-3
"""Margin at which the steps to the limits aim, so that they end inside."""

STEP = 1e-6
"""Difference of a parameter for numerical derivatives."""

EDGE = 2e-10
"""Negative margin that counts as rounding."""


class GuideFamily(NamedTuple):
    """A family of guides of poses, in the task's frame.

    forms    matrices G of poses 2 to n (`constant_distance`), shape (2 or 3, 3, 3)
    points   of the body at the poses      turned   e^{i angle} of the body from its first pose
    curve    of four poses: samples of the pivots' curve, homogeneous, one closed part after the other; else empty
    ends     of four poses: for each sample the first index of its part, and the index after its last
    """

    forms: FloatArray
    points: ComplexArray
    turned: ComplexArray
    curve: FloatArray
    ends: IntArray


class OtherPairs(NamedTuple):
    """Pairs that a search keeps `apart` from: their pivots and pins, shape (n, 4)."""

    pins: ComplexArray
    apart: float


@compiled
def line_of(pivot: FloatArray, form: FloatArray, line: FloatArray) -> None:
    """Write the line m̃ᵀ G of the pins of a pivot."""
    for b in range(3):
        line[b] = pivot[0] * form[0, b] + pivot[1] * form[1, b] + pivot[2] * form[2, b]


@compiled
def meeting(one: FloatArray, other: FloatArray, point: FloatArray) -> None:
    """Write the product of two lines, their common point."""
    point[0] = one[1] * other[2] - one[2] * other[1]
    point[1] = one[2] * other[0] - one[0] * other[2]
    point[2] = one[0] * other[1] - one[1] * other[0]


@compiled
def pivot_on_curve(
    family: GuideFamily, t: float, part: int, lines: FloatArray, pivot: FloatArray, work: FloatArray
) -> None:
    """Write the pivot of parameter t on the closed part that contains sample `part`, and its three lines."""
    first, stop = family.ends[part, 0], family.ends[part, 1]
    count = stop - first
    along = (t - first) % count
    at = min(int(along), count - 1)
    share, one, other = along - at, family.curve[first + at], family.curve[first + (at + 1) % count]
    same = one[0] * other[0] + one[1] * other[1] + one[2] * other[2]
    for a in range(3):
        pivot[a] = (1 - share) * one[a] + (share if same >= 0 else -share) * other[a]
    for _ in range(4):
        size = np.sqrt(pivot[0] ** 2 + pivot[1] ** 2 + pivot[2] ** 2)
        for a in range(3):
            pivot[a] /= size
        for i in range(3):
            line_of(pivot, family.forms[i], lines[i])
        meeting(lines[1], lines[2], work[0])
        meeting(lines[2], lines[0], work[1])
        meeting(lines[0], lines[1], work[2])
        value = lines[0, 0] * work[0, 0] + lines[0, 1] * work[0, 1] + lines[0, 2] * work[0, 2]
        steep = 0.0
        for a in range(3):
            slope = 0.0
            for i in range(3):
                for b in range(3):
                    slope += family.forms[i, a, b] * work[i, b]
            work[3, a] = slope
            steep += slope * slope
        if not steep > 1e-24:
            break
        for a in range(3):
            pivot[a] -= value / steep * work[3, a]
    for i in range(3):
        line_of(pivot, family.forms[i], lines[i])


@compiled
def link_of(family: GuideFamily, x: FloatArray, at: int, part: int, work: FloatArray) -> tuple[complex, complex]:
    """Pivot and pin of the link whose parameters begin at x[at]; NaN where one of them is at infinity."""
    lines, pivot, pin = work[0:3], work[3], work[4]
    if len(family.forms) == 2:
        pivot[0], pivot[1], pivot[2] = x[2 * at], x[2 * at + 1], 1.0
        line_of(pivot, family.forms[0], lines[0])
        line_of(pivot, family.forms[1], lines[1])
        meeting(lines[0], lines[1], pin)
    else:
        pivot_on_curve(family, x[at], part, lines, pivot, work[5:9])
        most = 0.0
        for i in range(3):
            meeting(lines[i], lines[(i + 1) % 3], work[5])
            size = work[5, 0] ** 2 + work[5, 1] ** 2 + work[5, 2] ** 2
            if size > most:
                most = size
                pin[0], pin[1], pin[2] = work[5, 0], work[5, 1], work[5, 2]
    far = abs(pin[2]) <= 1e-9 * (abs(pin[0]) + abs(pin[1])) or abs(pivot[2]) <= 1e-9
    if far or not pin[2] * pin[2] > 0:
        return complex(np.nan, np.nan), complex(np.nan, np.nan)
    return complex(pivot[0], pivot[1]) / pivot[2], complex(pin[0], pin[1]) / pin[2]


@compiled
def evaluate(
    family: GuideFamily,
    bounds: SearchBounds,
    others: OtherPairs,
    x: FloatArray,
    parts: IntArray,
    margins: FloatArray,
    work: FloatArray,
) -> float:
    """Write the margins of the pair of parameters x; returns its merit, 0 where it has no motion.

    Where the pair is nearer to `others.pins` than `others.apart`, the merit is negative by the difference.
    """
    margins[:] = -BAD
    n = len(family.points)
    m1, w1 = link_of(family, x, 0, parts[0], work)
    m2, w2 = link_of(family, x, 1, parts[1], work)
    if not abs(m1) + abs(m2) + abs(w1) + abs(w2) < 1e9:
        return 0.0
    pins1, pins2 = np.empty(n, np.complex128), np.empty(n, np.complex128)
    cranks, motion = np.empty(n), np.zeros(MOTION)
    set_pins(w1, family.points, family.turned, pins1)
    set_pins(w2, family.points, family.turned, pins2)
    set_cranks(m1, pins1, cranks)
    if not set_margins(m1, pins1, cranks, m2, pins2, bounds.limits, margins, motion):
        return 0.0
    margins[CRANK_REGION] = region_margin(m1, bounds.boxes[0], bounds.crank)
    margins[ROCKER_REGION] = region_margin(m2, bounds.boxes[1], bounds.rocker)
    worth = set_swept(m1, pins1, m2, pins2, family.points, bounds, margins, motion, True)
    for row in range(len(others.pins)):
        far = 0.0
        for at, one in enumerate((m1, m2, w1, w2)):
            far = max(far, abs(one - others.pins[row, at]))
        if far < others.apart:
            worth = min(worth, far - others.apart)
    return worth


@compiled
def clip(family: GuideFamily, bounds: SearchBounds, x: FloatArray) -> None:
    """Move the pivots of three poses into their boxes."""
    if len(family.forms) == 2:
        for at in range(2):
            x[2 * at] = min(max(x[2 * at], bounds.boxes[at, 0]), bounds.boxes[at, 1])
            x[2 * at + 1] = min(max(x[2 * at + 1], bounds.boxes[at, 2]), bounds.boxes[at, 3])


@compiled
def solve_damped(slopes: FloatArray, short: FloatArray, damping: float, move: FloatArray) -> None:
    """Write the damped least squares step: (JᵀJ + damping diag) move = Jᵀ short, by Gauss elimination."""
    n = len(move)
    matrix = np.zeros((n, n + 1))
    for i in range(n):
        for j in range(n):
            for k in range(len(short)):
                matrix[i, j] += slopes[k, i] * slopes[k, j]
        for k in range(len(short)):
            matrix[i, n] += slopes[k, i] * short[k]
    for i in range(n):
        matrix[i, i] += damping * (matrix[i, i] + 1e-12)
    for i in range(n):
        pivot = matrix[i, i]
        if not abs(pivot) > 1e-300:
            move[:] = 0.0
            return
        for j in range(i + 1, n):
            factor = matrix[j, i] / pivot
            for k in range(i, n + 1):
                matrix[j, k] -= factor * matrix[i, k]
    for i in range(n - 1, -1, -1):
        value = matrix[i, n]
        for k in range(i + 1, n):
            value -= matrix[i, k] * move[k]
        move[i] = value / matrix[i, i]


@compiled
def to_limits(
    family: GuideFamily,
    bounds: SearchBounds,
    others: OtherPairs,
    x: FloatArray,
    parts: IntArray,
    steps: int,
    work: FloatArray,
) -> float:
    """Move x to where all margins are above zero; returns the violation that is left, 0 where none is."""
    n = len(x)
    margins, near = np.empty(MARGINS), np.empty(MARGINS)
    slopes, short, move, tried = np.zeros((MARGINS, n)), np.zeros(MARGINS), np.zeros(n), np.empty(n)
    clip(family, bounds, x)
    evaluate(family, bounds, others, x, parts, margins, work)
    value, damping = violation(margins, MARGINS, SLACK), 1e-3
    for _ in range(steps):
        if value == 0 or value >= 2 * BAD**2:
            break
        for k in range(MARGINS):
            slack = 0.0 if k in (CRANK_REGION, ROCKER_REGION) else SLACK
            short[k] = min(max(slack - margins[k], 0.0), BAD)
        for i in range(n):
            before = x[i]
            difference = STEP * max(1.0, abs(before)) if len(family.forms) == 2 else 100 * STEP
            x[i] = before + difference
            evaluate(family, bounds, others, x, parts, near, work)
            x[i] = before
            for k in range(MARGINS):
                slope = (near[k] - margins[k]) / difference
                slopes[k, i] = slope if short[k] > 0 and abs(slope) < 1e6 else 0.0
        better = False
        for _ in range(6):
            solve_damped(slopes, short, damping, move)
            for i in range(n):
                tried[i] = x[i] + move[i]
            clip(family, bounds, tried)
            evaluate(family, bounds, others, tried, parts, near, work)
            left = violation(near, MARGINS, SLACK)
            if left < value:
                better = left < 0.999 * value
                x[:], margins[:], value, damping = tried, near, left, max(damping / 9, 1e-9)
                break
            damping = max(damping, 1e-6) * 8
        if not better:
            break
    return violation(margins, MARGINS, -EDGE)


@compiled
def repair_rows(
    family: GuideFamily,
    bounds: SearchBounds,
    others: OtherPairs,
    xs: FloatArray,
    parts: IntArray,
    start: int,
    stop: int,
    steps: int,
    left: FloatArray,
    worth: FloatArray,
) -> None:
    """`to_limits` of the rows from start to stop of xs; writes the violations that are left and the merits."""
    work, margins = np.zeros((10, 3)), np.empty(MARGINS)
    for row in range(start, stop):
        left[row] = to_limits(family, bounds, others, xs[row], parts[row], steps, work)
        worth[row] = evaluate(family, bounds, others, xs[row], parts[row], margins, work)


@compiled
def cost(
    family: GuideFamily,
    bounds: SearchBounds,
    others: OtherPairs,
    x: FloatArray,
    parts: IntArray,
    margins: FloatArray,
    work: FloatArray,
) -> float:
    """What `improve` makes least: minus the merit within the limits, the violation above 100 elsewhere."""
    clip(family, bounds, x)
    worth = evaluate(family, bounds, others, x, parts, margins, work)
    left = violation(margins, MARGINS, -EDGE)
    return 1e2 + left if left > 0 else -worth


@compiled
def improve(
    family: GuideFamily,
    bounds: SearchBounds,
    others: OtherPairs,
    x: FloatArray,
    parts: IntArray,
    reach: float,
    evaluations: int,
) -> float:
    """Move x to the least `cost` near it, by three runs of the simplex method; returns it.

    reach  side of the first simplex      evaluations  of the cost, nearly
    """
    n = len(x)
    work, margins = np.zeros((10, 3)), np.empty(MARGINS)
    corners, values = np.empty((n + 1, n)), np.empty(n + 1)
    for begin in range(3):
        for at in range(n + 1):
            corners[at] = x
            if at > 0:
                corners[at, at - 1] += reach * (0.1**begin) * (1.0 if begin % 2 == 0 else -1.0)
            values[at] = cost(family, bounds, others, corners[at], parts, margins, work)
        for _ in range(evaluations // 6):
            if np.max(values) - np.min(values) < 1e-10:
                break
            move_simplex(family, bounds, others, corners, values, parts, margins, work)
        x[:] = corners[np.argmin(values)]
    return float(np.min(values))


@compiled
def move_simplex(
    family: GuideFamily,
    bounds: SearchBounds,
    others: OtherPairs,
    corners: FloatArray,
    values: FloatArray,
    parts: IntArray,
    margins: FloatArray,
    work: FloatArray,
) -> None:
    """One step of the simplex method: reflection, expansion, contraction or shrinking.  [Nelder and Mead, 1965]"""
    n = corners.shape[1]
    order = np.argsort(values)
    best, worst, second = order[0], order[n], order[n - 1]
    middle = (np.sum(corners, axis=0) - corners[worst]) / n
    tried = 2 * middle - corners[worst]
    value = cost(family, bounds, others, tried, parts, margins, work)
    if value < values[best]:
        further = 3 * middle - 2 * corners[worst]
        least = cost(family, bounds, others, further, parts, margins, work)
        if least < value:
            tried, value = further, least
    elif value >= values[second]:
        if value < values[worst]:
            corners[worst], values[worst] = tried, value
        tried = 0.5 * (middle + corners[worst])
        value = cost(family, bounds, others, tried, parts, margins, work)
    if value < values[worst]:
        corners[worst], values[worst] = tried, value
        return
    for at in range(n + 1):
        corners[at] = 0.5 * (corners[best] + corners[at])
        values[at] = cost(family, bounds, others, corners[at], parts, margins, work)


@compiled
def pair_of(family: GuideFamily, x: FloatArray, parts: IntArray) -> ComplexArray:
    """Pivots and pins at the first pose of the pair of parameters x: m1, m2, w1, w2."""
    work = np.zeros((10, 3))
    found = np.empty(4, np.complex128)
    found[0], found[2] = link_of(family, x, 0, parts[0], work)
    found[1], found[3] = link_of(family, x, 1, parts[1], work)
    return found
