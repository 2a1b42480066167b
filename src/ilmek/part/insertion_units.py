"""What is put in as one when a tree is put together: its parts and bodies as units, each where it stands.

A body that moves comes as one, with the keys between its parts; of bodies that stand each part. Screws that lie side by
side come as one, rings by themselves. A body that is there several times comes with all that it carries. Directions: of
a part along its seat, of a body along its joint, and along the axes of the tree; of screws and rings along their axes.
"""

from collections import Counter, defaultdict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import count, groupby
from typing import TypeAlias

import numpy as np
from scipy.spatial import ConvexHull

from ilmek.arrays import Float
from ilmek.elements.machine_screws import screw_of
from ilmek.elements.retaining_rings import RetainingRing, ring_of
from ilmek.part.colliders import COARSE, MANY, collider
from ilmek.part.part import LASER_CUT, WELDED, Part
from ilmek.part.part_lists import BELTS, FASTENER
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.seat_axes import meeting_axes, seat_axis
from ilmek.part.shapes import Placed, Shape, Sum, box_corners, shape_box, tube
from ilmek.part.stacks import StackRun, stack_runs
from ilmek.part.straight_moves import FIT, FittedSolid, MovedSolids, Vector, fitted
from ilmek.part.tree import STANDING, Tree
from ilmek.records import record
from ilmek.report.scene import Solid

_MOST_ALIKE = 100
"""Parts in a row of which no more than the first, the middle and the last of each kind are compared with others."""

_DIGITS = 6
"""Digits of a direction at which two are the same."""

Direction: TypeAlias = tuple[float, ...]
Box: TypeAlias = tuple[Vector, Vector]
Axes: TypeAlias = tuple[Direction, ...]


@record
class StandingPart:
    """A part where it stands in the tree, of the body with this id."""

    part: Part
    body: str
    position: Placement

    @property
    def box(self) -> Box:
        """Its least and greatest coordinates [m]."""
        points = self.position.points(box_corners(*shape_box(_shape(self.part))))
        return points.min(0), points.max(0)


@dataclass(frozen=True, eq=False)
class InsertedUnit:
    """What is put in as one.

    number  in the order of the tree      name  of its body      pieces  its parts
    directions  in which it may begin to leave: of a part along its seat first      carriers  bodies that carry it
    inner   the units that it is made of on the bench, or one by one of screws; none: a part, or a row of like parts
    fastens whether it is a screw or key
    """

    number: int
    name: str
    pieces: tuple[StandingPart, ...]
    directions: Axes
    carriers: frozenset[str] = frozenset()
    inner: tuple["InsertedUnit", ...] = ()

    @property
    def parts(self) -> Mapping[Part, int]:
        """Its parts, how many of each."""
        counted = Counter(piece.part.id for piece in self.pieces)
        return {piece.part: counted[piece.part.id] for piece in self.pieces}

    @property
    def stack(self) -> tuple[StackRun, ...]:
        """Of several kinds of parts that alternate along an axis: their order."""
        if self.inner or len(self.parts) == 1 or len(self.pieces) < MANY * len(self.parts):
            return ()
        return stack_runs([(piece.part, piece.position) for piece in self.pieces])

    @property
    def fastens(self) -> bool:
        """Whether it is screws, or a key."""
        return len(self.parts) == 1 and self.pieces[0].part.process == FASTENER

    @property
    def is_stock(self) -> bool:
        """Whether it is welded: it leaves after what is only screwed to the same body."""
        return self.pieces[0].part.process in {WELDED, LASER_CUT}

    @property
    def yields(self) -> bool:
        """Whether it is a belt, which is put over the flanges of the pulleys on which it lies."""
        return len(self.pieces) == 1 and self.pieces[0].part.process in BELTS

    @property
    def first_moves(self) -> tuple[float, ...]:
        """Lengths by which it comes out of what it is in [m]: of a screw its thread."""
        part = self.pieces[0].part
        screw = screw_of(part.purchase.row) if self.fastens and part.purchase else None
        return (float(np.ptp(shape_box(_shape(part)), axis=0).max()) - screw.head + 2 * FIT,) if screw else ()

    @cached_property
    def solid(self) -> MovedSolids:
        """It where it stands, smaller by its fit."""
        return _placed(self.pieces, -FIT)

    @cached_property
    def opened(self) -> MovedSolids:
        """It as it moves: a retaining ring is opened until it passes over its shaft."""
        ring = _ring(self.pieces[0].part)
        if ring is None:
            return self.solid
        low, _ = shape_box(_shape(self.pieces[0].part))
        wide = Sum((Placed(tube(ring.room, (ring.room - ring.shaft) / 2, ring.thickness), (placement(z=low[2]),)),))
        return MovedSolids([(_of_shape(wide, -FIT), piece.position) for piece in self.pieces])

    @cached_property
    def grown(self) -> MovedSolids:
        """It where it stands, larger by its fit: it cuts what it touches."""
        return _placed(self.pieces, FIT)


