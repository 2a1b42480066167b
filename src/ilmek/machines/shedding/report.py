"""What a design of shedding cams says: results, checks against the thesis' limits, tables and figures."""

import math
from collections.abc import Callable

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.limits import area, concave_radius_min, convex_radius_min, pressure_angle_max
from ilmek.cams.programme import TURN, jumps
from ilmek.elements.motors import MOTORS
from ilmek.elements.shafts import STOCK_SIDES
from ilmek.machines.shedding.alternatives import SheddingAlternatives, study
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.machines.shedding.figures import figures
from ilmek.machines.shedding.parts import cam_tables, plates
from ilmek.machines.shedding.phases import window_asked
from ilmek.machines.shedding.tables import cycle_phases, tables
from ilmek.machines.shedding.warp import lifting_work
from ilmek.machines.shedding.warp_report import warp_checks, warp_results, warp_warnings
from ilmek.num.piecewise import supremum
from ilmek.report import Check, Json, Report, Result, at_least, at_most, snap_to_limit
from ilmek.units import format_quantity, mm, rpm

THESIS = "thesis, 3.2"
FOIL = 0.4 * mm
"""Thickness below which no sheet of a hand's radius stands upright [m]; a judgement of ours."""

SPEED_LIMIT = 5 * rpm
"""What the thesis allows the cam shaft, so that no warp breaks."""


def report(design: SheddingDesign) -> Report:
    """Everything that the design says."""
    studied = study(design)
    return Report(
        machine="shedding",
        title="Shedding cams",
        parameters=design.params.as_dict(),
        results=(
            *_cam_results(design),
            *_motion_results(design),
            *warp_results(studied),
            *_shaft_results(design),
            *_drive_results(design),
        ),
        checks=(*_checks(studied), *warp_checks(design)),
        tables=tables(studied),
        figures=figures(studied),
        warnings=(*_warnings(design), *warp_warnings(studied)),
        plates=plates(design),
        cam_tables=cam_tables(design),
    )


def prime_radius_for_bore(design: SheddingDesign) -> float:
    """Smallest prime radius [m] that leaves the wall outside the corners of the square bore."""
    return design.shaft.bar / math.sqrt(2) + design.params.bore_wall + design.cam.roller_radius


def _cam_results(design: SheddingDesign) -> tuple[Result, ...]:
    cam, stack = design.cam, design.stack
    hollow = concave_radius_min(cam)
    return (
        Result("prime_radius", cam.prime_radius, "mm", "prime radius of the cam, Rp"),
        Result("prime_radius_min", design.smallest_prime.value, "mm", "smallest for the pressure angle"),
        Result("prime_radius_for_bore", prime_radius_for_bore(design), "mm", "smallest for the bore and its wall"),
        Result("pressure_angle_max", pressure_angle_max(cam).value, "deg", "largest pressure angle over the turn"),
        Result("pressure_angle_at", pressure_angle_max(cam).at, "deg", "cam angle of the largest pressure angle"),
        Result("curvature_radius_min", convex_radius_min(cam).value, "mm", "least radius of the pitch curve, convex"),
        Result(
            "concave_radius_min", hollow.value if hollow else None, "mm", "least radius of the pitch curve, concave"
        ),
        Result("cam_area", area(cam), "cm^2", "area inside the cam's surface, bore not taken off"),
        Result("cam_thickness", stack.thickness, "mm", "thickness of a cam"),
        Result("guide_thickness", stack.guide_thickness, "mm", "thickness of a guide cam: the rest of the pitch"),
        Result("guide_radius", stack.guide_radius, "mm", "radius of a guide cam"),
        Result("cam_mass", stack.cam_mass, "kg", "mass of a cam, bored"),
        Result("guide_mass", stack.guide_mass, "kg", "mass of a guide cam, bored"),
        Result("mass", stack.mass, "kg", "mass of all cams, guide cams and the shaft between them"),
        Result("inertia", stack.inertia, "kg*m^2", "moment of inertia of all that about the shaft"),
    )


