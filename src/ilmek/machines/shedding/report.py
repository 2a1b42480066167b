"""The report of shedding cams: what is worth knowing, and tables."""

from functools import lru_cache

import numpy as np

from ilmek.cams.laws import LAWS, SMOOTH_LAWS
from ilmek.cams.limits import concave_radius_min, convex_radius_min
from ilmek.cams.plate import PlateCam
from ilmek.cams.programme import CamProgramme, jumps
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.elements import shafts
from ilmek.machines.shedding.analysis import SheddingAnalysis
from ilmek.machines.shedding.cam_shaft import lifting
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.machines.shedding.phases import Shed, shed_of
from ilmek.report import Table, columns
from ilmek.units import deg, format_quantity, rpm

SPEED_LIMIT = 5 * rpm
"""Speed of the cam shaft that the thesis allows."""

SPREADS = tuple(spread * deg for spread in (15, 30))
"""Spreads of two groups in the table of phases [rad]."""


def warnings(analysis: SheddingAnalysis) -> tuple[str, ...]:
    """What is worth knowing of cams that work: a quick shaft, hollows that a yarn does not follow."""
    return (*_speed_warning(analysis.design), *_hollow_warning(analysis))


def _speed_warning(design: SheddingDesign) -> tuple[str, ...]:
    if design.params.speed <= SPEED_LIMIT * (1 + 1e-9):
        return ()
    shown, allowed = (format_quantity(speed, "rpm") for speed in (design.params.speed, SPEED_LIMIT))
    return (f"the cam shaft turns at {shown}; the thesis allows {allowed}",)


def _hollow_warning(analysis: SheddingAnalysis) -> tuple[str, ...]:
    design = analysis.design
    hollow = concave_radius_min(design.cam)
    if hollow is None or design.params.roller_radius > 0:
        return ()
    shown, where = format_quantity(hollow.value, "mm"), format_quantity(hollow.at, "deg")
    by = f", by {format_quantity(analysis.bridges.excess, 'mm')} at most" if analysis.bridges else ""
    late = "is lifted a little earlier and let down a little later than by the law"
    return (f"the cam is hollow (radius {shown} at {where}): a taut warp bridges the hollow and {late}{by}",)


def tables(analysis: SheddingAnalysis) -> tuple[Table, ...]:
    """The cycle, phases compared, motion laws, sides of the shaft, points of the cam."""
    design = analysis.design
    several = (_shafts_table(design),) if len(design.shafts) > 1 else ()
    first = _phase_table(design), _stagger_table(analysis), _law_table(design), _side_table(design)
    return (*several, *first, _point_table(design))


def _shafts_table(design: SheddingDesign) -> Table:
    """Each of several shafts: where it stands, its warps, cams, bar, torque and motor."""
    heads = columns(
        "shaft | beyond the first [mm] | even warps | odd warps | lift [mm] | prime radius [mm]",
        "guide radius [mm] | mass [kg] | bar [mm] | torque [Nm] | bearing | motor",
    )
    rows = tuple(
        (
            index + 1,
            shaft.beyond,
            *shaft.numbers,
            shaft.params.lift,
            shaft.cam.prime_radius,
            shaft.stack.guide_radius,
            shaft.stack.mass,
            shaft.shaft.bar,
            shaft.drive.torque_max.value,
            shaft.shaft.seat.bearing.name,
            shaft.drive.motor.name if shaft.drive.motor else "given",
        )
        for index, shaft in enumerate(design.shafts)
    )
    return Table("shedding-shafts", "The cam shafts one above the other", heads, rows)


def _phase_table(design: SheddingDesign) -> Table:
    heads = columns("warps", "phase", "from [deg]", "to [deg]", "time [s]")
    rows = tuple(
        (parity, name, start, end, (end - start) / design.params.speed)
        for parity, name, start, end in design.cycle_phases
    )
    return Table("shedding-phases", "The cycle over the shaft's angle", heads, rows)


def _stagger_table(analysis: SheddingAnalysis) -> Table:
    """Torque and shed of cams all at once, in two halves, and in the phases of least torque."""
    design, params = analysis.design, analysis.design.params
    sheds = [("all at once", analysis.together)]
    if params.cloth.warps >= 4:
        sheds += [("two halves", shed_of(params, design.even, spread, 2)) for spread in SPREADS]
    sheds += [("flattest", analysis.flattest)]
    if params.phase == "staggered":
        sheds += [("chosen", design.shed)]
    heads = columns(
        "cams of a parity | groups | spread [deg] | torque [Nm] | root mean square [Nm]",
        "shed for the shuttle [deg] | time [s]",
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
        "law | prime radius [mm] | convex radius [mm] | velocity [mm/s] | acceleration [mm/s^2] | acceleration jumps"
    )
    rows = tuple(_law_row(design, name) for name in SMOOTH_LAWS)
    return Table("shedding-laws", "Motion laws compared at equal lift, angles and pressure angle", heads, rows)


def _law_row(design: SheddingDesign, name: str) -> tuple[float | int | str, ...]:
    params, law, programme = design.params, LAWS[name], lifting(design.params, name)
    prime, radius = _size_of(programme, params.pressure_angle_limit)
    rate = params.speed / min(params.rise, params.fall_angle)
    velocity, acceleration = params.lift * rate * law.velocity_peak, params.lift * rate**2 * law.acceleration_peak
    return name, prime, radius, velocity, acceleration, len(jumps(programme))


@lru_cache(maxsize=64)
def _size_of(programme: CamProgramme, pressure_angle: float) -> tuple[float, float]:
    """Prime radius for a pressure angle, and least convex radius [m]: of each law they are the same in most looms."""
    prime = pressure_prime(programme, CamLimits(pressure_angle, pressure_angle)).value
    # The roller may be larger than this law's prime circle; the pitch curve does not depend on it.
    return prime, convex_radius_min(PlateCam(programme, prime)).value


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
