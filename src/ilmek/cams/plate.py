"""Plate cam with a translating roller, knife-edge or spherical follower.

The follower's line may be offset from the axis (formulas and frame: `profile`). In the plane of motion a spherical
follower moves and touches as a roller of its radius; only the Hertz contact is a point contact.
"""

import math
from typing import ClassVar

import numpy as np

from ilmek.arguments import Arguments, Quantities, Quantity
from ilmek.arrays import FloatArray
from ilmek.cams import profile
from ilmek.cams.follower_dynamics import Response, steady_response
from ilmek.cams.follower_model import FollowerModel
from ilmek.cams.limits import undercut
from ilmek.cams.programme import CamProgramme, FollowerMotion, turn_of
from ilmek.cams.trace import CamCurves, CamTrace, trace_of_point
from ilmek.errors import ParameterError
from ilmek.records import value_record
from ilmek.report.framed import Framed
from ilmek.units import format_quantity


@value_record
class PlateCam(CamCurves, Framed):
    """A plate cam with a translating roller or knife-edge follower; lengths in m, frame and signs as in `profile`.

    prime_radius   distance of the roller's centre from the axis where the displacement is 0
    offset         of the follower's line from the axis      roller_radius  0: knife edge
    Raises ParameterError where the follower's line misses the prime circle or the roller is as large as it.

    >>> from ilmek import cam_programme, dwell, fall, rise
    >>> cam = PlateCam(cam_programme(rise("90deg", 0.04), fall("90deg", 0.04), dwell("180deg")), 0.1)
    >>> complex(cam.surface(0.0)), float(cam.pressure_angle("180deg")), cam.undercut
    ((0.1+0j), 0.0, False)
    """

    programme: CamProgramme
    prime_radius: float
    offset: float = 0.0
    roller_radius: float = 0.0
    flat: ClassVar[bool] = False

    def __post_init__(self) -> None:
        given = Arguments("a plate cam")
        given.record("programme", self.programme, CamProgramme)
        for name in ("prime_radius", "offset", "roller_radius"):
            object.__setattr__(self, name, given.number(name, getattr(self, name), "m"))
        given.not_negative("roller_radius", self.roller_radius)
        least = self.prime_bounds[0]
        if self.prime_radius <= least:
            shown = format_quantity(self.prime_radius, "mm")
            raise ParameterError(f"prime_radius={shown} is too small", allowed=f"above {format_quantity(least, 'mm')}")

    @property
    def prime_bounds(self) -> tuple[float, float]:
        """Bounds of the prime radius [m], both excluded: larger than the offset and the roller all round.

        A law that overshoots below 0 raises the lower bound.
        """
        least = max(abs(self.offset), self.roller_radius)
        lowest = min(self.programme.bounds[0], 0.0)
        return max(least, math.hypot(math.sqrt(least**2 - self.offset**2) - lowest, self.offset)), math.inf

    def trace_of(self, angle: FloatArray, motion: FollowerMotion) -> CamTrace:
        """The trace at cam angles [rad], for the follower's motion there."""
        centre = profile.reach(motion.s, self.prime_radius, self.offset) - 1j * self.offset
        return trace_of_point(angle, motion, (centre, motion.ds, motion.dds), 1.0, self.roller_radius)

    def pressure_angle(self, angle: Quantities) -> FloatArray:
        """Pressure angle [rad] at cam angles [rad]."""
        at = self.programme.at(angle)
        return np.asarray(profile.pressure_angle(at.s, at.ds, self.prime_radius, self.offset))

    def curvature(self, angle: Quantities) -> FloatArray:
        """Curvature of the pitch curve [1/m] at cam angles [rad], positive where convex."""
        at = self.programme.at(angle)
        return np.asarray(profile.curvature(at.s, at.ds, at.dds, self.prime_radius, self.offset))

    @property
    def undercut(self) -> bool:
        """Whether the roller cuts away surface that an earlier or later pose needs."""
        return undercut(self)

    def response(self, follower: FollowerModel, speed: Quantity) -> Response:
        """Periodic response of a follower over a turn at a speed of the cam [rad/s]; see `steady_response`."""
        given = Arguments("a cam's response")
        model = given.record("follower", follower, FollowerModel)
        return steady_response(model, self.programme, given.number("speed", speed, "rad/s"))

    def table(self) -> dict[str, FloatArray]:
        """Columns over a turn, the programme's knots among them: surface, pitch curve, pressure angle, curvature."""
        angle = turn_of(self.programme)
        curves = {"surface": self.surface(angle), "pitch": self.pitch(angle)}
        points = {f"{name} {axis} [m]": part(curve) for name, curve in curves.items() for axis, part in _AXES}
        others = {"pressure angle [rad]": self.pressure_angle(angle), "pitch curvature [1/m]": self.curvature(angle)}
        return {"cam angle [rad]": angle, **points, **others}


_AXES = (("x", np.real), ("y", np.imag))
