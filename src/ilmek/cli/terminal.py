"""Output for people: short tables on standard output, notes and a progress bar on the error stream.

Every text goes through `printed`: it is in the language of --lang, and no text of a file or argument controls the
terminal.
The library for tables and bars is imported when the first is drawn; JSON output does not need it.
"""

import contextlib
import sys
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import click

from ilmek.cli.language import printed, worded
from ilmek.num.compiled import COMPILATIONS
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence

if TYPE_CHECKING:
    from rich.console import Console

    from ilmek.report import Check

WIDTH_IN_A_PIPE = 120


def console() -> "Console":
    """A rich console on standard output that shows texts unchanged."""
    from rich.console import Console

    width = None if sys.stdout.isatty() else WIDTH_IN_A_PIPE
    return Console(file=sys.stdout, width=width, markup=False, highlight=False, emoji=False)


def say(text: str) -> None:
    """Print a text on standard output."""
    console().print(printed(text))


def show_table(
    headings: Sequence[str],
    *groups: Sequence[Sequence[str]],
    right: Sequence[int] = (),
    wide: Sequence[int] = (),
    words: Sequence[int] = (),
) -> None:
    """Print a table; lines divide its groups of rows.

    right  indices of columns aligned to the right
    wide   indices of columns that are never broken
    words  indices of columns with words of the engine, which are said in the language of the command
    """
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for index, heading in enumerate(headings):
        table.add_column(worded(heading), justify="right" if index in right else "left", no_wrap=index in wide)
    for rows in groups:
        for row in rows:
            table.add_row(*(worded(cell) if index in words else printed(cell) for index, cell in enumerate(row)))
        table.add_section()
    console().print(table)


def show_pairs(pairs: Sequence[tuple[str, str]]) -> None:
    """Print names and values, one line each. Lines are never broken, so that a path can be copied."""
    lines = [(worded(name), printed(value)) for name, value in pairs]
    width = max(len(name) for name, _ in lines)
    for name, value in lines:
        click.echo(f"{name:<{width}}  {value}")


def show_checks(checks: "Sequence[Check]") -> None:
    """Print checks with value and limit, failed ones first."""
    from ilmek.report import in_words

    ordered = sorted(checks, key=lambda check: check.ok)
    rows = [
        (
            "pass" if check.ok else "FAIL",
            check.name,
            value,
            f"{check.relation} {limit}" if limit != "yes" else limit,
            check.source,
        )
        for check in ordered
        for value, limit in [in_words(check)]
    ]
    show_table(("check", "", "value", "limit", "source"), rows, right=(2,), words=range(5))


def note(text: str) -> None:
    """Print a note of one line on the error stream."""
    click.echo(printed(Sentence("terminal.note", text=" ".join(printed(text).split()))), err=True)


@contextlib.contextmanager
def progress_bar() -> Iterator[Progress]:
    """A progress bar on a terminal; nothing in a pipe."""
    if not sys.stderr.isatty():
        yield SILENT
        return
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    screen = Console(stderr=True, markup=False, highlight=False)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    with Bar(*columns, console=screen, transient=True) as bar:
        task = bar.add_task("", total=1.0)
        # The first run of a kernel that was not installed with the package takes up to half a minute in all.
        COMPILATIONS.listener = lambda number: bar.update(
            task, description=f"compiling for this processor, once: kernel {number}"
        )
        try:
            yield Progress(lambda stage, share: bar.update(task, description=printed(stage), completed=share))
        finally:
            COMPILATIONS.listener = None