def _placed(pieces: Sequence[StandingPart], by: float) -> MovedSolids:
    """Parts, their faces moved outwards by a length [m]; `MANY` like ones among others by the hull of all."""
    alike: dict[str, list[StandingPart]] = defaultdict(list)
    for piece in pieces:
        alike[piece.part.id].append(piece)
    solids: list[tuple[FittedSolid, Placement]] = []
    for own in alike.values():
        shape = _shape(own[0].part)
        row = all(len(same) >= MANY for same in alike.values())
        own = [own[0], own[len(own) // 2], own[-1]] if row and len(pieces) > _MOST_ALIKE else own
        if len(own) >= MANY and not row:
            corners = collider(shape).corners
            hull = _hull(np.concatenate([piece.position.points(corners) for piece in own]))
            solids.append((fitted(hull, by), IDENTITY))
        else:
            solids += [(_of_shape(shape, by), piece.position) for piece in own]
    return MovedSolids(solids)


@lru_cache(maxsize=4096)
def _of_shape(shape: Shape, by: float) -> FittedSolid:
    own = collider(shape)
    return fitted(shape.mesh(COARSE) if own.large else own.solid, by)


def _hull(points: Float[np.ndarray, "points 3"]) -> Solid:
    """The convex hull of points."""
    hull = ConvexHull(points)
    triangles = hull.simplices.copy()
    first, second, third = points[triangles].swapaxes(0, 1)
    inwards = (np.cross(second - first, third - first) * hull.equations[:, :3]).sum(1) < 0
    triangles[inwards] = triangles[inwards][:, ::-1]
    return Solid(points, triangles)


def units_of(tree: Tree) -> tuple[InsertedUnit, ...]:
    """The units of a tree with every drive at angle 0; parts without a shape are left out."""
    return tuple(_units(list(chains(tree)), 0, count(), meeting_axes(tree)))


def _units(
    every: Sequence[Chain], depth: int, numbers: Iterator[int], seats: Mapping[str, Vector]
) -> Iterator[InsertedUnit]:
    """The units of chains beyond their first links, which carry all of them."""
    grouped: dict[Chain, list[Chain]] = defaultdict(list)
    for links in every:
        several = (k for k in range(depth, len(links)) if len(links[k].body.positions) > 1)
        grouped[links[: next(several, len(links) - 1) + 1]].append(links)
    for prefix, own in grouped.items():
        link, axes = prefix[-1], _axes(prefix)
        carriers = frozenset(before.name for before in prefix[depth:-1] if before.body.joint.kind not in STANDING)
        pieces = tuple(piece for links in own for piece in standing_parts(links))
        if pieces and len(prefix) > depth and len(link.body.positions) > 1:
            inner = tuple(_units(own, len(prefix), numbers, seats)) if link.index == 0 else ()
            yield InsertedUnit(next(numbers), link.name, pieces, axes, carriers, inner)
            continue
        single = tuple(_of_body(pieces, axes, carriers, numbers, seats))
        if len(prefix) <= depth or link.body.joint.kind in STANDING:
            yield from single
            continue
        kept = tuple(unit for unit in single if not _comes_after(unit, single))
        if kept:
            whole = tuple(piece for unit in kept for piece in unit.pieces)
            inner = kept if len(kept) > 1 else ()
            yield InsertedUnit(kept[0].number, link.name, whole, axes, carriers, inner)  # before its own screws
        yield from (unit for unit in single if unit not in kept)


def standing_parts(links: Chain) -> Iterator[StandingPart]:
    """The parts of the last body of a chain where they stand."""
    here = poses(links, "", np.zeros(1))
    body = Placement(here.origin[0], here.rotation[0])
    for occurrence in links[-1].body.occurrences:
        if occurrence.part.shape is not None:
            for position in occurrence.positions:
                yield StandingPart(occurrence.part, links[-1].name, body.after(position))


def _of_body(
    pieces: Sequence[StandingPart],
    axes: Axes,
    carriers: frozenset[str],
    numbers: Iterator[int],
    seats: Mapping[str, Vector],
) -> Iterator[InsertedUnit]:
    """The parts of a body, each as a unit; as one `MANY` like ones, rows of these that alternate along an axis, and
    screws of one kind that lie side by side.
    """
    alike = [tuple(same) for _, same in groupby(pieces, key=lambda piece: piece.part.id)]
    stacks: dict[Hashable, list[StandingPart]] = defaultdict(list)
    for number, own in enumerate(alike):
        lines = {_line(piece) for piece in own} if len(own) >= MANY else set()
        stacks[lines.pop() if len(lines) == 1 else number] += own
    for same in stacks.values():
        rows = [tuple(same)] if len(same) >= MANY else [(piece,) for piece in same]
        if is_screw(same[0].part):
            rows = [tuple(own) for _, own in groupby(sorted(same, key=_end), key=_end)]
        for own in rows:
            part, along = own[0].part, own[0].position.rotation[:, 2]
            seat = own[0].position.rotation @ seat_axis(part, seats)
            axial = own[-1].part is not part or _ring(part) is not None
            across = _both(own[0].position.rotation[:, 0]) if part.process == FASTENER else ()
            ends = _both(along) if axial else (*_both(seat), *axes, *_both(along), *across)
            ends = _both(along)[1:] if is_screw(part) else tuple(dict.fromkeys(ends))
            several = own if is_screw(part) and len(own) > 1 else ()
            inner = tuple(InsertedUnit(next(numbers), own[0].body, (piece,), ends, carriers) for piece in several)
            yield InsertedUnit(next(numbers), own[0].body, own, ends, carriers, inner)


def _comes_after(unit: InsertedUnit, body: Sequence[InsertedUnit]) -> bool:
    """Whether it comes after its body: screws, rings, and a key of which no hub is in the body."""
    if is_screw(unit.pieces[0].part) or _ring(unit.pieces[0].part):
        return True
    low, high = unit.solid.box
    meet = [own for own in body if (low < own.solid.box[1]).all() and (own.solid.box[0] < high).all()]
    return unit.fastens and len(meet) < len({"key", "shaft", "hub"})


def _line(piece: StandingPart) -> tuple[float, ...]:
    """The z axis of a piece: its direction, and the point on it that is nearest to the origin [m], rounded."""
    along = piece.position.rotation[:, 2]
    foot = piece.position.origin - along * (along @ piece.position.origin)
    return (*(along.round(3) + 0.0).tolist(), *(foot.round(4) + 0.0).tolist())


def _end(screw: StandingPart) -> tuple[float, ...]:
    """Direction of a screw, and where it begins along it [m], rounded."""
    along = screw.position.rotation[:, 2]
    return (*(along.round(3) + 0.0).tolist(), round(float(along @ screw.position.origin), 4))


def is_screw(part: Part) -> bool:
    """Whether a part is a screw of a catalogue."""
    return part.purchase is not None and screw_of(part.purchase.row) is not None


def _ring(part: Part) -> RetainingRing | None:
    return None if part.purchase is None else ring_of(part.purchase.row)


def _shape(part: Part) -> Shape:
    assert part.shape is not None
    return part.shape


def _axes(links: Chain) -> Axes:
    """Directions of the joint of the last body of a chain, and of the tree's axes."""
    here = poses(links, "", np.zeros(1))
    joint = here.rotation[0] @ np.array(links[-1].body.joint.axis, dtype=float)
    return tuple(dict.fromkeys((*_both(joint), *MAIN)))


def _both(axis: Vector) -> Axes:
    """An axis in both senses."""
    unit = (axis / np.linalg.norm(axis)).round(_DIGITS) + 0.0
    return tuple(unit.tolist()), tuple((0.0 - unit).tolist())


MAIN: Axes = tuple(own for axis in np.eye(3) for own in _both(axis))
"""The axes of the tree, in both senses."""
