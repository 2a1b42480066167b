"""What an automated loom says: its own results and checks, and those of the machines in it."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ilmek.machines import beat_up, hammer, shedding, warp_tension, weaver
from ilmek.machines.automated_loom.cyclogram import BEATER, CARRIAGE, SHUTTLE, TAKE_UP, cam_tables
from ilmek.machines.automated_loom.design import LoomDesign, warp_tension_of
from ilmek.machines.automated_loom.energy import axes, energy_of
from ilmek.machines.automated_loom.figures import figures
from ilmek.machines.automated_loom.frame import BOW_LIMIT, BUCKLING_SAFETY, STEEL, STRESS_SAFETY, LoomFrame
from ilmek.machines.automated_loom.knotting import arms_of
from ilmek.machines.automated_loom.parts import LoomPart, PartsList, parts_of_loom
from ilmek.machines.automated_loom.production_time import estimated_time, time_shares
from ilmek.report import Check, Column, Json, Report, Result, Table, at_least, at_most, snap_to_limit
from ilmek.timing.cyclogram import check_all, check_apart
from ilmek.timing.track import peak_acceleration, peak_speed
from ilmek.units import format_quantity, turn

ROW_TOLERANCE = 0.02
"""Share by which rows may be left farther apart than wanted before it is said; a judgement of ours."""

HEAVY = 0.25
"""Weight of a cylinder over the pull of its warps from which it is said; a judgement of ours."""


def report(loom: LoomDesign) -> Report:
    """Everything that the loom's design says; checks of a machine carry its name."""
    return report_with(loom, parts_of(loom))


def report_with(loom: LoomDesign, parts: tuple[Report, ...]) -> Report:
    """The same with the reports of its machines, where they are at hand."""
    listed = parts_of_loom(loom)
    checks = (*_checks(loom), *_frame_checks(listed.frame), *(check for part in parts for check in _prefixed(part)))
    warnings = (*_warnings(loom), *(f"{part.machine}: {said}" for part in parts for said in part.warnings))
    return Report(
        "automated-loom",
        "Automated loom",
        loom.params.as_dict(),
        (*_results(loom, listed), *(_nested(part) for part in parts)),
        checks,
        (_heads_table(loom), _parts_table(listed), _prices_table(listed), _row_table(loom)),
        figures(loom),
        warnings,
        tuple(replace(plate, name=f"{part.machine}-{plate.name}") for part in parts for plate in part.plates),
        (
            *(replace(table, name=f"{part.machine}-{table.name}") for part in parts for table in part.cam_tables),
            *cam_tables(loom.row_cyclogram, (SHUTTLE, BEATER, TAKE_UP)),
            *cam_tables(loom.cyclograms[0], (CARRIAGE,)),
        ),
    )


def parts_of(loom: LoomDesign) -> tuple[Report, ...]:
    """The reports of the machines in the loom: head, its arms where they can tie, what beats, shedding, tension."""
    arms = arms_of(loom.params).report
    return (
        weaver.MACHINE.report(loom.weaver, in_a_loom=True),
        *(() if arms is None else (arms,)),
        *(() if loom.beat_up is None else (beat_up.MACHINE.report(loom.beat_up, in_a_loom=True),)),
        *(() if loom.hammer is None else (hammer.MACHINE.report(loom.hammer),)),
        shedding.MACHINE.report(loom.shedding, in_a_loom=True),
        warp_tension.MACHINE.report(loom.warp_tension, in_a_loom=True),
    )


def _without(part: Report, *names: str) -> Report:
    """A report without the figures whose names begin so: the loom shows them itself, or leaves them to the machine."""
    return replace(part, figures=tuple(figure for figure in part.figures if not figure.name.startswith(names)))


def _results(loom: LoomDesign, listed: PartsList) -> tuple[Result, ...]:
    params = loom.params
    return (
        *_time_results(loom),
        Result("heads", loom.heads, "1", "knotting heads"),
        Result("heads_max", loom.heads_max, "1", "the most that can share a row without meeting"),
        Result("rows", loom.rows, "1", "rows of knots"),
        Result("columns", loom.columns, "1", "knots of a row"),
        Result("knots", loom.rows * loom.columns, "1", "knots of the carpet"),
        Result("warps", loom.warps, "1", "warps: two for each knot of a row"),
        Result("warp_pitch", params.pitch, "mm", "distance of two warps"),
        Result("tension", warp_tension_of(params), "N", "tension of a warp"),
        *_beat_results(loom),
        Result("colour_change_time", loom.times.colour_change, "s", "mean time to bring another yarn in line"),
        Result("tube", {"diameter": loom.tube[0], "wall": loom.tube[1]}, "mm", "stock tube of the warp cylinders"),
        *_whole_results(loom, listed),
    )


