"""General planar systems: the benchmarks of the field, a pin with clearance, and peers, with accuracy and time.

Error is the greatest of the benchmark's own coordinates, relative for Andrews' squeezer, in metres for the pendulum
and the four-bars; of exudyn and mujoco the angle of the beat-up's crank after 2 s from 20 rad/s, in radians.
"""

import importlib
import math
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.bench_forward import beat_up, free
from ilmek.dynamics.clearance import ClearancePin, hertz_stiffness
from ilmek.dynamics.forward import ForwardRun
from ilmek.dynamics.inertia import Inertia
from ilmek.dynamics.multibody.system import System, SystemRun, from_motion, simulate, with_clearance
from ilmek.linkage.solve import solve

for folder in ("reference", "support"):
    sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / folder))

PROBLEMS = ("test_multibody_andrews", "test_multibody_benchmarks", "crank_rocker_peers")
ANDREWS, ROWS, PEERS = (importlib.import_module(name) for name in PROBLEMS)
END_OF_A01 = -0.2750874626 - 0.9614192051j


@dataclass(frozen=True, slots=True)
class Line:
    """A measured job: processor seconds for a second simulated, and the error reached."""

    name: str
    work: Callable[[], Any]
    error: Callable[[Any], float]
    simulated: float


def andrews(rtol: float) -> Line:
    def work() -> SystemRun:
        return simulate(ANDREWS.squeezer(), np.array([0, 0.03]), rtol=rtol)

    def error(run: SystemRun) -> float:
        return float(np.max(np.abs(ANDREWS.minimal(run, "angle") / ANDREWS.PRINTED - 1)))

    return Line(f"Andrews to 0.03 s, rtol {rtol:.0e}", work, error, 0.03)


def squeezed() -> SystemRun:
    return simulate(ANDREWS.squeezer(), np.linspace(0, 0.05, 26), rtol=1e-10)


def swinging(rtol: float) -> Line:
    def work() -> SystemRun:
        return simulate(ROWS.pendulum(), np.array([0, 10.0]), rtol=rtol)

    def error(run: SystemRun) -> float:
        return abs(complex(run.position("bob", "tip")[-1]) - END_OF_A01)

    return Line(f"pendulum to 10 s, rtol {rtol:.0e}", work, error, 10)


def row(count: int, rtol: float) -> Line:
    times = np.array([0.0, 10.0])
    end = np.exp(1j * ROWS.one_angle(count, times)[-1])

    def work() -> SystemRun:
        return simulate(ROWS.row_of_four_bars(count), times, rtol=rtol)

    def error(run: SystemRun) -> float:
        return float(np.abs(np.exp(1j * run.angle(f"U{count}")[-1]) - end))

    return Line(f"{count} four-bars to 10 s, rtol {rtol:.0e}", work, error, 10)


def linkage(inertia: float = 0.0) -> System:
    """The beat-up's crank-rocker as a general system; the crank with a flywheel or without."""
    reduced = beat_up()
    crank = reduced.inertias["crank"]
    masses = {**reduced.inertias, "crank": Inertia(crank.mass, crank.centre, crank.moment + inertia)}
    return from_motion(solve(reduced.plan, 0.0, 20.0), masses, gravity=-9.81j)


def general(rtol: float) -> SystemRun:
    return simulate(linkage(), np.array([0.0, 2.0]), rtol=rtol)


def loose() -> SystemRun:
    clearance = 0.08e-3
    pin = ClearancePin("B", "coupler", "rocker", clearance, 8e-3, hertz_stiffness(8e-3, clearance, 207e9), 0.7, 0.1)
    return simulate(with_clearance(linkage(5.0), pin), np.linspace(0.0, 2 * math.pi / 10, 2001), rtol=1e-8)


def lines() -> list[Line]:
    wanted = float(free(beat_up(), 1e-13).position[-1])

    def off(angle: float) -> float:
        return abs(angle - wanted)

    def tip(run: SystemRun) -> float:
        return off(float(run.angle("crank")[-1]))

    def reduced_tip(run: ForwardRun) -> float:
        return off(float(run.position[-1]))

    def balance(run: SystemRun) -> float:
        return float(np.max(np.abs(run.energy_residual)))

    jobs = [andrews(rtol) for rtol in (1e-8, 1e-10, 1e-12)]
    jobs.append(Line("Andrews to 0.05 s, rtol 1e-10 (error: J)", squeezed, balance, 0.05))
    jobs += [swinging(rtol) for rtol in (1e-9, 1e-12)]
    jobs += [row(count, rtol) for count in (2, 40) for rtol in (1e-8, 1e-11)]
    for rtol in (1e-9, 1e-11):
        jobs.append(Line(f"beat-up to 2 s, reduced, rtol {rtol:.0e}", partial(free, beat_up(), rtol), reduced_tip, 2))
        jobs.append(Line(f"beat-up to 2 s, general, rtol {rtol:.0e}", partial(general, rtol), tip, 2))
    for h in (1e-3, 1e-4):
        jobs.append(
            Line(f"beat-up to 2 s, exudyn generalised alpha, h {h:.0e}", partial(PEERS.exudyn_angle, 2.0, h), off, 2)
        )
        jobs.append(Line(f"beat-up to 2 s, mujoco RK4, h {h:.0e}", partial(PEERS.mujoco_angle, 2.0, h), off, 2))
    jobs.append(Line("beat-up, two turns, a pin of 0.08 mm (error: J)", loose, balance, 2 * math.pi / 10))
    return jobs


def run() -> None:
    print(f"{'':52s}{'s CPU / s':>10s}{'s CPU':>10s}{'error':>10s}")
    for line in lines():
        found, taken = line.work(), []
        for _ in range(3):
            start = time.process_time()
            found = line.work()
            taken.append(time.process_time() - start)
        print(f"{line.name:52s}{min(taken) / line.simulated:10.4f}{min(taken):10.4f}{line.error(found):10.1e}")
