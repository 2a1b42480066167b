"""The assembly manual of a machine: its bodies in the order that their joints allow, with what comes, screws, pictures.

A body comes after what carries it and after the bodies that close loops with it and stand before it in the tree; so the
order is that of the tree, machine by machine.
"""

from collections.abc import Iterator, Sequence
from itertools import groupby

from ilmek.elements.hexagon_screws import screw_of
from ilmek.part.part_lists import FASTENER
from ilmek.part.projection import PieceOutline, View, outlines
from ilmek.part.tree import JointKind, RigidBody, Tree
from ilmek.records import record
from ilmek.report import Column, Drawing, Paper, PaperSection, Stroke, Table
from ilmek.sentences import Sentence
from ilmek.units import format_quantity

OWN = "automated-loom"
"""Machine of the bodies that are the loom's own."""

MOST_CURVES = 400
"""Most outlines of a picture: the largest; a smaller one would be a spot."""


@record
class AssemblyStep:
    """A step of the manual: its number, its body, how often the body is there."""

    number: int
    body: RigidBody
    copies: int


def assembly_steps(tree: Tree) -> tuple[AssemblyStep, ...]:
    """The bodies of a tree, each after what carries it: the first stands on the ground."""
    counts = tree.counts()
    return tuple(AssemblyStep(number, body, counts[body.id]) for number, body in enumerate(tree.bodies, 1))


def machine_of(body: RigidBody) -> str:
    """The machine of a body, by its id."""
    machine, dash, _ = body.id.partition("/")
    return machine if dash else OWN


def tree_manual(tree: Tree, view: View, how: str) -> Paper:
    """A section for the bodies of each machine that follow each other, with a picture from a side and its steps.

    how  the order came about, for people
    """
    seen = outlines(tree, view)
    standing: set[str] = set()
    sections = [PaperSection(Sentence("manual.order"), (how,))]
    for machine, grouped in groupby(assembly_steps(tree), key=lambda step: machine_of(step.body)):
        steps = tuple(grouped)
        coming = {step.body.id for step in steps}
        sections.append(_section(machine, steps, _picture(seen, standing, coming, _CAPTIONS[view])))
        standing |= coming
    sections.append(PaperSection(Sentence("manual.then"), (Sentence("manual.then-how"),)))
    return Paper("assembly-manual", Sentence("manual.title"), Sentence("manual.lead"), tuple(sections))


def _section(machine: str, steps: Sequence[AssemblyStep], picture: Drawing) -> PaperSection:
    first, last = str(steps[0].number), str(steps[-1].number)
    title = Sentence("manual.machine", machine=machine.replace("-", " "), first=first, last=last)
    heads = (
        Column(Sentence("manual.step")),
        Column(Sentence("manual.body")),
        Column(Sentence("manual.onto")),
        Column(Sentence("joint.joint")),
        Column(Sentence("manual.comes")),
        Column(Sentence("manual.mass"), "kg", 3),
        Column(Sentence("manual.tighten")),
    )
    table = Table("steps", title, heads, tuple(_row(step) for step in steps))
    return PaperSection(title, (picture.title,), table, boxes=True, figure=picture)


def _row(step: AssemblyStep) -> tuple[float | int | str, ...]:
    body = step.body
    name = body.id.rpartition("/")[2]
    copies = f"{step.copies} × " if step.copies > 1 else ""
    parts = (f"{len(own.positions)} × {own.part.title}" for own in body.occurrences if own.part.process != FASTENER)
    onto = body.parent.rpartition("/")[2] or Sentence("joint.stand")
    screws = "; ".join(_screws(body))
    return (
        step.number,
        f"{copies}{name}",
        onto,
        _JOINTS[body.joint.kind],
        "; ".join(parts),
        body.moments.zeroth,
        screws,
    )


def _screws(body: RigidBody) -> Iterator[str]:
    """Screws with their torque, and keys, of a body."""
    for own in body.occurrences:
        if own.part.process == FASTENER and own.part.purchase is not None:
            screw = screw_of(own.part.purchase.row)
            torque = "" if screw is None else f", {format_quantity(screw.torque, 'Nm', 3)}"
            yield f"{len(own.positions)} × {own.part.purchase.row}{torque}"


def _picture(seen: Sequence[PieceOutline], standing: set[str], coming: set[str], caption: str) -> Drawing:
    """What stands, dashed, and what comes, in bold lines: the largest outlines of both."""
    shown = sorted((own for own in seen if own.body in standing | coming), key=_extent, reverse=True)[:MOST_CURVES]
    strokes = [
        Stroke(curve, "outline" if own.body in coming else "construction", closed=True)
        for own in sorted(shown, key=lambda own: own.body in coming)
        for curve in own.curves
    ]
    return Drawing("assembly", caption, tuple(strokes), unit="mm")


def _extent(outline: PieceOutline) -> float:
    return max(float(abs(curve - outline.middle).max()) for curve in outline.curves)


_CAPTIONS = {
    View.SIDE: Sentence("manual.picture"),
    View.FRONT: Sentence("joint.from-front"),
    View.TOP: Sentence("joint.from-top"),
}

_JOINTS = {
    JointKind.FIXED: Sentence("joint.fixed"),
    JointKind.PIN: Sentence("joint.pin"),
    JointKind.SLIDE: Sentence("joint.slide"),
    JointKind.SCREW: Sentence("joint.screw"),
    JointKind.ROLLING: Sentence("joint.rolling"),
    JointKind.TRANSMISSION: Sentence("joint.transmission"),
    JointKind.CAM: Sentence("joint.cam"),
    JointKind.MISSING: Sentence("joint.missing"),
}
"""Kinds of joints in words."""
