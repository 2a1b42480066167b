"""What a hammer's design says: results, checks, tables, figures, and the stroke for a controller."""

import math

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.hammer.axis import BUCKLING, stroke_needed
from ilmek.machines.hammer.design import Hammer
from ilmek.machines.hammer.figures import figures
from ilmek.report import CamTable, Check, Column, Json, Report, Result, Table, at_least, at_most, snap_to_limit
from ilmek.units import dm, format_quantity

THESIS = "thesis, 3.3"


def report(design: Hammer) -> Report:
    """Everything that the design says."""
    return Report(
        machine="hammer",
        title="Hammer",
        parameters=design.params.as_dict(),
        results=(*_fabric_results(design), *_comb_results(design), *_axis_results(design), *_linkage_results(design)),
        checks=_checks(design),
        tables=(_row_table(design), _blow_table(design), _across_table(design)),
        figures=figures(design),
        warnings=_warnings(design),
        cam_tables=_cam_tables(design),
    )


def _fabric_results(design: Hammer) -> tuple[Result, ...]:
    params, fabric = design.params, design.fabric
    warps = params.warps
    packed = fabric.packing_work(design.spacing)
    across = design.spacing_across()
    return (
        Result("row_pitch", design.spacing, "mm", "distance of the rows that the beat leaves: the outcome"),
        Result("knots_along", design.rows_along, "1/dm", "rows of knots along the carpet"),
        Result(
            "row_pitch_range",
            [float(across.min()), float(across.max())],
            "mm",
            "rows apart, least and largest over the width",
        ),
        Result("force_warp", design.force, "N", "mean force on the fell for each warp"),
        Result("force_warp_min", float(design.force_across().min()), "N", "least force of a warp across the width"),
        Result("force_warp_max", float(design.force_across().max()), "N", "largest force of a warp across the width"),
        Result("force_needed", design.needed, "N", "force for each warp that the rows wanted ask"),
        Result("force", design.force * warps, "N", "force on the whole fell"),
        Result("tension", fabric.tension, "N", "tension of a warp before the beat"),
        Result("fell_movement", design.fell, "mm", "way by which the fell gives way and comes back"),
        Result("comb_way", float(fabric.travel(design.force)), "mm", "way of the comb from the laid row to its end"),
        Result("bump_force", fabric.bump, "N", "force of a warp from which the cloth hangs slack"),
        Result("beat_energy", design.energy * warps, "J", "work of a beat on rows, warps and cloth"),
        Result("packing_energy", packed * warps, "J", "of it, what packs the row and is not given back"),
        Result(
            "beat_power", 2 * design.energy * warps / params.turn_time, "W", "mean power, two beats a turn of the cams"
        ),
    )


def _comb_results(design: Hammer) -> tuple[Result, ...]:
    comb, line = design.comb, design.comb.line
    return (
        Result("uniformity", line.uniformity, "1", "least force over the largest, across the width"),
        Result("share_min", line.least, "1", "least force over the mean"),
        Result("share_max", line.most, "1", "largest force over the mean"),
        Result("fell_stiffness", comb.foundation, "Pa", "stiffness of the fell, force over width and way"),
        Result("beam_number", line.number, "1", "width over the length in which the comb bends on the fell, l W"),
        Result("comb_rigidity", comb.rigidity, "N*m^2", "E I of the comb's bar"),
        Result("comb_depth", design.params.depth, "mm", "height of the comb's bar: as given, or chosen"),
        Result("comb_mass", comb.mass, "kg", "mass of bar and leaves"),
        Result("comb_stress", comb.stress, "MPa", "largest stress of the bar"),
        Result("leaf_stress", comb.leaf_stress, "MPa", "stress of a leaf"),
        Result("leaf_sag", comb.leaf_sag, "mm", "sag of a leaf at the fell"),
        Result("mass", design.mass, "kg", "mass of all that moves"),
    )


