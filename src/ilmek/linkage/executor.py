# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""The compiled executor: a tape's instructions in order, block by block, variant by variant."""

import math
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, Int8, IntArray
from ilmek.linkage.groups import rpr as rpr_group
from ilmek.linkage.groups import rrp as rrp_group
from ilmek.linkage.groups import rrr as rrr_group
from ilmek.linkage.judgement import CLEAR, DOUBT
from ilmek.linkage.kernels import BLOCK, carry, pair, prp, rpp, rpr, rrp, rrr, slip, turn
from ilmek.linkage.status import Status
from ilmek.linkage.tape import BODY, CARRY, DIRECTION, DRIVE, MARGIN, PRP, RPP, RPR, RRP, RRR, SECOND, SLIP, TURN, ZERO
from ilmek.num.compiled import compiled

Statuses: TypeAlias = Int8[np.ndarray, "..."]

OK, CANNOT_CLOSE = int(Status.OK), int(Status.CANNOT_CLOSE)

DOUBTFUL = -1
"""Mark of a sample near a limit, whose status `judgement` decides."""

MAGNITUDE, INFINITE = np.int64(0x7FFFFFFFFFFFFFFF), np.int64(0x7FF0000000000000)
"""Bits of a double without its sign, and those of infinity."""

misfit, too_short, too_near = compiled(rrr_group.misfit), compiled(rrp_group.shortness), compiled(rpr_group.shortness)


@compiled
def _best(code: int, numbers: ComplexArray) -> tuple[float, float]:
    """Greatest possible margin and shortest length of a dyad, equal to those of its step; 0 for none."""
    a, b = numbers[0].real, numbers[1].real
    if code == RRR:
        return a * b, min(a, b)
    if code == RRP:
        return a, a
    if code == RPR:
        return numbers[4].real, numbers[4].real
    return 1.0, 0.0


@compiled
def _gap(code: int, dyad: FloatArray, guide: FloatArray, numbers: ComplexArray, i: int) -> float:
    """Gap [m] of a dyad without a real margin in sample i; NaN for lines that do not cross."""
    A, a, b = pair(dyad, i), numbers[0].real, numbers[1].real
    if code == RRR:
        return float(misfit(A, pair(dyad, SECOND * BLOCK + i), a, b))
    if code == RRP:
        return float(too_short(A, pair(dyad, ZERO * BLOCK + i), pair(guide, DIRECTION * BLOCK + i) * numbers[3], a))
    if code == RPR:
        return float(too_near(pair(dyad, SECOND * BLOCK + i) - A, a))
    return math.nan


@compiled
def _growth(code: int, numbers: ComplexArray, margin: float, size: float) -> float:
    """Factor by which a dyad increases rounding errors; see `judgement.growths`."""
    best, shortest = _best(code, numbers)
    part = margin / best
    growth = (max(size / shortest, 1.0) if shortest > 0 else 1.0) / abs(part * part * part)
    return 1.0 if growth < 1.0 else growth  # NaN where the margin is


@compiled
def _smallest(margin: FloatArray, count: int) -> float:
    """Smallest magnitude; NaN if there is one.

    By the bits without the sign, whose order as integers is that of the numbers, NaN above infinity: a minimum of
    integers is computed for several samples at once, one of numbers in order is not.
    """
    bits = margin.view(np.int64)
    least, most = MAGNITUDE, np.int64(0)
    for i in range(min(count, BLOCK)):
        magnitude = bits[i] & MAGNITUDE
        least, most = min(least, magnitude), max(most, magnitude)
    found = np.int64(least)
    return math.nan if most > INFINITE else found.view(np.float64)


@compiled
def _judge(
    code: IntArray,
    rows: FloatArray,
    count: int,
    numbers: ComplexArray,
    size: float,
    growth: FloatArray,
    status: Statuses,
) -> None:
    """Mark a dyad's samples that do not close, and those that `judgement` must decide.

    growth  of the rounding errors in the samples through all dyads so far, written
    """
    kind, dyad, guide = code[0], rows[code[1] * BLOCK :], rows[code[2] * BLOCK :]
    for i in range(count):
        if status[i] != OK:
            continue
        margin = dyad[MARGIN * BLOCK + i]
        if not math.isnan(margin):
            growth[i] *= _growth(kind, numbers, margin, size)
            if not growth[i] <= DOUBT:
                status[i] = DOUBTFUL
        elif abs(_gap(kind, dyad, guide, numbers, i)) <= 4 * CLEAR * size * growth[i]:
            status[i] = DOUBTFUL
        else:
            status[i] = CANNOT_CLOSE


@compiled
def _judge_all(
    codes: IntArray, rows: FloatArray, count: int, numbers: ComplexArray, size: float, status: Statuses
) -> None:
    """Mark the samples of a block: first by the smallest margin of each dyad, then, if that does not do, one by one."""
    growth = 1.0
    for k in range(len(codes)):
        if _can_fail(codes[k, 0]):
            growth *= _growth(codes[k, 0], numbers[k], _smallest(rows[(codes[k, 1] + MARGIN) * BLOCK :], count), size)
    if growth <= DOUBT:
        return
    growths = np.ones(BLOCK)
    for k in range(len(codes)):
        if _can_fail(codes[k, 0]):
            _judge(codes[k], rows, count, numbers[k], size, growths, status)


