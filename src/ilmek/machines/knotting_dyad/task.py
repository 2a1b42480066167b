"""The four timed points that an arm is made for: those given, or the best of a grid on the knot's own way."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Complex, Float

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.carpet.knot_path import KnotPath
from ilmek.errors import ParameterError
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.places import read_angles, read_points
from ilmek.synthesis.dyad import Arms, Found, arms_through_points
from ilmek.units import deg, format_quantity

SAMPLES = 181
"""Places along the way at which an arm is tried."""

SHARES = np.array([(0.05, 0.35, 0.65, 0.95), (0.0, 0.3, 0.6, 1.0), (0.1, 0.4, 0.6, 0.9), (0.0, 0.25, 0.7, 0.95)])
"""Where on the way the four points are tried, shares of its length."""

STARTS = np.arange(0, 360, 15) * deg
SWINGS = np.array([-120, -90, -60, -45, -30, -20, -10, 10, 20, 30, 45, 60, 90, 120]) * deg
"""Angles of the first link where the way begins, and its turn along the whole way."""


@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """What an arm is made for.

    points  four places [m]            angles  of the first link there [rad]
    course  all places that it must reach [m]: the way of its end, or the four points alone
    path    the knot's way, where the points were chosen on it         shares  of the way, of the points
    """

    points: Complex[np.ndarray, "4"]
    angles: Float[np.ndarray, "4"]
    course: ComplexArray
    path: KnotPath | None = None
    shares: Float[np.ndarray, "4"] | None = None


def task_of(params: KnottingDyadParams) -> Task:
    """The task that the parameters ask for."""
    if params.points is None or params.angles is None:
        return _chosen(params)
    points = read_points("points", params.points)
    return Task(points, read_angles("angles", params.angles), points)


def led(path: KnotPath, share: FloatArray) -> ComplexArray:
    """Places of one arm's end [m] at shares of its way: all of an asymmetric knot.

    Of a symmetric knot it is the right half, from the middle of its front; the mirrored arm leads the left one.
    """
    begin = path.length / 2 if path.knot.kind == "symmetric" else 0.0
    return path.point(begin + (path.length - begin) * share)


def bend(arms: Arms, points: ComplexArray, angles: FloatArray, course: ComplexArray) -> FloatArray:
    """Least |sin| of the angle between the links over the course, of each arm of a batch.

    0 where the four points are not on one side of the elbow, -1 where a place of the course is out of reach, or where
    there is no arm: |cos| = |d² - a1² - a2²| / (2 |a1| a2) with the distance d from the pivot.
    """
    there = arms.found == Found.ARM
    pivot, first, second = (np.where(there, one, 1.0)[..., None] for one in (arms.pivot, arms.first, arms.second))
    distance = np.abs(course - pivot)
    cosine = (distance**2 - first**2 - second**2) / (2 * np.abs(first) * second)
    least = 1 - np.max(cosine**2, axis=-1)
    u = np.exp(1j * angles)[..., None, :]
    side = np.sign(((points[..., None, :] - pivot - first * u) * np.conj(u)).imag)
    one_side = np.abs(np.sum(side, axis=-1)) == side.shape[-1]
    bent = np.where(least < 0, -1.0, np.where(one_side, np.sqrt(np.maximum(least, 0)), 0.0))
    return np.asarray(np.where(there, bent, -1.0))


def _chosen(params: KnottingDyadParams) -> Task:
    """Of the grid's tasks the one with the arm that stays farthest from its stretched and folded poses."""
    path = params.way()
    course = led(path, np.linspace(0.0, 1.0, SAMPLES))
    at, start, swing = (one.ravel() for one in np.meshgrid(np.arange(len(SHARES)), STARTS, SWINGS, indexing="ij"))
    shares = SHARES[at]
    points, angles = led(path, shares), start[:, None] + swing[:, None] * shares
    arms = arms_through_points(points, angles)
    # The pivot must stand clear of warps and pile.
    fits = (np.abs(arms.first) <= params.link_limit) & (arms.second <= params.link_limit)
    clear = arms.pivot.imag >= 2 * params.leg
    worth = np.max(np.where(fits & clear, bend(arms, points, angles, course), -1.0), axis=-1)
    best = int(np.argmax(worth))
    if worth[best] <= 0:
        raise ParameterError(
            f"no arm with links of {format_quantity(params.link_limit, 'mm')} or less leads the yarn on this way",
            do="allow longer links, or choose the four points",
        )
    return Task(points[best], angles[best], course, path, shares[best])
