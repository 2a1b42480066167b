"""Status of a sample."""

from enum import IntEnum

TOUCHING = 1e-12
"""Greatest gap, relative to the links, that a message attributes to rounding: the links are in line and just reach."""


class Status(IntEnum):
    """Status of a sample.

    OK             solved; every acceleration has two digits or more, see `judgement`
    CANNOT_CLOSE   the links do not reach: no position, NaN
    DEAD_CENTRE    links in line, or so near that rounding leaves less than two digits of an acceleration: a position
                   (NaN if in line to rounding), no reliable velocity or acceleration
    NOT_CONVERGED  Newton's method found no position: NaN

    OK guarantees that the errors of all accelerations of a group are below a hundredth of its largest: of the
    bodies' angular accelerations times their lengths [m/s^2], and of its sliders' accelerations. The judgement
    depends on the links' lengths and is independent of the position in the plane and of the units.
    """

    OK = 0
    CANNOT_CLOSE = 1
    DEAD_CENTRE = 2
    NOT_CONVERGED = 3
