"""`ilmek studio`: the carpet, the machines and the loom in the browser."""

from dataclasses import replace
from pathlib import Path

import click

from ilmek.cli.interrupts import before_end
from ilmek.cli.options import file_option
from ilmek.cli.password import typed_password
from ilmek.cli.terminal import note
from ilmek.errors import ParameterError
from ilmek.io.secret_file import read_bounded
from ilmek.jobs.studio.project.opening import open_project
from ilmek.web.serve import PORT, StudioOrder, checked_order, serve

EXAMPLES = """\b
Examples:
  ilmek studio
  ilmek studio carpet --no-browser
  ilmek studio carpet --port 8500
  ilmek studio carpet --host 0.0.0.0 --password-file password.txt

Limits: upload 64 MB; 100 open pages; 300 connections; 20 works at a time.
"""

DEFAULT_PROJECT = Path("studio-project")


@click.command(epilog=EXAMPLES)
@click.argument("project", type=click.Path(path_type=Path, file_okay=False), metavar="[PROJECT]", required=False)
@click.option("--port", type=int, default=PORT, metavar="N", help=f"Port; one in use: the next. Default: {PORT}.")
@click.option("--no-browser", is_flag=True, help="Print the address alone; default: open the browser too.")
@click.option("--host", default="127.0.0.1", help="Address to listen at; default: 127.0.0.1, this computer alone.")
@file_option("--password-file", "FILE", "File with the password that --host requires; default: typed.")
def command(*, project: Path | None, port: int, no_browser: bool, host: str, password_file: Path | None) -> int:
    """Open the studio on the folder PROJECT: carpet, machines, linkages, cyclograms and loom in the browser.

    The folder holds text files that the other commands read too; an empty or missing one is filled with an example.
    Default: the folder studio-project. The studio saves by itself and goes on until Ctrl-C. Its address has a token
    that opens it; whoever has the address has the studio.
    """
    folder = project or DEFAULT_PROJECT
    order = StudioOrder(folder, host, port)
    if not order.local or password_file is not None:
        order = StudioOrder(folder, host, port, _password(password_file))
    checked_order(order)
    folder = open_project(folder)
    with before_end(lambda: f"the studio is closed; the project is in {folder}"):
        serve(replace(order, project=folder), note, click.echo, browser=not no_browser)
    return 0


def _password(file: Path | None) -> str:
    if file is not None:
        try:
            return read_bounded(file, "password").decode().splitlines()[0]
        except (UnicodeDecodeError, IndexError):
            raise ParameterError(f"the password file {file} is no text", do="give a file with one line") from None
    return typed_password("nothing was written")
