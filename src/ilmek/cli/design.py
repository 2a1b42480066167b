"""`ilmek design`: design one machine from its parameters and report it."""

from pathlib import Path

import click

from ilmek.cli.options import json_option
from ilmek.cli.report import show_report
from ilmek.cli.settings import read_settings
from ilmek.cli.terminal import check_json, give_json, note, progress_bar, say
from ilmek.jobs.design import Outputs, design_machine

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
    help="Set a parameter, with its unit; @FILE reads the value from FILE.",
)
@json_option
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a report page.")
@click.option(
    "--workshop",
    "parts_to",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Write plates (DXF, STEP) and cam tables for controllers.",
)
@click.option("--tolerance", metavar="ERROR", help="Tolerance of cam tables: 1um, 0.01deg, or 0.01% of the stroke.")
@click.option("--force", is_flag=True, help="Replace a workshop folder that ilmek wrote.")
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
        raise click.UsageError("--force and --tolerance need --workshop DIR")
    outputs = Outputs(page_to, parts_to, tolerance, force)
    with progress_bar() as progress:
        made = design_machine(name, read_settings((*settings, *more)), outputs, progress=progress)
    if not give_json(json_to, made.as_json()):
        show_report(made.report)
        if page_to is not None:
            say(f"report: {page_to}")
        if made.workshop is not None:
            say(f"workshop: {made.workshop.summary}")
    for warning in made.warnings:
        note(warning)
