"""Constant distance of a moving from a fixed point: the equation of poses, timed points and arms through them.

A body is displaced from its first pose by z -> α z + t, with α = e^{iδ}. Its point w keeps its distance from the fixed
point m if

    |α w + t - m|² - |w - m|²  =  2 m̃ᵀ G w̃  =  0,      w̃ = (x_w, y_w, 1),   m̃ = (x_m, y_m, 1)
    m̃ᵀ G w̃  =  |t|²/2 + Re(conj(t) α w) - Re(conj(t) m) + Re(conj(w) m (1 - conj(α)))

which is linear in each of the two. w̃ and m̃ are homogeneous; a point at infinity (last number 0) is regular: a pin on
a straight line, or a line of the body through a fixed point.

Motion generation requires w and m for poses of a coupler. A path with given timing has the same equation: with the
first point as origin, the arm p = m + W e^{iφ} + Z has a constant |Z| if the point W of a body that rotates by φ and
translates by -p keeps its distance from -m. [Bottema and Roth, Theoretical Kinematics, 8.2-8.4; thesis 2.36 for paths]
"""

import math
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray, Num
from ilmek.errors import ParameterError
from ilmek.plane.vectors import unit
from ilmek.synthesis.task import require_angles

FAR = 1e9
"""Distance, relative to the size of the task, beyond which a point counts as infinitely far."""

ANGLES = 1e-9
"""Rotation [rad] below which a body counts as not rotated."""

FAMILIES = {
    "pose": (
        "the body has the same angle at all poses, so that parallel links guide it wherever one link does",
        "all poses are rotations about one point, so that every point of the body moves on a circle",
    ),
    "timed point": (
        "the crank has the same angle at all points",
        "the points lie on one circle and follow the rotation of the crank, so that a crank of any length meets them",
    ),
}
"""Reasons of a family of solutions: equal angles, and one rotation."""

METHODS = {
    "pose": {
        3: "3: arms_of_pivots, arms_of_pins or dyads_through_poses",
        4: "4: burmester_curve",
        5: "5: arms_through_five_poses",
    },
    "timed point": {
        3: "3: crank_of_pivot",
        4: "4: dyads_through_points or timed_curve",
        5: "5: cranks_through_five_points",
    },
}


class TaskFrame(NamedTuple):
    """Origin [m] and size [m] of a task; in this frame its numbers are near 1."""

    origin: complex
    size: float

    def to_world(self, points: ComplexArray) -> ComplexArray:
        """Points of the frame, converted to the ground frame [m]."""
        return np.asarray(points * self.size + self.origin)

    def point_to_world(self, point: complex) -> complex:
        """One point of the frame, converted to the ground frame [m]."""
        return complex(point * self.size + self.origin)

    def to_frame(self, points: ComplexArray | complex) -> ComplexArray:
        """Points of the ground frame [m], converted to this frame."""
        return np.asarray((points - self.origin) / self.size)


