"""Layers of a linkage in depth, found by search: the least number in which nothing meets over a motion.

Each body has one layer, the plate that stands layer 0. Layer k is slot 2 k, the room above it slot 2 k + 1:

    plate   its body's slot
    pin     all between its lowest body and its highest
    ring    the slot of a pin's highest body and the room above it; of one that is fixed in its highest body the slot of
            its lowest and the room below it; a shaft may be of one piece with its link, without a ring
    slide   rail and carriage: all between the body that guides and the one that slides, above or below it

Two things whose slots overlap must keep apart in the plane over the whole motion; a pin does not meet the plates that
it joins, nor a carriage its rail. Layers that nothing lies in can be left out, so that more layers than bodies help
nobody: the search, depth first with the next number of layers where one fails, tries all. Of the assignments of the
least number it returns that with the shortest pins, or after `MOST_TRIED` assignments the best until then.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from itertools import combinations

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.model import GROUND
from ilmek.plane.outlines import Outline, between
from ilmek.records import record
from ilmek.units import mm

CLEAR = 0.5 * mm
"""Least distance in the plane of what lies in one layer [m]: the play of the joints between, and of the making; assumed
by this project."""

MOST_TRIED = 50_000
"""Assignments of a body to a layer that are tried for one number of layers."""


@record
class BodyPath:
    """Where a body's frame lies at the samples of a motion: origin [m], and the unit vector along its x axis."""

    origin: ComplexArray
    direction: ComplexArray

    def points(self, local: ComplexArray) -> ComplexArray:
        """Points of the body at the samples, (samples, points)."""
        return np.asarray(self.origin[:, None] + self.direction[:, None] * local)


class RoomKind(StrEnum):
    """What takes room."""

    PLATE = "plate"
    PIN = "pin"
    RING = "ring"
    SLIDE = "slide"


class RingSide(StrEnum):
    """Where the ring of a pin is: above its highest body, below its lowest, or nowhere."""

    ABOVE = "above"
    BELOW = "below"
    NONE = "none"


@record
class Room:
    """What lies in the plane of motion and takes room in depth.

    name      of the body's plate, the pin or the slide      body  that it moves with
    joins     bodies between whose layers it lies: of a plate its own
    outlines  in the body's frame [m]
    kind      what it is      sides  where a ring can be, the best first
    """

    name: str
    body: str
    joins: tuple[str, ...]
    outlines: tuple[Outline, ...]
    kind: RoomKind
    sides: tuple[RingSide, ...] = (RingSide.ABOVE,)

    def slots(self, layers: Mapping[str, int], side: RingSide = RingSide.ABOVE) -> tuple[int, int] | None:
        """First and last slot by the layers of the bodies that have one; None: none has, or a slide or ring lacks one.

        side  of a ring
        """
        known = [layers[body] for body in self.joins if body in layers]
        if not known or (self.kind in {RoomKind.SLIDE, RoomKind.RING} and len(known) < len(self.joins)):
            return None
        low, high = 2 * min(known), 2 * max(known)
        if self.kind in {RoomKind.SLIDE, RoomKind.PIN}:
            return low + 1, high - 1
        if self.kind is RoomKind.RING:
            return {RingSide.ABOVE: (high, high + 1), RingSide.BELOW: (low - 1, low), RingSide.NONE: None}[side]
        return low, high


@record
class Layering:
    """Layers of bodies by name, the ground's 0, and sides of the rings by the names of their pins.

    found   whether nothing meets in them; else they are those of the bodies in their order, and something does
    tried   assignments of a body to a layer that were tried
    """

    layers: Mapping[str, int]
    found: bool
    tried: int
    sides: Mapping[str, RingSide] = field(default_factory=dict)

    @property
    def number(self) -> int:
        """Number of layers above the plate that stands."""
        return max(self.layers.values())


def apart(first: Room, other: Room, paths: Mapping[str, BodyPath]) -> float:
    """Distance in the plane [m] that two things are sure to keep over a motion; 0 or less: they may meet.

    Between two samples a point moves no further than half a step from the nearer of them: so much is taken off.

    >>> still = {"a": BodyPath(np.zeros(2, complex), np.ones(2, complex))}
    >>> outlines = Outline((0j,), 0.01), Outline((0.05 + 0j, 0.05 + 1j), 0.01)
    >>> disc, bar = (Room("plate", "a", ("a",), (outline,), RoomKind.PLATE) for outline in outlines)
    >>> round(apart(disc, bar, still), 9)
    0.03
    """
    here, there = paths[first.body], paths[other.body]
    back = np.conj(here.direction)
    away = BodyPath((there.origin - here.origin) * back, there.direction * back)
    least = np.inf
    for outline in other.outlines:
        moved = away.points(outline.corners)
        step = float(np.abs(np.diff(moved, axis=0)).max(initial=0.0)) / 2
        for own in first.outlines:
            gap: FloatArray = between(own.corners, moved) - own.radius - outline.radius
            least = min(least, float(gap.min()) - step)
    return least


