"""`ilmek import`: a mechanism of another program as a mechanism file."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option
from ilmek.cli.terminal import note, say
from ilmek.jobs.mechanism.importing import import_mechanism

EXAMPLES = """\b
Examples:
  ilmek import arm.urdf arm.toml
  ilmek import four-bar.xml four-bar.toml
  ilmek import walker.linkage2 walker.toml
  ilmek import skeleton.dxf linkage.toml

Limits: file 1 MB; one plane of motion; drawings of at most 200 links.
"""


@click.command(epilog=EXAMPLES)
@click.argument("source", type=click.Path(path_type=Path), metavar="IN")
@click.argument("target", type=click.Path(path_type=Path), metavar="OUT")
@force_option
def command(source: Path, target: Path, force: bool) -> None:
    """Write the mechanism of IN as OUT, a mechanism file, .toml or .json.

    IN is URDF (an open chain), MJCF (a planar model), a .linkage2 file, JSON of pylinkage, a text file with an address
    of PMKS+ or an expression of Pyslvs, a SolveSpace sketch or a DXF skeleton. What has no equivalent is listed.
    """
    with call_outputs({"OUT": target}, force=force, inputs={"IN": source}) as call:
        imported = import_mechanism(source, target, outputs=call.outputs)
    mechanism = imported.file.mechanism
    say(f"mechanism: {target}, {len(mechanism.bodies)} bodies, {len(mechanism.joints)} joints")
    for left_out in imported.left_out:
        note(f"left out: {left_out}")
