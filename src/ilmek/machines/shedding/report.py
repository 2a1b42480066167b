"""The report of shedding cams: checks against the thesis' limits, warnings, tables."""

import numpy as np

from ilmek.cams.laws import LAWS, SMOOTH_LAWS
from ilmek.cams.limits import concave_radius_min, convex_radius_min
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import TURN, jumps
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.elements import shafts
from ilmek.elements.drive_parts import no_motor
from ilmek.machines.shedding.analysis import SheddingAnalysis
from ilmek.machines.shedding.design import SheddingDesign, lifting
from ilmek.machines.shedding.phases import Shed, required_window, shed_of
from ilmek.report import Check, Table, at_least, at_most, columns
from ilmek.units import deg, format_quantity, mm, rpm

THESIS = "thesis, 3.2"
FOIL = 0.4 * mm
"""Thickness below which a sheet of a hand's radius does not stand upright [m]; assumed by this project."""

SPEED_LIMIT = 5 * rpm
"""Speed of the cam shaft that the thesis allows, so that no warp breaks."""

SPREADS = tuple(spread * deg for spread in (15, 30))
"""Spreads of two groups in the table of phases [rad]."""


def checks(found: SheddingAnalysis) -> tuple[Check, ...]:
    """Cam, shed, shaft, bearings, motor and strain of the warps."""
    design, strain = found.design, found.warp_strain
    params, cam, shaft, drive = design.params, design.cam, design.shaft, design.drive
    mu, width = params.pressure_angle_limit, params.warps * params.warp_pitch
    buckling = f"{THESIS}: a thin cam must not buckle"
    norton = "Norton, Cam Design and Manufacturing, 7: rho > roller radius"
    rho, bore = design.curvature_radius_min, design.prime_radius_for_bore
    deflection = f"{THESIS} and eq. 3.4, 1 mm"
    return (
        at_most("pressure angle", design.pressure_angle_max, mu, "deg", buckling),
        at_least("convex radius of the pitch curve (no undercut)", rho, cam.roller_radius, "mm", norton),
        at_least("prime radius round the bore", cam.prime_radius, bore, "mm", "bore_wall"),
        at_least("shed for the shuttle", design.shed_opening, params.shuttle_height, "mm", "shuttle_height"),
        *_window_checks(found),
        at_most("one parity down while the other is up", params.lifted_angle, TURN / 2, "deg", f"{THESIS}, Fig. 3.19"),
        at_most("width of the cams on the shaft", width, shaft.length, "mm", "shaft_length"),
        at_most("slope of the shaft", shaft.slope, params.slope_limit, "rad", f"{THESIS} and eq. 3.5"),
        at_most("deflection of the shaft", shaft.deflection, params.deflection_limit, "mm", deflection),
        at_most("twist of the shaft", shaft.twist, params.twist_limit, "deg", "twist_limit: lag of the far cams"),
        at_most("stress of the shaft", shaft.stress, params.strength, "MPa", "yield strength, von Mises"),
        at_least("fatigue of the shaft", shaft.endurance, 1.0, "1", "Goodman, hot rolled, 99 %"),
        at_most("speed of the shaft", params.speed, shaft.critical / 2, "rpm", "half of its critical speed"),
        *_bearing_checks(design),
        at_most("motor torque", drive.motor_torque, drive.motor_limit, "Nm", "continuous torque of the motor"),
        *(
            ()
            if strain is None
            else (at_most("strain of a lifted warp", strain, params.strain_limit, "%", "strain_limit"),)
        ),
    )


def _window_checks(found: SheddingAnalysis) -> tuple[Check, ...]:
    """The shuttle's window against the required one, if any."""
    design, required = found.design, found.design.params.shuttle_angle
    if required is None and design.params.phase == "flattest":
        first, last = found.together.window()
        required = required_window(design.params, last - first)
    if required is None:
        return ()
    return (at_least("window of the shuttle", design.shuttle_window_angle, required, "deg", "shuttle_angle"),)


