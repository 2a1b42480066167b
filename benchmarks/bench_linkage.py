"""A four-bar's position, velocity and acceleration at a million crank angles: the general engine beside its peers.

All on one core, the same linkage (the beat-up's: 300, 59.7, 200.7, 230.8 mm) at constant crank speed. NumPy by hand is
this one linkage's formulas written out in real arithmetic, without arc functions: nothing general, the least work a
person would leave in it. pylinkage is run by its compiled path, to which it hands no batch of angles: it steps.
"""

import time
from collections.abc import Callable
from importlib.metadata import version
from typing import Any

import numpy as np
from pylinkage.actuators import Crank
from pylinkage.components import Ground
from pylinkage.dyads import RRRDyad
from pylinkage.simulation import Linkage

from ilmek.arrays import FloatArray
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import BLOCK, solve
from ilmek.linkage.structure import plan

SAMPLES = 1_000_000
SPEED = 15.5
GROUND, CRANK, COUPLER, ROCKER = 0.3, 0.0597, 0.2007, 0.2308
COLUMNS = ("coupler x", "coupler y", "rocker x", "rocker y", "coupler w", "rocker w", "coupler a", "rocker a")


def by_hand(angle: FloatArray) -> tuple[FloatArray, ...]:
    """The columns above: directions of coupler and rocker, their angular velocities and accelerations."""
    g, a, b, c = GROUND, CRANK, COUPLER, ROCKER
    ax, ay = a * np.cos(angle), a * np.sin(angle)
    dx, dy = g - ax, -ay
    dd = dx * dx + dy * dy
    along = 0.5 + 0.5 * (b * b - c * c) / dd
    across = np.sqrt(b * b / dd - along * along)
    ux, uy = along * dx - across * dy, along * dy + across * dx
    vx, vy = ux - dx, uy - dy
    sine = ux * vy - uy * vx
    rx, ry = SPEED * ay, -SPEED * ax
    wb, wc = (vx * rx + vy * ry) / sine, (ux * rx + uy * ry) / sine
    rx = SPEED * SPEED * ax + wb * wb * ux - wc * wc * vx
    ry = SPEED * SPEED * ay + wb * wb * uy - wc * wc * vy
    return ux / b, uy / b, vx / c, vy / c, wb, wc, (vx * rx + vy * ry) / sine, (ux * rx + uy * ry) / sine


def by_hand_in_blocks(angle: FloatArray) -> tuple[FloatArray, ...]:
    columns = tuple(np.empty_like(angle) for _ in COLUMNS)
    for start in range(0, len(angle), BLOCK):
        part = slice(start, start + BLOCK)
        for column, block in zip(columns, by_hand(angle[part]), strict=True):
            column[part] = block
    return columns


def as_columns(motion: Motion) -> tuple[FloatArray, ...]:
    coupler, rocker = motion.direction("coupler"), motion.direction("rocker")
    rates = (motion.omega("coupler"), motion.omega("rocker"), motion.alpha("coupler"), motion.alpha("rocker"))
    return coupler.real, coupler.imag, rocker.real, rocker.imag, *rates


def pylinkage() -> Callable[[], Any]:
    """The peer's run over all samples: positions, velocities and accelerations of every pin."""
    first, second = Ground(0.0, 0.0, name="A0"), Ground(GROUND, 0.0, name="B0")
    crank = Crank(anchor=first, radius=CRANK, angular_velocity=2 * np.pi / SAMPLES, name="A")
    dyad = RRRDyad(anchor1=crank.output, anchor2=second, distance1=COUPLER, distance2=ROCKER, name="B")
    linkage = Linkage([first, second, crank, dyad], name="four-bar")
    linkage.set_input_velocity(crank, SPEED)
    linkage.compile()
    return lambda: linkage.step_fast_with_kinematics(SAMPLES)


def best(work: Callable[[], Any], times: int = 7) -> float:
    """The least time of several runs [ns a state]; the machine may be busy with other things."""
    work()
    taken = []
    for _ in range(times):
        start = time.perf_counter()
        work()
        taken.append(time.perf_counter() - start)
    return min(taken) / SAMPLES * 1e9


def run() -> None:
    angle = np.arange(SAMPLES) * (2 * np.pi / SAMPLES)
    beat_up = plan(four_bar(GROUND, CRANK, COUPLER, ROCKER, branch=+1, points={"coupler": {"P": 0.1 + 0.05j}}))
    solved = solve(beat_up, angle, SPEED)
    apart = max(float(np.abs(x - y).max()) for x, y in zip(as_columns(solved), by_hand(angle), strict=True))
    step = pylinkage()
    jobs: list[tuple[str, Callable[[], Any]]] = [
        ("ilmek solve", lambda: solve(beat_up, angle, SPEED)),
        ("ilmek solve, then a coupler point's motion", lambda: solve(beat_up, angle, SPEED).point("coupler", "P")),
        ("NumPy by hand, in blocks", lambda: by_hand_in_blocks(angle)),
        ("NumPy by hand, whole arrays", lambda: by_hand(angle)),
        (f"pylinkage {version('pylinkage')}, compiled", step),
    ]
    ours = 0.0
    print(f"{'':44s}{'ns a state':>12s}{'against ours':>14s}")
    for name, work in jobs:
        taken = best(work)
        ours = ours or taken
        print(f"{name:44s}{taken:12.1f}{taken / ours:13.2f}x")
    print(f"ours and NumPy by hand differ by at most {apart:.1e} (directions, rad/s, rad/s^2)")
