"""Exact synthesis: arms of four timed points and of three poses by the batch; five poses, curves and five timed points
one by one. Beside each wanted figure stands the ratio to a plain way: a loop over the tasks with numpy and scipy's
generalised eigenvalues, and for five poses Newton's method from random starts.
"""

import time
from collections.abc import Callable, Iterable
from typing import TypeVar

import numpy as np

from benchmarks.pencil import real_roots
from ilmek.arrays import ComplexArray, FloatArray, NumberArray
from ilmek.synthesis.burmester.curve import burmester_curve
from ilmek.synthesis.burmester.links import arms_through_five_poses, four_bars
from ilmek.synthesis.dyad import RootKind, arms_through_points, arms_through_poses
from ilmek.synthesis.path.points import timed_four_bars

Task = TypeVar("Task")

TASKS = 100_000
LOOPED = 3_000
"""Tasks of the plain loop."""

POSES = 300
NEWTON_TASKS, STARTS, STEPS = 30, 40, 40
"""Of the plain way for five poses: tasks, random starts for each, and steps at most."""


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
    off = np.nanmin(
        np.where(arms.found == RootKind.ARM, apart + np.abs(arms.second - second[:, None]), np.inf), axis=-1
    )
    counted = np.bincount(np.sum(arms.found == RootKind.ARM, axis=-1), minlength=4) / TASKS
    print(f"four timed points, {TASKS} planted arms, all roots: {taken:.2f} s of one core (wanted: 5)")
    plain = looped(four_point_task, (points, th1))
    print(f"  {plain / taken:.1f} times quicker than a loop over the tasks ({plain:.1f} s)")
    print(f"  planted arm met to 1e-9: {np.mean(off <= 1e-9):.3%} (wanted: 99.9 %), worst {np.max(off):.1e}")
    print(f"  real arms: 1 in {counted[1]:.1%}, 3 in {counted[3]:.1%}")


def pose_batch() -> None:
    """Three poses with the pivot on a ray."""
    random = np.random.default_rng(2027)
    ground, first, second = random.uniform(0.2, 2, (3, TASKS)) * random.choice([-1, 1], (3, TASKS))
    th0 = random.uniform(-np.pi, np.pi, TASKS)
    th1, th2 = random.uniform(-np.pi, np.pi, (2, TASKS, 1)) + np.cumsum(random.uniform(0.1, 1, (2, TASKS, 3)), axis=-1)
    links = (ground * np.exp(1j * th0))[:, None], first[:, None] * np.exp(1j * th1), second[:, None] * np.exp(1j * th2)
    points = links[0] + links[1] + links[2]
    start = time.process_time()
    arms = arms_through_poses(points, th2, th0)
    taken = time.process_time() - start
    apart = np.abs(arms.ground - ground[:, None]) + np.abs(arms.second - second[:, None])
    off = np.nanmin(np.where(arms.found == RootKind.ARM, apart, np.inf), axis=-1)
    plain = looped(three_pose_task, (points, th2, th0))
    print(f"three poses, {TASKS} planted arms, all roots: {taken:.2f} s of one core")
    print(f"  {plain / taken:.1f} times quicker than a loop over the tasks ({plain:.1f} s)")
    print(f"  planted arm met to 1e-9: {np.mean(off <= 1e-9):.3%}, worst {np.max(off):.1e}")


def four_point_task(points: ComplexArray, th1: FloatArray) -> None:
    """One task in plain numpy: equation 1 taken from the others, and generalised eigenvalues."""
    p, u = points - points[0], np.exp(1j * th1)
    A = np.stack([-2 * p.real, -2 * p.imag, np.abs(p) ** 2], axis=-1)
    B = np.stack([2 * u.real, 2 * u.imag, -2 * (p * np.conj(u)).real], axis=-1)
    real_roots(A[1:] - A[0], B[1:] - B[0])


