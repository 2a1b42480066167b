"""The motion of a mechanism of a file over a range of one input."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile
from ilmek.io.table_csv import check_size
from ilmek.linkage.groups.general import GeneralGroup
from ilmek.linkage.model import Input, Rotation
from ilmek.linkage.motion import Motion, moving_points
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import Plan
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.units import parse_quantity, turn

CUTS, PIECES = 9, 64
"""The end of a range is located by so many subdivisions of a step into so many pieces, to machine precision."""


MOST_RANGES = 100
"""Largest number of ranges in which a mechanism closes; the ends of each are located."""


MOST_BODIES = 20
"""Largest number of bodies of a group that is solved by Newton's method: its equations are solved for every sample."""


@record
class MotionRequest:
    """The motion of a mechanism, as texts with units.

    fixed  input -> value; "" for the only input. At most one input is left to drive
    over   range "FROM..TO" of the driving input; default: a full turn
    speed  of the driving input; default: 1 rad/s or 1 m/s
    steps  number of steps of the range
    """

    fixed: Mapping[str, str]
    over: str = ""
    speed: str = ""
    steps: int = 72


@record
class MechanismRun:
    """A mechanism in motion.

    running  the driving input; None if all inputs are fixed: one pose
    values   of the driving input [rad or m]
    speed    of the driving input [rad/s or m/s]
    """

    name: str
    plan: Plan
    motion: Motion
    running: Input | None
    values: FloatArray
    speed: float

    @property
    def unit(self) -> str:
        """Unit in which the driving input is shown."""
        return "mm" if self.running is not None and not isinstance(self.running, Rotation) else "deg"

    def at(self, values: FloatArray) -> dict[str, RealField]:
        """Values of all inputs for these values of the driving input [rad or m]."""
        fixed = {name: float(np.ravel(drive.value)[0]) for name, drive in self.motion.drives.items()}
        return {**fixed, **({self.running.name: values} if self.running else {})}

    @property
    def closing(self) -> tuple[tuple[float, float], ...]:
        """Ranges of the driving input in which the mechanism closes [rad or m]; their ends are exact to rounding."""
        ends = self.samples_that_close
        return tuple((self._end(first, first - 1), self._end(last, last + 1)) for first, last in ends)

    @property
    def samples_that_close(self) -> list[tuple[int, int]]:
        """First and last sample of each range in which the mechanism closes."""
        good = np.flatnonzero(self.motion.status == Status.OK)
        runs = np.split(good, np.flatnonzero(np.diff(good) > 1) + 1) if len(good) else []
        return [(int(run[0]), int(run[-1])) for run in runs]

    def _end(self, good: int, bad: int) -> float:
        """Input value at which the mechanism ceases to close between two samples; at an end of the range, that end."""
        if not 0 <= bad < len(self.values):
            return float(self.values[good])
        ends = self.values[[good, bad]]
        for _ in range(CUTS):
            cuts = np.linspace(ends[0], ends[1], PIECES + 1)
            lost = int(np.argmax(solve(self.plan, self.at(cuts)).status != Status.OK))
            ends = cuts[[lost - 1, lost]]
        return float(ends[0])


def run(file: MechanismFile, request: MotionRequest, progress: Progress = SILENT) -> MechanismRun:
    """The motion of the mechanism of a file.

    Raises MechanismError if the mechanism cannot be solved, if the request names an unknown input or leaves two inputs
    to drive, if the mechanism closes nowhere or in more than `MOST_RANGES` ranges, and if its motion has more than
    `MOST_NUMBERS` numbers or a group more than `MOST_BODIES` bodies; UnitError for a value that cannot be read;
    Cancelled.
    """
    motion_progress = progress.part(0.0, 1.0, "motion")
    plan = file.plan()
    _check_groups(plan)
    inputs = {entry.name: entry for entry in plan.mechanism.inputs}
    fixed = _fixed(plan, inputs, request.fixed)
    free = [entry for name, entry in inputs.items() if name not in fixed]
    if len(free) > 1:
        names = " and ".join(entry.name for entry in free)
        raise MechanismError(f"inputs {names} are both without a value", do=f"fix one, like --at {free[0].name}=0")
    if not free:
        motion = solve(plan, fixed).require()
        return MechanismRun(plan.mechanism.name, plan, motion, None, np.zeros(1), 0.0)
    (running,) = free
    check_size(request.steps + 1, _columns(plan), "--steps", MechanismError)
    values, speed = _values(running, request), _speed(running, request.speed)
    motion = solve(plan, {**fixed, running.name: values}, {running.name: speed}, progress=motion_progress)
    if (motion.status != Status.OK).all():
        motion.require()
    made = MechanismRun(plan.mechanism.name, plan, motion, running, values, speed)
    _check_ranges(made)
    return made


def _check_groups(plan: Plan) -> None:
    for step in plan.steps:
        if isinstance(step, GeneralGroup) and len(step.bodies) > MOST_BODIES:
            raise MechanismError(
                f"{plan.mechanism.name} has a group of {len(step.bodies)} bodies without a closed form",
                allowed=f"at most {MOST_BODIES} bodies in such a group",
            )


def _columns(plan: Plan) -> int:
    """The number of columns of `Motion.table`."""
    mechanism = plan.mechanism
    return len(mechanism.inputs) + 3 * len(mechanism.moving) + 6 * len(moving_points(mechanism))


def _check_ranges(made: MechanismRun) -> None:
    if len(made.samples_that_close) > MOST_RANGES:
        raise MechanismError(
            f"{made.name} closes in {len(made.samples_that_close)} ranges of {made.values[0]:g} to {made.values[-1]:g}",
            allowed=f"at most {MOST_RANGES}",
            do="give a shorter range with --over",
        )


def _fixed(plan: Plan, inputs: Mapping[str, Input], texts: Mapping[str, str]) -> dict[str, RealField]:
    fixed: dict[str, RealField] = {}
    for name, text in texts.items():
        if not name and len(inputs) > 1:
            raise MechanismError(f"{text} names no input", do=f"write NAME=VALUE, with one of {', '.join(inputs)}")
        entry = inputs.get(name or next(iter(inputs), ""))
        if entry is None:
            raise MechanismError(
                f"{plan.mechanism.name} has no input {name!r}", allowed=f"it has {', '.join(inputs) or 'none'}"
            )
        fixed[entry.name] = parse_quantity(text, "rad" if isinstance(entry, Rotation) else "m")
    return fixed


def _values(running: Input, request: MotionRequest) -> FloatArray:
    """The values of the driving input. Raises MechanismError for a range that cannot be read or has no length."""
    turning = isinstance(running, Rotation)
    if not request.over and not turning:
        raise MechanismError(
            f"input {running.name!r} is a displacement and needs a range", do="give one, like --over 0mm..50mm"
        )
    start, dots, end = request.over.partition("..") if request.over else ("0", "..", str(turn))
    if not dots or request.steps < 1:
        raise MechanismError(
            f"the range {request.over!r} in {request.steps} steps cannot be read",
            do="write FROM..TO, like 0deg..360deg",
        )
    first, last = (parse_quantity(end, "rad" if turning else "m") for end in (start, end))
    if first == last:
        raise MechanismError(f"the range {request.over} has no length", do="give one pose with --at instead")
    return np.linspace(first, last, request.steps + 1)


def _speed(running: Input, text: str) -> float:
    return parse_quantity(text, "rad/s" if isinstance(running, Rotation) else "m/s") if text else 1.0
