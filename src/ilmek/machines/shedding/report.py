"""What a design of shedding cams says: results, checks against the thesis' limits, tables and figures."""

import math
from collections.abc import Callable

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import LAWS, SMOOTH_LAWS
from ilmek.cams.limits import (
    PlateCam,
    area,
    concave_radius_min,
    convex_radius_min,
    pressure_angle_max,
    smallest_prime_radius,
)
from ilmek.cams.pieces import supremum
from ilmek.cams.programme import TURN, Programme, jumps
from ilmek.elements import shafts
from ilmek.elements.motors import MOTORS
from ilmek.elements.shafts import STOCK_SIDES
from ilmek.machines.rounding import settled
from ilmek.machines.shedding.design import SheddingDesign, lifting, turn_knots
from ilmek.machines.shedding.figures import figures
from ilmek.report import Check, Column, Json, Report, Result, Table, at_least, at_most
from ilmek.units import deg, format_quantity, mm, rpm

THESIS = "thesis, 3.2"
FOIL = 0.4 * mm
"""Thickness below which no sheet of a hand's radius stands upright [m]; a judgement of ours."""

SPEED_LIMIT = 5 * rpm
"""What the thesis allows the cam shaft, so that no warp breaks."""


def report(design: SheddingDesign) -> Report:
    """Everything that the design says."""
    return Report(
        machine="shedding",
        title="Shedding cams",
        parameters=design.params.as_dict(),
        results=(*_cam_results(design), *_motion_results(design), *_shaft_results(design), *_drive_results(design)),
        checks=_checks(design),
        tables=(_phase_table(design), _law_table(design), _side_table(design), _cam_table(design)),
        figures=figures(design),
        warnings=_warnings(design),
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


def _shaft_results(design: SheddingDesign) -> tuple[Result, ...]:
    shaft = design.shaft
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
    )


def _drive_results(design: SheddingDesign) -> tuple[Result, ...]:
    drive, speed = design.drive, design.params.speed
    work = float(design.params.warps // 2 * _work_of_a_warp(design))
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
    )


def cycle_phases(design: SheddingDesign) -> tuple[tuple[str, str, float, float], ...]:
    """Parity, phase, first and last shaft angle [rad] of each part of the turn; angles of the odd warps pass a turn."""
    return tuple(
        (parity, segment.name, float(programme.start + begin), float(programme.start + begin + segment.span))
        for parity, programme in (("even", design.even), ("odd", design.odd))
        for begin, segment in zip(programme.edges, programme.segments, strict=False)
    )


def _peak(function: Callable[[FloatArray], FloatArray], design: SheddingDesign) -> float:
    return supremum(lambda angle: np.abs(function(angle)), turn_knots(design.even, design.odd)).value


def _work_of_a_warp(design: SheddingDesign) -> float:
    """Work [J] of lifting one warp: F L, or 2 T (sqrt(L^2 + H^2) - H), what its tension does while it lengthens."""
    params = design.params
    if params.tension is None or params.half_span is None:
        return params.warp_force * params.lift
    return 2 * params.tension * (math.hypot(params.lift, params.half_span) - params.half_span)


def _checks(design: SheddingDesign) -> tuple[Check, ...]:
    params, cam, shaft, drive = design.params, design.cam, design.shaft, design.drive
    pressure = settled(pressure_angle_max(cam).value, params.pressure_angle_limit)
    lifted, width = settled(params.lifted_angle, TURN / 2), settled(params.warps * params.warp_pitch, shaft.length)
    opening = settled(_peak(design.opening, design), params.shuttle_height)
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
        at_most("one parity down while the other is up", lifted, TURN / 2, "deg", f"{THESIS}, Fig. 3.19"),
        at_most("width of the cams on the shaft", width, shaft.length, "mm", "shaft_length"),
        at_most("slope of the shaft", shaft.slope, params.slope_limit, "rad", f"{THESIS} and eq. 3.5"),
        at_most(
            "deflection of the shaft", shaft.deflection, params.deflection_limit, "mm", f"{THESIS} and eq. 3.4, 1 mm"
        ),
        at_most("twist of the shaft", shaft.twist, params.twist_limit, "deg", "twist_limit: the far cams lag by it"),
        at_most("stress of the shaft", shaft.stress, params.strength, "MPa", "yield strength, von Mises"),
        at_most(
            "motor torque",
            settled(drive.motor_torque, drive.motor_limit),
            drive.motor_limit,
            "Nm",
            "lasting torque of the motor",
        ),
    )


def _phase_table(design: SheddingDesign) -> Table:
    columns = (Column("warps"), Column("phase"), Column("from", "deg"), Column("to", "deg"), Column("time", "s"))
    rows = tuple(
        (parity, name, start, end, (end - start) / design.params.speed)
        for parity, name, start, end in cycle_phases(design)
    )
    return Table("shedding-phases", "The cycle on the shaft's angle", columns, rows)


