"""What a design of a cam says: results, checks, tables, figures, and its parts for workshop and controller."""

import math

import numpy as np

from ilmek.cams import limits
from ilmek.cams.programme import jumps
from ilmek.machines.cam.compliant_follower import (
    springy,
    springy_checks,
    springy_figures,
    springy_results,
    springy_table,
)
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.figures import figures
from ilmek.machines.cam.parts import cam_table, plates
from ilmek.machines.cam.results import pressure_angle_on, results
from ilmek.machines.cam.shape import size_without_undercut
from ilmek.machines.cam.tables import tables
from ilmek.num.piecewise import infimum
from ilmek.report import Check, Report, at_least, at_most, snap_to_limit
from ilmek.units import format_quantity


def report(design: CamDesign) -> Report:
    """Everything that the design says."""
    gives = springy(design)
    return Report(
        machine="cam",
        title="Cam",
        parameters=design.params.as_dict(),
        results=(*results(design), *(springy_results(gives) if gives else ())),
        checks=(*_checks(design), *(springy_checks(gives) if gives else ())),
        tables=(*tables(design), *((springy_table(gives),) if gives else ())),
        figures=(*figures(design), *(springy_figures(gives) if gives else ())),
        warnings=_warnings(design),
        plates=plates(design),
        cam_tables=(cam_table(design),),
    )


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


def _checks(design: CamDesign) -> tuple[Check, ...]:
    params, cam, extremes = design.params, design.cam, design.extremes
    speed, programme = params.speed, design.programme
    arc = params.per_unit
    drops = [abs(jump.after - jump.before) * arc * speed for jump in jumps(programme, 1)]
    bumps = [abs(jump.after - jump.before) * arc * speed**2 for jump in jumps(programme, 2)]
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
        at_most("jump of the velocity", max(drops, default=0.0), 0.0, "m/s", "an endless force"),
        at_most("jump of the acceleration", max(bumps, default=0.0), params.jump_limit, "m/s^2", "jump_limit"),
        *((at_least("wall between keyway and surface", room, params.wall, "mm", "wall"),) if room < math.inf else ()),
    ]
    if not params.led:
        source = "m w^2 s'' + k s + P + load >= 0"
        checks.insert(1, at_least("speed of lift-off", design.lift_off.speed, speed, "rpm", source))
    hollow = limits.concave_radius_min(cam)
    if params.kind in ("grooved", "barrel") and hollow is not None:
        source = f"{norton}, 7: the outer flank"
        checks.insert(1, at_least("concave radius of the pitch curve", hollow.value, cam.roller_radius, "mm", source))
    if params.limit is not None and params.led and not cam.flat:
        found = snap_to_limit(pressure_angle_on(design, design.fall_knots).value, params.limit)
        checks.insert(0, at_most("pressure angle on the fall", found, params.limit, "deg", f"{norton}, 7.2"))
    if params.limit is not None and not (params.follower == "flat" and params.motion == "translating"):
        found = snap_to_limit(pressure_angle_on(design, design.rise_knots).value, params.limit)
        checks.insert(0, at_most("pressure angle on the rise", found, params.limit, "deg", f"{norton}, 7.2"))
    if extremes.pressure is not None and not math.isnan(extremes.pressure.value):
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
    largest = largest_cutter(design)
    if params.cutter_radius is not None and params.cutter_radius > largest * (1 + 1e-9):
        shown, most = (format_quantity(value, "mm") for value in (params.cutter_radius, largest))
        said.append(f"cutter_radius={shown} does not get into every hollow of the cam: at most {most}")
    if design.roller is None and params.follower == "roller" and params.roller_radius is None:
        said.append(
            f"no roller of the table fits this cam: reckoned with {format_quantity(cam.roller_radius, 'mm')} of radius"
        )
    if math.isnan(design.extremes.normal.value):
        said.append("the follower jams in its guide: lower the friction or the pressure angle")
    return tuple(said)


def _undercut_said(design: CamDesign) -> str:
    cam, params = design.cam, design.params
    if design.cornered:
        return f"undercut: where the velocity jumps the cam has a corner, which a {params.follower} cannot follow"
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
