"""Forward runs: what a mechanism does under its drives, loads and friction."""

from __future__ import annotations  # so that `help` shows the aliases

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ilmek.api.mechanisms import ANY_ANGLE, Solvable, Values, as_frictions, as_inertias, as_loads, planned_of
from ilmek.arguments import Arguments, Quantity
from ilmek.dynamics import forward
from ilmek.dynamics.forward_run import Drive, ForwardRun, ForwardState
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.joint_friction import JointFriction
from ilmek.dynamics.loads import Load
from ilmek.dynamics.motor_drive import MotorDrive
from ilmek.dynamics.own_machine import EndStop
from ilmek.dynamics.reduced import reduce
from ilmek.errors import MechanismError
from ilmek.linkage.model import Input, Rotation


def forward_dynamics(
    mechanism: Solvable,
    inertias: Mapping[str, Inertia],
    duration: Quantity,
    *,
    position: Values = 0.0,
    speed: Values = 0.0,
    drive: Drive | Mapping[str, Drive] | None = None,
    loads: Sequence[Load] = (),
    joint_frictions: Sequence[JointFriction] = (),
    flywheel: Quantity | Mapping[str, Quantity] = 0.0,
    stops: Sequence[EndStop] = (),
    ratchet: int = 0,
    every: Quantity | None = None,
) -> ForwardRun:
    """Run of a mechanism from a state, under its drives, loads and friction.

    inertias  body -> inertia; a body that is not listed is massless
    duration  [s]
    position, speed  of the input at the start [rad, rad/s; m, m/s]; of several inputs by name
    drive     a `MotorDrive`, or the effort on the input [N m; N] as a function of time, position and speed; of several
              inputs by name, those without one are free; default: the machine coasts
    loads     loads such as `Gravity`; default: none
    joint_frictions  friction of joints: `PinFriction`, `SlideFriction`; default: none
    flywheel  inertia that moves with the input [kg m²; kg for a sliding input], beside that of its motor; of several
              inputs by name
    stops     end stops of one input      ratchet  the direction in which one input is free, +1 or -1; 0: both
    every     time between the reported samples [s]; default: the steps of the integrator

    Friction that brings the machine, or one of several inputs' joints, to rest and holds it there ends the run: see
    `ForwardRun.end`. Raises MechanismError for no moving mass, a start at which the mechanism does not close, and
    values that are not finite.

    >>> from ilmek import bar, four_bar
    >>> masses = {"crank": bar(0, 0.060, mass=0.1), "rocker": bar(0, 0.230, mass=0.4)}
    >>> run = forward_dynamics(four_bar(0.300, 0.060, 0.200, 0.230), masses, "0.5s", drive=MotorDrive(2.0, "100rpm"))
    >>> run.end.reason, bool(run.energy_error < 1e-6), round(float(run.speed[-1]), 2)
    ('its duration was reached', True, 10.47)
    """
    planned = planned_of(mechanism)
    given = Arguments("a run", MechanismError)
    inputs = planned.mechanism.inputs
    drives = _drives(given, inputs, drive)
    wheels = _numbers(given, inputs, "flywheel", flywheel, lambda turns: "kg*m^2" if turns else "kg")
    rotors = {name: motor.inertia for name, motor in drives.items() if isinstance(motor, MotorDrive)}
    reduced = reduce(
        planned,
        as_inertias(inertias),
        as_loads(given, loads),
        flywheel={entry.name: wheels.get(entry.name, 0.0) + rotors.get(entry.name, 0.0) for entry in inputs},
        frictions=as_frictions(given, joint_frictions),
    )
    at = _numbers(given, inputs, "position", position, lambda turns: "rad" if turns else "m")
    pace = _numbers(given, inputs, "speed", speed, lambda turns: "rad/s" if turns else "m/s")
    start = [np.array([one.get(entry.name, 0.0) for entry in inputs]) for one in (at, pace)]
    return forward.forward(
        reduced,
        ForwardState(*(start if len(inputs) > 1 else (float(one[0]) for one in start))),
        given.number("duration", duration, "s"),
        drive=drives,
        stops=given.sequence("stops", stops, EndStop),
        ratchet=given.whole("ratchet", ratchet, least=-1, most=1),
        every=None if every is None else given.number("every", every, "s"),
    )


def _numbers(
    given: Arguments, inputs: Sequence[Input], what: str, values: object, unit: Callable[[bool], str]
) -> dict[str, float]:
    """One number of each input [SI], of several inputs by name; those left out are missing."""
    turning = {entry.name: isinstance(entry, Rotation) for entry in inputs}
    if not isinstance(values, Mapping):
        if len(turning) > 1 and not (isinstance(values, int | float) and values == 0):
            do = f"give it by input: {', '.join(turning)}"
            raise MechanismError(f"one {what} is given for {len(turning)} inputs", do=do)
        values = dict.fromkeys(turning, values)
    read: dict[str, float] = {}
    for name, value in values.items():
        turns = turning[given.one_of("an input", name, turning)]
        if what == "position" and turns:
            given.turning(what, value, ANY_ANGLE)
        read[name] = given.number(what, value, unit(turns))
    return read


def _drives(given: Arguments, inputs: Sequence[Input], drive: object) -> dict[str, Drive]:
    """Drives by input."""
    names = [entry.name for entry in inputs]
    if drive is None:
        return {}
    if not isinstance(drive, Mapping):
        if len(names) != 1:
            do = f"give it by input: {', '.join(names)}"
            raise MechanismError(f"one drive is given for {len(names)} inputs", do=do)
        drive = {names[0]: drive}
    return {
        given.one_of("an input", name, names): given.function("drive", one, "time, position and speed")
        for name, one in drive.items()
    }
