"""The motion of a mechanism over the range of its drive, in plain data of six digits."""

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexField, FloatArray
from ilmek.dynamics.inverse_run import InverseRun
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.jobs.mechanism.analysis import HINT
from ilmek.jobs.mechanism.request import DrivenInputs, MotionRequest, driven_inputs
from ilmek.jobs.mechanism.run import MechanismRun, check_groups, run_of
from ilmek.jobs.studio.linkage.answer import (
    DeadCentreAnswer,
    ForceSeries,
    LinkageFault,
    MotionAnswer,
    PoseSeries,
    Rates,
    VectorSeries,
)
from ilmek.jobs.studio.words import in_page
from ilmek.linkage.branches_in_pose import Pose
from ilmek.linkage.closing import closing
from ilmek.linkage.initial_pose import inputs_in_pose
from ilmek.linkage.model import Input, Rotation
from ilmek.linkage.motion import Motion, moving_points
from ilmek.linkage.one_input import OneInput
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan
from ilmek.linkage.transmission import transmission_angles

DIGITS = 6
"""Significant digits of a series, of its greatest value."""

POSE_DIGITS = 8
"""The same of poses: lengths are computed from them while a joint is dragged."""

ANGLE_DECIMALS = 6
"""Decimals of transmission angles [rad]."""


@dataclass(frozen=True, eq=False, slots=True)
class RunOptions:
    """What is required of a motion, as texts with units; see `linkage.MechanismRequest`."""

    fixed: Mapping[str, str]
    over: str
    speed: str
    steps: int
    rates: bool = False
    forces: bool = False


def motion_of(machine: OwnMachine, plan: Plan, options: RunOptions, pose: Pose) -> MotionAnswer | None:
    """The motion of a mechanism; None where nothing is driven.

    pose  as drawn: of several ranges in which a slide closes, the one that contains it is the default
    Raises MechanismError, UnitError for inputs that cannot be read.
    """
    if not plan.mechanism.inputs or not plan.mechanism.moving:
        return None
    run = mechanism_run(machine, plan, options, pose)
    motion, closed = run.motion, run.closed
    why = "" if machine.has_forces or not options.forces else HINT
    running = run.running
    return MotionAnswer(
        running.name if running else "",
        "displacement" if running is not None and not isinstance(running, Rotation) else "rotation",
        run.values.tolist(),
        run.speed,
        motion.status.tolist(),
        _fault(motion),
        {body: _pose_series(motion, body) for body in plan.mechanism.moving},
        _points(motion),
        {
            pin: rounded(angle, decimals=ANGLE_DECIMALS)
            for pin, angle in transmission_angles(motion, machine.transmission).items()
        },
        closed.ranges if closed else (),
        tuple(DeadCentreAnswer(*dead_centre) for dead_centre in closed.dead_centres) if closed else (),
        closed.change_points if closed else (),
        _rates(motion) if options.rates else {},
        _forces(run.forces) if run.forces is not None else None,
        run.left_out or why,
    )


def mechanism_run(machine: OwnMachine, plan: Plan, options: RunOptions, pose: Pose) -> MechanismRun:
    """The motion over the range of the driving input, with inputs and range by default. Raises as `motion_of`."""
    check_groups(plan)
    driven = _driven(machine, plan, options, pose)
    motion = solve(plan, *driven.rates)
    return run_of(machine, plan, motion, driven, over=options.over, forced=options.forces)


def _driven(machine: OwnMachine, plan: Plan, options: RunOptions, pose: Pose) -> DrivenInputs:
    """The inputs' motions: of several without a value all but the first rest at 0; a slide moves where it closes."""
    names = {entry.name for entry in plan.mechanism.inputs}
    given = {name: value for name, value in options.fixed.items() if name in names}
    free = [one for one in plan.mechanism.inputs if one.name not in given and one.name not in machine.motions]
    fixed = given | {entry.name: "0" for entry in free[1:]}
    over = options.over
    if not over and free and not isinstance(free[0], Rotation):
        over = _reach(plan, free[0], fixed, pose)
    return driven_inputs(machine, plan, MotionRequest(fixed, over, options.speed, options.steps))


def _reach(plan: Plan, entry: Input, fixed: Mapping[str, str], pose: Pose) -> str:
    """The range in which a driven slide closes, the one of the pose if there are several; else its whole reach."""
    bodies = plan.mechanism.bodies
    reach = sum(abs(point) for body in bodies for point in body.points.values())
    if set(fixed.values()) <= {"0"}:
        ranges = closing(OneInput(plan, entry.name, dict.fromkeys(fixed, 0.0)), -reach, reach).ranges
        inner = {body: one for body, one in pose.items() if body in plan.mechanism.moving}
        at = inputs_in_pose(dataclasses.replace(plan.mechanism, pose=inner))[entry.name]
        around = [ends for ends in ranges if ends[0] <= at <= ends[1]] or list(ranges)
        if around:
            return f"{around[0][0]!r}m..{around[0][1]!r}m"
    return f"{-reach!r}m..{reach!r}m"


def _fault(motion: Motion) -> LinkageFault | None:
    """Why the mechanism does not close over all of the range."""
    try:
        motion.require()
    except MechanismError as error:
        return LinkageFault(*(in_page(part) for part in (error.given, error.allowed, error.do)))
    return None


def _pose_series(motion: Motion, body: str) -> PoseSeries:
    origin = motion.origin(body)
    return PoseSeries(
        rounded(origin.real, POSE_DIGITS),
        rounded(origin.imag, POSE_DIGITS),
        rounded(motion.angle(body), decimals=POSE_DIGITS),
    )


def _points(motion: Motion) -> dict[str, dict[str, VectorSeries]]:
    points: dict[str, dict[str, VectorSeries]] = {}
    for body, point in moving_points(motion.plan.mechanism):
        points.setdefault(body, {})[point] = vectors(motion.point(body, point).position)
    return points


def _rates(motion: Motion) -> dict[str, dict[str, Rates]]:
    rates: dict[str, dict[str, Rates]] = {}
    for body, point in moving_points(motion.plan.mechanism):
        moved = motion.point(body, point)
        rates.setdefault(body, {})[point] = Rates(vectors(moved.velocity), vectors(moved.acceleration))
    return rates


def _forces(run: InverseRun) -> ForceSeries:
    """The forces over the samples."""
    effort = run.effort if run.effort is not None else np.full(len(run.forces.status), np.nan)
    joints = {name: vectors(force) for name, force in run.forces.reactions.items()}
    return ForceSeries(joints, rounded(effort), vectors(run.shaking.force))


def vectors(values: ComplexField) -> VectorSeries:
    """Vectors over the samples."""
    return VectorSeries(rounded(np.real(values)), rounded(np.imag(values)))


def rounded(values: FloatArray, digits: int = DIGITS, *, decimals: int | None = None) -> list[float | None]:
    """Numbers with so many significant digits of the greatest, as a list; NaN, infinity: null in JSON.

    >>> rounded(np.array([1.23456789, 0.000123456789]))
    [1.23457, 0.00012]
    """
    if decimals is None:
        finite = np.abs(values[np.isfinite(values)])
        greatest = float(finite.max(initial=0.0))
        decimals = digits - 1 - math.floor(math.log10(greatest)) if greatest > 0 else 0
    made: list[float | None] = np.round(values, decimals).tolist()
    return made
