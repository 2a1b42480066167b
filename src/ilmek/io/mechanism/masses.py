"""Masses, sections and pins of a mechanism file: given, of shapes and a material, or of a bar's section."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations, pairwise
from typing import Any

from ilmek.dynamics import shapes
from ilmek.dynamics.inertia import Inertia, bar, combined, point_mass
from ilmek.dynamics.own_machine import FlatMember, FlatShape, PinMember
from ilmek.elements.bearings import find_bearing
from ilmek.elements.materials import find_material
from ilmek.errors import MechanismError
from ilmek.io.declared import FlagEntry, ListEntry, TableEntry, TextEntry, keys, names, quantity, variant
from ilmek.io.mechanism.names import LEAST_SIZE, MATERIAL, size, two_names, unknown, xy_of
from ilmek.io.mechanism.points import AT, POINT, complex_of
from ilmek.io.schema import SourceText, Table
from ilmek.linkage.model import GROUND, Body, Joint, Mechanism, Pin, Slide
from ilmek.records import JsonObject

SECTION = TableEntry(
    "a flat bar: strength, and the mass if no other is given",
    {
        "width": size("m", "in the plane of motion"),
        "thickness": size("m", "across it"),
        "material": TextEntry(MATERIAL),
    },
    {
        "stress": size("Pa", "allowed; default: the material's fatigue limit, or its strength, over `safety`"),
        "safety": size("1", "default: 2"),
    },
    name="section",
)

_MATTER = {
    "thickness": quantity("m"),
    "material": TextEntry(f"{MATERIAL}: gives the density"),
    "density": quantity("kg/m^3"),
    "mass": quantity("kg", "instead of thickness and density", above=0.0),
}
_CENTRE = replace(AT, doc="its centre")

SHAPE = variant(
    keys(
        {"bar": ListEntry("its two ends, with round ends about them", AT, 2, 2), "width": quantity("m")},
        _MATTER,
    ),
    keys({"disc": _CENTRE, "radius": quantity("m")}, _MATTER),
    keys({"ring": _CENTRE, "outer": quantity("m", "radius"), "inner": quantity("m", "radius")}, _MATTER),
    keys({"plate": ListEntry("corners in order", AT, 3, 100)}, _MATTER),
    keys({"point": replace(AT, doc="its position"), "mass": quantity("kg", above=0.0)}),
    name="shape",
)

_INERTIA = {
    "mass": quantity("kg", "default: of the shapes, of the section, else 0"),
    "centre": replace(AT, doc="mass centre; default: the origin, of a link with length its middle"),
    "moment": quantity(
        "kg*m^2", "of inertia about the mass centre; default: 0, of a link with length and no centre m L^2 / 12"
    ),
}
STATED = frozenset(_INERTIA)
"""Keys of a body's inertia."""

BODY = keys(
    {},
    {
        "points": names(POINT, "name -> position in the body's own frame", refers="point"),
        "length": quantity("m", "of a link: from its first joint, at the origin, to its second, on x", above=0.0),
        "between": two_names(
            "the two joints of `length`; default: the two joints of the body that have no point of their own", "point"
        ),
        **_INERTIA,
        "shapes": ListEntry("shapes that form the body: their masses are added", SHAPE, 1, 50),
        "section": SECTION,
    },
    name="body",
)

PIN = keys(
    {},
    {
        "diameter": size("m"),
        "length": size("m", "of the bearing in the bush"),
        "fork": FlagEntry("sheared in two sections; default: true"),
        "shear": size("Pa", "allowed; default: 60 MPa"),
        "bending": size("Pa", "allowed in a fork; default: 105 MPa"),
        "pressure": size("Pa", "allowed mean F / (d l); default: 15 MPa"),
        "wear": size("Pa*m/s", "allowed mean of pressure times sliding speed; default: 1 MPa m/s"),
        "bearing": TextEntry("rolling bearing of the catalogue instead of a bush"),
        "life": quantity("s", "required life of the bearing", least=0.0, written="h"),
    },
    name="pin",
)

