"""Where the stock of a frame is welded: parts that touch, move together and share no screw.

A weld belongs to the part whose end meets the other one, and runs round that end; where no end meets, to both long
edges of the other part. Each edge has a fillet where one part reaches beyond the other, else a bevel [`weld_seams`].
Throats: that of the part where strength sets it, else 0.7 of the thinner wall, as strong as the wall
[`elements.fillet_welds`].
"""

import math
from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import Float
from ilmek.elements.fillet_welds import THROATS, largest_throat, preheating, throat_for
from ilmek.part.contacts import Touch, joined_by, touches
from ilmek.part.folding import folded_sheet
from ilmek.part.forms import form_of
from ilmek.part.making import seams
from ilmek.part.part import LASER_CUT, WELDED, Part
from ilmek.part.placement import IDENTITY
from ilmek.part.shapes import Prism, Sum, Turned, shape_box
from ilmek.part.tree import Tree
from ilmek.part.weld_seams import PlacedPiece, flat_contact, sides_of, weld_seams
from ilmek.plane.contours import bounds
from ilmek.records import record
from ilmek.units import format_number, mm, um

_WITH = frozenset({WELDED, LASER_CUT})
"""Processes of the parts that it is welded to."""

TUBE, SPIGOT = "steel tube", "turned part"
"""Processes of a tube whose strength sets its throat, and of the spigots that it is welded to at its ends."""

LEG = math.sqrt(2)
"""Leg of a fillet over its throat."""

LONGEST, STITCH, PITCH = 400 * mm, 50 * mm, 150 * mm
"""Length from which a seam that no strength sets is stitched, so that it bends its piece less; length of a stitch and
distance of their beginnings [m]: EN 1993-1-8, 4.5.1 and 4.3.2.2; assumed by this project.
"""

_SHORTEST = 6.0
"""Length of a seam over its throat, at least [EN 1993-1-8, 4.5.1]."""

_THIN_WALL = 3 * mm
"""Wall below which an arc without a melting electrode welds it [m]; assumed by this project."""

_AT_END = 1 * mm
"""Distance from the end of a part within which a contact is one of its end."""