def _time_results(loom: LoomDesign) -> tuple[Result, ...]:
    """What a knot, a row and the carpet take, and where the time goes."""
    times, shares = loom.times, time_shares(loom)
    estimate, knots = estimated_time(loom), loom.rows * loom.columns
    parts: Json = {
        "knotting": shares.knotting,
        "colour changes": shares.colour_changes,
        "wefts and beats": shares.wefts,
    }
    return (
        Result("cycle_time_knot", times.knot, "s", "time of a knot of one head"),
        Result(
            "cycle_time_row", times.weft, "s", "wefts and beats of a row: a turn of the shedding cams, without knots"
        ),
        Result("row_time", estimate / loom.rows, "s", "a row with its knots, estimated"),
        Result("knots_per_minute", 60 * knots / estimate, "1", "of all heads, wefts included, estimated"),
        Result("weaving_time", estimate, "h", "the carpet, estimated; a programme tells it exactly"),
        Result("time_shares", parts, "%", "where the time goes"),
        Result("bottleneck", shares.bottleneck, "", "what takes most of the time"),
        Result("utilisation", shares.utilisation, "%", "time that a head ties or changes colour, of all"),
    )


def _whole_results(loom: LoomDesign, listed: PartsList) -> tuple[Result, ...]:
    """Energy, mass and price of the whole."""
    energy, frame = energy_of(loom), listed.frame
    shares: Json = {name: joules / energy.time for name, joules in energy.shares.items()}
    return (
        Result("power_mean", energy.power, "W", "mean power from the mains while it weaves"),
        Result("power_shares", shares, "W", "of it, what takes it"),
        Result("energy_per_area", energy.per_area, "kWh/m^2", "energy for a square metre of carpet"),
        Result("energy", energy.total, "kWh", "energy for the carpet"),
        Result("axes", axes(loom), "1", "driven axes"),
        Result("frame_column", frame.column.name, "", "square hollow section of the two columns"),
        Result("frame_rail", frame.rail.name, "", "square hollow section of the heads' rail"),
        Result("frame_mass", frame.mass, "kg", "mass of the frame"),
        Result("mass", listed.mass, "kg", "mass of all parts but reducers, rails and control"),
        Result("price", listed.price, "", "price of all parts by the table of prices, in its currency"),
    )


def _arms_in_time(loom: LoomDesign) -> tuple[Check, ...]:
    """Where arms tie the knots, whether they do within the time of one."""
    arms = arms_of(loom.params).report
    if arms is None:
        return ()
    cycle = next(float(str(result.value)) for result in arms.results if result.name == "cycle_time")
    return (at_most("arms of the heads: cycle", cycle, loom.times.knot, "s", "time of a knot of one head"),)


def _beat_results(loom: LoomDesign) -> tuple[Result, ...]:
    """What the beat gives to the whole width, to a warp and to a knot, and where it leaves the rows."""
    force, left = loom.beat_force, loom.left
    return (
        Result("beaters", loom.beaters, "1", "crank-rockers that drive the beater, all alike, on one crank shaft"),
        Result("beat_force", force, "N", "greatest force of the beat on the whole width"),
        Result("beat_force_width", force / loom.params.width, "N/m", "the same over the width"),
        Result("beat_force_warp", force / loom.warps, "N", "the same for a warp"),
        Result("beat_force_knot", force / loom.columns, "N", "the same for a knot"),
        Result("beat_torque_max", _beat_torque(loom), "Nm", "greatest torque on the crank shaft of all crank-rockers"),
        Result("beat_force_needed", left.needed, "N", "for a warp, that the rows wanted ask of a fabric as assumed"),
        Result("row_pitch_left", left.spacing, "mm", "distance of the rows that the beat leaves, as assumed"),
    )


def _beat_torque(loom: LoomDesign) -> float:
    return 0.0 if loom.beat_up is None else loom.beaters * loom.beat_up.peaks["drive_torque"].value


def _nested(part: Report) -> Result:
    results: Json = {result.name: result.value for result in part.results}
    return Result(part.machine.replace("-", "_"), results, "", f"results of the {part.machine}")


def _prefixed(part: Report) -> Iterator[Check]:
    return (replace(check, name=f"{part.machine}: {check.name}") for check in part.checks)


def _checks(loom: LoomDesign) -> tuple[Check, ...]:
    params, (knot, cyclogram) = loom.params, loom.cyclograms
    shuttle = cyclogram.track(SHUTTLE)
    speed, acceleration = peak_speed(shuttle, cyclogram.period), peak_acceleration(shuttle, cyclogram.period)
    limit = params.shuttle_acceleration
    shed = loom.shedding.params.shuttle_height
    return (
        at_most("heads that share a row", loom.heads, loom.heads_max, "1", "width and head_width"),
        *(
            (at_least("distance of two heads", loom.head_distance, params.head_width, "mm", "head_width"),)
            if loom.heads > 1
            else ()
        ),
        *_arms_in_time(loom),
        at_most(
            "shuttle: speed", snap_to_limit(speed, params.shuttle_speed), params.shuttle_speed, "m/s", "shuttle_speed"
        ),
        at_most("shuttle: acceleration", snap_to_limit(acceleration, limit), limit, "m/s^2", "shuttle_acceleration"),
        at_least("shuttle: room in the shed", _least_room(loom), shed, "mm", "shuttle_height"),
        *(replace(check, name=f"row: {check.name}") for check in check_all(cyclogram, cyclogram.relations)),
        *(replace(check_apart(knot, one), name=f"knot: {one.said(knot.units)}") for one in knot.exclusions),
    )


