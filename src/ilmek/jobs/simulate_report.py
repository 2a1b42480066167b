"""The report of a simulated carpet: results, checks, tables, figures."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ilmek.arrays import FloatArray, IntArray
from ilmek.loom.twin.carpet_run import FAULT_FIELDS, MOST_FAULTS
from ilmek.loom.twin.durations import BILLION, durations_of
from ilmek.loom.twin.kernel import CHANGED, DONE, NO_HEAD
from ilmek.loom.twin.statistics import CURES, HIGH, LOW, WORDS, CarpetStatistics, seconds
from ilmek.report import (
    Axis,
    Check,
    Column,
    Figure,
    Gantt,
    GanttLane,
    Mark,
    Plot,
    Report,
    Series,
    StackedBars,
    Table,
    at_least,
    at_most,
    columns,
    results_of,
)  # fmt: skip
from ilmek.units import format_quantity, hour

if TYPE_CHECKING:
    from ilmek.machines.automated_loom.energy import Energy

SAME = 1e-6
"""Relative difference of the time without faults from the programme's, which is a sum of rounded numbers."""

MOST_ROWS = 100
"""Largest number of packages that are listed in the table."""

_SPANS = 4000
"""Largest number of stops that are drawn."""

_WEAVES, _WAITS, _STOPS = range(3)
_KNOT, _MOVE, _END, _CHANGE, _FAILED, _WAIT = range(6)
_BEFORE, _WAITING = -1, -2


def simulation_report(
    name: str, found: CarpetStatistics, planned: float | None, deadline: float | None, energy: "Energy | None"
) -> Report:
    """The report of a run and its band.

    name  of the programme's file      planned  weaving time of the programme [s]      deadline  of the weaving [s]
    """
    params = {**found.params.as_dict(), "seed": found.run.seed, "seeds": len(found.seeds)}
    return Report(
        machine="simulate",
        title=f"Simulation of {name}",
        parameters=params,
        results=results_of(found, energy),
        checks=_checks(found, deadline),
        tables=_tables(found, energy),
        figures=_figures(found, deadline),
        warnings=_warnings(found, energy),
        headline=("time", "knots", "digest", "utilisation"),
        self_tests=_self_tests(found, planned),
        lead=_lead(found),
    )


def _lead(found: CarpetStatistics) -> str:
    """The result in a sentence."""
    band, unit = found.times, "h" if found.time >= hour else "min"
    low, middle, high, only = (
        format_quantity(time, unit) for time in (band.at(LOW), band.at(0.5), band.at(HIGH), found.time)
    )
    if len(band.values) == 1:
        return f"{found.knots:,} knots, woven in {only}"
    return f"{found.knots:,} knots, woven in {middle}; 90 % of {len(band.values):,} runs between {low} and {high}"


def _checks(found: CarpetStatistics, deadline: float | None) -> tuple[Check, ...]:
    checks = [at_least(
        "knots of the carpet", found.knots, found.setup.knots, "1", "rows and columns of the chart",
        cure="the programme leaves knots out: `ilmek check` names them",
    )]  # fmt: skip
    packages = found.packages_used
    if packages:
        least = min(packages, key=lambda one: one.left)
        label = f"head {least.head + 1}, tube {least.tube + 1}, {found.setup.yarns[least.yarn].name}"
        cure = "change that package earlier, or put a longer one on: yarn is lost with failed knots and repairs"
        checks.append(at_least("pile yarn left on a package", least.left, 0.0, "m", label, cure=cure))
    if deadline is not None:
        runs = len(found.times.values)
        source = f"the deadline given, for {HIGH:.0%} of {runs} runs" if runs > 1 else "the deadline given, of one run"
        cure = "give more time, more heads, or see the losses"
        checks.append(at_most("weaving time", found.times.at(HIGH), deadline, "h", source, cure=cure))
    return tuple(checks)


