"""Loads of a mechanism file: forces, torques, friction and drag of points; gravity."""

from dataclasses import replace
from typing import Any, TypeGuard

from ilmek.dynamics.friction import AngleRange, Friction, ValueRange, WindowedLoad
from ilmek.dynamics.input_loads import Drag, FollowerForce, TabulatedLoad
from ilmek.dynamics.loads import Load, PointForce, Torque
from ilmek.dynamics.own_machine import NamedLoad
from ilmek.errors import MechanismError
from ilmek.io.declared import ChoiceEntry, ListEntry, TableEntry, TextEntry, keys, quantity, variant
from ilmek.io.mechanism.motions import table_rows
from ilmek.io.mechanism.names import ANGLE, SPOT, input_of, position_of_input, spot_of, unit_of, value_of, xy_of
from ilmek.io.mechanism.points import complex_of, polar
from ilmek.io.mechanism.springs import spring_of
from ilmek.io.schema import Measured, SourceText, Table
from ilmek.linkage.model import Input, Mechanism, Rotation
from ilmek.records import JsonObject

TIME = "time"
"""What a table is over in place of an input."""

GRAVITY = variant(
    quantity("m/s^2", "downward, in -y"),
    ListEntry("x and y components", quantity("m/s^2"), 2, 2),
    keys({"value": quantity("m/s^2"), "direction": ANGLE}),
    doc="default: none, the plane of motion is horizontal",
)

_WINDOW = TableEntry(
    "the load acts from one value of the input up to another",
    {"from": position_of_input(), "to": position_of_input()},
    {"input": TextEntry("the driven joint or body; default: the only input", "input")},
    name="window",
)
_FORCE = variant(quantity("N", "magnitude, with `direction`"), ListEntry("x and y components", quantity("N"), 2, 2))
_OVER = TextEntry(
    "input of the table, or `time`; default: time where its first column has seconds, else the only input", "input"
)


def _rows(unit: str, doc: str) -> ListEntry:
    """A table of a load over an input or time."""
    row = ListEntry("a value of the input, or a time, and the load", quantity(("rad", "m", "s", unit)), 2, 2)
    return ListEntry(doc, row, 2, 1000)


LOAD = variant(
    keys(
        {"force": _FORCE, "on": SPOT},
        {
            "direction": ANGLE,
            "frame": ChoiceEntry("frame of the direction; default: ground", ("ground", "body")),
            "table": _rows(
                "N",
                "[[input or time, magnitude], ...] with straight lines between; replaces the magnitude of `force`",
            ),
            "over": _OVER,
            "while": _WINDOW,
        },
    ),
    keys(
        {"torque": quantity("N*m", "counter-clockwise"), "on": TextEntry("body", "body")},
        {
            "table": _rows("N*m", "[[input or time, torque], ...] with straight lines between; replaces `torque`"),
            "over": _OVER,
            "while": _WINDOW,
        },
    ),
    keys(
        {
            "friction": quantity("N", "magnitude, against the velocity of the point", least=0.0),
            "on": SPOT,
        },
        {"over": replace(_OVER, doc="input; default: the only input"), "while": _WINDOW},
    ),
    keys(
        {
            "drag": quantity("N*s/m", "viscous: force per speed of the point, against it"),
            "on": SPOT,
        },
        {"while": _WINDOW},
    ),
    name="load",
)


def loads_of(data: Table, mechanism: Mechanism, source: SourceText) -> tuple[NamedLoad, ...]:
    """The loads, springs and dampers of a file whose data satisfy the schema. Raises MechanismError with the line."""
    kinds = {"loads": _load, "springs": spring_of, "dampers": spring_of}
    loads: dict[str, Load] = {}
    for key, made in kinds.items():
        for name, table in data.get(key, {}).items():
            with source.located(key, name):
                if name in loads:
                    raise MechanismError(
                        f"the name {name!r} is used twice", do="give each load and spring its own name"
                    )
                loads[name] = made(table, mechanism)
    return tuple(NamedLoad(name, load) for name, load in loads.items())


def gravity_of(given: Any) -> complex:
    """Gravity [m/s²]: a magnitude downward, components, or a magnitude and a direction; none: 0."""
    if given is None:
        return 0j
    if isinstance(given, dict):
        return polar(given["value"], given["direction"])
    return complex_of(given) if isinstance(given, list) else complex(0.0, -given)


def _load(table: Table, mechanism: Mechanism) -> Load:
    load = _varying(table, mechanism)
    if "while" not in table or isinstance(load, Friction):
        return load
    entry, window = _window(table["while"], mechanism)
    return WindowedLoad(load, entry.name, window)


