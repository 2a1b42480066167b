"""Options that several commands share."""

from pathlib import Path

import click

from ilmek.jobs.animation_order import checked_animation

json_option = click.option(
    "--json",
    "json_to",
    metavar="-|FILE",
    help="Write all results as JSON, SI and radians; - writes to standard output.",
)
animation_option = click.option(
    "--animation",
    "animation_to",
    type=click.Path(path_type=Path),
    metavar="FILE.gif|FILE.mp4",
    callback=lambda _context, _option, path: checked_animation(path),
    help="Write the machine in motion; MP4 needs the extra video.",
)
issue_option = click.option(
    "--issue", "issued", metavar="REVISION,DATE", help="Revision and date (ISO 8601) of issue on the drawings."
)
rates_option = click.option(
    "--rates",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Read rates of the cost of a carpet from .toml, .json: wage, interest, rent and others of cost.*.",
)
stops_option = click.option(
    "--stops",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Read the rates of faults and the times of repairs from .toml, .json.",
)
motion_option = click.option(
    "--motion",
    metavar="NAME",
    help="The motion that --animation writes, by its name in the report; default: the first.",
)
picture_option = click.option(
    "--picture",
    type=click.Path(path_type=Path),
    metavar="FILE.png",
    help="Draw the carpet as far as it is woven, with its faults marked.",
)
force_option = click.option("--force", is_flag=True, help="Replace a folder that ilmek wrote, and any file.")


def require_options(*options: tuple[str, str | None, str, Path | None]) -> None:
    """Raise UsageError for an option without the output that it belongs to: option, value, that output, its path."""
    for option, given, needed, path in options:
        if given is not None and path is None:
            raise click.UsageError(f"{option} needs {needed}")
