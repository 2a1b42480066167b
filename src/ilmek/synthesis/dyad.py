"""Two-link arms (RR dyads) through three poses, or through four points with given angles of the first link.

    p_i = a0 e^{i th0} + a1 e^{i th1_i} + a2 e^{i th2_i}

Pivot O = a0 e^{i th0}, first link a1, second link a2, p its end; all angles absolute. With the equation of point 1
subtracted from the others, both tasks are matrix pencils (A + x B) v = 0 in one length x. All solutions follow at once,
without starting values and without the divisions at which the elimination by hand fails. Tasks are solved in batches of
any size, and every root has a kind: `arms_through_poses`, `arms_through_points`.

[thesis 2.1.3, there by superposition, with misprints listed by `ilmek reproduce --paper thesis`; knotting report, 2]
"""

from dataclasses import dataclass, fields
from enum import IntEnum
from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, Complex, ComplexArray, ComplexField, Float, FloatArray, Int8, RealField
from ilmek.errors import ParameterError
from ilmek.num.pencil2 import roots2
from ilmek.num.pencil3 import Roots, roots3
from ilmek.plane.vectors import cross, dot, unit
from ilmek.records import record
from ilmek.synthesis.burmester.constant_distance import FAR, require_task, timed_forms
from ilmek.synthesis.task import require_angles

BLOCK = 4096
"""Tasks solved at a time, so that their arrays stay in the cache."""

STILL = 1e-11
"""Length of the first link, relative to the size of the path, below which it counts as 0."""


@dataclass(frozen=True, slots=True)
class TwoLinkArm:
    """A two-link arm.

    pivot          O [m], complex
    ground         a0 [m] along the ground angle: |O|, with a sign where the ground angle was given
    first, second  a1, a2 [m]; a negative value is a link that points opposite to its angle
    """

    pivot: complex
    ground: float
    first: float
    second: float

    def first_angles(self, points: ComplexArray, second_angles: FloatArray) -> FloatArray:
        """Angles of the first link [rad] from points [m], angles of the second [rad]: arg(p - O - a2 e^{i th2})."""
        arrow = points - self.pivot - self.second * np.exp(1j * second_angles)
        return np.asarray(np.angle(arrow * np.sign(self.first)))

    def second_angles(self, points: ComplexArray, first_angles: FloatArray) -> FloatArray:
        """Angles of the second link [rad] from points [m], angles of the first [rad]: arg(p - O - a1 e^{i th1})."""
        arrow = points - self.pivot - self.first * np.exp(1j * first_angles)
        return np.asarray(np.angle(arrow * np.sign(self.second)))

    def end_position(self, first_angles: FloatArray, second_angles: FloatArray) -> ComplexArray:
        """Position p of the arm's end [m] at angles of both links [rad], of any shape."""
        links = self.first * np.exp(1j * first_angles) + self.second * np.exp(1j * second_angles)
        return np.asarray(self.pivot + links)


class Lengths(NamedTuple):
    """Link lengths of a four-bar [m]."""

    ground: float
    crank: float
    coupler: float
    rocker: float


class RootKind(IntEnum):
    """Kind of a root of a task with four timed points or three poses."""

    ARM = 0
    COMPLEX = 1
    STILL = 2
    FAR_PIVOT = 3
    LINE = 4
    LONG = 5
    FAMILY = 6
    FAR_ELBOW = 7
    FAR_BOTH = 8

    @property
    def words(self) -> str:
        """Description of the kind."""
        return WORDS[self]


WORDS = {
    RootKind.ARM: "an arm",
    RootKind.COMPLEX: "no real arm",
    RootKind.STILL: "the points lie on a circle about the pivot: the first link has no length",
    RootKind.FAR_PIVOT: "the pivot is infinitely far: the first link would rotate on a slide",
    RootKind.LINE: "the points lie on a line: the pivot is infinitely far and the first link has no length",
    RootKind.LONG: "both links are infinitely long",
    RootKind.FAMILY: "a family of arms solves this task, or the task is not valid",
    RootKind.FAR_ELBOW: "the elbow is infinitely far: a line of the second link would slide through the pivot",
    RootKind.FAR_BOTH: "pivot and elbow are infinitely far: the second link keeps its angle to the ground ray",
}


@record
class PoseArms:
    """Both roots of three-pose tasks, in the order of `ground`.

    pivot           O [m], complex; of an infinitely far pivot the unit vector of the ray
    ground, second  a0, a2 [m] with their signs; inf where infinite, NaN where there is no real arm or any value holds
    first           a1 [m], 0 or more
    found           `RootKind` of each root
    """

    pivot: Complex[np.ndarray, "*batch 2"]
    ground: Float[np.ndarray, "*batch 2"]
    first: Float[np.ndarray, "*batch 2"]
    second: Float[np.ndarray, "*batch 2"]
    found: Int8[np.ndarray, "*batch 2"]


