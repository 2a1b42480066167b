"""Pins of joints: shear, bending in the fork, mean pressure, pressure times sliding speed, life of a rolling bearing.

    τ = F / (n π d² / 4),    M = F (l + 2 g) / 8,    σ = 32 M / (π d³),    p = F / (d l)
    (p v)_mean = mean over the time of p |ω| d / 2
    P_m = (∫ F^q |ω| dt / ∫ |ω| dt)^(1/q),    L_10 = (C / P_m)^q 10^6 turns

F force in the joint [N], d diameter, l bearing length of the middle part, g thickness of each cheek of the fork [m],
n = 2 sections in a fork, 1 in an overhung pin, ω relative angular velocity of the two bodies [rad/s], q = 3 for balls,
10/3 for rollers.  [Roloff/Matek, Machine Elements, 9.2: pin with clearance in both parts; ISO 281; for variable loads
Harris, Rolling Bearing Analysis]

>>> round(pin_shear(6000.0, 0.012) / 1e6, 3), mean_pressure(6000.0, 0.012, 0.02) / 1e6
(26.526, 25.0)
"""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.elements.bearing_table import RollingBearing
from ilmek.elements.bearings import life
from ilmek.units import mm

PIN_DIAMETERS = tuple(size * 1e-3 for size in (6, 8, 10, 12, 16, 20, 25, 30, 40, 50, 63, 80, 100))
"""Diameters of pins to choose from [m]: of ISO 2341 and 2340."""


def side_play(width: float) -> float:
    """Play along its pin of what turns between cheeks [m]: more than ISO 2768-m takes of its width and theirs.

    >>> round(side_play(0.006), 6), round(side_play(0.012), 6)
    (0.00025, 0.00045)
    """
    return (0.25 if width <= 6 * mm * (1 + 1e-9) else 0.45) * mm


def pin_shear(force: float, diameter: float, *, fork: bool = True) -> float:
    """Mean shear stress [Pa] of a pin in a fork (two sections), or of an overhung one."""
    return force / ((2 if fork else 1) * math.pi * diameter**2 / 4)


def pin_bending(force: float, diameter: float, length: float, cheek: float | None = None) -> float:
    """Bending stress [Pa] of a pin in a fork, with clearance in both parts.

    length  of the middle part [m]      cheek  thickness of each cheek of the fork [m]; default: half the middle part

    >>> round(pin_bending(6000.0, 0.012, 0.02) / 1e6, 1)
    176.8
    """
    side = length / 2 if cheek is None else cheek
    return 32 * force * (length + 2 * side) / 8 / (math.pi * diameter**3)


def mean_pressure(force: float, diameter: float, length: float) -> float:
    """Mean pressure [Pa] of a pin on its bush, F / (d l)."""
    return force / (diameter * length)


def pressure_velocity(
    force: FloatArray, omega: FloatArray, weights: FloatArray, diameter: float, length: float
) -> float:
    """Mean over the time of pressure times sliding speed [Pa m/s]: of |F| |ω| / (2 l); the diameter cancels.

    force    |F| [N] and omega ω [rad/s], one value per sample      weights  share of each sample in the time; sum 1
    diameter, length  of the bush [m]

    >>> one = np.ones(4)
    >>> pressure_velocity(1000 * one, 10 * one, one / 4, 0.02, 0.025)  # 2 MPa at 0.1 m/s
    200000.0
    """
    pressure = mean_pressure(1.0, diameter, length) * np.abs(force)
    return float(np.sum(weights * pressure * np.abs(omega) * diameter / 2))


def mean_bearing_load(force: FloatArray, omega: FloatArray, weights: FloatArray, kind: str) -> float:
    """Equivalent constant load P_m [N] of a force that varies with the relative rotation; 0 without rotation.

    force, omega, weights  as for `pressure_velocity`      kind  of the bearing, ends in "ball" or "roller"
    """
    power = 10 / 3 if kind.endswith("roller") else 3.0
    turned = weights * np.abs(omega)
    total, top = float(np.sum(turned)), float(np.max(np.abs(force), initial=0.0))
    if total == 0 or top == 0:
        return 0.0
    return float(top * (np.sum((np.abs(force) / top) ** power * turned) / total) ** (1 / power))


def bearing_life_seconds(
    bearing: RollingBearing, force: FloatArray, omega: FloatArray, weights: FloatArray, reliability: float = 0.9
) -> float:
    """Life [s of running] of a rolling bearing in a joint; infinite where it does not turn or is not loaded.

    An oscillating bearing makes |ω| / 2π turns per second; that false brinelling at swings below the pitch of its
    balls shortens its life is not covered.

    force, omega, weights  as for `pressure_velocity`      reliability  0.90 to 0.99

    >>> from ilmek.elements.bearings import find_bearing
    >>> one, hour = np.ones(3), 3600.0
    >>> round(bearing_life_seconds(find_bearing("6204"), 1000 * one, 31.4159 * one, one / 3) / hour)
    116509
    """
    speed = float(np.sum(weights * np.abs(omega)))
    load = mean_bearing_load(force, omega, weights, bearing.kind)
    if speed == 0 or load == 0:
        return math.inf
    return life(bearing.dynamic, load, bearing.kind, reliability) * 2 * math.pi / speed
