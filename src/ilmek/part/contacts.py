"""What touches, and what is through each other, of the parts of a tree with every drive at angle 0.

Pieces of like parts that lie alike to each other are measured once.
"""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import Manifold
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ilmek.arrays import BoolArray, Float, Int
from ilmek.part.clearances import Approach
from ilmek.part.colliders import DEPTH, MANY, Collider, Common, collider, gap_between, inside, pose_key
from ilmek.part.placement import Placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.tree import STANDING, JointKind, Tree
from ilmek.records import record
from ilmek.units import mm

TOUCHING = 0.1 * mm
"""Distance within which parts touch [m]."""

PLAY, LEAST = 1 * mm, 1e-3 * mm**3
"""Move that shows what stops a piece [m], and volume in common that counts as rounding [m³]."""

AROUND = 1 * mm
"""Greatest gap between a key and the room about it [m]; assumed by this project."""


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
    """A piece of a part where it stands.

    rigid  names all that moves with it        held  names all that no joint lets move against it
    turned  names all that no joint but pins lets move against it
    along  direction in which `MANY` of it follow each other
    """

    part: str
    body: str
    position: Placement
    collider: Collider
    rigid: tuple[tuple[str, int], ...]
    held: tuple[tuple[str, int], ...]
    turned: tuple[tuple[str, int], ...]
    along: Float[np.ndarray, " 3"] | None = None


def groups(tree: Tree, gap: float = TOUCHING) -> tuple[TouchingParts, ...]:
    """The groups of parts that touch within a gap [m], the largest first; parts without a shape are left out."""
    return contacts(tree, gap).groups


def contacts(tree: Tree, gap: float = TOUCHING) -> Contacts:
    """What touches within a gap [m], and what is through each other; parts without a shape are left out."""
    pieces = tuple(_pieces(tree))
    if not pieces:
        return Contacts((), ())
    pairs = _near(_boxes(pieces), gap)
    touch, depth, volume = _measured(pieces, pairs, gap)
    return Contacts(_groups(pieces, pairs[touch]), _through(pieces, pairs, depth, volume))


def joined_by(tree: Tree, names: frozenset[str]) -> dict[str, tuple[str, ...]]:
    """By the id of each of some fasteners the ids of the parts that its pieces join, in the tree's order.

    They are those that it states; or those that it touches and that move with it, and what stands round the middle of
    it, such as the room of a reducer round the key in its hollow shaft.
    """
    stated = {part.id: part.joins for part, _ in tree.occurrences() if part.id in names and part.joins}
    if stated:
        return joined_by(tree, names - stated.keys()) | stated
    pieces = tuple(_pieces(tree))
    boxes = _boxes(pieces) if pieces else np.empty((0, 2, 3))
    found: dict[str, set[str]] = {name: set() for name in names}
    for pair in _near(boxes, AROUND).tolist() if pieces else ():
        for first, other in (pair, pair[::-1]):
            fastener, part = pieces[first], pieces[other]
            if fastener.part not in names or part.part in found[fastener.part] | names:
                continue
            middle, (low, high) = boxes[first].mean(0), boxes[other]
            alike = fastener.rigid == part.rigid
            if alike or bool(((low < middle) & (middle < high)).all()):
                gap = TOUCHING if alike else AROUND
                if _apart(fastener, part, gap) <= gap:
                    found[fastener.part].add(part.part)
    order = {part.id: number for number, (part, _) in enumerate(tree.occurrences())}
    return {name: tuple(sorted(others, key=order.__getitem__)) for name, others in found.items()}


def _apart(own: _Piece, its: _Piece, gap: float) -> float:
    """The distance of two pieces, as far as it is below a gap [m]."""
    back = own.position.rotation.T
    moved = back @ (its.position.origin - own.position.origin)
    return gap_between(own.collider, its.collider, back @ its.position.rotation, moved, gap)


@record
class Touch:
    """A contact of two parts that move together: ids, position of the other in the axes of the part, and the corners
    of the box about the contact there [m].
    """

    part: str
    other: str
    position: Placement
    box: Float[np.ndarray, "2 3"]


def touches(tree: Tree, names: frozenset[str]) -> Iterator[tuple[Touch, Touch]]:
    """The contacts among the pieces of some parts that move together: of each a pair, as each part has it."""
    pieces = tuple(piece for piece in _pieces(tree) if piece.part in names)
    boxes = _boxes(pieces) if pieces else np.empty((0, 2, 3))
    for one, two in _near(boxes, TOUCHING).tolist() if pieces else ():
        own, its = pieces[one], pieces[two]
        if own.rigid == its.rigid and _apart(own, its, TOUCHING) <= TOUCHING:
            yield _touch(own, its), _touch(its, own)


def _touch(own: _Piece, its: _Piece) -> Touch:
    """The contact of two pieces as the first one has it: what their boxes share in its axes."""
    lies = own.position.inverse.after(its.position)
    corners, others = own.collider.corners, lies.points(its.collider.corners)
    ends = np.maximum(corners.min(0), others.min(0)), np.minimum(corners.max(0), others.max(0))
    return Touch(own.part, its.part, lies, np.sort(ends, axis=0))


