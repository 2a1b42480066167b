"""The tolerance of a cam's radii that its follower allows.

Radii are listed and checked at equal steps d. At worst their errors e alternate, and the profile waves once in 2 d:

    s = e sin(pi theta / d),   greatest |s''| = (pi / d)²,   e = a (d / (pi w))²

a spare acceleration: with less the follower stays on the cam, and the contact within its pressure. Longer waves of the
same height accelerate less.      [waviness between setting points: Rothbart, Cam Design Handbook, 10.4; a sine's second
derivative]
"""

import math

from ilmek.units import mm, um

MOST = 0.05 * mm
"""Largest tolerance that is given [m]: the tool's position; assumed by this project."""


def radius_tolerance(spare: float, speed: float, step: float) -> float:
    """Tolerance ± of radii [m] at steps [rad], in whole micrometres, at most `MOST`.

    spare  acceleration that errors may add [m/s²]      speed  of the cam [rad/s]

    >>> from math import radians
    >>> round(radius_tolerance(40.0, 12.5, radians(1)) / um, 3)
    7.0
    """
    bound = spare * (step / (math.pi * speed)) ** 2 if speed > 0 else math.inf
    return math.floor(min(bound, MOST) / um + 1e-9) * um
