"""What an assembly step needs besides its parts: keys of its screws, lifting gear, thread lock, grease."""

from collections import Counter
from collections.abc import Iterator, Mapping

from ilmek.part.part import Part
from ilmek.part.poses import chains
from ilmek.part.tightening import tightening_of
from ilmek.part.tree import JointKind, Tree
from ilmek.report import Column, PaperSection, Table
from ilmek.sentences import Sentence

BY_HAND = 25.0
"""Mass that one person lifts [kg], at most: ISO 11228-1, table C.1."""

GREASED = frozenset(("bearing", "linear guide", "guide carriage", "spring", "energy chain"))
"""Processes of bought parts that are greased as they are mounted."""


def moving_bodies(tree: Tree) -> frozenset[str]:
    """Names of the bodies that move, or ride on one that does: their screws are locked."""
    return frozenset(
        links[-1].name for links in chains(tree) if any(link.body.joint.kind is not JointKind.FIXED for link in links)
    )


def step_tools(parts: Mapping[Part, int], mass: float, *, moving: bool) -> Iterator[str]:
    """What a step needs: keys of its screws, thread lock where its body moves, grease, and what lifts its mass [kg]."""
    turned = [own for part in parts if (own := tightening_of(part))]
    yield from dict.fromkeys(tool for own in turned for tool in own.tools)
    if turned and moving:
        yield Sentence("manual.lock")
    if any(part.process in GREASED for part in parts):
        yield Sentence("manual.grease")
    if mass > BY_HAND:
        yield Sentence("manual.hoist")


def tools_section(screwed: Tree) -> PaperSection:
    """Every key that the screws, nuts and anchors of a tree need, with their number by designation."""
    tools = dict[str, Counter[str]]()
    for part, number in screwed.occurrences():
        if turned := tightening_of(part):
            for tool in turned.tools:
                tools.setdefault(tool, Counter())[turned.designation] += number * turned.number
    title = Sentence("manual.tools-title")
    heads = Column(Sentence("manual.tools")), Column(Sentence("manual.for-screws"))
    rows = tuple(
        (tool, "; ".join(f"{number} × {name}" for name, number in sorted(own.items())))
        for tool, own in sorted(tools.items())
    )
    text = Sentence("manual.tools-how", mass=f"{BY_HAND:g} kg")
    return PaperSection(title, (text,), Table("tools", title, heads, rows))
