"""What keeps its distance: the one equation behind poses, timed points and the arms through them.

A body is moved from its first place by z -> α z + t, with α = e^{iδ}. Its point w keeps its distance from the fixed
point m where

    |α w + t - m|² - |w - m|²  =  2 m̃ᵀ G w̃  =  0,      w̃ = (x_w, y_w, 1),   m̃ = (x_m, y_m, 1)
    m̃ᵀ G w̃  =  |t|²/2 + Re(conj(t) α w) - Re(conj(t) m) + Re(conj(w) m (1 - conj(α)))

linear in each of the two: w̃ and m̃ are homogeneous, and a point infinitely far (last number 0) is a point like any
other: a pin on a straight line, or a line of the body through a fixed point.

Motion generation asks for w and m of a coupler's poses. A path with given timing is the same equation: with the first
point as origin the arm p = m + W e^{iφ} + Z has |Z| constant where the point W of a body that turns by φ and shifts by
-p keeps its distance from -m.               [Bottema and Roth, Theoretical Kinematics, 8.2-8.4; thesis 2.36 for paths]
"""

import math
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray, Num
from ilmek.errors import ParameterError
from ilmek.plane.vectors import unit
from ilmek.synthesis.task import require_angles

FAR = 1e9
"""Distance, in sizes of the task, beyond which a point counts as infinitely far."""

ANGLES = 1e-9
"""Angle [rad] below which a body has not turned."""

FAMILIES = {
    "pose": (
        "the body has one angle at all poses, so that parallel links guide it wherever one does",
        "one rotation makes all poses, so that any point of the body goes on a circle",
    ),
    "timed point": (
        "the crank has one angle at all points",
        "the points lie on one circle, timed as the crank turns, so that a crank of any length meets them",
    ),
}
"""What leaves a task without an answer of its own: equal angles, and one rotation."""

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
    """Origin [m] and size [m] of a task: in this frame its numbers are near 1."""

    origin: complex
    size: float

    def out(self, places: ComplexArray) -> ComplexArray:
        """Places of the frame as places of the world [m]."""
        return np.asarray(places * self.size + self.origin)

    def spot(self, place: complex) -> complex:
        """One place of the frame as a place of the world [m]."""
        return complex(place * self.size + self.origin)

    def into(self, places: ComplexArray | complex) -> ComplexArray:
        """Places of the world [m] in the frame."""
        return np.asarray((places - self.origin) / self.size)


def forms(
    turns: Float[np.ndarray, "*batch moves"], shifts: Complex[np.ndarray, "*batch moves"]
) -> Float[np.ndarray, "*batch moves 3 3"]:
    """G of each displacement z -> e^{i turn} z + shift [rad, any length].

    >>> G = forms(np.array([np.pi]), np.array([2 + 0j]))[0]  # half a turn about 1: from w = 3 + 7i to -1 - 7i
    >>> round(float(np.array([1, 5, 1]) @ G @ np.array([3, 7, 1])), 9)  # from m = 1 + 5i: (148 - 8) / 2
    70.0
    """
    spun = shifts * unit(-turns)
    lost, side = 2 * np.sin(turns / 2) ** 2, np.sin(turns)  # 1 - conj(α), without loss at small turns
    rows = [
        [lost, side, -shifts.real],
        [-side, lost, -shifts.imag],
        [spun.real, spun.imag, 0.5 * (shifts.real**2 + shifts.imag**2)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def pose_forms(points: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> tuple[FloatArray, TaskFrame]:
    """G of poses 2 to n from pose 1, in the frame whose origin is the body's point at pose 1.

    points [m]  places of one point of the body      angles [rad]  of one line of the body
    """
    frame = TaskFrame(complex(points[0]), float(np.max(np.abs(points - points[0]))) or 1.0)
    return forms(angles[1:] - angles[0], frame.into(points[1:])), frame


def timed_forms(
    points: Complex[np.ndarray, "*batch n"], crank_angles: Float[np.ndarray, "*batch n"], size: FloatArray
) -> FloatArray:
    """G of points 2 to n against point 1, between W / size and -(m - p_1) / size."""
    shifts = (points[..., :1] - points[..., 1:]) / size[..., None]
    return forms(crank_angles[..., 1:] - crank_angles[..., :1], shifts)


def homogeneous(places: ComplexArray) -> Float[np.ndarray, "... 3"]:
    """(x, y, 1) of places."""
    return np.stack([places.real, places.imag, np.ones(places.shape)], axis=-1)


def affine_point(vector: Num[np.ndarray, "3"]) -> tuple[complex, bool]:
    """The place of (x, y, k), and whether it is finite; of one infinitely far it is the direction, a unit vector."""
    x, y, k = (float(one) for one in vector)
    reach = math.hypot(x, y)
    if abs(k) * FAR <= reach:
        return complex(x, y) / reach, False
    return complex(x, y) / k, True


def still_points(places: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> list[complex]:
    """The poles: points that do not move from one pose to another; those of the poses that are turned most first."""
    pairs = [(i, j) for j in range(len(angles)) for i in range(j)]
    turned = {(i, j): complex(unit(angles[j] - angles[i])) for i, j in pairs}
    pairs = sorted((pair for pair in pairs if abs(1 - turned[pair]) > ANGLES), key=lambda pair: -abs(1 - turned[pair]))
    return [complex((places[j] - turned[i, j] * places[i]) / (1 - turned[i, j])) for i, j in pairs]


def family(kind: str, places: Complex[np.ndarray, " n"], angles: Float[np.ndarray, " n"]) -> ParameterError:
    """Why a task is met by more than points or a curve, as an error to raise; places in the task's frame."""
    alike, turned = FAMILIES[kind]
    poles = still_points(places, angles)
    if not poles:
        return ParameterError(f"{alike}: no task, or a whole family", do="give angles that differ")
    away = places - poles[0]
    if np.max(np.abs(away - away[0] * unit(angles - angles[0]))) <= ANGLES * np.max(np.abs(away)):
        return ParameterError(f"{turned}: a whole family solves this task", do="move a point or an angle")
    return ParameterError(
        "a whole family of links solves this task", do="move a point or an angle: two of them say the same"
    )


def require_task(kind: str, points: ComplexArray, angles: FloatArray, wanted: int, name: str) -> None:
    """Raise ParameterError unless points and angles are `wanted` finite, different places with angles in radians."""
    given, allowed = len(points), f"exactly {wanted}"
    if len(angles) != given:
        raise ParameterError(f"{given} points and {len(angles)} angles", allowed="one angle for each point")
    if given != wanted:
        other = METHODS[kind].get(given)
        do = (other and f"for {other}") or "exact methods take " + "; ".join(METHODS[kind].values())
        raise ParameterError(f"{name} was given {given} {kind}s", allowed=allowed, do=do)
    bad = np.flatnonzero(~np.isfinite(points))
    if len(bad):
        raise ParameterError(f"the point of {kind} {bad[0] + 1} is not a number", do="give finite places")
    require_angles(f"angle of a {kind}", angles)
    size = float(np.max(np.abs(points - points[0]))) or 1.0
    turned = np.asarray(unit(angles))
    for late in range(1, given):
        same = (np.abs(points[:late] - points[late]) <= size / FAR) & (np.abs(turned[:late] - turned[late]) <= 1 / FAR)
        if same.any():
            raise ParameterError(
                f"{kind}s {int(np.argmax(same)) + 1} and {late + 1} are one", do="leave one out or move it"
            )
