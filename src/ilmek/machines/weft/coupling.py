"""The magnets by which the carriage drags a shuttle through the warps at rest between them.

    hold = n max over x of (S(x) - f N(x))          n pairs of magnets, S and N their forces along and across the warps

A shuttle that is dragged lags behind the carriage by x. The farther it lags the greater is S, up to a displacement at
which it is left behind; N presses shuttle and carriage on the warps between them, whose friction f takes its share.
[forces: `elements.magnets`; derived]
"""

from functools import lru_cache

import numpy as np

from ilmek.elements.magnets import block_forces
from ilmek.machines.weft.params import WeftParams
from ilmek.records import record, result
from ilmek.units import mm

PAIRS = 2
"""Pairs of magnets: one at each end of the shuttle."""

THICKEST = 10 * mm
"""Thickest magnet [m]: a thicker one adds little to the force."""

BOX_WALL = 2 * mm
"""Wall of a shuttle's box [m]: assumed by this project."""

BEHIND_BOX = 1 * mm
"""Least play between carriage and box [m]: assumed by this project."""

_SAMPLES = 60


@record
class MagneticCoupling:
    """Pairs of equal magnets face to face; sides: along the width, along and across the warps [m].

    gap   between their faces: the room of the shuttle before the warps, the warps, and the same behind them
    pull  where they stand face to face
    """

    sides: tuple[float, float, float]
    gap: float = result("mm", "between the magnets of shuttle and carriage", name="magnet_gap")
    hold: float = result(
        "N", "force at which the shuttle's magnets slip, friction of their pull taken off", name="magnet_hold"
    )
    pull: float = result("N", "pull of the magnets across the warps", name="magnet_pull", least=0.0)


def magnet_sides(params: WeftParams, diameter: float) -> tuple[float, float, float]:
    """Sides of a magnet in the nose of a shuttle for a bobbin of a diameter [m]; of no length where it has no nose."""
    return params.nose / 2, diameter, min(diameter / 2, THICKEST)


def coupling_gap(params: WeftParams) -> float:
    """Distance of the faces of shuttle and carriage [m]: room for the warps, and for the wall of a box."""
    through_warps = 2 * params.play + params.cloth.carpet_yarns.warp.diameter
    return max(through_warps, params.play / 2 + BOX_WALL + BEHIND_BOX)


def coupling(params: WeftParams, diameter: float) -> MagneticCoupling:
    """The coupling of a shuttle for a bobbin of a diameter [m]."""
    sides, gap = magnet_sides(params, diameter), coupling_gap(params)
    if not params.nose > 0:
        return MagneticCoupling(sides, gap, 0.0, 0.0)
    hold, pull = _forces(sides, gap, params.cloth.yarns.friction)
    return MagneticCoupling(sides, gap, hold, pull)


@lru_cache(maxsize=256)
def _forces(sides: tuple[float, float, float], gap: float, friction: float) -> tuple[float, float]:
    """Force at which all pairs slip, and their pull face to face [N]."""
    lag = np.linspace(0.0, 1.5 * sides[0], _SAMPLES)
    shear, pull = (np.abs(force) for force in block_forces(sides, sides, (lag, 0.0, gap + sides[2])))
    return PAIRS * max(0.0, float(np.max(shear - friction * pull))), PAIRS * float(pull[0])