@compiled
def _least(margin: FloatArray, count: int, best: float, least: float) -> float:
    """Running minimum of the margin relative to the best."""
    for i in range(count):
        least = min(least, abs(margin[i]) / best)
    return least


@compiled
def _instruction(rows: FloatArray, code: IntArray, numbers: ComplexArray, count: int) -> None:
    """One instruction of the tape."""
    kind, to, of, also = code[0], rows[code[1] * BLOCK :], rows[code[2] * BLOCK :], rows[code[3] * BLOCK :]
    if kind == CARRY:
        carry(to, of, count, numbers[0])
    elif kind == TURN:
        turn(to, of, also, count, numbers[0].real)
    elif kind == SLIP:
        slip(to, of, also, count, numbers[0], numbers[1])
    elif kind == RRR:
        rrr(to, count, numbers[0].real, numbers[1].real, numbers[2].real, numbers[3], numbers[4])
    elif kind == RRP:
        rrp(to, of, count, numbers[0].real, numbers[1].real, numbers[2], numbers[3])
    elif kind == RPR:
        rpr(to, count, numbers[0].real, numbers[1].real, numbers[2], numbers[3])
    elif kind == PRP:
        prp(to, of, also, count, numbers[0], numbers[1])
    elif kind == RPP:
        rpp(to, of, count, numbers[0], numbers[1], numbers[2])


@compiled
def _can_fail(kind: int) -> bool:
    """Whether an instruction is a dyad with a margin."""
    return kind == RRR or kind == RRP or kind == RPR or kind == PRP  # noqa: PLR1714 - for the compiler


@compiled
def _drive(rows: FloatArray, values: FloatArray, rates: FloatArray, start: int, count: int) -> None:
    """The inputs' rows for the samples from `start` on; rates of one sample are already written."""
    for k in range(len(values)):
        row = (BODY + DRIVE * k) * BLOCK
        rows[row : row + count] = values[k, start : start + count]
        if rates.shape[2] > 1:
            for order in range(2):
                row += BLOCK
                rows[row : row + count] = rates[k, order, start : start + count]


@compiled
def _copy_out(
    rows: FloatArray,
    pairs: IntArray,
    singles: IntArray,
    points: ComplexArray,
    reals: FloatArray,
    start: int,
    count: int,
) -> None:
    """Copy the requested rows to the result arrays, from sample `start` on."""
    for k in range(len(pairs)):
        to, row = points[k, start : start + count], rows[pairs[k] * BLOCK :]
        for i in range(min(count, BLOCK)):
            to[i] = pair(row, i)
    for k in range(len(singles)):
        real, row = reals[k, start : start + count], rows[singles[k] * BLOCK :]
        for i in range(min(count, BLOCK)):
            real[i] = row[i]


@compiled
def run(
    height: int,
    still: int,
    codes: IntArray,
    numbers: ComplexArray,
    sizes: FloatArray,
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

    height   rows in all                                still, codes, numbers  the tape, see `tape.Tape.stack`
    values   (inputs, samples)                          rates   (inputs, 2, samples or 1)
    pairs    rows requested as complex fields           points  (variants, pairs, samples), written
    singles  rows requested as real fields              reals   (variants, singles, samples), written
    sizes    (variants,), the mechanisms' sizes [m]
    status   (variants, samples), written; zero before. DOUBTFUL: `judgement` must decide
    margin   (variants,), the least margin of all dyads, written; infinite before; empty if not requested
    """
    rows = np.zeros(height * BLOCK)
    rows[DIRECTION * BLOCK : (DIRECTION + 1) * BLOCK] = 1.0  # the ground's
    if rates.shape[2] == 1:
        for k in range(len(rates)):
            for order in range(2):
                row = (BODY + DRIVE * k + order + 1) * BLOCK
                rows[row : row + BLOCK] = rates[k, order, 0]
    variants, samples = status.shape
    for v in range(variants):
        for k in range(still):
            _instruction(rows, codes[k], numbers[v, k], BLOCK)
        for start in range(0, samples, BLOCK):
            end = min(start + BLOCK, samples)
            _drive(rows, values, rates, start, end - start)
            for k in range(still, len(codes)):
                _instruction(rows, codes[k], numbers[v, k], end - start)
                if len(margin) and _can_fail(codes[k, 0]):
                    best, _ = _best(codes[k, 0], numbers[v, k])
                    row = (codes[k, 1] + MARGIN) * BLOCK
                    margin[v] = _least(rows[row:], end - start, best, margin[v])
            _judge_all(codes, rows, end - start, numbers[v], sizes[v], status[v, start:end])
            _copy_out(rows, pairs, singles, points[v], reals[v], start, end - start)
