"""Loads of a mechanism file: forces, torques, friction and drag of points, springs, dampers; friction of joints."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from ilmek.dynamics.friction import AngleRange, Friction, ValueRange, WindowedLoad
from ilmek.dynamics.input_loads import Drag, FollowerForce, TabulatedLoad
from ilmek.dynamics.joint_friction import JointFriction, PinFriction, SlideFriction
from ilmek.dynamics.loads import Load, PointForce, Torque
from ilmek.dynamics.own_machine import NamedLoad, PinMember
from ilmek.dynamics.springs import Spring, TorsionSpring
from ilmek.errors import MechanismError
from ilmek.io.mechanism.masses import Tables
from ilmek.io.mechanism.names import input_of, unknown, value_of
from ilmek.io.mechanism.points import complex_of, polar
from ilmek.io.schema import SourceText, Table
from ilmek.linkage.model import Input, Joint, Mechanism, Rotation, Slide

TIME = "time"
"""What a table is over in place of an input."""


def loads_of(data: Table, mechanism: Mechanism, source: SourceText) -> tuple[NamedLoad, ...]:
    """The loads, springs and dampers of a file whose data satisfy the schema. Raises MechanismError with the line."""
    kinds = {"loads": _load, "springs": _spring, "dampers": _spring}
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
    body, point = _spot(table["on"], mechanism)
    if "drag" in table:
        return Drag(body, point, table["drag"])
    if not table["friction"] >= 0:
        raise MechanismError(f"friction is {table['friction']:g} N", allowed="0 or more")
    if "while" in table:
        entry, window = _window(table["while"], mechanism)
        return Friction(body, point, table["friction"], entry.name, window)
    return Friction(body, point, table["friction"], input_of(table.get("over"), mechanism).name)


def _force(table: Table, mechanism: Mechanism) -> PointForce | FollowerForce:
    body, point = _spot(table["on"], mechanism)
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
    return (FollowerForce if table.get("frame") == "body" else PointForce)(body, point, force)


def _tabulated(table: Table, unit: str, load: Load, mechanism: Mechanism) -> Load:
    if "table" not in table:
        if "over" in table:
            raise MechanismError("`over` is given without a table", do="give the table, or use `while`")
        return load
    timed = table.get("over", TIME if any(row[0].unit == "s" for row in table["table"]) else None) == TIME
    entry = None if timed else input_of(table.get("over"), mechanism)
    turning = isinstance(entry, Rotation)
    at_unit = "s" if timed else "rad" if turning else "m"
    at = tuple(value_of(row[0], at_unit, "the first of a row") for row in table["table"])
    factors = tuple(value_of(row[1], unit, "the second of a row") for row in table["table"])
    return TabulatedLoad(load, None if entry is None else entry.name, at, factors, turning)


def _window(table: Table, mechanism: Mechanism) -> tuple[Input, AngleRange | ValueRange]:
    entry = input_of(table.get("input"), mechanism)
    turning = isinstance(entry, Rotation)
    start, end = (value_of(table[key], "rad" if turning else "m", key) for key in ("from", "to"))
    if not turning and not start < end:
        raise MechanismError(f"the range from {start:g} m to {end:g} m is empty", do="give a greater value in `to`")
    return entry, AngleRange(start, end) if turning else ValueRange(start, end)


def _spot(spot: Sequence[str], mechanism: Mechanism) -> tuple[str, str]:
    """A body and its point. Raises MechanismError if the mechanism does not have them."""
    body, point = spot
    mechanism.point(body, point)
    return body, point


def _spring(table: Table, mechanism: Mechanism) -> Load:
    stiffness, damping = table.get("stiffness", 0.0), table.get("damping", 0.0)
    if "torsion" in table:
        first, second = table["torsion"]
        for body in (first, second):
            mechanism.body(body)
        _check_apart(first, second)
        return TorsionSpring(first, second, stiffness, table.get("angle", 0.0), damping)
    (first, first_point), (second, second_point) = (_spot(one, mechanism) for one in table["between"])
    _check_apart(first, second)
    return Spring(first, first_point, second, second_point, stiffness, table.get("length", 0.0), damping)


def _check_apart(first: str, second: str) -> None:
    if first == second:
        raise MechanismError(f"both ends are on {first!r}", allowed="two bodies")


def frictions_of(
    tables: Tables, parts: Mapping[str, Sequence[Joint]], pins: Mapping[str, PinMember], source: SourceText
) -> tuple[JointFriction, ...]:
    """Friction of the joints of a file.

    parts  joint of the file -> the joints into which it was divided      pins  joint -> its pin
    """
    return tuple(
        friction for name, table in tables.items() for friction in _frictions(name, table, parts, pins, source)
    )


def _frictions(
    name: str, table: Table, parts: Mapping[str, Sequence[Joint]], pins: Mapping[str, PinMember], source: SourceText
) -> Iterator[JointFriction]:
    with source.located("friction", name):
        if name not in parts:
            raise unknown("joint", name, parts)
        slots = [joint for joint in parts[name] if isinstance(joint, Slide)]
        for joint in slots or parts[name]:
            slides = isinstance(joint, Slide)
            size, other = ("breadth", "radius") if slides else ("radius", "breadth")
            if other in table:
                kind = "slide" if slides else "pin"
                raise MechanismError(f"{other} is given for {name!r}, a {kind}", allowed=f"a {kind} has a {size}")
            drag = value_of(table["drag"], "N*s/m" if slides else "N*m*s/rad", "drag") if "drag" in table else 0.0
            if slides:
                in_slot = joint.name != name
                if "breadth" not in table and not in_slot:
                    raise MechanismError(f"slide {name!r} has no breadth", do="give the length of its guide")
                breadth = table.get("breadth", 1.0)  # a pin in a slot transmits no couple, which it would depend on
                yield SlideFriction(joint.name, breadth, table["coefficient"], drag)
                continue
            if "radius" not in table and joint.name not in pins:
                raise MechanismError(f"pin {name!r} has no radius", do="give it, or the pin's diameter in [pins]")
            radius = table["radius"] if "radius" in table else pins[joint.name].diameter / 2
            yield PinFriction(joint.name, radius, table["coefficient"], drag)
