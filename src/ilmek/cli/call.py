"""`ilmek call`: a chart row by row on a terminal, for the weaver at the loom."""

import sys
from pathlib import Path

import click

from ilmek.cli.terminal import note
from ilmek.errors import ParameterError, did_you_mean

BY = ("runs", "colours")

EXAMPLES = """\b
Examples:
  ilmek call carpet/chart.png
  ilmek call carpet/chart.png --from-row 120 --by colours
  ilmek call carpet/chart.png --direction alternate > rows.txt

Limits: picture file 500 MB; 200,000,000 knots.
"""


@click.command(epilog=EXAMPLES)
@click.argument("chart", type=click.Path(path_type=Path))
@click.option(
    "--from-row",
    type=int,
    metavar="N",
    help="Row to begin with, counted from 1 at the lower edge; default: where the last call of this chart stopped.",
)
@click.option(
    "--by", default="runs", metavar="runs|colours", help="Call each run, or each colour once per row; default: runs."
)
@click.option(
    "--direction",
    default="right",
    metavar="right|left|alternate",
    help="Read rows to the right, to the left, or odd rows right and even rows left; default: right.",
)
def command(chart: Path, from_row: int | None, by: str, direction: str) -> int:
    """Call the rows of CHART, a file of a knot chart, step by step with large figures.

    Enter, space or → goes to the next step, b or ← back, n to the next row, p to the row before, q ends. Where it
    stopped is kept after every step, also for a computer that loses power, and the next call goes on there. Without a
    terminal the rows are printed, one a line.
    """
    from ilmek.cli.call_screen import print_rows, step_on_terminal
    from ilmek.io.chart.formats import read_chart
    from ilmek.jobs.call import DIRECTIONS, begin_calling

    for option, value, choices in (("--by", by, BY), ("--direction", direction, DIRECTIONS)):
        if value not in choices:
            hint = did_you_mean(value, choices)
            raise ParameterError(f"{option} {value!r}", allowed=", ".join(choices), do=hint)
    on_terminal = sys.stdout.isatty()
    read, notes = read_chart(chart)
    calling = begin_calling(read, by, direction, from_row, keep=on_terminal)
    if on_terminal:
        step_on_terminal(calling)
    else:
        print_rows(calling)
    for text in (*notes, *calling.notes):
        note(text)
    return 0
