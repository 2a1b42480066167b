"""Screws of the fixed joints of a tree: where parts that stand to each other touch with plane faces, screws hold them.

One part has holes with counterbores for the heads, the other the threads; nothing stands out of either. Screws stand
1.5 of their diameter off the edges of both faces and 40 of it apart at most; bought parts have theirs where their
catalogue has them. Of all sizes it is the largest that the part under the heads allows, half of its thickness, and for
which the other part is thick enough for the thread; in a part that ends in an axle one, by DIN 332-2.

Parts of a frame that are welded [`welds`] have none, nor have what turns, hangs or is stacked on its shaft.
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from ilmek.arrays import ComplexArray, Float
from ilmek.elements.machine_screws import SOCKET_LENGTHS, SOCKET_SCREWS, MachineScrew
from ilmek.part import catalogue
from ilmek.part.bolt_holes import DrilledPart
from ilmek.part.bolt_spots import clear, free_points, mapped, pattern_points, wanted
from ilmek.part.part import HolePattern, Part
from ilmek.part.placement import Placement, placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.seat_faces import Depth, SeatFace, depth_below, seat_faces
from ilmek.part.shapes import Drilling, Prism, Turned, box_corners, shape_box
from ilmek.part.tree import STANDING, Occurrence, RigidBody, Tree
from ilmek.part.welds import WELDED, welded_together
from ilmek.units import mm, um

BOLTED = frozenset(
    {
        "stepper", "servo", "reducer", "linear guide", "guide carriage", "linear axis", "sensor", "load cell",
        "light barrier", "yarn sensor", "yarn brake", "interlock", "actuator", "emergency stop", "button", "control",
        "mounting rail", "tool", "duct",
    }
)  # fmt: skip
"""Kinds of bought parts that are held by screws."""

_NEVER = frozenset({"cam plate", "guard mesh", "fastener"})
"""Processes of made parts that are held otherwise."""

_MOST = 200
"""Pieces of a part in a body from which they are a stack."""

_FLUSH = 20 * um
"""Distance within which faces lie on each other [m]."""

_CLAMPED = (2.0, 1.0)
"""Thickness of the flange of a bought part over the diameter of its screws, most and least; assumed by this project."""

_LONGEST = 6.0
"""Length of a screw under its head that is not in the thread over its diameter, at most: the head is sunk deeper."""

_PLAY = 0.1 * mm
"""Of a head in the notch of a bought flange [m]."""

_TOOL = 8.0
"""Room before a head over the diameter of its screw, at least; assumed by this project."""

_LEAST_EDGE = 0.8
"""Distance of a thread in a catalogue's pattern from an edge over its diameter, at least; assumed by this project."""

_FLOOR = 1.5 * mm
"""Least material under a thread that does not go through [m]; assumed by this project."""

_LARGEST, _BOUGHT = 12 * mm, 8 * mm
"""Largest diameters of screws in made parts and in bought ones [m]; assumed by this project."""

_TRIED, _BETWEEN = 8, 3.0
"""Points that are tried for a screw, and the distance of two over their diameter, at least."""

_TIP = 0.5
"""Depth of a thread beyond the screw over its diameter."""

_CENTRES = ((7, "M2.5"), (10, "M3"), (13, "M4"), (16, "M5"), (21, "M6"), (24, "M8"), (38, "M10"), (np.inf, "M12"))
"""Diameters of axles [mm] up to which they have a thread in their end [DIN 332-2]."""


@dataclass(frozen=True, eq=False)
class _Standing:
    """A piece that stands in a rigid group: part, its body, where it is in the group and in its body."""

    part: Part
    body: RigidBody
    lies: Placement
    own: Placement
    box: Float[np.ndarray, "2 3"]


