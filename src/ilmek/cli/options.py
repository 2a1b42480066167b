"""Options that several commands share."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from ilmek.jobs.animation_order import checked_animation

F = TypeVar("F", bound=Callable[..., Any])


def text_option(flag: str, metavar: str, meaning: str, *name: str, **more: Any) -> Callable[[F], F]:
    """An option with a value; name: of the argument, where it is not that of the flag."""
    return click.option(flag, *name, metavar=metavar, help=meaning, **more)


def file_option(flag: str, metavar: str, meaning: str, *name: str) -> Callable[[F], F]:
    """An option with the path of a file or a folder."""
    return text_option(flag, metavar, meaning, *name, type=click.Path(path_type=Path))


json_option = text_option(
    "--json", "-|FILE", "Write all results as JSON, SI and radians; - writes to standard output.", "json_to"
)
animation_option = click.option(
    "--animation",
    "animation_to",
    type=click.Path(path_type=Path),
    metavar="FILE.gif|FILE.mp4",
    callback=lambda _context, _option, path: checked_animation(path),
    help="Write the machine in motion; MP4 needs the extra video.",
)
issue_option = text_option(
    "--issue",
    "REVISION,DATE,OWNER",
    "Revision, date (ISO 8601) and legal owner on the drawings; those left out stay a dash.",
    "issued",
)
rates_option = file_option(
    "--rates",
    "FILE",
    "Read rates of the cost of a carpet from .toml, .json: wage, interest, rent and others of cost.*.",
)
stops_option = file_option("--stops", "FILE", "Read the rates of faults and the times of repairs from .toml, .json.")
motion_option = text_option(
    "--motion", "NAME", "The motion that --animation writes, by its name in the report; default: the first."
)
picture_option = file_option("--picture", "FILE.png", "Draw the carpet as far as it is woven, with its faults marked.")
force_option = click.option("--force", is_flag=True, help="Replace a folder that ilmek wrote, and any file.")


def require_options(*options: tuple[str, str | None, str, Path | None]) -> None:
    """Raise UsageError for an option without the output that it belongs to: option, value, that output, its path."""
    for option, given, needed, path in options:
        if given is not None and path is None:
            raise click.UsageError(f"{option} needs {needed}")