def _axis_results(design: Hammer) -> tuple[Result, ...]:
    axis, params = design.axis, design.params
    if axis is None:
        return ()
    duty = axis.drive.duty if axis.drive else None
    servo: Json = None
    if axis.drive and duty:
        servo = {
            "motor": axis.drive.motor.name,
            "ratio": axis.drive.reducer.ratio,
            "torque_rms": duty.rms,
            "torque_peak": duty.peak,
            "speed_max": duty.speed_max,
            "inertia_ratio": duty.inertia_ratio,
        }
    return (
        Result("moving_mass", axis.mass, "kg", "mass of cams and comb, which go down together"),
        Result("stroke_needed", stroke_needed(design.fabric, design.force), "mm", "least stroke: the comb's way"),
        Result("speed_max", float(np.max(np.abs(axis.speed))), "mm/s", "largest speed of the comb"),
        Result(
            "acceleration_max", float(np.max(np.abs(axis.acceleration))), "m/s^2", "largest acceleration of the comb"
        ),
        Result("inertia_force", axis.inertia_force, "N", "force that accelerates cams and comb"),
        Result("weight_carried", axis.balance, "N", "weight that the axes hold, the balanced part taken off"),
        Result("axes_force_down", float(np.max(axis.force)), "N", "largest force of all axes, downwards"),
        Result("axes_force_up", -float(np.min(axis.force)), "N", "largest force of all axes, upwards"),
        Result(
            "contact_speed",
            axis.meets,
            "mm/s",
            "speed of the comb where it meets the row: it presses, it does not strike",
        ),
        Result("power_max", axis.power_max, "W", "largest power of all axes"),
        Result("axes", params.shared, "1", f"vertical axes, {params.axis}s"),
        Result("axis_speed", float(np.max(np.abs(axis.cycle.speed))), "rpm", "largest speed of a screw or pulley"),
        Result("axis_torque", float(np.max(np.abs(axis.cycle.effort))), "Nm", "largest torque at a screw or pulley"),
        Result("brake_torque", axis.brake, "Nm", "torque that holds a screw or pulley at rest: neither locks itself"),
        Result("screw_diameter", axis.screw, "mm", "diameter of a ball screw; none of belts"),
        Result("buckling_safety", None if axis.screw is None else axis.buckling, "1", "safety of a screw, Euler"),
        Result("servo", servo, "", "of each axis; none where none of the table bears it"),
    )


def _linkage_results(design: Hammer) -> tuple[Result, ...]:
    linkage = design.linkage
    if linkage is None:
        return ()
    return (
        Result("beaters", linkage.number, "1", "crank-rockers that share the comb"),
        Result("linkage_force", linkage.force, "N", "of all at the beat, by the comb's inertia"),
        Result("linkage_torque", linkage.torque, "Nm", "largest on their crank shaft"),
        Result("swing_energy", linkage.energy, "J", "of the comb where it is quickest"),
        Result("speed_needed", _speed_needed(design), "rad/s", "of the crank, for the rows wanted"),
        Result("transmission_angle_min", linkage.one.transmission_angle_min, "deg", "of the crank-rockers"),
    )


def _speed_needed(design: Hammer) -> float | None:
    """Speed of the crank [rad/s] that gives the force needed: forces go with its square."""
    linkage = design.linkage
    if linkage is None or linkage.force == 0:
        return None
    return design.params.beat_speed * math.sqrt(design.needed * design.params.warps / linkage.force)


def _checks(design: Hammer) -> tuple[Check, ...]:
    params, comb = design.params, design.comb
    loosest = snap_to_limit(design.spacing, params.rows)
    common = (
        at_most("distance of the rows", loosest, params.rows, "mm", "row_pitch"),
        at_most("force before the cloth is slack", design.force, design.fabric.bump, "N", "T (1 + kw / kc)"),
        at_least("uniformity across the width", comb.line.uniformity, params.uniformity_limit, "1", f"{THESIS}: even"),
        at_most("stress of the comb", comb.stress, params.strength, "MPa", "strength"),
        at_most("stress of a leaf", comb.leaf_stress, params.strength, "MPa", "strength"),
    )
    return (*common, *_axis_checks(design))


def _axis_checks(design: Hammer) -> tuple[Check, ...]:
    axis, linkage, params = design.axis, design.linkage, design.params
    if axis is not None:
        way = stroke_needed(design.fabric, design.force)
        bears = axis.drive.duty.reserve if axis.drive else 0.0
        return (
            at_least("stroke for the comb's way", params.stroke, way, "mm", "fabric"),
            *(
                (at_least("buckling of the screws", axis.buckling, BUCKLING, "1", "Euler, one end clamped"),)
                if axis.screw is not None
                else ()
            ),
            at_least("torque of the servo over what is asked", bears, 1.0, "1", "motor table, margin 1.25"),
        )
    wanted, given = design.force * params.warps, linkage.force if linkage else 0.0
    return (at_least("force of the crank-rockers", snap_to_limit(given, wanted), wanted, "N", "inertia at the beat"),)