def _bearing_checks(design: SheddingDesign) -> tuple[Check, ...]:
    seat, bar = design.shaft.seat, design.shaft.bar
    life = at_least("life of the bearings", seat.life, design.params.bearing_life, "h", "ISO 281, bearing_life")
    if seat.bearing is None:
        return (life,)
    bore = seat.bearing.bore
    return (
        life,
        at_least("bore of the bearing for the torque", bore, seat.journal, "mm", "torsion, von Mises"),
        at_most("bore of the bearing in the bar", bore, bar, "mm", "journal of the bar"),
    )


def warnings(found: SheddingAnalysis) -> tuple[str, ...]:
    """Reasons why the design should not be made as it is, and remedies."""
    return (*_design_warnings(found.design), *_warp_warnings(found))


def _design_warnings(design: SheddingDesign) -> tuple[str, ...]:
    params, shaft, drive, made = design.params, design.shaft, design.drive, []
    if params.speed > SPEED_LIMIT * (1 + 1e-9):
        shown = format_quantity(params.speed, "rpm")
        made.append(f"the cam shaft turns at {shown}; the thesis allows {format_quantity(SPEED_LIMIT, 'rpm')}")
    if design.stack.thickness < FOIL:
        thin, foil = (format_quantity(value, "mm") for value in (design.stack.thickness, FOIL))
        made.append(f"cams {thin} thick are foil and buckle: below {foil} spread the warps over several cam shafts")
    if design.cam.prime_radius < design.prime_radius_for_bore:
        shown = format_quantity(design.prime_radius_for_bore, "mm")
        made.append(f"the square bore does not fit into the cam: set prime_radius={shown.replace(' ', '')} or more")
    if params.shaft_bar is None and shaft.bar > shafts.STOCK_SIDES[-1]:
        bar, largest = (format_quantity(side, "mm") for side in (shaft.bar, shafts.STOCK_SIDES[-1]))
        made.append(f"the shaft needs a bar of {bar}, beyond the {largest} of stock: set more spans")
    if params.bearing is None and shaft.seat.bearing is None:
        load, life = format_quantity(shaft.seat.reaction, "N"), format_quantity(params.bearing_life, "h")
        made.append(f"no insert bearing on the bar lives {life} under {load}: set more spans, or name a bearing")
    if params.motor_torque is None and drive.motor is None:
        made.append(no_motor(drive.motor_torque, drive.motor_speed))
    return tuple(made)


def _warp_warnings(found: SheddingAnalysis) -> tuple[str, ...]:
    """Hollows that a yarn does not follow; holds that are in the way of the nose."""
    design, made = found.design, []
    hollow = concave_radius_min(design.cam)
    if hollow is not None and design.params.roller_radius == 0:
        shown, where = format_quantity(hollow.value, "mm"), format_quantity(hollow.at, "deg")
        by = f", by {format_quantity(found.bridges.excess, 'mm')} at most" if found.bridges else ""
        made.append(
            f"the cam is hollow (radius {shown} at {where}): a taut warp bridges the hollow and is lifted a little "
            f"earlier and let down a little later than by the law{by}"
        )
    if found.warp is not None and found.yarn is None:
        reach = format_quantity(design.cam.prime_radius + design.params.lift, "mm")
        made.append(f"a hold of the warps stands within the {reach} that the cams reach: set longer spans")
    return tuple(made)


def tables(found: SheddingAnalysis) -> tuple[Table, ...]:
    """The cycle, phases compared, motion laws, sides of the shaft, points of the cam."""
    design = found.design
    return (_phase_table(design), _stagger_table(found), _law_table(design), _side_table(design), _point_table(design))


def _phase_table(design: SheddingDesign) -> Table:
    heads = columns("warps", "phase", "from [deg]", "to [deg]", "time [s]")
    rows = tuple(
        (parity, name, start, end, (end - start) / design.params.speed)
        for parity, name, start, end in design.cycle_phases
    )
    return Table("shedding-phases", "The cycle over the shaft's angle", heads, rows)