def forms(
    turns: Float[np.ndarray, "*batch moves"], shifts: Complex[np.ndarray, "*batch moves"]
) -> Float[np.ndarray, "*batch moves 3 3"]:
    """Matrix G of each displacement z -> e^{i turn} z + shift.

    turns  [rad]      shifts  complex, in any unit of length; both of shape (*batch, moves)

    >>> G = forms(np.array([np.pi]), np.array([2 + 0j]))[0]  # half a turn about 1: from w = 3 + 7i to -1 - 7i
    >>> round(float(np.array([1, 5, 1]) @ G @ np.array([3, 7, 1])), 9)  # from m = 1 + 5i: (148 - 8) / 2
    70.0
    """
    rotated_shifts = shifts * unit(-turns)
    one_minus_cosine, sine = 2 * np.sin(turns / 2) ** 2, np.sin(turns)  # 1 - conj(α), accurate at small angles
    rows = [
        [one_minus_cosine, sine, -shifts.real],
        [-sine, one_minus_cosine, -shifts.imag],
        [rotated_shifts.real, rotated_shifts.imag, 0.5 * (shifts.real**2 + shifts.imag**2)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def pose_forms(points: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> tuple[FloatArray, TaskFrame]:
    """Matrices G of poses 2 to n relative to pose 1, and their frame, with the body's point at pose 1 as origin.

    points  positions of one point of the body [m], complex      angles  of one line of the body [rad]
    """
    frame = TaskFrame(complex(points[0]), float(np.max(np.abs(points - points[0]))) or 1.0)
    return forms(angles[1:] - angles[0], frame.to_frame(points[1:])), frame


def timed_forms(
    points: Complex[np.ndarray, "*batch n"], crank_angles: Float[np.ndarray, "*batch n"], size: FloatArray
) -> FloatArray:
    """Matrices G of points 2 to n relative to point 1, between W / size and -(m - p_1) / size.

    points  [m], complex      crank_angles  [rad]      size  of the task [m], shape (*batch)
    """
    shifts = (points[..., :1] - points[..., 1:]) / size[..., None]
    return forms(crank_angles[..., 1:] - crank_angles[..., :1], shifts)


def homogeneous(points: ComplexArray) -> Float[np.ndarray, "... 3"]:
    """Homogeneous coordinates (x, y, 1) of points [m]; the last axis is added."""
    return np.stack([points.real, points.imag, np.ones(points.shape)], axis=-1)


def affine_point(vector: Num[np.ndarray, "3"]) -> tuple[complex, bool]:
    """The point (x, y) / k [m], and whether it is finite; of a point at infinity the direction, a unit vector."""
    x, y, k = (float(one) for one in vector)
    reach = math.hypot(x, y)
    if abs(k) * FAR <= reach:
        return complex(x, y) / reach, False
    return complex(x, y) / k, True


def poles_of_poses(points: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> list[complex]:
    """Poles of all pairs of poses, the greatest rotation first: points that coincide in both poses.

    points  of the body, complex, any unit      angles  of the body [rad]
    """
    pairs = [(i, j) for j in range(len(angles)) for i in range(j)]
    turned = {(i, j): complex(unit(angles[j] - angles[i])) for i, j in pairs}
    pairs = sorted((pair for pair in pairs if abs(1 - turned[pair]) > ANGLES), key=lambda pair: -abs(1 - turned[pair]))
    return [complex((points[j] - turned[i, j] * points[i]) / (1 - turned[i, j])) for i, j in pairs]


def family(kind: str, points: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> ParameterError:
    """The error for a task with a family of solutions, with its reason.

    kind  "pose" or "timed point"      points  in the task's frame      angles  [rad]
    """
    same_angle, one_rotation = FAMILIES[kind]
    poles = poles_of_poses(points, angles)
    if not poles:
        return ParameterError(f"{same_angle}: no solution, or a family of them", do="give different angles")
    away = points - poles[0]
    if np.max(np.abs(away - away[0] * unit(angles - angles[0]))) <= ANGLES * np.max(np.abs(away)):
        return ParameterError(f"{one_rotation}: a family solves this task", do="change a point or an angle")
    return ParameterError(
        "a family of links solves this task", do="change a point or an angle: two of them are dependent"
    )


def require_task(kind: str, points: ComplexArray, angles: FloatArray, count: int, name: str) -> None:
    """Raise ParameterError unless a task has `count` finite, different points with angles in radians.

    kind  "pose" or "timed point"      points  [m], complex      angles  [rad]      name  of the method, for the message
    """
    given, allowed = len(points), f"exactly {count}"
    if len(angles) != given:
        raise ParameterError(f"{given} points and {len(angles)} angles", allowed="one angle for each point")
    if given != count:
        other = METHODS[kind].get(given)
        do = (other and f"for {other}") or "exact methods: " + "; ".join(METHODS[kind].values())
        raise ParameterError(f"{name} was given {given} {kind}s", allowed=allowed, do=do)
    bad = np.flatnonzero(~np.isfinite(points))
    if len(bad):
        raise ParameterError(f"the point of {kind} {bad[0] + 1} is not finite", do="give finite points")
    require_angles(f"angle of a {kind}", angles)
    size = float(np.max(np.abs(points - points[0]))) or 1.0
    turned = np.asarray(unit(angles))
    for late in range(1, given):
        same = (np.abs(points[:late] - points[late]) <= size / FAR) & (np.abs(turned[:late] - turned[late]) <= 1 / FAR)
        if same.any():
            raise ParameterError(
                f"{kind}s {int(np.argmax(same)) + 1} and {late + 1} are the same", do="remove one or change it"
            )
