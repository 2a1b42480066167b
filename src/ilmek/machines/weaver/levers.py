"""The levers between the followers of a head and its tools, with radial slots for the pins of both.

Follower and tool run on straight lines at the distances a and b from the lever's pivot. A pin of each is in a slot of
an arm, so that with the lift s from the middle of the stroke

    tan phi = s / a,     the tool moves by b tan phi = s b / a        at every angle       [sliding pins; derived]

A bell crank, b upright, moves a tool along z; a straight lever, with its pivot between both lines, moves the sley down.
Side view, z + i y: z to the front from the warps, y up from the fell.
"""

import math

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.records import record
from ilmek.units import deg, mm

SWING = 33 * deg
"""Greatest angle of a bell crank from the middle of its stroke; assumed by this project, as all sizes here."""

LEAST_ARM, HALF, PIN, LEVER_AXLE = 12 * mm, 7 * mm, 5 * mm, 8 * mm
"""Least arm of a lever, half its width, diameters of its pins and of its axle [m]."""

OVER, SOLID = 6 * mm, 12 * mm
"""From a pin to the end of the cheeks that hold it, and from it to what is solid between them [m]."""


@record
class FollowerLever:
    """A lever between a follower, in front of its pivot, and a tool.

    pivot  [m]      arm  a, to the follower's line [m]      ratio  b / a      lift  of the follower [m]
    straight  moves the tool down where the follower rises; else a bell crank moves it to the warps
    """

    pivot: complex
    arm: float
    ratio: float
    lift: float
    straight: bool = False

    @property
    def pin(self) -> complex:
        """The tool's pin in the middle of its stroke [m]."""
        return self.pivot + self.ratio * self.arm * (-1 if self.straight else 1j)

    def turned(self, lift: RealField) -> FloatArray:
        """Its angle [rad] at lifts of the follower [m]."""
        return np.asarray(np.arctan((lift - self.lift / 2) / self.arm))

    def slot(self, length: float) -> tuple[float, float]:
        """Least and greatest distance from the pivot [m] of a pin whose line is at a length [m]."""
        return length, length * math.hypot(1.0, self.lift / 2 / self.arm)


def least_arm(lift: float) -> float:
    """The shortest arm of a bell crank for a lift [m]."""
    return max(LEAST_ARM, lift / 2 / math.tan(SWING))
