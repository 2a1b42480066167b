"""The motion that a call requires of a mechanism: values, speeds and accelerations of all inputs."""

from collections.abc import Mapping, Sequence

import numpy as np

from ilmek.arguments import Arguments, Quantity
from ilmek.arrays import FloatArray, RealField
from ilmek.dynamics.input_loads import jumps
from ilmek.dynamics.own_machine import GivenMotion, OwnMachine
from ilmek.errors import MechanismError
from ilmek.linkage.model import Input, Rotation
from ilmek.linkage.structure import Plan
from ilmek.records import record
from ilmek.units import turn

STEPS = 360
"""Default number of steps of a range."""

BESIDE = 1e-7
"""Distance of two further samples from a jump of a load [rad; m], or in time over the duration of the run."""

HALVINGS = 50
"""Halvings of a step of time in which a law passes a jump of a load."""


@record
class MotionRequest:
    """The motion of a mechanism, as texts with units or as numbers in SI.

    fixed  input -> value; "" for the only input. At most one input without a motion of its own is left to drive
    over   range "FROM..TO" of the driving input, or its ends; default: a full turn, or the period of its motion
    speed  of the driving input; default: that of its motion in the file, else 1 rad/s or 1 m/s
    steps  number of steps of the range
    fluctuation  of the speed for which a flywheel is sized, with the best counterweight on the crank; "": none
    """

    fixed: Mapping[str, Quantity]
    over: str | tuple[Quantity, Quantity] = ""
    speed: Quantity = ""
    steps: int = STEPS
    fluctuation: Quantity = ""


@record
class DrivenInputs:
    """Motions of all inputs over the samples.

    running  the driving input; None if all are fixed      values  of it [rad; m]; of a single pose: 0
    speed    its constant speed [rad/s; m/s]; None: it follows a law of time, or all inputs are fixed and at rest
    time     of the samples [s]; None: nothing moves
    rates    values, speeds and accelerations of all inputs by name, as for `solve`
    assumed  whether the speed is given neither by the call nor by the file
    """

    running: Input | None
    values: FloatArray
    speed: float | None
    time: FloatArray | None
    rates: tuple[dict[str, RealField], dict[str, RealField], dict[str, RealField]]
    assumed: bool = False


@record
class TimeGrid:
    """Steps of a run over time, and values of the driving input at which loads jump [rad; m]."""

    steps: int
    jumps: tuple[float, ...]


def driven_inputs(machine: OwnMachine, plan: Plan, request: MotionRequest) -> DrivenInputs:
    """The motions of all inputs: fixed by the request, by a motion of the file, or over the request's range.

    Range and speed of the request take the place of the driving input's motion in the file. Raises MechanismError for
    an unknown input, two inputs left to drive and a range that cannot be read; UnitError.
    """
    inputs = {entry.name: entry for entry in plan.mechanism.inputs}
    fixed = _fixed(plan, inputs, request.fixed)
    laws = {name: motion for name, motion in machine.motions.items() if name not in fixed}
    free = [entry for name, entry in inputs.items() if name not in fixed]
    if not free:
        return _pose(inputs, fixed, request)
    running = _running(free, laws)
    law = laws.pop(running.name, None)
    if law is not None and law.speed is None and _left_out(request.over) and _left_out(request.speed):
        grid = TimeGrid(request.steps, _jumps(machine, running.name))
        return _over_time(running, law, laws, fixed, grid)
    start = 0.0 if law is None else float(law.law(np.zeros(1))[0][0])
    values = _with_jumps(_values(running, request, start), _jumps(machine, running.name), isinstance(running, Rotation))
    speed = _speed(running, request.speed, law)
    time = None if speed == 0 else (values - start) / speed
    rates = _rates(laws, np.zeros(len(values)) if time is None else time, fixed)
    rates[0][running.name], rates[1][running.name] = values, speed
    return DrivenInputs(running, values, speed, time, rates, assumed=_left_out(request.speed) and law is None)


def _jumps(machine: OwnMachine, name: str) -> tuple[float, ...]:
    """Values of an input at which a load of the machine jumps [rad; m], ascending."""
    return tuple(sorted(set[float]().union(*(jumps(load.load, name) for load in machine.loads))))


def _with_jumps(values: FloatArray, at: Sequence[float], turning: bool) -> FloatArray:
    """The values with two more at each jump inside their range, just before and after it."""
    every = _beside(np.sort(values), _in_every_turn(values, at, turning), BESIDE)
    return every if values[-1] > values[0] else every[::-1]


def _in_every_turn(values: FloatArray, at: Sequence[float], turning: bool) -> list[float]:
    """Values of a turning input in every turn of its range; others as they are."""
    if not (turning and at):
        return list(at)
    least, most = float(values.min()), float(values.max())
    turns = np.arange(np.floor(least / turn) - 1, np.ceil(most / turn) + 1)
    return [float(one) for one in np.add.outer(turns * turn, np.asarray(at) % turn).ravel()]


def _beside(values: FloatArray, at: Sequence[float], distance: float) -> FloatArray:
    """Ascending values with two more at each position inside them."""
    more = [one + side for one in at for side in (-distance, distance) if values[0] < one + side < values[-1]]
    if not more:
        return values
    every = np.sort(np.concatenate((values, more)))
    return np.asarray(every[np.append(True, np.diff(every) > 0)])


