"""`ilmek knot`: which knot the motion of a gripper ties."""

from pathlib import Path

import click

from ilmek.cli.options import json_option
from ilmek.cli.report import show_report
from ilmek.cli.terminal import check_json, console, give_json
from ilmek.errors import CarpetError
from ilmek.io.output import check_file
from ilmek.jobs.knot import KnotRequest, knot_of
from ilmek.jobs.page import write_page
from ilmek.params.text_lists import read_points
from ilmek.units import parse_quantity

EXAMPLES = """\b
Examples:
  ilmek knot examples/gripper_path.csv --pitch 2mm
  ilmek knot left.csv right.csv --pitch 4mm --keep-out 0.6mm --report knot.html
  ilmek mechanism mine.toml --csv motion.csv
  ilmek knot motion.csv --columns "coupler.P x" "coupler.P y" --pitch 20mm --smooth
"""


@click.command(epilog=EXAMPLES)
@click.argument("paths", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="PATH.csv [OTHER.csv]")
@click.option("--pitch", default="2mm", show_default=True, metavar="LENGTH", help="Distance of two warps.")
@click.option("--warps", type=click.IntRange(1, 10_000), default=12, show_default=True, help="Warps in the row.")
@click.option("--first", default="(0mm,0mm)", show_default=True, metavar="(X,Y)", help="Place of warp 1, at the left.")
@click.option(
    "--keep-out", default="0mm", show_default=True, metavar="LENGTH", help="Radius about a warp that stays free."
)
@click.option("--columns", nargs=2, metavar="X Y", help="Headings of the two columns, where there are more.")
@click.option("--smooth", is_flag=True, help="The places are samples of a smooth motion, not corners.")
@click.option("--closed", is_flag=True, help="The motion ends where it began.")
@click.option("--report", "page_to", type=click.Path(path_type=Path), metavar="FILE.html", help="Write a page to read.")
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
    json_to: str | None,
) -> None:
    """Say which knot is tied by yarn whose end is led along PATH, among warps in a row, the pile upwards.

    With two paths each leads one end, both from one place. The answer is a proof: paths that can be pulled into each
    other without crossing a warp tie the same knot.
    """
    check_json(json_to)
    if page_to is not None:
        check_file(page_to)
    asked = KnotRequest(
        warps, parse_quantity(pitch, "mm"), _place(first), parse_quantity(keep_out, "mm"), smooth, closed
    )
    said = knot_of(paths, asked, columns)
    write_page(page_to, said)
    if not give_json(json_to, said.as_json()):
        show_report(said)
        if page_to is not None:
            console().print(f"report: {page_to}")


def _place(text: str) -> complex:
    """The one place of a text [m]."""
    places = read_points("--first", text)
    if len(places) != 1:
        raise CarpetError(f"--first gives {len(places)} places", allowed="one, like (0mm,0mm)")
    return complex(places[0])
