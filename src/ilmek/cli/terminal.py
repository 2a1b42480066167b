"""What a person sees: short tables on standard output, notes and a progress bar on the error stream."""

import contextlib
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import click
from rich import box
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from ilmek.io.json_file import json_text, write_json
from ilmek.io.output import check_file
from ilmek.jobs.progress import Told
from ilmek.report import Check
from ilmek.units import format_quantity

WIDTH_IN_A_PIPE = 120


def console() -> Console:
    """Standard output as rich sees it; texts are shown as they are."""
    width = None if sys.stdout.isatty() else WIDTH_IN_A_PIPE
    return Console(file=sys.stdout, width=width, markup=False, highlight=False, emoji=False)


def show_table(
    headings: Sequence[str], *groups: Sequence[Sequence[str]], right: Sequence[int] = (), wide: Sequence[int] = ()
) -> None:
    """A table, its groups of rows divided by lines.

    right  columns aligned to the right      wide  columns that are never broken
    """
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


def show_checks(checks: Sequence[Check]) -> None:
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


def passed(checks: Sequence[Check]) -> str:
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
        check_file(Path(str(to)))


def give_json(to: str | None, data: Any) -> bool:
    """Write JSON where `--json` says; whether it went to standard output, which is then kept clean of all else."""
    if to is None:
        return False
    if to == "-":
        click.echo(json_text(data), nl=False)
        return True
    write_json(Path(to), data)
    return False


@contextlib.contextmanager
def progress_bar() -> Iterator[Told | None]:
    """A bar for long work on a terminal; nothing (None) in a pipe."""
    if not sys.stderr.isatty():
        yield None
        return
    screen = Console(stderr=True, markup=False, highlight=False)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, console=screen, transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda doing, share: bar.update(task, description=doing, completed=share)
