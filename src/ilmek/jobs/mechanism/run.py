"""The motion of a mechanism of a file over a range of one input."""

from dataclasses import replace

import numpy as np

from ilmek.arguments import Arguments
from ilmek.arrays import FloatArray, RealField
from ilmek.dynamics.inverse_run import InverseRun, inverse_run
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile
from ilmek.io.table_csv import check_size
from ilmek.jobs.mechanism.request import DrivenInputs, MotionRequest, driven_inputs
from ilmek.linkage.closing import Closing, closing, closing_words
from ilmek.linkage.groups.general import GeneralGroup
from ilmek.linkage.model import Input, Rotation
from ilmek.linkage.motion import Motion, moving_points
from ilmek.linkage.one_input import OneInput
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import Plan
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.units import format_quantity

MOST_RANGES = 100
"""Largest number of ranges in which a mechanism closes; the ends of each are located."""


SAME = 1e-6
"""Distance of two values of the driving input, relative to its range, that are one dead centre."""

MOST_BODIES = 20
"""Largest number of bodies of a group that is solved by Newton's method: its equations are solved for every sample."""


@record
class MechanismRun:
    """A mechanism in motion, with its forces.

    running  the driving input; None if all inputs are fixed: one pose
    values   of the driving input [rad or m]
    speed    constant speed of the driving input [rad/s or m/s]; None: it follows its motion of the file
    time     of the samples [s]; None: nothing moves
    forces   None: without masses, loads and friction, or as `left_out` states
    assumed  whether the speed is neither that of the call nor of the file
    fluctuation  of the speed for which a flywheel is sized [1]; None: no balance is wanted
    required  whether the range is: given by the call, or that of a speed or motion of call or file
    """

    machine: OwnMachine
    plan: Plan
    motion: Motion
    running: Input | None
    values: FloatArray
    speed: float | None
    time: FloatArray | None = None
    forces: InverseRun | None = None
    left_out: str = ""
    assumed: bool = False
    required: bool = False
    fluctuation: float | None = None

    @property
    def name(self) -> str:
        """Name of the mechanism."""
        return self.plan.mechanism.name

    @property
    def unit(self) -> str:
        """Unit in which the driving input is shown."""
        return "mm" if self.running is not None and not isinstance(self.running, Rotation) else "deg"

    def shown(self, value: float) -> str:
        """A value of the driving input in its unit."""
        return format_quantity(float(value), self.unit)

    @property
    def by_time(self) -> bool:
        """Whether curves are drawn over time, because the driving input follows a law."""
        return self.running is not None and self.speed is None

    @property
    def abscissa(self) -> FloatArray:
        """What curves are drawn over: the driving input [rad; m], or the time [s]."""
        return self.time if self.by_time and self.time is not None else self.values

    def at(self, values: FloatArray) -> dict[str, RealField]:
        """Values of all inputs for these values of the driving input [rad or m]."""
        fixed = {name: float(np.ravel(drive.value)[0]) for name, drive in self.motion.drives.items()}
        return {**fixed, **({self.running.name: values} if self.running else {})}

    @property
    def others_rest(self) -> bool:
        """Whether all inputs but the driving one are fixed."""
        drives = self.motion.drives.items()
        return all(np.ptp(drive.value) == 0 for name, drive in drives if not self.running or name != self.running.name)

    def at_speed(self, speed: float) -> InverseRun:
        """The forces over the same values at another constant speed of the driving input [rad/s; m/s]."""
        assert self.running is not None
        motion = solve(self.plan, self.at(self.values), {self.running.name: speed})
        time = None if speed == 0 else (self.values - self.values[0]) / speed
        return inverse_run(self.machine, motion, self.running.name, time)

    @property
    def closed(self) -> Closing | None:
        """Where the mechanism closes over the range of the driving input; None if none or several inputs move."""
        if self.running is None or not self.others_rest:
            return None
        held = {name: float(value) for name, value in self.at(self.values).items() if name != self.running.name}
        moved = OneInput(self.plan, self.running.name, held)
        return closing(moved, float(np.min(self.values)), float(np.max(self.values)))

    @property
    def closing(self) -> tuple[tuple[float, float], ...]:
        """Ranges of the driving input in which the mechanism closes [rad or m]; their ends are exact to rounding.

        In the direction of the motion. Where several inputs move: from the first to the last sample that closes.
        """
        found = self.closed
        if found is None:
            ends = self.samples_that_close if self.running is not None else []
            return tuple((float(self.values[first]), float(self.values[last])) for first, last in ends)
        forwards = self.values[-1] >= self.values[0]
        return found.ranges if forwards else tuple((stop, start) for start, stop in reversed(found.ranges))

    @property
    def closed_share(self) -> float:
        """Share of the range of the driving input in which the mechanism closes [1]; of a pose 1."""
        whole = float(np.ptp(self.values))
        if self.running is None or not whole:
            return 1.0
        if self.closed is None:
            return float(np.mean(self.motion.status == Status.OK))
        return min(sum(abs(stop - start) for start, stop in self.closing) / whole, 1.0)

    @property
    def undefined(self) -> tuple[float, ...]:
        """Values of the driving input [rad; m] at which links are in line, so that velocities and forces do not exist.

        Those where two assemblies meet, and samples at a dead centre. An end of a range in which the mechanism closes
        counts only if the whole range is required.
        """
        closed = self.closed
        ends = [value for value, _ in closed.dead_centres] if closed is not None and not self.required else []
        samples = [float(value) for value in self.values[self.motion.status == Status.DEAD_CENTRE]]
        values = [*closed.change_points, *samples] if closed is not None else samples
        near = SAME * float(np.ptp(self.values))
        kept: list[float] = []
        for value in sorted(values):
            if all(abs(value - other) > near for other in (*ends, *kept[-1:])):
                kept.append(value)
        return tuple(kept)

    @property
    def samples_that_close(self) -> list[tuple[int, int]]:
        """First and last sample of each run of samples that close."""
        good = np.flatnonzero(self.motion.status == Status.OK)
        runs = np.split(good, np.flatnonzero(np.diff(good) > 1) + 1) if len(good) else []
        return [(int(run[0]), int(run[-1])) for run in runs]


