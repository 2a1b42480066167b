# ruff: noqa: PLR0917, C901 - compiled functions take their arguments by position
"""Margins of a four-bar of two guides against every limit, as compiled kernels; a limit is kept at a margin >= 0.

All lengths are in the task's frame, in which its size is 1. Every margin is continuous almost everywhere and about one
unit large where the four-bar is wrong by its own size, so that a search can follow it (`motion.refine`).

Circuit, branch, order, transmission angle and size are those of `candidate.judge`, which judges every result again.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray
from ilmek.num.compiled import compiled
from ilmek.plane import vectors
from ilmek.synthesis import merit as merit_terms
from ilmek.synthesis.motion.regions import NONE, circle_about, clearance, region_margin

(RATIO, BRANCH, CIRCUIT, ORDER, TURN, TRANSMISSION, CRANK_REGION, ROCKER_REGION, CRANK_SWING) = range(9)
SIZE, ROCKER_SWING, KEEP_OUT = range(9, 12)
MARGINS = 12
"""Indices of the margins; those from SIZE on need the whole motion."""

EVEN_RATIO, ONE_BRANCH, ONE_CIRCUIT, IN_ORDER, FULL_TURN, LEAST_SINE, TASK_ONLY, SIZE_MAX, EXTENT = range(9)
CRANK_LOW, CRANK_HIGH, ROCKER_LOW, ROCKER_HIGH = range(9, 13)
LIMITS = 13
"""Indices of the array of limits: greatest link ratio, four flags, sine of the least transmission angle, whether it is
that of the task alone, greatest size, extent of the poses, bounds on the rotation of the crank from first to last pose
and on the swing of the rocker."""

SIGN, LOW, HIGH, TURNS, SINE, GROUND = range(6)
MOTION = 6
"""Indices of what is known of a motion: side of B, crank angles of the task from the ground line [rad], whether the
crank turns fully, least sine of the transmission angle, angle of the ground line [rad]."""

EQUAL = 1e-12
"""Difference of sums of two links, in the sum of all four, up to which they are equal: a change point."""

BAD = 10.0
"""Violation of a four-bar that has no motion: of all its margins."""

PI = np.pi
FULL = 2 * np.pi

STEPS = 48
"""Positions of the motion at which size, swing and clearance are computed."""

SAGITTA, SWING_ROUNDING = 0.04, 1.002
"""How much nearer the motion may come between two of these positions, in the distance that a joint moves from one to
the next; and how much greater the swing may be than between them."""

HEADINGS = np.exp(1j * PI * np.arange(24) / 24)
WIDEST = 1 / np.cos(PI / 48)
"""Directions in which the size is measured, and the greatest size for a width of 1 in the widest of them."""

cross, dot = compiled(vectors.cross), compiled(vectors.dot)
merit_value = compiled(merit_terms.merit_value)
coupler_rates = compiled(merit_terms.coupler_rates)


class SearchBounds(NamedTuple):
    """Limits of a search, in the task's frame; see the indices above.

    boxes     of the crank's and the rocker's pivot: least and greatest x and y, shape (2, 4)
    crank, rocker   polygons of their pivots, and keep_out the polygon that no link may touch; empty where not given
    """

    limits: FloatArray
    boxes: FloatArray
    crank: ComplexArray
    rocker: ComplexArray
    keep_out: ComplexArray


@compiled
def cosine_range(low: float, high: float) -> tuple[float, float]:
    """Least and greatest cosine of the angles from low to high [rad]."""
    one, other = np.cos(low), np.cos(high)
    least, most = min(one, other), max(one, other)
    if np.floor(high / FULL) * FULL >= low:
        most = 1.0
    if np.floor((high - PI) / FULL) * FULL + PI >= low:
        least = -1.0
    return least, most


@compiled
def least_sine(ground: float, crank: float, coupler: float, rocker: float, least: float, most: float) -> float:
    """Least sine of the transmission angle where the cosine of the crank's angle goes from least to most."""
    found = 1.0
    for cosine in (least, most):
        square = ground * ground + crank * crank - 2 * ground * crank * cosine
        mu = (coupler * coupler + rocker * rocker - square) / (2 * coupler * rocker)
        found = min(found, np.sqrt(max(0.0, 1 - mu * mu)))
    return found


