"""The parts list of a tree: a line for each part, with the number of its pieces and the joints that they bring."""

from collections.abc import Container
from dataclasses import replace

from ilmek.part.blanks import size_of
from ilmek.part.making import steps_of
from ilmek.part.part import Part
from ilmek.part.tree import JointKind, Tree
from ilmek.report import BillLine, Joints

_PINS, _SLIDES = Joints(pins=1.0), Joints(slides=1.0)
_FITTED = {JointKind.PIN: _PINS, JointKind.SLIDE: _SLIDES}
_CONTACT = Joints(contacts=1.0)
_WITHOUT = (JointKind.FIXED, JointKind.MISSING)


def bill(tree: Tree, parts: Container[str] | None = None) -> tuple[BillLine, ...]:
    """The lines of the parts list, in the order of the bodies; parts: ids of those that are listed, default: all."""
    joints = _joints(tree)
    return tuple(
        _with_joints(line_of(part, number), joints.get(part.id))
        for part, number in tree.occurrences()
        if parts is None or part.id in parts
    )


def _with_joints(line: BillLine, joints: Joints | None) -> BillLine:
    """The line with joints of all of its pieces."""
    return line if joints is None else replace(line, joints=Joints(*(number / line.number for number in joints)))


def _joints(tree: Tree) -> dict[str, Joints]:
    """The joints of bodies to their parents and those that close loops, by the first part of their first body."""
    counts, joints = tree.counts(), dict[str, Joints]()
    kinds = [(body.joint.kind, body.id) for body in tree.bodies]
    for kind, name in (*kinds, *((closure.kind, closure.bodies[0]) for closure in tree.closures)):
        parts = tree.body(name).occurrences
        if kind not in _WITHOUT and parts:
            first = parts[0].part.id
            own = zip(joints.get(first, Joints()), _FITTED.get(kind, _CONTACT), strict=True)
            joints[first] = Joints(*(before + counts[name] * added for before, added in own))
    return joints


def line_of(part: Part, number: int = 1) -> BillLine:
    """The line of so many pieces of a part, without joints."""
    bought = part.purchase
    return BillLine(
        name=part.title,
        number=number,
        description=size_of(part),
        material=part.material.name if part.material else "",
        kind=part.process,
        mass=part.mass,
        length=bought.length if bought else 0.0,
        power=bought.power if bought else 0.0,
        drives=bought.drives if bought else 0,
        part=part.id,
        steps=steps_of(part),
    )
