"""The belt of the heads: clamped at both ends of their rail, and led about the pulley on the motor of each head.

    a = p z / 2 pi + d / 2 + u                  from the pulley's axis to those of the rollers beside it
    l = pi (p z / 2 pi + d / 2 + u) - 2 a       more belt for each head than its straight line        [derived]

p pitch, z teeth of the pulley, d diameter of a roller on the belt's back, u from the pitch line to that. Between its
rollers the belt goes half round the pulley, so one belt serves all heads of a rail: its length stays.

In plan z + i x about the pulley's axis, z to the front, x along the row [m].
"""

import math

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.belts import T5_BY_THE_METRE
from ilmek.plane.contours import polygon
from ilmek.report import Contour
from ilmek.units import mm, turn

BELT, TEETH = T5_BY_THE_METRE, 15
"""The belt, and the teeth of its pulleys: as few as it bears, so that the motor may be small."""

CLAMPED = 8
"""Teeth in a clamp, which then bears what the cords bear: makers' rule."""

RADIUS, ROLLER = BELT.belt.pitch_radius(TEETH), BELT.idler / 2
"""Pitch radius of the pulley, radius of the rollers [m]."""

ASIDE = RADIUS + ROLLER + BELT.back
"""From the pulley's axis along the row to those of its rollers [m]."""

LOOP = turn / 2 * ASIDE - 2 * ASIDE
"""Length of belt that a head takes more than the straight line [m]."""

CLAMP, APART = CLAMPED * BELT.belt.pitch, 3 * mm
"""Length of a clamp, and from it to a head's roller at the end of the row [m]."""

BESIDE = ASIDE + ROLLER + APART + CLAMP
"""Belt that is needed beyond the axis of a head at the end of the row [m]."""

ON_PULLEY = 0.05 * mm
"""Room of the belt on the tips of the pulley's teeth [m]."""

_ARC = 12


def loop() -> Contour:
    """The belt between its rollers, about the pulley, up to its straight line: drawn without its teeth."""
    tips = BELT.belt.tip_radius(TEETH) + ON_PULLEY
    inner = ROLLER + RADIUS + BELT.back - tips
    back = _line(ROLLER, RADIUS + BELT.back, 0.0)
    teeth = _line(inner, tips, math.acos(ROLLER / inner))
    return polygon(np.concatenate([teeth, back[::-1]]))


def _line(roller: float, pulley: float, begin: float) -> ComplexArray:
    """Round the first roller from an angle [rad], half round the pulley at its back, and round the other roller."""
    first = roller * np.exp(1j * np.linspace(begin, turn / 4, _ARC)) - 1j * ASIDE
    half = np.exp(-1j * (turn / 4 + np.linspace(0.0, turn / 2, 2 * _ARC)))
    return np.concatenate([first, pulley * half[1:-1], np.conj(first[::-1])])
