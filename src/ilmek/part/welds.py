"""Where the stock of a frame is welded: fillet welds between parts that touch, move together and share no screw.

A weld belongs to the part whose end meets the other one, and runs all round that end; where no end meets, to both
edges of the other part. Throats: that of the part where strength sets it, else 0.7 of the thinner wall, which is as
strong as the wall [`elements.fillet_welds`].
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import Float
from ilmek.elements.fillet_welds import throat_for
from ilmek.part.contacts import Touch, joined_by, touches
from ilmek.part.forms import form_of
from ilmek.part.making import seams
from ilmek.part.part import LASER_CUT, WELDED, Part
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.shapes import Prism, Sum, Turned, shape_box
from ilmek.part.tree import Tree
from ilmek.plane.contours import along, bounds
from ilmek.records import record
from ilmek.units import mm

_WITH = frozenset({WELDED, LASER_CUT})
"""Processes of the parts that it is welded to."""

TUBE, SPIGOT = "steel tube", "turned part"
"""Processes of a tube whose strength sets its throat, and of the spigots that it is welded to at its ends."""

_FLUSH = 0.05 * mm
"""Distance from an edge within which a seam is one of it [m]."""

_AT_END = 1 * mm
"""Distance from the end of a part within which a contact is one of its end."""


@record
class Weld:
    """A fillet weld of a part.

    other   id of the part that it is welded to; "": its own plates to each other          throat  a [m]
    box     corners of the contact, in the part's own axes [m]
    seams   begin and end of each straight seam, in the part's own axes [m]; none: round a circle, the contact
    all_round  the seams close round the contact; else they are at its long edges
    pieces  of the part that have it
    """

    other: str
    throat: float
    box: Float[np.ndarray, "2 3"]
    seams: Float[np.ndarray, "seams 2 3"]
    all_round: bool
    pieces: int = 1

    @property
    def middle(self) -> Float[np.ndarray, " 3"]:
        """Middle of the contact, in the part's own axes [m]."""
        return np.asarray(self.box.mean(axis=0))

    @property
    def lengths(self) -> tuple[float, ...]:
        """Length of each seam [m]; of one that is all round its whole length."""
        if not len(self.seams):
            return (float(np.pi * np.ptp(self.box, axis=0).max()),)
        each = np.linalg.norm(np.ptp(self.seams, axis=1), axis=1).tolist()
        return (sum(each),) if self.all_round else tuple(each)


def welded_together(one: Part, other: Part) -> bool:
    """Whether two parts are welded where they touch."""
    if _is_joined(one, other) or _is_joined(other, one):
        return True
    processes = {one.process, other.process}
    return WELDED in processes and processes <= _WITH


def _is_joined(part: Part, other: Part) -> bool:
    return part.material is not None and other.id in part.joins


@lru_cache(maxsize=8)
def welds_of(tree: Tree) -> Mapping[str, tuple[Weld, ...]]:
    """The welds of a tree by the ids of the parts whose sheets have them, like ones once."""
    parts = {part.id: part for part, _ in tree.occurrences()}
    tubes = frozenset(name for name, part in parts.items() if part.process == TUBE and part.throat > 0)
    spigots = frozenset(name for name, part in parts.items() if part.process == SPIGOT)
    stock = frozenset(name for name, part in parts.items() if part.process == WELDED) | tubes
    screws = frozenset(name for name, part in parts.items() if part.process == "fastener")
    screwed = [frozenset(pair) for pair in joined_by(tree, screws).values()] if screws else []
    welds: dict[str, dict[object, Weld]] = defaultdict(dict)
    for part in parts.values():
        if part.process == LASER_CUT and isinstance(part.shape, Sum):
            welds[part.id].update(enumerate(_of_plates(part, part.shape)))
    plates = frozenset(name for name, part in parts.items() if part.process in _WITH)
    stated = {frozenset((name, other)) for name, part in parts.items() if part.material for other in part.joins}
    named = frozenset(name for ids in stated for name in ids)
    for pair in touches(tree, plates | tubes | (spigots if tubes else frozenset()) | named):
        ids = frozenset(touch.part for touch in pair)
        stocked = ids & stock and ids <= plates | tubes | spigots and not (ids & spigots and not ids & tubes)
        if ids not in stated and (not stocked or any(ids <= joined for joined in screwed)):
            continue
        name, weld = _weld(pair, parts)
        if np.sort(np.ptp(weld.box, axis=0))[1] < weld.throat:
            continue  # an edge along an edge seats no fillet
        key = weld.other, weld.all_round, tuple(np.round(weld.middle, 4))
        like = welds[name].get(key)
        welds[name][key] = weld if like is None else replace(like, pieces=like.pieces + 1)
    return {name: tuple(own.values()) for name, own in welds.items()}


def _of_plates(part: Part, shape: Sum) -> Iterator[Weld]:
    """The welds of plates that are one part, all round what they share."""
    wall = min(min(_walls(member.shape)) for member in shape.members)
    for low, high in seams(shape):
        box = np.stack([low, high])
        yield Weld("", part.throat or throat_for(np.inf, wall), box, _sides(box), all_round=True)


