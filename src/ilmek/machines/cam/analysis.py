"""What only the report of a cam needs: extremes over the turn, area and mass, the follower's vibration."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import flat, limits, oscillating_flat
from ilmek.cams.flat import FlatCam
from ilmek.cams.oscillating_flat import OscillatingFlatCam
from ilmek.cams.programme import Jump, jumps
from ilmek.machines.cam.compliant_follower import CompliantFollower, compliant_follower
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.parts import area_of
from ilmek.machines.cam.tree import mass_of
from ilmek.num.piecewise import Extremum, infimum, supremum
from ilmek.records import computed, group, record, result
from ilmek.report import Json


@record
class SlidePeaks:
    """Greatest values of the motion of a follower on a slide."""

    velocity_max: float = result("m/s", "largest velocity")
    acceleration_max: float = result("m/s^2", "largest acceleration")
    jerk_max: float = result("m/s^3", "largest jerk between jumps of the acceleration")


@record
class ArmPeaks:
    """Swing of an arm, and greatest values of its motion."""

    swing: float = result("deg", "swing of the arm")
    velocity_max: float = result("rad/s", "largest angular velocity of the arm")
    acceleration_max: float = result("rad/s^2", "largest angular acceleration of the arm")
    jerk_max: float = result("rad/s^3", "largest angular jerk between jumps of the acceleration")


@record
class CamAnalysis:
    """A design with its extremes.

    on_rise    largest pressure angle on the rise       least      least force on the follower along its motion
    compliant  the follower on its linkage; None where that is rigid
    """

    design: CamDesign
    on_rise: Extremum
    motion: SlidePeaks | ArmPeaks = group()
    least: Extremum
    compliant: CompliantFollower | None

    pressure_angle_max = computed("deg", "largest pressure angle on the rise", lambda it: it.on_rise.value)
    pressure_angle_at = computed("deg", "cam angle of the same", lambda it: it.on_rise.at)

    @computed("deg", "largest pressure angle on the fall", absent="a wedge")
    def pressure_angle_fall_max(self) -> float | None:
        design = self.design
        return None if design.params.kind == "wedge" else pressure_angle_on(design, design.fall_knots).value

    area = computed(
        "cm^2", "area of the face, bore included", lambda it: area_of(it.design), absent="there is not one face"
    )

    @computed("kg", "mass of the cam, bored; of both where there are two", absent="undercut leaves no face")
    def mass(self) -> float | None:
        return mass_of(self.design)

    @computed("mm", "range of the contact along a flat face, from its stem or pivot", optional=True)
    def face_span(self) -> Json:
        cam = self.design.cam
        if isinstance(cam, OscillatingFlatCam):
            return list(oscillating_flat.face_span(cam))
        return list(flat.face_span(cam)) if isinstance(cam, FlatCam) else None

    @computed("mm", "travel of a wedge", optional=True)
    def travel(self) -> float | None:
        cam = self.design.cam
        return cam.prime_radius * float(cam.knots[-1]) if self.design.params.kind == "wedge" else None

    @computed("mm", "width of the groove", optional=True)
    def groove_width(self) -> float | None:
        return 2 * self.design.cam.roller_radius if self.design.params.kind in ("grooved", "barrel") else None

    @computed("", "the second conjugate cam, which returns the follower; SI", shown=False, optional=True)
    def second(self) -> Json:
        if self.design.cams.pair is None:
            return None
        cam = self.design.cams.pair.second
        return {
            "prime_radius": cam.prime_radius,
            "pressure_angle_max": limits.pressure_angle_max(cam).value,
            "curvature_radius_min": limits.convex_radius_min(cam).value,
            "undercut": limits.undercut(cam),
            "area": limits.area(cam),
        }

    @computed("N", "least force along the motion; below 0 the follower lifts off")
    def hold_force_min(self) -> float:
        return self.least.value / self.design.params.per_unit

    @computed("", "jumps of the velocity (order 1) and of the acceleration (order 2)", shown=False)
    def jumps(self) -> Json:
        programme, speed = self.design.programme, self.design.params.speed
        return [_jump_as_json(jump, speed) for order in (1, 2) for jump in jumps(programme, order)]

    @computed("", "the follower at the parameter `angle`, derivatives after a jump; SI, by time", optional=True)
    def at(self) -> Json:
        if self.design.params.angle is None:
            return None
        motion, speed = self.design.programme.at(np.array(self.design.params.angle)), self.design.params.speed
        names = ("position", "velocity", "acceleration", "jerk")
        return {name: float(motion[order]) * speed**order for order, name in enumerate(names)}


def analyse(design: CamDesign) -> CamAnalysis:
    """The analysis of a design. Raises ParameterError for a follower on a linkage without mass or speed."""
    rise, least = (
        pressure_angle_on(design, design.rise_knots),
        infimum(lambda q: design.state(q).force, design.cam.knots),
    )
    return CamAnalysis(design, rise, _motion(design), least, compliant_follower(design))


def results(analysis: CamAnalysis) -> tuple[object, ...]:
    """The records whose results are reported: size and parts, motion, forces, vibration."""
    return analysis.design, analysis, analysis.design.extremes, analysis.compliant


def pressure_angle_on(design: CamDesign, knots: FloatArray) -> Extremum:
    """Largest |pressure angle| [rad] over a part of the turn."""
    return supremum(lambda angle: np.abs(design.cam.trace(angle).pressure_angle), knots)


def _motion(design: CamDesign) -> SlidePeaks | ArmPeaks:
    params, programme = design.params, design.programme

    def peak(order: int) -> float:
        found = supremum(lambda angle: np.abs(programme.at(angle)[order]), programme.knots)
        return found.value * params.speed**order

    velocity, acceleration, jerk = peak(1), peak(2), peak(3)
    if params.motion == "oscillating":
        return ArmPeaks(params.lift / params.per_unit, velocity, acceleration, jerk)
    return SlidePeaks(velocity, acceleration, jerk)


def _jump_as_json(jump: Jump, speed: float) -> dict[str, Json]:
    rate = speed**jump.order
    sides: dict[str, Json] = {"before": jump.before * rate, "after": jump.after * rate}
    return {"angle": jump.angle, "order": jump.order, "place": jump.where, **sides}
