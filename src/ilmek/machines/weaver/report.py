"""What the design of the knotting head says: results, checks, tables and figures."""

import numpy as np

from ilmek.machines.weaver.cam_report import (
    cam_checks,
    cam_results,
    cam_tables,
    cams_drawing,
    cams_table,
    plates,
    torque_plot,
)
from ilmek.machines.weaver.cyclogram import HANDLER, relations
from ilmek.machines.weaver.design import HAND_KNOT, Weaver
from ilmek.machines.weaver.knot_report import knot_checks, knot_results, knot_warnings
from ilmek.machines.weaver.plan_view import moving, plan_view
from ilmek.report import Axis, Check, Column, Plot, Report, Result, Series, Table, Timing, at_most
from ilmek.timing.cyclogram import check_all
from ilmek.timing.figures import draw
from ilmek.timing.track import sample
from ilmek.units import rpm, turn


def report(weaver: Weaver) -> Report:
    """Everything that the head's design says."""
    return Report(
        "weaver",
        "Knotting head",
        weaver.params.as_dict(),
        _results(weaver),
        checks(weaver),
        (_peaks_table(weaver), cams_table(weaver), _motions_table(weaver)),
        (
            timing(weaver),
            plan_view(weaver),
            moving(weaver),
            cams_drawing(weaver),
            _accelerations(weaver),
            torque_plot(weaver),
        ),
        _warnings(weaver),
        plates(weaver),
        cam_tables(weaver),
    )


def checks(weaver: Weaver) -> tuple[Check, ...]:
    """Limits of every track, order of the motions, the carriage's step, and the hand weaver as the measure."""
    params = weaver.params
    limits: list[Check] = []
    for name, peak in weaver.peaks.items():
        # A cycle set by one of these limits meets it up to rounding.
        speed, acceleration = float(f"{peak.speed:.12g}"), float(f"{peak.acceleration:.12g}")
        limits += [
            at_most(f"{name}: speed", speed, params.speed_limit, "m/s", "parameter speed_limit"),
            at_most(f"{name}: acceleration", acceleration, params.acceleration_limit, "m/s^2", "acceleration_limit"),
        ]
    return (
        *limits,
        *check_all(weaver.cyclogram, relations(params.relation_gap)),
        at_most("carriage: step to the next knot", weaver.carriage_step, weaver.carriage_window, "s", "tools out"),
        at_most("knot cycle", weaver.cycle, HAND_KNOT, "s", "best hand weaver: 25 knots a minute"),
        *knot_checks(weaver),
        *cam_checks(weaver),
    )


def timing(weaver: Weaver) -> Timing:
    """The head's cyclogram as a figure."""
    note = "Order of the motions: thesis, 2.2.3; angles chosen, the thesis prints none."
    return draw(weaver.cyclogram, "One knot: the five cams of the head", note)


def _results(weaver: Weaver) -> tuple[Result, ...]:
    return (
        Result("cycle_time_knot", weaver.cycle, "s", "time of a knot"),
        Result("cycle_time_shortest", weaver.shortest, "s", "the shortest that speeds and accelerations allow"),
        Result("cycle_time_set_by", weaver.limiting, "", "the track that sets the shortest cycle"),
        Result("knots_per_minute", 60 / weaver.cycle, "", "knots of one head in a minute, without colour changes"),
        Result("cam_speed", weaver.cyclogram.speed, "rpm", "speed of the cam shaft"),
        Result(
            "speed_max", {name: peak.speed for name, peak in weaver.peaks.items()}, "m/s", "largest speed of each track"
        ),
        Result(
            "acceleration_max",
            {name: p.acceleration for name, p in weaver.peaks.items()},
            "m/s^2",
            "largest acceleration of each track",
        ),
        *knot_results(weaver),
        Result("colour_change_time", weaver.colour_change, "s", "mean time to bring another tube in line"),
        Result("colour_change_longest", weaver.colour_change_longest, "s", "time from the first tube to the last"),
        Result(
            "selector_window",
            weaver.selector_window,
            "s",
            "from cut to next grasp: a selector that knows the next colour could move in it; not counted on",
        ),
        Result("carriage_step_time", weaver.carriage_step, "s", "time of the step to the next knot"),
        Result("carriage_window", weaver.carriage_window, "s", "time in which no tool is in the warps"),
        Result("carriage_travel_time", weaver.travel, "s", "time of each further pitch"),
        *cam_results(weaver),
    )


def _peaks_table(weaver: Weaver) -> Table:
    columns = (
        Column("track"),
        Column("driven by"),
        Column("stroke", "mm"),
        Column("largest speed", "m/s"),
        Column("largest acceleration", "m/s^2"),
        Column("shortest cycle", "s"),
    )
    rows = tuple(
        (track.name, track.actuator, peak.stroke, peak.speed, peak.acceleration, peak.shortest)
        for track, peak in zip(weaver.cyclogram.tracks, weaver.peaks.values(), strict=True)
    )
    return Table("tracks", "Tracks of the head; the handler at its tip", columns, rows)


def _motions_table(weaver: Weaver) -> Table:
    columns = (Column("track"), Column("motion"), Column("from", "deg"), Column("to", "deg"), Column("law"))
    rows = tuple(
        (track.name, part.name, part.start, part.end, part.law.name)
        for track in weaver.cyclogram.tracks
        for part in track.segments
    )
    return Table("motions", "Motions over the cam angle", columns, rows)


def _accelerations(weaver: Weaver) -> Plot:
    angle = np.linspace(0, turn, 721)
    w = weaver.cyclogram.speed
    arms = {HANDLER: weaver.handler_radius}
    series = tuple(
        Series(track.name, angle, sample(track, angle).bend * w**2 * arms.get(track.name, 1.0))
        for track in weaver.cyclogram.tracks
    )
    note = f"at {60 / weaver.cycle:.3g} knots a minute; the handler at its tip"
    return Plot(
        "acceleration",
        "Acceleration of the tools",
        Axis("cam angle", "deg"),
        Axis("acceleration", "m/s^2"),
        series,
        note=note,
    )


def _warnings(weaver: Weaver) -> tuple[str, ...]:
    asked, drive = weaver.params.cycle, weaver.drive
    said = list(knot_warnings(weaver))
    if weaver.cycle > asked:
        longer = f"a knot takes {weaver.cycle:.4g} s, not the {asked:.4g} s asked for"
        said.append(f"{longer}: the limits of the {weaver.limiting} allow no less")
    if drive.motor is None:
        needed = f"{drive.torque_max:.3g} Nm at {weaver.cyclogram.speed / rpm:.3g} rpm"
        said.append(f"no motor of the table gives {needed} of the cam shaft: lighter tools or a longer cycle")
    return tuple(said)
