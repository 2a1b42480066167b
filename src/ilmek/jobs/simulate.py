"""A programme woven in time: one run with all its events, and the runs of many seeds."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ilmek.errors import ParameterError
from ilmek.io.any_programme import OpenProgramme, open_any_programme
from ilmek.io.output import Outputs, joined
from ilmek.io.programme_file import ProgrammeFile
from ilmek.io.stops_file import read_stops
from ilmek.io.table_csv import csv_text
from ilmek.jobs.deadline import read_deadline
from ilmek.jobs.page import page_text
from ilmek.jobs.simulate_report import fault_columns, row_columns, simulation_report
from ilmek.jobs.simulate_runs import runs_of
from ilmek.loom.twin.carpet_run import CarpetRun, run_carpet
from ilmek.loom.twin.faults import StopParams, fault_table
from ilmek.loom.twin.row_motion import row_in_motion
from ilmek.loom.twin.seed_runs import MOST_SEEDS
from ilmek.loom.twin.statistics import CarpetStatistics
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject
from ilmek.report import Report
from ilmek.studies.workers import MOST_WORKERS

GREATEST_SEED = 2**53
"""Largest seed, which JSON keeps."""

SEEDS = 200
"""Runs for the band, where none is given."""


@dataclass(frozen=True, slots=True)
class SimulationOrder:
    """What is to be simulated.

    file      the programme                        params    stops and operator
    seed      of the run; the band's are those from it on
    seeds     runs for the band; 0: none           loom      file of the loom, for the energy
    deadline  of the weaving [s]                   workers   processes, None: chosen
    cluster   address of a Dask scheduler          row       loom row that is shown in motion; None: the longest
    """

    file: Path
    params: StopParams = StopParams()
    seed: int = 0
    seeds: int = SEEDS
    loom: Path | None = None
    deadline: float | None = None
    workers: int | None = None
    cluster: str | None = None
    row: int | None = None

    def __post_init__(self) -> None:
        for name, value, least, most in (
            ("--seed", self.seed, 0, GREATEST_SEED - MOST_SEEDS),
            ("--seeds", self.seeds, 0, MOST_SEEDS),
            ("--workers", 1 if self.workers is None else self.workers, 1, MOST_WORKERS),
        ):
            if not least <= value <= most:
                raise ParameterError(f"{name} {value}", allowed=f"{least} to {most}")


@dataclass(frozen=True, slots=True)
class SimulationResult:
    """A simulated carpet: its run, its statistics and its report; files: the paths of what was written."""

    run: CarpetRun
    found: CarpetStatistics
    report: Report
    files: tuple[str, ...] = ()

    def as_json(self) -> JsonObject:
        """The JSON of the job: the report's, and the files."""
        return {**self.report.as_json(), "job": "simulate", "files": list(self.files)}


def read_simulation_order(
    file: Path,
    *,
    stops: Path | None = None,
    settings: Mapping[str, Setting] = MappingProxyType({}),
    without_faults: bool = False,
    deadline: str | None = None,
    **more: Any,
) -> SimulationOrder:
    """The order of a simulation, from texts.

    stops     file of settings; those in `settings` replace them      without_faults  the loom stops only as planned
    deadline  like 72h                                                more            as in `SimulationOrder`
    Raises ParameterError, UnitError, LoomError.
    """
    params = read_stops(stops, settings)
    params = params.without_faults() if without_faults else params
    return SimulationOrder(file, params, deadline=None if deadline is None else read_deadline(deadline), **more)


def simulate(
    order: SimulationOrder,
    folder: Path | None = None,
    *,
    rows: bool = False,
    outputs: Outputs | None = None,
    force: bool = False,
    progress: Progress = SILENT,
) -> SimulationResult:
    """Weave a programme in time; where a folder is given, write simulation.html, simulation.json and stops.csv into it.

    rows  rows.csv as well
    Raises LoomError for a file that is no whole programme, and a loom that is not that of the programme; Cancelled.
    """
    with joined(outputs, force=force, progress=progress) as made:
        if folder is not None:
            made.expect_folder(folder, "--out")
        with open_any_programme(order.file, progress=progress.part(0.0, 0.3, "programme")) as programme:
            result = _simulated(order, programme, progress)
        return result if folder is None else _written(result, folder, rows, made)


def _simulated(order: SimulationOrder, programme: OpenProgramme, progress: Progress) -> SimulationResult:
    params, setup = order.params, programme.setup
    if order.row is not None and not 0 <= order.row < setup.rows:
        raise ParameterError(f"--row {order.row + 1}", allowed=f"1 to {setup.rows}")
    table = fault_table(params, setup)
    run = run_carpet(programme, table, order.seed, waste=params.waste, progress=progress.part(0.3, 0.6, "knots"))
    part = progress.part(0.6, 0.95, "runs")
    sums = run.sums[None][:0]
    if order.seeds:
        sums = runs_of(programme, order.file, params, order.seed, order.seeds, order.workers, order.cluster, part)
    statistics = CarpetStatistics(run, setup, params, sums)
    energy = None
    if order.loom is not None:
        from ilmek.jobs.simulate_energy import energy_of_run  # brings all machines

        energy = energy_of_run(order.loom, statistics)
    stated = programme.totals.duration if isinstance(programme, ProgrammeFile) else None
    report = simulation_report(order.file.name, statistics, stated, order.deadline, energy)
    moving = row_in_motion(setup, programme.operations(run.slowest[0] if order.row is None else order.row))
    return SimulationResult(run, statistics, replace(report, figures=(*report.figures, moving)))


def _written(result: SimulationResult, folder: Path, rows: bool, outputs: Outputs) -> SimulationResult:
    """The result with its files in a folder."""
    from ilmek.io.json_file import write_json

    left_out: list[str] = []
    texts = {
        "simulation.html": page_text(result.report, left_out),
        "stops.csv": csv_text(fault_columns(result.found)),
        "rows.csv": csv_text(row_columns(result.found)) if rows else None,
    }
    names = [name for name, text in texts.items() if text is not None]
    simulation_result = SimulationResult(
        result.run, result.found, result.report, tuple(str(folder / name) for name in (*names, "simulation.json"))
    )
    with outputs.folder(folder) as work:
        for name in names:
            (work / name).write_text(texts[name] or "", encoding="utf-8")
        found = simulation_result.as_json()
        write_json(work / "simulation.json", {**found, "warnings": [*found["warnings"], *left_out]})
    return simulation_result
