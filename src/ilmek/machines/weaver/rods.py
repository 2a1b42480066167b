"""Bending of the side grippers' rods and arms by the yarn that they lead.

A round rod of the diameter t reaches the length l past its guide, its arm stands across it by rho. The yarn's pull F
at the arm's end, across the rod, bends the rod, twists it, and bends the arm:

    y = F l³ / 3 E I + F rho² l / G J + F rho³ / 3 E I,     I = pi t⁴ / 64,  J = 2 I,  G = E / 2 (1 + nu)

[cantilever with a force at its end; torsion of a round bar; added as if all in one direction: an upper bound]
"""

import math

from ilmek.elements.materials import MATERIALS
from ilmek.machines.weaver.grippers import Grippers
from ilmek.machines.weaver.params import WeaverParams

STEEL = MATERIALS["heat-treatable steel"]


def rod_bend(params: WeaverParams, grippers: Grippers) -> float:
    """Greatest deflection of a side gripper's tip [m], with the rod out of its guide by the whole travel."""
    length, inertia = params.opening + grippers.crossing, math.pi * params.finger**4 / 64
    modulus, shear = STEEL.modulus, STEEL.modulus / (2 * (1 + STEEL.poisson))
    bent = (length**3 + grippers.arm**3) / (3 * modulus * inertia)
    return params.forces.yarn_pull * (bent + grippers.arm**2 * length / (shear * 2 * inertia))
