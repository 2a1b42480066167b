"""`ilmek compare`: measured curves beside those of a machine's model."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option, json_option, text_option
from ilmek.cli.report import show_report
from ilmek.cli.settings import read_settings, setting_files
from ilmek.cli.verdict import exit_code, note_verdict
from ilmek.jobs.compare import compare, read_compare_order
from ilmek.units import parse_quantity

EXAMPLES = """\b
Examples:
  ilmek compare measured.csv tufting
  ilmek compare measured.csv tufting --fit friction_force --fit link_mass.rocker --report compared.html
  ilmek compare measured.csv tufting-machine width=2m drives=5 --align --within 5%

measured.csv: a header like `crank angle [deg], main shaft [N*m]`, then rows of numbers. A column is named as a curve of
the machine's figures; where that is the label of several, with the figure before it: `shaft-torques: main shaft`.
"""


@click.command(epilog=EXAMPLES)
@click.argument("file", metavar="MEASURED.csv", type=click.Path(path_type=Path))
@click.argument("machine", metavar="MACHINE")
@click.argument("settings", nargs=-1, metavar="[NAME=VALUE]...")
@click.option(
    "--fit", multiple=True, metavar="NAME", help="Fit this parameter of the machine, from its value, by least squares."
)
@click.option("--align", is_flag=True, help="Find the shift of the first column too: the encoder's zero is not known.")
@text_option("--within", "SHARE", "Allowed rms difference over the range of a measured curve, like 5%.")
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a report page.")
@force_option
@json_option
def command(
    *,
    file: Path,
    machine: str,
    settings: tuple[str, ...],
    fit: tuple[str, ...],
    align: bool,
    within: str | None,
    page_to: Path | None,
    force: bool,
    json_to: str | None,
) -> int:
    """Compare the curves of MEASURED.csv with those of MACHINE: what differs by how much, curve by curve.

    --fit finds the parameters with which it differs least, each with its standard deviation. Ends with 3 where a curve
    differs by more than --within.
    """
    allowed = None if within is None else parse_quantity(within, "%")
    order = read_compare_order(file, machine, read_settings(settings), fit=fit, align=align, within=allowed)
    inputs = {"MEASURED.csv": file, **setting_files(settings)}
    with call_outputs({"--json": json_to, "--report": page_to}, force=force, inputs=inputs) as call:
        report = compare(order, call.progress)
        call.give_page("--report", report)
        call.give_json(report.as_json)
    if call.quiet:
        note_verdict(report.all_checks)
    else:
        show_report(report)
        call.show_files({"--report": "report"})
    return exit_code(report.all_checks)
