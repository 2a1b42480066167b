"""Friction of the joints of a mechanism file."""

from collections.abc import Iterator, Mapping, Sequence

from ilmek.dynamics.joint_friction import JointFriction, PinFriction, SlideFriction
from ilmek.dynamics.own_machine import PinMember
from ilmek.errors import MechanismError
from ilmek.io.declared import keys, quantity
from ilmek.io.mechanism.masses import Tables
from ilmek.io.mechanism.names import unknown, value_of
from ilmek.io.schema import Measured, SourceText, Table
from ilmek.linkage.model import Joint, Slide
from ilmek.records import JsonObject

FRICTION = keys(
    {"coefficient": quantity("1")},
    {
        "radius": quantity("m", "of a pin; default: half its diameter in `pins`"),
        "breadth": quantity("m", "of a slide: length of the guide along the line"),
        "drag": quantity(("N*m*s/rad", "N*s/m"), "viscous; default: 0"),
    },
    name="friction",
)


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


def friction_data(friction: JointFriction) -> JsonObject:
    """The table of a joint's friction."""
    unit = "N*m*s/rad" if isinstance(friction, PinFriction) else "N*s/m"
    return {**FRICTION.given(friction), "drag": Measured(friction.drag, unit)}