@dataclass(frozen=True, eq=False)
class _Side:
    """A face of a piece in a contact."""

    piece: _Standing
    face: SeatFace

    @property
    def part(self) -> Part:
        """The part."""
        return self.piece.part

    @cached_property
    def frame(self) -> Placement:
        """Of the face in the group."""
        return self.piece.lies.after(self.face.position)

    def depth(self, point: complex, radius: float) -> Depth:
        """Of a hole of a radius at a point of the face."""
        assert self.part.shape is not None
        return depth_below(self.part.shape, self.face, point, radius)


@dataclass(frozen=True, eq=False)
class _Screwed:
    """The screws of a contact: `head` is under their heads, `thread` has their threads.

    points  in the face under the heads [m]      clamped, engaged  lengths of a screw before and in the thread [m]
    deep, below  of the parts there [m]          sink  diameter of the counterbore [m]
    """

    head: _Side
    thread: _Side
    screw: MachineScrew
    points: tuple[complex, ...]
    clamped: float
    engaged: float
    deep: float
    sink: float
    below: Depth

    @property
    def length(self) -> float:
        """Length of a screw [m]."""
        return self.clamped + self.engaged

    def holes(self, point: complex) -> tuple[tuple[_Side, Drilling], tuple[_Side, Drilling]]:
        """The holes of a screw in both parts, in their axes."""
        row, head, thread = self.screw, self.head, self.thread
        mouth = head.face.position.after(placement(point.real, point.imag, -self.deep))
        steps = (self.sink, self.deep - self.clamped), (row.hole, self.clamped)
        there = thread.piece.lies.inverse.after(head.frame).after(placement(point.real, point.imag))
        long = self.engaged + _TIP * row.diameter
        through = self.below.flat and self.below.length - long < _FLOOR
        tapped = Drilling(there, ((row.diameter, self.below.length if through else long),), through=through)
        return (head, Drilling(mouth, steps, through=True)), (thread, tapped)


@lru_cache(maxsize=16)
def bolted(tree: Tree) -> Tree:
    """The tree with the screws of its fixed joints, and the holes for them in its parts."""
    worked: dict[str, DrilledPart] = {}
    known: dict[tuple[object, ...], _Screwed | None] = {}
    placed: dict[tuple[str, str, float], dict[str, list[Placement]]] = defaultdict(lambda: defaultdict(list))
    joined: dict[tuple[str, str, float], tuple[MachineScrew, tuple[Part, Part]]] = {}
    for group in _groups(tree):
        for one, other in _contacts(group):
            lies = one.frame.inverse.after(other.frame)
            key = one.part.id, other.part.id, id(one.face), id(other.face), *_rounded(lies)
            if key not in known:
                known[key] = _screwed(one, other, group, worked)
            made = known[key]
            if made is None:
                continue
            head, thread = (one, other) if made.head.part is one.part else (other, one)
            ids = head.part.id, thread.part.id, round(made.length, 6)
            joined[ids] = made.screw, (head.part, thread.part)
            host = min((head.piece, thread.piece), key=lambda own: len(own.body.positions))
            to_body = host.own.after(host.lies.inverse).after(head.frame)
            placed[ids][host.body.id] += (
                to_body.after(placement(point.real, point.imag, -made.clamped)) for point in made.points
            )
    return _with(tree, worked, placed, joined) if placed else tree


def _rounded(lies: Placement) -> tuple[float, ...]:
    return tuple((np.round(np.concatenate([lies.origin, lies.rotation.ravel()]), 6) + 0.0).tolist())


def _with(
    tree: Tree,
    worked: Mapping[str, DrilledPart],
    placed: Mapping[tuple[str, str, float], Mapping[str, list[Placement]]],
    joined: Mapping[tuple[str, str, float], tuple[MachineScrew, tuple[Part, Part]]],
) -> Tree:
    """The tree with drilled parts, and screws in its bodies."""
    parts = {name: own.finished for name, own in worked.items()}
    screws: dict[str, list[Occurrence]] = defaultdict(list)
    names: dict[str, int] = defaultdict(int)
    for ids, bodies in placed.items():
        screw, both = joined[ids]
        first, second = (part.id.rpartition("/")[2] for part in both)
        stem = f"{both[0].id.rpartition('/')[0]}/{first}-{second}-screw"
        names[stem] += 1
        name = stem if names[stem] == 1 else f"{stem}-{names[stem]}"
        own = replace(
            catalogue.screw(name, f"screw of the {both[0].title} on the {both[1].title}", screw, ids[2]), joins=ids[:2]
        )
        for body, positions in bodies.items():
            screws[body].append(Occurrence(own, tuple(positions)))
    return tree.replaced(
        replace(
            body,
            occurrences=(
                *(replace(own, part=parts.get(own.part.id, own.part)) for own in body.occurrences),
                *screws[body.id],
            ),
        )
        for body in tree.bodies
    )


