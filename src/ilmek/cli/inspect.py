"""`ilmek inspect`: what a loom programme holds."""

import itertools
import random
from pathlib import Path
from typing import Any

import click
import numpy as np

from ilmek.cli.options import json_option
from ilmek.cli.terminal import console, give_json, show_pairs, show_table
from ilmek.errors import LoomError
from ilmek.io.programme_file import ProgrammeFile, open_programme
from ilmek.loom.row import Row, Ties
from ilmek.units import format_quantity

EXAMPLES = """\b
Examples:
  ilmek inspect carpet/programme.ilmek
  ilmek inspect carpet/programme.ilmek --row 1
  ilmek inspect carpet/programme.ilmek --row 1 --json -
"""


@click.command(epilog=EXAMPLES)
@click.argument("file", type=click.Path(path_type=Path), metavar="FILE.ilmek")
@click.option(
    "--row", "number", type=int, metavar="N", help="The row to show, from 1 at the bottom edge; else a random one."
)
@json_option
def command(file: Path, number: int | None, json_to: str | None) -> None:
    """Show the carpet, colours and statistics of a loom programme, and one row as the heads tie it.

    Rows are counted from 1 at the bottom, knots from 1 at the left, as on the printed chart.
    """
    with open_programme(file) as programme:
        chosen = random.randrange(programme.rows) if number is None else _place(number, programme.rows)
        row = programme.row(chosen)
        time = programme.row_time(chosen)
        if not give_json(json_to, as_json(programme, row, time)):
            show_programme(programme)
            show_row(programme, row, time)


def _place(number: int, rows: int) -> int:
    """The row, from 0, of a person's number. Raises LoomError beyond the carpet."""
    if not 1 <= number <= rows:
        raise LoomError(f"there is no row {number}", allowed=f"rows 1 to {rows}, from the bottom")
    return number - 1


def runs(ties: Ties) -> list[tuple[int, int, int]]:
    """(first knot, last knot, yarn) of neighbouring knots tied one after the other in one yarn; knots from 1 at the
    left, yarns from 0.
    """
    pairs, colours = ties.pairs.astype(np.int64) + 1, ties.colours
    breaks = (np.abs(np.diff(pairs)) != 1) | (np.diff(colours.astype(np.int64)) != 0)
    edges = np.concatenate(([0], np.flatnonzero(breaks) + 1, [len(pairs)])).tolist()
    return [(int(pairs[begin]), int(pairs[end - 1]), int(colours[begin])) for begin, end in itertools.pairwise(edges)]


def as_json(programme: ProgrammeFile, row: Row, time: float) -> dict[str, Any]:
    """The programme's figures and one row, SI. The row's number is from 1 at the bottom, its pairs (the knots, one on
    each pair of warps) from 1 at the left, as on the printed chart; its yarns are places in the list `yarn`, from 0.
    """
    label, totals, work = programme.label, programme.totals, programme.work
    return {
        "rows": programme.rows,
        "columns": programme.columns,
        "knots": totals.knots,
        "heads": programme.heads,
        "weaving_time": totals.duration,
        "colour_changes": totals.changes,
        "changes_per_knot": totals.changes_per_knot,
        "size": {"width": label.size.width, "length": label.size.length, "name": label.size.name},
        "quality": {"across": label.quality.across, "along": label.quality.along},
        "knot": label.knot,
        "warp_pitch": label.warp_pitch,
        "times": {name: getattr(programme.times, name) for name in programme.times.__slots__},
        "yarn": [{"name": y.name, "knots": n} for y, n in zip(label.yarns, totals.counts, strict=True)],
        "work": {name: getattr(work, name) for name in work.__slots__},
        "row": {
            "number": row.number + 1,
            "time": time,
            "forward": row.forward,
            "heads": [{"pairs": ties.pairs.astype(np.int64) + 1, "yarns": ties.colours} for ties in row.ties()],
        },
    }


def show_programme(programme: ProgrammeFile) -> None:
    """The whole carpet: what it is, how long it takes, its yarns, its heads."""
    label, totals, work = programme.label, programme.totals, programme.work
    show_pairs(
        [
            ("carpet", f"{label.size}, {label.quality}, {label.knot} knot"),
            ("rows", f"{programme.rows:,} of {programme.columns:,} knots, {totals.knots:,} in all"),
            ("loom", f"{programme.heads} heads, a warp every {format_quantity(label.warp_pitch, 'mm')}"),
            ("weaving time", f"{format_quantity(totals.duration, 'h')}"),
            ("colour changes", f"{totals.changes:,}, {totals.changes_per_knot:.3f} a knot"),
        ]
    )
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


def show_row(programme: ProgrammeFile, row: Row, time: float) -> None:
    """One row: for each head the runs of knots in the order they are tied."""
    names = [yarn.name for yarn in programme.label.yarns]
    console().print(
        f"row {row.number + 1} of {programme.rows}, from the bottom: {format_quantity(time, 's')}, "
        f"woven to the {'right' if row.forward else 'left'}; knots from the left, in the order they are tied"
    )
    lines = []
    for head, ties in enumerate(row.ties(), 1):
        tied = "  ".join(f"{a}–{b} {names[y]}" if a != b else f"{a} {names[y]}" for a, b, y in runs(ties))
        lines.append((str(head), tied))
    show_table(("head", "ties"), lines, right=(0,))
