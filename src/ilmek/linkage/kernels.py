# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""The compiled executor: a tape's instructions over rows of samples, the groups' own leaf formulas inside.

All rows lie in one array, those of a body one after the other, `BLOCK` samples each: the compiler sees that no row
overlaps another, and works on several samples at once (measured for an RRR dyad: 3 ns a state, 17 ns one by one).
"""

import math
from typing import TypeAlias

import numpy as np
from jaxtyping import Int8

from ilmek.arrays import ComplexArray, ComplexField, FloatArray, IntArray
from ilmek.linkage import body_motion
from ilmek.linkage.groups import rrp, rrr, shift
from ilmek.linkage.status import DEAD, TOUCHING, Status
from ilmek.linkage.tape import BODY, CARRY, DRIVE, MARGIN, RRP, RRR, TURN
from ilmek.num import sincos as trigonometry
from ilmek.num.compiled import compiled

BLOCK = 64
"""Samples in a row: all rows of a mechanism fit the first or second cache."""

Statuses: TypeAlias = Int8[np.ndarray, "..."]

OK, CANNOT_CLOSE, DEAD_CENTRE = int(Status.OK), int(Status.CANNOT_CLOSE), int(Status.DEAD_CENTRE)

carried_velocity = compiled(body_motion.carried_velocity)
carried_acceleration = compiled(body_motion.carried_acceleration)
slid_velocity = compiled(shift.slid_velocity)
slid_acceleration = compiled(shift.slid_acceleration)
sincos = compiled(trigonometry.sincos)
rrr_position, rrr_turning, rrr_parting = compiled(rrr.position), compiled(rrr.turning), compiled(rrr.parting)
first_rate, second_rate, misfit = compiled(rrr.first_rate), compiled(rrr.second_rate), compiled(rrr.misfit)
rrp_position, rrp_turning, rrp_parting = compiled(rrp.position), compiled(rrp.turning), compiled(rrp.parting)
link_rate, slider_rate, shortness = compiled(rrp.link_rate), compiled(rrp.slider_rate), compiled(rrp.shortness)


@compiled
def _pair(rows: FloatArray, row: int, i: int) -> complex:
    """Sample i of the complex field in a row and the next."""
    return complex(rows[row * BLOCK + i], rows[(row + 1) * BLOCK + i])


@compiled
def _put(rows: FloatArray, row: int, i: int, value: ComplexField) -> None:
    rows[row * BLOCK + i] = value.real
    rows[(row + 1) * BLOCK + i] = value.imag


@compiled
def _carry(point: FloatArray, body: FloatArray, count: int, local: complex) -> None:
    """Motion of a body's point into six rows."""
    for i in range(count):
        arm, omega, alpha = _pair(body, 6, i) * local, body[8 * BLOCK + i], body[9 * BLOCK + i]
        _put(point, 0, i, _pair(body, 0, i) + arm)
        _put(point, 2, i, carried_velocity(_pair(body, 2, i), arm, omega))
        _put(point, 4, i, carried_acceleration(_pair(body, 4, i), arm, omega, alpha))


@compiled
def _turn(body: FloatArray, carrier: FloatArray, drive: FloatArray, count: int, sign: float) -> None:
    """Direction and rates of a driven body; its anchor stands already."""
    for i in range(count):
        sine, cosine = sincos(sign * drive[i])
        _put(body, 6, i, _pair(carrier, 6, i) * complex(cosine, sine))
        body[8 * BLOCK + i] = carrier[8 * BLOCK + i] + sign * drive[BLOCK + i]
        body[9 * BLOCK + i] = carrier[9 * BLOCK + i] + sign * drive[2 * BLOCK + i]


