"""The holes for screws in a part, one after the other: apart from each other, and at last in its shape.

A hole along a prism through all of it is one of its section, so that what cuts the section cuts it too; all others are
drilled. The hole in the end of a turned shape is in its profile.
"""

from collections import defaultdict
from dataclasses import dataclass, field, replace

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.part.features import drillings
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.seat_faces import SeatFace, prism_of
from ilmek.part.shapes import Drilling, Placed, Prism, Shape, Sum, Turned
from ilmek.plane.contours import circle, polygon
from ilmek.units import mm, um

_WALL = 1 * mm
"""Material between holes at least [m]; assumed by this project."""

_ALONG = 1e-9
"""Deviation of a direction that counts as rounding."""


@dataclass(frozen=True, eq=False)
class DrilledPart:
    """A part with its holes so far, those in a face with it."""

    part: Part
    holes: list[tuple[SeatFace, Drilling]] = field(default_factory=list)
    axes: list[FloatArray] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.axes.extend(axis for hole in drillings(self.part.shape) for axis in _axes(hole))

    def has_room(self, hole: Drilling) -> bool:
        """Whether a hole keeps off all others, or is one of them: of the same part on others like it."""
        if not self.axes or self._has(hole):
            return True
        others = np.array(self.axes)
        return all(bool((_apart(own, others) >= own[6] + others[:, 6] + _WALL).all()) for own in _axes(hole))

    def drill(self, face: SeatFace, hole: Drilling) -> None:
        """One more hole, if it is none of them."""
        if self._has(hole):
            return
        self.holes.append((face, hole))
        self.axes.extend(_axes(hole))

    def _has(self, hole: Drilling) -> bool:
        return any(_is_same(hole, other) for _, other in self.holes)

    @property
    def finished(self) -> Part:
        """The part with its holes."""
        shape, members = self.part.shape, defaultdict[int, list[Drilling]](list)
        assert shape is not None
        for face, hole in self.holes:
            members[face.member].append(hole)
        if isinstance(shape, Turned):
            return replace(self.part, shape=_with_threads(shape, members[-1]))
        if isinstance(shape, Sum):
            each = (_member(shape, number, members.get(number)) for number in range(len(shape.members)))
            return replace(self.part, shape=Sum(tuple(each)))
        return replace(self.part, shape=_with_holes(shape, -1, members[-1]))


def _is_same(one: Drilling, other: Drilling) -> bool:
    """Whether two holes are one: mouths, axes and steps; a plain one through a part also from behind."""
    first, second = (np.append(_axis(own), np.ravel(own.steps)) for own in (one, other))
    if len(first) != len(second):
        return False
    same = bool(np.abs(first - second).max() < um)
    if same or not (one.through and other.through and len(one.steps) == 1):
        return same
    second[:3] += second[3:6] * other.steps[0][1]
    second[3:6] *= -1
    return bool(np.abs(first - second).max() < um)


def _axis(hole: Drilling) -> Float[np.ndarray, " 6"]:
    """Mouth and direction of a hole."""
    return np.append(hole.position.origin, hole.position.rotation[:, 2])


def _member(shape: Sum, number: int, holes: list[Drilling] | None) -> Placed:
    own = shape.members[number]
    return own if holes is None else Placed(_with_holes(shape, number, holes), own.positions)


def _with_holes(shape: Shape, member: int, holes: list[Drilling]) -> Prism:
    prism, back = prism_of(shape, member)
    cut, drilled = list(prism.section.holes), list(prism.drilled)
    for hole in holes:
        lies = back.after(hole.position)
        if hole.through and abs(lies.rotation[2, 2]) > 1 - _ALONG:
            bore = hole.steps[-1][0]
            cut.append(circle(complex(*lies.origin[:2].round(12)), bore / 2))
            if len(hole.steps) > 1:
                drilled.append(Drilling(lies, hole.steps[:1], bore))
        else:
            drilled.append(replace(hole, position=lies))
    section = prism.section
    return Prism(Profile(section.outline, tuple(cut), section.smooth), prism.length, tuple(drilled))


def _with_threads(shape: Turned, holes: list[Drilling]) -> Turned:
    """A turned shape with holes along its axis from its ends."""
    corners = shape.profile.outline
    points, bulges = corners.points.tolist(), corners.bulges.tolist()
    for hole in holes:
        (diameter, deep), z = hole.steps[0], float(hole.position.origin[2])
        number = next(k for k, own in enumerate(points) if abs(own - z) < _ALONG)
        inner = z + deep * float(hole.position.rotation[2, 2])
        rim, floor = complex(z, diameter / 2), complex(inner, diameter / 2)
        forward = abs(points[(number + 1) % len(points)].real - z) < _ALONG  # the outline goes out along this end
        added = [complex(inner), floor, rim] if forward else [rim, floor, complex(inner)]
        points[number : number + 1] = added
        bulges[number : number + 1] = [0.0, 0.0, bulges[number]]
    return Turned(Profile(replace(polygon(np.array(points)), bulges=np.array(bulges)), shape.profile.holes))


def _axes(hole: Drilling) -> list[FloatArray]:
    """Begin and end of the axis of each step of a hole, and its radius [m]."""
    begin, axes = 0.0, []
    for diameter, length in hole.steps:
        ends = (hole.position.after(placement(z=z)).origin for z in (begin, begin + length))
        axes.append(np.concatenate([*ends, [diameter / 2]]))
        begin += length
    return axes


def _apart(own: FloatArray, others: Float[np.ndarray, "n 7"]) -> FloatArray:
    """Distances of a piece of a line from others [m].            [Ericson, Real-Time Collision Detection, 5.1.9]"""
    first, second = own[3:6] - own[:3], others[:, 3:6] - others[:, :3]
    away = own[:3] - others[:, :3]
    a, e = float(first @ first), (second * second).sum(1)
    b, c, f = second @ first, away @ first, (second * away).sum(1)
    across = a * e - b * b
    parallel = across < _ALONG * a * e
    s = np.where(parallel, 0.0, np.clip((b * f - c * e) / np.where(parallel, 1.0, across), 0.0, 1.0))
    t = np.clip((b * s + f) / e, 0.0, 1.0)
    s = np.clip((b * t - c) / a, 0.0, 1.0)
    t = np.clip((b * s + f) / e, 0.0, 1.0)
    return np.asarray(np.linalg.norm(away + s[:, None] * first - t[:, None] * second, axis=1))