@record
class Weld:
    """A weld of a part: fillets on a face, or bevels between faces that end at one edge.

    other   id of the part that it is welded to; "": its own plates to each other
    throat  a of a fillet, s of a bevel: the thinner wall [m]
    box     corners of the contact, in the part's own axes [m]
    seams   begin and end of each straight seam, in the part's own axes [m]; none: round a circle, the contact
    all_round  the seams close round the contact; else they are at some of its edges
    walls   of the parts, the thinner one first [m]
    pieces  of the part that have it      stitched  seams of `STITCH`, each `PITCH` after the last
    carbon  greater equivalent of both parts
    """

    other: str
    throat: float
    box: Float[np.ndarray, "2 3"]
    seams: Float[np.ndarray, "seams 2 3"]
    all_round: bool
    walls: tuple[float, float]
    pieces: int = 1
    bevel: bool = False
    stitched: bool = False
    carbon: float = 0.0

    @property
    def mark(self) -> str:
        """Its size by ISO 2553 [mm]: a of a throat, s of a depth."""
        return f"{'s' if self.bevel else 'a'}{format_number(self.throat / mm)}"

    @property
    def brazed(self) -> bool:
        """Whether it is brazed: thinner than a fillet."""
        return self.throat < THROATS[0] - um

    @property
    def process(self) -> str:
        """Number of its process, ISO 4063: torch brazing, tungsten inert gas on thin walls, metal active gas."""
        return "912" if self.brazed else "141" if self.walls[0] < _THIN_WALL - um else "135"

    @property
    def preheat(self) -> float:
        """Temperature to which its parts are preheated [degrees Celsius]; 0: they are not."""
        return preheating(self.walls[0] if self.bevel else self.throat, *self.walls, self.carbon)

    @property
    def too_thick(self) -> bool:
        """Whether a fillet burns through the thinner wall."""
        return not (self.bevel or self.brazed) and self.throat > largest_throat(self.walls[0]) + um

    @property
    def middle(self) -> Float[np.ndarray, " 3"]:
        """Middle of the contact, in the part's own axes [m]."""
        return np.asarray(self.box.mean(axis=0))

    @property
    def lengths(self) -> tuple[float, ...]:
        """Length of each seam [m]; of one that is all round its whole length, of a stitched one of each stitch."""
        if not len(self.seams):
            return (float(np.pi * np.ptp(self.box, axis=0).max()),)
        each = np.linalg.norm(np.ptp(self.seams, axis=1), axis=1).tolist()
        if self.stitched:
            return (STITCH,) * sum(1 + int((length - STITCH) // PITCH) for length in each)
        return (sum(each),) if self.all_round else tuple(each)


def welded_together(one: Part, other: Part) -> bool:
    """Whether two parts are welded where they touch."""
    if _is_joined(one, other) or _is_joined(other, one):
        return True
    processes = {one.process, other.process}
    return WELDED in processes and processes <= _WITH and not (one.fixing or other.fixing)


def _is_joined(part: Part, other: Part) -> bool:
    return part.material is not None and other.id in part.joins


@lru_cache(maxsize=8)
def welds_of(tree: Tree) -> Mapping[str, tuple[Weld, ...]]:
    """The welds of a tree by the ids of the parts whose sheets have them, like ones once."""
    welds: dict[str, dict[object, Weld]] = defaultdict(dict)
    for part, _ in tree.occurrences():
        if part.process == LASER_CUT and isinstance(part.shape, Sum):
            welds[part.id].update(enumerate(_of_plates(part, part.shape)))
    for name, weld in (own for _, welded in _joints(tree) for own in welded):
        key = weld.other, weld.bevel, weld.all_round, tuple(np.round(weld.middle, 4))
        like = welds[name].get(key)
        welds[name][key] = weld if like is None else replace(like, pieces=like.pieces + 1)
    return {name: tuple(own.values()) for name, own in welds.items()}


def arc_partners(tree: Tree) -> Mapping[str, frozenset[str]]:
    """The ids of the parts to which an arc welds each part of a tree: what it distorts is machined after."""
    partners: dict[str, set[str]] = defaultdict(set)
    for name, own in welds_of(tree).items():
        for weld in own:
            if weld.other and not weld.brazed:
                partners[name].add(weld.other)
                partners[weld.other].add(name)
    return {name: frozenset(others) for name, others in partners.items()}


def welded_pairs(tree: Tree) -> frozenset[frozenset[str]]:
    """Ids of the parts that welds join, by two: where they touch there is an edge for a seam."""
    return frozenset(frozenset(pair) for pair, welded in _joints(tree) if welded)


@lru_cache(maxsize=8)
def _joints(tree: Tree) -> tuple[tuple[tuple[str, str], tuple[tuple[str, Weld], ...]], ...]:
    """Ids of parts that are welded to each other, with the welds of each contact by the ids of their parts."""
    parts = {part.id: part for part, _ in tree.occurrences()}
    tubes = frozenset(name for name, part in parts.items() if part.process == TUBE and part.throat > 0)
    spigots = frozenset(name for name, part in parts.items() if part.process == SPIGOT)
    stock = frozenset(name for name, part in parts.items() if part.process == WELDED) | tubes
    screws = frozenset(name for name, part in parts.items() if part.process == "fastener")
    screwed = [frozenset(pair) for pair in joined_by(tree, screws).values()] if screws else []
    plates = frozenset(name for name, part in parts.items() if part.process in _WITH and not part.fixing)
    stated = {frozenset((name, other)) for name, part in parts.items() if part.material for other in part.joins}
    named = frozenset(name for ids in stated for name in ids)
    joints = list[tuple[tuple[str, str], tuple[tuple[str, Weld], ...]]]()
    for pair in touches(tree, plates | tubes | (spigots if tubes else frozenset()) | named):
        ids = frozenset(touch.part for touch in pair)
        stocked = ids & stock and ids <= plates | tubes | spigots and not (ids & spigots and not ids & tubes)
        if ids in stated or (stocked and not any(ids <= joined for joined in screwed)):
            first, second = (touch.part for touch in pair)
            carbon = max(material.carbon for name in ids if (material := parts[name].material) is not None)
            welds = tuple((name, replace(weld, carbon=carbon)) for name, weld in _welds(pair, parts))
            joints.append(((first, second), welds))
    return tuple(joints)


def _of_plates(part: Part, shape: Sum) -> Iterator[Weld]:
    """The welds of plates that are one part, along the edges of what they share."""
    for box, pieces in seams(shape):
        thinner, thicker = sorted(min(_walls(own)) for own, _ in pieces)
        yield from _seamed("", np.stack(box), pieces, part.throat, (thinner, thicker))


def _welds(pair: tuple[Touch, Touch], parts: Mapping[str, Part]) -> Iterator[tuple[str, Weld]]:
    """The welds of a contact with the id of their part: that whose end it is, or the thinner one."""
    ends = [
        touch
        for touch in pair
        if touch.other in parts[touch.part].joins or _is_end(parts[touch.part], touch.box.mean(axis=0))
    ]
    touch = (ends or sorted(pair, key=lambda own: wall_of(parts[own.part])))[0]
    own, other = parts[touch.part], parts[touch.other]
    assert own.shape is not None
    assert other.shape is not None
    thinner, thicker = sorted((wall_of(own), wall_of(other)))
    walls = thinner, thicker
    if own.process == TUBE and own.throat:  # on the flange of a spigot, round its end
        box, along = touch.box.copy(), np.array(shape_box(own.shape))[:, 2]
        box[:, 2] = along[np.argmin(np.abs(along - box[:, 2].mean()))]
        yield own.id, Weld(other.id, own.throat, box, _ROUND, True, walls)
        return
    strength = own.throat or (0.0 if ends else other.throat)
    if ends and form_of(own.shape).round:
        throat = strength or throat_for(np.inf, *walls)
        yield own.id, Weld(other.id, throat, touch.box, _ROUND, True, walls)
        return
    pieces = (own.shape, IDENTITY), (other.shape, touch.position)
    whole = bool(ends) or any(_is_whole(parts[each.part], each.box) for each in pair)
    welds = list(_seamed(other.id, touch.box, pieces, strength, walls, number=4 if whole else 2))
    if not welds and other.id in own.joins:  # as stated: on a round face, or shorter
        seams = sides_of(touch.box)[:2]
        welds = [Weld(other.id, strength or throat_for(np.inf, *walls), touch.box, seams, False, walls)]
    for weld in welds:
        yield own.id, weld


_ROUND = np.empty((0, 2, 3))
"""Seams of a weld round a circle."""


def _seamed(  # noqa: PLR0917
    other: str,
    box: Float[np.ndarray, "2 3"],
    pieces: tuple[PlacedPiece, PlacedPiece],
    strength: float,
    walls: tuple[float, float],
    number: int = 4,
) -> Iterator[Weld]:
    """The fillets of a contact, and where both pieces end the bevels through the thinner wall.

    strength  throat by it; 0: by the walls [m], the thinner one first      number  of the sides of the box
    """
    throat = strength or throat_for(np.inf, *walls)
    contact = flat_contact(box, pieces)
    if np.sort(np.ptp(contact.box, axis=0))[1] < throat:
        return  # an edge along an edge seats no weld
    least = _SHORTEST * throat if throat >= THROATS[0] else throat
    every = tuple(weld_seams(contact, LEG * throat, least, number=number))
    for bevel in (False, True):
        kept = [seam for seam in every if seam.bevel == bevel]
        if kept:
            ends, whole = np.array([seam.ends for seam in kept]), all(seam.whole for seam in kept) and len(kept) == 4
            long, size = max(seam.length for seam in kept) > LONGEST and not strength, walls[0] if bevel else throat
            yield Weld(other, size, contact.box, ends, whole, walls, bevel=bevel, stitched=long)


def _is_whole(part: Part, box: Float[np.ndarray, "2 3"]) -> bool:
    """Whether a contact is as large as a part across its thin direction: a plate that lies on another part."""
    assert part.shape is not None
    size = np.delete(np.ptp(np.array(shape_box(part.shape)), axis=0), thin := int(np.argmin(np.ptp(box, axis=0))))
    return bool(np.allclose(size, np.delete(np.ptp(box, axis=0), thin), atol=_AT_END))


def _is_end(part: Part, middle: Float[np.ndarray, " 3"]) -> bool:
    """Whether a contact is at an end of stock."""
    if part.process != WELDED or part.shape is None:
        return part.process == TUBE and part.throat > 0
    low, high = shape_box(part.shape)
    return bool(min(abs(middle[2] - low[2]), abs(middle[2] - high[2])) < _AT_END)


def wall_of(part: Part) -> float:
    """Wall of a tube or hollow section, or thickness of a plate [m]."""
    return min(_walls(part.shape))


def _walls(shape: object) -> Iterator[float]:
    if isinstance(shape, Prism):
        sheet = folded_sheet(shape)
        if sheet is not None:
            yield sheet.thickness
        low, high = bounds(shape.section.outline)
        yield from (shape.length, (high - low).real, (high - low).imag)
        for hole in shape.section.holes[:1]:
            begin, end = bounds(hole)
            inside = (high - low - (end - begin)) / 2
            yield from (inside.real, inside.imag)
    elif isinstance(shape, Turned):
        points = shape.profile.outline.points
        yield float(np.ptp(points.imag))
        yield float(np.ptp(points.real[points.imag > shape.outer_radius - um]))  # of a flange
    elif isinstance(shape, Sum):
        for member in shape.members:
            yield from _walls(member.shape)
    else:
        yield float(np.ptp(np.array(shape_box(shape)), axis=0).min())  # type: ignore[arg-type]
