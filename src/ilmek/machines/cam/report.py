"""What a design of a cam says: results, checks, tables, figures, and its parts for workshop and controller."""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.pieces import Extremum, infimum, supremum
from ilmek.cams.programme import Jump, jumps
from ilmek.elements.materials import MATERIALS
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.figures import figures
from ilmek.machines.cam.parts import cam_table, plates
from ilmek.machines.cam.shape import size_without_undercut
from ilmek.machines.cam.tables import tables
from ilmek.machines.rounding import settled
from ilmek.report import Check, Json, Report, Result, at_least, at_most
from ilmek.units import format_quantity


def report(design: CamDesign) -> Report:
    """Everything that the design says."""
    return Report(
        machine="cam",
        title="Cam",
        parameters=design.params.as_dict(),
        results=(
            *_size_results(design),
            *_motion_results(design),
            *_force_results(design),
            *_part_results(design),
            *_at(design),
        ),
        checks=_checks(design),
        tables=tables(design),
        figures=figures(design),
        warnings=_warnings(design),
        plates=plates(design),
        cam_tables=(cam_table(design),),
    )


def pressure_angle_on(design: CamDesign, knots: FloatArray) -> Extremum:
    """Largest |pressure angle| [rad] over a part of the turn."""
    return supremum(lambda angle: np.abs(design.cam.trace(angle).pressure_angle), knots)


def _size_results(design: CamDesign) -> tuple[Result, ...]:
    cam, flat = design.cam, design.params.follower == "flat"
    on_rise, on_fall = (pressure_angle_on(design, knots) for knots in (design.rise_knots, design.fall_knots))
    convex, hollow = limits.convex_radius_min(cam), limits.concave_radius_min(cam)
    word = "base radius: least distance of the face from the axis" if flat else "prime radius of the pitch curve, Rp"
    curve = "surface" if flat else "pitch curve"
    return (
        Result("prime_radius", cam.prime_radius, "mm", word),
        Result("prime_radius_min", design.size.smallest.value, "mm", "smallest for the limit"),
        Result("pressure_angle_max", on_rise.value, "deg", "largest pressure angle on the rise"),
        Result("pressure_angle_at", on_rise.at, "deg", "cam angle of it"),
        Result("pressure_angle_fall_max", on_fall.value, "deg", "largest pressure angle on the fall"),
        Result("curvature_radius_min", convex.value, "mm", f"least radius of curvature of the {curve}, convex"),
        Result("curvature_at", convex.at, "deg", "cam angle of it"),
        Result("concave_radius_min", hollow.value if hollow else None, "mm", f"least radius of the {curve}, concave"),
        Result("undercut", design.undercut, "", "whether no surface can guide the follower"),
        Result("area", design.area, "cm^2", "area inside the surface, bore not taken off"),
        *((_face(design),) if flat else ()),
    )


def _face(design: CamDesign) -> Result:
    """Where the contact wanders along a flat face, from the follower's stem."""
    knots, offset = design.programme.knots, design.params.offset
    ds = lambda angle: design.programme.at(angle).ds - offset  # noqa: E731
    span: Json = [infimum(ds, knots).value, supremum(ds, knots).value]
    return Result("face_span", span, "mm", "from where to where the contact wanders along the face, from the stem")


def _motion_results(design: CamDesign) -> tuple[Result, ...]:
    params, programme, speed = design.params, design.programme, design.params.speed

    def peak(order: int) -> float:
        return supremum(lambda angle: np.abs(programme.at(angle)[order]), programme.knots).value * speed**order

    found: Json = [_jump_as_json(jump, speed) for order in (1, 2) for jump in jumps(programme, order)]
    return (
        Result("lift", params.lift, "mm", "lift of the follower"),
        Result("rise", params.rise, "deg", "cam angle of the rise"),
        Result("dwell", params.dwell, "deg", "cam angle for which it stays lifted"),
        Result("fall", params.fall_angle, "deg", "cam angle of the fall"),
        Result("velocity_max", peak(1), "m/s", "largest velocity"),
        Result("acceleration_max", peak(2), "m/s^2", "largest acceleration"),
        Result("jerk_max", peak(3), "m/s^3", "largest jerk between jumps of the acceleration"),
        Result("jumps", found, "", "where the velocity (order 1) or the acceleration (order 2) jumps", shown=False),
    )


