"""Torsion of a shaft with discs along it: natural frequencies, and the steady twist under torques of one period.

Between neighbouring discs the shaft is a finite element with a linear twist:

    k = G J / l [1 -1; -1 1]      m = rho J l / 6 [2 1; 1 2]      J = pi d^4 / 32

    (K - w² M) phi = 0,   phi' M phi = 1              natural frequencies w, rad/s; the shaft is free: w_0 = 0
    x(t) = Σ_m Σ_j phi_j phi_j' T_m e^(i m W t) / (w_j² - (m W)² + i m W c w_j²)        T_m harmonics of the torques

Damping is in proportion to the stiffness, c = 2 zeta / w_1: zeta is that of the first mode. The mean of the torques
must be balanced; the uniform rotation is left out of the twist of m = 0.           [Rao, Mechanical Vibrations, 5.3, 6]

n equal discs J on equal shafts k:  w_j = 2 sqrt(k / J) sin(j pi / 2n)
"""

import math

import numpy as np
import scipy

from ilmek.arrays import Float, FloatArray
from ilmek.elements.materials import Material
from ilmek.errors import ParameterError
from ilmek.records import record


@record
class TorsionModes:
    """Natural frequencies [rad/s], ascending from 0, and modes (discs, modes), of unit modal mass."""

    frequencies: Float[np.ndarray, " modes"]
    shapes: Float[np.ndarray, "discs modes"]


def torsion_modes(
    stations: FloatArray, inertias: FloatArray, diameter: float, material: Material, *, massless: bool = False
) -> TorsionModes:
    """Modes of a round shaft with discs.

    stations  of the discs along it, ascending [m]      inertias  of the discs [kg m²], above 0
    diameter  [m]      massless  True: of the shaft itself no inertia
    Raises ParameterError for fewer than two discs, and for stations that do not ascend.

    >>> from ilmek.elements.materials import MATERIALS
    >>> found = torsion_modes(np.arange(3) * 1.0, np.ones(3), 0.05, MATERIALS["structural steel"], massless=True)
    >>> stiffness = MATERIALS["structural steel"].shear_modulus * math.pi * 0.05**4 / 32
    >>> (found.frequencies[1:] ** 2 / stiffness).round(9).tolist()
    [1.0, 3.0]
    """
    lengths = np.diff(stations)
    if lengths.size == 0 or np.any(lengths <= 0):
        raise ParameterError("discs on a shaft", allowed="two or more, at ascending stations")
    polar, count = math.pi * diameter**4 / 32, len(stations)
    stiff, mass = np.zeros((count, count)), np.diag(np.asarray(inertias, dtype=float))
    weight = 0.0 if massless else material.density * polar
    for place, length in enumerate(lengths):
        both = slice(place, place + 2)
        stiff[both, both] += material.shear_modulus * polar / length * np.array([[1, -1], [-1, 1]])
        mass[both, both] += weight * length / 6 * np.array([[2, 1], [1, 2]])
    squares, shapes = scipy.linalg.eigh(stiff, mass)
    squares[0] = 0.0  # a free shaft turns as a whole
    return TorsionModes(np.sqrt(squares), shapes)


def steady_twist(modes: TorsionModes, torques: FloatArray, speed: float, damping: float) -> FloatArray:
    """Twist of each disc [rad] under torques of a turn, (discs, samples); its mean over the discs is 0 in the mean.

    torques  on the discs [N m] at equal steps of a turn, its end left out, (discs, samples); their mean balanced
    speed    of the shaft [rad/s]      damping  share of the critical of the first elastic mode
    """
    samples = torques.shape[1]
    harmonics = np.fft.rfft(torques, axis=1)
    whirl = speed * np.arange(harmonics.shape[1])
    squares = modes.frequencies[:, None] ** 2
    drag = 2 * damping / modes.frequencies[1]
    stiffness = squares - whirl**2 + 1j * whirl * drag * squares
    stiffness[0, 0] = np.inf
    answer = modes.shapes @ (modes.shapes.T @ harmonics / stiffness)
    return np.asarray(np.fft.irfft(answer, samples, axis=1))
