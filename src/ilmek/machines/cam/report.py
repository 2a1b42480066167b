"""The report of a cam: checks, warnings, tables."""

import math
from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams import limits
from ilmek.cams.contact import FollowerLoad
from ilmek.cams.laws import LAWS
from ilmek.cams.programme import CamProgramme, jumps
from ilmek.elements.cam_rollers import ROLLERS, RollerDuty
from ilmek.errors import ParameterError
from ilmek.machines.cam.analysis import CamAnalysis
from ilmek.machines.cam.compliant_follower import vibration_checks, vibration_table
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.shape import programme_of, size_without_undercut, smallest_of
from ilmek.num.piecewise import infimum, supremum
from ilmek.report import Check, Table, at_least, at_most, columns, must
from ilmek.units import deg, format_quantity

NORTON = "Norton, Cam Design and Manufacturing"


def checks(analysis: CamAnalysis) -> tuple[Check, ...]:
    """Pressure angle, curvature, lift-off, jumps, wall, Hertz pressure, roller, and the follower on its linkage."""
    return (
        *_pressure_angle_checks(analysis),
        *_shape_checks(analysis.design),
        *_load_checks(analysis.design),
        *(vibration_checks(analysis.compliant) if analysis.compliant else ()),
    )


def _pressure_angle_checks(analysis: CamAnalysis) -> tuple[Check, ...]:
    """Both flanks; the stem of a flat face on a slide has no pressure angle."""
    params, fall = analysis.design.params, analysis.pressure_angle_fall_max
    if params.follower == "flat" and params.motion == "translating":
        return ()
    longer, norton = "set a larger prime_radius, or a longer", f"{NORTON}, 7.2"
    greatest = analysis.pressure_angle_max
    rise = at_most("pressure angle on the rise", greatest, params.limit, "deg", norton).with_cure(f"{longer} rise")
    if fall is None:
        return (rise,)
    source = norton if params.led else "a spring drives the fall; assumed by this project"
    return rise, at_most("pressure angle on the fall", fall, params.fall_limit, "deg", source).with_cure(
        f"{longer} fall"
    )


def _shape_checks(design: CamDesign) -> tuple[Check, ...]:
    params, radius, programme = design.params, design.cam.roller_radius, design.programme
    hollow, convex = design.concave_radius_min, design.curvature_radius_min
    shape_checks = []
    if convex is not None:
        source = f"{NORTON}, 7: rho > roller radius"
        shape_checks.append(at_least("convex radius of curvature (no undercut)", convex, radius, "mm", source))
    if params.kind in ("grooved", "barrel") and hollow is not None:
        shape_checks.append(
            at_least("concave radius of the pitch curve", hollow, radius, "mm", f"{NORTON}, 7: outer flank")
        )
    if not params.led and math.isfinite(design.lift_off.speed):
        source = "m w^2 s'' + k s + P + load >= 0"
        shape_checks.append(at_least("speed of lift-off", design.lift_off.speed, params.speed, "rpm", source))
    drop, bump = (
        max((abs(jump.after - jump.before) * params.per_unit * params.speed**order for jump in found), default=0.0)
        for order, found in ((order, jumps(programme, order)) for order in (1, 2))
    )
    shape_checks.append(at_most("jump of the velocity", drop, 0.0, "m/s", "an infinite force"))
    shape_checks.append(at_most("jump of the acceleration", bump, params.jump_limit, "m/s^2", "jump_limit"))
    room = least_surface_radius(design) - design.hub.reach
    if room < math.inf:
        shape_checks.append(at_least("wall between keyway and surface", room, params.wall, "mm", "wall"))
    largest = largest_cutter(design)
    if params.cutter_radius is not None and largest < math.inf:
        source, cure = "least hollow of the cam, or its groove", "leave cutter_radius out, or set a smaller one"
        shape_checks.append(
            at_most("radius of the cutter", params.cutter_radius, largest, "mm", source).with_cure(cure)
        )
    if params.follower == "roller" and params.roller_radius is None:
        cure = "set a larger prime_radius, or a roller_radius of your own"
        shape_checks.append(
            must("a roller of the table fits the cam", design.roller is not None, "roller table").with_cure(cure)
        )
    return tuple(shape_checks)