def _self_tests(found: CarpetStatistics, planned: float | None) -> tuple[Check, ...]:
    """The run beside the programme's own time, its accounts, and the same seed among the many."""
    run = found.run
    used = np.abs(run.uses.sum(axis=(0, 2)) - run.time).max()
    tests = [at_most("time of the heads beside the run's", float(used), 0.0, "1", "uses add up, in nanoseconds")]
    if planned:
        apart = abs(run.base / BILLION / planned - 1)
        tests.append(at_most("time without faults beside the programme's", apart, SAME, "1", "rules of time"))
    if len(found.seeds):
        differs = np.abs(found.seeds[0] - run.sums).max()
        tests.append(at_most("the seed alone beside it among the runs", float(differs), 0.0, "1", "equal sums"))
    return tuple(tests)


def _warnings(found: CarpetStatistics, energy: "Energy | None") -> tuple[str, ...]:
    texts = []
    if energy is None:
        texts.append("no energy: give the loom's machine.json with --loom")
    if len(found.run.faults) == MOST_FAULTS:
        texts.append(f"stops.csv and the pictures have the first {MOST_FAULTS:,} faults")
    if len(found.seeds) == 0:
        texts.append("no band: one run alone; give --seeds")
    return tuple(texts)


def _tables(found: CarpetStatistics, energy: "Energy | None") -> tuple[Table, ...]:
    losses = tuple((WORDS[one["use"]], one["time"], one["share"], CURES[one["use"]]) for one in found.losses)
    heads = tuple((str(one["head"]), *(one[use] for use in WORDS), one["changes"], one["last"]) for one in found.heads)
    stops = tuple(
        (
            one["cause"], one["faults"], "–" if one["mean_faults"] is None else one["mean_faults"], one["calls"],
            one["operator_time"], one["standstill"],
        )
        for one in found.stops
    )  # fmt: skip
    yarn = tuple(
        (one["name"], one["knots"], one["tied"], one["lost"], one["left"], one["packages"]) for one in found.yarn
    )
    packages = tuple(tuple(one.values()) for one in found.packages[:MOST_ROWS])
    power = tuple((name, joules) for name, joules in (energy.shares.items() if energy else ()))
    tables = [
        Table("losses", "Where the time goes, mean of the heads",
              columns("use", "time [h] 3", "share of the time [%] 3", "what would shorten it"), losses, brief=True),
        Table("stops", "Stops by cause",
              columns("cause", "faults", Column("mean of the runs", "", 3), "calls", "operator's time [min] 3",
                      "standstill [min] 3"), stops, brief=True),
        Table("heads", "Heads: share of the weaving time",
              columns("head", *(f"{words} [%] 3" for words in WORDS.values()), "changes", "last of a phase"), heads),
        Table("yarn", "Pile yarn by colour",
              columns("yarn", "knots", "tied [m] 5", "lost [m] 3", "left [m] 5", "packages"), yarn),
        Table("packages", _first("Packages by head and tube", len(found.packages)),
              columns("head", "tube", "yarn", "length [m] 5", "used [m] 5", "left [m] 5"), packages),
        Table("energy", "Energy by consumer", columns("consumer", "energy [kWh] 3"), power),
    ]  # fmt: skip
    return tuple(table for table in tables if table.rows)


def _first(title: str, number: int) -> str:
    return f"{title}, the first {MOST_ROWS} of {number:,}" if number > MOST_ROWS else title


def _figures(found: CarpetStatistics, deadline: float | None) -> tuple[Figure, ...]:
    several, detailed = len(found.times.values) > 1, len(found.run.slowest[2]) > 0
    band, row = ([_band(found, deadline)] if several else []), ([_row(found)] if detailed else [])
    return (_carpet(found), *band, _progress(found), _uses(found), *row)