def three_pose_task(points: ComplexArray, th2: FloatArray, th0: float) -> None:
    """One task in plain numpy, likewise."""
    e0, e2 = np.exp(1j * th0), np.exp(1j * th2)
    A = np.stack([2 * (points * np.conj(e2)).real, -(np.abs(points) ** 2)], axis=-1)
    B = np.stack([-2 * (e2 * np.conj(e0)).real, 2 * (points * np.conj(e0)).real], axis=-1)
    real_roots(A[1:] - A[0], B[1:] - B[0])


def looped(job: Callable[..., None], tasks: tuple[NumberArray, ...]) -> float:
    """Processor time [s] of all tasks one by one, from some of them."""
    start = time.process_time()
    for task in zip(*(one[:LOOPED] for one in tasks), strict=True):
        job(*task)
    return (time.process_time() - start) * TASKS / LOOPED


def newton_links(points: ComplexArray, angles: FloatArray, random: np.random.Generator) -> list[complex]:
    """Pivots of links through five poses by Newton's method from random starts: what is found, no proof of all."""
    turned = np.exp(1j * (angles - angles[0]))
    found: list[complex] = []
    for x in random.normal(size=(STARTS, 4)):
        for _ in range(STEPS):
            m, w = complex(*x[:2]), complex(*x[2:])
            pins = points + (w - points[0]) * turned
            away = pins - m
            missed = np.abs(away[1:]) ** 2 - abs(away[0]) ** 2
            by_m, by_w = -2 * (away[1:] - away[0]), 2 * (away[1:] * np.conj(turned[1:]) - away[0])
            slope = np.stack([by_m.real, by_m.imag, by_w.real, by_w.imag], axis=-1)
            try:
                step = np.linalg.solve(slope, missed)
            except np.linalg.LinAlgError:
                break
            x -= step
            if np.max(np.abs(step)) < 1e-12 * (1 + np.max(np.abs(x))):
                if not any(abs(m - one) < 1e-6 * (1 + abs(m)) for one in found):
                    found.append(m)
                break
    return found


def beside_newton(five: list[tuple[ComplexArray, FloatArray, FloatArray]]) -> None:
    """Five poses in closed form and by Newton's method."""
    random, all_links, met = np.random.default_rng(1), 0, 0
    some = five[:NEWTON_TASKS]
    start = time.process_time()
    plain = [newton_links(points, angles, random) for points, angles, _ in some]
    slow = time.process_time() - start
    start = time.process_time()
    ours = [arms_through_five_poses(points, angles) for points, angles, _ in some]
    taken = time.process_time() - start
    for links, pivots in zip(ours, plain, strict=True):
        cranks = [one.pivot for one in links if np.isfinite(one.length)]
        all_links += len(cranks)
        met += sum(any(abs(pivot - one) < 1e-6 * (1 + abs(pivot)) for one in pivots) for pivot in cranks)
    print(f"  five poses {slow / taken:.0f} times quicker than Newton's method from {STARTS} random starts")
    print(f"  ({slow / NEWTON_TASKS * 1e3:.1f} ms a task), which finds {met} of the {all_links} links")


def run() -> None:
    batch()
    pose_batch()
    random = np.random.default_rng(7)
    five, four = couplers(random, 5), couplers(random, 4)
    jobs = (
        (
            "five poses: links and four-bars (wanted 5)",
            lambda t: four_bars(arms_through_five_poses(t[0], t[1]), t[0][0]),
            five,
        ),
        ("five timed points: all four-bars", lambda t: timed_four_bars(t[0], t[2]), five),
        ("four poses: both curves, 360 points", lambda t: burmester_curve(t[0], t[1]), four),
    )
    for name, job, tasks in jobs:
        job(tasks[0])
        median, most = timed(job, tasks)
        print(f"{name:46s}{median * 1e3:8.2f} ms, at most {most * 1e3:.2f} ms, of {POSES}")
    uneven, missed = [], []
    for points, angles, _ in five:
        found = arms_through_five_poses(points, angles)
        uneven += [float(np.ptp(one.reach(points, angles))) / max(1.0, abs(one.pivot), abs(one.pin)) for one in found]
        missed.append(min(abs(one.pivot) for one in found))  # the planted one is the origin
    beside_newton(five)
    print(f"  a link's length over its poses: even to {max(uneven):.1e}; planted pivot met to {max(missed):.1e}")
