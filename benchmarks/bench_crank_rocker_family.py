"""The crank-rocker's family and Pareto's front: 10^4 members with their dynamics, against a loop over `solve`.

The peer is what one writes first: for each member the mechanism, `solve` and `inverse` over a turn in 360 steps, and
the greatest of the samples. It is timed on some members, and misses what lies between its samples.
"""

import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.structure import plan
from ilmek.machines.beat_up.family import tabulate
from ilmek.machines.beat_up.linkage import evaluate, magnitudes, mechanism
from ilmek.machines.beat_up.links import inertia_of, moving_masses
from ilmek.machines.beat_up.params import BEATER_RATIO, BeatUpParams
from ilmek.num.pareto import front
from ilmek.synthesis.crank_rocker.family import CrankRockerFamily, family
from ilmek.units import deg

MEMBERS, LOOPED, STEPS = 10_000, 60, 360
HOLE = 0.006
"""Diameter of the holes in the links [m]."""

ROTATIONS = (110, 160, 180, 200, 250)
FRONT = (("transmission_angle_min", -1), ("force_at_beat", -1), ("drive_torque_max", +1))
PEAKS = ("beater_acceleration_max", "beater_force_max", "drive_torque_max")
ANGLE = np.linspace(0, 2 * np.pi, STEPS + 1)


def timed(work: Callable[[], Any], times: int = 3) -> tuple[float, Any]:
    """The least processor time of several runs [s], and what they gave; the machine may be busy with other things."""
    taken = []
    for _ in range(times):
        begin = time.process_time()
        found = work()
        taken.append(time.process_time() - begin)
    return min(taken), found


def whole(params: BeatUpParams, count: int) -> tuple[dict[str, FloatArray], int]:
    """Every quantity of every member, and how many are on the front."""
    members = family(params.rocker_swing, params.crank_rotation, count)
    table = dict(tabulate(params, members.links, members.beta, HOLE))
    return table, int(front(np.stack([sign * table[name] for name, sign in FRONT], axis=1)).sum())


def looped(params: BeatUpParams, members: CrankRockerFamily, places: Sequence[int]) -> FloatArray:
    """The greatest samples of `PEAKS`, (members, peaks), one member after another."""
    found = []
    for place in places:
        crank, coupler, rocker = (float(np.asarray(link)[place]) * params.ground for link in members.links)
        lengths = {"ground": params.ground, "crank": crank, "coupler": coupler, "rocker": rocker}
        lengths["beater"] = BEATER_RATIO * rocker
        bodies = {name: inertia_of(moments) for name, moments in moving_masses(params, lengths, HOLE).items()}
        curves = magnitudes(evaluate(params, plan(mechanism(lengths)), bodies, ANGLE))
        found.append([float(np.max(curves[name.removesuffix("_max")])) for name in PEAKS])
    return np.array(found)


def run() -> None:
    print(f"  {MEMBERS} members, all quantities and the front; the loop: {LOOPED} members, scaled up; processor time")
    print("  crank rotation    ilmek   on front       loop   ratio   loop's peaks too low by: median, greatest")
    for rotation in ROTATIONS:
        one(BeatUpParams(crank_rotation=rotation * deg, gravity=9.81))


def one(params: BeatUpParams) -> None:
    """A line of the table: one family."""
    taken, (table, on_front) = timed(lambda: whole(params, MEMBERS))
    places = np.linspace(0, MEMBERS - 1, LOOPED).astype(int).tolist()
    members = family(params.rocker_swing, params.crank_rotation, MEMBERS)
    loop, sampled = timed(lambda: looped(params, members, places), 1)
    loop *= MEMBERS / LOOPED
    missed = 1 - sampled / np.stack([table[name][places] for name in PEAKS], axis=1)
    print(
        f"  {params.crank_rotation / deg:>10.0f} deg{taken:>9.2f} s{on_front:>10}{loop:>9.1f} s{loop / taken:>7.0f}x"
        f"{np.median(missed):>20.1e}{missed.max():>12.1e}"
    )


if __name__ == "__main__":
    run()
