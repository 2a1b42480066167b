"""The real four-bars among the complex solutions of a task."""

from collections import Counter

import numpy as np

from ilmek.arrays import Bool, Complex, Int
from ilmek.records import record
from ilmek.synthesis.alt_burmester.certificate import unit_length
from ilmek.synthesis.alt_burmester.homotopy import SolvedTask, Tracked, repeated, rotations_of, track
from ilmek.synthesis.alt_burmester.task import PosesAndPoints

REAL = 1e-7
"""Greatest difference of primed quantities and conjugates, relative to the unknowns, of a solution that may be real."""

SHORT = 1e-7
"""Length of a link, relative to the longest, below which the four-bar is degenerate."""

COMPLEX, UNFINISHED, DEGENERATE = "complex", "path not finished", "degenerate"
"""Reasons for which solutions are left out."""

PLAIN = [0, 2, 4, 6]
"""Unknowns A, x, B, y."""


@record
class RealSolutions:
    """Real four-bars of a task.

    pins      A, x, B, y relative to the tracer at the reference, in the `unit_length` of the task
    turns     T at the other positions      family  number of the coupler curve: cognates have one
    left_out  solutions left out, by reason: of nine points classes of three cognates
    """

    pins: Complex[np.ndarray, "four_bars 4"]
    turns: Complex[np.ndarray, "four_bars others"]
    family: Int[np.ndarray, " four_bars"]
    left_out: dict[str, int]


def real_solutions(task: PosesAndPoints, found: Tracked) -> RealSolutions:
    """The real four-bars of the ends of all paths, of nine points with their cognates."""
    left_out: Counter[str] = Counter()
    alone = found.good & ~repeated(found.distinct_keys)
    left_out[UNFINISHED] = int(np.sum(~alone))
    u = found.solved.unknowns
    apart = np.abs(u[:, 1::2] - u[:, ::2].conj()).max(axis=1, initial=0.0)
    real = alone & (apart <= REAL * (1 + np.abs(u).max(axis=1)))
    left_out[COMPLEX] = int(np.sum(alone & ~real))
    pins = u[real][:, PLAIN]
    proper = np.all([_proper(variant) for variant in _variants(pins, found.solved.nine_points)], axis=0)
    left_out[DEGENERATE] = int(np.sum(~proper))
    variants = _variants(pins[proper], found.solved.nine_points)
    family = np.tile(np.arange(int(np.sum(proper))), len(variants))
    pins, turns, good = _refined(np.concatenate(variants), found.solved)
    left_out[UNFINISHED] += len(set(family[~good].tolist()))
    scale = task.size / unit_length(task)
    return RealSolutions(scale * pins[good], turns[good], family[good], dict(+left_out))


def _variants(pins: Complex[np.ndarray, "curves 4"], nine_points: bool) -> list[Complex[np.ndarray, "curves 4"]]:
    """The four-bars themselves and of nine points their cognates: see `cognates`; the tracer is at 0."""
    if not nine_points:
        return [pins]
    A, x, B, y = pins.T
    with np.errstate(divide="ignore", invalid="ignore"):
        z = -x / (y - x)
        C = A + z * (B - A)
        timed = np.stack([C, C + (1 - z) * (x - A), B, B - y], axis=1)
        other = np.stack([A, A - x, C, C + z * (y - B)], axis=1)
    return [pins, timed, other]


def _proper(pins: Complex[np.ndarray, "curves 4"]) -> Bool[np.ndarray, " curves"]:
    """Whether no link, and no ground link, has lost its length."""
    A, x, B, y = pins.T
    lengths = np.abs([x - A, y - B, y - x, B - A])
    with np.errstate(invalid="ignore"):
        return np.asarray(lengths.min(axis=0) > SHORT * lengths.max(axis=0))


def _refined(
    pins: Complex[np.ndarray, "four_bars 4"], solved: SolvedTask
) -> tuple[Complex[np.ndarray, "four_bars 4"], Complex[np.ndarray, "four_bars others"], Bool[np.ndarray, " four_bars"]]:
    """Pins and rotations after Newton's method from real numbers, which remain real; whether it converges."""
    unknowns = np.empty((len(pins), 8), dtype=complex)
    unknowns[:, ::2], unknowns[:, 1::2] = pins, pins.conj()
    begin = SolvedTask(solved.pose, solved.task, unknowns, rotations_of(unknowns, solved.task, solved.pose))
    found = track(begin, solved.task)
    refined = found.solved.unknowns[:, ::2]
    near = np.abs(refined - pins).max(axis=1, initial=0.0) <= 10 * REAL * (1 + np.abs(pins).max(axis=1, initial=0.0))
    return refined, found.solved.rotations / np.abs(found.solved.rotations), found.good & near