def _times(law: GivenMotion, at: Sequence[float], turning: bool, time: FloatArray) -> FloatArray:
    """Times with two more beside each at which the law passes a jump of a load, or its acceleration jumps [s]."""
    values = law.law(time)[0]
    found = [one for one in law.breaks if time[0] < one < time[-1]]
    for jump in _in_every_turn(values, at, turning):
        before = np.flatnonzero((values[:-1] - jump) * (values[1:] - jump) < 0)
        low, high = time[before], time[before + 1]
        for _ in range(HALVINGS if before.size else 0):
            middle = (low + high) / 2
            same = (law.law(middle)[0] - jump) * (values[before] - jump) > 0
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        found += low.tolist()
    return _beside(time, found, BESIDE * float(time[-1] - time[0]))


def _running(free: list[Input], laws: Mapping[str, GivenMotion]) -> Input:
    """The driving input: the only one without a motion in the file, or else the first."""
    left = [entry for entry in free if entry.name not in laws]
    if len(left) > 1:
        names = " and ".join(entry.name for entry in left)
        raise MechanismError(f"inputs {names} are both without a value", do=f"fix one, like {left[0].name}=0")
    return (left or free)[0]


def _pose(inputs: Mapping[str, Input], fixed: dict[str, RealField], request: MotionRequest) -> DrivenInputs:
    """A single pose; a speed of the request is that of the only input."""
    if _left_out(request.speed):
        return DrivenInputs(None, np.zeros(1), None, None, (fixed, {}, {}))
    if len(inputs) > 1:
        raise MechanismError("a speed is given for a pose of several inputs", do="leave one input free, with a range")
    (entry,) = inputs.values()
    return DrivenInputs(None, np.zeros(1), None, None, (fixed, {entry.name: _speed(entry, request.speed, None)}, {}))


def _over_time(
    running: Input, law: GivenMotion, others: Mapping[str, GivenMotion], fixed: dict[str, RealField], times: TimeGrid
) -> DrivenInputs:
    """All inputs over the period of the driving input's law, or to its end."""
    end = law.period if law.period is not None else (law.breaks[-1] if law.breaks else None)
    if end is None:
        raise MechanismError(f"the motion of {running.name!r} has neither a period nor an end", do="give it a period")
    time = _times(law, times.jumps, isinstance(running, Rotation), np.linspace(0.0, end, times.steps + 1))
    rates = _rates({**others, running.name: law}, time, fixed)
    return DrivenInputs(running, np.asarray(rates[0][running.name]), None, time, rates)


def _rates(
    laws: Mapping[str, GivenMotion], time: FloatArray, fixed: Mapping[str, RealField]
) -> tuple[dict[str, RealField], dict[str, RealField], dict[str, RealField]]:
    """Values, speeds and accelerations of the fixed inputs and of those with a law, at times [s]."""
    rates: tuple[dict[str, RealField], dict[str, RealField], dict[str, RealField]] = ({**fixed}, {}, {})
    for name, motion in laws.items():
        for field, values in zip(rates, motion.law(time), strict=True):
            field[name] = values
    return rates


def _fixed(plan: Plan, inputs: Mapping[str, Input], values: Mapping[str, Quantity]) -> dict[str, RealField]:
    fixed: dict[str, RealField] = {}
    for name, value in values.items():
        if not name and len(inputs) > 1:
            raise MechanismError(f"{value} names no input", do=f"write NAME=VALUE, with one of {', '.join(inputs)}")
        entry = inputs.get(name or next(iter(inputs), ""))
        if entry is None:
            raise MechanismError(
                f"{plan.mechanism.name} has no input {name!r}", allowed=f"it has {', '.join(inputs) or 'none'}"
            )
        fixed[entry.name] = _quantity(f"value of {entry.name!r}", value, "rad" if isinstance(entry, Rotation) else "m")
    return fixed


def _left_out(value: object) -> bool:
    return isinstance(value, str) and not value


def _quantity(name: str, value: Quantity, unit: str) -> float:
    """A number in SI, or a text with its unit [SI]."""
    return Arguments("", MechanismError).number(name, value, unit)


def _values(running: Input, request: MotionRequest, start: float) -> FloatArray:
    """The values of the driving input. Raises MechanismError for a range that cannot be read or has no length."""
    turning = isinstance(running, Rotation)
    if _left_out(request.over):
        if turning:
            return np.linspace(start, start + turn, request.steps + 1)
        raise MechanismError(
            f"input {running.name!r} is a displacement and needs a range", do="give one, like 0mm..50mm"
        )
    ends = request.over.split("..") if isinstance(request.over, str) else request.over
    if len(ends) != 2 or request.steps < 1:
        raise MechanismError(
            f"the range {request.over!r} in {request.steps} steps cannot be read",
            do="write FROM..TO, like 0deg..360deg",
        )
    first, last = (_quantity("the range", end, "rad" if turning else "m") for end in ends)
    if first == last:
        raise MechanismError(f"the range {request.over} has no length", do="fix the input at one pose instead")
    return np.linspace(first, last, request.steps + 1)


def _speed(running: Input, value: Quantity, law: GivenMotion | None) -> float:
    """Speed of the driving input [rad/s; m/s]: that of the request, of the file, or 1."""
    if not _left_out(value):
        speed = _quantity(f"speed of {running.name!r}", value, "rad/s" if isinstance(running, Rotation) else "m/s")
        if not speed:
            raise MechanismError(f"speed {value} of {running.name!r}", allowed="not 0", do="fix the input at a pose")
        return speed
    return 1.0 if law is None or law.speed is None else law.speed