def _load_checks(design: CamDesign) -> tuple[Check, ...]:
    params, roller, duty, pressure, load_checks = (
        design.params,
        design.roller,
        design.duty,
        design.extremes.pressure,
        [],
    )
    if design.extremes.jammed:
        along = infimum(lambda angle: design.state(angle).along, design.cam.knots).value
        source = "0 and below it jams: friction is greater than the force along the motion"
        share = "the follower does not jam: share of the contact force along its motion"
        return (Check(share, along, 0.0, "1", False, source, ">"),)
    if pressure is not None and not math.isnan(pressure.value):
        source = "pressure_limit" if params.pressure_limit else "first yield below the surface, Johnson"
        load_checks.append(at_most("Hertz pressure", pressure.value, design.pressure_limit, "MPa", source))
    if roller is not None and duty is not None:
        life, most = duty.time(roller), roller.force_limit
        if math.isfinite(life):
            load_checks.append(at_least("life of the roller", life, params.life, "h", "ISO 281, roller bearings"))
        load_checks.append(
            at_most("force on the roller", duty.largest, most, "N", "largest force of the roller's table")
        )
    return tuple(load_checks)


def largest_cutter(design: CamDesign) -> float:
    """The largest radius [m] of a cutter for the cam, or for both; a groove's is its roller's."""
    if design.params.kind in ("grooved", "barrel"):
        return design.cam.roller_radius
    pair = design.cams.pair
    return min(limits.largest_cutter(cam) for cam in ((pair.first, pair.second) if pair else (design.cam,)))


def least_surface_radius(design: CamDesign) -> float:
    """Least distance of the surface from the axis [m]."""
    if design.params.laid_flat:
        wedge = design.params.kind == "wedge"
        return math.inf if wedge else design.cam.prime_radius - design.face_width / 2
    return infimum(lambda angle: np.abs(design.cam.trace(angle).surface), design.cam.knots).value


def warnings(analysis: CamAnalysis) -> tuple[str, ...]:
    """Reasons why the cam cannot be made or run as it is, and remedies."""
    design = analysis.design
    params, cam, warnings = design.params, design.cam, []
    smallest, limit = design.size.smallest.value, params.limit
    if params.follower != "flat" and params.pressure_angle_limit and cam.prime_radius < smallest * (1 - 1e-9):
        shown, least = (format_quantity(value, "mm") for value in (cam.prime_radius, smallest))
        angle = format_quantity(limit, "deg")
        warnings.append(f"prime_radius={shown} is too small for a pressure angle of {angle}: the smallest is {least}")
    if design.undercut:
        warnings.append(_undercut_warning(design))
    if jumps(design.programme, 1):
        warnings.append("the velocity jumps: the cam would need an infinite force; take a law from rest to rest")
    if least_surface_radius(design) <= design.hub.reach:
        bore = format_quantity(design.hub.bore, "mm")
        warnings.append(f"the bore of {bore} does not fit into the cam, which is drawn without it")
    if design.roller is None and params.follower == "roller" and params.roller_radius is None:
        radius = format_quantity(cam.roller_radius, "mm")
        warnings.append(f"no roller of the table fits this cam: computed with a radius of {radius}")
    if design.extremes.jammed:
        warnings.append("the follower jams in its guide: lower the friction or the pressure angle")
    return tuple(warnings)