def _stagger_table(found: SheddingAnalysis) -> Table:
    """Torque and shed of cams all at once, in two halves, and in the phases of least torque."""
    design, params = found.design, found.design.params
    sheds = [("all at once", found.together)]
    if params.warps >= 4:
        sheds += [("two halves", shed_of(params, design.even, spread, 2)) for spread in SPREADS]
    sheds += [("flattest", found.flattest)]
    if params.phase == "staggered":
        sheds += [("chosen", design.shed)]
    heads = columns(
        "cams of a parity",
        "groups",
        "spread [deg]",
        "torque [Nm]",
        "root mean square [Nm]",
        "shed for the shuttle [deg]",
        "time [s]",
    )
    rows = tuple(_stagger_row(name, shed) for name, shed in sheds)
    return Table("shedding-stagger", "Cams all at once and one after another", heads, rows)


def _stagger_row(name: str, shed: Shed) -> tuple[float | int | str, ...]:
    most, least = (peak.value for peak in shed.peaks())
    first, last = shed.window()
    window, speed = last - first, shed.params.speed
    return name, shed.groups, shed.spread, max(most, -least), shed.rms(), window, window / speed


def _law_table(design: SheddingDesign) -> Table:
    """Each motion law with the same lift, angles and pressure angle."""
    heads = columns(
        "law",
        "prime radius [mm]",
        "convex radius [mm]",
        "velocity [mm/s]",
        "acceleration [mm/s^2]",
        "acceleration jumps",
    )
    rows = tuple(_law_row(design, name) for name in SMOOTH_LAWS)
    return Table("shedding-laws", "Motion laws compared at equal lift, angles and pressure angle", heads, rows)


def _law_row(design: SheddingDesign, name: str) -> tuple[float | int | str, ...]:
    params, law, programme = design.params, LAWS[name], lifting(design.params, name)
    prime = pressure_prime(programme, CamLimits(params.pressure_angle_limit, params.pressure_angle_limit)).value
    # The roller may be larger than this law's prime circle; the pitch curve does not depend on it.
    radius = convex_radius_min(PlateCam(programme, prime)).value
    rate = params.speed / min(params.rise, params.fall_angle)
    velocity, acceleration = params.lift * rate * law.velocity_peak, params.lift * rate**2 * law.acceleration_peak
    return name, prime, radius, velocity, acceleration, len(jumps(programme))


def _side_table(design: SheddingDesign) -> Table:
    """The shaft for other safeties on the same load: the thesis' Table 3.2, its columns in the right order."""
    shaft, params = design.shaft, design.params

    def row(factor: float) -> tuple[float, float, float]:
        load, span, modulus = factor * shaft.load, shaft.span, params.modulus
        slope = shafts.inertia_for_slope(load, span, modulus, params.slope_limit)
        deflection = shafts.inertia_for_deflection(load, span, modulus, params.deflection_limit)
        return factor, shafts.square_side(slope), shafts.square_side(deflection)

    heads = columns("factor on the load", "side for the slope [mm]", "side for the deflection [mm]")
    rows = tuple(row(factor) for factor in (0.5, 0.75, 1.0, 1.5, 2.0))
    return Table("shedding-shaft", "Square shaft by load", heads, rows)


def _point_table(design: SheddingDesign) -> Table:
    """The cam in steps of 5 degrees, to be drawn or cut."""
    angle, cam = np.arange(0, 360, 5) * deg, design.cam
    surface = cam.surface(angle)
    lift, mu, bend = cam.programme.at(angle).s, cam.pressure_angle(angle), cam.curvature(angle)
    values = np.stack([angle, lift, surface.real, surface.imag, mu, bend], axis=1)
    heads = columns("cam angle [deg]", "lift [mm]", "x [mm]", "y [mm]", "pressure angle [deg]", "curvature [1/m]")
    return Table("shedding-cam-points", "Points of the cam's surface", heads, tuple(map(tuple, values.tolist())))
