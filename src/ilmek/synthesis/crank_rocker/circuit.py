"""The circuit check of a crank-rocker: both dead centres must be reached without taking it apart.

The classical problem gives the crank Z1 and the rocker Z2 at the extended dead centre, for any ratio of the coupler to
the crank, L = b / a, by two linear equations; the ground link is 1:

    (1 + L) Z1 - Z2 = 1,       (1 - L) e^{i phi} Z1 - e^{i psi} Z2 = 1

They know nothing of the way between the dead centres. A crank-rocker's joint B never crosses the ground line, so that

    Im Z2  and  Im(Z2 e^{i psi})  must be of one sign

Without this check a search over L finds better transmission angles than the best there is, all of linkages whose
rocker would have to jump from one side of the ground line to the other. With it nothing beats `best_ratio`.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, ComplexField, RealField


class ExtendedPose(NamedTuple):
    """Crank D -> C and rocker A -> B at the extended dead centre, in ground links, complex."""

    crank: ComplexField
    rocker: ComplexField


def extended(swing: RealField, rotation: RealField, ratio: RealField) -> ExtendedPose:
    """Crank and rocker at the extended dead centre, whatever they are good for, for any ratio a / b above 0.

    Infinite or NaN where the two equations have no one solution.      [the two equations, by Cramer's rule]

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
    """Whether a rocker A -> B at one dead centre and the same turned by `swing` at the other lie on one circuit.

    On the ground line, where the linkage stands in a toggle: False.

    >>> bool(on_one_circuit(np.radians(30), np.exp(1j * np.radians(120))))
    True
    >>> bool(on_one_circuit(np.radians(30), np.exp(1j * np.radians(170))))
    False
    """
    here = np.imag(rocker)
    there = np.imag(rocker * np.exp(1j * np.asarray(swing)))
    return np.asarray(here * there > 0)
