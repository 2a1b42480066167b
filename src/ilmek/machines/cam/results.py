"""The numbers that a design of a cam answers with, by the names of the JSON."""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import flat, limits, oscillating_flat
from ilmek.cams.flat import FlatCam
from ilmek.cams.oscillating_flat import OscillatingFlatCam
from ilmek.cams.programme import Jump, jumps
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.hub import Hub
from ilmek.machines.cam.parts import area_of, mass_of
from ilmek.num.piecewise import EQUAL, Extremum, infimum, supremum
from ilmek.report import Json, Result

_PRIME = "prime radius of the pitch curve, Rp"
_SIZES = {
    **dict.fromkeys(("plate", "grooved", "conjugate"), _PRIME),
    **dict.fromkeys(("barrel", "face"), "mean radius, of the middle of the roller"),
    "wedge": "travel of the wedge for a radian of the programme",
}


def results(design: CamDesign) -> tuple[Result, ...]:
    """Size, motion, forces, parts, and the follower at the cam angle asked for."""
    return (
        *_size_results(design),
        *_motion_results(design),
        *_force_results(design),
        *_part_results(design),
        *_at(design),
    )


def pressure_angle_on(design: CamDesign, knots: FloatArray) -> Extremum:
    """Largest |pressure angle| [rad] over a part of the turn."""
    return supremum(lambda angle: np.abs(design.cam.trace(angle).pressure_angle), knots)


def _size_results(design: CamDesign) -> tuple[Result, ...]:
    cam, face = design.cam, design.params.follower == "flat"
    on_rise = pressure_angle_on(design, design.rise_knots)
    on_fall = None if design.params.kind == "wedge" else pressure_angle_on(design, design.fall_knots).value
    convex, hollow = limits.convex_radius_min(cam), limits.concave_radius_min(cam)
    word = "base radius: least distance of the face from the axis" if face else _SIZES[design.params.kind]
    curve = "surface" if face else "pitch curve"
    return (
        Result("prime_radius", cam.prime_radius, "mm", word),
        Result("prime_radius_min", design.size.smallest.value, "mm", "smallest for the limit"),
        Result("pressure_angle_max", on_rise.value, "deg", "largest pressure angle on the rise"),
        Result("pressure_angle_at", on_rise.at, "deg", "cam angle of it"),
        Result("pressure_angle_fall_max", on_fall, "deg", "largest pressure angle on the fall"),
        Result("curvature_radius_min", convex.value, "mm", f"least radius of curvature of the {curve}, convex"),
        Result("curvature_at", convex.at, "deg", "cam angle of it"),
        Result("concave_radius_min", hollow.value if hollow else None, "mm", f"least radius of the {curve}, concave"),
        Result("undercut", design.undercut, "", "whether no surface can guide the follower"),
        Result(
            "area",
            _finite(area_of(design)),
            "cm^2",
            "area of the face, bore not taken off; none: of no one face, or undercut through and through",
        ),
        *((_face(design),) if face else ()),
        *_other(design),
    )


def _other(design: CamDesign) -> tuple[Result, ...]:
    """The second of two conjugate cams; the groove."""
    if design.params.kind == "wedge":
        travel = design.cam.prime_radius * float(design.cam.knots[-1])
        return (Result("travel", travel, "mm", "travel of the wedge"),)
    if design.params.kind in ("grooved", "barrel"):
        return (Result("groove_width", 2 * design.cam.roller_radius, "mm", "width of the groove"),)
    if design.cams.pair is None:
        return ()
    cam = design.cams.pair.second
    other: Json = {
        "prime_radius": cam.prime_radius,
        "pressure_angle_max": limits.pressure_angle_max(cam).value,
        "curvature_radius_min": limits.convex_radius_min(cam).value,
        "undercut": limits.undercut(cam),
        "area": limits.area(cam),
    }
    return (Result("second", other, "", "the second cam, which brings the follower back; SI", shown=False),)


def _face(design: CamDesign) -> Result:
    """Where the contact wanders along a flat face: from the stem of a slide, from the pivot of an arm."""
    cam = design.cam
    if isinstance(cam, OscillatingFlatCam):
        span: Json = list(oscillating_flat.face_span(cam))
    elif isinstance(cam, FlatCam):
        span = list(flat.face_span(cam))
    meaning = "from where to where the contact wanders along the face, from its stem or pivot"
    return Result("face_span", span, "mm", meaning)


