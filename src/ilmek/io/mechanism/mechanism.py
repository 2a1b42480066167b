"""The mechanism of a file: bodies, joints, couplings, inputs, branches."""

from collections.abc import Mapping

from ilmek.errors import MechanismError, did_you_mean
from ilmek.io.mechanism.couplings import couplings_of
from ilmek.io.mechanism.cylinders import add_cylinders
from ilmek.io.mechanism.joints import blocks_of, joints_of, members_of
from ilmek.io.mechanism.points import check_lengths, complex_of, points_of
from ilmek.io.schema import SourceText, Table
from ilmek.linkage.drawing import as_drawn
from ilmek.linkage.model import Body, Displacement, Input, Joint, Mechanism, Rotation, Slide
from ilmek.linkage.redundant import without_redundant


def mechanism_of(data: Table, source: SourceText) -> Mechanism:
    """The mechanism of data that satisfy the schema. Raises MechanismError with the line and the key."""
    name = data.get("name", "mechanism")
    _check_bodies(data, name, source)
    members = members_of(data["joints"])
    with source.located("joints"):
        joints = joints_of(data["joints"], data["inputs"], data.get("couplings", {}))
    points = {body: points_of(body, table, members, joints, source) for body, table in data["bodies"].items()}
    _check_points(points, members, name, source)
    pose = {body: (complex_of(table["origin"]), table["angle"]) for body, table in data.get("pose", {}).items()}
    parts, further = add_cylinders(data.get("cylinders", {}), points, pose, source)
    joints = (*joints, *further)
    with source.located():
        mechanism = Mechanism(
            bodies=(*(Body(body, own) for body, own in points.items()), *blocks_of(data["joints"], points), *parts),
            joints=joints,
            inputs=tuple(_input(joint, body, joints, members) for joint, body in data["inputs"].items()),
            branches=data.get("branches", {}),
            name=name,
            couplings=tuple(couplings_of(data.get("couplings", {}), joints, source)),
            redundant=data.get("redundant", ()),
            pose=pose,
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
