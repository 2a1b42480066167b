"""Options that several commands have, declared once."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

F = TypeVar("F", bound=Callable[..., Any])

SIZES = "a standard size (seccade, kelle, ...) or width x length, like 120x180cm"
QUALITIES = "knots across x along, like 25x25/dm; also 40raj, 130kpsi, 62500/m2, 9/60 (India), 90line (China)"

json_option = click.option(
    "--json", "json_to", metavar="-|FILE", help="Give everything as JSON, SI and radians; - is standard output."
)
force_option = click.option("--force", is_flag=True, help="Replace an output folder that ilmek made before.")


def carpet_options(command: F) -> F:
    """The options that say which carpet: picture, size, quality, knot, yarns, colours, lone knots, pile, printing."""
    for option in reversed(_CARPET):
        command = option(command)
    return command


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
        help="Yarn list, TOML or CSV; without it sixteen wool yarns that come with ilmek.",
    ),
    click.option("--colours", type=int, metavar="N", help="Use only the best N yarns of the list."),
    click.option("--keep-lone", is_flag=True, help="Leave knots unlike all four neighbours; else they are merged."),
    click.option("--pile-height", default="8mm", show_default=True, metavar="LENGTH", help="Height of the cut pile."),
    click.option(
        "--pdf/--no-pdf", default=None, help="Print the chart as PDF or not; without it up to 400 sheets are printed."
    ),
    click.option(
        "--out", type=click.Path(path_type=Path), metavar="DIR", help="Output folder, made whole or not at all."
    ),
)