def _groups(tree: Tree) -> Iterator[tuple[_Standing, ...]]:
    """The pieces that stand to each other, of like bodies those of the first."""
    groups: dict[tuple[str, ...], list[_Standing]] = defaultdict(list)
    for chain in chains(tree):
        moving = [k for k, link in enumerate(chain) if link.body.joint.kind not in STANDING]
        carrier = chain[: moving[-1] + 1] if moving else ()
        if any(link.index for link in carrier):
            continue
        groups[tuple(link.name for link in carrier)] += _pieces(chain, len(carrier))
    return (tuple(group) for group in groups.values())


def _pieces(chain: Chain, first: int) -> Iterator[_Standing]:
    """The pieces of the last body of a chain, in the frame of its link before `first`."""
    here = poses(chain[first:], "", np.zeros(1))
    lies = Placement(here.origin[0], here.rotation[0])
    for occurrence in chain[-1].body.occurrences:
        part = occurrence.part
        if part.shape is None or occurrence.turning or len(occurrence.positions) > _MOST:
            continue
        corners = _corners(part)
        for position in occurrence.positions:
            stands = lies.after(position)
            points = stands.points(corners)
            yield _Standing(part, chain[-1].body, stands, position, np.stack([points.min(0), points.max(0)]))


@lru_cache(maxsize=4096)
def _corners(part: Part) -> Float[np.ndarray, "8 3"]:
    assert part.shape is not None
    return box_corners(*shape_box(part.shape))


def _can(part: Part) -> bool:
    """Whether screws hold a part."""
    if part.purchase is not None:
        return part.process in BOLTED
    return part.process not in _NEVER and part.drawing is None


def _contacts(group: Sequence[_Standing]) -> list[tuple[_Side, _Side]]:
    """Faces that lie on each other of parts that are screwed: those of catalogues first."""
    sides = [_Side(piece, face) for piece in group if _can(piece.part) for face in seat_faces(piece.part.shape)]
    if not sides:
        return []
    frames = [side.frame for side in sides]
    normals = np.array([frame.rotation[:, 2] for frame in frames])
    levels = (normals * np.array([frame.origin for frame in frames])).sum(1)
    boxes = np.array([_face_box(side.face, frame) for side, frame in zip(sides, frames, strict=True)])
    turned, level = np.round(normals * 1e3).astype(int), np.round(levels / _FLUSH).astype(int)
    numbers: dict[tuple[int, ...], list[int]] = defaultdict(list)
    for number, key in enumerate(np.column_stack([turned, level]).tolist()):
        numbers[tuple(key)].append(number)
    pairs: dict[tuple[int, int], list[tuple[float, _Side, _Side]]] = defaultdict(list)
    for first, (*key, height) in enumerate(np.column_stack([-turned, -level]).tolist()):
        for other in (k for step in (-1, 0, 1) for k in numbers.get((*key, height + step), ())):
            one, two = sides[first], sides[other]
            if first < other and abs(levels[first] + levels[other]) < _FLUSH and _may(one.piece, two.piece):
                shared = np.minimum(boxes[first, 1], boxes[other, 1]) - np.maximum(boxes[first, 0], boxes[other, 0])
                if (shared > -_FLUSH).all() and np.sort(shared)[1] > 2 * mm:
                    area = float(np.prod(np.sort(shared)[1:]))
                    pairs[id(one.piece), id(two.piece)].append((area, one, two))
    found = [(one, two) for own in pairs.values() for _, one, two in sorted(own, key=lambda contact: -contact[0])[:2]]
    return sorted(found, key=lambda both: all(_pattern(side.piece.part) is None for side in both))


