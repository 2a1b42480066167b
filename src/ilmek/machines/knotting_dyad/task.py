"""The four timed points that an arm is made for: those given, or four of the way of the best arm for the knot."""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.machines.knotting_dyad.arm_path import Arm
from ilmek.synthesis.dyad import PointArms, RootKind

SHARES = (1 - np.cos((2 * np.arange(4) + 1) * np.pi / 8)) / 2
"""Where on the way the four points are: Chebyshev's nodes, values of its parameter s."""

SAMPLES = 181
"""Places of the way at which the bend of the arms is looked at."""


@dataclass(frozen=True, slots=True, eq=False)
class ArmTask:
    """What an arm is made for.

    points  four places [m]            angles  of the first link there [rad]
    course  all places that it must reach [m]: the way of its end, or the four points alone
    shares  of the way, values of s, where the points were chosen
    """

    points: Complex[np.ndarray, "4"]
    angles: Float[np.ndarray, "4"]
    course: ComplexArray
    shares: Float[np.ndarray, "4"] | None = None


def task_on(arm: Arm) -> ArmTask:
    """Four points of an arm's way, and the angles that its first link has there."""
    course = arm.tip(np.linspace(0.0, 1.0, SAMPLES))
    return ArmTask(arm.tip(SHARES), np.ascontiguousarray(arm.way(SHARES).theta[:, 0]), course, SHARES)


def bend(arms: PointArms, points: ComplexArray, angles: FloatArray, course: ComplexArray) -> FloatArray:
    """Least |sin| of the angle between the links over the course, of each arm of a batch.

    0 where the four points are not on one side of the elbow, -1 where a place of the course is out of reach, or where
    there is no arm: |cos| = |d² - a1² - a2²| / (2 |a1| a2) with the distance d from the pivot.
    """
    there = arms.found == RootKind.ARM
    pivot, first, second = (np.where(there, one, 1.0)[..., None] for one in (arms.pivot, arms.first, arms.second))
    distance = np.abs(course - pivot)
    cosine = (distance**2 - first**2 - second**2) / (2 * np.abs(first) * second)
    least = 1 - np.max(cosine**2, axis=-1)
    u = np.exp(1j * angles)[..., None, :]
    side = np.sign(((points[..., None, :] - pivot - first * u) * np.conj(u)).imag)
    one_side = np.abs(np.sum(side, axis=-1)) == side.shape[-1]
    bent = np.where(least < 0, -1.0, np.where(one_side, np.sqrt(np.maximum(least, 0)), 0.0))
    return np.asarray(np.where(there, bent, -1.0))
