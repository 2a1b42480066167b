"""How far the yarn's pull bends the needle aside between the warps.

The needle is a blade, as thin across the section as the gap asks, broader along the warps. Where the wide link ends it
is clamped. The yarn pulls at the tip against its motion; what of that is across the needle, F, bends it, and at the
warps, x from the clamp of the length L, by

    y = F x² (3 L - x) / 6 E I,      I = breadth d³/12                                 [a clamped bar under an end load]
"""

import numpy as np

from ilmek.elements.materials import MATERIALS
from ilmek.machines.knotting_dyad.arm_path import Arm
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.section import WarpSection

STEEL = MATERIALS["heat-treatable steel"]
SAMPLES = 201


def bent_aside(params: KnottingDyadParams, section: WarpSection, arm: Arm) -> float:
    """The most that the needle is bent aside at the warps' axes on its way behind them [m]."""
    s = np.linspace(0.0, 1.0, SAMPLES)
    beyond, length = arm.beyond(s), section.needle_length
    turn = arm.way(s).first[:, 1] * beyond  # the tip across the needle, by s; along it the stroke
    across = params.yarn_pull * np.abs(turn) / np.hypot(turn, arm.stroke)
    x = length - np.maximum(beyond, 0.0)
    inertia = params.needle_breadth * section.needle**3 / 12
    bent = across * x**2 * (3 * length - x) / (6 * STEEL.modulus * inertia)
    return float(np.max(bent[beyond >= 0]))