def arms_through_poses(
    points: Complex[np.ndarray, "*batch 3"],
    second_angles: Float[np.ndarray, "*batch 3"],
    ground_angle: RealField,
    start: ComplexField = 0j,
) -> PoseArms:
    """All arms through three poses of the second link with the pivot on a ray: a batch of tasks, two roots each.

        a2 (f3 - a0 F) + f4 + a0 f2 = const
        f2 = 2 p · e0,   f3 = 2 p · e2,   f4 = -|p|²,   F = 2 cos(th2 - th0)

    points         positions of the second link's end [m], complex, shape (*batch, 3)
    second_angles  angles of the second link [rad], shape (*batch, 3)
    ground_angle   direction of the ray [rad], shape (*batch)
    start          start of the ray [m]; default: the origin

    The origin is shifted to the point of the ray nearest to the first point. No task raises: an invalid one has the
    kind FAMILY.                                                   [knotting report, 2, with the bracket of F corrected]

    >>> along = arms_through_poses(np.array([0, 3 + 0j, 5 + 0j]), np.array([0.0, 0.4, -0.2]), np.pi / 2)
    >>> [RootKind(int(one)).name for one in along.found], along.ground.round(9).tolist()  # p itself goes along x
    (['ARM', 'FAR_PIVOT'], [2.167450549, inf])
    """
    finite = np.isfinite(points).all(axis=-1) & np.isfinite(second_angles).all(axis=-1) & np.isfinite(ground_angle)
    usable = np.asarray(finite)
    angles = np.where(usable[..., None], second_angles, 0)
    moved = np.where(usable[..., None], points - points[..., :1], 0)
    e0, e2 = np.asarray(unit(np.where(usable, ground_angle, 0))), np.asarray(unit(angles))
    first = np.where(usable, points[..., 0] - start, 0)
    aside = 1j * e0 * cross(e0, first)
    size = np.maximum(np.max(np.abs(moved), axis=-1), np.abs(aside))
    size = np.where(size > 0, size, 1.0)
    q = (moved + aside[..., None]) / size[..., None]
    roots = roots2(*_pose_pencil(q, moved / size[..., None], e0[..., None], e2))
    found = _pose_root_kinds(roots, usable)
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        along, second = roots.numerator / roots.denominator, roots.vectors[..., 0] / roots.vectors[..., 1]
    far = np.isin(found, (RootKind.FAR_PIVOT, RootKind.FAR_BOTH))
    none = np.isin(found, (RootKind.COMPLEX, RootKind.FAMILY))
    second = np.where(np.isin(found, (RootKind.FAR_ELBOW, RootKind.FAR_BOTH)), np.inf, second)
    second = np.where(none | (far & ~roots.alone), np.nan, second)
    scale, foot, arm = size[..., None], np.asarray(dot(e0, first))[..., None], found == RootKind.ARM
    with np.errstate(invalid="ignore"):
        reach = np.abs(q[..., :1] - along * e0[..., None] - second * e2[..., :1])
        length = np.where(arm, reach, np.where(none, np.nan, np.inf))
        ground = np.where(none, np.nan, np.where(far, np.inf, along * scale + foot))
        pivot = np.where(far, e0[..., None], np.asarray(start)[..., None] + ground * e0[..., None])
    pivot = np.where(none, np.nan, pivot)
    order = np.argsort(ground, axis=-1)  # infinite and NaN come last
    parts = pivot, ground, length * scale, second * scale, found
    return PoseArms(*(np.take_along_axis(part, order, axis=-1) for part in parts))


def dyads_through_poses(
    points: Complex[np.ndarray, "3"], second_angles: Float[np.ndarray, "3"], ground_angle: float, start: complex = 0j
) -> tuple[TwoLinkArm, ...]:
    """Arms with finite links through three poses of the second link, the pivot on a ray: none, 1 or 2.

    The arguments are those of `arms_through_poses`, for one task. Sorted by `ground`; `first` is positive, `ground` and
    `second` have signs. Two arms together are a four-bar whose coupler takes the poses: `four_bar`. Raises
    ParameterError for values that are not finite, angles in degrees, points that all coincide, and poses taken by a
    family of arms.
    """
    _frame(points, second_angles)
    require_angles("angle of the second link", second_angles)
    arms = arms_through_poses(points, second_angles, ground_angle, start)
    if np.any(arms.found == RootKind.FAMILY):
        raise _family()
    return tuple(
        TwoLinkArm(complex(pivot), float(ground), float(first), float(second))
        for pivot, ground, first, second, found in zip(*_each(arms), strict=True)
        if found == RootKind.ARM
    )