Tables = Mapping[str, Table]
"""Name -> table, checked by the schema."""


def sections_of(
    bodies: Tables, links: Table | None, mechanism: Mechanism, joints: Mapping[str, Sequence[str]]
) -> JsonObject:
    """Body -> section: its own, or that of `links` for a link without a mass, shapes or a section of its own.

    joints  body -> names of its joints in the file; a link has two or more, apart from one another
    """
    found: JsonObject = {}
    for name, table in bodies.items():
        if "section" in table:
            found[name] = table["section"]
        elif links is not None and name != GROUND and not table.keys() & {"mass", "shapes"}:
            points = mechanism.body(name).points
            if len({points[joint] for joint in joints[name]}) > 1:
                found[name] = links
    return found


def flat_member(section: Table) -> FlatMember:
    """The section of a link. Raises IlmekError for a material that is not in the table."""
    return FlatMember(**{**section, "material": find_material(section["material"]).name})


def check_link(body: Body, joints: Sequence[str]) -> None:
    """Raise MechanismError for a link with a section whose joints are almost at one point: it has no strength."""
    for first, second in combinations(joints, 2):
        apart = abs(body.points[first] - body.points[second])
        if 0 < apart < LEAST_SIZE:
            given = f"{first} and {second} of {body.name!r} are {apart:g} m apart"
            raise MechanismError(given, allowed=f"0, or {LEAST_SIZE:g} m or more for a link with a section")


def inertia_of(table: Table, body: Body, member: FlatMember | None) -> Inertia | None:
    """The inertia of a body: given, of its shapes, else of bars of its section between its points; None: massless.

    Raises IlmekError for masses that are negative or given twice, and for shapes that cannot be.
    """
    stated = table.keys() & STATED
    if "shapes" in table:
        if stated:
            raise MechanismError(f"{', '.join(sorted(stated))} and shapes are both given", do="leave one of them")
        return combined(*(_shape(one, body) for one in table["shapes"]))
    if not stated:
        return combined(*_bars(body, member)) if member is not None else None
    mass = table.get("mass", 0.0)
    if "length" in table and not stated & {"centre", "moment"}:
        start, end = list(body.points.values())[:2]
        return bar(start, end, mass=mass)
    return Inertia(mass, _at(table.get("centre", [0.0, 0.0]), body), table.get("moment", 0.0))


def _bars(body: Body, member: FlatMember) -> Iterator[Inertia]:
    """Bars of a section from point to point in the file's order, closed for three points or more."""
    positions = list(dict.fromkeys(body.points.values()))
    if len(positions) < 2:
        given = f"body {body.name!r} has a section, but no two points apart"
        raise MechanismError(given, do="give its mass or its shapes")
    ends = [*pairwise(positions), *([(positions[-1], positions[0])] if len(positions) > 2 else [])]
    density = find_material(member.material).density
    for start, end in ends:
        yield shapes.link(start, end, member.width, member.thickness, density)


def _at(at: Any, body: Body) -> complex:
    """A position given by the name of a point or by coordinates [m]."""
    if not isinstance(at, str):
        return complex_of(at)
    if at not in body.points:
        given = f"body {body.name!r} has no point {at!r}"
        raise MechanismError(given, allowed=f"it has {', '.join(body.points) or 'none'}")
    return body.points[at]


def _shape(table: Table, body: Body) -> Inertia:
    if "point" in table:
        return point_mass(table["mass"], _at(table["point"], body))
    by_mass = "mass" in table
    further = table.keys() & {"material", "density", "thickness"}
    if by_mass and further:
        raise MechanismError(f"a shape has a mass and {', '.join(sorted(further))}", do="leave one of them")
    thickness, density = (1.0, 1.0) if by_mass else (table.get("thickness", 0.0), _density(table))
    if not by_mass and "thickness" not in table:
        raise MechanismError("a shape has no thickness", do="give thickness and material, or its mass")
    inertia = _flat(table, body, thickness, density)
    if not by_mass:
        return inertia
    mass = table["mass"]
    return replace(inertia, mass=mass, moment=inertia.moment * mass / inertia.mass)


