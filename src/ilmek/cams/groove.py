"""Groove: a roller between two flanks, which both are as far from the pitch curve as the roller is large.

A groove leads the roller out and back without a spring. Its inner flank is a plate's surface, its outer flank the same
on the other side: it is cut in a cusp where the pitch curve is hollow and its radius not above the roller's. A groove
that is wider than the roller by a clearance has that between the roller and its outer flank. It is cut by a cutter of
its own width along one path, or, along two, by any smaller one. For plates and, developed, for barrels.
"""

from dataclasses import dataclass

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.trace import CamRole
from ilmek.errors import ParameterError
from ilmek.units import format_quantity


@dataclass(frozen=True, slots=True)
class Groove:
    """The groove round a cam's pitch curve, wider than the roller by `clearance` [m].

    Raises ParameterError for a follower without a roller, or a clearance below 0.
    """

    cam: CamRole
    clearance: float = 0.0

    def __post_init__(self) -> None:
        if self.cam.flat or self.cam.roller_radius <= 0:
            raise ParameterError("a groove without a roller", allowed="a roller of a radius above 0")
        if self.clearance < 0:
            raise ParameterError(f"clearance={format_quantity(self.clearance, 'mm')}", allowed="0 mm or more")

    @property
    def width(self) -> float:
        """Width of the groove [m]."""
        return 2 * self.cam.roller_radius + self.clearance

    def flanks(self, angle: FloatArray) -> tuple[ComplexArray, ComplexArray]:
        """Inner and outer flank at cam angles [rad], in the cam's frame [m]."""
        trace, (inner, outer) = self.cam.trace(angle), self._distances
        return trace.parallel(inner), trace.parallel(outer)

    def flank_curvatures(self, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Curvature of inner and outer flank [1/m], positive where convex as seen from outside the cam."""
        trace, (inner, outer) = self.cam.trace(angle), self._distances
        return trace.curvature_at(inner), trace.curvature_at(outer)

    def cutter_paths(self, angle: FloatArray, radius: float) -> tuple[ComplexArray, ComplexArray]:
        """Centre of a cutter of a radius [m] along the inner and along the outer flank; one path where it fills both.

        Raises ParameterError for a cutter wider than the groove.
        """
        if not 0 < radius <= self.width / 2 * (1 + 1e-12):
            raise ParameterError(
                f"a cutter of {format_quantity(2 * radius, 'mm')} in a groove of {format_quantity(self.width, 'mm')}",
                allowed="a diameter above 0, at most the groove's width",
            )
        trace, (inner, outer) = self.cam.trace(angle), self._distances
        return trace.parallel(inner + radius), trace.parallel(outer - radius)

    @property
    def _distances(self) -> tuple[float, float]:
        """Signed distances of the flanks outside the pitch curve [m]."""
        return -self.cam.roller_radius, self.cam.roller_radius + self.clearance
