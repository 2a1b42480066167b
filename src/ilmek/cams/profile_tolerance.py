"""The tolerances of a cam's radii that its follower allows: of each, and of the step from one to the next.

Radii are listed and checked at equal steps d. What shakes a follower is the increment of their error, not the error: a
gradual one matters less than the same in a shorter period. Of all waves whose increments are at most c, the shortest
accelerates most; its errors alternate by c/2:

    s = c/2 sin(pi theta / d),   greatest |s''| = c/2 (pi / d)²,   c = 2 a (d / (pi w))²

a spare acceleration: with less the follower stays on the cam, and the contact within its pressure. Longer waves with
the same increments accelerate less: of three steps 0.6 times, of four half as much.
                 [increment deviation: Rothbart, Cam Design Handbook, 10.4.6; waviness: Figure 10.8 there; derived]
"""

import math

from ilmek.units import mm, um

BAND = 0.05 * mm
"""Tolerance ± of each radius [m]: the tool's position; assumed by this project."""

GROUND = 2 * um
"""Least change of a ground cam's error from one degree to the next that can be ordered [m]; assumed by this project, as
grinders of camshafts hold some micrometres per degree."""


FLANK = 0.4 * um
"""Ra of a ground cam's track [m]."""


def increment_tolerance(spare: float, speed: float, step: float) -> float:
    """Largest change of the error of radii [m] from one step to the next [rad], in whole micrometres, at most `BAND`.

    spare  acceleration that errors may add [m/s²]      speed  of the cam [rad/s]

    >>> from math import radians
    >>> round(increment_tolerance(40.0, 12.5, radians(1)) / um, 3)
    15.0
    """
    bound = 2 * spare * (step / (math.pi * speed)) ** 2 if speed > 0 else math.inf
    return math.floor(min(bound, BAND) / um + 1e-9) * um
