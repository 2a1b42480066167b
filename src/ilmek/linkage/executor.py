# ruff: noqa: PLR0917 - compiled functions take their arguments by position
"""The compiled executor: a tape's instructions in order, block by block, variant by variant.

It is put together from the instructions of the groups: `choice` makes one kernel of many, which the compiler inlines.
"""

import functools
import math
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, Int8, IntArray
from ilmek.linkage.judgement import CLEAR, DOUBT
from ilmek.linkage.kernels import BLOCK, BODY, DIRECTION, DRIVE, MARGIN, Instruction, pair
from ilmek.linkage.status import Status
from ilmek.num.compiled import compiled, inlined

Statuses: TypeAlias = Int8[np.ndarray, "..."]

OK, CANNOT_CLOSE = int(Status.OK), int(Status.CANNOT_CLOSE)

DOUBTFUL = -1
"""Mark of a sample near a limit, whose status `judgement` decides."""

MAGNITUDE, INFINITE = np.int64(0x7FFFFFFFFFFFFFFF), np.int64(0x7FF0000000000000)
"""Bits of a double without its sign, and those of infinity."""


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
    smallest = np.int64(least)
    return math.nan if most > INFINITE else smallest.view(np.float64)


@compiled
def _least(margin: FloatArray, count: int, best: float, least: float) -> float:
    """Running minimum of the margin relative to the best."""
    for i in range(count):
        least = min(least, abs(margin[i]) / best)
    return least


@compiled
def _growth(scale: tuple[float, float], margin: float, size: float) -> float:
    """Factor by which a dyad increases rounding errors; see `judgement.growths`."""
    best, shortest = scale
    part = margin / best
    growth = (max(size / shortest, 1.0) if shortest > 0 else 1.0) / abs(part * part * part)
    return 1.0 if growth < 1.0 else growth  # NaN where the margin is


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
def _prepared(height: int, rates: FloatArray) -> FloatArray:
    """The rows at the start: those of the ground, and the inputs' rates where they are constant."""
    rows = np.zeros(height * BLOCK)
    rows[DIRECTION * BLOCK : (DIRECTION + 1) * BLOCK] = 1.0  # the ground's
    if rates.shape[2] == 1:
        for k in range(len(rates)):
            for order in range(2):
                row = (BODY + DRIVE * k + order + 1) * BLOCK
                rows[row : row + BLOCK] = rates[k, order, 0]
    return rows


def _choice(kernels: Sequence[Callable[..., Any] | None]) -> Any:
    """One kernel of many: its first argument is the index of the one that gets the others. None is never called."""
    present = [(index, kernel) for index, kernel in enumerate(kernels) if kernel is not None]
    chosen = _last(present.pop()[1])
    for index, kernel in reversed(present):
        chosen = _either(index, kernel, chosen)
    return chosen


def _last(kernel: Callable[..., Any]) -> Any:
    @inlined
    def last(_: int, *arguments: Any) -> Any:
        return kernel(*arguments)

    return last


def _either(own: int, kernel: Callable[..., Any], others: Callable[..., Any]) -> Any:
    @inlined
    def either(index: int, *arguments: Any) -> Any:
        if index == own:
            return kernel(*arguments)
        return others(index, *arguments)

    return either


def _sample_by_sample(growth_of: Any, gap_of: Any) -> Any:
    """The kernel that judges the samples of one dyad."""

    @compiled
    def mark(
        code: IntArray,
        rows: FloatArray,
        count: int,
        numbers: ComplexArray,
        size: float,
        growth: FloatArray,
        status: Statuses,
    ) -> None:
        """The samples of a dyad; `growth` of the rounding errors through all dyads so far is written."""
        dyad, guide = rows[code[1] * BLOCK :], rows[code[2] * BLOCK :]
        for i in range(count):
            if status[i] != OK:
                continue
            margin = dyad[MARGIN * BLOCK + i]
            if not math.isnan(margin):
                growth[i] *= growth_of(code[0], numbers, margin, size)
                if not growth[i] <= DOUBT:
                    status[i] = DOUBTFUL
            elif abs(gap_of(code[0], dyad, guide, numbers, i)) <= 4 * CLEAR * size * growth[i]:
                status[i] = DOUBTFUL
            else:
                status[i] = CANNOT_CLOSE

    return mark