def _face_box(face: SeatFace, frame: Placement) -> Float[np.ndarray, "2 3"]:
    low, high = face.low, face.high
    corners = frame.points(np.array([[x, y, 0.0] for x in (low.real, high.real) for y in (low.imag, high.imag)]))
    return np.stack([corners.min(0), corners.max(0)])


def _may(one: _Standing, two: _Standing) -> bool:
    """Whether two pieces may be screwed to each other."""
    parts = one.part, two.part
    turned = [isinstance(part.shape, Turned) for part in parts]
    bought = [part.purchase is not None for part in parts]
    return (
        parts[0] is not parts[1]
        and not all(turned)
        and not (any(turned) and any(bought))
        and not welded_together(*parts)
    )


def _pattern(part: Part) -> HolePattern | None:
    return part.purchase.holes if part.purchase is not None else None


def _screwed(one: _Side, other: _Side, group: Sequence[_Standing], worked: dict[str, DrilledPart]) -> _Screwed | None:
    """The screws of a contact, with their holes in both parts; None: there is no room for any."""
    options = [own for head, thread in ((one, other), (other, one)) for own in _options(head, thread, group, worked)]
    if not options:
        return None
    _, best = max(options, key=lambda own: own[0])
    for point in best.points:
        for side, hole in best.holes(point):
            worked.setdefault(side.part.id, DrilledPart(side.part)).drill(side.face, hole)
    return best


def _options(
    head: _Side, thread: _Side, group: Sequence[_Standing], worked: Mapping[str, DrilledPart]
) -> Iterator[tuple[tuple[float, ...], _Screwed]]:
    """The largest screws with their heads in one of two parts, two or more if they have room, and how good that is."""
    if head.face.turned or head.part.process == WELDED:
        return
    made: _Screwed | None = None
    for screw, points, fixed in _offered(head, thread):
        tried = _of_size((head, thread), screw, points, worked, fixed=fixed)
        if tried is not None and (made is None or len(tried.points) > 1):
            made = tried
            if len(made.points) > 1 or thread.face.turned:
                break
    if made is None:
        return
    deep = head.depth(made.points[0], 0.0).length + mm
    mouths = head.frame.points(np.array([[point.real, point.imag, -deep] for point in made.points]))
    free = not any(_covers(own, mouths) for own in group if own is not head.piece)
    several = len(made.points) > 1 or thread.face.turned
    yield (several, free, head.part.purchase is None, -deep), made


def _covers(piece: _Standing, points: Float[np.ndarray, "n 3"]) -> bool:
    """Whether the box of a piece holds any of some points."""
    near = ((piece.box[0] < points) & (points < piece.box[1])).all(1)
    if not near.any() or not isinstance(piece.part.shape, Prism):
        return bool(near.any())
    own = piece.lies.inverse.points(points[near])
    section = seat_faces(piece.part.shape)[1]
    within = (own[:, 2] > 0) & (own[:, 2] < piece.part.shape.length)
    return bool((within & (section.room(own[:, 0] + 1j * own[:, 1], mm) > 0)).any())


def _offered(head: _Side, thread: _Side) -> Iterator[tuple[MachineScrew, ComplexArray, bool]]:
    """Screws that a joint may have with the points where they may stand, or all stand, the best first."""
    across = thread.frame.inverse.after(head.frame)
    for side in (head, thread):
        pattern = _pattern(side.part)
        if pattern is not None:
            points = pattern_points(pattern, side.face)
            yield SOCKET_SCREWS[pattern.thread], points if side is head else mapped(across.inverse, points), True
    if thread.face.turned:
        diameter = 2 * thread.face.high.real / mm
        largest = SOCKET_SCREWS[next(name for most, name in _CENTRES if diameter <= most + 1e-9)]
        sizes = [own for own in reversed(SOCKET_SCREWS.values()) if own.diameter <= largest.diameter]
    else:
        thick = head.depth((head.face.low + head.face.high) / 2, 0.0).length
        most = _LARGEST if head.part.purchase is None else _BOUGHT
        sizes = [own for own in reversed(SOCKET_SCREWS.values()) if own.diameter <= min(thick / 1.5 + um, most)]
        sizes.sort(key=lambda own: own.diameter > thick / 2 + um)
    for screw in sizes:
        yield screw, free_points(head.face, thread.face, across, screw.diameter), False