def run(file: MechanismFile, request: MotionRequest, progress: Progress = SILENT) -> MechanismRun:
    """The motion of the mechanism of a file, and its forces where the file has masses, loads or friction.

    Raises MechanismError if the mechanism cannot be solved, if the request names an unknown input or leaves two inputs
    to drive, if the mechanism closes nowhere or in more than `MOST_RANGES` ranges, and if its motion has more than
    `MOST_NUMBERS` numbers or a group more than `MOST_BODIES` bodies; UnitError for a value that cannot be read;
    Cancelled.
    """
    machine, plan = file.machine, file.plan()
    check_groups(plan)
    driven = driven_inputs(machine, plan, request)
    check_size(len(driven.values), _columns(machine), "--steps", MechanismError)
    motion = solve(plan, *driven.rates, progress=progress.part(0.0, 1.0, "motion"))
    if (motion.status != Status.OK).all():
        raise _closes_elsewhere(plan, motion, driven)
    run = run_of(machine, plan, motion, driven, over=request.over)
    _check_ranges(run)
    if request.fluctuation == "":
        return run
    fluctuation = Arguments("a balance", MechanismError).number("fluctuation", request.fluctuation, "1")
    return replace(run, fluctuation=fluctuation)


def run_of(
    machine: OwnMachine, plan: Plan, motion: Motion, driven: DrivenInputs, *, over: object, forced: bool = True
) -> MechanismRun:
    """A motion with its forces; over: the range that the call gives, if any; forced: whether forces are wanted."""
    forces, left_out = _forces_or_reason(machine, motion, driven) if forced else (None, "")
    return MechanismRun(
        machine,
        plan,
        motion,
        driven.running,
        driven.values,
        driven.speed,
        driven.time,
        forces,
        left_out,
        driven.assumed,
        required=bool(over) or not driven.assumed,
    )


def _forces_or_reason(machine: OwnMachine, motion: Motion, driven: DrivenInputs) -> tuple[InverseRun | None, str]:
    """The forces of a motion; or None and why there are none, "" for a machine without masses, loads and friction."""
    if not machine.has_forces:
        return None, ""
    try:
        name = driven.running.name if driven.running else None
        return inverse_run(machine, motion, name, driven.time), ""
    except MechanismError as error:
        return None, f"forces are left out: {error}"


def _closes_elsewhere(plan: Plan, motion: Motion, driven: DrivenInputs) -> MechanismError:
    """The error of a motion without a sample that closes, with the ranges of the input in which it closes."""
    try:
        motion.require()
    except MechanismError as error:
        if Status.NOT_CONVERGED in motion.status:  # the error names the branch of the pose
            return error
        inputs = plan.mechanism.inputs
        entry = driven.running or inputs[0]
        others = {one.name: np.ravel(motion.drives[one.name].value) for one in inputs if one is not entry}
        if (others and driven.running is None) or any(np.ptp(value) > 0 for value in others.values()):
            return error
        moved = OneInput(plan, entry.name, {name: float(value[0]) for name, value in others.items()})
        where = closing_words(moved)
        where = f"it closes for {entry.name} {where}" if where else f"it closes for no value of {entry.name}"
        return MechanismError(error.given, allowed=error.allowed, do=f"{error.do}; {where}" if error.do else where)
    raise AssertionError("no sample closes")


def check_groups(plan: Plan) -> None:
    """Raise MechanismError for a group of more than `MOST_BODIES` bodies without a closed form."""
    for step in plan.steps:
        if isinstance(step, GeneralGroup) and len(step.bodies) > MOST_BODIES:
            raise MechanismError(
                f"{plan.mechanism.name} has a group of {len(step.bodies)} bodies without a closed form",
                allowed=f"at most {MOST_BODIES} bodies in such a group",
            )


def _columns(machine: OwnMachine) -> int:
    """The number of columns of a table: those of `Motion.table`, slides and forces."""
    mechanism = machine.mechanism
    moved = len(mechanism.inputs) + 3 * len(mechanism.moving) + 6 * len(moving_points(mechanism))
    pulls = 3 * (len(mechanism.joints) + len(mechanism.couplings)) + len(mechanism.inputs) + 6
    return moved + 3 * len(mechanism.joints) + (pulls if machine.has_forces else 0)


def _check_ranges(made: MechanismRun) -> None:
    if len(made.closing) > MOST_RANGES:
        raise MechanismError(
            f"{made.name} closes in {len(made.closing)} ranges of {made.values[0]:g} to {made.values[-1]:g}",
            allowed=f"at most {MOST_RANGES}",
            do="give a shorter range with --over",
        )
