"""Exact synthesis: the four-point arm by the batch; five poses, curves and five timed points one by one."""

import time
from collections.abc import Callable, Iterable
from typing import TypeVar

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.synthesis.burmester import arms_through_five_poses, four_bars
from ilmek.synthesis.burmester_curve import burmester_curve
from ilmek.synthesis.dyad import Found, arms_through_points
from ilmek.synthesis.path_points import timed_four_bars

Task = TypeVar("Task")

TASKS = 100_000
POSES = 300


def planted_arms(random: np.random.Generator) -> tuple[ComplexArray, FloatArray, FloatArray, ComplexArray, FloatArray]:
    """Pivots, both links, points and first angles of random arms [m, rad]."""
    pivot = random.uniform(-1, 1, TASKS) + 1j * random.uniform(-1, 1, TASKS)
    first, second = random.uniform(0.2, 2, (2, TASKS))
    th1, th2 = random.uniform(-np.pi, np.pi, (2, TASKS, 1)) + np.cumsum(random.uniform(0.1, 1, (2, TASKS, 4)), axis=-1)
    th2 *= random.choice([-1, 1], (TASKS, 1))
    points = pivot[:, None] + first[:, None] * np.exp(1j * th1) + second[:, None] * np.exp(1j * th2)
    return pivot, first, second, points, th1


def couplers(random: np.random.Generator, count: int) -> list[tuple[ComplexArray, FloatArray, FloatArray]]:
    """Points and angles of couplers of random four-bars that close at `count` crank angles, and those."""
    found: list[tuple[ComplexArray, FloatArray, FloatArray]] = []
    while len(found) < POSES:
        crank, coupler, rocker = random.uniform(0.3, 1.5, 3)
        th = random.uniform(0, 6) + np.cumsum(random.uniform(0.15, 0.8, count))
        across = 1 - crank * np.exp(1j * th)
        along = 0.5 + 0.5 * (coupler**2 - rocker**2) / np.abs(across) ** 2
        height = (coupler / np.abs(across)) ** 2 - along**2
        if np.min(height) > 0.01:
            angles = np.angle((along + 1j * np.sqrt(height)) * across)
            tracer = complex(*random.normal(size=2))
            found.append((crank * np.exp(1j * th) + tracer * np.exp(1j * angles), angles, th))
    return found


def timed(job: Callable[[Task], object], tasks: Iterable[Task]) -> tuple[float, float]:
    """Median and greatest processor time of a job [s]; the machine may be busy with other things."""
    taken = []
    for task in tasks:
        start = time.process_time()
        job(task)
        taken.append(time.process_time() - start)
    return float(np.median(taken)), max(taken)


def batch() -> None:
    pivot, first, second, points, th1 = planted_arms(np.random.default_rng(2026))
    start = time.process_time()
    arms = arms_through_points(points, th1)
    taken = time.process_time() - start
    apart = np.abs(arms.pivot - pivot[:, None]) + np.abs(arms.first - first[:, None])
    off = np.nanmin(np.where(arms.found == Found.ARM, apart + np.abs(arms.second - second[:, None]), np.inf), axis=-1)
    counted = np.bincount(np.sum(arms.found == Found.ARM, axis=-1), minlength=4) / TASKS
    print(f"four timed points, {TASKS} planted arms, all roots: {taken:.2f} s of one core (wanted: 5)")
    print(f"  planted arm met to 1e-9: {np.mean(off <= 1e-9):.3%} (wanted: 99.9 %), worst {np.max(off):.1e}")
    print(f"  real arms: 1 in {counted[1]:.1%}, 3 in {counted[3]:.1%}")


def run() -> None:
    batch()
    random = np.random.default_rng(7)
    five, four = couplers(random, 5), couplers(random, 4)
    jobs = (
        ("five poses: links and four-bars", lambda t: four_bars(arms_through_five_poses(t[0], t[1]), t[0][0]), five),
        ("five timed points: all four-bars", lambda t: timed_four_bars(t[0], t[2]), five),
        ("four poses: both curves, 360 points", lambda t: burmester_curve(t[0], t[1]), four),
    )
    for name, job, tasks in jobs:
        job(tasks[0])
        median, most = timed(job, tasks)
        print(f"{name:40s}{median * 1e3:8.2f} ms, at most {most * 1e3:.2f} ms, of {POSES}")
    uneven, missed = [], []
    for points, angles, _ in five:
        found = arms_through_five_poses(points, angles)
        uneven += [float(np.ptp(one.reach(points, angles))) / max(1.0, abs(one.pivot), abs(one.pin)) for one in found]
        missed.append(min(abs(one.pivot) for one in found))  # the planted one is the origin
    print(f"  a link's length over its poses: even to {max(uneven):.1e}; planted pivot met to {max(missed):.1e}")
