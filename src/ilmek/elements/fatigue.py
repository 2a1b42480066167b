"""Fatigue of a shaft: endurance limit with Marin's factors, notches, safety after Goodman and after Soderberg.

    Se = ka kb kc ke Se',   Se' = Sut / 2 (700 MPa at most),   Kf = 1 + q (Kt - 1)
    1 / n = σa / Se + σm / Sut                              [Goodman; Soderberg has the yield strength for Sut]

σa, σm are von Mises stresses of amplitude and mean of bending and torsion, with notch factors.
                              [Shigley's Mechanical Engineering Design, 9th ed., 6-7 to 6-14, eq. 7-7; steel shafts]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.elements.sections import Section
from ilmek.errors import ParameterError
from ilmek.units import MPa, mm

SURFACES = {
    "ground": (1.58, -0.085),
    "machined": (4.51, -0.265),
    "hot-rolled": (57.7, -0.718),
    "forged": (272.0, -0.995),
}
"""Factor a and exponent b of ka = a Sut^b, Sut in MPa [table 6-2]; cold-drawn counts as machined."""

RELIABILITY = {0.5: 1.0, 0.9: 0.897, 0.95: 0.868, 0.99: 0.814, 0.999: 0.753, 0.9999: 0.702}
"""ke [table 6-5]."""

NOTCHES = {
    "none": (1.0, 1.0),
    "rounded shoulder": (1.7, 1.5),
    "sharp shoulder": (2.7, 2.2),
    "keyway": (2.14, 3.0),
    "sled-runner keyway": (1.7, 3.0),
    "retaining ring": (5.0, 3.0),
}
"""Kt of bending and of torsion for a first estimate [table 7-1]; r / d = 0.1, 0.02, 0.02 ..."""

_LARGEST = 700 * MPa


@dataclass(frozen=True, slots=True)
class Loading:
    """Amplitude and mean of moment and torque [N m]: on a rotating shaft a constant moment is an amplitude."""

    moment: float
    torque: float
    moment_mean: float = 0.0
    torque_amplitude: float = 0.0


def surface_factor(tensile: float, surface: str) -> float:
    """Surface factor ka [1] of a tensile strength [Pa] and a surface of `SURFACES` [eq. 6-19].

    Raises ParameterError for another surface.

    >>> round(surface_factor(520e6, "machined"), 3)
    0.86
    """
    if surface not in SURFACES:
        raise ParameterError(f"surface {surface!r}", allowed="one of " + ", ".join(SURFACES))
    factor, power = SURFACES[surface]
    return min(1.0, float(factor * (tensile / MPa) ** power))


def size_factor(diameter: float) -> float:
    """Size factor kb [1] of a diameter [m], clipped to 2.79 to 254 mm [eq. 6-20].

    >>> round(size_factor(0.032), 3)
    0.858
    """
    size = min(max(diameter / mm, 2.79), 254.0)
    return float((size / 7.62) ** -0.107 if size <= 51 else 1.51 * size**-0.157)


def endurance_limit(tensile: float, diameter: float, surface: str = "machined", reliability: float = 0.99) -> float:
    """Endurance limit Se [Pa] of a steel shaft in reversed bending [eq. 6-18].

    tensile  strength [Pa]      diameter  [m]      surface  of `SURFACES`      reliability  0.5 to 0.9999
    Raises ParameterError for an unknown surface or a reliability outside the table.

    >>> round(endurance_limit(690e6, 0.032, "machined", 0.5) / 1e6)
    236
    """
    levels, factors = zip(*sorted(RELIABILITY.items()), strict=True)
    if not levels[0] <= reliability <= levels[-1]:
        raise ParameterError(f"a reliability of {reliability:g}", allowed=f"{levels[0]:g} to {levels[-1]:g}")
    trusted = float(np.interp(reliability, levels, factors))
    return surface_factor(tensile, surface) * size_factor(diameter) * trusted * min(tensile / 2, _LARGEST)


def notch_factor(concentration: float, radius: float, tensile: float, *, torsion: bool = False) -> float:
    """Fatigue notch factor Kf of a steel shaft: Kf = 1 + q (Kt - 1), q = 1 / (1 + sqrt(a / r)) [eq. 6-33 to 6-35].

    concentration  Kt      radius  of the notch [m]      tensile  strength [Pa]

    >>> round(notch_factor(1.65, 0.003, 690e6), 2)
    1.55
    """
    kpsi, inch = tensile / 6.894757e6, 0.0254
    terms = (0.190, -2.51e-3, 1.35e-5, -2.67e-8) if torsion else (0.246, -3.08e-3, 1.51e-5, -2.67e-8)
    root = sum(term * kpsi**power for power, term in enumerate(terms))
    return 1 + (concentration - 1) / (1 + root / math.sqrt(radius / inch))


def goodman(
    loading: Loading, section: Section, *, endurance: float, tensile: float, notch: tuple[float, float] = (1.0, 1.0)
) -> float:
    """Safety against fatigue for infinite life; infinite without load.

    endurance  limit Se [Pa]      tensile  strength [Pa]; the yield strength instead gives Soderberg's criterion
    notch      Kf of bending and of torsion
    """
    bending, torsion = notch
    amplitude = section.equivalent_stress(bending * loading.moment, torsion * loading.torque_amplitude, turning=True)
    mean = section.equivalent_stress(bending * loading.moment_mean, torsion * loading.torque)
    used = float(amplitude) / endurance + float(mean) / tensile
    return 1 / used if used > 0 else float("inf")


def yielding(loading: Loading, section: Section, *, strength: float, notch: tuple[float, float] = (1.0, 1.0)) -> float:
    """Safety against yielding at the largest moment and torque together [eq. 7-15, 7-16].

    strength  yield strength [Pa]      notch  factors of bending and of torsion
    """
    moment = notch[0] * (abs(loading.moment) + abs(loading.moment_mean))
    torque = notch[1] * (abs(loading.torque) + abs(loading.torque_amplitude))
    stress = float(section.equivalent_stress(moment, torque, turning=True))
    return strength / stress if stress > 0 else float("inf")
