"""The comb on crank-rockers, which share it: the beat-up linkage as the hammer's drive.

Each crank-rocker carries its share of the comb. At the extended dead centre the rocker turns the comb back with m a: so
much force the fell can take before the pins' load turns round, and so much is counted on. It goes with the square of
the speed.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.machines import beat_up
from ilmek.machines.beat_up.design import evaluate
from ilmek.machines.hammer.comb import comb_mass
from ilmek.machines.hammer.params import HammerParams


@dataclass(frozen=True, slots=True)
class Linkage:
    """Crank-rockers, all alike: one of them, their number, their force at the beat together [N].

    energy  of motion of the comb where it is quickest [J]      torque  largest on the crank shaft of all [N m]
    """

    one: beat_up.BeatUp
    number: int
    force: float
    energy: float
    torque: float


def linkage_for(params: HammerParams) -> Linkage:
    """The crank-rockers of the comb."""
    number = params.rockers
    share = comb_mass(params) / number
    one = beat_up.design(
        beat_up.BeatUpParams(ground=params.ground, speed=params.beat_speed, beater_mass=share, beat_force=0.0)
    )
    beat = evaluate(one.params, one.plan, one.bodies, np.array([one.beta]))
    quickest = one.peaks["beater_velocity"].value
    return Linkage(
        one=one,
        number=number,
        force=number * float(np.abs(beat.beater_force[0])),
        energy=0.5 * number * share * quickest**2,
        torque=number * one.peaks["drive_torque"].value,
    )