def _law_table(design: SheddingDesign) -> Table:
    """What each motion law would give for the same lift, angles and pressure angle."""
    columns = (
        Column("law"),
        Column("prime radius", "mm"),
        Column("convex radius", "mm"),
        Column("velocity", "mm/s"),
        Column("acceleration", "mm/s^2"),
        Column("acceleration jumps"),
    )
    rows = tuple(_law_row(design, name) for name in SMOOTH_LAWS)
    return Table("shedding-laws", "Motion laws compared at equal lift, angles and pressure angle", columns, rows)


def _law_row(design: SheddingDesign, name: str) -> tuple[float | int | str, ...]:
    params, law, shortest = design.params, LAWS[name], min(design.params.rise, design.params.fall_angle)
    programme: Programme = lifting(params, name)
    prime = smallest_prime_radius(programme, params.pressure_angle_limit).value
    # The roller may be larger than this law's prime circle; the pitch curve does not ask for it.
    radius = convex_radius_min(PlateCam(programme, prime)).value
    rate = params.speed / shortest
    velocity, acceleration = params.lift * rate * law.velocity_peak, params.lift * rate**2 * law.acceleration_peak
    return name, prime, radius, velocity, acceleration, len(jumps(programme))


def _side_table(design: SheddingDesign) -> Table:
    """The shaft for other safeties on the same load: the thesis' Table 3.2 with its columns in their places."""
    shaft, params = design.shaft, design.params
    columns = (
        Column("factor on the load"),
        Column("side for the slope", "mm"),
        Column("side for the deflection", "mm"),
    )

    def row(factor: float) -> tuple[float, float, float]:
        load = factor * shaft.load
        return (
            factor,
            shafts.square_side(shafts.inertia_for_slope(load, shaft.span, params.modulus, params.slope_limit)),
            shafts.square_side(
                shafts.inertia_for_deflection(load, shaft.span, params.modulus, params.deflection_limit)
            ),
        )

    return Table("shedding-shaft", "Square shaft by load", columns, tuple(row(f) for f in (0.5, 0.75, 1.0, 1.5, 2.0)))


def _cam_table(design: SheddingDesign) -> Table:
    """The cam in steps of 5 degrees, to be drawn or cut."""
    angle = np.arange(0, 360, 5) * deg
    surface, cam = design.cam.surface(angle), design.cam
    columns = (
        Column("cam angle", "deg"),
        Column("lift", "mm"),
        Column("x", "mm"),
        Column("y", "mm"),
        Column("pressure angle", "deg"),
        Column("curvature", "1/m"),
    )
    values = (
        angle,
        cam.programme.at(angle).s,
        surface.real,
        surface.imag,
        cam.pressure_angle(angle),
        cam.curvature(angle),
    )
    rows = tuple(tuple(float(value) for value in row) for row in zip(*values, strict=True))
    return Table("shedding-cam-points", "Points of the cam's surface", columns, rows)


def _warnings(design: SheddingDesign) -> tuple[str, ...]:
    params, hollow = design.params, concave_radius_min(design.cam)
    said = []
    if design.params.speed > SPEED_LIMIT * (1 + 1e-9):
        shown = format_quantity(params.speed, "rpm")
        said.append(f"the cam shaft turns at {shown}; the thesis allows {format_quantity(SPEED_LIMIT, 'rpm')}")
    if design.stack.thickness < FOIL:
        thin, foil = (format_quantity(value, "mm") for value in (design.stack.thickness, FOIL))
        said.append(f"cams {thin} thick are foil and buckle: below {foil} spread the warps over several cam shafts")
    if hollow is not None and params.roller_radius == 0:
        shown, where = format_quantity(hollow.value, "mm"), format_quantity(hollow.at, "deg")
        said.append(
            f"the cam is hollow (radius {shown} at {where}): a taut warp bridges the hollow and is lifted a little "
            "earlier and let down a little later than the law says"
        )
    if design.cam.prime_radius < prime_radius_for_bore(design):
        shown = format_quantity(prime_radius_for_bore(design), "mm")
        said.append(f"the square bore does not fit into the cam: set prime_radius={shown.replace(' ', '')} or more")
    if params.shaft_bar is None and design.shaft.bar > STOCK_SIDES[-1]:
        bar, largest = (format_quantity(side, "mm") for side in (design.shaft.bar, STOCK_SIDES[-1]))
        said.append(f"the shaft needs a bar of {bar}, beyond the {largest} of stock: set more spans")
    if params.motor_torque is None and design.drive.motor is None:
        largest = max(MOTORS, key=lambda motor: motor.torque).name
        needed, speed = (
            format_quantity(value, unit)
            for value, unit in ((design.drive.motor_torque, "Nm"), (design.drive.motor_speed, "rpm"))
        )
        said.append(f"no motor gives {needed} at {speed}; the largest is {largest}: set another ratio")
    return tuple(said)
