"""`ilmek mechanism`: analyse a mechanism from a file, tabulate and draw its motion."""

import json
from collections.abc import Mapping
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ilmek.cli.call_outputs import CallOutputs, call_outputs
from ilmek.cli.issue import issue_of
from ilmek.cli.options import (
    animation_option,
    file_option,
    force_option,
    issue_option,
    json_option,
    require_options,
    text_option,
)
from ilmek.cli.report import cell_text, show_self_tests
from ilmek.cli.settings import read_settings
from ilmek.cli.terminal import note, say, show_checks, show_table
from ilmek.cli.verdict import exit_code, note_verdict, show_verdict
from ilmek.errors import MechanismError, printable
from ilmek.io.mechanism_file import mechanism_json, mechanism_toml, read_mechanism, schema
from ilmek.io.table_csv import MOST_NUMBERS, csv_text
from ilmek.jobs.design import DesignResult
from ilmek.jobs.mechanism.analysis import Analysis, analysis
from ilmek.jobs.mechanism.data import as_json, columns
from ilmek.jobs.mechanism.making import MadeMechanism, made_mechanism
from ilmek.jobs.mechanism.report import report
from ilmek.jobs.mechanism.request import STEPS, MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.jobs.workshop_order import WorkshopOrder, workshop_writer
from ilmek.report import Json, Report, rounded
from ilmek.units import format_quantity

if TYPE_CHECKING:
    from ilmek.jobs.workshop import Workshop

EXAMPLES = """\b
Examples:
  ilmek mechanism examples/tufting_needle.toml
  ilmek mechanism examples/peaucellier.toml --over -40deg..40deg --report peaucellier.html
  ilmek mechanism examples/jansen_leg.toml --speed 60rpm --steps 360 --csv motion.csv
  ilmek mechanism examples/tufting_needle.toml --at 30deg --json -
  ilmek mechanism examples/klann_leg.toml --animation klann.gif
  ilmek mechanism mine.toml --workshop parts
  ilmek mechanism mine.toml --as json

Limits: file 250 kB; 100 bodies, joints, couplings; 2,000,000 numbers in a table.
"""


def _show_schema(ctx: click.Context, _: click.Parameter, value: bool) -> None:
    if value:
        click.echo(json.dumps(schema(), ensure_ascii=False))
        ctx.exit()


@click.command(epilog=EXAMPLES)
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--set", "values", multiple=True, metavar="NAME=VALUE", help="Set an entry of the table [values].")
@click.option(
    "--at",
    "fixed",
    multiple=True,
    metavar="[NAME=]VALUE",
    help="Fix an input at a value; with all inputs fixed, compute one pose.",
)
@click.option(
    "--over", default="", metavar="FROM..TO", help="Range of the driving input; default: a full turn, or its motion."
)
@click.option(
    "--speed",
    default="",
    metavar="SPEED",
    help="Its speed, like 60rpm; default: that of the file, else 1 rad/s or 1 m/s.",
)
@click.option(
    "--steps", type=click.IntRange(1, MOST_NUMBERS), default=STEPS, show_default=True, help="Steps of the range."
)
@text_option(
    "--balance", "FLUCTUATION", "Find the best counterweight on the crank, and the flywheel for a fluctuation, like 2%."
)
@text_option(
    "--csv", "-|FILE", "Write motion and forces as CSV, SI and radians; - writes to standard output.", "csv_to"
)
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a report page.")
@animation_option
@file_option(
    "--workshop", "DIR", "Write the parts (drawings, DXF, STEP, lists) and the inputs' laws as cam tables.", "parts_to"
)
@file_option("--glb", "FILE.glb", "Write the parts in space.", "space_to")
@issue_option
@click.option("--tolerance", metavar="ERROR", help="Tolerance of cam tables: 1um, 0.01deg, or 0.01% of the stroke.")
@click.option("--as", "kind", type=click.Choice(("toml", "json")), help="Convert the file to this format and exit.")
@click.option(
    "--schema",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_show_schema,
    help="Print the JSON Schema of these files.",
)
@force_option
@json_option
def command(
    *,
    file: Path,
    values: tuple[str, ...],
    fixed: tuple[str, ...],
    over: str,
    speed: str,
    steps: int,
    balance: str | None,
    csv_to: str | None,
    page_to: Path | None,
    animation_to: Path | None,
    parts_to: Path | None,
    space_to: Path | None,
    issued: str | None,
    tolerance: str | None,
    kind: str | None,
    force: bool,
    json_to: str | None,
) -> int:
    """Read the mechanism in FILE (TOML or JSON) and compute its motion, and its forces if it has masses or loads.

    Ends with 3 where a check fails.
    """
    require_options(
        ("--tolerance", tolerance, "--workshop DIR", parts_to), ("--issue", issued, "--workshop DIR", parts_to)
    )
    if kind is not None:
        given = read_mechanism(file, read_settings(values))
        write = mechanism_toml if kind == "toml" else mechanism_json
        click.echo(given.text if kind == "toml" and given.text and not values else write(given.machine), nl=False)
        return 0
    files = {"--json": json_to, "--csv": csv_to, "--report": page_to, "--animation": animation_to, "--glb": space_to}
    order = None if parts_to is None else WorkshopOrder(parts_to, tolerance, issue_of(issued))
    with call_outputs(files, force=force, inputs={"FILE": file}) as call:
        write_parts = workshop_writer(order, call.outputs)
        request = MotionRequest(_fixed(fixed), over, speed, steps, balance or "")
        moved = run(read_mechanism(file, read_settings(values)), request, call.progress)
        drawn = not (page_to is None and animation_to is None)
        if order is None and space_to is None:
            found = analysis(moved, call.progress)
            mechanism, shown = None, report(found, drawn=drawn)
        else:
            mechanism = made_mechanism(moved, call.progress, drawn=drawn)
            found, shown = mechanism.analysis, mechanism.report
        workshop = None
        if write_parts is not None and mechanism is not None:
            workshop = write_parts(shown, mechanism.papers, progress=call.progress)
            shown = workshop.judged(shown)
        _give(call, found, shown, mechanism, {} if workshop is None else {"files": workshop.files})
    _show(call, shown, workshop)
    return exit_code(shown.all_checks)


