"""Options that several commands share."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import click

F = TypeVar("F", bound=Callable[..., Any])

SIZES = "a standard size (seccade, kelle, ...) or width x length, like 120x180cm"
QUALITIES = "knots across x knots along, like 25x25/dm; also 40raj, 130kpsi, 62500/m2, 9/60 (India), 90line (China)"

json_option = click.option(
    "--json",
    "json_to",
    metavar="-|FILE",
    help="Write all results as JSON, SI and radians; - writes to standard output.",
)
force_option = click.option("--force", is_flag=True, help="Replace a folder that ilmek wrote, and any file.")


def carpet_options(command: F) -> F:
    """Options of a carpet: picture, size, quality, knot, yarns, colours, lone knots, pile, printed chart."""
    for option in reversed(_CARPET):
        command = option(command)
    return command


def carpet_inputs(carpet: Mapping[str, Any]) -> dict[str, Path | None]:
    """The files that a carpet is read from, by name in messages."""
    return {"PICTURE": carpet["picture"], "--yarns": carpet["yarn_file"]}


_CARPET = (
    click.argument("picture", type=click.Path(path_type=Path)),
    click.option("--size", default="seccade", show_default=True, metavar="SIZE", help=f"Carpet size: {SIZES}."),
    click.option(
        "--quality", default="25x25/dm", show_default=True, metavar="QUALITY", help=f"Knot density: {QUALITIES}."
    ),
    click.option("--knot", default="symmetric", show_default=True, metavar="KNOT", help="symmetric or asymmetric."),
    click.option(
        "--yarns",
        "yarn_file",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Yarn list, TOML or CSV; default: the sixteen wool yarns that come with ilmek.",
    ),
    click.option(
        "--colours", type=int, metavar="N", help="Use only the N yarns of the list that match the picture best."
    ),
    click.option(
        "--keep-lone", is_flag=True, help="Keep knots that differ from all four neighbours; default: they are merged."
    ),
    click.option("--pile-height", default="8mm", show_default=True, metavar="LENGTH", help="Height of the cut pile."),
    click.option(
        "--pdf/--no-pdf",
        default=None,
        help="Write the chart as PDF or not; default: only if it has at most 400 sheets.",
    ),
    click.option(
        "--out", type=click.Path(path_type=Path), metavar="DIR", help="Output folder; on an error nothing is written."
    ),
)
