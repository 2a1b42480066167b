"""Forces of many crank-rockers with a mass on the rocker, the beater: those of `dynamics.inverse`, in closed form.

    F      of the coupler on the rocker at B
    v x F = J_A alpha_4 - g_4 x m_4 w,        u x F = -(g_3 x m_3 (a_3 - w) + J_3 alpha_3)
    F_C = F + m_3 (a_3 - w),     F_D = F_C + m_2 (a_2 - w),     F_A = m_4 (a_4 - w) - F
    T = C x F_C - g_2 x m_2 w    on the crank, whose speed is constant

u = CB, v = AB; 2, 3, 4 are crank, coupler and rocker with masses m, mass centres g from D, C and A, and accelerations a
of these; w is the acceleration of gravity. The first two are two equations for F:  F = (N v - M u) / (u x v),  M and N
their right sides.
[Newton and Euler, body by body; a test holds them equal to `dynamics.inverse`]
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexField, FloatArray, IntArray
from ilmek.plane.vectors import cross
from ilmek.synthesis.crank_rocker.dead_centres import LinkRatios
from ilmek.synthesis.crank_rocker.motion import CrankRockerMotion, moved


class CrankRockerBodies(NamedTuple):
    """Lengths, masses and moments of many crank-rockers, each an array of one shape.

    crank, coupler, rocker, beater   lengths [m], the beater: the mass on the rocker, from A
    crank_mass, crank_static         of the crank [kg], and times its centre's distance from D [kg m]
    coupler_mass, coupler_moment     of the coupler [kg], whose centre is its middle, and about it [kg m²]
    rocker_mass, rocker_static, rocker_moment   rocker and beater together [kg], mass times its centre's distance from A
                                     [kg m], and moment about A [kg m²]
    """

    crank: FloatArray
    coupler: FloatArray
    rocker: FloatArray
    beater: FloatArray
    crank_mass: FloatArray
    crank_static: FloatArray
    coupler_mass: FloatArray
    coupler_moment: FloatArray
    rocker_mass: FloatArray
    rocker_static: FloatArray
    rocker_moment: FloatArray

    def rows(self, row: IntArray) -> "CrankRockerBodies":
        """Those of some of them."""
        return CrankRockerBodies(*(column[row] for column in self))

    def links(self, ground: float) -> LinkRatios:
        """Their links over the ground link [m]."""
        return LinkRatios(self.crank / ground, self.coupler / ground, self.rocker / ground)


class CrankRockerLoad(NamedTuple):
    """Ground link [m], speed of the crank [rad/s], mass of the beater [kg], acceleration of gravity [m/s²]."""

    ground: float
    speed: float
    beater_mass: float
    gravity: complex


def loaded(load: CrankRockerLoad, made: CrankRockerBodies, angle: FloatArray) -> dict[str, FloatArray]:
    """Curves of crank-rockers at crank angles [rad] that broadcast with them; magnitudes, by name.

    rocker_speed [rad/s], rocker_acceleration [rad/s^2], beater_acceleration [m/s^2], beater_force [N],
    drive_torque [N m], and the forces in the pins A, B, C, D [N]
    """
    at = moved(made.links(load.ground), angle)
    pull, gravity = load.speed**2, load.gravity
    turned = (1j * at.alpha[1] - at.omega[1] ** 2) * at.rocker
    beater = (made.beater / made.rocker * (load.ground * pull)) * turned
    torque, pins = _forces(load, made, at, turned)
    size = np.abs(beater)
    return {
        "rocker_speed": np.abs(at.omega[1]) * load.speed,
        "rocker_acceleration": np.abs(at.alpha[1]) * pull,
        "beater_acceleration": size,
        "beater_force": load.beater_mass * (np.abs(beater - gravity) if gravity else size),
        "drive_torque": np.abs(torque),
        **{pin: np.abs(force) for pin, force in zip("ABCD", pins, strict=True)},
    }


def _forces(
    load: CrankRockerLoad, made: CrankRockerBodies, at: CrankRockerMotion, turned: ComplexField
) -> tuple[FloatArray, tuple[ComplexField, ...]]:
    """Torque on the crank [N m] and forces in the pins A, B, C, D [N]; turned: acceleration of B, at unit speed.

    Factors that are constant over the turn are multiplied first: their arrays are small beside the others.
    """
    ground, pull, gravity = load.ground, load.speed**2, load.gravity
    half = 0.5 * at.coupler
    coupler = (made.coupler_mass * (ground * pull)) * ((1j * at.alpha[0] - at.omega[0] ** 2) * half - at.pin)
    rocker = (made.rocker_static / made.rocker * (ground * pull)) * turned
    crank = (made.crank_static / made.crank * (ground * pull)) * at.pin
    M = (made.rocker_moment * (pull / ground)) * at.alpha[1]
    if gravity:
        coupler, rocker = coupler - made.coupler_mass * gravity, rocker - made.rocker_mass * gravity
        crank = crank + made.crank_mass * gravity
        M = M - made.rocker_static / made.rocker * cross(at.rocker, gravity)
    N = -cross(half, coupler) - (made.coupler_moment * (pull / ground)) * at.alpha[0]
    B = (N * at.rocker - M * at.coupler) / at.lean
    C = B + coupler
    torque = cross(at.pin, C) * ground
    if gravity:
        torque = torque - (made.crank_static / made.crank * ground) * cross(at.pin, gravity)
    return np.asarray(torque), (rocker - B, B, C, C - crank)