@compiled
def _rrr(dyad: FloatArray, count: int, a: float, b: float, branch: float, per_a: complex, per_b: complex) -> None:
    """Directions, rates and margin of two links, whose known pins' motions stand already."""
    for i in range(count):
        A, B = _pair(dyad, 0, i), _pair(dyad, 10, i)
        C = rrr_position(A, B, a, b, branch)
        u, v = C - A, C - B
        sine = rrr_turning(u, v)
        r: ComplexField = _pair(dyad, 12, i) - _pair(dyad, 2, i)
        wa, wb = first_rate(v, r, sine), second_rate(u, r, sine)
        r = rrr_parting(_pair(dyad, 4, i), _pair(dyad, 14, i), u, v, wa, wb)
        _put(dyad, 6, i, u * per_a)
        _put(dyad, 16, i, v * per_b)
        dyad[8 * BLOCK + i] = wa
        dyad[18 * BLOCK + i] = wb
        dyad[9 * BLOCK + i] = first_rate(v, r, sine)
        dyad[19 * BLOCK + i] = second_rate(u, r, sine)
        dyad[20 * BLOCK + i] = sine


@compiled
def _rrp(
    dyad: FloatArray, guide: FloatArray, count: int, a: float, branch: float, per_arm: complex, lead: complex
) -> None:
    """Direction and rates of the link, margin, travel and rates of the slider; pin and line's zero stand already."""
    for i in range(count):
        e, w, alpha = _pair(guide, 6, i) * lead, guide[8 * BLOCK + i], guide[9 * BLOCK + i]
        A, Q = _pair(dyad, 0, i), _pair(dyad, 21, i)
        s = rrp_position(A, Q, e, a, branch)
        u = Q + s * e - A
        cosine = rrp_turning(u, e)
        r = _pair(dyad, 23, i) + slid_velocity(e, w, s, 0.0) - _pair(dyad, 2, i)
        wa, ds = link_rate(e, r, cosine), slider_rate(u, r, cosine)
        C2 = _pair(dyad, 25, i) + slid_acceleration(e, w, alpha, s, ds, 0.0)
        r = rrp_parting(_pair(dyad, 4, i), C2, u, wa)
        _put(dyad, 6, i, u * per_arm)
        dyad[8 * BLOCK + i] = wa
        dyad[9 * BLOCK + i] = link_rate(e, r, cosine)
        dyad[20 * BLOCK + i] = cosine
        dyad[27 * BLOCK + i] = s
        dyad[28 * BLOCK + i] = ds
        dyad[29 * BLOCK + i] = slider_rate(u, r, cosine)


@compiled
def _slip(body: FloatArray, guide: FloatArray, travel: FloatArray, count: int, lead: complex, twist: complex) -> None:
    """A slider: its anchor, the line's root as yet, moved along the line; its direction and rates."""
    for i in range(count):
        direction, w, alpha = _pair(guide, 6, i), guide[8 * BLOCK + i], guide[9 * BLOCK + i]
        s, ds, dds, e = travel[i], travel[BLOCK + i], travel[2 * BLOCK + i], direction * lead
        _put(body, 0, i, _pair(body, 0, i) + s * e)
        _put(body, 2, i, _pair(body, 2, i) + slid_velocity(e, w, s, ds))
        _put(body, 4, i, _pair(body, 4, i) + slid_acceleration(e, w, alpha, s, ds, dds))
        _put(body, 6, i, direction * twist)
        body[8 * BLOCK + i] = w
        body[9 * BLOCK + i] = alpha


@compiled
def _doubtful(margin: FloatArray, count: int, least: float) -> int:
    """How many samples are near a dead centre or lost."""
    found = 0
    for i in range(count):
        found += not abs(margin[i]) > least  # true of a NaN
    return found


@compiled
def _judge(dyad: FloatArray, guide: FloatArray, count: int, code: int, numbers: ComplexArray, status: Statuses) -> None:
    """What `status.judge` says of a dyad's samples that were still OK."""
    a, b = numbers[0].real, numbers[1].real
    best, size = (a * b, max(a, b)) if code == RRR else (a, a)
    if _doubtful(dyad[MARGIN * BLOCK :], count, DEAD * best) == 0:
        return
    for i in range(count):
        margin = dyad[MARGIN * BLOCK + i]
        if status[i] != OK or abs(margin) > DEAD * best:
            continue
        A = _pair(dyad, 0, i)
        if code == RRR:
            gap = misfit(A, _pair(dyad, 10, i), a, b)
        else:
            gap = shortness(A, _pair(dyad, 21, i), _pair(guide, 6, i) * numbers[3], a)
        lost = math.isnan(margin) and not abs(gap) <= TOUCHING * size
        status[i] = CANNOT_CLOSE if lost else DEAD_CENTRE