def _of_size(
    sides: tuple[_Side, _Side],
    screw: MachineScrew,
    points: ComplexArray,
    worked: Mapping[str, DrilledPart],
    *,
    fixed: bool,
) -> _Screwed | None:
    """The screws of a size at some of the points; None where there is no room."""
    head, thread = sides
    across = thread.frame.inverse.after(head.frame)
    if not len(points):
        return None
    if fixed:
        inside = clear(head.face, points, _sink(head.part, screw) / 2)
        points = points[inside & clear(thread.face, mapped(across, points), _LEAST_EDGE * screw.diameter)]
    made: _Screwed | None = None
    for target in points if fixed else wanted(points, screw.diameter):
        nearest = points[np.argsort(np.abs(points - target), kind="stable")][: 1 if fixed else _TRIED]
        for point in nearest.tolist():
            tried = _at_point(made, sides, screw, point, mapped(across, np.array([point]))[0])
            if tried is not None and all(
                side.part.id not in worked or worked[side.part.id].has_room(hole) for side, hole in tried.holes(point)
            ):
                chosen = () if made is None else made.points
                if all(abs(point - own) >= _BETWEEN * screw.diameter for own in chosen):
                    made = replace(tried, points=(*chosen, point))
                    break
    return made


def _sink(part: Part, screw: MachineScrew) -> float:
    """Diameter of the room of a head in a part [m]."""
    return screw.sink if part.purchase is None else screw.across + 2 * _PLAY


def _at_point(
    made: _Screwed | None, sides: tuple[_Side, _Side], screw: MachineScrew, point: complex, there: complex
) -> _Screwed | None:
    """A screw at a point of the face under its head, like those before; None where it cannot be."""
    head, thread = sides
    sink = _sink(head.part, screw)
    deep, below = head.depth(point, sink / 2), thread.depth(there, screw.diameter / 2)
    if not deep.flat or deep.free < _TOOL * screw.diameter:
        return None
    least = screw.engaged(thread.part.material.name) if thread.part.material else screw.diameter
    most = below.length if below.flat else below.length - 2 * _TIP * screw.diameter
    if thread.part.purchase is not None:
        most = min(most, 2 * screw.diameter)
    if made is not None:
        alike = abs(made.deep - deep.length) < um and most >= made.engaged - um
        return replace(made, below=below, points=()) if alike else None
    lengths = _lengths(screw, deep.length, least, most, made_part=head.part.purchase is None)
    return None if lengths is None else _Screwed(head, thread, screw, (), *lengths, deep.length, sink, below)


def _lengths(
    screw: MachineScrew, deep: float, least: float, most: float, *, made_part: bool
) -> tuple[float, float] | None:
    """Lengths of a screw before the thread and in it [m]: the shortest with enough thread, its head sunk.

    deep  of the part under the head      least, most  of the thread
    """
    if most < least - um:
        return None
    if made_part:
        longest = min(deep - screw.head, _LONGEST * screw.diameter)
        shortest = min(0.5 * screw.diameter, longest)
    else:
        longest, shortest = (min(share * screw.diameter, deep - screw.head) for share in _CLAMPED)
    if shortest <= 0:
        return None
    for length in SOCKET_LENGTHS:
        engaged = min(max(length - longest, least), most)
        if shortest - um <= length - engaged <= longest + um:
            return length - engaged, engaged
    return None
