"""What holds the parts of a tree together that stand to each other, and which parts nothing holds.

Parts that touch are joined by a weld, a screw or key, a fit, or by what a bought part brings with it: snaps, threads,
hooks. Of the parts that move together all are held that are joined to each other, directly or by others, and what these
and what turns beside them let move in no direction: a roller on its pin between two cheeks, a spacer. Those that are
not joined to most of them are in the air, though they touch.
"""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from enum import StrEnum
from functools import lru_cache

import numpy as np

from ilmek.elements.locknuts import locknut_of
from ilmek.elements.machine_screws import screw_of
from ilmek.part.contacts import StandingTouches, connected, joined_by, standing_touches
from ilmek.part.meetings import meetings
from ilmek.part.part import Part
from ilmek.part.tree import JointKind, Tree
from ilmek.part.welds import welded_pairs
from ilmek.records import record
from ilmek.units import mm

Pair = frozenset[str]


class Means(StrEnum):
    """By what two parts are held to each other."""

    SCREW = "screw"
    KEY = "key"
    WELD = "weld"
    FIT = "fit"
    OWN = "its own"
    NONE = "none"


OWN = {
    "axis of the control": "its screws in the threads of the plate",
    "levelling foot": "its thread with a nut",
    "belt": "lies round its pulleys",
    "belt and pulleys": "lies round its pulleys",
    "spring": "stands in or hooks into its seats",
    "yarn package": "on its peg",
    "yarn tube": "in its bore",
    "conduit": "clips in its duct",
    "bearing": "between its shoulders",
}
"""How kinds of parts hold themselves, by their process; a single part says it in its `fixing`."""

_ROUND_OTHERS = frozenset({"belt", "belt and pulleys"})
"""Kinds that lie round parts of other bodies, beside which they touch nothing."""


@record
class Fastenings:
    """The contacts of parts that stand to each other by their means, and the ids of parts that none holds."""

    contacts: Mapping[Means, int]
    loose: tuple[str, ...]


@lru_cache(maxsize=4)
def fastenings(tree: Tree) -> Fastenings:
    """What holds the parts of a tree."""
    parts = {part.id: part for part, _ in tree.occurrences()}
    means = _means(tree, parts) | dict.fromkeys(welded_pairs(tree), Means.WELD)
    counted, loose = Counter[Means](), dict[str, None]()
    for group in standing_touches(tree):
        joined, free = list[tuple[int, int]](), list[tuple[int, int]]()
        for pair in group.pairs:
            first, second = (group.parts[number] for number in pair)
            held = means.get(frozenset((first, second))) or _by_itself(parts[first], parts[second])
            counted[held] += 1
            (free if held is Means.NONE else joined).append(pair)
        names = (group.parts[number] for number in _loose(group, joined, free))
        loose |= dict.fromkeys(name for name in names if parts[name].process not in _ROUND_OTHERS)
    return Fastenings(dict(counted), tuple(loose))


def _loose(group: StandingTouches, joined: Sequence[tuple[int, int]], free: Sequence[tuple[int, int]]) -> Iterator[int]:
    """Of pieces that nothing holds to the largest group, nor stand on the floor, those that touch what is held."""
    groups = sorted(connected(len(group.parts), np.array(joined, int).reshape(-1, 2)), key=len, reverse=True)
    standing = [own for own in groups if group.ground and any(group.lowest[number] < _ON_FLOOR for number in own)]
    held = {number for own in standing or groups[:1] for number in own}
    apart = [own for own in groups if own[0] not in held]
    while captive := [own for own in apart if group.captive(own, held)]:
        held.update(number for own in captive for number in own)
        apart = [own for own in apart if own not in captive]
    for own in apart:
        yield from _touch(own, held, free) or own


def _touch(own: Collection[int], others: Collection[int], pairs: Sequence[tuple[int, int]]) -> set[int]:
    """Of some pieces those that touch others."""
    return {number for pair in pairs if not set(pair).isdisjoint(others) for number in pair if number in own}


_ON_FLOOR = 1 * mm
"""Height over the lowest part up to which parts stand on the floor [m]."""


def _means(tree: Tree, parts: Mapping[str, Part]) -> dict[Pair, Means]:
    """By the ids of two parts what joins them."""
    found: dict[Pair, Means] = {}
    for meeting in meetings(tree):
        if meeting.joint is JointKind.FIXED:
            found[frozenset((meeting.bore.part.id, meeting.inner.part.id))] = Means.FIT
    fasteners = {name for name, part in parts.items() if part.process == "fastener"}
    for name, joined in joined_by(tree, frozenset(fasteners)).items():
        purchase = parts[name].purchase
        screwed = purchase is not None and (screw_of(purchase.row) or locknut_of(purchase.row))
        means = Means.SCREW if screwed else Means.KEY
        for other in joined:
            found |= {frozenset((name, other)): means}
            found |= {frozenset((other, third)): means for third in joined if third != other}
    return found


def _by_itself(one: Part, other: Part) -> Means:
    own = one.fixing or other.fixing or {one.process, other.process} & OWN.keys()
    return Means.OWN if own else Means.NONE
