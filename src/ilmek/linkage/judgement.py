"""The status of samples from the solutions of a plan's steps.

An error e of the known points of a group is an error e / mu of its position, mu the sine of the transmission angle, and
changes mu itself by e / (mu l), l the shorter link. All rates contain powers of 1/mu: their relative error is

    growth(group) = max growth(parents) * (size / l) / mu^3        of the rounding of a double, times a small number

From step to step this is a bound in one number, and nearly all samples are far below it. The few others, `doubtful`,
are solved again with disturbed numbers (`disturbance`), and the spread decides.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ilmek.arrays import Bool, FloatArray, Int8, IntArray, RealField
from ilmek.linkage.anchors import span
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.disturbance import ROUNDING, RUNS, disturbed_solutions
from ilmek.linkage.groups.group import Columns, GroupSolution, InputMotion, Known, Step
from ilmek.linkage.model import GROUND
from ilmek.linkage.status import Status
from ilmek.linkage.structure import Plan

DOUBT = 1e-6 / ROUNDING
"""Growth of rounding errors above which a sample is solved again: a millionth of an acceleration."""

SPREAD = 8e-3
"""Largest difference of a disturbed acceleration, relative to the largest of its group, of a sample that is OK.

Its error is to be below 1e-2, and may be somewhat greater than the spread of a few runs shows.
"""

PART = 1024
"""Samples examined at once, which take RUNS times their memory."""

CLEAR = 1e4 * ROUNDING
"""Least gap, relative to the size and to the growth of the known bodies' errors, that is not rounding."""


def growths(plan: Plan, margins: Sequence[RealField | None], size: float) -> list[RealField]:
    """Growth of rounding errors up to each step, from the margins relative to their best."""
    bodies: dict[str, RealField] = {GROUND: 1.0}
    growths = []
    for step, margin in zip(plan.steps, margins, strict=True):
        growth: RealField = 1.0
        for parent in step.parents:
            growth = np.maximum(growth, bodies[parent])
        if margin is not None:
            growth = growth * (max(size / step.shortest, 1.0) if step.shortest else 1.0) / (margin * margin * margin)
        bodies |= dict.fromkeys(step.bodies, growth)
        growths.append(growth)
    return growths


def judge(
    plan: Plan,
    drives: Mapping[str, InputMotion],
    start: Mapping[str, BodyMotion],
    known: Known,
    solved: Sequence[GroupSolution],
) -> tuple[Int8[np.ndarray, " samples"], IntArray]:
    """Status of each sample, and the index of the step that fails first; -1 where none does.

    start  start of Newton's method, of the bodies that need one      known, solved  what the steps need and give
    """
    samples = np.shape(next(iter(drives.values())).value)
    status, at = np.zeros(samples, dtype=np.int8), np.full(samples, -1)
    margins = [None if solution.margin is None else np.abs(solution.margin) / solution.best for solution in solved]
    size = span(plan.mechanism)
    least = [None if one is None else np.min(one) for one in margins]  # NaN if any is
    if all(growth <= DOUBT for growth in growths(plan, least, size)):
        return status, at
    doubtful = np.zeros(samples, dtype=bool)
    before: RealField = 1.0
    for k, growth in enumerate(growths(plan, margins, size)):
        step, alive = plan.steps[k], (status == Status.OK) & ~doubtful
        margin = margins[k]
        if margin is not None and alive.any():
            lost = alive & np.isnan(margin)
            if lost.any():
                gap = np.abs(step.gap(known)) <= CLEAR * max(size, step.size) * _finite(before)
                _set(status, at, lost & ~gap, Status[step.failure], k)
                doubtful |= lost & gap
            doubtful |= alive & (growth > DOUBT)
        before = np.fmax(before, growth)
    places = np.flatnonzero(doubtful)
    for first in range(0, len(places), PART):
        part = places[first : first + PART]
        parts = [_part_of(solution, part) for solution in solved]
        repeated = np.tile(part, RUNS)
        begun = {body: _body_part(motion, repeated) for body, motion in start.items()}
        inputs = {name: drive.part(repeated) for name, drive in drives.items()}
        status[part], at[part] = _examined(plan, parts, disturbed_solutions(plan, inputs, begun, len(part)), len(part))
    return status, at