def _motion_results(design: CamDesign) -> tuple[Result, ...]:
    params, programme, speed = design.params, design.programme, design.params.speed
    length = "rad" if params.motion == "oscillating" else "m"

    def peak(order: int) -> float:
        return supremum(lambda angle: np.abs(programme.at(angle)[order]), programme.knots).value * speed**order

    found: Json = [_jump_as_json(jump, speed) for order in (1, 2) for jump in jumps(programme, order)]
    return (
        Result("lift", params.lift, "mm", "lift of the follower; of an arm along its arc"),
        *((Result("swing", params.lift / params.per_unit, "deg", "swing of the arm"),) if length == "rad" else ()),
        Result("rise", params.rise, "deg", "cam angle of the rise"),
        Result("dwell", params.dwell, "deg", "cam angle for which it stays lifted"),
        Result("fall", params.fall_angle, "deg", "cam angle of the fall"),
        Result("velocity_max", peak(1), f"{length}/s", "largest velocity"),
        Result("acceleration_max", peak(2), f"{length}/s^2", "largest acceleration"),
        Result("jerk_max", peak(3), f"{length}/s^3", "largest jerk between jumps of the acceleration"),
        Result("jumps", found, "", "where the velocity (order 1) or the acceleration (order 2) jumps", shown=False),
    )


def _jump_as_json(jump: Jump, speed: float) -> dict[str, Json]:
    rate = speed**jump.order
    sides: dict[str, Json] = {"before": jump.before * rate, "after": jump.after * rate}
    return {"angle": jump.angle, "order": jump.order, "place": jump.place, **sides}


def _force_results(design: CamDesign) -> tuple[Result, ...]:
    extremes, held, speed = design.extremes, design.held, design.params.speed
    forwards = extremes.torque.value >= -extremes.back_torque.value * (1 - EQUAL)  # equal but for rounding: the first
    torque = extremes.torque if forwards else extremes.back_torque
    least = infimum(lambda angle: design.state(angle).force, design.cam.knots)
    lift_off, arc = design.lift_off.speed, design.params.per_unit
    preload, rate = held.preload / arc, held.rate / arc**2
    return (
        Result("torque_max", abs(torque.value), "N*m", "largest torque of the shaft, forwards or back"),
        Result("torque_at", torque.at, "deg", "cam angle of it"),
        Result("torque_range", [extremes.back_torque.value, extremes.torque.value], "N*m", "least and largest torque"),
        Result("torque_rms", extremes.torque_rms, "N*m", "root mean square of the torque over the turn"),
        Result("power_max", max(extremes.torque.value, 0.0) * speed, "W", "largest power of the shaft"),
        Result("contact_force_max", extremes.normal.value, "N", "largest force between cam and follower"),
        Result("contact_force_at", extremes.normal.at, "deg", "cam angle of it"),
        Result("hold_force_min", least.value / arc, "N", "least force along the motion; below 0 it lifts off"),
        Result("spring_rate", rate, "N/mm", "rate of the return spring"),
        Result("preload", preload, "N", "force of the return spring at the lowest place"),
        Result("spring_force_max", preload + rate * design.params.lift, "N", "its force at the full lift"),
        Result(
            "lift_off_speed",
            lift_off if math.isfinite(lift_off) else None,
            "rpm",
            "speed of the cam from which the follower lifts off; none: it never does",
        ),
        *_hertz_results(design),
    )


def _hertz_results(design: CamDesign) -> tuple[Result, ...]:
    pressure = design.extremes.pressure
    value = None if pressure is None else _finite(pressure.value)
    return (
        Result(
            "hertz_pressure_max",
            value,
            "MPa",
            "largest Hertz pressure; none of a knife's edge, or where undercut leaves no face",
        ),
        Result("hertz_at", None if pressure is None or value is None else pressure.at, "deg", "cam angle of it"),
        Result("hertz_pressure_limit", design.pressure_limit, "MPa", "pressure that is allowed"),
    )


def _part_results(design: CamDesign) -> tuple[Result, ...]:
    hub, roller, duty = design.hub, design.roller, design.duty
    life = duty.time(roller) if roller and duty else math.inf
    return (
        Result("roller", roller.name if roller else None, "", "cam follower from the table"),
        Result("roller_radius", design.cam.roller_radius, "mm", "radius of what touches the cam; 0 of knife and flat"),
        Result("roller_life", life if math.isfinite(life) else None, "h", "time that the roller lasts"),
        Result("roller_speed", duty.turns * duty.speed if duty else None, "rpm", "mean speed of the roller"),
        Result("face_width", design.face_width, "mm", "thickness of the cam"),
        *(() if design.params.kind == "wedge" else _hub_results(hub)),
        Result("mass", _finite(mass_of(design)), "kg", "mass of the cam, bored; of both where there are two"),
    )


def _hub_results(hub: Hub) -> tuple[Result, ...]:
    return (
        Result("bore", hub.bore, "mm", "bore of the cam"),
        Result("keyway", {"width": hub.key_width, "depth": hub.key_depth}, "mm", "keyway in the cam"),
    )


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _at(design: CamDesign) -> tuple[Result, ...]:
    """The follower at the cam angle asked for; where a derivative jumps, that of the part which begins."""
    if design.params.angle is None:
        return ()
    course, speed = design.programme.at(np.array(design.params.angle)), design.params.speed
    names = ("position", "velocity", "acceleration", "jerk")
    found: Json = {name: float(course[order]) * speed**order for order, name in enumerate(names)}
    return (Result("at", found, "", "the follower at the cam angle asked for, per time at the speed; SI"),)