def _flat(table: Table, body: Body, thickness: float, density: float) -> Inertia:
    if "bar" in table:
        start, end = (_at(one, body) for one in table["bar"])
        return shapes.link(start, end, table["width"], thickness, density)
    if "disc" in table:
        return shapes.disc(table["radius"], thickness, density, at=_at(table["disc"], body))
    if "ring" in table:
        return shapes.ring(table["outer"], table["inner"], thickness, density, at=_at(table["ring"], body))
    return shapes.plate([_at(one, body) for one in table["plate"]], thickness, density)


def shapes_of(table: Table, body: Body) -> tuple[FlatShape, ...]:
    """The shapes of a body that are given with thickness and material, which its parts are made by."""
    made = (one for one in table.get("shapes", ()) if {"thickness", "material"} <= one.keys())
    return tuple(_flat_shape(one, body) for one in made)


def _flat_shape(table: Table, body: Body) -> FlatShape:
    thickness, material = table["thickness"], find_material(table["material"]).name
    if "bar" in table:
        return FlatShape(tuple(_at(one, body) for one in table["bar"]), table["width"] / 2, thickness, material)
    if "plate" in table:
        return FlatShape(tuple(_at(one, body) for one in table["plate"]), 0.0, thickness, material)
    middle, outer = (table["disc"], table["radius"]) if "disc" in table else (table["ring"], table["outer"])
    return FlatShape((_at(middle, body),), outer, thickness, material, table.get("inner", 0.0))


def _density(table: Table) -> float:
    given = table.keys() & {"material", "density", "mass"}
    if len(given) != 1:
        stated = " and ".join(sorted(given)) or "no mass"
        raise MechanismError(f"a shape has {stated}", allowed="one of material, density and mass")
    return find_material(table["material"]).density if "material" in table else float(table["density"])


def body_data(body: Body, inertia: Inertia | None, member: FlatMember | None) -> JsonObject:
    """The table of a body."""
    data: JsonObject = {"points": {name: xy_of(point) for name, point in body.points.items()}}
    if inertia is not None:
        data |= {**BODY.given(inertia), "centre": xy_of(inertia.centre)}
    if member is not None:
        data["section"] = SECTION.given(member)
        data.setdefault("mass", 0.0)  # else the section would give the body a mass
    return data


def pin_members(tables: Tables, parts: Mapping[str, Sequence[Joint]], source: SourceText) -> dict[str, PinMember]:
    """Joint -> its pin; a pin of several bodies is one pin with several pairs of bodies.

    parts  joint of the file -> the joints into which it was divided
    """
    pin_members: dict[str, PinMember] = {}
    for name, table in tables.items():
        with source.located("pins", name):
            if name not in parts or isinstance(parts[name][0], Slide):
                raise unknown("pin", name, [joint for joint, own in parts.items() if isinstance(own[0], Pin)])
            member = PinMember(**_pin_of(table))
            pin_members |= {joint.name: member for joint in parts[name] if isinstance(joint, Pin)}
    return pin_members


def _pin_of(table: Table) -> JsonObject:
    """A pin's table with the bore and width of its bearing where it has no sizes of its own."""
    made: JsonObject = {"bearing": None}
    if "bearing" in table:
        bearing = find_bearing(table["bearing"])
        made = {"diameter": bearing.bore, "length": bearing.width}
        table = {**table, "bearing": bearing.name}
    for key in ("diameter", "length"):
        if key not in table and key not in made:
            raise MechanismError(f"has no {key!r}", allowed="it needs diameter and length, or a bearing")
    return {**made, **table}