def _frame_checks(frame: LoomFrame) -> tuple[Check, ...]:
    stress = STEEL.strength / STRESS_SAFETY
    return (
        at_most("frame: stress of a column", frame.column_stress, stress, "MPa", "half of yield, S235"),
        at_most(
            "frame: bow of a column", frame.column_bow, BOW_LIMIT, "mm", "as the cylinders' deflection, thesis 3.1"
        ),
        at_least("frame: against buckling", frame.buckling_factor, BUCKLING_SAFETY, "1", "Euler's load"),
        at_most("frame: sag of the heads' rail", frame.rail_sag, frame.task.sag_limit, "mm", "rail_sag"),
    )


def _least_room(loom: LoomDesign) -> float:
    """The least opening of the shed while the shuttle is in it [m]; it is least when it enters and when it leaves."""
    passing = loom.row_cyclogram.track(SHUTTLE).segment("pass")
    rooms = loom.shedding.shed.opening(np.array([passing.start, passing.end]))
    return snap_to_limit(float(rooms.min()), loom.shedding.params.shuttle_height)


def _heads_table(loom: LoomDesign) -> Table:
    columns = (Column("heads"), Column("weaving time", "h"), Column("a row", "s"), Column("knots a minute"))
    knots = loom.rows * loom.columns
    rows = []
    for heads in range(1, loom.heads_max + 1):
        time = estimated_time(loom, heads)
        rows.append((heads, time, time / loom.rows, 60 * knots / time))
    return Table("loom-heads", "Weaving time by number of heads, estimated", columns, tuple(rows))


def _parts_table(listed: PartsList) -> Table:
    columns = (
        Column("part"),
        Column("number"),
        Column("what"),
        Column("material"),
        Column("mass of one", "kg", 3),
        Column("mass of all", "kg"),
        Column("price of all"),
    )
    rows = tuple(
        (part.name, part.number, part.what, part.material, part.mass, _weighed(part), part.price(listed.prices))
        for part in listed.parts
    )
    return Table("loom-parts", "Parts of the loom", columns, rows)


def _weighed(part: LoomPart) -> float:
    return part.number * part.mass


def _prices_table(listed: PartsList) -> Table:
    columns = (Column("kind of part"), Column("each"), Column("per kg"), Column("per m"), Column("per W"))
    rows = tuple((kind, r.each, r.per_kg, r.per_m, r.per_W) for kind, r in listed.prices.items())
    return Table("loom-prices", "Prices reckoned with; set others with `prices`", columns, rows)


def _row_table(loom: LoomDesign) -> Table:
    columns = (Column("track"), Column("motion"), Column("from", "deg"), Column("to", "deg"), Column("time", "s"))
    period = loom.row_cyclogram.period
    rows = tuple(
        (track.name, part.name, part.start, part.end, (part.end - part.start) / turn * period)
        for track in loom.row_cyclogram.tracks
        for part in track.segments
    )
    return Table("loom-row", "Motions of a row over the angle of the shedding cams", columns, rows)


def _warnings(loom: LoomDesign) -> tuple[str, ...]:
    params, said = loom.params, []
    arms = arms_of(params)
    if arms.cannot:
        said.append(arms.cannot)
    if params.knot != "symmetric":
        said.append(
            f"the head of the thesis ties symmetric knots; {params.knot} ones need other motions of its grippers"
            + ("" if arms.report is None else ", as those of the knotting-dyad")
        )
    left, wanted = loom.left, 1 / params.quality.along
    if left.spacing > wanted * (1 + ROW_TOLERANCE):
        beats, rows = format_quantity(left.force, "N", 3), format_quantity(left.spacing, "mm", 3)
        said.append(
            f"the crank-rockers press each warp with {beats}: a fabric as the hammer assumes keeps its rows {rows} "
            f"apart, not {format_quantity(wanted, 'mm', 3)}; hammer=comb presses them together"
        )
    share = loom.warp_tension.self_weight / loom.warp_tension.load
    if share > HEAVY:
        mass, part = format_quantity(loom.warp_tension.mass, "kg", 3), format_quantity(share, "%", 2)
        said.append(f"a cylinder weighs {mass}, {part} of what the warps pull: weave narrower, or support it between")
    asked = turn / params.shed_speed
    if loom.times.weft > asked * (1 + 1e-9):
        slower = format_quantity(turn / loom.times.weft, "rpm")
        said.append(f"the shedding cams turn at {slower} only: shuttle and beat need that time at this width")
    return tuple(said)
