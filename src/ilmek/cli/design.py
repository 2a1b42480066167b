"""`ilmek design`: design one machine from its parameters and report it."""

from functools import partial
from pathlib import Path

import click

from ilmek.cli.call_outputs import CallOutputs, call_outputs
from ilmek.cli.issue import issue_of
from ilmek.cli.options import (
    animation_option,
    file_option,
    force_option,
    issue_option,
    json_option,
    motion_option,
    rates_option,
    require_options,
)
from ilmek.cli.report import headline_of, show_report, show_report_table, tables_named
from ilmek.cli.settings import read_settings, setting_files
from ilmek.cli.terminal import note, say
from ilmek.cli.verdict import exit_code, note_verdict
from ilmek.io.rates_file import read_rates
from ilmek.jobs.design import (
    IN_SPACE,
    DesignResult,
    design_machine,
    mechanism_text,
    require_mechanism,
    require_space,
)
from ilmek.jobs.machine_file import read_machine_order
from ilmek.jobs.workshop_order import WorkshopOrder
from ilmek.report import Table

EXAMPLES = """\b
Examples:
  ilmek design beat-up
  ilmek design beat-up --set swing=30deg --set crank_rotation=180deg --json -
  ilmek design shedding --set lift=60mm --set pressure_angle_limit=30deg --report shedding.html
  ilmek design weaver --workshop parts --tolerance 2um
  ilmek design hammer --animation hammer.gif
  ilmek design automated-loom --animation knot.gif --motion loom-knot-front
  ilmek design motion-four-bar --to gripper.toml
  ilmek design automated-loom --glb loom.glb
  ilmek design automated-loom --rates rates.toml --table cost
  ilmek design tufting --glb needles.glb
  ilmek design automated-loom --step loom.step --pose row=90deg
  ilmek design automated-loom --mjcf loom.xml
  ilmek design machines/beat-up.toml --set swing=32deg

The parameters of a machine, and their limits: ilmek machines MACHINE
"""


@click.command(epilog=EXAMPLES)
@click.argument("name", metavar="MACHINE|FILE.toml")
@click.argument("more", nargs=-1, metavar="[NAME=VALUE]...")
@click.option(
    "--set",
    "settings",
    multiple=True,
    metavar="NAME=VALUE",
    help="Set a parameter, with its unit; @FILE reads the value from FILE.",
)
@click.option("--aim", metavar="cost|price|time", help="The same as --set aim=price: what a loom's choice makes least.")
@rates_option
@json_option
@click.option("--table", metavar="NAME", help="Print these tables of the report alone, like cost of a loom.")
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a report page.")
@animation_option
@motion_option
@file_option("--workshop", "DIR", "Write plates (DXF, STEP) and cam tables for controllers.", "parts_to")
@file_option(
    "--to", "FILE.toml", "Write the linkage as a mechanism file (.toml, .json) for ilmek mechanism.", "mechanism_to"
)
@file_option(
    "--glb",
    "FILE.glb",
    "Write the parts in space, in motion, as GLB (glTF 2.0); those of a loom, over a row and a knot, are compared "
    "there too: what is through each other, and what nothing holds, fails a check.",
    "space_to",
)
@file_option(
    "--step",
    "FILE.step",
    "Write the parts as one STEP assembly (AP242), as they stand at the start, or at --pose.",
    "solids_to",
)
@click.option("--pose", metavar="DRIVE=ANGLE", help="Angle of a drive in --step: row=90deg or knot=200deg in a loom.")
@file_option(
    "--mjcf", "FILE.xml", "Write the bodies with joints, inertia, contacts and servos for MuJoCo (MJCF).", "model_to"
)
@click.option("--tolerance", metavar="ERROR", help="Tolerance of cam tables: 1um, 0.01deg, or 0.01% of the stroke.")
@issue_option
@force_option
def command(  # noqa: PLR0917 - click calls it by name
    name: str,
    more: tuple[str, ...],
    settings: tuple[str, ...],
    aim: str | None,
    rates: Path | None,
    table: str | None,
    json_to: str | None,
    page_to: Path | None,
    animation_to: Path | None,
    motion: str | None,
    parts_to: Path | None,
    mechanism_to: Path | None,
    space_to: Path | None,
    solids_to: Path | None,
    pose: str | None,
    model_to: Path | None,
    tolerance: str | None,
    issued: str | None,
    force: bool,
) -> int:
    """Design MACHINE and report it: results, checks against limits, warnings. Ends with 3 where a check fails.

    FILE.toml has the machine and settings; --set wins over the settings of the file.
    """
    require_options(
        ("--tolerance", tolerance, "--workshop DIR", parts_to),
        ("--issue", issued, "--workshop DIR", parts_to),
        ("--motion", motion, "--animation FILE", animation_to),
        ("--pose", pose, "--step FILE", solids_to),
    )
    given = (*settings, *more, *(() if aim is None else (f"aim={aim}",)))
    order = read_machine_order(name, {**read_rates(rates), **read_settings(given)})
    if mechanism_to is not None:
        require_mechanism(order.machine, mechanism_to)
    in_space = {"--glb": space_to, "--step": solids_to, "--mjcf": model_to}
    require_space(order.machine, in_space)
    files = {"--json": json_to, "--report": page_to, "--animation": animation_to, "--to": mechanism_to, **in_space}
    read = {"FILE": order.file, "--rates": rates}
    with call_outputs(files, force=force, inputs=read | setting_files(given)) as call:
        design_result = design_machine(
            *(order.machine, order.settings),
            WorkshopOrder(parts_to, tolerance, issue_of(issued)) if parts_to else None,
            outputs=call.outputs,
            progress=call.progress,
            illustrated=not call.quiet or page_to is not None or animation_to is not None,
            drawn=page_to is not None or animation_to is not None,
        )
        shown = () if table is None else tables_named(design_result.report, table)
        _give(design_result, call, motion, mechanism_to, pose)
    _show(design_result, call, shown, mechanism_to, parts_to)
    return exit_code(design_result.report.all_checks)


def _give(
    made: DesignResult, call: CallOutputs, motion: str | None, mechanism_to: Path | None, pose: str | None
) -> None:
    """Stage the files."""
    call.give_page("--report", made.report)
    call.give_animation("--animation", made.report, motion)
    if mechanism_to is not None and made.mechanism is not None:
        call.give("--to", partial(mechanism_text, made.mechanism, mechanism_to))
    for option in IN_SPACE:
        call.give_scene(option, made, pose)
    call.give_json(made.as_json)


def _show(
    made: DesignResult,
    call: CallOutputs,
    tables: tuple[Table, ...],
    mechanism_to: Path | None,
    parts_to: Path | None,
) -> None:
    """The report and the files on the terminal, or some tables alone; what was required and not written is noted."""
    for table in () if call.quiet else tables:
        show_report_table(table)
    if tables and not call.quiet:
        return
    if not call.quiet:
        show_report(made.report)
        call.show_files(
            {
                "--report": "report",
                "--animation": "animation",
                "--glb": "in space",
                "--step": "assembly",
                "--mjcf": "model for MuJoCo",
            }
        )
        if mechanism_to is not None and made.mechanism is not None:
            say(f"mechanism: {mechanism_to}")
        if made.workshop is not None:
            say(f"workshop: {made.workshop.summary}")
    else:
        note_verdict(made.report.all_checks, headline_of(made.report))
    if mechanism_to is not None and made.mechanism is None:
        note(f"{mechanism_to} was not written: there is no linkage")
    if parts_to is not None and made.workshop is None:
        note(f"{parts_to} was not written: there are no links")
    for warning in made.warnings:
        note(warning)