def _jump_as_json(jump: Jump, speed: float) -> dict[str, Json]:
    rate = speed**jump.order
    sides: dict[str, Json] = {"before": jump.before * rate, "after": jump.after * rate}
    return {"angle": jump.angle, "order": jump.order, "place": jump.place, **sides}


def _force_results(design: CamDesign) -> tuple[Result, ...]:
    extremes, held, speed = design.extremes, design.held, design.params.speed
    torque = extremes.torque if extremes.torque.value >= -extremes.back_torque.value else extremes.back_torque
    least = infimum(lambda angle: design.state(angle).force, design.programme.knots)
    lift_off = design.lift_off.speed
    return (
        Result("torque_max", abs(torque.value), "N*m", "largest torque of the shaft, forwards or back"),
        Result("torque_at", torque.at, "deg", "cam angle of it"),
        Result("torque_range", [extremes.back_torque.value, extremes.torque.value], "N*m", "least and largest torque"),
        Result("torque_rms", extremes.torque_rms, "N*m", "root mean square of the torque over the turn"),
        Result("power_max", max(extremes.torque.value, 0.0) * speed, "W", "largest power of the shaft"),
        Result("contact_force_max", extremes.normal.value, "N", "largest force between cam and follower"),
        Result("contact_force_at", extremes.normal.at, "deg", "cam angle of it"),
        Result("hold_force_min", least.value, "N", "least force along the motion; below 0 the follower lifts off"),
        Result("spring_rate", held.rate, "N/mm", "rate of the return spring"),
        Result("preload", held.preload, "N", "force of the return spring at the lowest place"),
        Result("spring_force_max", held.preload + held.rate * design.params.lift, "N", "its force at the full lift"),
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
    value = None if pressure is None else pressure.value
    return (
        Result("hertz_pressure_max", value, "MPa", "largest Hertz pressure; none: a knife's edge has no such pressure"),
        Result("hertz_at", None if pressure is None else pressure.at, "deg", "cam angle of it"),
        Result("hertz_pressure_limit", design.pressure_limit, "MPa", "pressure that is allowed"),
    )


def _part_results(design: CamDesign) -> tuple[Result, ...]:
    hub, roller, duty = design.hub, design.roller, design.duty
    density = MATERIALS[design.params.material].density
    mass = max(design.area - hub.area, 0.0) * design.face_width * density
    life = duty.time(roller) if roller and duty else math.inf
    return (
        Result("roller", roller.name if roller else None, "", "cam follower from the table"),
        Result("roller_radius", design.cam.roller_radius, "mm", "radius of what touches the cam; 0 of knife and flat"),
        Result("roller_life", life if math.isfinite(life) else None, "h", "time that the roller lasts"),
        Result("roller_speed", duty.turns * duty.speed if duty else None, "rpm", "mean speed of the roller"),
        Result("face_width", design.face_width, "mm", "thickness of the cam"),
        Result("bore", hub.bore, "mm", "bore of the cam"),
        Result("keyway", {"width": hub.key_width, "depth": hub.key_depth}, "mm", "keyway in the cam"),
        Result("mass", mass, "kg", "mass of the cam, bored"),
    )


def _at(design: CamDesign) -> tuple[Result, ...]:
    """The follower at the cam angle asked for; where a derivative jumps, that of the part which begins."""
    if design.params.angle is None:
        return ()
    course, speed = design.programme.at(np.array(design.params.angle)), design.params.speed
    names = ("position", "velocity", "acceleration", "jerk")
    found: Json = {name: float(course[order]) * speed**order for order, name in enumerate(names)}
    return (Result("at", found, "", "the follower at the cam angle asked for, per time at the speed; SI"),)


def least_surface_radius(design: CamDesign) -> float:
    """Least distance of the surface from the axis [m]."""
    return infimum(lambda angle: np.abs(design.cam.trace(angle).surface), design.programme.knots).value


def _checks(design: CamDesign) -> tuple[Check, ...]:
    params, cam, extremes = design.params, design.cam, design.extremes
    speed, programme = params.speed, design.programme
    drops = [abs(jump.after - jump.before) * speed for jump in jumps(programme, 1)]
    bumps = [abs(jump.after - jump.before) * speed**2 for jump in jumps(programme, 2)]
    room = least_surface_radius(design) - design.hub.reach
    norton = "Norton, Cam Design and Manufacturing"
    checks = [
        at_least(
            "convex radius of curvature (no undercut)",
            limits.convex_radius_min(cam).value,
            cam.roller_radius,
            "mm",
            f"{norton}, 7: rho > roller radius",
        ),
        at_least("speed of lift-off", design.lift_off.speed, speed, "rpm", "m w^2 s'' + k s + P + load >= 0"),
        at_most("jump of the velocity", max(drops, default=0.0), 0.0, "m/s", "an endless force"),
        at_most("jump of the acceleration", max(bumps, default=0.0), params.jump_limit, "m/s^2", "jump_limit"),
        at_least("wall between keyway and surface", room, params.wall, "mm", "wall"),
    ]
    if params.limit is not None and params.follower != "flat":
        found = settled(pressure_angle_on(design, design.rise_knots).value, params.limit)
        checks.insert(0, at_most("pressure angle on the rise", found, params.limit, "deg", f"{norton}, 7.2"))
    if extremes.pressure is not None:
        source = "pressure_limit" if params.pressure_limit else "first yield below the surface, Johnson"
        checks.append(at_most("Hertz pressure", extremes.pressure.value, design.pressure_limit, "MPa", source))
    if design.roller is not None and design.duty is not None:
        checks += _roller_checks(design)
    return tuple(checks)


def _roller_checks(design: CamDesign) -> list[Check]:
    roller, duty = design.roller, design.duty
    if roller is None or duty is None:
        return []
    return [
        at_least("life of the roller", duty.time(roller), design.params.life, "h", "ISO 281, roller bearings"),
        at_most("force on the roller", duty.largest, roller.force_limit, "N", "largest force of the roller's table"),
    ]


def _warnings(design: CamDesign) -> tuple[str, ...]:
    params, cam, said = design.params, design.cam, []
    smallest, limit = design.size.smallest.value, params.limit
    if params.follower != "flat" and limit is not None and cam.prime_radius < smallest * (1 - 1e-9):
        shown, least = (format_quantity(value, "mm") for value in (cam.prime_radius, smallest))
        angle = format_quantity(limit, "deg")
        said.append(f"prime_radius={shown} is too small for a pressure angle of {angle}: the smallest is {least}")
    if design.undercut:
        said.append(_undercut_said(design))
    if jumps(design.programme, 1):
        said.append("the velocity jumps: the cam would need an endless force; take a law from rest to rest")
    if least_surface_radius(design) <= design.hub.reach:
        said.append(
            f"the bore of {format_quantity(design.hub.bore, 'mm')} does not fit into the cam, which is drawn without it"
        )
    if design.roller is None and params.follower == "roller" and params.roller_radius is None:
        said.append(
            f"no roller of the table fits this cam: reckoned with {format_quantity(cam.roller_radius, 'mm')} of radius"
        )
    if math.isnan(design.extremes.normal.value):
        said.append("the follower jams in its guide: lower the friction or the pressure angle")
    return tuple(said)


def _undercut_said(design: CamDesign) -> str:
    cam, params = design.cam, design.params
    convex = format_quantity(limits.convex_radius_min(cam).value, "mm")
    if params.follower == "flat":
        least = format_quantity(design.size.smallest.value, "mm")
        return f"a flat follower needs a cam that is convex all round: the smallest base radius is {least}"
    least_radius = size_without_undercut(params, design.programme, cam.roller_radius)
    mend = (
        f"set prime_radius={format_quantity(least_radius * (1 + 1e-4), 'mm').replace(' ', '')} or a smaller roller"
        if math.isfinite(least_radius)
        else "take a smaller roller"
    )
    return f"undercut: the pitch curve's radius is {convex}, not more than the roller's: {mend}"