@compiled
def set_order(cranks: FloatArray, turns: bool, both: bool, across: bool, motion: FloatArray) -> tuple[float, float]:
    """Margins of order and of circuit of crank angles [rad]; writes the crank angles of the task.

    turns   the crank turns fully          both  it rocks within two intervals       across  and passes 180°
    """
    count, first = len(cranks), cranks[0] - motion[GROUND]
    rises, falls, before, after = np.inf, np.inf, 0.0, FULL
    if turns:
        for at in range(1, count):
            onward = (cranks[at] - cranks[0]) % FULL
            rises, falls = min(rises, onward - before), min(falls, after - onward)
            before, after = onward, onward
        # The last rotation back to the first position counts too: in one turn it is above 0.
        if rises >= falls:
            motion[LOW], motion[HIGH] = first, first + before
        else:
            motion[LOW], motion[HIGH] = first - (FULL - before), first
        return max(rises, falls), NONE
    above, below = np.inf, np.inf
    last = 0.0
    for at in range(count):
        angle = (cranks[at] - motion[GROUND] + PI) % FULL - PI
        above, below = min(above, np.sin(angle)), min(below, -np.sin(angle))
        if across and angle < 0:
            angle += FULL
        if at == 0:
            motion[LOW] = motion[HIGH] = angle
        else:
            rises, falls = min(rises, angle - last), min(falls, last - angle)
        motion[LOW], motion[HIGH] = min(motion[LOW], angle), max(motion[HIGH], angle)
        last = angle
    return max(rises, falls), (max(above, below) if both else NONE)


@compiled
def set_margins(
    m1: complex,
    pins1: ComplexArray,
    cranks: FloatArray,
    m2: complex,
    pins2: ComplexArray,
    limits: FloatArray,
    margins: FloatArray,
    motion: FloatArray,
) -> bool:
    """Write the margins up to TRANSMISSION and CRANK_SWING; False where a link has no length.

    m1, pins1, cranks  pivot, pin at the poses and angles of the crank [rad]      m2, pins2  of the rocker
    """
    base = m2 - m1
    ground, crank = abs(base), abs(pins1[0] - m1)
    coupler, rocker = abs(pins2[0] - pins1[0]), abs(pins2[0] - m2)
    shortest, longest = min(ground, crank, coupler, rocker), max(ground, crank, coupler, rocker)
    if not (shortest > 1e-9 and longest < 1e9):
        return False
    margins[RATIO] = min(NONE, np.log(limits[EVEN_RATIO] * shortest / longest))
    least, most = np.inf, -np.inf
    for at in range(len(pins1)):
        sine = cross(pins2[at] - pins1[at], pins2[at] - m2) / (coupler * rocker)
        least, most = min(least, sine), max(most, sine)
    motion[SIGN] = 1.0 if least + most >= 0 else -1.0
    one_side = least if least + most >= 0 else -most
    margins[BRANCH] = one_side if limits[ONE_BRANCH] > 0 else NONE
    inner, outer = abs(ground - crank) - abs(coupler - rocker), coupler + rocker - ground - crank
    size = 0.25 * (ground + crank + coupler + rocker)
    # A crank passes the ground line only where the triangle A, B0, B does not flatten there: at a change point it jams.
    passes_inner, passes_outer = inner > 2 * EQUAL * size, outer > 2 * EQUAL * size
    turns = passes_inner and passes_outer
    margins[TURN] = min(inner, outer) / size if limits[FULL_TURN] > 0 else NONE
    motion[TURNS], motion[GROUND] = (1.0 if turns else 0.0), np.arctan2(base.imag, base.real)
    order, circuit = set_order(
        cranks, turns, not passes_inner and not passes_outer, passes_outer and not passes_inner, motion
    )
    margins[ORDER] = order if limits[IN_ORDER] > 0 else NONE
    margins[CIRCUIT] = NONE
    if limits[ONE_CIRCUIT] > 0:
        margins[CIRCUIT] = min(circuit, one_side) if turns else circuit
    low, high = cosine_range(motion[LOW], motion[HIGH])
    if turns and not limits[TASK_ONLY] > 0:
        low, high = -1.0, 1.0
    motion[SINE] = least_sine(ground, crank, coupler, rocker, low, high)
    margins[TRANSMISSION] = motion[SINE] - limits[LEAST_SINE] if limits[LEAST_SINE] > 0 else NONE
    swing = motion[HIGH] - motion[LOW]
    margins[CRANK_SWING] = min(NONE, swing - limits[CRANK_LOW], limits[CRANK_HIGH] - swing)
    return True