def _carpet(found: CarpetStatistics) -> Gantt:
    """Every head over the carpet: weaving, waiting for the operator, planned stops."""
    run, heads = found.run, found.setup.heads
    faults = run.faults[run.faults[:, 6] >= 0]
    own = [faults[(faults[:, 1] == head) | (faults[:, 1] < 0)][:_SPANS] for head in range(heads)]
    if found.params.others == "stop":
        own = [faults[:_SPANS]] * heads
    planned = np.flatnonzero(run.rows[:, 3])[:_SPANS]
    begins = np.concatenate([[0], run.rows[:-1, 0]])[planned]
    lanes = []
    for head in range(heads):
        calls, waits = own[head][:, 6], own[head][:, 7]
        starts = np.concatenate([[0], calls, begins])
        ends = np.concatenate([[run.time], calls + waits, begins + run.rows[planned, 3]])
        kinds = np.repeat([_WEAVES, _WAITS, _STOPS], [1, len(calls), len(begins)])
        order = np.argsort(starts, kind="stable")
        lanes.append(GanttLane(f"head {head + 1}", starts[order] / BILLION, ends[order] / BILLION, kinds[order]))
    note = "Short stops are drawn wider than they are. Planned stops are drawn at the begin of their row."
    names = ("weaving", "waiting for the operator", "planned stop")
    return Gantt("carpet", "The heads over the carpet", Axis("time", "h"), tuple(lanes), names, note, pale=1)


def _row(found: CarpetStatistics) -> Gantt:
    """Every head over the row that took longest."""
    number, begin, events = found.run.slowest
    head, knot = events[:, 3] >> 16, durations_of(found.setup.times).knot
    faults = found.run.faults
    faults = faults[(faults[:, 0] == number) & (faults[:, 6] >= 0)]
    halts = faults[faults[:, 1] >= 0] if found.params.others == "stop" else faults[:0]
    lanes = []
    for index in range(found.setup.heads):
        tied = _split(_cut(events[head == index], halts), knot)
        waits = _waits(halts if len(halts) else faults[faults[:, 1] == index])
        lanes.append(_lane(f"head {index + 1}", np.concatenate([tied, waits]), begin))
    lanes.append(_lane("loom", np.concatenate([events[head == NO_HEAD], _waits(faults[faults[:, 1] < 0])]), begin))
    kinds = ("knot", "colour change, travel", "weft, beat, take-up", "change of a package", "failed attempt",
             "waiting for the operator")  # fmt: skip
    note = "White: the head waits for a slower one, or the loom is at the row's end."
    return Gantt("row", f"Row {number + 1}, which took longest", Axis("time from the row's begin", "s"), tuple(lanes),
                 kinds, note)  # fmt: skip


def _waits(faults: IntArray) -> IntArray:
    """The waits of faults as events."""
    calls, waits = faults[:, 6], faults[:, 7]
    return np.stack([calls, calls + waits, calls, np.full(len(calls), _WAITING)], axis=1)


def _cut(events: IntArray, halts: IntArray) -> IntArray:
    """The events of a head without the standstills of the loom in them."""
    for call, wait in halts[:, 6:8].tolist():
        inside = (events[:, 0] < call) & (events[:, 1] > call + wait)
        first, last = events[inside].copy(), events[inside].copy()
        first[:, 1], last[:, 0] = call, call + wait
        events = np.concatenate([events[~inside], first, last])
    return events


def _split(events: IntArray, knot: int) -> IntArray:
    """The events of a head, with the colour change and the travel before a knot apart."""
    before = events[events[:, 1] - events[:, 0] > knot].copy()
    before[:, 1] -= knot
    before[:, 3] = _BEFORE
    knots = events.copy()
    knots[:, 0] = np.maximum(events[:, 0], events[:, 1] - knot)
    return np.concatenate([before, knots])