def _judging(growth_of: Any, mark: Any) -> Any:
    """The kernel that marks the samples of a block that do not close, or that `judgement` must decide."""

    @compiled
    def judge(
        codes: IntArray, rows: FloatArray, count: int, numbers: ComplexArray, size: float, status: Statuses
    ) -> None:
        """First by the smallest margin of each dyad, then, if that does not do, sample by sample."""
        growth = 1.0
        for k in range(len(codes)):
            if codes[k, 4]:
                margin = _smallest(rows[(codes[k, 1] + MARGIN) * BLOCK :], count)
                growth *= growth_of(codes[k, 0], numbers[k], margin, size)
        if growth <= DOUBT:
            return
        growths = np.ones(BLOCK)
        for k in range(len(codes)):
            if codes[k, 4]:
                mark(codes[k], rows, count, numbers[k], size, growths, status)

    return judge


@functools.cache
def executor(instructions: tuple[Instruction, ...]) -> Any:
    """The kernel that runs a tape of these instructions: every variant and sample.

    Its arguments:
    height   rows in all                                still, codes, numbers  the tape, see `tape.Tape.stack`
    sizes    (variants,), the mechanisms' sizes [m]     values  (inputs, samples)
    rates    (inputs, 2, samples or 1)
    pairs    rows requested as complex fields           singles  rows requested as real fields
    points   (variants, pairs, samples), written        reals    (variants, singles, samples), written
    status   (variants, samples), written; zero before. DOUBTFUL: `judgement` must decide
    margin   (variants,), the least margin of all dyads, written; infinite before; empty if not requested
    """
    write = _choice([instruction.kernel for instruction in instructions])
    scale_of, gap_of = (
        _choice([instruction.scale for instruction in instructions]),
        _choice([instruction.gap for instruction in instructions]),
    )

    @inlined
    def growth_of(index: int, numbers: ComplexArray, margin: float, size: float) -> float:
        return _growth(scale_of(index, numbers), margin, size)

    @inlined
    def instruct(rows: FloatArray, code: IntArray, count: int, numbers: ComplexArray) -> None:
        write(code[0], rows[code[1] * BLOCK :], rows[code[2] * BLOCK :], rows[code[3] * BLOCK :], count, numbers)

    @compiled
    def block(
        rows: FloatArray, still: int, codes: IntArray, count: int, numbers: ComplexArray, least: float, judged: bool
    ) -> float:
        """The lines that differ from sample to sample; the least margin so far."""
        for k in range(still, len(codes)):
            instruct(rows, codes[k], count, numbers[k])
            if judged and codes[k, 4]:
                best, _ = scale_of(codes[k, 0], numbers[k])
                least = _least(rows[(codes[k, 1] + MARGIN) * BLOCK :], count, best, least)
        return least

    return _running(instruct, block, _judging(growth_of, _sample_by_sample(growth_of, gap_of)))


def _running(instruct: Any, block: Any, judge: Any) -> Any:
    """The kernel of `executor`."""

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
        rows = _prepared(height, rates)
        variants, samples = status.shape
        judged = len(margin) > 0
        for v in range(variants):
            for k in range(still):
                instruct(rows, codes[k], BLOCK, numbers[v, k])
            least = math.inf
            for start in range(0, samples, BLOCK):
                end = min(start + BLOCK, samples)
                count = end - start
                _drive(rows, values, rates, start, count)
                least = block(rows, still, codes, count, numbers[v], least, judged)
                judge(codes, rows, count, numbers[v], sizes[v], status[v, start:end])
                _copy_out(rows, pairs, singles, points[v], reals[v], start, count)
            if judged:
                margin[v] = least

    return run
