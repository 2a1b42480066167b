"""`ilmek plc`: the loom's control for a programmable controller."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option
from ilmek.cli.terminal import note, show_pairs
from ilmek.io.plc.targets import TARGETS
from ilmek.jobs.plc.program import FILES, write_plc

EXAMPLES = """\b
Examples:
  ilmek plc carpet/programme.ilmek --out carpet-plc
  ilmek plc carpet/programme.ilmek --target tia --out carpet-plc

Limits: 32,000 knots in a row; rows.csv of at most 5 million knots.
"""


@click.command(epilog=EXAMPLES)
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE")
@click.option("--out", "folder", type=click.Path(path_type=Path), metavar="DIR", required=True, help="Folder to write.")
@click.option("--target", type=click.Choice(list(TARGETS)), default="codesys", show_default=True, help="Controller.")
@force_option
def command(file: Path, folder: Path, target: str, force: bool) -> None:
    """Write the control of the loom for the programme of FILE as a program of a PLC.

    States, interlocks and alarms come from the same tables as those of `ilmek run`; cams from the cyclograms; addresses
    and files are those of the target. The host gives the program one row at a time, from FILE or rows.csv.
    """
    with call_outputs({}, force=force, inputs={"FILE": file}) as call:
        plc_result = write_plc(file, folder, target=target, outputs=call.outputs, progress=call.progress)
    for one in plc_result.notes:
        note(one)
    heads = "1 head" if plc_result.setup.heads == 1 else f"{plc_result.setup.heads} heads"
    show_pairs(
        [
            ("loom", f"{heads}, {plc_result.setup.rows:,} rows of {plc_result.setup.columns:,} knots"),
            ("target", TARGETS[target].title),
            ("program", f"{plc_result.units} units, {plc_result.signals} signals with an address"),
            *((str(folder / name), FILES[name]) for name in plc_result.files),
        ]
    )