def _varying(table: Table, mechanism: Mechanism) -> Load:
    """The load without its window."""
    if "force" in table:
        return _tabulated(table, "N", _force(table, mechanism), mechanism)
    if "torque" in table:
        mechanism.body(table["on"])
        torque = 1.0 if "table" in table else table["torque"]
        return _tabulated(table, "N*m", Torque(table["on"], torque), mechanism)
    on = spot_of(table["on"], mechanism)
    if "drag" in table:
        return Drag(on, table["drag"])
    if "while" in table:
        entry, window = _window(table["while"], mechanism)
        return Friction(on, table["friction"], entry.name, window)
    return Friction(on, table["friction"], input_of(table.get("over"), mechanism).name)


def _force(table: Table, mechanism: Mechanism) -> PointForce | FollowerForce:
    on = spot_of(table["on"], mechanism)
    given, tabulated = table["force"], "table" in table
    if isinstance(given, list):
        if "direction" in table:
            raise MechanismError("force has components and a direction", do="leave the direction, or give a magnitude")
        force = complex_of(given)
        if tabulated:
            if force == 0:
                raise MechanismError("force is 0: it has no direction", do="give its direction")
            force /= abs(force)
    elif "direction" in table:
        force = polar(1.0 if tabulated else given, table["direction"])
    else:
        raise MechanismError("force has no direction", do='give one, like direction = "90deg", or [x, y] components')
    return (FollowerForce if table.get("frame") == "body" else PointForce)(on, force)


def _tabulated(table: Table, unit: str, load: Load, mechanism: Mechanism) -> Load:
    if "table" not in table:
        if "over" in table:
            raise MechanismError("`over` is given without a table", do="give the table, or use `while`")
        return load
    timed = table.get("over", TIME if any(row[0].unit == "s" for row in table["table"]) else None) == TIME
    entry = None if timed else input_of(table.get("over"), mechanism)
    turning = isinstance(entry, Rotation)
    at_unit = "s" if entry is None else unit_of(entry)
    at = tuple(value_of(row[0], at_unit, "the first of a row") for row in table["table"])
    factors = tuple(value_of(row[1], unit, "the second of a row") for row in table["table"])
    return TabulatedLoad(load, None if entry is None else entry.name, at, factors, turning)


def _window(table: Table, mechanism: Mechanism) -> tuple[Input, AngleRange | ValueRange]:
    entry = input_of(table.get("input"), mechanism)
    turning = isinstance(entry, Rotation)
    start, end = (value_of(table[key], unit_of(entry), key) for key in ("from", "to"))
    if not turning and not start < end:
        raise MechanismError(f"the range from {start:g} m to {end:g} m is empty", do="give a greater value in `to`")
    return entry, AngleRange(start, end) if turning else ValueRange(start, end)


def load_data(name: str, load: Load, mechanism: Mechanism) -> JsonObject:
    """The table of a load that is no spring. Raises MechanismError for one that no file can express."""
    if isinstance(load, WindowedLoad) and _is_default(load.side):
        return {**load_data(name, load.load, mechanism), "while": _window_data(load.window, load.input_name, mechanism)}
    if isinstance(load, TabulatedLoad) and load.turns == (_unit(load.input_name, mechanism) == "rad"):
        data = load_data(name, load.load, mechanism)
        unit, at_unit = "N" if "force" in data else "N*m", _unit(load.input_name, mechanism)
        return {**data, "over": load.input_name or TIME, "table": table_rows(load.at, at_unit, load.factors, unit)}
    if isinstance(load, PointForce | FollowerForce) and isinstance(load.on[1], str) and _is_complex(load.force):
        frame = "body" if isinstance(load, FollowerForce) else "ground"
        return {"force": xy_of(complex(load.force)), "on": load.on, "frame": frame}
    if isinstance(load, Torque) and _is_real(load.torque):
        return {"torque": load.torque, "on": load.body}
    if isinstance(load, Drag):
        return {"drag": load.coefficient, "on": load.on}
    if (
        isinstance(load, Friction)
        and isinstance(load.on[1], str)
        and _is_real(load.magnitude)
        and _is_default(load.side)
    ):
        window = {} if load.window is None else {"while": _window_data(load.window, load.input_name, mechanism)}
        return {"friction": load.magnitude, "on": load.on, "over": load.input_name, **window}
    raise MechanismError(f"load {name!r} is a function that no file expresses", do="write the others to the file")


def _window_data(window: AngleRange | ValueRange, name: str, mechanism: Mechanism) -> JsonObject:
    unit = _unit(name, mechanism)
    return {"input": name, "from": Measured(window.start, unit), "to": Measured(window.end, unit)}


def _unit(name: str | None, mechanism: Mechanism) -> str:
    """The unit of what a load is over: an input, or time."""
    return "s" if name is None else unit_of(input_of(name, mechanism))


def _is_real(value: object) -> TypeGuard[float]:
    return isinstance(value, int | float)


def _is_complex(value: object) -> TypeGuard[complex]:
    return isinstance(value, int | float | complex)


def _is_default(side: object) -> bool:
    return isinstance(side, float) and side == 1.0
