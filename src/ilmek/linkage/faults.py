"""Errors of motions that cannot be solved: the failing range of the input, the gap, and a remedy."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Bool, Float, Int8
from ilmek.errors import MechanismError
from ilmek.linkage.groups.group import InputMotion, Known, Step
from ilmek.linkage.judgement import judge
from ilmek.linkage.model import Input, Rotation
from ilmek.linkage.newton_starts import acting_inputs, branch_over
from ilmek.linkage.solution import local_starts, solved_steps
from ilmek.linkage.status import Status
from ilmek.linkage.structure import Plan
from ilmek.units import deg, mm

SHOWN = 3
"""Number of ranges listed in a message; further ranges are counted."""


def first_fault(plan: Plan, drives: Mapping[str, InputMotion], status: Int8[np.ndarray, " samples"]) -> MechanismError:
    """The error for the first step that fails anywhere: the failing samples are solved once more, step by step."""
    bad = status != Status.OK
    whole = {name: np.atleast_1d(np.asarray(drive.value, dtype=float)) for name, drive in drives.items()}
    moving = _moving(plan, drives)
    drives = {name: drive.part(bad) for name, drive in drives.items()}
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        start = local_starts(plan, drives)
        known, solved = solved_steps(plan, drives, start)
        found, steps = judge(plan, drives, start, known, solved)
        first = min(steps[found != Status.OK])
        found = np.where(steps == first, found, np.int8(Status.OK))
        nowhere = len(found) == len(bad) > 1 and found.all()
        branch = _branch(plan, moving, whole) if found.max() == Status.NOT_CONVERGED else ""
        where = _where(moving, drives, bad, found), "" if nowhere else " or ".join(one.name for one in moving)
        return _error(plan, plan.steps[first], where, known, Status(found.max()), branch)


def _moving(plan: Plan, drives: Mapping[str, InputMotion]) -> tuple[Input, ...]:
    """The inputs whose value varies over the samples; all, if none varies."""
    varied = tuple(entry for entry in plan.mechanism.inputs if np.ptp(np.asarray(drives[entry.name].value)) > 0)
    return varied or plan.mechanism.inputs


def _branch(plan: Plan, moving: tuple[Input, ...], values: Mapping[str, Float[np.ndarray, " samples"]]) -> str:
    """What limits the groups without a closed form, in words."""
    if len(moving) > 1:
        return "Newton's method follows them from the mechanism's pose"
    (entry,) = moving
    branch = branch_over(plan, entry.name, values) if entry.name in acting_inputs(plan) else None
    if branch is None or branch.full:
        return "the mechanism's pose cannot be assembled"
    unit, sign = (deg, "°") if isinstance(entry, Rotation) else (mm, " mm")
    low, high = (f"{end / unit:.3f}{sign}" for end in (branch.start, branch.stop))
    return f"the branch of the mechanism's pose goes from {low} to {high}, between dead centres"


def _error(  # noqa: PLR0917
    plan: Plan, step: Step, failing: tuple[str, str], known: Known, status: Status, branch: str
) -> MechanismError:
    """The error from the failing range, the names of the inputs to limit ("" where no limit helps), and the branch."""
    (where, limit), name, bodies = failing, plan.mechanism.name, " and ".join(step.bodies)
    if status is Status.DEAD_CENTRE:
        return MechanismError(
            f"{name} is at a dead centre for {where}",
            allowed=f"{bodies} are in line there and have no definite velocity",
            do="drive another body or keep away from it",
        )
    if status is Status.NOT_CONVERGED:
        return MechanismError(
            f"{name}: no position of {bodies} found for {where}",
            allowed=branch,
            do="limit the input" if "dead centres" in branch else "give a pose nearer to an assembled one",
        )
    missing, remedy = step.shortfall(known)
    remedy = f"{remedy} or limit the {limit}" if limit else remedy
    return MechanismError(f"{name} cannot close for {where}: {missing}", do=remedy)


def _where(
    moving: tuple[Input, ...],
    drives: Mapping[str, InputMotion],
    bad: Bool[np.ndarray, " samples"],
    found: Int8[np.ndarray, " bad"],
) -> str:
    """The failing samples as ranges of the input, or of sample numbers where several inputs move."""
    samples = np.flatnonzero(bad)[found != Status.OK]
    runs = np.split(np.arange(len(samples)), np.flatnonzero(np.diff(samples) > 1) + 1)
    if len(moving) == 1:
        entry = moving[0]
        value = np.asarray(drives[entry.name].value)[found != Status.OK]
        return f"{entry.name} {_ranges(value, runs, isinstance(entry, Rotation))}"
    first, last = samples[runs[0][0]], samples[runs[0][-1]]
    return f"{len(samples)} of {len(bad)} samples, the first of them {first}..{last}"


def _ranges(value: Float[np.ndarray, " failing"], runs: list[np.ndarray], angle: bool) -> str:
    unit, sign = (deg, "°") if angle else (mm, " mm")
    ranges = []
    for run in runs[:SHOWN]:
        first, last = (f"{value[at] / unit:.1f}{sign}" for at in (run[0], run[-1]))
        ranges.append(first if first == last else f"{first}..{last}")
    return ", ".join(ranges) + (f" and {len(runs) - SHOWN} further ranges" if len(runs) > SHOWN else "")