def _motion_results(design: SheddingDesign) -> tuple[Result, ...]:
    speed = design.params.speed
    first, last = design.shuttle_window
    found: Json = [{"angle": jump.angle, "place": jump.place} for jump in jumps(design.even)]
    phases: Json = [
        {"warps": parity, "phase": name, "start": start, "end": end}
        for parity, name, start, end in cycle_phases(design)
    ]
    return (
        Result("shed_opening", _peak(design.opening, design), "mm", "largest distance between even and odd warps"),
        Result("shuttle_start", first, "deg", "shaft angle from which the even shed is open enough for the shuttle"),
        Result("shuttle_end", last, "deg", "shaft angle to which it is; the odd shed follows half a turn later"),
        Result("shuttle_window", last - first, "deg", "for what angle it is"),
        Result("phase_groups", design.shed.groups, "1", "groups of each parity's cams that move one after another"),
        Result("phase_spread", design.shed.spread, "deg", "angle from the first group to the last"),
        Result("shed_overlap", _overlap(design), "deg", "of one parity coming down while the other goes up, each time"),
        Result("shuttle_time", (last - first) / speed, "s", "time that each shed is open enough for the shuttle"),
        Result("turn_time", TURN / speed, "s", "time of a turn: two sheds"),
        Result("velocity_max", speed * _peak(lambda q: design.even.at(q).ds, design), "mm/s", "largest warp velocity"),
        Result(
            "acceleration_max",
            speed**2 * _peak(lambda q: design.even.at(q).dds, design),
            "mm/s^2",
            "largest warp acceleration",
        ),
        Result("acceleration_jumps", found, "", "where the acceleration of the even warps jumps, shaft angle [rad]"),
        Result("phases", phases, "", "the cycle of even and odd warps, shaft angles [rad]"),
    )


def _directions(design: SheddingDesign) -> Json:
    """Load, slope and deflection of the weight alone and of the warps alone; None where the load is given."""
    shaft = design.shaft
    if shaft.directions is None:
        return None
    shares = dict(zip(("weight", "pull"), shaft.directions.shares(), strict=True))
    loads = {"weight": shaft.directions.weight, "pull": shaft.directions.pull}
    return {
        "angle": float(np.angle(shaft.directions.resultant)),
        **{
            name: {"load": loads[name], "slope": share * shaft.slope, "deflection": share * shaft.deflection}
            for name, share in shares.items()
        },
    }


def _shaft_results(design: SheddingDesign) -> tuple[Result, ...]:
    shaft, seat = design.shaft, design.shaft.seat
    return (
        Result("shaft_load", shaft.load, "kN/m", "load of the shaft, with its safety"),
        Result("shaft_length", shaft.length, "m", "length of the shaft between its first and last support"),
        Result("shaft_supports", design.params.spans + 1, "1", "supports of the shaft, both ends counted"),
        Result("shaft_span", shaft.span, "m", "from one support to the next"),
        Result("shaft_side_slope", shaft.side_slope, "mm", "least side of the square shaft for the slope"),
        Result(
            "shaft_side_deflection", shaft.side_deflection, "mm", "least side of the square shaft for the deflection"
        ),
        Result("shaft_side", shaft.side, "mm", "least side of the square shaft for slope and deflection"),
        Result("shaft_side_twist", shaft.side_twist, "mm", "least side of the square shaft for the twist"),
        Result("shaft_side_strength", shaft.side_strength, "mm", "least side of the square shaft for its strength"),
        Result("shaft_bar", shaft.bar, "mm", "side of the bar taken: as given, or from stock"),
        Result("shaft_slope", shaft.slope, "rad", "its slope at the supports"),
        Result("shaft_deflection", shaft.deflection, "mm", "its deflection between them"),
        Result("shaft_twist", shaft.twist, "deg", "its twist from end to end under the largest torque"),
        Result("shaft_stress", shaft.stress, "MPa", "its equivalent stress in bending and torsion, with the safety"),
        Result("shaft_endurance", shaft.endurance, "1", "safety against fatigue without end, beside that of the load"),
        Result("shaft_critical_speed", shaft.critical, "rpm", "lowest critical speed, cams and all"),
        Result("warps_across", design.across_max.value, "N", "largest force of the lifted warps across the shaft"),
        Result("shaft_directions", _directions(design), "", "weight and warps apart, with the safety [N/m, m, rad]"),
        Result("bearing", seat.bearing.name if seat.bearing else None, "", "bearing of the shaft"),
        Result("bearing_load", seat.reaction, "N", "on the most loaded bearing, without the safety"),
        Result("bearing_life", seat.life if seat.bearing else None, "h", "nine of ten live so long"),
        Result("journal", seat.journal, "mm", "least diameter of the journal, in torsion"),
    )


