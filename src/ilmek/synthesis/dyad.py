"""Two-link arms (RR dyads) through given places: three poses, or four points timed by the first link.

    p_i = a0 e^{i th0} + a1 e^{i th1_i} + a2 e^{i th2_i}

Pivot O = a0 e^{i th0}, first link a1, second link a2, p its end; all angles absolute. Where the equation of place 1 is
taken from the others, both tasks are pencils (A + x B) v = 0 in one length x: all solutions at once, no starting
values, and none of the divisions at which the elimination by hand breaks down.

[thesis 2.1.3, there by superposition, with misprints that `ilmek reproduce --paper thesis` names; knotting report, 2]
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from jaxtyping import Complex, Float

from ilmek.arrays import ComplexArray, FloatArray, RealField
from ilmek.errors import ParameterError
from ilmek.num.pencil import Root, real_roots
from ilmek.plane.vectors import dot

FAR = 1e9
"""Distance of a pivot, in sizes of the path, beyond which it counts as infinitely far: the arm would be a slide."""


FAMILY = 1e-9
"""Singular value of the task's pencil, in units of the path, that leaves a length free."""


@dataclass(frozen=True, slots=True)
class Dyad:
    """A two-link arm.

    pivot   O [m], complex      first, second  a1, a2 [m]
    ground  a0 [m] along the ground angle: |O|, with a sign where the ground angle was given

    A negative `first` or `second` is a link of that length that points away from its angle.
    """

    pivot: complex
    ground: float
    first: float
    second: float

    def first_angles(self, points: ComplexArray, second_angles: FloatArray) -> FloatArray:
        """Angles of the first link [rad] at the poses: arg(p - O - a2 e^{i th2})."""
        arrow = points - self.pivot - self.second * np.exp(1j * second_angles)
        return np.asarray(np.angle(arrow * np.sign(self.first)))

    def second_angles(self, points: ComplexArray, first_angles: FloatArray) -> FloatArray:
        """Angles of the second link [rad] at the points: arg(p - O - a1 e^{i th1})."""
        arrow = points - self.pivot - self.first * np.exp(1j * first_angles)
        return np.asarray(np.angle(arrow * np.sign(self.second)))

    def place(self, first_angles: FloatArray, second_angles: FloatArray) -> ComplexArray:
        """The end of the arm p [m]."""
        links = self.first * np.exp(1j * first_angles) + self.second * np.exp(1j * second_angles)
        return np.asarray(self.pivot + links)


class Lengths(NamedTuple):
    """Links of a four-bar [m]."""

    ground: float
    crank: float
    coupler: float
    rocker: float


def dyads_through_poses(
    points: Complex[np.ndarray, "3"], second_angles: Float[np.ndarray, "3"], ground_angle: float
) -> tuple[Dyad, ...]:
    """All arms through three poses of the second link with the pivot on the ray of `ground_angle`: none, 1 or 2.

        a2 (f3 - a0 F) + f4 + a0 f2 = const
        f2 = 2 p · e0,   f3 = 2 p · e2,   f4 = -|p|²,   F = 2 cos(th2 - th0)

    `first` is positive, ground and second carry signs. Sorted by ground. Two arms together are a four-bar whose coupler
    takes the poses: `four_bar`. Raises ParameterError where the poses are no task: not finite, all in one place, or so
    placed that a whole family of arms takes them.                        [knotting report, 2, with F's bracket mended]
    """
    _, size = _frame(points, second_angles)
    # The ray starts at the world's origin, which must stay; lengths are scaled.
    p, e0, e2 = points / size, np.exp(1j * ground_angle), np.exp(1j * second_angles)
    of_ground, of_second = 2 * dot(p, e0), 2 * dot(p, e2)
    of_both, known = 2 * dot(e2, e0), -dot(p, p)
    A = np.stack([_less_first(of_second), _less_first(known)], axis=-1)
    B = np.stack([_less_first(-of_both), _less_first(of_ground)], axis=-1)
    found = []
    for ground, (second, one) in _roots(A, B):
        if abs(one) * FAR < abs(second) or abs(ground) > FAR:
            continue
        pivot, a2 = ground * e0, second / one
        first = abs(p[0] - pivot - a2 * e2[0])
        found.append(Dyad(complex(pivot * size), ground * size, float(first) * size, float(a2) * size))
    return tuple(found)


