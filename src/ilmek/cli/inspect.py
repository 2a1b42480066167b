"""`ilmek inspect`: show a loom programme."""

from collections.abc import Sequence
from pathlib import Path

import click

from ilmek.cli.call_outputs import call_outputs
from ilmek.cli.options import force_option, json_option
from ilmek.cli.terminal import say, show_pairs, show_table
from ilmek.io.programme_file import ProgrammeFile
from ilmek.jobs.inspect import InspectionResult, inspect_programme, runs
from ilmek.loom.bobbins import ChangeStop
from ilmek.units import format_quantity

MOST_RUNS = 4000
"""Largest number of runs of a row that are printed; a table of more takes seconds, and nobody reads it."""

MOST_STOPS = 20
"""Largest number of stops that are printed."""

EXAMPLES = """\b
Examples:
  ilmek inspect carpet/programme.ilmek
  ilmek inspect carpet/programme.ilmek --row 1
  ilmek inspect carpet/programme.ilmek --row 1 --json -

Limits: file 1,000 MB.
"""


@click.command(epilog=EXAMPLES)
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE.ilmek")
@click.option(
    "--row",
    "number",
    type=int,
    metavar="N",
    help="Row to show, counted from 1 at the bottom edge; default: a random row.",
)
@force_option
@json_option
def command(file: Path, number: int | None, force: bool, json_to: str | None) -> None:
    """Show the carpet, colours and statistics of a loom programme, and one row as the heads tie it.

    Rows are counted from 1 at the bottom, knots from 1 at the left, as on the printed chart.
    """
    with call_outputs({"--json": json_to}, force=force, inputs={"FILE": file}) as call:
        found = inspect_programme(file, number, progress=call.progress)
        call.give_json(found.as_json)
    if not call.quiet:
        show_programme(found.programme)
        show_row(found)


def show_programme(programme: ProgrammeFile) -> None:
    """Print size, weaving time, yarns and heads of the whole carpet."""
    label, totals, work = programme.label, programme.totals, programme.work
    show_pairs(
        [
            ("carpet", f"{label.size}, {label.quality}, {label.knot} knot"),
            ("rows", f"{programme.rows:,} of {programme.columns:,} knots, {totals.knots:,} in all"),
            ("loom", f"{programme.heads} heads, warp pitch {format_quantity(label.warp_pitch, 'mm')}"),
            ("weaving time", f"{format_quantity(totals.duration, 'h')}"),
            ("colour changes", f"{totals.changes:,}, {totals.changes_per_knot:.3f} per knot"),
            ("stops", stops_in_words(programme.stops)),
        ]
    )
    bobbins = [
        (one.yarn, f"{one.rows:,}", f"{one.changes(programme.rows):,}", format_quantity(one.time, "s"))
        for one in programme.bobbins
    ]
    if bobbins:
        show_table(("bobbin", "rows", "changes", "time of one"), bobbins, right=(1, 2, 3))
    counted = [
        (yarn.name, yarn.hex, f"{count:,}", f"{count / totals.knots:.1%}")
        for yarn, count in zip(label.yarns, totals.counts, strict=True)
        if count
    ]
    show_table(("yarn", "colour", "knots", "share"), counted, right=(2, 3))
    heads = [
        (str(head + 1), f"{knots:,}", f"{changes:,}", format_quantity(busy, "h"))
        for head, (knots, changes, busy) in enumerate(zip(work.knots, work.changes, work.busy, strict=True))
    ]
    show_table(("head", "knots", "colour changes", "busy"), heads, right=(0, 1, 2, 3))


def stops_in_words(stops: Sequence[ChangeStop]) -> str:
    """The rows before which the loom stops, from 1 at the bottom, up to MOST_STOPS."""
    if not stops:
        return "none: no bobbin of weft is changed"
    rows = ", ".join(str(one.row + 1) for one in stops[:MOST_STOPS])
    more = f", … {len(stops) - MOST_STOPS:,} more: see --json" if len(stops) > MOST_STOPS else ""
    time = format_quantity(sum(one.time for one in stops), "min", 3)
    return f"{len(stops):,}, {time} in all, to change bobbins before row {rows}{more}"


def show_row(found: InspectionResult) -> None:
    """Print one row: for each head its runs of knots in the order of tying, up to MOST_RUNS of all heads."""
    row, names = found.row, [yarn.name for yarn in found.programme.label.yarns]
    say(
        f"row {row.number + 1} of {found.programme.rows}, from the bottom: {format_quantity(found.time, 's')}, "
        f"woven to the {'right' if row.forward else 'left'}; knots from the left, in the order of tying"
    )
    lines, most = [], max(1, MOST_RUNS // row.heads)
    for head, ties in enumerate(row.ties(), 1):
        tied = runs(ties)
        shown = [f"{a}–{b} {names[y]}" if a != b else f"{a} {names[y]}" for a, b, y in tied[:most]]
        if len(tied) > most:
            shown.append(f"… {len(tied) - most:,} more: see --json")
        lines.append((str(head), "  ".join(shown)))
    show_table(("head", "ties"), lines, right=(0,))
