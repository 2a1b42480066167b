"""The report of a simulated carpet: results, checks, tables."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.jobs.simulate_figures import simulation_figures
from ilmek.loom.twin.carpet_run import FAULT_FIELDS, MOST_FAULTS
from ilmek.loom.twin.statistics import CURES, HIGH, LOW, WORDS, CarpetStatistics
from ilmek.report import Check, Column, Report, Table, at_least, at_most, columns, results_of
from ilmek.units import BILLION, format_quantity, hour

if TYPE_CHECKING:
    from ilmek.machines.automated_loom.energy import Energy

SAME = 1e-6
"""Relative difference of the time without faults from the programme's, which is a sum of rounded numbers."""

MOST_ROWS = 100
"""Largest number of packages that are listed in the table."""


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
        figures=simulation_figures(found, deadline),
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
    complete = at_least("knots of the carpet", found.knots, found.setup.knots, "1", "rows and columns of the chart")
    checks = [complete.with_cure("the programme leaves knots out: `ilmek check` names them")]
    packages = found.packages_used
    if packages:
        least = min(packages, key=lambda one: one.left)
        label = f"head {least.head + 1}, tube {least.tube + 1}, {found.setup.yarns[least.yarn].name}"
        cure = "change that package earlier, or put a longer one on: yarn is lost with failed knots and repairs"
        checks.append(at_least("pile yarn left on a package", least.left, 0.0, "m", label).with_cure(cure))
    if deadline is not None:
        runs = len(found.times.values)
        source = f"the deadline given, for {HIGH:.0%} of {runs} runs" if runs > 1 else "the deadline given, of one run"
        cure = "give more time, more heads, or see the losses"
        checks.append(at_most("weaving time", found.times.at(HIGH), deadline, "h", source).with_cure(cure))
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
    losses = tuple((WORDS[loss["use"]], loss["time"], loss["share"], CURES[loss["use"]]) for loss in found.losses)
    heads = tuple(
        (str(head["head"]), *(head[use] for use in WORDS), head["changes"], head["last"]) for head in found.heads
    )
    stops = tuple(
        (
            stop["cause"], stop["faults"], "–" if stop["mean_faults"] is None else stop["mean_faults"], stop["calls"],
            stop["operator_time"], stop["standstill"],
        )
        for stop in found.stops
    )  # fmt: skip
    yarn = tuple(
        (one["name"], one["knots"], one["tied"], one["lost"], one["left"], one["packages"]) for one in found.yarn
    )
    packages = tuple(tuple(package.values()) for package in found.packages[:MOST_ROWS])
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
