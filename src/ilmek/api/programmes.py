"""Programmes of looms: proved, read, converted, simulated, woven, written for a PLC; and plans of many carpets."""

from __future__ import annotations  # so that `help` shows the aliases

from datetime import datetime
from pathlib import Path
from types import MappingProxyType

from ilmek.api.carpets import Settings
from ilmek.arguments import Arguments, Quantity
from ilmek.errors import ParameterError
from ilmek.io.output.outputs import Outputs
from ilmek.io.plan_file import read_instant
from ilmek.io.plc.targets import TARGETS
from ilmek.jobs.check import CheckResult, check_programme
from ilmek.jobs.convert import convert_programme
from ilmek.jobs.inspect import InspectionResult, inspect_programme
from ilmek.jobs.plan import AIMS, LEAST_LIMIT, MOST_LIMIT, PlanResult, plan_factory
from ilmek.jobs.plc.program import PlcResult, write_plc
from ilmek.jobs.run.loom_run import LoomRun
from ilmek.jobs.run.order import read_run_order
from ilmek.jobs.run.result import RunResult
from ilmek.jobs.simulate import SimulationResult, read_simulation_order, simulate
from ilmek.loom.operations import LoomSetup
from ilmek.progress import SILENT, Progress

_GIVEN = Arguments("a programme")


def check(programme: str | Path, loom: str | Path | None = None, *, progress: Progress = SILENT) -> CheckResult:
    """Prove the programme of a file: every knot of its chart once, no head in another's way, no rule broken.

    loom  file of the loom that it must be for; default: any loom
    `result.ok` and `result.errors`, each with its line. Raises LoomError for a file that is no programme, or no loom;
    Cancelled.

    >>> check("examples/small_programme.txt").ok
    True
    """
    on = _GIVEN.record("progress", progress, Progress)
    return check_programme(_file(programme), None if loom is None else _GIVEN.path("loom", loom), progress=on)


def inspect(programme: str | Path, row: int | None = None, *, progress: Progress = SILENT) -> InspectionResult:
    """The statistics of a programme, its stops, and one of its rows.

    row  from 1 at the bottom edge; default: a random one
    Raises LoomError for a file that is no programme, and for a row beyond the carpet; Cancelled.

    >>> import tempfile
    >>> programme = Path(tempfile.mkdtemp()) / "programme.ilmek"
    >>> setup = convert("examples/small_programme.txt", programme)
    >>> [ties.pairs.size for ties in inspect(programme, 2).ties]
    [12, 12]
    """
    number = None if row is None else _GIVEN.whole("row", row, least=1)
    return inspect_programme(_file(programme), number, progress=_GIVEN.record("progress", progress, Progress))


def convert(source: str | Path, target: str | Path, *, force: bool = False, progress: Progress = SILENT) -> LoomSetup:
    """Write a programme in the form of the target's ending: .ilmek or .txt.

    force  replace an existing file
    Raises ParameterError for another ending, LoomError for a file that is no programme, OutputError; Cancelled.

    >>> import tempfile
    >>> target = Path(tempfile.mkdtemp()) / "programme.ilmek"
    >>> convert("examples/small_programme.txt", target).knots, check(target).ok
    (144, True)
    """
    file, on = _GIVEN.path("target", target), _GIVEN.record("progress", progress, Progress)
    with Outputs(force=_GIVEN.flag("force", force)) as outputs:
        return convert_programme(_GIVEN.path("source", source), file, outputs=outputs, progress=on)


def simulate_loom(
    programme: str | Path,
    *,
    settings: Settings = MappingProxyType({}),
    seed: int = 0,
    seeds: int = 0,
    deadline: str | None = None,
    progress: Progress = SILENT,
) -> SimulationResult:
    """Weave a programme in time on the twin of its loom, with stops and an operator.

    settings  rates of stops and the operator's times, by name, as of `ilmek simulate --set`
    seed      of the run          seeds  further runs for the band of the weaving time; 0: none
    deadline  of the weaving, like "72h"
    `result.report` has times, stops and figures. Raises LoomError, ParameterError; Cancelled.

    >>> simulate_loom("examples/small_programme.txt", seed=1).report.failed
    ()
    """
    order = read_simulation_order(
        _file(programme),
        settings=_GIVEN.mapping("settings", settings, lambda _, value: value),
        deadline=None if deadline is None else _GIVEN.text("deadline", deadline),
        seed=_GIVEN.whole("seed", seed),
        seeds=_GIVEN.whole("seeds", seeds),
        workers=1,
    )
    return simulate(order, progress=_GIVEN.record("progress", progress, Progress))


