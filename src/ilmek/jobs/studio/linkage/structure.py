"""The structure of a mechanism in plain data: bodies, joints, degrees of freedom, Assur groups."""

import dataclasses

from ilmek.io.mechanism.names import is_part
from ilmek.io.schema import Table
from ilmek.jobs.studio.linkage.answer import (
    BodyAnswer,
    CouplingAnswer,
    GroupAnswer,
    InputAnswer,
    JointAnswer,
    LinkageFault,
    Structure,
)
from ilmek.linkage.drawing import branches_as_drawn
from ilmek.linkage.groups.group import Step
from ilmek.linkage.model import GROUND, Joint, Mechanism, Rotation, Slide, degrees_of_freedom


def bodies_of(mechanism: Mechanism, known: set[str]) -> tuple[BodyAnswer, ...]:
    """All bodies; `known` are located."""
    return tuple(
        BodyAnswer(body.name, {name: (xy.real, xy.imag) for name, xy in body.points.items()}, body.name in known)
        for body in mechanism.bodies
    )


def joints_of(mechanism: Mechanism, file_joints: Table) -> tuple[JointAnswer, ...]:
    """All joints of two bodies."""
    return tuple(_joint(joint, file_joints) for joint in mechanism.joints)


def _joint(joint: Joint, file_joints: Table) -> JointAnswer:
    own = joint.name
    if own not in file_joints:
        own = next((name for name in file_joints if is_part(joint.name, name)), own)
    if isinstance(joint, Slide):
        return JointAnswer(joint.name, own, "slide", joint.bodies, joint.along, joint.turned)
    return JointAnswer(joint.name, own, "pin", joint.bodies)


def couplings_of(mechanism: Mechanism) -> tuple[CouplingAnswer, ...]:
    """All gears, belts and racks."""
    return tuple(
        CouplingAnswer(gear.name, gear.kind, *gear.ends, gear.carrier, gear.ratio) for gear in mechanism.couplings
    )


def inputs_of(mechanism: Mechanism) -> tuple[InputAnswer, ...]:
    """All inputs."""
    return tuple(
        InputAnswer(entry.name, entry.joint, "rotation" if isinstance(entry, Rotation) else "displacement")
        for entry in mechanism.inputs
    )


def structure_of(
    mechanism: Mechanism, steps: tuple[Step, ...], loose: tuple[str, ...], missing: LinkageFault | None
) -> Structure:
    """Degrees of freedom, loops and groups, in the order of solution."""
    known, groups, drawn = {GROUND}, [], branches_as_drawn(mechanism)
    for step in steps:
        groups.append(dataclasses.replace(_group(mechanism, step, known), drawn=step.free in drawn))
        known.update(step.bodies)
    return Structure(
        degrees_of_freedom(mechanism),
        len(mechanism.inputs),
        len(mechanism.joints) + len(mechanism.couplings) - len(mechanism.bodies) + _connected_parts(mechanism),
        tuple(groups),
        tuple(body for body in mechanism.moving if body not in known),
        loose,
        missing,
    )


def _connected_parts(mechanism: Mechanism) -> int:
    """Number of parts of a mechanism that no joint connects."""
    part = {body.name: body.name for body in mechanism.bodies}
    for joint in mechanism.joints:
        old, new = (part[body] for body in joint.bodies)
        part = {body: new if own == old else own for body, own in part.items()}
    return len(set(part.values()))


def _group(mechanism: Mechanism, step: Step, known: set[str]) -> GroupAnswer:
    own = set(step.bodies)
    joints = [joint.name for joint in mechanism.joints if own & set(joint.bodies) and set(joint.bodies) <= own | known]
    sign = mechanism.branches[step.free] if step.free else 0
    return GroupAnswer(step.kind, step.symbol, step.bodies, tuple(joints), step.description, sign, step.free)
