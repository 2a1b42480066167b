"""`ilmek knot`: prove which knot the motion of a gripper ties."""

from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option, json_option
from ilmek.cli.report import show_report
from ilmek.cli.terminal import say
from ilmek.errors import CarpetError
from ilmek.jobs.knot import KnotRequest, knot_of
from ilmek.params.text_lists import read_points
from ilmek.units import parse_quantity

EXAMPLES = """\b
Examples:
  ilmek knot examples/gripper_path.csv --pitch 2mm
  ilmek knot left.csv right.csv --pitch 4mm --keep-out 0.6mm --report knot.html
  ilmek mechanism mine.toml --csv motion.csv
  ilmek knot motion.csv --columns "coupler.P x" "coupler.P y" --pitch 20mm --smooth

Limits: path file 20 MB, 100,000 points; 10,000 warps.
"""


@click.command(epilog=EXAMPLES)
@click.argument("paths", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="PATH.csv [OTHER.csv]")
@click.option(
    "--pitch", default="2mm", show_default=True, metavar="LENGTH", help="Distance between neighbouring warps."
)
@click.option("--warps", type=click.IntRange(1, 10_000), default=12, show_default=True, help="Warps in the row.")
@click.option(
    "--first", default="(0mm,0mm)", show_default=True, metavar="(X,Y)", help="Position of warp 1, the leftmost."
)
@click.option(
    "--keep-out",
    default="0mm",
    show_default=True,
    metavar="LENGTH",
    help="Radius around each warp that the path must not enter.",
)
@click.option(
    "--columns", nargs=2, metavar="X Y", help="Headings of the columns of x and y, if the file has more than two."
)
@click.option("--smooth", is_flag=True, help="The points are samples of a smooth motion, not corners of a polyline.")
@click.option("--closed", is_flag=True, help="The path is closed: it returns to its first point.")
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a report page.")
@force_option
@json_option
def command(
    *,
    paths: tuple[Path, ...],
    pitch: str,
    warps: int,
    first: str,
    keep_out: str,
    columns: tuple[str, str] | None,
    smooth: bool,
    closed: bool,
    page_to: Path | None,
    force: bool,
    json_to: str | None,
) -> None:
    """Find the knot that a yarn ties when its end is led along PATH through a row of warps; the pile points up.

    With two paths, each leads one end of the yarn, and both start at the same point. The answer is proved: paths that
    can be deformed into each other without crossing a warp tie the same knot.
    """
    request = KnotRequest(
        warps, parse_quantity(pitch, "mm"), _position(first), parse_quantity(keep_out, "mm"), smooth, closed
    )
    files = {"--json": json_to, "--report": page_to}
    with call_outputs(files, force=force, inputs={str(path): path for path in paths}) as call:
        report = knot_of(paths, request, columns, call.progress)
        call.give_page("--report", report)
        call.give_json(report.as_json)
    if not call.quiet:
        show_report(report)
        if "--report" in call.files:
            say(f"report: {page_to}")


def _position(text: str) -> complex:
    """The position of warp 1 [m]. Raises CarpetError unless the text gives exactly one point."""
    points = read_points("--first", text)
    if len(points) != 1:
        raise CarpetError(f"--first gives {len(points)} points", allowed="one, like (0mm,0mm)")
    return complex(points[0])
