"""The spigots of the shaft ends in a tube: the tube is bored at both ends, the spigot fits its bore, a weld holds it.

A fillet weld all round the end of the tube, of the radius r, on the flange of the shaft end carries its torque T and
its bending moment M; the fit only centres:

    f = sqrt(T² / 4 + M²) / (pi r²) <= f_w a                          [EN 1993-1-8, 4.5.3.3; theory of elasticity]
"""

import math

from ilmek.elements.fillet_welds import throat_for
from ilmek.elements.tubes import turned_bore
from ilmek.machines.warp_tension.slot import Ring, depth
from ilmek.units import mm

LENGTH, FLANGE = 20 * mm, 8 * mm
"""Length of a spigot, thickness of the flange [m]; assumed by this project."""

_STEP = 1 * mm


def bored(cylinder: Ring) -> float:
    """Radius of the bore at the ends of a tube [m]: its diameter in whole millimetres, half of the metal at most."""
    return min(turned_bore(cylinder.inner), cylinder.inner + (cylinder.outer - cylinder.inner - depth(cylinder)) / 2)


def spigot_length(span: float) -> float:
    """Length of the bores and of the spigots in them, of a tube of a length [m]."""
    return min(LENGTH, span / 4)


def weld_force(radius: float, torque: float, moment: float) -> float:
    """Force on the length of a weld all round a radius [m] by torque and bending moment [N m]: [N/m].

    >>> round(weld_force(0.1, 2 * math.pi, 0.0), 9), round(weld_force(0.1, 0.0, math.pi), 9)
    (100.0, 100.0)
    """
    return math.hypot(torque / 2, moment) / (math.pi * radius**2)


def flange_radius(outer: float, throat: float) -> float:
    """Radius of the flange on a tube of a radius [m]: its weld has room beside the tube."""
    return outer + math.ceil(math.sqrt(2) * throat / _STEP) * _STEP


def weld_throat(force: float, cylinder: Ring) -> float:
    """Throat of the weld [m] under a force on its length [N/m]."""
    return throat_for(force, cylinder.outer - cylinder.inner)
