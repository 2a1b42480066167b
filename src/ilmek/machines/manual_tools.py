"""What an assembly step needs besides its parts: keys of its screws, lifting gear, thread lock, grease."""

from collections import Counter
from collections.abc import Iterator, Mapping

from ilmek.elements.machine_screws import screw_of
from ilmek.part.part import Part
from ilmek.part.part_lists import FASTENER
from ilmek.part.poses import chains
from ilmek.part.tree import JointKind, Tree
from ilmek.report import Column, PaperSection, Table
from ilmek.sentences import Sentence
from ilmek.units import in_mm

BY_HAND = 25.0
"""Mass that one person lifts [kg], at most: ISO 11228-1, table C.1."""

GREASED = frozenset(("bearing", "linear guide", "guide carriage", "spring", "energy chain"))
"""Processes of bought parts that are greased as they are mounted."""


def moving_bodies(tree: Tree) -> frozenset[str]:
    """Names of the bodies that move, or ride on one that does: their screws are locked."""
    return frozenset(
        links[-1].name for links in chains(tree) if any(link.body.joint.kind is not JointKind.FIXED for link in links)
    )


def tool_of(designation: str) -> str:
    """The key of a screw in words; "" of what no key turns."""
    screw = screw_of(designation)
    if screw is None:
        return ""
    return Sentence("manual.hexagon-key" if screw.sink else "manual.spanner", size=in_mm(screw.key))


def step_tools(parts: Mapping[Part, int], mass: float, *, moving: bool) -> Iterator[str]:
    """What a step needs: keys of its screws, thread lock where its body moves, grease, and what lifts its mass [kg]."""
    rows = [part.purchase.row for part in parts if part.process == FASTENER and part.purchase is not None]
    keys = dict.fromkeys(filter(None, map(tool_of, rows)))
    yield from keys
    if keys and moving:
        yield Sentence("manual.lock")
    if any(part.process in GREASED for part in parts):
        yield Sentence("manual.grease")
    if mass > BY_HAND:
        yield Sentence("manual.hoist")


def tools_section(screwed: Tree) -> PaperSection:
    """Every key that the screws of a tree need, with their number by designation."""
    screws = Counter[str]()
    for part, number in screwed.occurrences():
        if part.process == FASTENER and part.purchase is not None:
            screws[part.purchase.row] += number
    tools: dict[str, list[str]] = {}
    for row, number in screws.items():
        if tool := tool_of(row):
            tools.setdefault(tool, []).append(f"{number} × {row}")
    title = Sentence("manual.tools-title")
    heads = Column(Sentence("manual.tools")), Column(Sentence("manual.for-screws"))
    rows = tuple((tool, "; ".join(sorted(own))) for tool, own in sorted(tools.items()))
    text = Sentence("manual.tools-how", mass=f"{BY_HAND:g} kg")
    return PaperSection(title, (text,), Table("tools", title, heads, rows))