@compiled
def widen(point: complex, least: FloatArray, most: FloatArray) -> None:
    """Let the least and greatest positions along `HEADINGS` take in a point."""
    for at in range(len(HEADINGS)):
        reach = HEADINGS[at].real * point.real + HEADINGS[at].imag * point.imag
        least[at], most[at] = min(least[at], reach), max(most[at], reach)


@compiled
def set_swept(
    m1: complex,
    pins1: ComplexArray,
    m2: complex,
    pins2: ComplexArray,
    points: ComplexArray,
    bounds: SearchBounds,
    margins: FloatArray,
    motion: FloatArray,
    thorough: bool,
) -> float:
    """Write the margins that need the whole motion; returns the merit (`synthesis.merit`).

    points  of the body at the poses      motion  as `set_margins` wrote it
    thorough  False: the clearance ends at the first position that touches the region
    """
    limits = bounds.limits
    ground, crank = abs(m2 - m1), abs(pins1[0] - m1)
    coupler, rocker = abs(pins2[0] - pins1[0]), abs(pins2[0] - m2)
    tracer = (points[0] - pins1[0]) / (pins2[0] - pins1[0])
    low, high = (-PI, PI) if motion[TURNS] > 0 else (motion[LOW], motion[HIGH])
    least, most = np.full(len(HEADINGS), np.inf), np.full(len(HEADINGS), -np.inf)
    clear, swung, swing_low, swing_high = NONE, 0.0, 0.0, 0.0
    before, circle, stride, last_a, last_b, last_p = pins2[0] - m2, circle_about(bounds.keep_out), 0.0, m1, m1, m1
    for step in range(STEPS + 1):
        angle = low + (high - low) * step / STEPS + motion[GROUND]
        a = m1 + crank * complex(np.cos(angle), np.sin(angle))
        d = m2 - a
        square = max(d.real * d.real + d.imag * d.imag, 1e-200)
        along = 0.5 + 0.5 * (coupler * coupler - rocker * rocker) / square
        across = np.sqrt(max(coupler * coupler / square - along * along, 0.0))
        b = a + complex(along, motion[SIGN] * across) * d
        p = a + tracer * (b - a)
        for one in (a, b, p):
            widen(one, least, most)
        if limits[ROCKER_HIGH] < 100 or limits[ROCKER_LOW] > 0:
            swung += float(np.arctan2(cross(before, b - m2), dot(before, b - m2)))
            before = b - m2
            swing_low, swing_high = min(swing_low, swung), max(swing_high, swung)
        if len(bounds.keep_out) and (thorough or clear > 0):
            stride = max(stride, abs(a - last_a), abs(b - last_b), abs(p - last_p)) if step > 0 else 0.0
            last_a, last_b, last_p = a, b, p
            for one, other in ((m1, a), (m2, b), (a, b), (a, p), (b, p)):
                clear = min(clear, clearance(one, other, bounds.keep_out, circle))
    widen(m1, least, most)
    widen(m2, least, most)
    widest = np.max(most - least)
    margins[SIZE] = min(NONE, np.log(limits[SIZE_MAX] / (widest * WIDEST)))
    swung = swing_high - swing_low
    margins[ROCKER_SWING] = min(NONE, swung - limits[ROCKER_LOW], limits[ROCKER_HIGH] - SWING_ROUNDING * swung)
    margins[KEEP_OUT] = min(NONE, clear - SAGITTA * stride) if len(bounds.keep_out) else NONE
    ratio = max(ground, crank, coupler, rocker) / min(ground, crank, coupler, rocker)
    size, gain = widest / limits[EXTENT], sensitivity(m1, pins1, m2, pins2, points, limits[EXTENT])
    return float(merit_value(motion[SINE], size, ratio, gain))


