"""What is computed of a machine: a run under its motor, speeds to compare, a servo, paths, transmission angles."""

from collections.abc import Mapping, Sequence

import numpy as np

from ilmek.dynamics.friction import Friction
from ilmek.dynamics.motor_drive import MotorDrive
from ilmek.dynamics.own_machine import EndStop, ForwardTask, NamedLoad, SpeedStudy, StopEvent
from ilmek.errors import MechanismError
from ilmek.io.declared import ChoiceEntry, FlagEntry, ListEntry, TableEntry, WholeEntry, keys, names, quantity, variant
from ilmek.io.mechanism.names import input_of, position_of_input, speed_of_input, unit_of, unknown, value_of
from ilmek.io.schema import Measured, SourceText, Table
from ilmek.linkage.model import Joint, Mechanism, Pin, Rotation
from ilmek.records import JsonObject
from ilmek.units import counted

MOST_SPEEDS_RATIO = 1e4
"""Greatest ratio of the speeds of a study."""

_SLIP = quantity("1", "default: 5 %", above=0.0)
_SHARP = FlagEntry("line and limit meet in a corner; default: false, rounded")
_DIRECTIONS = {"up": 1, "down": -1, "both": 0}

_MOTOR = variant(
    keys(
        {"torque": quantity("N*m", "limit of the motor, at a turning input")},
        {
            "speed": quantity("rad/s", "without load; default: constant torque"),
            "slip": _SLIP,
            "sharp": _SHARP,
            "inertia": quantity("kg*m^2", "of rotor and flywheel at the input; default: 0", least=0.0),
        },
    ),
    keys(
        {"force": quantity("N", "limit of the drive, at a sliding input")},
        {
            "speed": quantity("m/s", "without load; default: constant force"),
            "slip": _SLIP,
            "sharp": _SHARP,
            "inertia": quantity("kg", "at the input; default: 0", least=0.0),
        },
    ),
)

_EVENT = keys(
    {},
    {
        "position": position_of_input(),
        "speed": speed_of_input(),
        "time": quantity("s"),
        "direction": ChoiceEntry("of the crossing; default: both", tuple(_DIRECTIONS)),
        "stop": FlagEntry("the run ends there; default: true"),
    },
    name="event",
)

_STOP = keys(
    {"position": position_of_input()},
    {"rebound": quantity("1", "coefficient of restitution, 0 to 1; default: 0", least=0.0)},
    name="end stop",
)

_RATCHETS = {name: sign for name, sign in _DIRECTIONS.items() if sign}

FORWARD = TableEntry(
    "a run from a state under a motor",
    {"duration": quantity("s", above=0.0)},
    {
        "position": position_of_input("of the input at the start; default: 0"),
        "speed": speed_of_input("of the input at the start; default: 0"),
        "motor": _MOTOR,
        "events": names(_EVENT, "name -> one of position, speed, time"),
        "stops": names(_STOP, "name -> end stop of the input, on the side on which it starts"),
        "ratchet": ChoiceEntry("direction in which alone the input moves", tuple(_RATCHETS)),
    },
    name="forward",
)

STUDY = variant(
    keys({"speeds": ListEntry("speeds of the driving input", speed_of_input(), 1, 50)}),
    keys(
        {"from": speed_of_input(), "to": speed_of_input()},
        {"count": WholeEntry("number of speeds; default: 5", 2, 50)},
    ),
    name="study",
    doc="speeds of the driving input to compare",
)


def forward_of(
    table: Table | None, mechanism: Mechanism, loads: Sequence[NamedLoad], source: SourceText
) -> ForwardTask | None:
    """The forward run of a file. Raises MechanismError with the line."""
    if table is None:
        return None
    with source.located("forward"):
        unit = unit_of(input_of(None, mechanism))
        events = []
        for name, event in table.get("events", {}).items():
            with source.located("forward", "events", name):
                events.append(_event(name, event, unit))
        with source.located("forward", "motor"):
            drive = _motor(table.get("motor"), unit)
        position = value_of(table["position"], unit, "position") if "position" in table else 0.0
        speed = value_of(table["speed"], f"{unit}/s", "speed") if "speed" in table else 0.0
        against = next((load.name for load in loads if isinstance(load.load, Friction)), None)
        if speed == 0 and against is not None:
            given = f"the run starts at rest, where friction {against!r} has no direction"
            raise MechanismError(given, do='give the speed at the start, like speed = "1rpm"')
        stops = [_stop(name, stop, unit) for name, stop in table.get("stops", {}).items()]
        ratchet = _RATCHETS.get(table.get("ratchet", ""), 0)
        return ForwardTask(table["duration"], position, speed, drive, tuple(events), tuple(stops), ratchet)


def _event(name: str, table: Table, unit: str) -> StopEvent:
    units = {"position": unit, "speed": f"{unit}/s", "time": "s"}
    given = [key for key in units if key in table]
    if len(given) != 1:
        stated = " and ".join(given) or "none"
        raise MechanismError(f"event {name!r} has {stated} of position, speed and time", allowed="one of them")
    of = given[0]
    value = table[of] if of == "time" else value_of(table[of], units[of], of)
    direction = _DIRECTIONS[table.get("direction", "both")]
    return StopEvent(name, of, value, table.get("stop", True), direction)


def _stop(name: str, table: Table, unit: str) -> EndStop:
    return EndStop(value_of(table["position"], unit, "position"), table.get("rebound", 0.0), name)


