"""Pins of a mechanism over a motion: greatest force, shear, bending, pressure, pressure times speed, life of a bearing.

The force is that of the joint, the speed that of its two bodies relative to one another; means are those over the time
of the samples. See `ilmek.elements.pin_joints` for the formulas.
"""

from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.dynamics.inverse import Forces
from ilmek.elements.bearing_table import RollingBearing
from ilmek.elements.pin_joints import bearing_life_seconds, mean_pressure, pin_bending, pin_shear, pressure_velocity
from ilmek.records import record


@record
class PinDuty:
    """Load of a pin over a cycle, one value per sample where the motion is solved.

    name  of the joint      bodies  that it joins      force  |F| [N]      omega  relative angular velocity [rad/s]
    weights  share of each sample in the time; sum 1
    """

    name: str
    bodies: tuple[str, str]
    force: FloatArray
    omega: FloatArray
    weights: FloatArray

    @property
    def greatest(self) -> float:
        """Greatest force [N]."""
        return float(np.max(self.force, initial=0.0))


@record
class PinStrength:
    """Stresses of a pin over a cycle.

    name  of the joint        diameter [m]                   force  greatest [N]
    shear  greatest mean shear stress [Pa]
    bending  greatest bending stress in the fork [Pa]; 0 of an overhung pin
    pressure  greatest mean pressure on the bush [Pa]        wear  mean of pressure times sliding speed [Pa m/s]
    """

    name: str
    diameter: float
    force: float
    shear: float
    bending: float
    pressure: float
    wear: float


def pin_duty(forces: Forces, joint: str, times: FloatArray | None = None) -> PinDuty:
    """Load of a pin over the motion of the forces.

    times  of the samples [s], ascending; default: equal steps, both ends of a cycle included

    Raises MechanismError for an unknown joint.
    """
    first, second = forces.mechanism.joint(joint).bodies
    force, omega = np.abs(forces.pin(joint)), forces.motion.omega(second) - forces.motion.omega(first)
    steps = np.ones(force.size - 1) if times is None else np.diff(times)
    weights = np.zeros(force.size)
    weights[:-1] += steps / 2
    weights[1:] += steps / 2
    solved = np.isfinite(force) & np.isfinite(omega)
    total = float(weights[solved].sum())
    return PinDuty(
        joint, (first, second), force[solved], omega[solved], weights[solved] / total if total > 0 else weights[solved]
    )


def pin_strength(
    duty: PinDuty, diameter: float, length: float, *, fork: bool = True, cheek: float | None = None, share: float = 1.0
) -> PinStrength:
    """Stresses of a pin under a load over a cycle.

    diameter, length  of the pin and of its bush [m]      fork   False: overhung, with one section
    cheek  thickness of each cheek of the fork [m]; default: half the length
    share  of the time for which the mechanism moves, for the mean of pressure times speed
    """
    top = duty.greatest
    return PinStrength(
        name=duty.name,
        diameter=diameter,
        force=top,
        shear=pin_shear(top, diameter, fork=fork),
        bending=pin_bending(top, diameter, length, cheek) if fork else 0.0,
        pressure=mean_pressure(top, diameter, length),
        wear=share * _rubbing(duty) / length,
    )


@lru_cache(maxsize=64)
def _rubbing(duty: PinDuty) -> float:
    """Mean of pressure times sliding speed of a pin in a bush of 1 m [Pa m/s]; its diameter does not matter."""
    return pressure_velocity(duty.force, duty.omega, duty.weights, 1.0, 1.0)


def bearing_life(duty: PinDuty, bearing: RollingBearing, reliability: float = 0.9) -> float:
    """Life [s of running] of a rolling bearing in a pin joint; infinite where it does not turn."""
    return bearing_life_seconds(bearing, duty.force, duty.omega, duty.weights, reliability)
