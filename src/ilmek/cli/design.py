"""`ilmek design`: one machine, designed from its parameters and reported."""

import math
from pathlib import Path

import click

from ilmek.cli.options import json_option
from ilmek.cli.settings import read_settings
from ilmek.cli.terminal import check_json, console, give_json, note, passed, progress_bar, show_checks, show_table
from ilmek.jobs.design import Outputs, design_machine
from ilmek.report import Column, Report, Result, Table
from ilmek.units import format_number, format_quantity, from_si, printed_unit

EXAMPLES = """\b
Examples:
  ilmek design beat-up
  ilmek design beat-up --set swing=30deg --set crank_rotation=180deg --json -
  ilmek design shedding --set lift=60mm --set pressure_angle_limit=30deg --report shedding.html
  ilmek design weaver --workshop parts --tolerance 2um

The parameters of a machine: ilmek machines MACHINE
"""


@click.command(epilog=EXAMPLES)
@click.argument("name", metavar="MACHINE")
@click.argument("more", nargs=-1, metavar="[NAME=VALUE]...")
@click.option(
    "--set",
    "settings",
    multiple=True,
    metavar="NAME=VALUE",
    help="Set a parameter; a value takes its unit; @FILE: what stands in FILE.",
)
@json_option
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a page to read.")
@click.option(
    "--workshop",
    "parts_to",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Write plates (DXF, STEP) and cam tables for controllers.",
)
@click.option("--tolerance", metavar="ERROR", help="Of cam tables: 1um, 0.01deg, 0.01% of the stroke.")
@click.option("--force", is_flag=True, help="Replace a workshop folder whose files ilmek made.")
def command(  # noqa: PLR0917 - click calls it by name
    name: str,
    more: tuple[str, ...],
    settings: tuple[str, ...],
    json_to: str | None,
    page_to: Path | None,
    parts_to: Path | None,
    tolerance: str | None,
    force: bool,
) -> None:
    """Design MACHINE and report it: results, checks against limits, warnings."""
    check_json(json_to)
    if parts_to is None and (force or tolerance is not None):
        raise click.UsageError("--force and --tolerance belong to --workshop DIR")
    outputs = Outputs(page_to, parts_to, tolerance, force)
    with progress_bar() as progress:
        made = design_machine(name, read_settings((*settings, *more)), outputs, progress=progress)
    if not give_json(json_to, made.as_json()):
        show_report(made.report)
        if page_to is not None:
            console().print(f"report: {page_to}")
        if made.workshop is not None:
            console().print(f"workshop: {made.workshop.said}")
    for warning in made.warnings:
        note(warning)


def show_report(report: Report) -> None:
    """Results, the tables that are brief, and checks."""
    console().print(report.title)
    shown = [(r.name, _shown(r), r.meaning) for r in report.results if r.shown]
    show_table(("result", "value", "meaning"), shown, right=(1,))
    more = [result.name for result in report.results if not result.shown]
    more += [f"{child.key}.*" for child in report.children]
    if more:
        console().print(f"with --json also: {', '.join(more)}")
    for table in report.tables:
        if table.brief:
            _show(table)
    if report.all_checks:
        show_checks(report.all_checks)
        console().print(f"checks: {passed(report.all_checks)}")


def _show(table: Table) -> None:
    """A table of the report, its numbers in the units of their columns."""
    console().print(table.title)
    units = [printed_unit(column.unit) for column in table.columns]
    headings = [
        f"{column.heading} ({unit})" if unit else column.heading
        for column, unit in zip(table.columns, units, strict=True)
    ]
    rows = [[_cell(cell, column) for cell, column in zip(row, table.columns, strict=True)] for row in table.rows]
    show_table(headings, rows)


def _cell(cell: float | int | str, column: Column) -> str:
    """A cell without its unit, which the heading has."""
    if isinstance(cell, str):
        return cell
    return format_number(from_si(cell, column.unit), column.digits) if math.isfinite(cell) else "–"


def _shown(result: Result) -> str:
    """A result in its unit; a group is shown name by name."""
    return _value(result.value, result.unit)


def _value(value: object, unit: str) -> str:  # noqa: PLR0911 - one line for each kind
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int | float):
        return format_quantity(value, unit)
    if isinstance(value, list | tuple | dict) and not value:
        return "none"
    if isinstance(value, dict):
        return "\n".join(f"{name} {_value(item, unit)}" for name, item in value.items())
    if isinstance(value, list | tuple):
        records = isinstance(value[0], dict)
        return f"{len(value)} entries, with --json" if records else ", ".join(_value(item, unit) for item in value)
    return str(value)