@dataclass(frozen=True, eq=False)
class StandingTouches:
    """Pieces that stand to each other, by their numbers, and the pairs of them that touch.

    beside  pieces that turn against them      lowest  of each, over the lowest of all [m]      ground  they stand
    """

    pieces: tuple[_Piece, ...]
    pairs: tuple[tuple[int, int], ...]
    beside: tuple[_Piece, ...]
    lowest: tuple[float, ...]
    ground: bool

    @property
    def parts(self) -> tuple[str, ...]:
        """Ids of their parts."""
        return tuple(piece.part for piece in self.pieces)

    def captive(self, own: Sequence[int], others: Collection[int]) -> bool:
        """Whether some pieces, moved together, run into others, or what turns beside, along all axes of the first one.

        A move of `PLAY` has to give them more in common, which is on the average thicker than `DEPTH`: as a shoulder
        has, not the facets of a pin that slides in its bore.
        """
        mine, theirs = [self.pieces[k] for k in own], [*(self.pieces[k] for k in others), *self.beside]
        low, high = (edge[:, None] for edge in _boxes(mine).swapaxes(0, 1))
        begin, end = _boxes(theirs).swapaxes(0, 1)
        near = np.argwhere((low <= end + PLAY).all(2) & (begin <= high + PLAY).all(2)).tolist()
        known, pairs = dict[Collider, Manifold](), [(mine[k], theirs[j]) for k, j in near]
        rests = [_in_common(one, other, np.zeros(3), known) for one, other in pairs]

        def stops(move: Float[np.ndarray, " 3"]) -> bool:
            for pair, (volume, surface) in zip(pairs, rests, strict=True):
                more, around = _in_common(*pair, move, known)
                if more - volume > LEAST and 2 * (more - volume) > DEPTH * (around - surface):
                    return True
            return False

        axes = mine[0].position.rotation.T
        return all(stops(sense * PLAY * axis) for axis in axes for sense in (1.0, -1.0))


def _in_common(
    own: _Piece, its: _Piece, move: Float[np.ndarray, " 3"], known: dict[Collider, Manifold]
) -> tuple[float, float]:
    """Volume [m³] and surface [m²] of what two pieces have in common when the first is moved [m]."""
    for piece in (own, its):
        if piece.collider not in known:
            known[piece.collider] = piece.collider.manifold()
    back = own.position.rotation.T
    lies = np.column_stack([back @ its.position.rotation, back @ (its.position.origin - own.position.origin - move)])
    common = known[own.collider] ^ known[its.collider].transform(lies)
    return common.volume(), common.surface_area()


def standing_touches(tree: Tree) -> Iterator[StandingTouches]:
    """The pieces that no joint lets move against each other, and which of them touch."""
    pieces = tuple(_pieces(tree))
    groups: dict[tuple[tuple[str, int], ...], dict[int, int]] = {}
    turned: dict[tuple[tuple[str, int], ...], list[_Piece]] = {}
    for number, piece in enumerate(pieces):
        own = groups.setdefault(piece.held, {})
        own[number] = len(own)
        turned.setdefault(piece.turned, []).append(piece)
    boxes = _boxes(pieces) if pieces else np.empty((0, 2, 3))
    pairs = _near(boxes, TOUCHING) if pieces else np.empty((0, 2), int)
    together = np.array([pieces[one].held == pieces[two].held for one, two in pairs.tolist()], bool)
    pairs = pairs[together]
    touch, _, _ = _measured(pieces, pairs, TOUCHING, shared=False)
    met: dict[tuple[tuple[str, int], ...], list[tuple[int, int]]] = {held: [] for held in groups}
    for one, two in pairs[touch].tolist():
        held = pieces[one].held
        met[held].append((groups[held][one], groups[held][two]))
    for held, own in groups.items():
        height = boxes[list(own), 0, 1]
        yield StandingTouches(
            tuple(pieces[number] for number in own),
            tuple(met[held]),
            tuple(piece for piece in turned[pieces[next(iter(own))].turned] if piece.held != held),
            tuple((height - height.min()).tolist()),
            ground=not held,
        )


def open_parts(tree: Tree) -> tuple[str, ...]:
    """Ids of the parts whose mesh encloses no volume: what they have in common with others is not known."""
    shaped = ((part.id, part.shape) for part, _ in tree.occurrences() if part.shape is not None)
    return tuple(name for name, shape in shaped if not collider(shape).closed)


def _pieces(tree: Tree) -> Iterator[_Piece]:
    for chain in chains(tree):
        here = poses(chain, "", np.zeros(1))
        body, rigid = Placement(here.origin[0], here.rotation[0]), _rigid(chain)
        held, turned = _held(chain, STANDING), _held(chain, STANDING | {JointKind.PIN})
        for occurrence in chain[-1].body.occurrences:
            if occurrence.part.shape is not None:
                own, positions = collider(occurrence.part.shape), occurrence.positions
                along = (
                    _unit(body.rotation @ (positions[-1].origin - positions[0].origin))
                    if len(positions) >= MANY
                    else None
                )
                for position in positions:
                    yield _Piece(
                        occurrence.part.id, chain[-1].name, body.after(position), own, rigid, held, turned, along
                    )


