"""The figures of a simulated carpet."""

import numpy as np

from ilmek.arrays import IntArray
from ilmek.loom.twin.durations import durations_of
from ilmek.loom.twin.kernel import CHANGED, DONE, NO_HEAD
from ilmek.loom.twin.statistics import HIGH, LOW, WORDS, CarpetStatistics, seconds
from ilmek.report import Axis, Figure, Gantt, GanttLane, Mark, Plot, Series, StackedBars
from ilmek.units import BILLION, hour

MOST_HEADS_DRAWN = 40
"""Largest number of heads in a figure."""

_SPANS = 4000
"""Largest number of stops that are drawn."""

_WEAVES, _WAITS, _STOPS = range(3)
_KNOT, _MOVE, _END, _CHANGE, _FAILED, _WAIT = range(6)
_BEFORE, _WAITING = -1, -2


def simulation_figures(found: CarpetStatistics, deadline: float | None) -> tuple[Figure, ...]:
    """The figures of a run and its band. deadline: of the weaving [s]."""
    several, detailed = len(found.times.values) > 1, len(found.run.slowest[2]) > 0
    band, row = ([_band(found, deadline)] if several else []), ([_row(found)] if detailed else [])
    stops = [_stops(found)] if found.run.lost.any() else []
    return (_carpet(found), *band, _progress(found), _uses(found), *stops, *row)


def _shown_heads(found: CarpetStatistics) -> int:
    return min(found.setup.heads, MOST_HEADS_DRAWN)


def _first_heads(found: CarpetStatistics) -> str:
    heads = found.setup.heads
    return f" The first {MOST_HEADS_DRAWN} of {heads} heads." if heads > MOST_HEADS_DRAWN else ""


def _stops(found: CarpetStatistics) -> StackedBars:
    """Standstill of the loom and work of the operator by cause."""
    stops = [stop for stop in found.stops if stop["faults"]]
    lost = np.array([stop["standstill"] for stop in stops])
    beside = np.maximum(np.array([stop["operator_time"] for stop in stops]) - lost, 0.0)
    note = "The operator's time counts from the call to the end of the repair; in the rest of it other heads tie knots."
    kinds = ("standstill of the loom", "operator, while heads tie knots")
    bars = tuple(f"{stop['cause']} ({stop['faults']})" for stop in stops)
    values = tuple(np.column_stack([lost, beside]))
    return StackedBars("stops", "Stops by cause (faults)", Axis("time", "min"), bars, kinds, values, note)


def _carpet(found: CarpetStatistics) -> Gantt:
    """Every head over the carpet: weaving, waiting for the operator, planned stops."""
    run, heads = found.run, _shown_heads(found)
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
    note += _first_heads(found)
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
    for index in range(_shown_heads(found)):
        tied = _split(_cut(events[head == index], halts), knot)
        waits = _waits(halts if len(halts) else faults[faults[:, 1] == index])
        lanes.append(_lane(f"head {index + 1}", np.concatenate([tied, waits]), begin))
    lanes.append(_lane("loom", np.concatenate([events[head == NO_HEAD], _waits(faults[faults[:, 1] < 0])]), begin))
    kinds = ("knot", "colour change, travel", "weft, beat, take-up", "change of a package", "failed attempt",
             "waiting for the operator")  # fmt: skip
    note = "White: the head waits for a slower one, or the loom is at the row's end." + _first_heads(found)
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
    bars = tuple(f"head {head + 1}" for head in range(_shown_heads(found)))
    title = "What each head's time is used for"
    return StackedBars("uses", title, Axis("time", "h"), bars, tuple(WORDS.values()),
                       tuple(found.by_head[: len(bars)]), _first_heads(found).strip())  # fmt: skip


def _progress(found: CarpetStatistics) -> Plot:
    """Share of the heads' time for tying, waiting and stops, over the rows of the carpet."""
    run = found.run
    uses = run.uses.sum(axis=1).astype(float)
    rows = np.minimum((np.arange(len(uses)) + 0.5) * run.rows_per_bin, found.setup.rows)
    total = uses.sum(axis=1)
    shown = {words: 100 * uses[:, index] / total for index, words in enumerate(WORDS.values())}
    kept = {words: values for words, values in shown.items() if values.max() >= 1.0}
    series = tuple(Series(words, rows, values) for words, values in kept.items())
    rows_of = "one row" if run.rows_per_bin == 1 else f"{run.rows_per_bin} rows"
    note = f"Mean of the heads over {rows_of}; left out: what never has 1 %."
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