def _motor(table: Table | None, unit: str) -> MotorDrive | None:
    if table is None:
        return None
    effort, other = ("torque", "force") if unit == "rad" else ("force", "torque")
    if effort not in table:
        kind = "turning" if unit == "rad" else "sliding"
        raise MechanismError(f"the motor of a {kind} input has a {other}", do=f"give its {effort}")
    if "speed" in table and not abs(table["speed"]) > 0:
        raise MechanismError("speed of the motor without load is 0", allowed="not 0")
    return MotorDrive(table[effort], **{key: value for key, value in table.items() if key != effort})


def forward_data(task: ForwardTask, unit: str) -> JsonObject:
    """The table of a forward run of an input in a unit."""
    units = {"position": unit, "speed": f"{unit}/s", "time": "s"}
    data: JsonObject = {
        "duration": task.duration,
        "position": Measured(task.position, unit),
        "speed": Measured(task.speed, units["speed"]),
    }
    if task.drive is not None:
        effort = {"torque" if unit == "rad" else "force": task.drive.effort}
        data["motor"] = {**effort, **_MOTOR.table(effort).given(task.drive)}
    if task.events:
        direction = {sign: name for name, sign in _DIRECTIONS.items()}
        data["events"] = {
            event.name: {
                event.of: event.value if event.of == "time" else Measured(event.value, units[event.of]),
                "direction": direction[event.direction],
                "stop": event.terminal,
            }
            for event in task.events
        }
    if task.stops:
        data["stops"] = {
            stop.name: {"position": Measured(stop.position, unit), "rebound": stop.rebound} for stop in task.stops
        }
    if task.ratchet:
        data["ratchet"] = next(name for name, sign in _RATCHETS.items() if sign == task.ratchet)
    return data


def study_of(table: Table | None, mechanism: Mechanism, source: SourceText) -> SpeedStudy | None:
    """The speeds to compare, ascending. Raises MechanismError with the line."""
    if table is None:
        return None
    with source.located("study"):
        turning = any(isinstance(entry, Rotation) for entry in mechanism.inputs)
        unit = "rad/s" if turning else "m/s"
        if "speeds" in table:
            speeds = [value_of(one, unit, "speeds") for one in table["speeds"]]
        else:
            first, last = (value_of(table[key], unit, key) for key in ("from", "to"))
            speeds = [float(one) for one in np.linspace(first, last, table.get("count", 5))]
        if any(not speed > 0 for speed in speeds) or max(speeds) > MOST_SPEEDS_RATIO * min(speeds):
            raise MechanismError(
                "speeds of a study cannot be used", allowed=f"above 0, up to {MOST_SPEEDS_RATIO:g} to 1"
            )
        return SpeedStudy(tuple(sorted(set(speeds))))


def effort_of(joint: Joint) -> str:
    """The kind of effort that an actuator has in a joint."""
    return "torque" if isinstance(joint, Pin) else "force"


def actuators_of(
    efforts: Mapping[str, str], parts: Mapping[str, Sequence[Joint]], mechanism: Mechanism, source: SourceText
) -> tuple[str, ...]:
    """The joints with the motors. Raises MechanismError for an unknown joint, a joint of several bodies, an effort of
    another kind, and another number than of inputs.
    """
    for name, effort in efforts.items():
        with source.located("actuators", name):
            if name not in parts:
                raise unknown("joint", name, parts)
            if len(parts[name]) != 1:
                raise MechanismError(f"{name!r} joins more than two bodies", do="give the actuator a joint of two")
            kind = effort_of(parts[name][0])
            if effort != kind:
                raise MechanismError(f"the actuator at {name!r} is a {effort}", allowed=f"in this joint a {kind}")
    with source.located("actuators"):
        if efforts and len(efforts) != len(mechanism.inputs):
            given = f"there are {counted(len(efforts), 'actuator')} and {counted(len(mechanism.inputs), 'input')}"
            raise MechanismError(given, allowed="the same number")
    return tuple(efforts)


def servo_of(name: str | None, mechanism: Mechanism, actuators: Sequence[str], source: SourceText) -> str | None:
    """The turning input, or actuator in its place, for which a servo motor is chosen."""
    if name is None:
        return None
    with source.located("servo"):
        if actuators:
            if name not in actuators:
                raise unknown("actuator", name, actuators)
            if not isinstance(mechanism.joint(name), Pin):
                raise MechanismError(f"a servo motor is for a turning actuator, and {name!r} slides")
            return name
        entry = input_of(name, mechanism)
        if not isinstance(entry, Rotation):
            raise MechanismError(f"a servo motor is for a turning input, and {name!r} slides")
        return entry.name


def paths_of(spots: Sequence[tuple[str, str]], mechanism: Mechanism, source: SourceText) -> tuple[tuple[str, str], ...]:
    """The points whose paths are drawn. Raises MechanismError for an unknown body or point."""
    for number, spot in enumerate(spots):
        with source.located("paths", number):
            mechanism.point(*spot)
    return tuple(dict.fromkeys(spots))


def transmission_of(names: Sequence[str], parts: Mapping[str, Sequence[Joint]], source: SourceText) -> tuple[str, ...]:
    """The pins at which the transmission angle is listed. Raises MechanismError for another name."""
    for number, name in enumerate(names):
        with source.located("transmission", number):
            if name not in parts:
                raise unknown("joint", name, parts)
            if not isinstance(parts[name][0], Pin):
                raise MechanismError(f"{name!r} is a slide", allowed="a pin has a transmission angle")
    return tuple(dict.fromkeys(names))