def _give(
    call: CallOutputs, found: Analysis, shown: Report, made: MadeMechanism | None, files: Mapping[str, Json]
) -> None:
    """Stage the files."""
    call.give_page("--report", shown)
    call.give_animation("--animation", shown)
    call.give_json(lambda: {**as_json(found, shown), **files})
    call.give("--csv", lambda: csv_text(columns(found), call.progress.part(0.0, 1.0, "table")))
    if made is not None:
        call.give_scene("--glb", DesignResult(shown, tree=made.tree))


def _show(call: CallOutputs, shown: Report, workshop: "Workshop | None") -> None:
    """The report and the files on the terminal."""
    if call.quiet:
        note_verdict(shown.all_checks)
    else:
        show(shown)
        call.show_files({"--report": "report", "--animation": "animation", "--glb": "in space", "--csv": "table"})
        if workshop is not None:
            say(f"workshop: {workshop.summary}")
    for warning in (*shown.warnings, *(workshop.notes if workshop else ())):
        note(warning)


def _fixed(texts: tuple[str, ...]) -> dict[str, str]:
    """Values by input, "" for the only one. Raises MechanismError for an input that is fixed twice."""
    fixed: dict[str, str] = {}
    for text in texts:
        name, equals, value = text.rpartition("=")
        if name.strip() in fixed:
            raise MechanismError(f"--at fixes {name.strip() or 'the input'} twice", do="fix it once")
        fixed[name.strip() if equals else ""] = value.strip()
    return fixed


def show(shown: Report) -> None:
    """Print the verdict, the structure and greatest values, the tables, and the checks."""
    click.echo(printable(shown.title))
    show_verdict(shown.all_checks)
    for result in shown.results:
        if result.shown and result.value is not None:
            for value in result.value if isinstance(result.value, list) else [result.value]:
                click.echo(printable(f"  {result.name}: {_shown(value, result.unit)}"))
    for table in shown.tables:
        if table.brief:
            headings = [f"{c.heading} [{c.unit}]" if c.unit else c.heading for c in table.columns]
            rows = [[cell_text(cell, c) for cell, c in zip(row, table.columns, strict=True)] for row in table.rows]
            show_table(headings, rows, right=range(1, len(headings)))
    if shown.all_checks:
        show_checks(shown.all_checks)
    show_self_tests(shown.all_self_tests)


def _shown(value: object, unit: str) -> str:
    if value is None:
        return "–"
    if isinstance(value, dict):
        return ", ".join(f"{name} {_shown(one, unit)}" for name, one in value.items())
    if isinstance(value, list | tuple):
        return " .. ".join(_shown(one, unit) for one in value)
    if isinstance(value, float):
        return format_quantity(rounded(value, unit), unit) if isfinite(value) else "–"
    return str(value)
