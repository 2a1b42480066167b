"""The screen of `ilmek call`: large figures, the yarn's name and swatch, the steps that follow; and rows in a pipe.

All in the language that is spoken, with its digits; lines are in the order of reading, which a terminal turns itself.
"""

import os
import sys
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import click

from ilmek.carpet.calling import CallStep, count_text, rightward_in
from ilmek.carpet.overlay import HALF, JUFTI
from ilmek.carpet.yarn import Yarn
from ilmek.cli.keys import pressed_keys
from ilmek.cli.large_figures import large, without_blocks
from ilmek.errors import printable, shortened
from ilmek.io.chart.symbols import signs_of_codes
from ilmek.jobs.call import Calling
from ilmek.sentences import Sentence, language_spoken, noun, numerals, translated

if TYPE_CHECKING:
    from ilmek.drivers.speech import Speaker

_FOLLOWING = 12
"""Largest number of following steps that are shown."""


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


def step_on_terminal(calling: Calling, *, pedal: bool = False, speaker: "Speaker | None" = None) -> None:
    """Show the steps and follow the keys until the last row is done or the weaver ends.

    pedal  the keys are those of a foot switch      speaker  who says each step as well
    """
    plain = os.environ.get("TERM", "dumb") == "dumb"
    depth = colour_depth(os.environ)
    calling.remember()
    _show(calling, depth, plain)
    _speak(calling, speaker)
    for key in pressed_keys(pedal=pedal):
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
        _speak(calling, speaker)
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
        text = without_blocks(text).replace("→", ">").replace("←", "<")
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
        yield _said("call.done", rows=chart.rows)
        return
    steps, step = calling.steps, calling.steps[calling.step]
    arrow = "→" if rightward_in(calling.row, calling.direction) else "←"
    numbers = {"row": calling.row, "rows": chart.rows, "step": calling.step + 1, "steps": len(steps)}
    yield _said("call.row", **numbers, arrow=arrow)[:width]
    yield ""
    yarns = (step.yarn, step.second) if step.mark == HALF else (step.yarn,)
    number = numerals(count_text(step))
    figures = large(number, language_spoken().digits)
    if len(figures[0]) + 18 > width:  # a number is never cut
        figures = (number,)
    signs = signs_of_codes(chart.yarns)
    beside = "  ".join(swatch(chart.yarn(yarn).srgb, 12 // len(yarns), depth) for yarn in yarns)
    for line in figures:
        yield f"{line[: width - 20]}    {beside}".rstrip() if depth else line[:width].rstrip()
    yield ""
    for yarn in yarns:
        yield f"  {signs[yarn]}  {_name(chart.yarn(yarn))}"[:width]
    if step.mark:
        yield from _wrapped(_said("call.half" if step.mark == HALF else "call.jufti"), width, 3)
    yield ""
    yield from _wrapped(_said("call.cells", cells=_cells(step, "  "), columns=chart.columns), width, 6)
    following = "   ".join(_counted(later, signs) for later in steps[calling.step + 1 :][:_FOLLOWING])
    yield from _wrapped(_said("call.then", steps=following) if following else _said("call.then-row"), width, 3)
    for text in calling.notes[-1:]:
        yield from _wrapped(printable(translated(text)), width, 3)
    yield ""
    yield _said("call.keys")[:width]


def _said(key: str, **values: object) -> str:
    """A sentence in the language that is spoken; numbers in its digits, symbols of yarns as they are."""
    written = {name: numerals(str(value)) if isinstance(value, int) else value for name, value in values.items()}
    return translated(Sentence(key, **written))


def _counted(step: CallStep, signs: str) -> str:
    """Number and symbols of a step."""
    return f"{numerals(count_text(step))} {_signs(step, signs)}"


def _cells(step: CallStep, between: str) -> str:
    """The cells of a step; from and to stand in the order of reading."""
    cells = numerals(between.join(step.cells))
    return cells.replace("-", "–") if language_spoken().leftward else cells


def spoken_step(calling: Calling) -> str:
    """What is said of a step: at the begin of a row its number, then the number of knots and the yarn."""
    if calling.done:
        return _said("call.done", rows=calling.chart.rows)
    step = calling.steps[calling.step]
    first, second = (_name(calling.chart.yarn(yarn)) for yarn in (step.yarn, step.second))
    half, jufti = Sentence("call.speak-half", first=first, second=second), Sentence("call.speak-jufti", first=first)
    yarn = translated(half if step.mark == HALF else jufti if step.mark == JUFTI else first)
    row = "" if calling.step else _said("call.speak-row", row=calling.row) + ". "
    return f"{row}{numerals(str(step.knots))}. {yarn}."


def _speak(calling: Calling, speaker: "Speaker | None") -> None:
    """Say the step, and note once that it cannot be said."""
    if speaker is None:
        return
    if speaker.failed:
        note_ = Sentence("call.not-spoken", program=speaker.program, language=speaker.language)
        if note_ not in calling.notes:
            calling.notes.append(note_)
    speaker.say(spoken_step(calling))


def _signs(step: CallStep, signs: str) -> str:
    return signs[step.yarn] + (signs[step.second] if step.mark == HALF else "")


def _name(yarn: Yarn) -> str:
    return shortened(" ".join(printable(translated(noun(yarn.name))).split()), 60)


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
        click.echo(f"{signs[yarn]} {_name(chart.yarn(yarn))}")
    while not calling.done:
        arrow = "→" if rightward_in(calling.row, calling.direction) else "←"
        called = [_counted(step, signs) for step in calling.steps]
        if calling.by == "colours":
            called = [f"{one}: {_cells(step, ' ')}" for one, step in zip(called, calling.steps, strict=True)]
        click.echo(_said("call.printed", row=calling.row, arrow=arrow, steps=", ".join(called)))
        calling.next_row()
