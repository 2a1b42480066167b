"""The programme of a tufting machine as text: a head of names and values, then a line for each stroke.

    ilmek tufting 1
    gauge 3.175                     lengths in mm
    ...
    thread 0 #5a1e20 dark red       of the colours in turn, from needle to needle
    feed A 23.63                    yarn of a needle at a stroke
    strokes
    0 1- 7A 1B                      position of the bar; then how many needles have which feed, from the first; - is out

Needles count from the left of the pile, strokes from the lower end of the carpet.
"""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from ilmek.arrays import Int32
from ilmek.errors import ParameterError, restated
from ilmek.io.text_file import read_text
from ilmek.units import mm
from ilmek.weaving.tufting.programme import OUT, UNIT, TuftGrid, TuftProgramme

HEAD = "ilmek tufting 1"
LARGEST = 500_000_000
"""Largest size of a file [bytes]: of a carpet of 5 m by 12 m in 16 colours."""

_GRID = ("gauge", "stitch", "height", "low", "hidden", "backing")
"""Lengths of the grid."""

_COUNTS = ("back", "advance", "rows", "columns", "needles", "first")


def write_tufting(path: Path, programme: TuftProgramme, threads: Sequence[tuple[str, str]]) -> None:
    """Write a programme; threads: name and colour of each thread. Raises OSError."""
    with path.open("w", encoding="utf-8") as file:
        file.writelines(line + "\n" for line in _lines(programme, threads))


def _lines(programme: TuftProgramme, threads: Sequence[tuple[str, str]]) -> Iterator[str]:
    grid = programme.grid
    yield HEAD
    yield from (f"{name} {getattr(grid, name) / mm!r}" for name in _GRID)
    yield f"back {grid.back!r}\nadvance {programme.advance / mm!r}"
    yield f"rows {programme.rows}\ncolumns {programme.columns}"
    yield f"needles {programme.threads.size}\nfirst {programme.first}"
    for number, (name, colour) in enumerate(threads):
        yield f"thread {number} {colour} {' '.join(name.split())}"
    fed = np.unique(programme.feeds)
    names = ["-" if feed == OUT else _letters(number) for number, feed in enumerate(fed.tolist())]
    yield from (
        f"feed {name} {feed * UNIT / mm:.2f}" for name, feed in zip(names, fed.tolist(), strict=True) if feed != OUT
    )
    yield "strokes"
    for shift, feeds in zip(programme.shifts.tolist(), programme.feeds, strict=True):
        begin = np.flatnonzero(np.diff(feeds, prepend=feeds[0] - 1))
        number = np.diff(begin, append=feeds.size).tolist()
        own = np.searchsorted(fed, feeds[begin]).tolist()
        yield f"{shift} " + " ".join(f"{times}{names[feed]}" for times, feed in zip(number, own, strict=True))


def _letters(number: int) -> str:
    """A name of capital letters.

    >>> [_letters(number) for number in (0, 25, 26, 701, 702)]
    ['A', 'Z', 'AA', 'ZZ', 'AAA']
    """
    text = ""
    while number >= 0:
        number, digit = number // 26 - 1, number % 26
        text = chr(ord("A") + digit) + text
    return text


def read_tufting(path: Path) -> TuftProgramme:
    """The programme of a file. Raises ParameterError, with the line, for what is none."""
    with restated(ParameterError, f"{path}: ", of=ParameterError):
        text = read_text(path, noun="tufting programme", largest=LARGEST, error=ParameterError, do="check its name")
        lines = text.splitlines()
        if lines[0] != HEAD or "strokes" not in lines:
            raise ParameterError(f"is no tufting programme: line 1 is {lines[0][:40]!r}", allowed=HEAD)
        end = lines.index("strokes")
        entries = [line.split(" ", 2) for line in lines[1:end]]
        values = {entry[0]: entry[1] for entry in entries if len(entry) == 2}
        feeds = {entry[1]: round(float(entry[2]) * mm / UNIT) for entry in entries if entry[0] == "feed"}
        colours = sum(entry[0] == "thread" for entry in entries)
        missing = [name for name in (*_GRID, *_COUNTS) if name not in values]
        if missing:
            raise ParameterError(f"the head has no {' and no '.join(missing)}", do="write the programme again")
        needles = int(values["needles"])
        strokes = [_stroke(line, feeds | {"-": OUT}, needles, end + 2 + k) for k, line in enumerate(lines[end + 1 :])]
        return TuftProgramme(
            TuftGrid(**{name: float(values[name]) * mm for name in _GRID}, back=float(values["back"])),
            int(values["rows"]),
            int(values["columns"]),
            np.arange(needles) % colours,
            int(values["first"]),
            np.array([shift for shift, _ in strokes]),
            float(values["advance"]) * mm,
            np.array([own for _, own in strokes], dtype=np.int32),
        )


def _stroke(line: str, feeds: dict[str, int], needles: int, number: int) -> tuple[int, Int32[np.ndarray, " needles"]]:
    """Position of the bar and feed of each needle, of a line with its number."""
    shift, *runs = line.split(" ")
    names = [run.lstrip("0123456789") for run in runs]
    unknown = [name for name in names if name not in feeds]
    if unknown:
        raise ParameterError(f"line {number}: the feed {unknown[0]!r}", allowed="one of the head, or -")
    times = [int(run[: len(run) - len(name)]) for run, name in zip(runs, names, strict=True)]
    if sum(times) != needles:
        raise ParameterError(f"line {number} has {sum(times)} needles", allowed=f"{needles}, as in the head")
    return int(shift), np.repeat(np.array([feeds[name] for name in names], dtype=np.int32), times)