def _boxes(pieces: Sequence[_Piece]) -> Float[np.ndarray, "pieces 2 3"]:
    """Least and largest x, y, z of each piece [m]."""
    boxes, alike = np.empty((len(pieces), 2, 3)), dict[Collider, list[int]]()
    for number, piece in enumerate(pieces):
        alike.setdefault(piece.collider, []).append(number)
    for collided, numbers in alike.items():
        turned = np.array([pieces[number].position.rotation for number in numbers]).swapaxes(1, 2)
        away = np.array([pieces[number].position.origin for number in numbers])
        points = collided.corners @ turned + away[:, None]
        boxes[numbers, 0], boxes[numbers, 1] = points.min(1), points.max(1)
    return boxes


def _rigid(chain: Chain) -> tuple[tuple[str, int], ...]:
    """The chain up to its last link that moves with any drive."""
    moving = [number for number, link in enumerate(chain) if link.moves]
    return tuple((link.name, link.index) for link in chain[: moving[-1] + 1 if moving else 0])


def _held(chain: Chain, kinds: frozenset[JointKind]) -> tuple[tuple[str, int], ...]:
    """The chain up to its last link whose joint is of none of some kinds."""
    jointed = [k for k, link in enumerate(chain) if link.body.joint.kind not in kinds]
    return tuple((link.name, link.index) for link in chain[: jointed[-1] + 1 if jointed else 0])


def _unit(vector: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " 3"]:
    return np.asarray(vector / np.linalg.norm(vector))


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
    pieces: Sequence[_Piece], pairs: Int[np.ndarray, "pairs 2"], gap: float, *, shared: bool = True
) -> tuple[BoolArray, Float[np.ndarray, " pairs"], Float[np.ndarray, " pairs"]]:
    """Of each pair whether it touches, and mean depth [m] and volume [m³] in common where it stands to each other."""
    rotation = np.array([piece.position.rotation for piece in pieces])
    origin = np.array([piece.position.origin for piece in pieces])
    first, other = pairs.T
    back = rotation[first].swapaxes(1, 2)
    turned, moved = back @ rotation[other], (back @ (origin[other] - origin[first])[:, :, None])[:, :, 0]
    touch, depth, volume = np.zeros(len(pairs), bool), np.zeros(len(pairs)), np.zeros(len(pairs))
    common = Common({})

    def measure(k: int) -> tuple[bool, float, float]:
        own, its = (pieces[number] for number in pairs[k])
        lies = own.collider, its.collider, turned[k], moved[k]
        apart = gap_between(*lies, gap)
        together = shared and own.rigid == its.rigid and (apart <= 0 or inside(*lies))
        return apart <= gap, *(common.depth(*lies) if together else (0.0, 0.0))

    for alike, in_rows in _alike(pieces, pairs, turned, moved):
        some = {alike[0], alike[len(alike) // 2], alike[-1]} if in_rows else {alike[0]}
        tried = [measure(k) for k in some]
        every = tried[:1] * len(alike) if len(set(tried)) == 1 else [measure(k) for k in alike]
        touch[alike], depth[alike], volume[alike] = np.array(every).T
    return touch, depth, volume


def _alike(
    pieces: Sequence[_Piece],
    pairs: Int[np.ndarray, "pairs 2"],
    turned: Float[np.ndarray, "pairs 3 3"],
    moved: Float[np.ndarray, "pairs 3"],
) -> Iterator[tuple[list[int], bool]]:
    """Pairs that lie alike, and whether they are of rows of many and lie alike but for their places along these: of two
    rows, or of a row beside one piece. Beside several pieces of another pitch the places decide what meets.
    """
    kinds: dict[tuple[bool, bool, tuple[bytes, ...]], list[int]] = {}
    for k, (first, other) in enumerate(pairs.tolist()):
        own, its = pieces[first], pieces[other]
        row = own.along if own.along is not None else its.along
        along = None if row is None else own.position.rotation.T @ row
        key = own.rigid == its.rigid, row is None, pose_key(own.collider, its.collider, turned[k], moved[k], along)
        kinds.setdefault(key, []).append(k)
    for key, alike in kinds.items():
        beside = {number for k in alike for number in pairs[k].tolist() if pieces[number].along is None}
        if key[1] or len(beside) <= 1:
            yield alike, not key[1]
        else:
            yield from (([k], False) for k in alike)


def _groups(pieces: Sequence[_Piece], links: Int[np.ndarray, "links 2"]) -> tuple[TouchingParts, ...]:
    counted = (Counter(pieces[number].part for number in own) for own in connected(len(pieces), links))
    return tuple(sorted(map(TouchingParts, counted), key=lambda group: -group.pieces))


def connected(number: int, links: Int[np.ndarray, "links 2"]) -> list[list[int]]:
    """Groups of the numbers below a number that links join to each other, directly or by others."""
    graph = coo_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(number, number))
    groups: dict[int, list[int]] = {}
    for own, label in enumerate(connected_components(graph, directed=False)[1].tolist()):
        groups.setdefault(label, []).append(own)
    return list(groups.values())


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
