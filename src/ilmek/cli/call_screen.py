"""The screen of `ilmek call`: large figures, the yarn's name and swatch, the steps that follow; and rows in a pipe."""

import os
import sys
from collections.abc import Iterator, Mapping

import click

from ilmek.carpet.calling import CallStep, count_text, rightward_in
from ilmek.carpet.overlay import HALF
from ilmek.carpet.yarn import Yarn
from ilmek.cli.keys import pressed_keys
from ilmek.errors import printable, shortened
from ilmek.io.chart.symbols import signs_of_codes
from ilmek.jobs.call import Calling

FIGURES = {
    "0": ("███", "█ █", "█ █", "█ █", "███"),
    "1": (" █ ", "██ ", " █ ", " █ ", "███"),
    "2": ("███", "  █", "███", "█  ", "███"),
    "3": ("███", "  █", "███", "  █", "███"),
    "4": ("█ █", "█ █", "███", "  █", "  █"),
    "5": ("███", "█  ", "███", "  █", "███"),
    "6": ("███", "█  ", "███", "█ █", "███"),
    "7": ("███", "  █", "  █", " █ ", " █ "),
    "8": ("███", "█ █", "███", "█ █", "███"),
    "9": ("███", "█ █", "███", "  █", "███"),
    "j": ("  █", "   ", "  █", "█ █", "███"),
    "/": ("  █", "  █", " █ ", "█  ", "█  "),
    " ": (" ", " ", " ", " ", " "),
}
"""Large figures, each of five lines of cells that are two characters wide."""

_FOLLOWING = 12
"""Largest number of following steps that are shown."""


def large(text: str) -> tuple[str, ...]:
    """A number in large figures, five lines; ½ is written 1/2.

    >>> for line in large("17"):
    ...     print(f"|{line}|")
    |  ██    ██████|
    |████        ██|
    |  ██        ██|
    |  ██      ██  |
    |██████    ██  |
    """
    figures = [FIGURES[figure] for figure in text.replace("½", " 1/2")]
    return tuple("  ".join("".join(2 * cell for cell in one[line]) for one in figures) for line in range(5))


def colour_depth(environment: Mapping[str, str]) -> int:
    """Colours of the terminal by its environment: 0, 256 or 16777216   [no-color.org; COLORTERM].

    >>> colour_depth({"TERM": "xterm-256color"}), colour_depth({"TERM": "xterm-256color", "NO_COLOR": "1"})
    (256, 0)
    """
    if environment.get("NO_COLOR") or environment.get("TERM", "dumb") == "dumb":
        return 0
    if environment.get("COLORTERM", "") in ("truecolor", "24bit"):
        return 1 << 24
    return 256 if "256color" in environment.get("TERM", "") else 0


def swatch(srgb: tuple[int, int, int], width: int, depth: int) -> str:
    """Blanks on the yarn's colour; on a terminal without colours nothing."""
    if not depth:
        return ""
    if depth == 256:
        cube = [min(range(6), key=lambda step: abs((0, 95, 135, 175, 215, 255)[step] - code)) for code in srgb]
        colour = f"5;{16 + 36 * cube[0] + 6 * cube[1] + cube[2]}"
    else:
        colour = "2;{};{};{}".format(*srgb)
    return f"\x1b[48;{colour}m{' ' * width}\x1b[0m"


def step_on_terminal(calling: Calling) -> None:
    """Show the steps and follow the keys until the last row is done or the weaver ends."""
    plain = os.environ.get("TERM", "dumb") == "dumb"
    depth = colour_depth(os.environ)
    calling.remember()
    _show(calling, depth, plain)
    for key in pressed_keys():
        if key == "quit":
            break
        move = {
            "next": calling.forward,
            "back": calling.back,
            "row": calling.next_row,
            "row before": calling.row_before,
        }.get(key)
        if move is not None:
            move()
            calling.remember()
        _show(calling, depth, plain)
        if calling.done:
            break
    click.echo("")


