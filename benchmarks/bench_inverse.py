"""Inverse dynamics of the tufting six-bar, all joint forces and both torques; and virtual power of random mechanisms.

The peer is what one writes in NumPy for this one mechanism: its 18 equations assembled for every state, about the
origin, and a stacked `np.linalg.solve`, in blocks that suit the cache. Both are handed the same motion and loads.
"""

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks.random_mechanisms import random_inertias, random_mechanism
from ilmek.arrays import FloatArray
from ilmek.dynamics.friction import AngleRange, Friction
from ilmek.dynamics.inverse import inverse
from ilmek.dynamics.loads import Gravity, PointForce, Torque
from ilmek.linkage.model import GROUND, Pin
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.linkage.status import Status
from ilmek.linkage.structure import plan
from ilmek.machines.tufting.model import inertias, mechanism, move
from ilmek.machines.tufting.params import TuftingParams

SAMPLES = 200_000
CAMPAIGN = 100_000
STATES = 5
BLOCK = 2048
PARAMS = TuftingParams()
PIERCING = AngleRange(PARAMS.entry, PARAMS.exit)
LOADS = (Gravity(-1j * PARAMS.gravity), Friction("needle.F", PARAMS.friction_force, "crank", PIERCING, 1.0))


def by_numpy(motion: Motion) -> FloatArray:
    """Sizes of every state's unknowns: the joints' forces in x and y (force and couple of the guide), both torques."""
    six_bar = motion.plan.mechanism
    row = {body: 3 * place for place, body in enumerate(six_bar.moving)}
    points = {
        joint.name: motion.carried(joint.bodies[0], six_bar.point(joint.bodies[0], joint.name)).position
        for joint in six_bar.joints
    }
    rubbing = LOADS[1].force(motion)
    tip = motion.carried("needle", six_bar.point("needle", "F")).position
    right = np.empty((len(motion), 18))
    for body, inertia in inertias(PARAMS).items():
        centre = motion.carried(body, inertia.centre)
        force = inertia.mass * (centre.acceleration + 1j * PARAMS.gravity)
        moment = np.imag(np.conj(centre.position) * force) + inertia.moment * motion.alpha(body)
        if body == "needle":
            force, moment = force - rubbing, moment - np.imag(np.conj(tip) * rubbing)
        right[:, row[body]], right[:, row[body] + 1], right[:, row[body] + 2] = force.real, force.imag, moment
    sizes = np.empty_like(right)
    for start in range(0, len(motion), BLOCK):
        part = slice(start, start + BLOCK)
        matrix = np.zeros((len(right[part]), 18, 18))
        for column, joint in enumerate(six_bar.joints):
            on, by = (joint.second, joint.first) if isinstance(joint, Pin) else joint.bodies
            at = points[joint.name][part]
            for body, sign in ((on, 1.0), (by, -1.0)):
                if body != GROUND:
                    first = row[body]
                    matrix[:, first, 2 * column] = sign
                    matrix[:, first + 2, 2 * column] = -sign * at.imag
                    if isinstance(joint, Pin):
                        matrix[:, first + 1, 2 * column + 1] = sign
                        matrix[:, first + 2, 2 * column + 1] = sign * at.real
                    else:
                        matrix[:, first + 2, 2 * column + 1] = sign
        matrix[:, row["crank"] + 2, 16] = 1.0
        matrix[:, row["arm"] + 2, 17], matrix[:, row["rocker"] + 2, 17] = 1.0, -1.0
        sizes[part] = np.linalg.solve(matrix, right[part, :, None])[..., 0]
    return sizes


def best(work: Callable[[], Any], times: int = 5) -> float:
    """The least processor time of several runs [ns a state]; the machine may be busy with other things."""
    work()
    taken = []
    for _ in range(times):
        start = time.process_time()
        work()
        taken.append(time.process_time() - start)
    return min(taken) / SAMPLES * 1e9


def six_bar() -> None:
    angle = np.arange(SAMPLES) * (2 * np.pi / SAMPLES)
    planned, bodies = plan(mechanism(PARAMS)), inertias(PARAMS)
    motion = move(PARAMS, planned, angle)
    jobs: list[tuple[str, Callable[[], Any]]] = [
        ("ilmek: joint forces, torques, power balance", lambda: inverse(motion, bodies, LOADS)),
        ("ilmek: the same and the motion", lambda: inverse(move(PARAMS, planned, angle), bodies, LOADS)),
        ("NumPy, this mechanism's 18 equations, stacked", lambda: by_numpy(motion)),
    ]
    ours = 0.0
    print(f"{'':52s}{'ns a state':>12s}{'against ours':>14s}")
    for name, work in jobs:
        taken = best(work)
        ours = ours or taken
        print(f"{name:52s}{taken:12.0f}{taken / ours:13.1f}x")
    forces, sizes = inverse(motion, bodies, LOADS), by_numpy(motion)
    apart = np.abs(forces.effort("crank") - sizes[:, 16]).max() / np.abs(sizes[:, 16]).max()
    print(
        f"torques differ by {apart:.1e} of the greatest; power residual {forces.power_error:.1e} of the greatest power"
    )


def campaign(count: int = CAMPAIGN, seed: int = 1) -> None:
    """Power residual of random mechanisms of every kind of class II, under inertia, weight, a torque and a damper."""
    draw = np.random.default_rng(seed)
    errors, usable, start = [], 0, time.process_time()
    for _ in range(count):
        drawn, values = random_mechanism(draw)
        at = {name: value + np.linspace(-0.1, 0.1, STATES) for name, value in values.items()}
        speeds = {name: float(draw.uniform(-9, 9)) for name in values}
        spurts = {name: float(draw.uniform(-50, 50)) for name in values}
        motion = solve(plan(drawn), at, speeds, spurts)
        last = drawn.moving[-1]
        drag = PointForce((last, 0.3j), lambda moved, last=last: -20 * moved.carried(last, 0.3j).velocity)  # type: ignore[misc]
        loads = (Gravity(-9.81j), Torque(last, 3.0), drag)
        errors.append(inverse(motion, random_inertias(draw, drawn), loads).power_error)
        usable += int((motion.status == Status.OK).sum())
    taken = time.process_time() - start
    print(f"\n{count} random mechanisms, {usable} states that close: power residual over the greatest power")
    middle, high = np.percentile(errors, (50, 99.9))
    print(f"median {middle:.1e}, 99.9 % below {high:.1e}, greatest {max(errors):.1e}; {taken:.0f} s of processor time")


def run() -> None:
    six_bar()
    campaign()