def _undercut_warning(design: CamDesign) -> str:
    cam, params = design.cam, design.params
    if design.cornered:
        return f"undercut: where the velocity jumps the cam has a corner, which a {params.follower} cannot follow"
    if params.follower == "flat":
        least = format_quantity(design.size.smallest.value, "mm")
        return f"a flat follower needs a cam that is convex all round: the smallest base radius is {least}"
    convex = format_quantity(limits.convex_radius_min(cam).value, "mm")
    least_radius = size_without_undercut(params, design.programme, cam.roller_radius)
    remedy = "take a smaller roller"
    if math.isfinite(least_radius):
        shown = format_quantity(least_radius * (1 + 1e-4), "mm").replace(" ", "")
        remedy = f"set prime_radius={shown} or a smaller roller"
    return f"undercut: the pitch curve's radius is {convex}, not more than the roller's: {remedy}"


def tables(analysis: CamAnalysis) -> tuple[Table, ...]:
    """Laws, rollers where there is one, points of the cam, vibration where the follower is compliant."""
    design = analysis.design
    rollers = (_roller_table(design, design.duty),) if design.duty and design.roller else ()
    vibration = (vibration_table(analysis.compliant),) if analysis.compliant else ()
    return (_law_table(design), *rollers, _point_table(design), *vibration)


def _law_table(design: CamDesign) -> Table:
    """Each law for rise and fall, at the same lift, angles, load and limit."""
    heads = columns(
        "law | smallest prime radius [mm] | velocity [m/s] | acceleration [m/s^2] | jerk [m/s^3] | torque [N*m]",
        "acceleration jumps",
    )
    rows = tuple(_law_row(design, name) for name in LAWS)
    return Table("cam-laws", "Motion laws compared at equal lift, angles, load and limit", heads, rows)


def _law_row(design: CamDesign, name: str) -> tuple[float | int | str, ...]:
    """A law's row; the spring stays the same, the torque is that of load, spring and mass without friction."""
    params, speed = design.params, design.params.speed
    law = params.laws()[0] if name == params.law else LAWS[name]
    programme = programme_of(params, (law, law))
    rate = speed / min(params.rise, params.fall_angle)
    peaks = (law.velocity_peak * rate, law.acceleration_peak * rate**2, law.jerk_peak * rate**3)
    try:
        size = smallest_of(params, programme).value
    except ParameterError:
        size = math.nan
    return (
        name,
        size,
        *(params.lift * peak for peak in peaks),
        _torque(programme, design.follower_load),
        len(jumps(programme)),
    )


def _torque(programme: CamProgramme, follower_load: FollowerLoad) -> float:
    def torque(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        return np.asarray(np.abs(follower_load.force(at.s, at.dds) * at.ds))

    return supremum(torque, programme.knots).value


def _roller_table(design: CamDesign, duty: RollerDuty) -> Table:
    """Life of each roller of the table under the force on this cam."""
    heads = columns("roller", "diameter [mm]", "width [mm]", "C [N]", "largest force [N]", "life [h]", "chosen")
    rows = []
    for roller in ROLLERS.values():
        turns = (duty.turns + 1) * design.cam.roller_radius / roller.radius - 1
        life = replace(duty, turns=turns).time(roller) if turns > 0 else math.inf
        chosen = "yes" if roller is design.roller else ""
        rows.append((roller.name, roller.diameter, roller.width, roller.dynamic, roller.force_limit, life, chosen))
    return Table("cam-rollers", "Rollers under the force on this cam", heads, tuple(rows))


def _point_table(design: CamDesign) -> Table:
    """The cam in steps of 5 degrees, to be drawn or checked."""
    angle = np.arange(0, 360, 5) * deg
    state = design.state(angle)
    trace, lift = state.trace, state.trace.motion.s * design.params.per_unit
    shape = (angle, lift, trace.surface.real, trace.surface.imag, trace.pressure_angle, trace.curvature)
    heads = columns(
        "cam angle [deg] | lift [mm] | x [mm] | y [mm] | pressure angle [deg] | curvature [1/m]",
        "contact force [N] | torque [N*m]",
    )
    rows = np.stack([*shape, state.normal, state.torque], axis=1).tolist()
    return Table("cam-points", "The cam in steps of 5°", heads, tuple(map(tuple, rows)))
