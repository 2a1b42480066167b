"""Synthesis: processor time of each method, and how near planted mechanisms are found again."""

import time
from collections.abc import Callable

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.synthesis.candidate import judge
from ilmek.synthesis.circuit_loops import circuit_loops
from ilmek.synthesis.cognates import cognates
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.freudenstein import function_generators
from ilmek.synthesis.task import PrecisionTask

PROBLEMS = 300


def run() -> None:
    function_generation()
    judging()


def function_generation() -> None:
    """Five pairs of angles of random four-bars: nothing else given."""
    tasks = list(planted(PROBLEMS, 5))
    started = time.process_time()
    found = [function_generators(np.angle(crank), np.angle(rocker)).four_bars for _, crank, rocker in tasks]
    each = (time.process_time() - started) / len(tasks)
    gaps = np.array(
        [
            min((abs(one.a - drawn.a) + abs(one.b - drawn.b) for one in four_bars), default=np.inf)
            for (drawn, _, _), four_bars in zip(tasks, found, strict=True)
        ]
    )
    print(f"function generation, 5 pairs       {each * 1e3:8.3f} ms each")
    print(f"  planted found again within 1e-9  {np.mean(gaps < 1e-9) * 100:8.2f} %, worst {np.max(gaps):.1e}")


def judging() -> None:
    """Candidates of path tasks with and without timing, and their cognates."""
    crank_rocker = FourBar(0j, 4 + 0j, 1j, 3 + 3j, tracer=2 + 3j)
    u = np.array([np.pi / 2, 2.0, 2.9, 4.1, 5.0])
    points = circuit_loops(crank_rocker)[0].at(u).tracer
    timing, free = PrecisionTask(points=points, crank=u), PrecisionTask(points=points)
    print(f"judging a four-bar, 5 timed points {timed(lambda: judge(crank_rocker, timing)) * 1e3:8.3f} ms each")
    print(f"judging a four-bar, 5 points       {timed(lambda: judge(crank_rocker, free)) * 1e3:8.3f} ms each")
    print(f"three cognates                     {timed(lambda: cognates(crank_rocker)) * 1e3:8.3f} ms each")


def planted(count: int, pairs: int) -> list[tuple[FourBar, FloatArray, FloatArray]]:
    """Random four-bars on the ground from 0 to 1 and directions of crank and rocker on one branch of each."""
    random = np.random.default_rng(11)
    found: list[tuple[FourBar, FloatArray, FloatArray]] = []
    while len(found) < count:
        a, b = random.normal(size=4).view(complex)
        loop = next(iter(circuit_loops(FourBar(0j, 1 + 0j, a, b))), None)
        u = 0.2 + np.cumsum(random.uniform(0.3, 0.6, pairs))
        if loop and u[-1] < np.pi and loop.high - loop.low > 0.5:
            pose = loop.at(u)
            found.append((FourBar(0j, 1 + 0j, complex(pose.a[0]), complex(pose.b[0])), pose.a, pose.rocker))
    return found


def timed(work: Callable[[], object], times: int = 50) -> float:
    """Processor time of one run [s]."""
    work()
    started = time.process_time()
    for _ in range(times):
        work()
    return (time.process_time() - started) / times
