"""Approximation in three criteria beside plain ways to it: a linear programme, local searches from many starts."""

import time
from collections.abc import Callable
from functools import partial
from typing import TypeVar

import numpy as np
from scipy.optimize import least_squares as local_squares
from scipy.optimize import linprog, minimize

from benchmarks.superposition import superposed_through_points
from ilmek.arrays import FloatArray
from ilmek.synthesis.approximation.dyad import dyads_along
from ilmek.synthesis.approximation.exchange import linear_minimax
from ilmek.synthesis.approximation.function_generator import CRITERIA, function_approximations
from ilmek.synthesis.approximation.polynomial import SynthesisPolynomial, least_squares, minimax, of_table, range_nodes
from ilmek.synthesis.dyad import dyads_through_points
from ilmek.synthesis.function import Function
from ilmek.units import deg

Answer = TypeVar("Answer")

PRODUCTS = ((0, 1), (0, 2))

FUNCTIONS = {
    "sqrt(1 + x), 0 to 3": Function(lambda x: np.sqrt(1 + x), 0.0, 3.0, 80 * deg, 60 * deg),
    "log10 x, 1 to 2": Function(np.log10, 1.0, 2.0, 60 * deg, 90 * deg),
    "x^2, 0 to 1": Function(lambda x: x**2, 0.0, 1.0, 90 * deg, 90 * deg),
    "sin x, 0 to 90 deg": Function(np.sin, 0.0, np.pi / 2, 120 * deg, 60 * deg),
}


def timed(job: Callable[[], Answer], repeats: int) -> tuple[float, Answer]:
    """Median processor time [s] and the last answer."""
    taken = []
    for _ in range(repeats):
        start = time.process_time()
        answer = job()
        taken.append(time.process_time() - start)
    return float(np.median(taken)), answer


def exchange() -> None:
    x = range_nodes(-1.0, 1.0, 301)
    table = np.stack([x**k for k in range(6)], axis=-1)
    ours, best = timed(lambda: linear_minimax(table, np.exp(x)), 20)
    level = -np.ones((len(x), 1))
    rows = np.vstack([np.hstack([table, level]), np.hstack([-table, level])])
    right = np.concatenate([np.exp(x), -np.exp(x)])
    theirs, peer = timed(lambda: linprog([0.0] * 6 + [1.0], rows, right, bounds=(None, None), method="highs"), 3)
    print(
        f"minimax of e^x by degree 5, 301 places: {ours * 1e3:.2f} ms, linear programme (HiGHS) {theirs * 1e3:.1f} ms"
    )
    print(f"  quicker {theirs / ours:.0f} times; greatest error {best.worst:.6e}, there {peer.fun:.6e}")
    print(f"  proven by the bound to {1 - best.level / best.worst:.1e}")


def squares() -> None:
    random = np.random.default_rng(1)
    ours, theirs, counts = [], [], np.zeros(3, dtype=int)
    for _ in range(20):
        table, more, wanted = random.normal(size=(6, 4)), random.normal(size=(6, 2)), random.normal(size=6)
        polynomial = of_table(table, wanted, PRODUCTS, more)
        taken, answers = timed(partial(least_squares, polynomial, np.arange(6.0)), 1)
        ours.append(taken)
        begin = time.process_time()
        sums = local_sums(table, more, wanted, random)
        theirs.append(time.process_time() - begin)
        minima = [one.rms for one in answers.found if one.kind == "minimum"]
        counts += (
            len(answers.found),
            sum(min(abs(one - minimum) for minimum in minima) > 1e-6 for one in sums),
            sum(min((abs(one - minimum) for one in sums), default=1.0) > 1e-6 for minimum in minima),
        )
    print(
        f"squares with two products, {counts[0]} stationary answers of 20 tasks: {np.median(ours) * 1e3:.1f} ms a task"
    )
    ratio = np.median(theirs) / np.median(ours)
    print(f"  20 local searches: {np.median(theirs) * 1e3:.1f} ms, {ratio:.1f} times as long")
    print(f"  minima that only they find: {counts[1]}; that they miss: {counts[2]}")


