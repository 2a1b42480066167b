"""The mechanism of a file: bodies, joints, couplings, inputs, branches."""

from collections.abc import Iterator, Mapping, Sequence, Set

from ilmek.errors import MechanismError, did_you_mean
from ilmek.io.mechanism.joints import blocks_of, joints_of, members_of
from ilmek.io.mechanism.names import value_of
from ilmek.io.mechanism.pairs import law_of_pair
from ilmek.io.mechanism.points import check_lengths, complex_of, points_of
from ilmek.io.schema import Measured, SourceText, Table
from ilmek.linkage.drawing import as_drawn
from ilmek.linkage.model import (
    GROUND,
    KINDS,
    BeltSpans,
    Body,
    Coupling,
    Displacement,
    Input,
    Joint,
    Mechanism,
    Rotation,
    Slide,
)
from ilmek.linkage.redundant import without_redundant
from ilmek.plane.teeth import PRESSURE_ANGLE


def mechanism_of(data: Table, source: SourceText) -> Mechanism:
    """The mechanism of data that satisfy the schema. Raises MechanismError with the line and the key."""
    name = data.get("name", "mechanism")
    _check_bodies(data, name, source)
    members = members_of(data["joints"])
    with source.located("joints"):
        joints = joints_of(data["joints"], data["inputs"], data.get("couplings", {}))
    points = {body: points_of(body, table, members, joints, source) for body, table in data["bodies"].items()}
    _check_points(points, members, name, source)
    with source.located():
        mechanism = Mechanism(
            bodies=(*(Body(body, own) for body, own in points.items()), *blocks_of(data["joints"], points)),
            joints=joints,
            inputs=tuple(_input(joint, body, joints, members) for joint, body in data["inputs"].items()),
            branches=data.get("branches", {}),
            name=name,
            couplings=tuple(_couplings(data.get("couplings", {}), joints, source)),
            redundant=data.get("redundant", ()),
            pose={body: (complex_of(pose["origin"]), pose["angle"]) for body, pose in data.get("pose", {}).items()},
        )
        for entry in mechanism.inputs:
            _check_driven(mechanism, entry, data["inputs"])
        mechanism = as_drawn(without_redundant(mechanism))
    if "lengths" not in data.get("confirm", ()):
        check_lengths(points, members, source)
    return mechanism


def _check_bodies(data: Table, name: str, source: SourceText) -> None:
    """Raise MechanismError for a joint with an unknown body, or twice with the same."""
    known = data["bodies"]
    for joint, bodies in members_of(data["joints"]).items():
        for body in bodies:
            if body not in known:
                allowed = f"it has {', '.join(known) or 'none'}"
                error = MechanismError(f"{name} has no body {body!r}", allowed=allowed, do=did_you_mean(body, known))
                source.refuse(("joints", joint), error)
        if len(set(bodies)) < len(bodies):
            twice = next(body for body in bodies if bodies.count(body) > 1)
            source.refuse(("joints", joint), MechanismError(f"joint {joint!r} of {name} joins {twice!r} to itself"))


def _check_points(
    points: Mapping[str, Mapping[str, complex]], members: Mapping[str, tuple[str, ...]], name: str, source: SourceText
) -> None:
    """Raise MechanismError for a body without a point at one of its joints."""
    for joint, bodies in members.items():
        for body in bodies:
            if joint not in points[body]:
                allowed = f"it has {', '.join(points[body]) or 'none'}"
                error = MechanismError(f"body {body!r} of {name} has no point {joint!r}", allowed=allowed)
                source.refuse(("joints", joint), error)


def _input(joint: str, body: str, joints: tuple[Joint, ...], members: Mapping[str, tuple[str, ...]]) -> Input:
    """The input at a joint of the file; of a pin of several bodies, at the pin that holds the driven body."""
    parts = [
        one
        for one in joints
        if one.name == joint or (len(members.get(joint, ())) > 2 and one.name.startswith(f"{joint}."))
    ]
    if any(isinstance(part, Slide) for part in parts):
        return Displacement(joint)
    holding = [part.name for part in parts if body in part.bodies]
    return Rotation(body, holding[0] if holding else joint)


def _check_driven(mechanism: Mechanism, entry: Input, bodies: Mapping[str, str]) -> None:
    """Raise MechanismError if an input at a slide names another body than the sliding one."""
    joint = mechanism.joint(entry.joint)
    if isinstance(joint, Slide) and bodies[joint.name] != joint.body:
        given = f"slide {joint.name!r} is driven by {bodies[joint.name]!r}"
        raise MechanismError(given, allowed=f"its sliding body is {joint.body!r}", about=("inputs", joint.name))


def _couplings(tables: Table, joints: Sequence[Joint], source: SourceText) -> Iterator[Coupling]:
    sliding = {joint.name for joint in joints if isinstance(joint, Slide)}
    for name, table in tables.items():
        with source.located("couplings", name):
            yield _coupling(name, table, sliding)


def _coupling(name: str, table: Table, sliding: Set[str]) -> Coupling:
    kind = next(kind for kind in KINDS if kind in table)
    first, second = (tuple(end) for end in table[kind])
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
