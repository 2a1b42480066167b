"""A mechanism of one's own, moved through the course of one input."""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.errors import MechanismError
from ilmek.io.mechanism_file import MechanismFile
from ilmek.linkage.model import Input, Rotation
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import Plan
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.units import parse_quantity, turn

CUTS, PIECES = 9, 64
"""A step of a range is cut so often into so many pieces to find where it ends: to rounding."""


@record
class MotionRequest:
    """What a mechanism is driven through, as a person says it.

    held   input -> value; "" for the only input. At most one input is left to run
    over   "FROM..TO" of the input that runs; "" for a full turn
    speed  of the input that runs; "" for 1 rad/s or 1 m/s
    steps  how many the range is divided into
    """

    held: Mapping[str, str]
    over: str = ""
    speed: str = ""
    steps: int = 72


@record
class MechanismRun:
    """A mechanism in motion.

    running  the input that runs over `values` [rad or m], at `speed`; None where all are held: one pose
    """

    name: str
    plan: Plan
    motion: Motion
    running: Input | None
    values: FloatArray
    speed: float

    @property
    def unit(self) -> str:
        """Unit to show the running input in."""
        return "mm" if self.running is not None and not isinstance(self.running, Rotation) else "deg"

    def at(self, values: FloatArray) -> dict[str, RealField]:
        """All inputs' values where the running one takes these."""
        held = {name: float(np.ravel(drive.value)[0]) for name, drive in self.motion.drives.items()}
        return {**held, **({self.running.name: values} if self.running else {})}

    @property
    def closing(self) -> tuple[tuple[float, float], ...]:
        """Ranges of the running input over which the mechanism could be moved; their ends to rounding."""
        good = np.flatnonzero(self.motion.status == Status.OK)
        runs = np.split(good, np.flatnonzero(np.diff(good) > 1) + 1) if len(good) else []
        ends = [(int(run[0]), int(run[-1])) for run in runs]
        return tuple((self._end(first, first - 1), self._end(last, last + 1)) for first, last in ends)

    def _end(self, good: int, bad: int) -> float:
        """Where the mechanism ceases to close between two samples; the good one's value where there is no other."""
        if not 0 <= bad < len(self.values):
            return float(self.values[good])
        ends = self.values[[good, bad]]
        for _ in range(CUTS):
            cuts = np.linspace(ends[0], ends[1], PIECES + 1)
            lost = int(np.argmax(solve(self.plan, self.at(cuts)).status != Status.OK))
            ends = cuts[[lost - 1, lost]]
        return float(ends[0])


def run(file: MechanismFile, course: MotionRequest, progress: Progress = SILENT) -> MechanismRun:
    """The mechanism moved through its course.

    Raises MechanismError where it has no plan, where the course names an unknown input or leaves two to run, and where
    it closes nowhere; UnitError for a value that cannot be read.
    """
    progress.part(0.0, 1.0, "motion")
    plan = file.plan()
    inputs = {entry.name: entry for entry in plan.mechanism.inputs}
    held = _held(plan, inputs, course.held)
    free = [entry for name, entry in inputs.items() if name not in held]
    if len(free) > 1:
        names = " and ".join(entry.name for entry in free)
        raise MechanismError(f"inputs {names} are both left to run", do=f"hold one, like --at {free[0].name}=0")
    if not free:
        motion = solve(plan, held).require()
        return MechanismRun(plan.mechanism.name, plan, motion, None, np.zeros(1), 0.0)
    (running,) = free
    values, speed = _values(running, course), _speed(running, course.speed)
    motion = solve(plan, {**held, running.name: values}, {running.name: speed})
    if (motion.status != Status.OK).all():
        motion.require()
    return MechanismRun(plan.mechanism.name, plan, motion, running, values, speed)


def _held(plan: Plan, inputs: Mapping[str, Input], said: Mapping[str, str]) -> dict[str, RealField]:
    held: dict[str, RealField] = {}
    for name, text in said.items():
        if not name and len(inputs) > 1:
            raise MechanismError(f"{text} for which input?", do=f"write NAME=VALUE, with one of {', '.join(inputs)}")
        entry = inputs.get(name or next(iter(inputs), ""))
        if entry is None:
            raise MechanismError(
                f"{plan.mechanism.name} has no input {name!r}", allowed=f"it has {', '.join(inputs) or 'none'}"
            )
        held[entry.name] = parse_quantity(text, "rad" if isinstance(entry, Rotation) else "m")
    return held


def _values(running: Input, course: MotionRequest) -> FloatArray:
    """The values of the running input. Raises MechanismError for a range that cannot be read or has no length."""
    turning = isinstance(running, Rotation)
    if not course.over and not turning:
        raise MechanismError(f"input {running.name!r} shifts a slide", do="say its range, like --over 0mm..50mm")
    start, dots, end = course.over.partition("..") if course.over else ("0", "..", str(turn))
    if not dots or course.steps < 1:
        raise MechanismError(
            f"the range {course.over!r} in {course.steps} steps is none", do="write FROM..TO, like 0deg..360deg"
        )
    first, last = (parse_quantity(end, "rad" if turning else "m") for end in (start, end))
    if first == last:
        raise MechanismError(f"the range {course.over} has no length", do="give one pose with --at instead")
    return np.linspace(first, last, course.steps + 1)


def _speed(running: Input, said: str) -> float:
    return parse_quantity(said, "rad/s" if isinstance(running, Rotation) else "m/s") if said else 1.0
