"""What a design of the warp tension cylinder says: results, checks against the thesis' limits, tables, figures."""

from dataclasses import replace

from ilmek.elements.beam import uniform
from ilmek.elements.bearings import BEARINGS, bearings_for
from ilmek.elements.figures import deflection_plot, tube_drawing
from ilmek.elements.motors import MOTORS
from ilmek.machines.warp_tension.cylinder_report import (
    cylinder_checks,
    cylinder_results,
    cylinders_table,
    side_view,
    stock_table,
    tension_plot,
)
from ilmek.machines.warp_tension.cylinders import Cylinder, cylinders
from ilmek.machines.warp_tension.design import WarpTensionDesign, outer_radii_min
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.report import Check, Column, Figure, Report, Result, Table, at_most, snap_to_limit
from ilmek.units import format_number, format_quantity, mm, turn

THESIS = "thesis, 3.1"
LOCKING, SURE = 0.5, 0.45
"""Largest efficiency of a reducer that locks itself, and that up to which makers count on it (to 0.55 it is unsure)."""


def report(design: WarpTensionDesign) -> Report:
    """Everything that the design says."""
    return Report(
        machine="warp-tension",
        title="Warp tension",
        parameters=design.params.as_dict(),
        results=(*_cylinder_results(design), *_drive_results(design), *cylinder_results(design)),
        checks=(*_checks(design), *cylinder_checks(design)),
        tables=(
            cylinders_table(design),
            stock_table(design),
            _bearing_table(design),
            _tube_table(design),
            _efficiency_table(design),
        ),
        figures=(side_view(design), *_figures(design), tension_plot(design)),
        warnings=_warnings(design),
    )


def _cylinder_results(design: WarpTensionDesign) -> tuple[Result, ...]:
    params = design.params
    return (
        Result("slope", design.slope, "rad", "slope of the cylinder in its bearings, under the warps alone"),
        Result("deflection", design.deflection, "mm", "deflection at mid-width, under the warps alone"),
        Result("slope_loaded", design.slope_loaded, "rad", "slope with the tube's own weight"),
        Result("deflection_loaded", design.deflection_loaded, "mm", "deflection with the tube's own weight"),
        Result("torque", design.torque, "Nm", "torque of all warps on the bare cylinder"),
        Result("reaction", design.reaction, "N", "force on each bearing"),
        Result("outer_radius", design.outer_radius, "mm", "outer radius of the tube"),
        Result("inner_radius", design.inner_radius, "mm", "inner radius of the tube"),
        Result("outer_radius_min", design.outer_radius_min, "mm", "least outer radius for the slope"),
        Result(
            "outer_radius_min_deflection",
            design.outer_radius_min_deflection,
            "mm",
            "least outer radius for the deflection",
        ),
        Result("load", design.load, "kN/m", "pull of the warps along the cylinder"),
        Result("force", design.load * params.width, "kN", "pull of all warps"),
        Result("stress", design.stress, "MPa", "bending stress at mid-width, own weight included"),
        Result("self_weight", design.self_weight, "N/m", "weight of the tube"),
        Result("mass", design.mass, "kg", "mass of the tube between its bearings"),
        Result(
            "bearings",
            [kind.name for kind in bearings_for(design.slope_loaded)],
            "",
            "kinds that bear the slope, own weight included",
        ),
    )


def _drive_results(design: WarpTensionDesign) -> tuple[Result, ...]:
    params, reducer = design.params, design.reducer
    return (
        Result("roll_radius", design.roll_radius, "mm", "radius with the carpet wound on"),
        Result("torque_full", design.torque_full, "Nm", "torque of all warps with the carpet wound on"),
        Result("ratio", reducer.ratio, "1", "ratio of the reducer"),
        Result("self_locking", reducer.self_locking, "", "whether the reducer holds the warps by itself"),
        Result(
            "back_driving_efficiency", reducer.back_driving_efficiency, "1", "2 - 1/efficiency; locked at 0 and below"
        ),
        Result("motor_torque", design.motor_torque, "Nm", "torque that the motor must give"),
        Result("motor_speed", design.motor_speed, "rpm", "largest speed of the motor while a row is taken up"),
        Result("motor", design.motor.name if design.motor else None, "", "class of motor chosen"),
        Result(
            "take_up_angle", params.row_pitch / design.outer_radius, "deg", "turn of the cylinder for a row of knots"
        ),
        Result(
            "take_up_motor_turns",
            params.row_pitch / design.outer_radius * design.reducer.ratio / turn,
            "1",
            "motor turns a row",
        ),
        Result("take_up_turns", design.take_up_turns, "1", "turns of the cylinder for the whole carpet"),
    )


