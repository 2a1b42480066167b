"""Groove: a roller between two flanks, both one roller radius from the pitch curve.

A groove guides the roller out and back without a spring. The inner flank is the surface of a plate cam, the outer flank
is the parallel curve on the other side. The outer flank is undercut where the pitch curve is concave and its radius of
curvature is not above the roller's. The clearance lies between the roller and the outer flank. A cutter of the groove's
width cuts it along one path, a smaller cutter along two. Valid for plates and for developed barrels.
"""

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.trace import CamRole
from ilmek.errors import ParameterError
from ilmek.records import value_record
from ilmek.units import format_quantity


@value_record
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
        """Paths of the centre of a cutter of a radius [m] along the inner and the outer flank, at cam angles [rad] [m].

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