@record
class PointArms:
    """All roots of four-point tasks, three each, in the order of `first`.

    pivot          O [m], complex; of an infinitely far pivot its direction, a unit vector
    first, second  a1 with its sign, a2 [m]; inf where infinite, NaN where there is no real arm
    found          `RootKind` of each root
    """

    pivot: Complex[np.ndarray, "*batch 3"]
    first: Float[np.ndarray, "*batch 3"]
    second: Float[np.ndarray, "*batch 3"]
    found: Int8[np.ndarray, "*batch 3"]


def arms_through_points(
    points: Complex[np.ndarray, "*batch 4"], first_angles: Float[np.ndarray, "*batch 4"]
) -> PointArms:
    """All arms whose end is at four points at four angles of the first link: a batch of tasks, three roots each.

        |p_i - O - a1 e^{i th1_i}|² = a2²,    minus the first:    (A + a1 B) (O - p_1, 1)^T = 0

    points  [m], complex, shape (*batch, 4)      first_angles  [rad], shape (*batch, 4)

    A and B are columns of the forms G of `burmester.constant_distance`, with W = a1 e^{i th1_1} as the moving point. No
    task raises: an invalid one has the kind FAMILY.                                                 [thesis 2.36, 2.37]

    >>> arms = arms_through_points(np.array([0, 2, 2 + 2j, 2j]), np.array([0.1, 0.7, 1.9, 3.0]))
    >>> [RootKind(one).name for one in arms.found], complex(np.round(arms.pivot[0], 12))  # a circle about 1 + i
    (['STILL', 'COMPLEX', 'COMPLEX'], (1+1j))
    """
    batch = points.shape[:-1]
    flat, angles = points.reshape(-1, 4), first_angles.reshape(-1, 4)
    parts = [_arms(flat[k : k + BLOCK], angles[k : k + BLOCK]) for k in range(0, max(len(flat), 1), BLOCK)]
    whole = [np.concatenate([getattr(part, field.name) for part in parts]) for field in fields(PointArms)]
    return PointArms(*(one.reshape(*batch, 3) for one in whole))


def dyads_through_points(points: ComplexArray, first_angles: FloatArray) -> tuple[TwoLinkArm, ...]:
    """Arms with finite links whose end is at four points at four angles of the first link: 1 or 3, rarely fewer.

    The arguments are those of `arms_through_points`, for one task. Sorted by `first`; `second` is positive, `first` has
    a sign. An arm with first = 0 means that the points lie on a circle about its pivot. Raises ParameterError for a
    number of points other than four, values that are not finite, equal points, angles in degrees, and points met by a
    family of arms.
    """
    _frame(points, first_angles)
    require_task("timed point", points, first_angles, 4, "dyads_through_points")
    arms = arms_through_points(points, first_angles)
    if np.any(arms.found == RootKind.FAMILY):
        raise _family()
    return tuple(
        TwoLinkArm(complex(pivot), abs(pivot), float(first), float(second))
        for pivot, first, second, found in zip(arms.pivot, arms.first, arms.second, arms.found, strict=True)
        if found in (RootKind.ARM, RootKind.STILL)
    )


def four_bar(one: TwoLinkArm, other: TwoLinkArm) -> Lengths:
    """Lengths [m] of the four-bar formed by two arms through the same poses; their second links are the coupler.

    Both joints of the coupler are on the line through p along th2 and both pivots on the ray of the ground angle. So
    ground and coupler are the differences of a0 and of a2; the first links are crank and rocker.
    """
    return Lengths(abs(other.pivot - one.pivot), abs(one.first), abs(other.second - one.second), abs(other.first))


def _frame(points: ComplexArray, angles: FloatArray) -> tuple[complex, float]:
    """Origin and size of the frame in which the numbers are near 1: first point and extent of the path [m]."""
    if not (np.isfinite(points).all() and np.isfinite(angles).all()):
        raise ParameterError("a point or an angle of the dyad's task is not finite", do="give finite values")
    origin, size = complex(points[0]), float(np.max(np.abs(points - points[0])))
    if size == 0:
        raise ParameterError("all points of the dyad's task are the same", do="give different points")
    return origin, size


def _each(arms: PoseArms) -> tuple[np.ndarray, ...]:
    """Pivots, grounds, first and second links, and kinds."""
    return arms.pivot, arms.ground, arms.first, arms.second, arms.found