def _weld(pair: tuple[Touch, Touch], parts: Mapping[str, Part]) -> tuple[str, Weld]:
    """The weld of a contact with the id of its part: that whose end it is, or the thinner one."""
    ends = [
        touch
        for touch in pair
        if touch.other in parts[touch.part].joins or _is_end(parts[touch.part], touch.box.mean(axis=0))
    ]
    touch = (ends or sorted(pair, key=lambda own: wall_of(parts[own.part])))[0]
    own, other = parts[touch.part], parts[touch.other]
    if own.process == TUBE and own.shape is not None:  # on the flange of a spigot, round its end
        box, along = touch.box.copy(), np.array(shape_box(own.shape))[:, 2]
        box[:, 2] = along[np.argmin(np.abs(along - box[:, 2].mean()))]
        return own.id, Weld(other.id, own.throat, box, _sides(box)[:0], all_round=True)
    strength = own.throat or (0.0 if ends else other.throat)
    throat = strength or throat_for(np.inf, min(wall_of(own), wall_of(other)))
    sides = _sides(touch.box)
    if ends and own.shape is not None and form_of(own.shape).round:
        return own.id, Weld(other.id, throat, touch.box, sides[:0], all_round=True)
    trimmed = [_trimmed(_trimmed(side, touch.box, own, IDENTITY), touch.box, other, touch.position) for side in sides]
    whole = bool(ends) and np.allclose(trimmed, sides, atol=_FLUSH)
    kept = trimmed if ends else trimmed[:2]
    seams = np.array([side for side in kept if np.linalg.norm(side[1] - side[0]) > throat])
    return own.id, Weld(other.id, throat, touch.box, sides if whole else seams.reshape(-1, 2, 3), whole)


def _sides(box: Float[np.ndarray, "2 3"]) -> Float[np.ndarray, "4 2 3"]:
    """The sides of a flat box, both long ones first."""
    thin, across, along = np.argsort(np.ptp(box, axis=0), kind="stable")
    corners = np.repeat(box[:1], 4, axis=0)
    corners[:, thin] = box[:, thin].mean()
    corners[1:3, along], corners[2:, across] = box[1, along], box[1, across]
    return np.asarray(corners[[[0, 1], [3, 2], [0, 3], [1, 2]]])


def _trimmed(
    side: Float[np.ndarray, "2 3"], box: Float[np.ndarray, "2 3"], part: Part, position: Placement
) -> Float[np.ndarray, "2 3"]:
    """What a side of a contact has on the end face of a prism; of other shapes the whole side."""
    shape = part.shape
    thin = position.rotation[int(np.argmin(np.ptp(box, axis=0))), 2]
    if not isinstance(shape, Prism) or abs(float(thin)) < 1 - 1e-9:
        return side
    inward = box.mean(axis=0) - side.mean(axis=0)
    lies = position.inverse.points(side + inward * min(1.0, _FLUSH / max(float(np.linalg.norm(inward)), _FLUSH)))
    start, end = lies[:, 0] + 1j * lies[:, 1]
    if abs(end - start) < _FLUSH:
        return side
    points = (along(shape.section.outline, _FLUSH) - start) / (end - start)
    after = np.roll(points, -1)
    crossed = (points.imag > 0) != (after.imag > 0)
    share = points.imag[crossed] / (points.imag[crossed] - after.imag[crossed])
    crossings = np.sort(points.real[crossed] + share * (after.real[crossed] - points.real[crossed]))
    inside = [(max(low, 0.0), min(high, 1.0)) for low, high in crossings.reshape(-1, 2).tolist()]
    low, high = max(inside, key=lambda ends: ends[1] - ends[0], default=(0.0, 0.0))
    return np.asarray(side[0] + np.array([[low], [max(low, high)]]) * (side[1] - side[0]))


def _is_end(part: Part, middle: Float[np.ndarray, " 3"]) -> bool:
    """Whether a contact is at an end of stock."""
    if part.process != WELDED or part.shape is None:
        return part.process == TUBE
    low, high = shape_box(part.shape)
    return bool(min(abs(middle[2] - low[2]), abs(middle[2] - high[2])) < _AT_END)


def wall_of(part: Part) -> float:
    """Wall of a tube or hollow section, or thickness of a plate [m]."""
    return min(_walls(part.shape))


def _walls(shape: object) -> Iterator[float]:
    if isinstance(shape, Prism):
        low, high = bounds(shape.section.outline)
        yield from (shape.length, (high - low).real, (high - low).imag)
        for hole in shape.section.holes[:1]:
            begin, _ = bounds(hole)
            yield from ((begin - low).real, (begin - low).imag)
    elif isinstance(shape, Turned):
        low, high = bounds(shape.profile.outline)
        yield (high - low).imag
    else:
        yield float(np.ptp(np.array(shape_box(shape)), axis=0).min())  # type: ignore[arg-type]
