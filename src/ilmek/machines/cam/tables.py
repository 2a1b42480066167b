"""The cam's tables: laws compared, rollers compared, points of the surface."""

import math
from dataclasses import replace

import numpy as np

from ilmek.cams.contact import FollowerLoad
from ilmek.cams.laws import LAWS
from ilmek.cams.programme import CamProgramme, jumps
from ilmek.errors import ParameterError
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.rollers import ROLLERS, RollerDuty
from ilmek.machines.cam.shape import programme_of, smallest_of
from ilmek.num.piecewise import supremum
from ilmek.report import Column, Table
from ilmek.units import deg


def tables(design: CamDesign) -> tuple[Table, ...]:
    """Laws, rollers where there is one, and points of the cam."""
    rollers = (_roller_table(design, design.duty),) if design.duty and design.roller else ()
    return (_law_table(design), *rollers, _point_table(design))


def _law_table(design: CamDesign) -> Table:
    """What each law would give for rise and fall, at the same lift, angles, load and limit."""
    columns = (
        Column("law"),
        Column("smallest prime radius", "mm"),
        Column("velocity", "m/s"),
        Column("acceleration", "m/s^2"),
        Column("jerk", "m/s^3"),
        Column("torque", "N*m"),
        Column("acceleration jumps"),
    )
    rows = tuple(_law_row(design, name) for name in LAWS)
    return Table("cam-laws", "Motion laws compared at equal lift, angles, load and limit", columns, rows)


def _law_row(design: CamDesign, name: str) -> tuple[float | int | str, ...]:
    """A law's row; the spring is left as it is, the torque is that of load, spring and mass without friction."""
    params, speed = design.params, design.params.speed
    law = params.laws()[0] if name == params.law else LAWS[name]
    programme = programme_of(params, (law, law))
    rate = speed / min(params.rise, params.fall_angle)
    peaks = (law.velocity_peak * rate, law.acceleration_peak * rate**2, law.jerk_peak * rate**3)
    size = _smallest(design, programme)
    return name, size, *(params.lift * peak for peak in peaks), _torque(programme, design.held), len(jumps(programme))


def _smallest(design: CamDesign, programme: CamProgramme) -> float:
    """The smallest prime radius [m] by another law; NaN where there is none."""
    try:
        return smallest_of(design.params, programme).value
    except ParameterError:
        return math.nan


def _torque(programme: CamProgramme, held: FollowerLoad) -> float:
    def torque(angle: np.ndarray) -> np.ndarray:
        at = programme.at(angle)
        return np.asarray(np.abs(held.force(at.s, at.dds) * at.ds))

    return supremum(torque, programme.knots).value


def _roller_table(design: CamDesign, duty: RollerDuty) -> Table:
    """How long each roller of the table would last under the force on this cam."""
    columns = (
        Column("roller"),
        Column("diameter", "mm"),
        Column("width", "mm"),
        Column("C", "N"),
        Column("largest force", "N"),
        Column("life", "h"),
        Column("taken"),
    )
    rows = []
    for roller in ROLLERS.values():
        turns = (duty.turns + 1) * design.cam.roller_radius / roller.radius - 1
        life = replace(duty, turns=turns).time(roller) if turns > 0 else math.inf
        taken = "yes" if roller is design.roller else ""
        rows.append((roller.name, roller.diameter, roller.width, roller.dynamic, roller.force_limit, life, taken))
    return Table("cam-rollers", "Rollers under the force on this cam", columns, tuple(rows))


def _point_table(design: CamDesign) -> Table:
    """The cam in steps of 5 degrees, to be drawn or checked."""
    angle = np.arange(0, 360, 5) * deg
    state = design.state(angle)
    surface = state.trace.surface
    columns = (
        Column("cam angle", "deg"),
        Column("lift", "mm"),
        Column("x", "mm"),
        Column("y", "mm"),
        Column("pressure angle", "deg"),
        Column("curvature", "1/m"),
        Column("contact force", "N"),
        Column("torque", "N*m"),
    )
    values = (
        angle,
        state.trace.course.s * design.params.per_unit,
        surface.real,
        surface.imag,
        state.trace.pressure_angle,
        state.trace.curvature,
        state.normal,
        state.torque,
    )
    rows = tuple(tuple(float(value) for value in row) for row in zip(*values, strict=True))
    return Table("cam-points", "The cam in steps of 5°", columns, rows)
