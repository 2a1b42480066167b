"""`ilmek call`: a chart row by row on a terminal, for the weaver at the loom."""

import sys
from contextlib import nullcontext
from pathlib import Path

import click

from ilmek.cli.terminal import note
from ilmek.errors import ParameterError, did_you_mean
from ilmek.sentences import DEFAULT, WEAVERS, in_language, translated

BY = ("runs", "colours")

EXAMPLES = """\b
Examples:
  ilmek call carpet/chart.png
  ilmek call carpet/chart.png --from-row 120 --by colours
  ilmek call carpet/chart.png --direction alternate > rows.txt
  ilmek call carpet/chart.png --lang fa --speak --pedal

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
@click.option(
    "--lang", default=DEFAULT, metavar="|".join(WEAVERS), help=f"Language and digits of the call; default: {DEFAULT}."
)
@click.option(
    "--speak", is_flag=True, help="Say each step by the system's speech: espeak-ng, spd-say, say, PowerShell."
)
@click.option(
    "--pedal",
    is_flag=True,
    help="Keys of a foot switch: b, c, page down, space or Enter next; a or page up back; held down it counts once.",
)
def command(*, chart: Path, from_row: int | None, by: str, direction: str, lang: str, speak: bool, pedal: bool) -> int:
    """Call the rows of CHART, a file of a knot chart, step by step with large figures.

    Enter, space or → goes to the next step, b or ← back, n to the next row, p to the row before, q ends. Where it
    stopped is kept after every step, also for a computer that loses power, and the next call goes on there. Without a
    terminal the rows are printed, one a line.
    """
    from ilmek.cli.call_screen import print_rows, step_on_terminal
    from ilmek.drivers.speech import Speaker
    from ilmek.io.chart.formats import read_chart
    from ilmek.jobs.call import DIRECTIONS, begin_calling

    for option, value, choices in (("--by", by, BY), ("--direction", direction, DIRECTIONS), ("--lang", lang, WEAVERS)):
        if value not in choices:
            hint = did_you_mean(value, choices)
            raise ParameterError(f"{option} {value!r}", allowed=", ".join(choices), do=hint)
    on_terminal = sys.stdout.isatty()
    if speak and not on_terminal:
        raise ParameterError("--speak calls on a terminal, and the output is none", do="leave it out")
    speaker = Speaker(lang) if speak else None
    read, notes = read_chart(chart)
    calling = begin_calling(read, by, direction, from_row, keep=on_terminal)
    with in_language(lang), speaker or nullcontext():
        if on_terminal:
            step_on_terminal(calling, pedal=pedal, speaker=speaker)
        else:
            print_rows(calling)
        for text in (*notes, *calling.notes):
            note(translated(text))
    return 0
