"""The bars to which the warps are tied, one in a slot along each cylinder that winds; thesis, 3.1, Figures 3.3 and 3.4.

    p = T n / l h                                                pressure on the slot's edge, before a warp is wound
    sigma_v = sqrt(sigma² + 3 tau²),   sigma = M (R - h) / I,   tau = M_t / (2 pi r² s)          [von Mises, Bredt]
    I = pi (R⁴ - Ri⁴) / 4 - w h (R - h / 2)²,   s = R - Ri - h,   r = Ri + s / 2

h depth and w width of the slot in a tube of the radii R and Ri; T n pull of the warps over their width l; M moment of
their bending in the middle, M_t torque. The bar is half in the slot; the pull is along the surface, and the first turn
of warps keeps it there.
"""

import math
from collections.abc import Sequence
from functools import lru_cache

from ilmek.elements.beam import uniform
from ilmek.elements.materials import MATERIALS
from ilmek.machines.warp_tension.cylinders import Cylinder, part_id
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.machines.warp_tension.slot import SLOT_AT, depth, diameter, width
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.shapes import bar
from ilmek.part.tree import Occurrence
from ilmek.report import Check, at_least, at_most
from ilmek.units import turn

ATTACHMENT_BAR = part_id("attachment-bar")
"""Id of the part."""

SAFETY = 1.5
"""Of slot and cylinder against yielding; assumed by this project."""

BRIGHT = MATERIALS["heat-treatable steel"]


@lru_cache(maxsize=8)
def attachment_bar(thick: float, wide: float) -> Part:
    """A bar, by its diameter and length [m]."""
    title = "attachment bar of the warps"
    held = "lies half in its slot, by cable ties at its ends until the first turn of the warps keeps it"
    return Part(ATTACHMENT_BAR, title, "steel bar", bar(thick, wide), BRIGHT, fixing=held)


def on_cylinder(cylinder: Cylinder, tube: Part, params: WarpTensionParams) -> tuple[Occurrence, ...]:
    """The tube, and its bar in the slot as wide as the warps; about z, 0 in the middle of the width."""
    wide, thick = params.cloth.width, diameter(cylinder)
    at = (cylinder.outer - depth(cylinder) + thick / 2) * SLOT_AT
    return (
        Occurrence(tube, (placement(z=-params.span / 2),)),
        Occurrence(attachment_bar(thick, wide), (placement(at.real, at.imag, -wide / 2),)),
    )


def slot_stress(params: WarpTensionParams, cylinder: Cylinder) -> float:
    """Stress of a cylinder under its slot [Pa]."""
    outer, inner, deep = cylinder.outer, cylinder.inner, depth(cylinder)
    lost = width(cylinder) * deep * (outer - deep / 2) ** 2
    inertia = float(uniform.tube_inertia(outer, inner)) - lost
    bent = float(uniform.moment_max(abs(cylinder.load), params.span)) * (outer - deep) / inertia
    left = outer - inner - deep
    twisted = cylinder.torque / (turn * (inner + left / 2) ** 2 * left)
    return math.hypot(bent, math.sqrt(3) * twisted)


def attachment_checks(params: WarpTensionParams, winding: Sequence[Cylinder]) -> tuple[Check, ...]:
    """The slot's edge under the pull of all warps, and what the slot leaves of the more loaded cylinder."""
    cylinder = max(winding, key=lambda own: slot_stress(params, own))
    pressure = abs(cylinder.bare) * params.span / (params.cloth.width * depth(cylinder))
    source, cure = (
        f"yield of the tube over {SAFETY:g}; assumed by this project",
        "set a thicker wall, or a lower tension",
    )
    parts = ATTACHMENT_BAR, part_id("cylinder")
    return (
        at_most("pressure of the attachment bar", pressure, params.strength / SAFETY, "MPa", source).with_cure(
            cure, *parts
        ),
        at_least(
            "safety of a cylinder under its slot",
            params.strength / slot_stress(params, cylinder),
            SAFETY,
            "1",
            "bending and torsion, yield of the tube; assumed by this project",
        ).with_cure(cure, *parts),
    )
