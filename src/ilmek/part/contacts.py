"""Which parts of a tree touch: the groups that stand together, with every drive at angle 0."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import fcl
import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ilmek.arrays import Float
from ilmek.part.clearances import DEVIATION, triangle_tree
from ilmek.part.placement import Placement
from ilmek.part.poses import chains, poses
from ilmek.part.tree import Tree
from ilmek.plane.solids import is_closed
from ilmek.records import record
from ilmek.units import mm

TOUCHING = 0.1 * mm
"""Distance within which parts touch [m]."""

_ROUNDED = 7
"""Digits of the relative positions [m] that are compared: pairs of like parts that lie alike are measured once."""


@record
class TouchingParts:
    """Parts that touch each other, directly or by others: how many of each, by id."""

    parts: Mapping[str, int]

    @property
    def pieces(self) -> int:
        """Number of all its pieces."""
        return sum(self.parts.values())


@dataclass(frozen=True)
class _Piece:
    part: str
    position: Placement
    collider: fcl.BVHModel
    low: Float[np.ndarray, " 3"]
    high: Float[np.ndarray, " 3"]


def groups(tree: Tree, gap: float = TOUCHING) -> tuple[TouchingParts, ...]:
    """The groups of parts that touch within a gap [m], the largest first; parts without a shape are left out."""
    pieces = tuple(_pieces(tree))
    if not pieces:
        return ()
    links = np.array(list(_touching(pieces, gap)), dtype=int).reshape(-1, 2)
    graph = coo_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(len(pieces), len(pieces)))
    _, labels = connected_components(graph, directed=False)
    members: dict[int, Counter[str]] = {}
    for piece, label in zip(pieces, labels.tolist(), strict=True):
        members.setdefault(label, Counter())[piece.part] += 1
    return tuple(sorted((TouchingParts(parts) for parts in members.values()), key=lambda group: -group.pieces))


def open_parts(tree: Tree) -> tuple[str, ...]:
    """Ids of the parts whose mesh encloses no volume: what they have in common with others is not known."""
    shaped = ((part.id, part.shape) for part, _ in tree.occurrences() if part.shape is not None)
    return tuple(name for name, shape in shaped if not is_closed(shape.mesh(DEVIATION)))


def _pieces(tree: Tree) -> Iterator[_Piece]:
    models: dict[str, fcl.BVHModel] = {}
    corners: dict[str, Float[np.ndarray, "points 3"]] = {}
    for chain in chains(tree):
        here = poses(chain, "", np.zeros(1))
        body = Placement(here.origin[0], here.rotation[0])
        for occurrence in chain[-1].body.occurrences:
            part = occurrence.part
            if part.shape is None:
                continue
            if part.id not in models:
                mesh = part.shape.mesh(DEVIATION)
                models[part.id], corners[part.id] = triangle_tree(mesh), mesh.points
            for own in occurrence.positions:
                position = body.after(own)
                points = position.points(corners[part.id])
                yield _Piece(part.id, position, models[part.id], points.min(0), points.max(0))


def _touching(pieces: tuple[_Piece, ...], gap: float) -> Iterator[tuple[int, int]]:
    """Numbers of two pieces that touch; of those that others join already, not all."""
    low, high = np.array([piece.low for piece in pieces]), np.array([piece.high for piece in pieces])
    measured: dict[tuple[object, ...], bool] = {}
    roots = list(range(len(pieces)))

    def root(number: int) -> int:
        while roots[number] != number:
            roots[number] = roots[roots[number]]
            number = roots[number]
        return number

    for first, piece in enumerate(pieces):
        near = (low[first + 1 :] <= high[first] + gap) & (low[first] <= high[first + 1 :] + gap)
        for offset in np.flatnonzero(near.all(1)).tolist():
            other = first + 1 + offset
            ends = root(first), root(other)
            if ends[0] == ends[1]:
                continue
            relative = piece.position.inverse.after(pieces[other].position)
            key = (
                piece.part,
                pieces[other].part,
                relative.origin.round(_ROUNDED).tobytes(),
                relative.rotation.round(_ROUNDED).tobytes(),
            )
            if key not in measured:
                measured[key] = _distance(piece, pieces[other], relative) <= gap
            if measured[key]:
                roots[ends[0]] = ends[1]
                yield first, other


def _distance(first: _Piece, other: _Piece, relative: Placement) -> float:
    return float(
        fcl.distance(
            fcl.CollisionObject(first.collider),
            fcl.CollisionObject(other.collider, fcl.Transform(relative.rotation, relative.origin)),
        )
    )