def meeting(rooms: Sequence[Room], paths: Mapping[str, BodyPath]) -> Iterator[tuple[Room, Room]]:
    """The pairs that come nearer than `CLEAR` in the plane, but for those that a joint puts into one another."""
    for first, other in combinations(rooms, 2):
        if not _joined(first, other) and apart(first, other, paths) < CLEAR:
            yield first, other


def _joined(first: Room, other: Room) -> bool:
    """Whether two rooms are of one body, of one pin or slide, or of a pin or slide and a body that it joins."""
    if RoomKind.PLATE not in {first.kind, other.kind}:
        return first.name == other.name
    return first.body == other.body if first.kind is other.kind else bool({*first.joins} & {*other.joins})


def layering(bodies: Sequence[str], rooms: Sequence[Room], pairs: Sequence[tuple[Room, Room]]) -> Layering:
    """The layers of moving bodies whose rooms meet in pairs; not found: with each body in a layer of its own.

    >>> Layering({GROUND: 0, "crank": 1, "rod": 2}, True, 3).number
    2
    """
    tried = 0
    for number in range(1, len(bodies) + 1):
        search = _Search(tuple(bodies), tuple(rooms), tuple(pairs), number)
        search.fill(0)
        tried += search.tried
        if search.best is not None:
            return Layering(search.best, True, tried, search.sides)
    sides = {room.name: room.sides[0] for room in rooms if room.kind is RoomKind.RING}
    return Layering({GROUND: 0, **{body: at for at, body in enumerate(bodies, 1)}}, False, tried, sides)


@dataclass(slots=True)
class _Search:
    """The assignments of bodies to a number of layers, one after the other."""

    bodies: tuple[str, ...]
    rooms: tuple[Room, ...]
    pairs: tuple[tuple[Room, Room], ...]
    number: int
    layers: dict[str, int] = field(default_factory=lambda: {GROUND: 0})
    best: dict[str, int] | None = None
    least: float = float("inf")
    tried: int = 0
    sides: dict[str, RingSide] = field(default_factory=dict)
    concerned: dict[str, list[tuple[Room, Room]]] = field(default_factory=dict)
    slides: dict[str, list[Room]] = field(default_factory=dict)
    rings: list[Room] = field(default_factory=list)

    def __post_init__(self) -> None:
        """The bodies that most others meet come first: what cannot be is found early."""
        for body in self.bodies:
            self.concerned[body] = [
                pair
                for pair in self.pairs
                if body in pair[0].joins + pair[1].joins and RoomKind.RING not in {pair[0].kind, pair[1].kind}
            ]
            self.slides[body] = [room for room in self.rooms if room.kind is RoomKind.SLIDE and body in room.joins]
        self.rings = [room for room in self.rooms if room.kind is RoomKind.RING]
        self.bodies = tuple(sorted(self.bodies, key=lambda body: -len(self.concerned[body])))

    def fill(self, at: int) -> None:
        """Try all layers of the body at a place of the order, and of those after it."""
        if at == len(self.bodies):
            sides: dict[str, RingSide] = {}
            if self.ringed(0, sides):
                self.least, self.best, self.sides = self.length(), dict(self.layers), sides
            return
        body = self.bodies[at]
        for layer in range(1, self.number + 1):
            if self.tried >= MOST_TRIED:
                return
            self.tried += 1
            self.layers[body] = layer
            if self.clear(body) and self.length() < self.least:
                self.fill(at + 1)
            del self.layers[body]

    def length(self) -> float:
        """Sum of the lengths of pins and slides, in slots; of what is placed."""
        slots = (room.slots(self.layers) for room in self.rooms if room.kind is not RoomKind.PLATE)
        return sum(last - first for first, last in (slot for slot in slots if slot is not None))

    def ringed(self, at: int, sides: dict[str, RingSide]) -> bool:
        """Whether the rings from one on have a side on which they meet nothing; sides  of those before it."""
        if at == len(self.rings):
            return True
        ring = self.rings[at]
        for side in ring.sides:
            sides[ring.name] = side
            if self.ring_clear(ring, sides) and self.ringed(at + 1, sides):
                return True
            del sides[ring.name]
        return False

    def ring_clear(self, ring: Room, sides: Mapping[str, RingSide]) -> bool:
        """Whether a ring meets nothing, of other rings those that have a side."""
        for first, other in self.pairs:
            if ring in (first, other):
                met = other if ring is first else first
                if (met.kind is not RoomKind.RING or met.name in sides) and _overlap(
                    *(one.slots(self.layers, sides.get(one.name, RingSide.ABOVE)) for one in (ring, met))
                ):
                    return False
        return True

    def clear(self, body: str) -> bool:
        """Whether what lies between the bodies placed so far keeps apart, as far as it concerns the last of them."""
        for slide in self.slides[body]:
            slots = slide.slots(self.layers)
            if slots is not None and slots[0] > slots[1]:
                return False  # the guide and what slides on it are in one layer
        return not any(
            _overlap(first.slots(self.layers), other.slots(self.layers)) for first, other in self.concerned[body]
        )


def _overlap(first: tuple[int, int] | None, other: tuple[int, int] | None) -> bool:
    if first is None or other is None or first[0] > first[1] or other[0] > other[1]:
        return False
    return first[0] <= other[1] and other[0] <= first[1]
