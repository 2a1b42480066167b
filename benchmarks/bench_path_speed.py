"""The quickest motion along a path beside a plain way: the best seven-phase motion of the path's parameter.

The plain way leads s by constant jerk, acceleration and speed, as a machine's controller does, of 400 shapes the best,
and slows it down until every axis keeps its limits. Its ratio to the quickest motion is the time that is saved.
"""

import itertools
import math
import statistics
import time
from collections.abc import Callable

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.knotting_dyad import KnottingDyadParams, design
from ilmek.timing.path_speed.solve import AxesLimits, JointPath, PathMotion, quickest_motion
from ilmek.timing.s_curve import AxisLimits, SCurve, s_curve

RUNS = 5
RANDOM = 30
SHAPES = [(speed, bend) for speed, bend in itertools.product(np.geomspace(0.1, 1.0, 20), np.geomspace(0.1, 1.3, 20))]
"""Limits of speed and acceleration over a way of 1 with a jerk of 1; without them it reaches 0.63 and 0.79."""

TIMES = np.linspace(0.0, 1.0, 2001)


def plain(path: JointPath, limits: AxesLimits) -> float:
    """Time of the plain way [s]."""
    return min(slowed(path, limits, s_curve(1.0, AxisLimits(speed, bend, 1.0))) for speed, bend in SHAPES)


def slowed(path: JointPath, limits: AxesLimits, motion: SCurve) -> float:
    """Time of a motion over the way's length of 1, slowed down until all limits hold [s]."""
    s, v, a, j = (one[:, None] for one in motion.at(TIMES * motion.time))
    along = path.s[0] + path.length * np.clip(s[:, 0], 0.0, 1.0)
    q1, q2, q3 = (path.at(along, order) * path.length**order for order in (1, 2, 3))
    speed, bend, jerk = q1 * v, q2 * v**2 + q1 * a, q3 * v**3 + 3 * q2 * v * a + q1 * j
    slow = max(
        float(np.max(np.abs(speed) / limits.speed)),
        math.sqrt(np.max(np.abs(bend) / limits.acceleration)),
        math.cbrt(np.max(np.abs(jerk) / limits.jerk)),
    )
    return motion.time * slow


def equal(axes: int, *limits: float) -> AxesLimits:
    return AxesLimits(*(np.full(axes, limit) for limit in limits))


def waves(seed: int, nodes: int = 300) -> JointPath:
    """Two axes that go to and fro."""
    rng = np.random.default_rng(seed)
    s = np.linspace(0.0, 1.0, nodes)
    pace, start = rng.uniform(-9, 9, (2, 2))
    phase = s[:, None] * pace + start
    return JointPath(s, np.sin(phase) / 9, pace * np.cos(phase) / 9, -(pace**2) * np.sin(phase) / 9)


def line() -> JointPath:
    s = np.linspace(0.0, 1.0, 300)
    return JointPath(s, s[:, None], np.ones((300, 1)), np.zeros((300, 1)))


def arc() -> JointPath:
    s = np.linspace(0.0, 1.0, 300)
    turn = math.pi / 2
    course = np.exp(1j * turn * s)
    return JointPath(s, parts(-1j * course / turn), parts(course), parts(1j * turn * course))


def parts(course: np.ndarray) -> FloatArray:
    return np.stack([course.real, course.imag], axis=1)


def arm() -> tuple[JointPath, AxesLimits]:
    """The knotting dyad's own way and limits."""
    params = KnottingDyadParams()
    head = design(params).head
    assert head is not None
    way = head.path
    limits = equal(2, params.joint_speed, params.joint_acceleration, params.joint_jerk)
    return JointPath(way.s, way.theta, way.first, way.second), limits


def timed(job: Callable[[], PathMotion | float]) -> float:
    """Median processor time of a job [s]."""
    taken = []
    for _ in range(RUNS):
        begin = time.process_time()
        job()
        taken.append(time.process_time() - begin)
    return statistics.median(taken)


def show(name: str, path: JointPath, limits: AxesLimits) -> None:
    motion = quickest_motion(path, limits)
    course = motion.even(20_001)
    used = max(
        float(np.max(np.abs(course.speed) / limits.speed)),
        float(np.max(np.abs(course.acceleration) / limits.acceleration)),
        float(np.max(np.abs(course.jerk) / limits.jerk)),
    )
    other = plain(path, limits)
    seconds = timed(lambda: quickest_motion(path, limits))
    print(
        f"  {name:<28}{motion.duration:>10.4f} s{other:>10.4f} s{other / motion.duration:>8.2f}{used:>9.4f}"
        f"{seconds:>9.2f} s"
    )


def run() -> None:
    print("  way                            quickest     plain    ratio     used  processor")
    show("one axis, straight", line(), equal(1, 0.3, 0.3, 1.0))
    show("quarter of a circle", arc(), equal(2, 1.0, 3.0, 30.0))
    show("the same, speed hardly counts", arc(), equal(2, 5.0, 20.0, 100.0))
    show("an arm of the knotting dyad", *arm())
    ratios, seconds = [], []
    for seed in range(RANDOM):
        path, limits = waves(seed), equal(2, *(10.0 ** np.random.default_rng(seed).uniform((-1, 0, 1), (1, 1.5, 2.5))))
        begin = time.process_time()
        motion = quickest_motion(path, limits)
        seconds.append(time.process_time() - begin)
        ratios.append(plain(path, limits) / motion.duration)
    print(
        f"  {RANDOM} random ways of two axes: plain / quickest median {statistics.median(ratios):.2f}, "
        f"{min(ratios):.2f} to {max(ratios):.2f}; {statistics.median(seconds):.2f} s, at most {max(seconds):.2f} s"
    )


if __name__ == "__main__":
    run()