def run_loom(
    programme: str | Path,
    *,
    journal: str | Path | None = None,
    new: bool = False,
    faults: int | None = None,
    rates: Settings = MappingProxyType({}),
) -> RunResult:
    """Weave a programme on the simulated loom under the controller with its journal, as fast as possible.

    journal  folder; default: beside the programme, NAME.journal. A run that was interrupted goes on where it stopped
    new      begin another carpet
    faults   seed of simulated faults; default: none        rates  of them, by name
    `result.ok`: the carpet is complete and equal to its chart. Raises LoomError, ParameterError, OutputError.

    >>> import tempfile
    >>> result = run_loom("examples/small_programme.txt", journal=Path(tempfile.mkdtemp()) / "journal", faults=7)
    >>> result.state, result.ok
    ('Complete', True)
    """
    order = read_run_order(
        _file(programme),
        "max",
        None if journal is None else _GIVEN.path("journal", journal),
        new=_GIVEN.flag("new", new),
        faults=None if faults is None else str(_GIVEN.whole("faults", faults, most=2**53)),
        settings=_GIVEN.mapping("rates", rates, lambda _, value: value),
    )
    with LoomRun(order) as run:
        if not run.complete:
            run.work()
        return run.result()


def plc(
    programme: str | Path,
    out: str | Path,
    *,
    target: str = "codesys",
    force: bool = False,
    progress: Progress = SILENT,
) -> PlcResult:
    """Write the control program for a PLC, its list of signals, and the rows for its host into the folder `out`.

    target  codesys, twincat, tia, openplc      force  replace a folder that ilmek made
    Raises LoomError for a file that is no programme and rows too wide for a PLC; OutputError; Cancelled.

    >>> import tempfile
    >>> plc("examples/small_programme.txt", Path(tempfile.mkdtemp()) / "plc", target="openplc").files[0]
    'loom.st'
    """
    chosen, folder = _GIVEN.one_of("target", target, TARGETS), _GIVEN.path("out", out)
    with Outputs(force=_GIVEN.flag("force", force)) as outputs:
        on = _GIVEN.record("progress", progress, Progress)
        return write_plc(_file(programme), folder, target=chosen, outputs=outputs, progress=on)


def plan(
    orders: str | Path,
    looms: str | Path,
    *,
    time_limit: Quantity | None = None,
    now: str | datetime | None = None,
    against: str | Path | None = None,
    aim: str = "cost",
    progress: Progress = SILENT,
) -> PlanResult:
    """Plan the orders of a file on the looms of another: which carpet on which loom when, at the least cost.

    time_limit  of the search [s], like "60s"; default: by the number of carpets
    now         begin of the plan, "2026-12-03T10:00": what is on the looms stays; default: that of the file
    against     plan.json of an earlier plan, with whose ends those of the orders are compared
    aim         "cost": the least; "late": the fewest late carpets, then the least cost
    Raises an IlmekError, with file and line, for what cannot be read; Cancelled.

    >>> import shutil, tempfile
    >>> folder = Path(tempfile.mkdtemp())
    >>> copy = shutil.copy("examples/medallion.png", folder)
    >>> orders = folder / "orders.toml"
    >>> words = ["start = 2026-12-01T06:00:00", "[[order]]", "picture = 'medallion.png'", "due = 2026-12-18"]
    >>> wishes = ["late = '40 EUR/d'", "name = 'Rug'", "size = '30x40cm'", "quality = '10x10/dm'", "colours = 4"]
    >>> written = orders.write_text(chr(10).join([*words, *wishes]))
    >>> result = plan(orders, "examples/looms.toml", time_limit="1s")
    >>> len(result.inputs.orders)
    1
    """
    given = Arguments("a plan")
    limit = None if time_limit is None else given.number("time_limit", time_limit, "s", most=MOST_LIMIT)
    if limit is not None and limit < LEAST_LIMIT:
        raise ParameterError(f"a time_limit of {limit:g} s", allowed=f"{LEAST_LIMIT:g} s to {MOST_LIMIT:g} s")
    on = given.record("progress", progress, Progress)
    return plan_factory(
        given.path("orders", orders),
        given.path("looms", looms),
        time_limit=limit,
        now=None if now is None else read_instant("now", now),
        against=None if against is None else given.path("against", against),
        aim=given.one_of("aim", aim, AIMS),
        progress=on,
    )


def _file(programme: object) -> Path:
    return _GIVEN.path("programme", programme)
