"""`ilmek simulate`: a programme woven in time, with stops at stated rates."""

from pathlib import Path
from typing import Any

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import animation_option, file_option, force_option, json_option, stops_option
from ilmek.cli.settings import read_settings, setting_files
from ilmek.cli.terminal import note, say, show_pairs, show_table
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict
from ilmek.errors import ParameterError
from ilmek.jobs.simulate import SEEDS, SimulationResult, read_simulation_order, simulate
from ilmek.loom.twin.faults import StopParams
from ilmek.params import declared
from ilmek.report import Table
from ilmek.units import format_quantity

EXAMPLES = """\b
Examples:
  ilmek simulate carpet/programme.ilmek
  ilmek simulate carpet/programme.ilmek --seed 7 --seeds 1000 --deadline 72h --out simulation
  ilmek simulate carpet/programme.ilmek --set gripper_miss=0.002 --set response=3min --set others=stop
  ilmek simulate carpet/programme.ilmek --stops stops.toml --loom carpet/machine.json --json -
  ilmek simulate carpet/programme.ilmek --no-faults --seeds 0 --json -
  ilmek simulate carpet/programme.ilmek --row 120 --animation row.gif
  ilmek simulate --parameters

Limits: programme 1,000 MB; stops file 250 kB; 1,000,000 seeds; 64 processes.
"""


def _show_parameters(context: click.Context, _option: click.Parameter, value: bool) -> None:
    if not value:
        return
    rows = []
    for one in declared(StopParams):
        default = one.default if isinstance(one.default, str) else format_quantity(float(one.default or 0), one.unit, 6)
        rows.append((one.name, default, one.allowed().removeprefix("allowed: "), one.doc))
    show_table(("parameter", "default", "allowed", "meaning"), rows)
    context.exit()


@click.command(epilog=EXAMPLES)
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE")
@click.option("--seed", type=int, default=0, show_default=True, metavar="N", help="Seed of the run that is shown.")
@click.option(
    "--seeds", type=int, default=SEEDS, show_default=True, metavar="K", help="Runs for the band; 0: only the one run."
)
@stops_option
@click.option("--set", "settings", multiple=True, metavar="NAME=VALUE", help="Set a rate or a time: see --parameters.")
@click.option("--no-faults", "without_faults", is_flag=True, help="Stop only as planned: all rates are 0.")
@click.option("--deadline", metavar="TIME", help="Check that 95 % of the runs are woven in this time, like 72h.")
@file_option("--loom", "FILE.json", "Loom of the programme, for the energy.")
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Write page, JSON and tables to a folder.")
@click.option(
    "--row", "number", type=int, metavar="N", help="Row shown in motion, from 1 at the bottom; default: the longest."
)
@animation_option
@click.option("--shown", type=click.Choice(("rows",)), help="Write a table of all rows into --out as well.")
@click.option("--workers", type=int, metavar="N", help="Processes for the runs; default: by the work.")
@click.option("--cluster", metavar="ADDRESS", help="Dask scheduler for the runs, which needs the extra cluster.")
@click.option(
    "--parameters",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_parameters,
    help="List rates and times with their defaults.",
)
@force_option
@json_option
def command(
    *,
    file: Path,
    stops: Path | None,
    settings: tuple[str, ...],
    loom: Path | None,
    out: Path | None,
    number: int | None,
    animation_to: Path | None,
    shown: str | None,
    force: bool,
    json_to: str | None,
    **runs: Any,
) -> int:
    """Weave a programme, FILE.ilmek or its text, in time, with faults, the operator and planned stops.

    Every knot is an event. One run of --seed is shown; --seeds more give the band of the weaving time. Faults happen
    at stated rates; the same seed gives the same run on every machine. Ends with 3 where a check fails.
    """
    if shown and out is None:
        raise ParameterError(f"--shown {shown} is given without --out", do="give a folder: --out DIR")
    inputs = {"FILE": file, "--stops": stops, "--loom": loom, **setting_files(settings)}
    order = read_simulation_order(
        file,
        stops=stops,
        settings=read_settings(settings),
        loom=loom,
        row=None if number is None else number - 1,
        **runs,
    )
    with call_outputs({"--json": json_to, "--animation": animation_to}, force=force, inputs=inputs) as call:
        found = simulate(order, out, rows=shown == "rows", outputs=call.outputs, progress=call.progress)
        call.give_animation("--animation", found.report)
        call.give_json(found.as_json)
    if call.quiet:
        note_verdict(found.report.all_checks)
    else:
        show_simulation(found)
    return exit_code(found.report.all_checks)


def show_simulation(result: SimulationResult) -> None:
    """Print the verdict, the run, its band, and where the time goes."""
    found, report = result.found, result.report
    show_verdict(report.all_checks)
    band = found.times
    runs = len(band.values)
    woven, without = (format_quantity(time, "h") for time in (found.time, found.time_without_faults))
    ordered, passed = format_quantity(found.order_time, "h"), format_quantity(found.calendar_time, "d", 3)
    parts = f"availability {found.availability:.1%} × performance {found.performance:.1%} × quality {found.quality:.2%}"
    pairs = [
        ("weaving time", f"{woven}, {without} without faults"),
        ("order", f"{ordered} with dressing and doffing, {passed} of the calendar"),
        ("utilisation", f"{found.utilisation:.1%} ties knots; {found.knots_per_minute:.1f} knots a minute"),
        ("bottleneck", f"{found.bottleneck}; {found.bottleneck_cure}"),
        ("OEE", f"{found.oee:.1%} = {parts}"),
    ]
    if runs > 1:
        low, middle, high = (format_quantity(band.at(share), "h") for share in (0.05, 0.5, 0.95))
        pairs.insert(1, (f"{runs:,} runs", f"median {middle}, 90 % between {low} and {high}"))
    show_pairs([*pairs, ("digest", found.digest)])
    for table in report.tables:
        if table.brief:
            show_table([column.heading for column in table.columns], [_cells(table, row) for row in table.rows])
    for text in report.warnings:
        note(text)
    if result.files:
        say(f"report: {result.files[0]}")


def _cells(table: Table, row: tuple[float | int | str, ...]) -> list[str]:
    return [
        cell if isinstance(cell, str) else format_quantity(cell, column.unit, column.digits)
        for cell, column in zip(row, table.columns, strict=True)
    ]
