"""The coordinates by which the bodies of a tree move, those that its closures leave free, and those that drive it.

A pin turns about a point p of its body, a slide shifts along a direction d. What a body's motion shows decides:

    shift(q) = p - R(rotation(q)) p:    one turn about p            else:   slides, then a turn about the origin

Velocities of what two bodies share in a closure are equal: J(q) dq = 0. The degrees of freedom are the coordinates less
the rank of J at a generic pose; of the coordinates in loops the first, in the order of the tree, drive the others.
                                                                          [Angeles, Spatial Kinematic Chains, 4]
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.part.placement import Placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.tree import Axis, Closure, Joint, JointKind, RigidBody, Tree
from ilmek.records import record
from ilmek.report.scene import SceneMotion

_ROUNDING = 1e-9
"""Shift [m], or share of a column of the Jacobian, that counts as rounding."""

_INDEPENDENT = 1e-7
"""Length of what is left of a row of the Jacobian that counts as rounding."""

_PARALLEL = 0.99
"""Least cosine of the directions of a slide and of the transmission to it."""

_PIVOT = 1e-6
"""How far a body may be from turning about a point [m]."""

_GENERIC = (0.7, 2.1, 3.9)
"""Angles of the drives at which the rank is taken, the largest of them [rad]."""

_UNITS = np.eye(3)


@record
class BodyCoordinate:
    """A coordinate of a body in its parent: it turns about an axis [rad], or shifts along it [m].

    turns   whether it turns       axis  unit vector in the body's frame       point  on the axis of a turn [m]
    motion  that it has part in; None: nothing moves it     value  of the coordinate at the samples of the motion
    """

    turns: bool
    axis: Axis
    point: Axis = (0.0, 0.0, 0.0)
    motion: SceneMotion | None = None
    value: FloatArray | None = None

    def slope(self, drive: str, angle: float) -> float:
        """Its derivative by the angle of a drive, all other drives at 0."""
        if self.motion is None or self.value is None or self.motion.drive != drive:
            return 0.0
        after = int(np.clip(np.searchsorted(self.motion.angle, angle, side="right"), 1, len(self.motion.angle) - 1))
        rise, run = np.diff(self.value[after - 1 : after + 1]), np.diff(self.motion.angle[after - 1 : after + 1])
        return float(rise[0] / run[0])

    def at(self, drive: str, angle: float) -> float:
        """Its value at an angle of a drive [rad], all other drives at 0."""
        if self.motion is None or self.value is None:
            return 0.0
        return float(np.interp(angle if self.motion.drive == drive else 0.0, self.motion.angle, self.value))


def coordinates(body: RigidBody) -> tuple[BodyCoordinate, ...]:
    """The coordinates of a body in its parent, slides first; by its joint where no motion moves it."""
    motion = body.joint.motion
    if motion is None or not (motion.rotation.any() or np.abs(motion.shift).max() > _ROUNDING):
        return tuple(_at_rest(body.joint))
    turn = tuple(_turn(body.joint, motion))
    if turn and turn[0].point != (0.0, 0.0, 0.0):
        return turn
    return (*_slides(motion), *turn)


def _at_rest(joint: Joint) -> Iterator[BodyCoordinate]:
    axis = _unit(np.array(joint.axis))
    if joint.kind in {JointKind.SLIDE, JointKind.SCREW}:
        yield BodyCoordinate(False, axis)
    if joint.kind in {JointKind.PIN, JointKind.SCREW}:
        yield BodyCoordinate(True, axis)


def _turn(joint: Joint, motion: SceneMotion) -> Iterator[BodyCoordinate]:
    """The turn of a motion, about the point that it leaves where it is, if there is one."""
    if not motion.rotation.any():
        return
    axis = _unit(np.array(joint.axis))
    point = _pivot(np.array(axis), motion)
    yield BodyCoordinate(True, axis, (0.0, 0.0, 0.0) if point is None else _triple(point), motion, motion.rotation)


def _pivot(axis: FloatArray, motion: SceneMotion) -> Float[np.ndarray, " 3"] | None:
    """The point of a body, nearest to its origin, that a motion does not move; None where it moves all."""
    across = np.array([np.cross(axis, unit) for unit in _UNITS]).T
    sine, cosine = np.sin(motion.rotation)[:, None, None], np.cos(motion.rotation)[:, None, None]
    left = -sine * across - (1 - cosine) * (across @ across)
    point = np.linalg.lstsq(left.reshape(-1, 3), motion.shift.reshape(-1), rcond=1e-9)[0]
    point = np.where(np.abs(point) > _ROUNDING, point, 0.0)
    return point if np.abs(left @ point - motion.shift).max() <= _PIVOT and point.any() else None


def _slides(motion: SceneMotion) -> Iterator[BodyCoordinate]:
    """Slides along the line of a motion, else along the axes that it goes along."""
    _, sizes, lines = np.linalg.svd(motion.shift, full_matrices=False)
    number = int(np.sum(sizes > _ROUNDING * max(float(sizes[0]), 1.0)))
    if number == 1:
        line = lines[0] * np.sign(lines[0][np.argmax(np.abs(lines[0]))])
        yield BodyCoordinate(False, _unit(line), motion=motion, value=motion.shift @ line)
    elif number > 1:
        for axis, unit in enumerate(_UNITS):
            if np.abs(motion.shift[:, axis]).max() > _ROUNDING:
                yield BodyCoordinate(False, _unit(unit), motion=motion, value=motion.shift[:, axis])


def _unit(vector: FloatArray) -> Axis:
    return _triple(vector / np.linalg.norm(vector))


def _triple(vector: FloatArray) -> Axis:
    x, y, z = vector.tolist()
    return x, y, z


@dataclass(frozen=True)
class TreeMobility:
    """The coordinates of a tree, one for each place of its body, with the chain of the body."""

    tree: Tree

    @cached_property
    def coordinates(self) -> tuple[tuple[Chain, BodyCoordinate], ...]:
        """All coordinates, in the order of the bodies."""
        own = {body.id: coordinates(body) for body in self.tree.bodies}
        return tuple((chain, one) for chain in chains(self.tree) for one in own[chain[-1].name])

    @cached_property
    def _columns(self) -> Mapping[Chain, tuple[int, ...]]:
        columns: dict[Chain, list[int]] = {}
        for number, (chain, _) in enumerate(self.coordinates):
            columns.setdefault(chain, []).append(number)
        return {chain: tuple(numbers) for chain, numbers in columns.items()}

    @cached_property
    def closed(self) -> tuple[tuple[Closure, Chain, Chain], ...]:
        """The closures, one for each two places of bodies that it holds together; none that lacks what keeps it."""
        parts = {part.id for part, _ in self.tree.occurrences()}
        places: dict[str, list[Chain]] = {body.id: [] for body in self.tree.bodies}
        for chain in chains(self.tree):
            places[chain[-1].name].append(chain)
        return tuple(
            (closure, *pair)
            for closure in self.tree.closures
            if parts.issuperset(closure.kept_by)
            for pair in _pairs(*(places[of] for of in closure.bodies))
        )

    @property
    def driven(self) -> tuple[int, ...]:
        """Numbers of the coordinates that the closures leave free: the others follow."""
        return left_free(self.jacobian)

    @property
    def degrees_of_freedom(self) -> int:
        """Number of coordinates less the rank of the closures."""
        return len(self.driven)

    def transmission(self, closure: Closure, first: Chain, second: Chain) -> tuple[int, int] | None:
        """Numbers of the coordinates of a transmission, the one that follows last; None: the second has none."""
        (leading, *_), following = self._columns.get(first, (0,)), self._columns.get(second, ())
        if closure.along is not None:
            along = np.array(closure.along)
            slides = [(number, self.coordinates[number][1]) for number in following]
            following = tuple(number for number, one in slides if not one.turns and abs(along @ one.axis) > _PARALLEL)
        return (leading, following[0]) if following else None

    @cached_property
    def jacobian(self) -> Float[np.ndarray, "rows coordinates"]:
        """What the closures require of the velocities: of several generic poses the one of the greatest rank."""
        drives = {one.motion.drive for _, one in self.coordinates if one.motion is not None} or {""}
        every = (_Pose(self, drive, angle) for drive in sorted(drives) for angle in _GENERIC)
        none = np.zeros((0, len(self.coordinates)))
        return max(
            (np.concatenate([none, *(at.rows(*closed) for closed in self.closed)]) for at in every),
            key=lambda rows: len(independent_rows(rows)),
        )


def rate(leading: BodyCoordinate, following: BodyCoordinate, drive: str, angle: float) -> float:
    """Velocity of a coordinate over that of the one that it follows; 0 where that stands."""
    first = leading.slope(drive, angle)
    return following.slope(drive, angle) / first if first else 0.0


def independent_rows(rows: Float[np.ndarray, "rows columns"]) -> list[int]:
    """Numbers of the rows that no rows before them combine to: by Gram and Schmidt, each twice [Giraud 2005].

    >>> independent_rows(np.array([[1.0, 0.0], [2.0, 0.0], [0.0, 0.0], [1.0, 1.0]]))
    [0, 3]
    """
    base, chosen = np.empty((min(rows.shape), rows.shape[1])), list[int]()
    for number, row in enumerate(rows):
        known = base[: len(chosen)]
        left = row - (row @ known.T) @ known
        left -= (left @ known.T) @ known
        length = float(np.linalg.norm(left))
        if length > _INDEPENDENT and len(chosen) < len(base):
            base[len(chosen)] = left / length
            chosen.append(number)
    return chosen


def left_free(rows: Float[np.ndarray, "rows columns"]) -> tuple[int, ...]:
    """Numbers of the columns that the others follow, as few as the rank leaves, the first ones.

    >>> left_free(np.array([[1.0, -2.0, 0.0]]))
    (0, 2)
    """
    last = rows.shape[1] - 1
    following = {last - column for column in independent_rows(rows.T[::-1])}
    return tuple(number for number in range(last + 1) if number not in following)


def _pairs(first: list[Chain], second: list[Chain]) -> Iterator[tuple[Chain, Chain]]:
    if first == second:
        return ((first[0], other) for other in first[1:])
    most = max(len(first), len(second))
    if {len(first), len(second)} - {1, most}:
        raise ParameterError(f"{len(first)} bodies closed with {len(second)}", allowed="as many, or one with many")
    return zip(first * (most // len(first)), second * (most // len(second)), strict=True)


@dataclass(frozen=True)
class _Pose:
    """The tree at an angle of a drive [rad]."""

    mobility: TreeMobility
    drive: str
    angle: float

    def place(self, chain: Chain) -> Placement:
        here = poses(chain, self.drive, np.array([self.angle]))
        return Placement(here.origin[0], here.rotation[0])

    def rows(self, closure: Closure, first: Chain, second: Chain) -> Float[np.ndarray, "rows coordinates"]:
        """Velocities of the second body less those of the first, over those of the coordinates."""
        if closure.kind == JointKind.ROLLING:
            row = np.zeros((1, len(self.mobility.coordinates)))
            row[0, self._turning(second)], row[0, self._turning(first)] = 1.0, -closure.ratio
            return row
        if closure.kind == JointKind.TRANSMISSION:
            return self._transmitted(closure, first, second)
        point = self.place(first).points(closure.position.origin)
        moved = self._velocities(second, point) - self._velocities(first, point)
        return np.asarray(moved if closure.kind == JointKind.FIXED else moved[:3])

    def _transmitted(self, closure: Closure, first: Chain, second: Chain) -> Float[np.ndarray, "1 coordinates"]:
        row, numbers = np.zeros((1, len(self.mobility.coordinates))), self.mobility.transmission(closure, first, second)
        if numbers is not None:
            leading, following = (self.mobility.coordinates[number][1] for number in numbers)
            row[0, numbers[1]], row[0, numbers[0]] = 1.0, -rate(leading, following, self.drive, self.angle)
        return row

    def _turning(self, chain: Chain) -> int:
        all_of_them = self.mobility.coordinates
        (number,) = (number for number in self.mobility._columns[chain] if all_of_them[number][1].turns)
        return number

    def _velocities(self, chain: Chain, point: FloatArray) -> Float[np.ndarray, "6 coordinates"]:
        """Velocity of a body at a point, and its angular velocity, for a unit velocity of each coordinate."""
        velocities = np.zeros((6, len(self.mobility.coordinates)))
        for length in range(1, len(chain) + 1):
            part = chain[:length]
            before = (
                self.place(part[:-1]).rotation @ part[-1].position.rotation
                if length > 1
                else part[-1].position.rotation
            )
            for number in self.mobility._columns.get(part, ()):
                one = self.mobility.coordinates[number][1]
                axis = before @ np.array(one.axis)
                if one.turns:
                    arm = point - self.place(part).points(np.array(one.point))
                    velocities[:3, number], velocities[3:, number] = np.cross(axis, arm), axis
                else:
                    velocities[:3, number] = axis
        return velocities
