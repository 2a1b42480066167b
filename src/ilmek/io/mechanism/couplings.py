"""Couplings of a mechanism file: gears, belts, racks, cams, Geneva wheels."""

from collections.abc import Iterator, Sequence, Set
from dataclasses import replace

from ilmek.errors import MechanismError
from ilmek.io.declared import FlagEntry, ListEntry, TextEntry, WholeEntry, keys, quantity, variant
from ilmek.io.mechanism.motions import step_data, steps_entry, table_rows
from ilmek.io.mechanism.names import ANGLE, LENGTH, position_of_input, two_spots, value_of
from ilmek.io.mechanism.pairs import CamLift, LiftTable, law_of_pair
from ilmek.io.schema import Measured, SourceText, Table
from ilmek.linkage.couplings import KINDS, BeltSpans, Coupling
from ilmek.linkage.geneva import Geneva
from ilmek.linkage.model import GROUND, Joint, Slide
from ilmek.plane.teeth import PRESSURE_ANGLE
from ilmek.records import JsonObject

_WHEELS = two_spots("two wheels, each a body and its point in the middle")
_SECOND = "the same of the second; of a rack the slide's displacement"
_CARRIER = {"carrier": TextEntry("the body that carries both; default: the ground", "body")}
_MESH = {
    "first_at": replace(ANGLE, doc="angle of the first against the carrier, as assembled"),
    "second_at": replace(ANGLE, doc=_SECOND),
}
_TEETH = {
    "pressure_angle": replace(ANGLE, doc="of the teeth at the pitch point, at most 45 degrees; default: 20 degrees")
}

_GEARS = keys(
    {
        "gears": _WHEELS,
        "ratio": quantity(
            "1", "-z1/z2, the teeth of the first by those of the second; without the sign where one is inside the other"
        ),
        **_MESH,
    },
    {**_CARRIER, **_TEETH},
)

_BELT = keys(
    {
        "belt": _WHEELS,
        "ratio": quantity("1", "r1/r2, the first's radius by the second's; with a minus sign for a crossed belt"),
        **_MESH,
    },
    {
        **_CARRIER,
        "radius": quantity(
            "m",
            "of the first pulley: for the forces of the spans; without it the forces that depend on them are not "
            "determined",
        ),
        "pretension": quantity("N", "force of each span at rest; default: 0, a chain, whose slack span has no force"),
        "friction": quantity(
            "1", "coefficient on the pulleys: for the grip of a flat belt; default: teeth, which do not slip"
        ),
    },
)

_RACK = keys(
    {
        "rack": two_spots("the pinion and its middle; the rack and its slide"),
        "ratio": quantity("m/rad", "travel per radian of the pinion: its pitch radius, with a sign"),
        **_MESH,
        "second_at": replace(LENGTH, doc=_SECOND),
    },
    {**_CARRIER, **_TEETH},
)

_CAM = keys(
    {"cam": two_spots("the cam and its middle; the follower and its slide, or its pin")},
    {
        **_CARRIER,
        "first_at": replace(ANGLE, doc="angle of the cam against the carrier at which its law begins; default: 0"),
        "second_at": position_of_input(
            "of the follower at lift 0: displacement of its slide, or its angle; default: 0"
        ),
        "roller": TextEntry(
            "point of the follower in the middle of its roller; default: a flat face square to its slide"
        ),
        "groove": FlagEntry("whether the cam also pulls; default: false"),
        "lift": steps_entry(
            "lifts and dwells that fill one turn of the cam",
            keys({"to": position_of_input("lift at the end"), "over": quantity("rad", "angle of the cam", above=0.0)}),
            "angle of the cam at rest",
            "rad",
        ),
        "table": ListEntry(
            "[[angle of the cam, lift], ...] from 0 to 360 degrees, with a smooth curve through them",
            ListEntry("angle and lift", position_of_input(), 2, 2),
            4,
            1000,
        ),
    },
)

_GENEVA = keys(
    {
        "geneva": two_spots("the crank and its middle; the wheel and its middle"),
        "slots": WholeEntry(
            "number of slots; the pin's radius is sin(180 degrees / slots) of the centres' distance", 3, 100
        ),
        "first_at": replace(ANGLE, doc="angle of the crank against the carrier with its pin between the centres"),
        "second_at": replace(ANGLE, doc="angle of the wheel then"),
    },
    _CARRIER,
)

COUPLING = variant(_GEARS, _BELT, _RACK, _CAM, _GENEVA, name="coupling")


def couplings_of(tables: Table, joints: Sequence[Joint], source: SourceText) -> Iterator[Coupling]:
    """The couplings of a file. Raises MechanismError with the line."""
    sliding = {joint.name for joint in joints if isinstance(joint, Slide)}
    for name, table in tables.items():
        with source.located("couplings", name):
            yield _coupling(name, table, sliding)


def _coupling(name: str, table: Table, sliding: Set[str]) -> Coupling:
    kind = next(kind for kind in KINDS if kind in table)
    first, second = table[kind]
    law = law_of_pair(kind, table, slides=second[1] in sliding)
    second_at = table.get("second_at", 0.0)
    if isinstance(second_at, Measured):
        second_at = value_of(second_at, "m" if law is not None and law.slides else "rad", "second_at")
    return Coupling(
        name,
        kind,
        first,
        second,
        table.get("ratio", 0.0),
        table.get("first_at", 0.0),
        second_at,
        table.get("carrier", GROUND),
        table.get("pressure_angle", PRESSURE_ANGLE),
        law,
        table.get("roller", ""),
        _spans(table),
    )


def _spans(table: Table) -> BeltSpans | None:
    """The spans of a belt that is given with a radius. Raises MechanismError for a tension without one."""
    if "radius" in table:
        return BeltSpans(table["radius"], table.get("pretension", 0.0), table.get("friction"))
    if table.keys() & {"pretension", "friction"}:
        raise MechanismError("a belt has a tension or friction and no radius", do="give the radius of its first pulley")
    return None


def coupling_data(coupling: Coupling) -> JsonObject:
    """The table of a coupling. Raises MechanismError for a law that no file can express."""
    ends: JsonObject = {coupling.kind: coupling.ends}
    table, law = COUPLING.table(ends), coupling.law
    data = {**ends, **table.given(coupling), **table.given(coupling.spans)}
    if law is None or isinstance(law, Geneva):
        return data | table.given(law)
    if not isinstance(law, CamLift | LiftTable):
        raise MechanismError(f"the law of {coupling.name!r} is a function that no file expresses")
    unit = "m" if law.slides else "rad"
    data |= {"second_at": Measured(coupling.second_at, unit), "groove": law.groove}
    if not coupling.roller:
        del data["roller"]
    if isinstance(law, LiftTable):
        return {**data, "table": table_rows(law.angles, "rad", law.lifts, unit)}
    return {**data, "lift": [step_data(step, unit, "over") for step in law.steps]}