def local_sums(table: FloatArray, more: FloatArray, wanted: FloatArray, random: np.random.Generator) -> list[float]:
    """Roots of mean squares at which 20 local searches end."""

    def errors(p: FloatArray) -> FloatArray:
        return np.asarray(table @ p + more @ (p[0] * p[1:3]) - wanted)

    ends = [local_squares(errors, random.normal(size=4) * 2, xtol=1e-13, ftol=1e-13, gtol=1e-13) for _ in range(20)]
    return [float(np.sqrt(2 * end.cost / 6)) for end in ends if end.optimality < 1e-6]


def products() -> None:
    bent = SynthesisPolynomial(
        lambda x: np.stack([np.ones_like(x), x, x**2, x**3], axis=-1),
        lambda x: np.tanh(4 * x - 1),
        PRODUCTS,
        lambda x: np.stack([np.sin(3 * x), np.cos(4 * x)], axis=-1),
    )
    taken, answers = timed(lambda: minimax(bent, range_nodes(-1.0, 1.0)).found, 3)
    x, random = range_nodes(-1.0, 1.0, 301), np.random.default_rng(2)
    sides = [{"type": "ineq", "fun": lambda q, s=side: q[4] - s * bent.errors(q[:4], x)} for side in (1, -1)]
    begin = time.process_time()
    ends = [
        minimize(lambda q: q[4], np.append(random.normal(size=4), 2.0), constraints=sides, options={"maxiter": 300})
        for _ in range(10)
    ]
    theirs = time.process_time() - begin
    worst = sorted(float(np.max(np.abs(bent.errors(end.x[:4], x)))) for end in ends)
    print(
        f"minimax, two products: {sum(one.proven for one in answers)} of {len(answers)} answers proven, {taken:.2f} s"
    )
    print(f"  ours {', '.join(f'{one.worst:.6f}' for one in answers)}; 10 local searches with limits: {theirs:.2f} s,")
    print(f"  best {worst[0]:.6f}, median {np.median(worst):.6f}, {theirs / taken:.1f} times as long")


def functions() -> None:
    print("function generators, all five numbers free: greatest error [deg] of the best, seconds, answers proven")
    for name, function in FUNCTIONS.items():
        cells, worst = [], {}
        for criterion in CRITERIA:
            taken, answers = timed(partial(function_approximations, function, criterion), 1)
            worst[criterion] = min((one.greatest for one in answers.found), default=np.nan)
            proven = sum(one.proven for one in answers.found)
            cells.append(f"{worst[criterion] / deg:9.5f} {taken:5.2f} s {proven}/{len(answers.found)}")
        ratio = worst["interpolation"] / worst["minimax"]
        print(f"  {name:22s}{'   '.join(cells)}   minimax less {ratio:.1f} times")


def arms() -> None:
    u = np.linspace(0, 1, 40)
    path, angles = 0.04 * u + 0.015j * np.sin(np.pi * u), np.radians(20 + 70 * u)
    for criterion in CRITERIA:
        taken, answers = timed(partial(dyads_along, path, angles, criterion), 3)
        worst = answers.found[0].worst * 1e3
        print(f"arm along 40 timed points, {criterion}: {taken * 1e3:.0f} ms, worst {worst:.4f} mm")
    four = np.array([0, 13, 26, 39])
    ours, _ = timed(lambda: dyads_through_points(path[four], angles[four]), 20)
    theirs, _ = timed(lambda: superposed_through_points(path[four], angles[four]), 20)
    print(
        f"four points by the pencil {ours * 1e3:.2f} ms, by superposition {theirs * 1e3:.2f} ms ({theirs / ours:.1f}:1)"
    )


def run() -> None:
    exchange()
    squares()
    products()
    functions()
    arms()