def dyads_through_points(points: Complex[np.ndarray, "4"], first_angles: Float[np.ndarray, "4"]) -> tuple[Dyad, ...]:
    """All arms whose end is at four points at four angles of the first link: 1 or 3, seldom fewer.

        |p_i - O - a1 e^{i th1_i}|² = a2²,    less the first:    (A + a1 B) (X, Y, 1)^T = 0
        A_i = [-2 dx, -2 dy, d|p|²],    B_i = [2 dcos, 2 dsin, -2 d(x cos + y sin)],    d: row i minus row 1

    `second` is positive, `first` carries a sign. Sorted by `first`. An arm with first = 0 says that the points lie on a
    circle about its pivot; arms with the pivot infinitely far (points on a line) are left out. Raises ParameterError
    where the points are no task: not finite, all in one place, or met by a whole family of arms. [thesis 2.36, 2.37]
    """
    origin, size = _frame(points, first_angles)
    p, u = (points - origin) / size, np.exp(1j * first_angles)
    A = np.stack([_less_first(-2 * p.real), _less_first(-2 * p.imag), _less_first(dot(p, p))], axis=-1)
    B = np.stack([_less_first(2 * u.real), _less_first(2 * u.imag), _less_first(-2 * dot(p, u))], axis=-1)
    found = []
    for first, (x, y, one) in _roots(A, B):
        if abs(one) * FAR < math.hypot(x, y) or abs(first) > FAR:
            continue
        pivot = complex(x, y) / one
        second = abs(p[0] - pivot - first * u[0])
        place = pivot * size + origin
        found.append(Dyad(complex(place), abs(place), first * size, float(second) * size))
    return tuple(found)


def four_bar(one: Dyad, other: Dyad) -> Lengths:
    """The four-bar of two arms through the same poses: their second links are one body, the coupler.

    Both joints of the coupler lie on the line through p along th2, both pivots on the ray of the ground angle, so that
    ground and coupler are the differences of a0 and a2; the two first links are its crank and its rocker.
    """
    return Lengths(abs(other.pivot - one.pivot), abs(one.first), abs(other.second - one.second), abs(other.first))


def _less_first(values: RealField) -> FloatArray:
    """Each value but the first, minus the first."""
    numbers = np.asarray(values)
    return np.asarray(numbers[1:] - numbers[0])


def _frame(points: ComplexArray, angles: FloatArray) -> tuple[complex, float]:
    """The first point and the size of the path: the frame in which the numbers are near 1."""
    if not (np.isfinite(points).all() and np.isfinite(angles).all()):
        raise ParameterError("a point or an angle of the dyad's task is not a number", do="give finite places")
    origin, size = complex(points[0]), float(np.max(np.abs(points - points[0])))
    if size == 0:
        raise ParameterError("all points of the dyad's task are one", do="give places that differ")
    return origin, size


def _roots(A: FloatArray, B: FloatArray) -> tuple[Root, ...]:
    """The real roots of the task's pencil; ParameterError where every length solves it, or one length in many ways."""
    found = real_roots(A, B)
    probes = (0.6180339887, *(root.value for root in found))  # the first is a root by chance only
    ranks = [int(np.linalg.matrix_rank(A + x * B, tol=FAMILY * max(1.0, abs(x)))) for x in probes]
    if ranks[0] < len(A) or any(rank < len(A) - 1 for rank in ranks):
        raise ParameterError(
            "a whole family of dyads solves this task",
            do="move a point or an angle: equal places, or an arm that turns without bending, leave a length free",
        )
    return found