@compiled
def sensitivity(
    m1: complex, pins1: ComplexArray, m2: complex, pins2: ComplexArray, points: ComplexArray, extent: float
) -> float:
    """The term G of the merit of poses: points and angles of the coupler."""
    worst = 0.0
    for at in range(len(points)):
        total = 0.0
        arm = points[at] - pins1[at]
        rates = coupler_rates(m1, m2, pins1[at], pins2[at])
        for link in range(4):
            moved = 1j * arm * rates[link]
            if link == 1:
                moved += (pins1[at] - m1) / abs(pins1[at] - m1)
            total += np.sqrt(abs(moved) ** 2 + (extent * rates[link]) ** 2)
        worst = max(worst, total)
    return worst


@compiled
def violation(margins: FloatArray, count: int, slack: float) -> float:
    """Sum of the squares of the first `count` margins as far as they are below `slack`; at most that of BAD.

    A region may be a line or a point: its margins are compared with 0 at most.
    """
    total = 0.0
    for at in range(count):
        short = (min(slack, 0.0) if at in (CRANK_REGION, ROCKER_REGION) else slack) - margins[at]
        if short > 0:
            total += min(short, BAD) ** 2
        elif not short <= 0:
            total += BAD**2
    return total


@compiled
def set_pins(pin: complex, points: ComplexArray, turned: ComplexArray, pins: ComplexArray) -> None:
    """Write a pin's position at every pose; turned  e^{i angle} of the body from the first pose."""
    for at in range(len(points)):
        pins[at] = points[at] + (pin - points[0]) * turned[at]


@compiled
def set_cranks(pivot: complex, pins: ComplexArray, cranks: FloatArray) -> None:
    """Write the angles of a link at every pose [rad]."""
    for at in range(len(pins)):
        arm = pins[at] - pivot
        cranks[at] = np.arctan2(arm.imag, arm.real)


@compiled
def search_rows(
    start: int,
    stop: int,
    cranks: tuple[ComplexArray, ComplexArray, FloatArray],
    rockers: tuple[ComplexArray, ComplexArray, FloatArray],
    points: ComplexArray,
    bounds: SearchBounds,
    row_best: FloatArray,
    row_index: IntArray,
    column_best: FloatArray,
    column_index: IntArray,
    counts: IntArray,
) -> int:
    """All pairs of the cranks from start to stop with all rockers; returns how many fulfil every limit.

    cranks, rockers   (pivots, pins at the poses, angles at the poses) of links
    row_best, column_best    written: least score of each crank and of each rocker: minus the merit, or the violation
    row_index, column_index  written: index of its partner      counts  added to: how many pairs fail each margin
    """
    pivots1, pins1, angles1 = cranks
    pivots2, pins2, _ = rockers
    margins, motion = np.full(MARGINS, NONE), np.zeros(MOTION)
    inside2 = np.empty(len(pivots2))
    for j in range(len(pivots2)):
        inside2[j] = region_margin(pivots2[j], bounds.boxes[1], bounds.rocker)
    found = 0
    for i in range(start, stop):
        inside1 = region_margin(pivots1[i], bounds.boxes[0], bounds.crank)
        for j in range(len(pivots2)):
            if not set_margins(pivots1[i], pins1[i], angles1[i], pivots2[j], pins2[j], bounds.limits, margins, motion):
                continue
            margins[CRANK_REGION], margins[ROCKER_REGION] = inside1, inside2[j]
            score = violation(margins, SIZE, 0.0)
            count = SIZE
            if score == 0:
                worth = set_swept(pivots1[i], pins1[i], pivots2[j], pins2[j], points, bounds, margins, motion, False)
                score, count = violation(margins, MARGINS, 0.0), MARGINS
                if score == 0:
                    found += 1
                    score = -worth
            if score > 0:
                for at in range(count):
                    if not margins[at] >= 0:
                        counts[at] += 1
            if score < row_best[i]:
                row_best[i], row_index[i] = score, j
            if score < column_best[j]:
                column_best[j], column_index[j] = score, i
    return found
