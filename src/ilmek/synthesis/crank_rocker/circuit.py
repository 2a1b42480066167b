"""Circuit check of a crank-rocker: both dead centres must be on one circuit.

The classical problem gives the crank Z1 and the rocker Z2 at the extended dead centre by two linear equations, for any
ratio of coupler to crank, L = b / a, with the ground link 1:

    (1 + L) Z1 - Z2 = 1,       (1 - L) e^{i phi} Z1 - e^{i psi} Z2 = 1

They do not include the motion between the dead centres. The joint B of a crank-rocker never crosses the ground line, so

    Im Z2  and  Im(Z2 e^{i psi})  must have the same sign

Without this check a search over L finds better transmission angles than the optimum, of linkages whose rocker would
have to jump across the ground line. With it no member is better than `best_ratio`. [derived from the loop closure]
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, ComplexField, RealField


class ExtendedPose(NamedTuple):
    """Crank D -> C and rocker A -> B at the extended dead centre, in ground links, complex."""

    crank: ComplexField
    rocker: ComplexField


def extended(swing: RealField, rotation: RealField, ratio: RealField) -> ExtendedPose:
    """Crank and rocker at the extended dead centre, for any ratio a / b above 0, without circuit check.

    swing, rotation  psi, phi [rad]; any shapes that broadcast

    Infinite or NaN where the two equations have no unique solution.      [the two equations, by Cramer's rule]

    >>> found = extended(np.radians(30), np.pi, 0.3)
    >>> [round(float(abs(vector)), 4) for vector in found]
    [0.1998, 0.7721]
    """
    stretch = 1 / np.asarray(ratio, dtype=float)
    turned, swung = np.exp(1j * np.asarray(rotation)), np.exp(1j * np.asarray(swing))
    with np.errstate(divide="ignore", invalid="ignore"):
        det = (1 - stretch) * turned - (1 + stretch) * swung
        return ExtendedPose((1 - swung) / det, ((1 + stretch) - (1 - stretch) * turned) / det)


def on_one_circuit(swing: RealField, rocker: ComplexField) -> BoolArray:
    """Whether a rocker A -> B at one dead centre and the same rotated by `swing` at the other lie on one circuit.

    swing  psi [rad]      rocker  vector A -> B, complex, any unit

    False on the ground line, where the linkage is at a toggle position.

    >>> bool(on_one_circuit(np.radians(30), np.exp(1j * np.radians(120))))
    True
    >>> bool(on_one_circuit(np.radians(30), np.exp(1j * np.radians(170))))
    False
    """
    heights = np.imag(rocker), np.imag(rocker * np.exp(1j * np.asarray(swing)))
    return np.asarray(heights[0] * heights[1] > 0)