def _checks(design: WarpTensionDesign) -> tuple[Check, ...]:
    params = design.params
    locking = (
        at_most(
            "efficiency, to lock itself",
            params.efficiency,
            LOCKING,
            "1",
            "nothing comes back: 2 - 1/efficiency <= 0",
        ),
    )
    return (
        at_most(
            "slope in the bearings",
            design.slope_loaded,
            params.slope_limit,
            "rad",
            f"{THESIS}, eq. 3.5 and 3.7; own weight included",
        ),
        at_most(
            "deflection",
            design.deflection_loaded,
            params.deflection_limit,
            "mm",
            f"{THESIS}, eq. 3.4; own weight included",
        ),
        at_most("bending stress", design.stress, params.strength, "MPa", "yield strength of the tube"),
        *(locking if params.self_locking else ()),
        at_most(
            "motor torque",
            snap_to_limit(design.motor_torque, design.motor_limit),
            design.motor_limit,
            "Nm",
            f"{THESIS}, eq. 3.8",
        ),
    )


def _bearing_table(design: WarpTensionDesign) -> Table:
    columns = (Column("bearing"), Column("largest slope", "mrad"), Column("slope here", "mrad"), Column("bears it"))
    borne = bearings_for(design.slope_loaded)
    rows = tuple(
        (kind.name, kind.slope_limit, design.slope_loaded, "yes" if kind in borne else "no") for kind in BEARINGS
    )
    return Table("warp-tension-bearings", "Rolling bearings for the slope", columns, rows)


def _tube_table(design: WarpTensionDesign) -> Table:
    """The thesis' Table 3.1 for this loom: radii, and the factor 5 in its place."""
    params = design.params
    columns = (
        Column("inner radius", "mm"),
        Column("least outer radius, slope", "mm", 6),
        Column("least outer radius, deflection", "mm", 6),
        Column("deflection of a 10 mm wall", "mm"),
    )

    def row(inner: float) -> tuple[float, float, float, float]:
        inertia = uniform.tube_inertia(inner + 10 * mm, inner)
        sag = float(uniform.deflection_max(design.load, params.width, params.modulus, inertia))
        return (inner, *outer_radii_min(params, inner), sag)

    rows = tuple(row(inner * mm) for inner in (50, 75, 100, 125, 150))
    return Table("warp-tension-tubes", "Tubes for this loom", columns, rows)


def _efficiency_table(design: WarpTensionDesign) -> Table:
    columns = (Column("efficiency of the reducer"), Column("motor torque", "Nm"), Column("locks itself"))
    rows = tuple(
        (eta, design.torque_full / (design.reducer.ratio * eta), "yes" if eta <= LOCKING else "no")
        for eta in (0.35, 0.45, 0.5, 0.7, 0.9, 1.0)
    )
    return Table("warp-tension-reducers", "Reducer: self-locking or efficient, not both", columns, rows)


def _figures(design: WarpTensionDesign) -> tuple[Figure, ...]:
    params = design.params
    line = deflection_plot(
        design.load + design.self_weight, params.width, params.modulus, design.inertia, params.deflection_limit
    )
    section = tube_drawing(design.outer_radius, design.inner_radius, design.outer_radius_min)
    return tuple(replace(figure, name=f"warp-tension-{figure.name}") for figure in (line, section))


def _warnings(design: WarpTensionDesign) -> tuple[str, ...]:
    params, said = design.params, []
    needed = design.torque_full / (design.reducer.ratio * LOCKING)
    if params.self_locking and not design.reducer.self_locking:
        said.append(
            f"a reducer of efficiency {format_number(params.efficiency)} does not lock itself: one that does "
            f"(at most {LOCKING:g}) asks {format_quantity(needed, 'Nm')} or more of the motor; or "
            "set self_locking=no and hold the warps by a brake"
        )
    if params.self_locking and SURE < params.efficiency <= LOCKING:
        said.append(
            f"a reducer of efficiency {format_number(params.efficiency)} locks itself in theory only: "
            f"makers count on it below {SURE:g}"
        )
    if params.motor_torque is None and design.motor is None:
        largest = max(MOTORS, key=lambda motor: motor.torque).name
        shown, speed = format_quantity(design.motor_torque, "Nm"), format_quantity(design.motor_speed, "rpm")
        said.append(f"no motor gives {shown} at {speed}; the largest is {largest}: set another ratio")
    spacer = cylinders(design)[2]
    if params.spacer_tube is None and not _stiff(params, spacer):
        said.append(
            "no stock tube is stiff enough for the spacer: less tension, a narrower width or a smaller spacer_wrap"
        )
    return tuple(said)


def _stiff(params: WarpTensionParams, one: Cylinder) -> bool:
    return one.slope <= params.slope_limit and one.deflection <= params.deflection_limit