@compiled
def _least(margin: FloatArray, count: int, best: float, least: float) -> float:
    """The least margin, of the best there is, so far."""
    for i in range(count):
        least = min(least, abs(margin[i]) / best)
    return least


@compiled
def _instruction(rows: FloatArray, code: IntArray, numbers: ComplexArray, count: int, status: Statuses) -> None:
    """One instruction of the tape."""
    kind, to, of, also = code[0], rows[code[1] * BLOCK :], rows[code[2] * BLOCK :], rows[code[3] * BLOCK :]
    if kind == CARRY:
        _carry(to, of, count, numbers[0])
    elif kind == TURN:
        _turn(to, of, also, count, numbers[0].real)
    elif kind == RRR:
        _rrr(to, count, numbers[0].real, numbers[1].real, numbers[2].real, numbers[3], numbers[4])
        _judge(to, of, count, RRR, numbers, status)
    elif kind == RRP:
        _rrp(to, of, count, numbers[0].real, numbers[1].real, numbers[2], numbers[3])
        _judge(to, of, count, RRP, numbers, status)
    else:
        _slip(to, of, also, count, numbers[0], numbers[1])


@compiled
def _drive(rows: FloatArray, values: FloatArray, rates: FloatArray, start: int, count: int) -> None:
    """The inputs' rows for the samples from `start` on; rates of one sample hold for all."""
    for k in range(len(values)):
        row = (BODY + DRIVE * k) * BLOCK
        rows[row : row + count] = values[k, start : start + count]
        for order in range(2):
            row += BLOCK
            if rates.shape[2] == 1:
                rows[row : row + count] = rates[k, order, 0]
            else:
                rows[row : row + count] = rates[k, order, start : start + count]


@compiled
def _copy_out(
    rows: FloatArray, pairs: IntArray, singles: IntArray, points: ComplexArray, reals: FloatArray, count: int
) -> None:
    """The rows wanted into the answer's arrays."""
    for k in range(len(pairs)):
        to, row = points[k], rows[pairs[k] * BLOCK : (pairs[k] + 2) * BLOCK]
        for i in range(count):
            to[i] = complex(row[i], row[BLOCK + i])
    for k in range(len(singles)):
        reals[k, :count] = rows[singles[k] * BLOCK : singles[k] * BLOCK + count]


@compiled
def run(
    height: int,
    codes: IntArray,
    numbers: ComplexArray,
    values: FloatArray,
    rates: FloatArray,
    pairs: IntArray,
    singles: IntArray,
    points: ComplexArray,
    reals: FloatArray,
    status: Statuses,
    margin: FloatArray,
) -> None:
    """Every variant and sample through the tape.

    height   rows in all                                codes, numbers  the tape, see `tape.Tape.stack`
    values   (inputs, samples)                          rates   (inputs, 2, samples or 1)
    pairs    rows wanted as complex fields              points  (variants, pairs, samples), written
    singles  rows wanted as real fields                 reals   (variants, singles, samples), written
    status   (variants, samples), written; zero before
    margin   (variants,), the least margin of all dyads, written; infinite before; of no length where not wanted
    """
    rows = np.zeros(height * BLOCK)
    rows[6 * BLOCK : 7 * BLOCK] = 1.0  # the ground's direction
    variants, samples = status.shape
    for v in range(variants):
        for start in range(0, samples, BLOCK):
            end = min(start + BLOCK, samples)
            _drive(rows, values, rates, start, end - start)
            for k in range(len(codes)):
                _instruction(rows, codes[k], numbers[v, k], end - start, status[v, start:end])
                if len(margin) and (codes[k, 0] == RRR or codes[k, 0] == RRP):
                    best = numbers[v, k, 0].real * (numbers[v, k, 1].real if codes[k, 0] == RRR else 1.0)
                    row = (codes[k, 1] + MARGIN) * BLOCK
                    margin[v] = _least(rows[row:], end - start, best, margin[v])
            _copy_out(rows, pairs, singles, points[v, :, start:end], reals[v, :, start:end], end - start)
