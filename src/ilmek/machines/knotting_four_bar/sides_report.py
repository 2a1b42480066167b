"""What both sides together say: gears, motor torque, clearances and the knot; nothing of one side."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.linkage.clearance import Clearance
from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.sides import KnottingSides, clearances, hands
from ilmek.report import Check, Column, Json, Result, Table, at_least, at_most
from ilmek.units import format_quantity
from ilmek.weaving.knots.two_hands import TwoHandKnot, knot_of_hands, pitch_range

AGREE = 1e-9
LEFT_OUT = (
    "torque and pins know the force along the pitch circle; left out: what presses the gears apart, friction, play"
)


@dataclass(frozen=True, slots=True)
class SidesReport:
    """What is said of both sides; nothing of one."""

    results: tuple[Result, ...] = ()
    checks: tuple[Check, ...] = ()
    tables: tuple[Table, ...] = ()
    warnings: tuple[str, ...] = ()


def said(design: KnottingFourBar) -> SidesReport:
    """Gears, torque, clearances, knot."""
    sides = design.sides
    if sides is None:
        return SidesReport()
    near = clearances(design.params, sides)
    tied = _tied(design, sides)
    results = (*_results(sides, near), *_knot(design, tied))
    return SidesReport(results, _checks(design, sides, near), (_table(sides),), _warnings(design, tied))


def _results(sides: KnottingSides, near: Mapping[str, Clearance]) -> tuple[Result, ...]:
    least = min(near, key=lambda body: near[body].least)
    pins = "greatest force in each pin on the way, *: of the second side; SI"
    return (
        Result("axis_distance", sides.gears.distance, "mm", "distance of the pivots of both cranks"),
        Result("mirror", sides.mirror, "mm", "x of the upright line that the second side is mirrored in"),
        Result("gears", _gears(sides), "", f"of both cranks, equal, SI; {LEFT_OUT}", shown=False),
        Result("motor_torque_max", sides.torque, "N*m", "greatest torque of one motor on the first crank, both sides"),
        Result("side_pin_forces_max", _pins(sides), "", pins, shown=False),
        Result("side_clearance_min", near[least].least, "mm", f"least on the way, from {least} to {least}"),
        Result("gripper_clearance_min", near["coupler"].least, "mm", "least of the couplers with their grippers"),
        Result("hand_distance_min", float(sides.gap.min()), "mm", "of the two hands, where they are nearest"),
        Result("knot_crank_angle", sides.knot, "deg", "crank angle there"),
    )


def _gears(sides: KnottingSides) -> Json:
    gears = sides.gears
    return {
        "module": gears.module,
        "teeth": gears.teeth,
        "width": gears.width,
        "pitch_radius": gears.pitch_radius,
        "pressure_angle": gears.pressure_angle,
        "profile_shift": gears.profile_shift,
        "tooth_force_max": sides.tooth,
        "separating_force_max": gears.separating(sides.tooth),
        "bending_stress": gears.bending(sides.tooth),
    }


def _pins(sides: KnottingSides) -> Json:
    course = sides.course
    pins = (joint.name for joint in sides.plan.mechanism.joints)
    return {name.replace(" ", ""): float(np.max(np.abs(course.forces.pin(name)))) for name in pins}


@dataclass(frozen=True, slots=True, eq=False)
class TiedPitches:
    """What the hands tie on warps at the pitch asked for, and the pitches at which they tie any."""

    proof: TwoHandKnot
    pitches: tuple[float, float] | None
    other: str


def _tied(design: KnottingFourBar, sides: KnottingSides) -> TiedPitches:
    first, second = (way[design.onward] for way in hands(sides.course.motion))
    wide = pitch_range(first, second)
    other = "" if wide is None else knot_of_hands(first, second, sum(wide) / 2).name
    return TiedPitches(knot_of_hands(first, second, design.params.warp_pitch), wide, other)


def _knot(design: KnottingFourBar, tied: TiedPitches) -> tuple[Result, ...]:
    ends: list[Json] | None = None if tied.pitches is None else list(tied.pitches)
    pitch = format_quantity(design.params.warp_pitch, "mm")
    meaning = f"with two warps {pitch} apart between the sides, by the crossings of the yarn"
    return (
        Result("knot_tied", tied.proof.name, "", meaning),
        Result("knot_why", tied.proof.why, "", "where it is tied, or why there is none", shown=False),
        Result("knot_pitches", ends, "mm", "least and greatest distance of two warps that a knot is tied on"),
    )


def _warnings(design: KnottingFourBar, tied: TiedPitches) -> tuple[str, ...]:
    """That no knot is tied, and on which warps one is."""
    if tied.proof.tied is not None:
        return ()
    none = f"the hands tie no knot on two warps {format_quantity(design.params.warp_pitch, 'mm')} apart"
    if tied.pitches is None:
        return (f"{none}, nor on any opened wider",)
    least, most = (format_quantity(end, "mm") for end in tied.pitches)
    return (f"{none}; on warps opened to {least} to {most} they tie a {tied.other}",)


def _table(sides: KnottingSides) -> Table:
    gears = sides.gears
    columns = (
        *(Column("distance of axes", "mm", 7), Column("module", "mm"), Column("teeth of each"), Column("width", "mm")),
        *(Column("pressure angle", "deg"), Column("sum of profile shifts"), Column("tooth force, most", "N")),
        *(Column("pressed apart by", "N"), Column("bending", "MPa")),
    )
    row = (
        *(gears.distance, gears.module, gears.teeth, gears.width, gears.pressure_angle, gears.profile_shift),
        *(sides.tooth, gears.separating(sides.tooth), gears.bending(sides.tooth)),
    )
    return Table("knotting-gears", "Gears that couple both cranks", columns, (row,), brief=True)


def _checks(design: KnottingFourBar, sides: KnottingSides, near: Mapping[str, Clearance]) -> tuple[Check, ...]:
    params = design.params
    missed = max(sides.course.torque_error, sides.standing.torque_error)
    bending = sides.gears.bending(sides.tooth)
    least, wanted = min(one.least for one in near.values()), params.side_clearance
    return (
        at_least("clearance of the two sides", least, wanted, "mm", "side_clearance"),
        at_most("bending of the gears' teeth", bending, params.gear_stress, "MPa", "gear_stress; Lewis"),
        at_most("torque of both sides coupled, against each alone", missed, AGREE, "1", "mirror image"),
        at_most("power balance of both sides", sides.course.forces.power_error, AGREE, "1", "virtual power"),
    )
