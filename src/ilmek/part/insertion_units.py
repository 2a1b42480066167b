"""What is put in as one when a tree is put together: its parts and bodies as units, each where it stands.

A body that moves comes as one; of bodies that stand, and of what fastens, each part; of a body that is there several
times, it with all that it carries. Directions: the axes of the tree, and those of the unit's joint and parts; screws
along their axes only.
"""

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import count, groupby
from typing import TypeAlias

import numpy as np
from scipy.spatial import ConvexHull

from ilmek.arrays import Float
from ilmek.elements.machine_screws import screw_of
from ilmek.part.colliders import MANY, collider
from ilmek.part.part import Part
from ilmek.part.part_lists import FASTENER
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.shapes import Shape
from ilmek.part.straight_moves import FIT, FittedSolid, MovedSolids, Vector, fitted
from ilmek.part.tree import STANDING, Tree
from ilmek.records import record
from ilmek.report.scene import Solid

_MOST_ALIKE = 100
"""Like parts in a row of which no more than the first, the middle and the last are compared with others."""

_DIGITS = 6
"""Digits of a direction at which two are the same."""

Direction: TypeAlias = tuple[float, ...]
Axes: TypeAlias = tuple[Direction, ...]


@record
class StandingPart:
    """A part where it stands in the tree, of the body with this id."""

    part: Part
    body: str
    position: Placement


@dataclass(frozen=True, eq=False)
class InsertedUnit:
    """What is put in as one.

    number  in the order of the tree      name  of its body      pieces  its parts
    directions  in which it may begin to leave      carriers  bodies that move and carry it
    inner   the units that it is made of on the bench; none: it is a part, or a row of like parts
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
    def fastens(self) -> bool:
        """Whether it is a screw or a key."""
        return len(self.pieces) == 1 and self.pieces[0].part.process == FASTENER

    @property
    def first_moves(self) -> tuple[float, ...]:
        """Lengths by which it comes out of what it is in [m]: of a screw its thread."""
        screw = self.fastens and self.pieces[0].part.purchase and screw_of(self.pieces[0].part.purchase.row)
        return (float(np.ptp(self.solid.box, axis=0).max()) - screw.head + 2 * FIT,) if screw else ()

    @cached_property
    def solid(self) -> MovedSolids:
        """It where it stands, smaller by its fit."""
        return _placed(self.pieces, -FIT)

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
        shape = own[0].part.shape
        assert shape is not None
        own = own if len(alike) > 1 or len(own) <= _MOST_ALIKE else [own[0], own[len(own) // 2], own[-1]]
        if len(own) >= MANY and len(alike) > 1:
            corners = collider(shape).corners
            hull = _hull(np.concatenate([piece.position.points(corners) for piece in own]))
            solids.append((fitted(hull, by), IDENTITY))
        else:
            solids += [(_of_shape(shape, by), piece.position) for piece in own]
    return MovedSolids(solids)


@lru_cache(maxsize=4096)
def _of_shape(shape: Shape, by: float) -> FittedSolid:
    return fitted(collider(shape).solid, by)


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
    return tuple(_units(list(chains(tree)), 0, count()))


def _units(every: Sequence[Chain], depth: int, numbers: Iterator[int]) -> Iterator[InsertedUnit]:
    """The units of chains beyond their first links, which carry all of them."""
    grouped: dict[Chain, list[Chain]] = defaultdict(list)
    for links in every:
        several = (k for k in range(depth, len(links)) if len(links[k].body.positions) > 1)
        grouped[links[: next(several, len(links) - 1) + 1]].append(links)
    for prefix, own in grouped.items():
        link, axes = prefix[-1], _axes(prefix)
        carriers = frozenset(before.name for before in prefix[depth:-1] if before.body.joint.kind not in STANDING)
        pieces = tuple(piece for links in own for piece in _pieces(links))
        if pieces and len(prefix) > depth and len(link.body.positions) > 1:
            inner = tuple(_units(own, len(prefix), numbers)) if link.index == 0 else ()
            yield InsertedUnit(next(numbers), link.name, pieces, axes, carriers, inner)
            continue
        single = tuple(_of_body(pieces, axes, carriers, numbers))
        if len(prefix) <= depth or link.body.joint.kind in STANDING:
            yield from single
            continue
        kept = tuple(unit for unit in single if not unit.fastens)
        if kept:
            whole = tuple(piece for unit in kept for piece in unit.pieces)
            yield InsertedUnit(next(numbers), link.name, whole, axes, carriers, kept if len(kept) > 1 else ())
        yield from (unit for unit in single if unit.fastens)


def _pieces(links: Chain) -> Iterator[StandingPart]:
    """The parts of the last body of a chain where they stand."""
    here = poses(links, "", np.zeros(1))
    body = Placement(here.origin[0], here.rotation[0])
    for occurrence in links[-1].body.occurrences:
        if occurrence.part.shape is not None:
            for position in occurrence.positions:
                yield StandingPart(occurrence.part, links[-1].name, body.after(position))


def _of_body(
    pieces: Sequence[StandingPart], axes: Axes, carriers: frozenset[str], numbers: Iterator[int]
) -> Iterator[InsertedUnit]:
    """The parts of a body, each as a unit; `MANY` like ones as one."""
    for _, same in groupby(pieces, key=lambda piece: piece.part.id):
        alike = tuple(same)
        for own in [alike] if len(alike) >= MANY else [(piece,) for piece in alike]:
            part, along = own[0].part, own[0].position.rotation[:, 2]
            screwed = part.purchase is not None and screw_of(part.purchase.row) is not None
            ends = _both(along)[1:] if screwed else (*axes, *_both(along))
            yield InsertedUnit(next(numbers), own[0].body, own, tuple(dict.fromkeys(ends)), carriers)


def _axes(links: Chain) -> Axes:
    """Directions of the tree's axes, and of the joint of the last body of a chain."""
    here = poses(links, "", np.zeros(1))
    joint = here.rotation[0] @ np.array(links[-1].body.joint.axis, dtype=float)
    return tuple(dict.fromkeys((*MAIN, *_both(joint))))


def _both(axis: Vector) -> Axes:
    """An axis in both senses."""
    unit = (axis / np.linalg.norm(axis)).round(_DIGITS) + 0.0
    return tuple(unit.tolist()), tuple((0.0 - unit).tolist())


MAIN: Axes = tuple(own for axis in np.eye(3) for own in _both(axis))
"""The axes of the tree, in both senses."""