def _examined(
    plan: Plan, solved: Sequence[GroupSolution], disturbed: Sequence[GroupSolution], samples: int
) -> tuple[Int8[np.ndarray, " samples"], IntArray]:
    """As `judge`, every sample from the spread of the disturbed solutions."""
    status, at = np.zeros(samples, dtype=np.int8), np.full(samples, -1)
    runs = RUNS, samples
    for k, step in enumerate(plan.steps):
        margin = solved[k].margin
        if margin is None:
            continue
        lost = np.broadcast_to(np.isnan(margin), samples)
        met = np.isfinite(_by_run(np.asarray(disturbed[k].margin, dtype=float), runs)).any(axis=0)
        good = np.ones(samples, dtype=bool)
        pairs = zip(_accelerations(step, solved[k].columns), _accelerations(step, disturbed[k].columns), strict=True)
        for (exact, scale), (shaken, _) in pairs:
            for ours, theirs in zip(exact, shaken, strict=True):
                good &= (np.abs(ours - _by_run(theirs, runs)) <= SPREAD * scale).all(axis=0)  # False with a NaN
        alive = status == Status.OK
        _set(status, at, alive & lost & ~met, Status[step.failure], k)
        _set(status, at, alive & ((lost & met) | (~lost & ~good)), Status.DEAD_CENTRE, k)
    return status, at


def _accelerations(step: Step, columns: Mapping[str, Columns]) -> list[tuple[list[RealField], RealField]]:
    """Accelerations [m/s^2] of a step's bodies and the largest: of turning and sliding, then of anchors, if any."""
    moved: list[RealField] = []
    anchors: list[RealField] = []
    scale: RealField = 0.0
    for body, length in zip(step.bodies, step.lengths, strict=True):
        first, rate, second, *anchor = columns[body]
        turns = np.iscomplexobj(first)
        moved.append(second * length if turns else second)
        scale = np.maximum(scale, (np.abs(second) + rate * rate) * length if turns else np.abs(second))
        anchors += [np.real(anchor[2]), np.imag(anchor[2])] if anchor else []
    largest: RealField = 0.0
    for one in anchors:
        largest = np.maximum(largest, np.abs(one))
    return [(moved, scale), (anchors, largest)]


def _by_run(field: RealField, runs: tuple[int, int]) -> FloatArray:
    """A disturbed field as an array of runs and samples."""
    return np.broadcast_to(field, runs[0] * runs[1]).reshape(runs)


def _set(status: np.ndarray, at: np.ndarray, which: Bool[np.ndarray, " samples"], new: Status, step: int) -> None:
    status[which], at[which] = new, step


def _finite(growth: RealField) -> RealField:
    return np.where(np.isfinite(growth), growth, 0.0)


def _part_of(solved: GroupSolution, which: IntArray) -> GroupSolution:
    columns = {body: tuple(_part(field, which) for field in fields) for body, fields in solved.columns.items()}
    return GroupSolution(columns, None if solved.margin is None else _part(solved.margin, which), solved.best)


def _body_part(body: BodyMotion, which: IntArray) -> BodyMotion:
    anchor = PointMotion(*(_part(getattr(body.anchor, one), which) for one in ("position", "velocity", "acceleration")))
    return BodyMotion(anchor, body.at, *(_part(getattr(body, one), which) for one in ("direction", "omega", "alpha")))


def _part(field: object, which: IntArray) -> Any:
    """Samples of a real or complex field; a constant is the same in all."""
    return field[which] if isinstance(field, np.ndarray) and field.ndim else field
