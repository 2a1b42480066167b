"""The shedding cams' tables: the cycle, phases compared, motion laws, sides of the shaft, points of the cam."""

import numpy as np

from ilmek.cams.laws import LAWS, SMOOTH_LAWS
from ilmek.cams.limits import PlateCam, convex_radius_min
from ilmek.cams.programme import CamProgramme, jumps
from ilmek.cams.sizing import CamLimits, pressure_prime
from ilmek.elements import shafts
from ilmek.machines.shedding.alternatives import SheddingAlternatives
from ilmek.machines.shedding.design import SheddingDesign, lifting
from ilmek.machines.shedding.phases import Shed, shed_of
from ilmek.report import Column, Table
from ilmek.units import deg

SPREADS = tuple(spread * deg for spread in (15, 30))
"""Spreads of two groups that the table of phases compares [rad]."""


def tables(studied: SheddingAlternatives) -> tuple[Table, ...]:
    """All tables, in the order of the report."""
    design = studied.design
    return (
        phase_table(design),
        stagger_table(studied),
        law_table(design),
        side_table(design),
        point_table(design),
    )


def cycle_phases(design: SheddingDesign) -> tuple[tuple[str, str, float, float], ...]:
    """Parity, phase, first and last shaft angle [rad] of each part of the turn; angles of the odd warps pass a turn."""
    return tuple(
        (parity, segment.name, float(programme.start + begin), float(programme.start + begin + segment.span))
        for parity, programme in (("even", design.even), ("odd", design.odd))
        for begin, segment in zip(programme.edges, programme.segments, strict=False)
    )


def phase_table(design: SheddingDesign) -> Table:
    """Phases of even and odd warps over the turn."""
    columns = (Column("warps"), Column("phase"), Column("from", "deg"), Column("to", "deg"), Column("time", "s"))
    rows = tuple(
        (parity, name, start, end, (end - start) / design.params.speed)
        for parity, name, start, end in cycle_phases(design)
    )
    return Table("shedding-phases", "The cycle on the shaft's angle", columns, rows)


def stagger_table(studied: SheddingAlternatives) -> Table:
    """Torque and shed of cams all at once, in two halves one after the other, and as flat as the shuttle allows."""
    design, params = studied.design, studied.design.params
    sheds = [("all at once", studied.together)]
    if params.warps >= 4:
        sheds += [("two halves", shed_of(params, design.even, spread, 2)) for spread in SPREADS]
    sheds += [("flattest", studied.flattest)]
    if params.phase == "staggered":
        sheds += [("taken", design.shed)]
    columns = (
        Column("cams of a parity"),
        Column("groups"),
        Column("spread", "deg"),
        Column("torque", "Nm"),
        Column("root mean square", "Nm"),
        Column("shed for the shuttle", "deg"),
        Column("time", "s"),
    )
    rows = tuple(_stagger_row(name, shed) for name, shed in sheds)
    return Table("shedding-stagger", "Cams all at once and one after another", columns, rows)


def _stagger_row(name: str, shed: Shed) -> tuple[float | int | str, ...]:
    most, least = (peak.value for peak in shed.peaks())
    first, last = shed.window()
    return (
        name,
        shed.groups,
        shed.spread,
        max(most, -least),
        shed.rms(),
        last - first,
        (last - first) / shed.params.speed,
    )


def law_table(design: SheddingDesign) -> Table:
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
    limit = design.params.pressure_angle_limit
    params, law, shortest = design.params, LAWS[name], min(design.params.rise, design.params.fall_angle)
    programme: CamProgramme = lifting(params, name)
    prime = pressure_prime(programme, CamLimits(limit, limit)).value
    # The roller may be larger than this law's prime circle; the pitch curve does not ask for it.
    radius = convex_radius_min(PlateCam(programme, prime)).value
    rate = params.speed / shortest
    velocity, acceleration = params.lift * rate * law.velocity_peak, params.lift * rate**2 * law.acceleration_peak
    return name, prime, radius, velocity, acceleration, len(jumps(programme))


def side_table(design: SheddingDesign) -> Table:
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


def point_table(design: SheddingDesign) -> Table:
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
