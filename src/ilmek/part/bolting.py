"""Screws of the fixed joints of a tree: where parts that stand to each other touch with plane faces, screws hold them.

One part has holes with counterbores for the heads, the other the threads; nothing stands out of either. Screws stand
1.5 of their diameter off the edges of both faces and 40 of it apart at most. Bought parts whose catalogue states their
holes have screws in all of these, or none. Of all sizes it is the largest that the part under the heads allows, half of
its thickness, and for which the other part is thick enough for the thread; in a part that ends in an axle one, by
DIN 332-2.

Parts of a frame that are welded [`welds`] have none, nor have what turns, hangs or is stacked on its shaft.
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import BoolArray, ComplexArray, Float
from ilmek.elements.machine_screws import SOCKET_LENGTHS, SOCKET_SCREWS, MachineScrew
from ilmek.part import catalogue
from ilmek.part.bolt_contacts import (
    FaceSide,
    StandingPiece,
    face_contacts,
    is_given,
    pattern_of,
    patterns_of,
    standing_groups,
)
from ilmek.part.bolt_holes import DrilledPart
from ilmek.part.bolt_spots import clear, free_points, mapped, pattern_points, row_points
from ilmek.part.part import WELDED, Part
from ilmek.part.placement import Placement, placement
from ilmek.part.seat_faces import Depth, seat_faces
from ilmek.part.shapes import Drilling, Prism
from ilmek.part.tree import Occurrence, Tree
from ilmek.part.welds import welded_together
from ilmek.units import mm, um

_CLAMPED = (2.0, 1.0)
"""Thickness of the flange of a bought part over the diameter of its screws, most and least; assumed by this project."""

_LONGEST = 10.0
"""Length of a screw under its head that is not in the thread over its diameter, at most: the head is sunk deeper."""

_DEEPEST = 6.0
"""Depth of a counterbore over its diameter, at most; assumed by this project."""

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

_SEAM = 3 * mm
"""Between a head and stock that is welded to the part under it, for the seam [m]; assumed by this project."""

_TRIED, _BETWEEN = 8, 3.0
"""Points that are tried for a screw, and the distance of two over their diameter, at least."""

_TIP = 0.5
"""Depth of a thread beyond the screw over its diameter."""

_CENTRES = ((7, "M2.5"), (10, "M3"), (13, "M4"), (16, "M5"), (21, "M6"), (24, "M8"), (38, "M10"), (np.inf, "M12"))
"""Diameters of axles [mm] up to which they have a thread in their end [DIN 332-2]."""


@dataclass(frozen=True, eq=False)
class _Screwed:
    """The screws of a contact: `head` is under their heads, `thread` has their threads.

    points  in the face under the heads [m]      clamped, engaged  lengths of a screw before and in the thread [m]
    deep, below  of the parts there          sink  diameter of the counterbore [m]
    """

    head: FaceSide
    thread: FaceSide
    screw: MachineScrew
    points: tuple[complex, ...]
    clamped: float
    engaged: float
    deep: Depth
    sink: float
    below: Depth

    @property
    def length(self) -> float:
        """Length of a screw [m]."""
        return self.clamped + self.engaged

    def holes(self, point: complex) -> Iterator[tuple[FaceSide, Drilling]]:
        """The holes of a screw in both parts, in their axes; to a head in a hollow the key comes through its wall."""
        row, head, thread, deep = self.screw, self.head, self.thread, self.deep.length
        mouth = head.face.position.after(placement(point.real, point.imag, -deep))
        sunk = ((self.sink, deep - self.clamped),) if deep > self.clamped + um else ()
        yield head, Drilling(mouth, (*sunk, (row.hole, self.clamped)), through=True)
        if self.deep.wall:
            outside = mouth.after(placement(z=-self.deep.free - self.deep.wall))
            yield head, Drilling(outside, ((self.sink, self.deep.wall),), through=True)
        there = thread.piece.lies.inverse.after(head.frame).after(placement(point.real, point.imag))
        long = self.engaged + _TIP * row.diameter
        through = self.below.flat and self.below.length - long < _FLOOR
        yield thread, Drilling(there, ((row.diameter, self.below.length if through else long),), through=through)


_Key = tuple[str, str, str, float]
"""Parts that screws hold, the one under their heads first, size and length of these."""


@lru_cache(maxsize=16)
def bolted(tree: Tree) -> Tree:
    """The tree with the screws of its fixed joints, and the holes for them in its parts; one that has them as it is."""
    if any(part.joins and part.purchase for part, _ in tree.occurrences()):
        return tree
    worked: dict[str, DrilledPart] = {}
    known: dict[tuple[object, ...], _Screwed | None] = {}
    placed: dict[_Key, dict[str, list[Placement]]] = defaultdict(lambda: defaultdict(list))
    joined: dict[_Key, tuple[MachineScrew, tuple[Part, Part]]] = {}
    for group in standing_groups(tree):
        for one, other in face_contacts(group):
            lies = one.frame.inverse.after(other.frame)
            key = one.part.id, other.part.id, id(one.face), id(other.face), *_rounded(lies)
            if key not in known:
                known[key] = _screwed(one, other, group, worked)
            made = known[key]
            if made is None:
                continue
            head, thread = (one, other) if made.head.part is one.part else (other, one)
            ids = head.part.id, thread.part.id, made.screw.name, round(made.length, 6)
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
    placed: Mapping[_Key, Mapping[str, list[Placement]]],
    joined: Mapping[_Key, tuple[MachineScrew, tuple[Part, Part]]],
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
        own = replace(catalogue.screw(name, f"screw of the {both[0].title}", screw, ids[3]), joins=ids[:2])
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


def _screwed(
    one: FaceSide, other: FaceSide, group: Sequence[StandingPiece], worked: dict[str, DrilledPart]
) -> _Screwed | None:
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
    head: FaceSide, thread: FaceSide, group: Sequence[StandingPiece], worked: Mapping[str, DrilledPart]
) -> Iterator[tuple[tuple[float, ...], _Screwed]]:
    """The largest screws with their heads in one of two parts, two or more if they have room, and how good that is."""
    if head.face.turned or head.part.process == WELDED:
        return
    made: _Screwed | None = None
    around = [own for own in group if own is not head.piece and welded_together(own.part, head.part)]
    for screw, offered, fixed in _offered(head, thread):
        points = offered[~_closed(head, offered, _sink(head.part, screw) / 2 + _SEAM, around)]
        if fixed and len(points) < len(offered):
            continue
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
    flange = thread.part.purchase is not None and bool(patterns_of(head.part))  # of two bought parts, the motor's
    yield (several, flange, free, head.part.purchase is None, -deep), made


def _covers(piece: StandingPiece, points: Float[np.ndarray, "n 3"]) -> bool:
    """Whether the box of a piece holds any of some points."""
    near = _boxed(piece, points)
    if not near.any() or not isinstance(piece.part.shape, Prism):
        return bool(near.any())
    own = piece.lies.inverse.points(points[near])
    section = seat_faces(piece.part.shape)[1]
    within = (own[:, 2] > 0) & (own[:, 2] < piece.part.shape.length)
    return bool((within & (section.room(own[:, 0] + 1j * own[:, 1], mm) > 0)).any())


def _closed(head: FaceSide, points: ComplexArray, radius: float, around: Sequence[StandingPiece]) -> BoolArray:
    """Whether stock that is welded to the part under the heads closes round heads of a radius at points [m]."""
    closed = np.zeros(len(points), bool)
    if not around or not len(points):
        return closed
    deep = head.depth(complex(points[0]), 0.0).length + mm
    mouths = head.frame.points(np.stack([points.real, points.imag, np.full(len(points), -deep)], axis=1))
    for piece in around:
        if isinstance(piece.part.shape, Prism) and _boxed(piece, mouths, radius).any():
            own, section = piece.lies.inverse.points(mouths), seat_faces(piece.part.shape)[1]
            outline = replace(section, loops=section.loops[:1])
            within = (own[:, 2] > 0) & (own[:, 2] < piece.part.shape.length)
            closed |= within & (outline.room(own[:, 0] + 1j * own[:, 1], 2 * radius) > -radius)
    return closed


def _boxed(piece: StandingPiece, points: Float[np.ndarray, "n 3"], apart: float = 0.0) -> BoolArray:
    """Which points are in the box of a piece, or so far about it [m]."""
    return np.asarray(((piece.box[0] - apart < points) & (points < piece.box[1] + apart)).all(1))


def _offered(head: FaceSide, thread: FaceSide) -> Iterator[tuple[MachineScrew, ComplexArray, bool]]:
    """Screws that a joint may have with the points where they may stand, or all stand, the best first."""
    across = thread.frame.inverse.after(head.frame)
    holed = [side for side in (head, thread) if is_given(side)]
    for side in holed:
        pattern = pattern_of(side)
        if pattern is not None and pattern.tapped == (side is thread):
            points = pattern_points(pattern, side.face)
            yield SOCKET_SCREWS[pattern.thread], points if side is head else mapped(across.inverse, points), True
    if holed:
        return
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
    sides: tuple[FaceSide, FaceSide],
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
        if not (inside & clear(thread.face, mapped(across, points), _LEAST_EDGE * screw.diameter)).all():
            return None
    made: _Screwed | None = None
    for target in points if fixed else row_points(points, screw.diameter):
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
    return None if fixed and made is not None and len(made.points) < len(points) else made


def _sink(part: Part, screw: MachineScrew) -> float:
    """Diameter of the room of a head in a part [m]."""
    return screw.sink if part.purchase is None else screw.across + 2 * _PLAY


def _at_point(
    made: _Screwed | None, sides: tuple[FaceSide, FaceSide], screw: MachineScrew, point: complex, there: complex
) -> _Screwed | None:
    """A screw at a point of the face under its head, like those before; None where it cannot be."""
    head, thread = sides
    sink = _sink(head.part, screw)
    deep, below = head.depth(point, sink / 2), thread.depth(there, screw.diameter / 2)
    if not deep.flat or deep.free < _TOOL * screw.diameter:
        return None
    least = screw.engaged(thread.part.material.name) if thread.part.material else screw.diameter
    flat = below.flat or thread.part.purchase is not None  # a maker's thread ends over what is below
    most = below.length if flat else below.length - 2 * _TIP * screw.diameter
    if thread.part.purchase is not None:
        most = min(most, 2 * screw.diameter)
    if made is not None:
        alike = abs(made.deep.length - deep.length) < um and most >= made.engaged - um
        return replace(made, deep=deep, below=below, points=()) if alike else None
    made_part = head.part.purchase is None
    lengths = _lengths(screw, deep, least, most, made_part=made_part)
    if lengths is None or (made_part and deep.length - lengths[0] > _DEEPEST * sink):
        return None
    return _Screwed(head, thread, screw, (), *lengths, deep, sink, below)


def _lengths(
    screw: MachineScrew, deep: Depth, least: float, most: float, *, made_part: bool
) -> tuple[float, float] | None:
    """Lengths of a screw before the thread and in it [m]: of those that are sold with enough thread the one whose head
    is sunk least in a made part, in a hollow not at all; in the flange of a bought one, the shortest.

    deep  of the part under the head      least, most  of the thread
    """
    if most < least - um:
        return None
    sunk = deep.length if deep.wall else deep.length - screw.head
    if made_part:
        longest = min(sunk, _LONGEST * screw.diameter)
        shortest = min(0.5 * screw.diameter, longest)
    else:
        longest, shortest = (min(share * screw.diameter, sunk) for share in _CLAMPED)
    if shortest <= 0:
        return None
    engaged = {length: min(max(length - longest, least), most) for length in SOCKET_LENGTHS}
    fitting = {length: length - own for length, own in engaged.items() if shortest - um <= length - own <= longest + um}
    if not fitting:
        return None
    length = max(fitting, key=lambda own: (round(fitting[own], 6) if made_part else 0.0, -own))
    return fitting[length], engaged[length]
