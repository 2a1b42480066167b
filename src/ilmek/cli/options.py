"""Options that several commands share."""

import click

json_option = click.option(
    "--json",
    "json_to",
    metavar="-|FILE",
    help="Write all results as JSON, SI and radians; - writes to standard output.",
)
force_option = click.option("--force", is_flag=True, help="Replace a folder that ilmek wrote, and any file.")
