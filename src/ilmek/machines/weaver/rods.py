"""The side grippers' rods and arms: bend and stress by the yarn that they lead, natural frequency against their motion.

A round rod of the diameter t reaches the length l past its guide, its arm stands across it by rho. The yarn's pull F
at the arm's end, across the rod, bends the rod, twists it, and bends the arm:

    y = F l³ / 3 E I + F rho² l / G J + F rho³ / 3 E I,     I = pi t⁴ / 64,  J = 2 I,  G = E / 2 (1 + nu)

[cantilever with a force at its end; torsion of a round bar; added as if all in one direction: an upper bound]

The rod is bent by F l and twisted by F rho, σv = sqrt(σ² + 3 τ²). It vibrates as a cantilever with the arm's mass at
its end; a motion of the time t from rest to rest leaves little of it where t f is large (`cams.vibration.least_ratio`).
"""

from ilmek.elements.beam.model import Beam
from ilmek.elements.materials import MATERIALS
from ilmek.elements.sections import Section, round_section
from ilmek.elements.whirl import Mass, frequencies
from ilmek.machines.weaver.grippers import Grippers
from ilmek.machines.weaver.motions import SIDE_MOTION
from ilmek.machines.weaver.params import WeaverParams
from ilmek.timing.cyclogram import Cyclogram
from ilmek.units import turn

STEEL = MATERIALS["hard-drawn stainless steel"]
ROD_STRESS = (STEEL.fatigue or 0.0) / 1.5
"""Allowed stress of the rods [Pa]: the fatigue limit over a safety of 1.5, assumed by this project."""

ROD_TIME = 5.0
"""Least time of a motion over the rods' natural period: the common laws then leave about 1 % of the travel or less
as vibration (`cams.vibration.least_ratio`); assumed by this project."""


def wall_of(params: WeaverParams) -> float:
    """Wall of a gripper's tube [m]: its bore is half as wide."""
    return params.finger / 4


def _section(params: WeaverParams) -> Section:
    return round_section(params.finger, params.finger - 2 * wall_of(params))


def rod_bend(params: WeaverParams, grippers: Grippers) -> float:
    """Greatest deflection of a side gripper's tip [m], with the rod out of its guide by the whole travel."""
    length, inertia = params.opening + grippers.crossing, _section(params).inertia
    modulus, shear = STEEL.modulus, STEEL.modulus / (2 * (1 + STEEL.poisson))
    bent = (length**3 + grippers.arm**3) / (3 * modulus * inertia)
    return params.forces.yarn_pull * (bent + grippers.arm**2 * length / (shear * 2 * inertia))


def rod_stress(params: WeaverParams, grippers: Grippers) -> float:
    """Greatest equivalent stress of a side gripper's rod by the yarn [Pa], out of its guide by the whole travel."""
    pull, length = params.forces.yarn_pull, params.opening + grippers.crossing
    section = _section(params)
    return float(section.equivalent_stress(pull * max(length, grippers.arm), pull * grippers.arm))


def rod_frequency(params: WeaverParams, grippers: Grippers) -> float:
    """Lowest natural frequency of a side gripper's rod with its arm [rad/s], out of its guide by the whole travel."""
    length, section = params.opening + grippers.crossing, _section(params)
    line_mass = section.area * STEEL.density
    beam, arm = Beam(length, (0.0,), clamped=(0.0,)), [Mass(length, line_mass * grippers.arm)]
    return float(frequencies(beam, STEEL.modulus * section.inertia, line_mass, arm, count=1)[0])


def rod_time_ratio(params: WeaverParams, grippers: Grippers, cyclogram: Cyclogram) -> float:
    """Time of the quickest motion of the side grippers over the period of their rods' natural frequency [1]."""
    track = cyclogram.track(SIDE_MOTION)
    shortest = min(part.end - part.start for part in track.segments) / cyclogram.speed
    return shortest * rod_frequency(params, grippers) / turn
