"""What a person sees: short tables on standard output, notes and a progress bar on the error stream.

The library that draws tables and bars is imported when the first is drawn: JSON needs none.
"""

import contextlib
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ilmek.progress import SILENT, Progress
from ilmek.units import format_quantity

if TYPE_CHECKING:
    from rich.console import Console

    from ilmek.report import Check

WIDTH_IN_A_PIPE = 120


def console() -> "Console":
    """Standard output as rich sees it; texts are shown as they are."""
    from rich.console import Console

    width = None if sys.stdout.isatty() else WIDTH_IN_A_PIPE
    return Console(file=sys.stdout, width=width, markup=False, highlight=False, emoji=False)


def show_table(
    headings: Sequence[str], *groups: Sequence[Sequence[str]], right: Sequence[int] = (), wide: Sequence[int] = ()
) -> None:
    """A table, its groups of rows divided by lines.

    right  columns aligned to the right      wide  columns that are never broken
    """
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for place, heading in enumerate(headings):
        table.add_column(heading, justify="right" if place in right else "left", no_wrap=place in wide)
    for rows in groups:
        for row in rows:
            table.add_row(*row)
        table.add_section()
    console().print(table)


def show_pairs(pairs: Sequence[tuple[str, str]]) -> None:
    """Names and what they are, a line each, never broken: a path can be copied."""
    width = max(len(name) for name, _ in pairs)
    for name, said in pairs:
        click.echo(f"{name:<{width}}  {said}")


def show_checks(checks: "Sequence[Check]") -> None:
    """Value against limit, the failed ones first."""
    ordered = sorted(checks, key=lambda check: check.ok)
    rows = [
        (
            "pass" if check.ok else "FAIL",
            check.name,
            format_quantity(check.value, check.unit),
            f"{check.relation} {format_quantity(check.limit, check.unit)}",
            check.source,
        )
        for check in ordered
    ]
    show_table(("check", "", "value", "limit", "source"), rows, right=(2,))


def passed(checks: "Sequence[Check]") -> str:
    """How many checks hold, in words, naming those that do not."""
    failed = [check.name for check in checks if not check.ok]
    said = f"{len(checks) - len(failed)} passed, {len(failed)} failed"
    return f"{said}: {'; '.join(failed)}" if failed else said


def note(text: str) -> None:
    """A remark on the error stream, one line."""
    click.echo(f"note: {' '.join(text.split())}", err=True)


def check_json(to: str | None) -> None:
    """Raise OutputError before any work where `--json` says a place that cannot be written."""
    if to not in (None, "-"):
        from ilmek.io.output import check_file

        check_file(Path(str(to)))


def give_json(to: str | None, data: Any) -> bool:
    """Write JSON where `--json` says; whether it went to standard output, which is then kept clean of all else."""
    if to is None:
        return False
    from ilmek.io.json_file import json_text, write_json

    if to == "-":
        click.echo(json_text(data), nl=False)
        return True
    write_json(Path(to), data)
    return False


@contextlib.contextmanager
def progress_bar() -> Iterator[Progress]:
    """A bar for long work on a terminal; nothing in a pipe."""
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
        yield Progress(lambda stage, share: bar.update(task, description=stage, completed=share))