def _row_table(design: Hammer) -> Table:
    """What other forces leave, from loose to nearly jammed."""
    columns = (
        Column("force of a warp", "N"),
        Column("all warps", "kN"),
        Column("rows", "mm"),
        Column("rows along", "1/dm"),
        Column("fell gives way", "mm"),
        Column("energy of a beat", "J"),
    )
    warps, fabric = design.params.warps, design.fabric
    shares = (0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 4.0)

    def row(force: float) -> tuple[float, ...]:
        spacing = float(fabric.spacing(force))
        return force, force * warps, spacing, 1 / spacing, float(fabric.fell(force)), fabric.energy(force) * warps

    rows = tuple(row(share * design.needed) for share in shares)
    return Table("hammer-rows", "Rows by the force of the beat", columns, rows)


def _blow_table(design: Hammer) -> Table:
    """The same row struck instead of pressed: speed and momentum of a mass whose energy goes into the fell."""
    columns = (
        Column("what strikes"),
        Column("mass", "kg"),
        Column("speed for the rows wanted", "m/s"),
        Column("momentum", "N*s"),
        Column("speed it has", "m/s"),
        Column("rows it would leave", "mm"),
    )
    warps, fabric = design.params.warps, design.fabric
    wanted = fabric.energy(design.needed) * warps

    def row(name: str, mass: float, speed: float) -> tuple[float | str, ...]:
        asked = math.sqrt(2 * wanted / mass) if mass > 0 else math.inf
        left = float(fabric.spacing(fabric.struck(0.5 * mass * speed**2 / warps)))
        return name, mass, asked, mass * asked, speed, left

    if design.axis is not None:
        speed = float(np.max(np.abs(design.axis.speed)))
        rows = [row("cams and comb", design.axis.mass, speed), row("comb alone", design.comb.mass, speed)]
    else:
        speed = design.linkage.one.peaks["beater_velocity"].value if design.linkage else 0.0
        rows = [row("comb on the crank-rockers", design.comb.mass, speed)]
    return Table("hammer-blow", "The same row struck instead of pressed", columns, tuple(rows))


def _across_table(design: Hammer) -> Table:
    columns = (
        Column("across", "mm"),
        Column("force of a warp", "N"),
        Column("rows", "mm"),
        Column("rows along", "1/dm"),
    )
    x = design.comb.line.x
    at = np.linspace(0, x.size - 1, 13).round().astype(int)
    force, spacing = design.force_across(), design.spacing_across()
    rows = tuple((float(x[i]), float(force[i]), float(spacing[i]), 1 / float(spacing[i])) for i in at.tolist())
    return Table("hammer-across", "Force and rows across the width", columns, rows)


def _warnings(design: Hammer) -> tuple[str, ...]:
    said = []
    if design.comb.line.least <= 0:
        said.append("the comb bends so much that it leaves the fell: set more supports or a deeper comb")
    if design.spacing > design.params.rows * (1 + 1e-9):
        rows, wanted = (1 / pitch * dm for pitch in (design.spacing, design.params.rows))
        asked = format_quantity(design.needed, "N")
        more = _speed_needed(design)
        how = f" or turn the cranks at {format_quantity(more, 'rad/s')}" if more else ""
        said.append(f"{rows:.4g} rows a decimetre where {wanted:.4g} are wanted: press with {asked} a warp{how}")
    if design.axis is not None and design.axis.drive is None:
        said.append("no servo of the table bears an axis: set more axes, a smaller lead or a slower shed_speed")
    return tuple(said)


def _cam_tables(design: Hammer) -> tuple[CamTable, ...]:
    if design.axis is None:
        return ()
    programme = design.axis.programme

    def course(angle: FloatArray) -> FloatArray:
        at = programme.at(angle)
        return np.stack([at.s, at.ds, at.dds])

    title = "Stroke of the comb over the cam shaft's angle"
    return (CamTable("comb", title, course, programme.knots, "mm", design.params.turn_time),)