def _show(calling: Calling, depth: int, plain: bool) -> None:
    width, height = _terminal_size()
    lines = list(screen_lines(calling, depth, width))[: max(8, height - 1)]
    text = "\n".join(lines)
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except UnicodeEncodeError:  # a figure of question marks cannot be read
        text = text.replace("█", "#").replace("→", ">").replace("←", "<")
    sys.stdout.write(("" if plain else "\x1b[H\x1b[2J") + text + "\n")
    sys.stdout.flush()


def _terminal_size() -> tuple[int, int]:
    try:
        size = os.get_terminal_size(sys.stdout.fileno())
    except (OSError, ValueError):
        return 80, 24
    return max(20, size.columns or 80), max(10, size.lines or 24)


def screen_lines(calling: Calling, depth: int, width: int) -> Iterator[str]:
    """The lines of a screen of a width in characters."""
    chart = calling.chart
    if calling.done:
        yield f"All {chart.rows} rows are done."
        return
    steps, step = calling.steps, calling.steps[calling.step]
    arrow = "→" if rightward_in(calling.row, calling.direction) else "←"
    yield f"Row {calling.row} of {chart.rows} {arrow}   step {calling.step + 1} of {len(steps)}"[:width]
    yield ""
    yarns = (step.yarn, step.second) if step.mark == HALF else (step.yarn,)
    figures = large(count_text(step))
    if len(figures[0]) + 18 > width:  # a number is never cut
        figures = (count_text(step),)
    signs = signs_of_codes(chart.yarns)
    beside = "  ".join(swatch(chart.yarn(yarn).srgb, 12 // len(yarns), depth) for yarn in yarns)
    for line in figures:
        yield f"{line[: width - 20]}    {beside}".rstrip() if depth else line[:width].rstrip()
    yield ""
    for yarn in yarns:
        yield f"  {signs[yarn]}  {_name(chart.yarn(yarn))}"[:width]
    if step.mark:
        half = "half knots: the first yarn on the warp that is met first"
        yield from _wrapped(half if step.mark == HALF else "jufti knots, on four warps", width, 3)
    yield ""
    yield from _wrapped(f"cells {'  '.join(step.cells)} of {chart.columns}", width, 6)
    following = [f"{count_text(one)} {_signs(one, signs)}" for one in steps[calling.step + 1 :][:_FOLLOWING]]
    yield from _wrapped(f"then {'   '.join(following)}" if following else "then the next row", width, 3)
    for text in calling.notes[-1:]:
        yield from _wrapped(printable(text), width, 3)
    yield ""
    yield "Enter next   b back   n next row   p row before   q end"[:width]


def _signs(step: CallStep, signs: str) -> str:
    return signs[step.yarn] + (signs[step.second] if step.mark == HALF else "")


def _name(yarn: Yarn) -> str:
    return shortened(" ".join(printable(yarn.name).split()), 60)


def _wrapped(text: str, width: int, most: int) -> list[str]:
    """A text in lines of at most `width` characters, at most `most` of them."""
    lines, line = [], ""
    for word in text.split(" "):
        if line and len(line) + 1 + len(word) > width:
            lines.append(line)
            line = word[:width]
        else:
            line = f"{line} {word}" if line else word[:width]
    lines.append(line)
    return lines if len(lines) <= most else [*lines[: most - 1], f"{lines[most - 1][: width - 2]} …"]


def print_rows(calling: Calling) -> None:
    """Print the rows from the present one, one a line, with the yarns' names first."""
    chart, signs = calling.chart, signs_of_codes(calling.chart.yarns)
    for yarn in chart.used:
        click.echo(f"{signs[yarn]} {_name(chart.yarns[yarn])}")
    while not calling.done:
        arrow = "→" if rightward_in(calling.row, calling.direction) else "←"
        called = [f"{count_text(step)} {_signs(step, signs)}" for step in calling.steps]
        if calling.by == "colours":
            cells = (" ".join(step.cells) for step in calling.steps)
            called = [f"{one}: {where}" for one, where in zip(called, cells, strict=True)]
        click.echo(f"row {calling.row} {arrow} {', '.join(called)}")
        calling.next_row()
