"""Plate cam with a translating roller, knife-edge or spherical follower.

The follower's line may pass beside the axis (`profile` has the formulas and the frame). A ball in a follower moves
and touches as a roller of its radius does, in the plane of its motion; only the Hertz contact is a point's.
"""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import profile
from ilmek.cams.programme import Programme
from ilmek.cams.trace import Trace, Traced, trace_of_point
from ilmek.errors import ParameterError
from ilmek.units import format_quantity


@dataclass(frozen=True, slots=True)
class PlateCam(Traced):
    """A plate cam with a translating roller or knife-edge follower; lengths in m, frame and signs as in `profile`.

    Raises ParameterError where the follower's line misses the prime circle or the roller fills it.
    """

    programme: Programme
    prime_radius: float
    offset: float = 0.0
    roller_radius: float = 0.0
    flat: ClassVar[bool] = False

    def __post_init__(self) -> None:
        least = max(abs(self.offset), self.roller_radius)
        if self.prime_radius <= least:
            shown = format_quantity(self.prime_radius, "mm")
            raise ParameterError(f"prime_radius={shown} is too small", allowed=f"above {format_quantity(least, 'mm')}")

    def trace(self, angle: FloatArray) -> Trace:
        """Everything at cam angles [rad], in one pass."""
        at = self.programme.at(angle)
        centre = profile.reach(at.s, self.prime_radius, self.offset) - 1j * self.offset
        return trace_of_point(angle, at, (centre, at.ds, at.dds), 1.0, self.roller_radius)

    def pressure_angle(self, angle: FloatArray) -> FloatArray:
        """Pressure angle [rad] at cam angles [rad]."""
        at = self.programme.at(angle)
        return np.asarray(profile.pressure_angle(at.s, at.ds, self.prime_radius, self.offset))

    def curvature(self, angle: FloatArray) -> FloatArray:
        """Curvature of the pitch curve [1/m] at cam angles [rad], positive where convex."""
        at = self.programme.at(angle)
        return np.asarray(profile.curvature(at.s, at.ds, at.dds, self.prime_radius, self.offset))