def _pose_pencil(
    q: Complex[np.ndarray, "*batch 3"],
    moved: Complex[np.ndarray, "*batch 3"],
    e0: Complex[np.ndarray, "*batch 1"],
    e2: Complex[np.ndarray, "*batch 3"],
) -> tuple[Float[np.ndarray, "*batch 2 2"], Float[np.ndarray, "*batch 2 2"]]:
    """A and B of (A + a0 B) (a2, 1)^T = 0: poses 2 and 3 minus the first; `moved` are points relative to the first."""
    known = -np.asarray(dot(moved[..., 1:], q[..., 1:] + q[..., :1]))
    of_second = np.asarray(dot(q, e2))
    A = np.stack([2 * (of_second[..., 1:] - of_second[..., :1]), known], axis=-1)
    B = np.stack(
        [-2 * np.asarray(dot(e0, e2[..., 1:] - e2[..., :1])), 2 * np.asarray(dot(e0, moved[..., 1:]))], axis=-1
    )
    return A, B


def _pose_root_kinds(roots: Roots, usable: BoolArray) -> Int8[np.ndarray, "*batch 2"]:
    """Kind of each root of a three-pose task."""
    x, k, vectors = roots.numerator, roots.denominator, roots.vectors
    far = np.abs(k) * FAR <= np.abs(x)
    straight = roots.alone & (np.abs(vectors[..., 1]) * FAR <= np.abs(vectors[..., 0]))
    cases = [
        ((roots.free | ~usable)[..., None] | np.zeros_like(far), RootKind.FAMILY),
        (~roots.real, RootKind.COMPLEX),
        (far & straight, RootKind.FAR_BOTH),
        (far, RootKind.FAR_PIVOT),
        (~roots.alone, RootKind.FAMILY),
        (straight, RootKind.FAR_ELBOW),
    ]
    return np.select([test for test, _ in cases], [value for _, value in cases], RootKind.ARM).astype(np.int8)


def _family() -> ParameterError:
    return ParameterError(
        "a family of dyads solves this task",
        do="change a point or an angle: with equal points, or an arm that rotates as a rigid body, a length is free",
    )


def _arms(points: Complex[np.ndarray, "n 4"], angles: Float[np.ndarray, "n 4"]) -> PointArms:
    """Arms of a block of tasks."""
    usable = np.isfinite(points).all(axis=-1) & np.isfinite(angles).all(axis=-1)
    points, angles = np.where(usable[:, None], points, 0), np.where(usable[:, None], angles, 0)
    size = np.max(np.abs(points - points[:, :1]), axis=-1)
    size = np.where(size > 0, size, 1.0)
    start = np.asarray(unit(angles[:, 0]))
    G = timed_forms(points, angles, size)
    A = G[..., 2]
    B = G[..., 0] * start.real[:, None, None] + G[..., 1] * start.imag[:, None, None]
    roots = roots3(A, B)
    found = _point_root_kinds(roots, usable)
    with np.errstate(divide="ignore", invalid="ignore"):
        first = roots.numerator / roots.denominator
        away = -(roots.vectors[..., 0] + 1j * roots.vectors[..., 1])  # the moving point of the forms is -(O - p_1)
        far = np.isin(found, (RootKind.FAR_PIVOT, RootKind.LINE))
        pivot = np.where(far, away / np.abs(away), size[:, None] * away / roots.vectors[..., 2] + points[:, :1])
        first = np.where(found == RootKind.LONG, np.inf, np.where(found == RootKind.STILL, 0.0, first * size[:, None]))
        second = np.where(
            far | (found == RootKind.LONG), np.inf, np.abs(points[:, :1] - pivot - first * start[:, None])
        )
    none = np.isin(found, (RootKind.COMPLEX, RootKind.FAMILY))
    first, second, pivot = (np.where(none, np.nan, one) for one in (first, second, pivot))
    order = np.argsort(first, axis=-1)  # NaN comes last
    return PointArms(*(np.take_along_axis(one, order, axis=-1) for one in (pivot, first, second, found)))


def _point_root_kinds(roots: Roots, usable: np.ndarray) -> Int8[np.ndarray, "n 3"]:
    """Kind of each root of a four-point task."""
    x, k, vectors = roots.numerator, roots.denominator, roots.vectors
    far = np.abs(vectors[..., 2]) * FAR <= np.hypot(vectors[..., 0], vectors[..., 1])
    still = np.abs(x) <= STILL * np.abs(k)
    free = (roots.free | ~usable)[:, None] | (roots.real & ~roots.alone)
    cases = [
        (free, RootKind.FAMILY),
        (~roots.real, RootKind.COMPLEX),
        (np.abs(k) * FAR <= np.abs(x), RootKind.LONG),
        (far & still, RootKind.LINE),
        (far, RootKind.FAR_PIVOT),
        (still, RootKind.STILL),
    ]
    return np.select([test for test, _ in cases], [value for _, value in cases], RootKind.ARM).astype(np.int8)
