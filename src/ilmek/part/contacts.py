"""What touches, and what is through each other, of the parts of a tree with every drive at angle 0.

Pieces of like parts that lie alike to each other are measured once.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ilmek.arrays import BoolArray, Float, Int, IntArray
from ilmek.part.clearances import Approach
from ilmek.part.colliders import Collider, Common, collider, distances, inside, pose_key
from ilmek.part.placement import Placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.units import mm

TOUCHING = 0.1 * mm
"""Distance within which parts touch [m]."""


@record
class TouchingParts:
    """Parts that touch each other, directly or by others: how many of each, by id."""

    parts: Mapping[str, int]

    @property
    def pieces(self) -> int:
        """Number of all its pieces."""
        return sum(self.parts.values())


@record
class Contacts:
    """The groups of parts that touch, the largest first; the parts through each other of those that stand to each other
    at all angles, the deepest first.
    """

    groups: tuple[TouchingParts, ...]
    through: tuple[Approach, ...]


@dataclass(frozen=True, eq=False)
class _Piece:
    """A piece of a part where it stands; rigid: names all that moves with it."""

    part: str
    body: str
    position: Placement
    collider: Collider
    rigid: tuple[tuple[str, int], ...]

    @cached_property
    def box(self) -> Float[np.ndarray, "2 3"]:
        """Least and largest x, y, z [m]."""
        points = self.position.points(self.collider.corners)
        return np.stack([points.min(0), points.max(0)])


def groups(tree: Tree, gap: float = TOUCHING) -> tuple[TouchingParts, ...]:
    """The groups of parts that touch within a gap [m], the largest first; parts without a shape are left out."""
    return contacts(tree, gap).groups


def contacts(tree: Tree, gap: float = TOUCHING) -> Contacts:
    """What touches within a gap [m], and what is through each other; parts without a shape are left out."""
    pieces = tuple(_pieces(tree))
    if not pieces:
        return Contacts((), ())
    pairs = _near(np.array([piece.box for piece in pieces]), gap)
    touch, depth, volume = _measured(pieces, pairs, gap)
    return Contacts(_groups(pieces, pairs[touch]), _through(pieces, pairs, depth, volume))


def _pieces(tree: Tree) -> Iterator[_Piece]:
    for chain in chains(tree):
        here = poses(chain, "", np.zeros(1))
        body, rigid = Placement(here.origin[0], here.rotation[0]), _rigid(chain)
        for occurrence in chain[-1].body.occurrences:
            if occurrence.part.shape is not None:
                own = collider(occurrence.part)
                for position in occurrence.positions:
                    yield _Piece(occurrence.part.id, chain[-1].name, body.after(position), own, rigid)


def _rigid(chain: Chain) -> tuple[tuple[str, int], ...]:
    """The chain up to its last link that moves with any drive."""
    moving = [number for number, link in enumerate(chain) if link.body.joint.motion is not None]
    return tuple((link.name, link.index) for link in chain[: moving[-1] + 1 if moving else 0])


def _near(boxes: Float[np.ndarray, "pieces 2 3"], gap: float) -> Int[np.ndarray, "pairs 2"]:
    """Numbers of two pieces whose boxes are within the gap."""
    order = np.argsort(boxes[:, 0, 0])
    low, high = boxes[order, 0], boxes[order, 1] + gap
    ends = np.searchsorted(low[:, 0], high[:, 0], side="right")
    every = []
    for first, end in enumerate(ends.tolist()):
        near = (low[first + 1 : end, 1:] <= high[first, 1:]) & (low[first, 1:] <= high[first + 1 : end, 1:])
        others = first + 1 + np.flatnonzero(near.all(1))
        every.append(np.stack([np.full(len(others), first), others], axis=1))
    return np.asarray(np.sort(order[np.concatenate(every)], axis=1))


def _measured(
    pieces: Sequence[_Piece], pairs: Int[np.ndarray, "pairs 2"], gap: float
) -> tuple[BoolArray, Float[np.ndarray, " pairs"], Float[np.ndarray, " pairs"]]:
    """Of each pair whether it touches, and mean depth [m] and volume [m³] in common where it stands to each other."""
    rotation = np.array([piece.position.rotation for piece in pieces])
    origin = np.array([piece.position.origin for piece in pieces])
    first, other = pairs.T
    back = rotation[first].swapaxes(1, 2)
    turned, moved = back @ rotation[other], (back @ (origin[other] - origin[first])[:, :, None])[:, :, 0]
    once, alike = _alike(pieces, pairs, turned, moved)
    touch, depth, volume = np.zeros(len(once), bool), np.zeros(len(once)), np.zeros(len(once))
    common = Common({})
    for number, k in enumerate(once.tolist()):
        own, its = pieces[pairs[k, 0]], pieces[pairs[k, 1]]
        apart = distances(own.collider, its.collider, turned[k : k + 1], moved[k : k + 1])[0]
        touch[number] = apart <= gap
        lies = own.collider, its.collider, turned[k], moved[k]
        if own.rigid == its.rigid and (apart <= 0 or inside(*lies)):
            depth[number], volume[number] = common.depth(*lies)
    return touch[alike], depth[alike], volume[alike]


def _alike(
    pieces: Sequence[_Piece],
    pairs: Int[np.ndarray, "pairs 2"],
    turned: Float[np.ndarray, "pairs 3 3"],
    moved: Float[np.ndarray, "pairs 3"],
) -> tuple[IntArray, IntArray]:
    """The first of each kind of pairs that lie alike, and of each pair the number of its kind."""
    keys: dict[object, int] = {}
    once, alike = [], []
    for k, (first, other) in enumerate(pairs.tolist()):
        own, its = pieces[first], pieces[other]
        key = own.rigid == its.rigid, pose_key(own.collider, its.collider, turned[k], moved[k])
        if key not in keys:
            keys[key] = len(once)
            once.append(k)
        alike.append(keys[key])
    return np.array(once, dtype=int), np.array(alike, dtype=int)


def _groups(pieces: Sequence[_Piece], links: Int[np.ndarray, "links 2"]) -> tuple[TouchingParts, ...]:
    graph = coo_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(len(pieces), len(pieces)))
    _, labels = connected_components(graph, directed=False)
    members: dict[int, Counter[str]] = {}
    for piece, label in zip(pieces, labels.tolist(), strict=True):
        members.setdefault(label, Counter())[piece.part] += 1
    return tuple(sorted((TouchingParts(parts) for parts in members.values()), key=lambda group: -group.pieces))


def _through(
    pieces: Sequence[_Piece],
    pairs: Int[np.ndarray, "pairs 2"],
    depth: Float[np.ndarray, " pairs"],
    volume: Float[np.ndarray, " pairs"],
) -> tuple[Approach, ...]:
    deepest = np.argsort(-depth)[: int((depth > 0).sum())].tolist()
    both = ((k, pieces[pairs[k, 0]], pieces[pairs[k, 1]]) for k in deepest)
    return tuple(
        Approach((own.part, its.part), (own.body, its.body), -float(depth[k]), float(volume[k]), "", 0.0)
        for k, own, its in both
    )