def _lane(name: str, events: IntArray, begin: int) -> GanttLane:
    outcome, loom = events[:, 3] & 255, events[:, 3] >> 16 == NO_HEAD
    cases = {
        _MOVE: events[:, 3] == _BEFORE,
        _WAIT: events[:, 3] == _WAITING,
        _END: (outcome == DONE) & loom,
        _KNOT: outcome == DONE,
        _CHANGE: outcome == CHANGED,
    }
    kinds = np.select(list(cases.values()), list(cases), _FAILED)
    order = np.argsort(events[:, 0], kind="stable")
    starts, ends = (events[order, column] - begin for column in (0, 1))
    return GanttLane(name, starts / BILLION, ends / BILLION, kinds[order])


def _uses(found: CarpetStatistics) -> StackedBars:
    bars = tuple(f"head {head + 1}" for head in range(found.setup.heads))
    title = "What each head's time is used for"
    return StackedBars("uses", title, Axis("time", "h"), bars, tuple(WORDS.values()), found.by_head)


def _progress(found: CarpetStatistics) -> Plot:
    """Share of the heads' time for tying, waiting and stops, over the rows of the carpet."""
    run = found.run
    uses = run.uses.sum(axis=1).astype(float)
    rows = np.minimum((np.arange(len(uses)) + 0.5) * run.rows_per_bin, found.setup.rows)
    total = uses.sum(axis=1)
    shown = {words: 100 * uses[:, index] / total for index, words in enumerate(WORDS.values())}
    kept = {words: values for words, values in shown.items() if values.max() >= 1.0}
    series = tuple(Series(words, rows, values) for words, values in kept.items())
    note = f"Mean of the heads over {run.rows_per_bin} rows; left out: what never has 1 %."
    return Plot("shares", "Use of the time over the rows", Axis("row"), Axis("share of the heads' time [%]"), series,
                note=note)  # fmt: skip


def _band(found: CarpetStatistics, deadline: float | None) -> Plot:
    """Share of the runs that have ended by a time."""
    times = np.sort(found.times.values)
    share = 100 * (np.arange(len(times)) + 1) / len(times)
    step_x, step_y = np.repeat(times, 2), np.concatenate([[0.0], np.repeat(share, 2)[:-1]])
    marks = [Mark(found.times.at(LOW), "5 %"), Mark(found.times.at(0.5), "median"), Mark(found.times.at(HIGH), "95 %")]
    if deadline is not None:
        marks.append(Mark(deadline, "deadline"))
    unit = "h" if times[-1] >= hour else "min"
    marks.append(Mark(seconds(found.run.base), "without faults"))
    note = f"{len(times)} runs, seeds {found.run.seed} to {found.run.seed + len(times) - 1}."
    return Plot("band", "When the carpet is woven", Axis("weaving time", unit), Axis("runs that have ended [%]"),
                (Series("runs", step_x, step_y),), tuple(marks), note)  # fmt: skip


def row_columns(found: CarpetStatistics) -> Mapping[str, FloatArray]:
    """A line for each loom row, from 1 at the bottom: end, time of its knots, standstill, planned stops."""
    rows = found.run.rows
    names = ("end [s]", "knots [s]", "standstill [s]", "planned stops [s]")
    shown = {"row": np.arange(1.0, len(rows) + 1)}
    return {**shown, **{name: rows[:, index] / BILLION for index, name in enumerate(names)}}


def fault_columns(found: CarpetStatistics) -> Mapping[str, FloatArray]:
    """A line for each fault; rows, heads, columns and tubes from 1; empty: of the whole loom, or without a call.

    cause  its number in the list of `stops` of the JSON, from 1
    """
    faults = found.run.faults.astype(float)
    columns_of = {name: faults[:, index] for index, name in enumerate(FAULT_FIELDS)}
    counted = {
        name: np.where(columns_of[name] < 0, np.nan, columns_of[name] + 1)
        for name in ("row", "head", "column", "tube", "cause")
    }
    calls = np.where(columns_of["call"] < 0, np.nan, columns_of["call"] / BILLION)
    return {**counted, "attempts": columns_of["attempts"], "call [s]": calls, "wait [s]": columns_of["wait"] / BILLION}