def _drive_results(design: SheddingDesign) -> tuple[Result, ...]:
    drive, speed, duty = design.drive, design.params.speed, design.drive.duty
    work = float(design.params.warps // 2 * lifting_work(design.params))
    return (
        Result("shaft_torque_max", drive.torque_max.value, "Nm", "largest torque that lifts the warps"),
        Result("shaft_torque_min", drive.torque_min.value, "Nm", "largest torque of the warps on the way back"),
        Result("torque_rms", drive.torque_rms, "Nm", "root mean square of the shaft's torque over the turn"),
        Result("power_max", drive.torque_max.value * speed, "W", "largest power at the shaft"),
        Result("shed_work", work, "J", "work of lifting the even warps once; it comes back on the return"),
        Result("motor_torque", drive.motor_torque, "Nm", "torque that the motor must give"),
        Result("motor_speed", drive.motor_speed, "rpm", "speed of the motor"),
        Result("motor_power", drive.motor_torque * drive.motor_speed, "W", "largest power of the motor"),
        Result("motor", drive.motor.name if drive.motor else None, "", "class of motor chosen"),
        Result("motor_torque_rms", duty.rms if duty else None, "Nm", "root mean square of its torque over the turn"),
        Result("motor_power_mean", duty.power_mean if duty else None, "W", "what goes in, the reducer's losses in it"),
        Result("inertia_ratio", duty.inertia_ratio if duty else None, "1", "cams over rotor, on the motor's shaft"),
    )


def _overlap(design: SheddingDesign) -> float:
    """Angle for which warps of both parities are off their lines [rad], at each change of the shed."""
    return max(0.0, design.params.lifted_angle + design.shed.spread - TURN / 2)


def _peak(function: Callable[[FloatArray], FloatArray], design: SheddingDesign) -> float:
    return supremum(lambda angle: np.abs(function(angle)), design.shed.knots).value


def _bearing_checks(design: SheddingDesign) -> tuple[Check, ...]:
    seat, params = design.shaft.seat, design.params
    life = at_least("life of the bearings", seat.life, params.bearing_life, "h", "ISO 281, bearing_life")
    if seat.bearing is None:
        return (life,)
    return (
        life,
        at_least("bore of the bearing for the torque", seat.bearing.bore, seat.journal, "mm", "torsion, von Mises"),
        at_most("bore of the bearing in the bar", seat.bearing.bore, design.shaft.bar, "mm", "journal of the bar"),
    )


def _window_checks(studied: SheddingAlternatives) -> tuple[Check, ...]:
    """The shuttle's window against what is asked for, if anything is."""
    design, whole = studied.design, studied.together.window()
    first, last = design.shuttle_window
    asked = design.params.shuttle_angle
    if asked is None and design.params.phase == "flattest":
        asked = window_asked(design.params, whole[1] - whole[0])
    return () if asked is None else (at_least("window of the shuttle", last - first, asked, "deg", "shuttle_angle"),)


def _checks(studied: SheddingAlternatives) -> tuple[Check, ...]:
    design = studied.design
    params, cam, shaft, drive = design.params, design.cam, design.shaft, design.drive
    pressure = snap_to_limit(pressure_angle_max(cam).value, params.pressure_angle_limit)
    lifted, width = (
        snap_to_limit(params.lifted_angle, TURN / 2),
        snap_to_limit(params.warps * params.warp_pitch, shaft.length),
    )
    opening = snap_to_limit(_peak(design.opening, design), params.shuttle_height)
    return (
        at_most(
            "pressure angle", pressure, params.pressure_angle_limit, "deg", f"{THESIS}: a thin cam must not buckle"
        ),
        at_least(
            "convex radius of the pitch curve (no undercut)",
            convex_radius_min(cam).value,
            cam.roller_radius,
            "mm",
            "Norton, Cam Design and Manufacturing, 7: rho > roller radius",
        ),
        at_least("prime radius round the bore", cam.prime_radius, prime_radius_for_bore(design), "mm", "bore_wall"),
        at_least("shed for the shuttle", opening, params.shuttle_height, "mm", "shuttle_height"),
        *_window_checks(studied),
        at_most("one parity down while the other is up", lifted, TURN / 2, "deg", f"{THESIS}, Fig. 3.19"),
        at_most("width of the cams on the shaft", width, shaft.length, "mm", "shaft_length"),
        at_most("slope of the shaft", shaft.slope, params.slope_limit, "rad", f"{THESIS} and eq. 3.5"),
        at_most(
            "deflection of the shaft", shaft.deflection, params.deflection_limit, "mm", f"{THESIS} and eq. 3.4, 1 mm"
        ),
        at_most("twist of the shaft", shaft.twist, params.twist_limit, "deg", "twist_limit: the far cams lag by it"),
        at_most("stress of the shaft", shaft.stress, params.strength, "MPa", "yield strength, von Mises"),
        at_least("fatigue of the shaft", shaft.endurance, 1.0, "1", "Goodman, hot rolled, 99 %"),
        at_most("speed of the shaft", params.speed, shaft.critical / 2, "rpm", "half of its critical speed"),
        *_bearing_checks(design),
        at_most(
            "motor torque",
            snap_to_limit(drive.motor_torque, drive.motor_limit),
            drive.motor_limit,
            "Nm",
            "lasting torque of the motor",
        ),
    )


def _warnings(design: SheddingDesign) -> tuple[str, ...]:
    params = design.params
    said = []
    if design.params.speed > SPEED_LIMIT * (1 + 1e-9):
        shown = format_quantity(params.speed, "rpm")
        said.append(f"the cam shaft turns at {shown}; the thesis allows {format_quantity(SPEED_LIMIT, 'rpm')}")
    if design.stack.thickness < FOIL:
        thin, foil = (format_quantity(value, "mm") for value in (design.stack.thickness, FOIL))
        said.append(f"cams {thin} thick are foil and buckle: below {foil} spread the warps over several cam shafts")
    if design.cam.prime_radius < prime_radius_for_bore(design):
        shown = format_quantity(prime_radius_for_bore(design), "mm")
        said.append(f"the square bore does not fit into the cam: set prime_radius={shown.replace(' ', '')} or more")
    if params.shaft_bar is None and design.shaft.bar > STOCK_SIDES[-1]:
        bar, largest = (format_quantity(side, "mm") for side in (design.shaft.bar, STOCK_SIDES[-1]))
        said.append(f"the shaft needs a bar of {bar}, beyond the {largest} of stock: set more spans")
    if params.bearing is None and design.shaft.seat.bearing is None:
        load, asked = format_quantity(design.shaft.seat.reaction, "N"), format_quantity(params.bearing_life, "h")
        said.append(f"no insert bearing on the bar lives {asked} under {load}: set more spans, or name a bearing")
    if params.motor_torque is None and design.drive.motor is None:
        largest = max(MOTORS, key=lambda motor: motor.torque).name
        needed, speed = (
            format_quantity(value, unit)
            for value, unit in ((design.drive.motor_torque, "Nm"), (design.drive.motor_speed, "rpm"))
        )
        said.append(f"no motor gives {needed} at {speed}; the largest is {largest}: set another ratio")
    return tuple(said)
