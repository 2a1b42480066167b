"""Reading of rows.txt: the rows expanded to the chart's knots and overlay."""

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ilmek.arrays import Indices, Int32
from ilmek.carpet.design import MOST_KNOTS
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, Overlay, overlay_of
from ilmek.carpet.rows import DIRECTIONS, HALF_CODE, JUFTI_CODE, directions, runs_of
from ilmek.carpet.yarn import MOST_YARNS
from ilmek.errors import CarpetError, shortened
from ilmek.io.chart.rows_text import MAGIC
from ilmek.io.text_file import read_text
from ilmek.records import record

LARGEST = 250_000_000
"""Largest size of a rows.txt that is read [bytes]."""

_RUN = re.compile(r"([1-9]\d{0,8})([½j]?):?(\S)(\S?)")
_SPAN = re.compile(r"([1-9]\d{0,8})(?:-([1-9]\d{0,8}))?([LRj]?)")
_LINE = re.compile(r"([1-9]\d{0,8}) ([<>])(?: (\S) (\d{1,9}):)? (\S.*)")
_YARN = re.compile(r"(\S) #[0-9a-f]{6} \d+ ?(.*)")


@record
class WeavingRows:
    """Contents of a rows.txt: the chart's knots and overlay, names of the yarns, split and direction."""

    knots: Indices
    overlay: Overlay
    names: tuple[str, ...]
    split: str
    direction: str


def read_rows(path: Path) -> WeavingRows:
    """Read a rows.txt. Raises CarpetError with the line."""
    try:
        text = read_text(path, noun="rows.txt", largest=LARGEST, error=CarpetError, do="give a rows.txt")
        return parse_rows(text)
    except CarpetError as failed:
        raise CarpetError(f"{path}: {failed.given}", allowed=failed.allowed, do=failed.do) from None


def parse_rows(text: str) -> WeavingRows:
    """The chart that the text of a rows.txt describes. Raises CarpetError with the line.

    Every row must be there in each of its directions, in full, and both directions of a row must agree.
    """
    head, _, body = text.partition("\n\n")
    lines = head.split("\n")
    if lines[0] != MAGIC:
        raise CarpetError(f"line 1: {shortened(lines[0])!r}", allowed=f"a text that begins with {MAGIC!r}")
    facts, symbols, names = _header(lines)
    rows, columns = _number(facts, "rows"), _number(facts, "columns")
    if rows * columns > MOST_KNOTS:
        raise CarpetError(f"{rows * columns:,} knots", allowed=f"at most {MOST_KNOTS:,}")
    split, direction = facts.get("split", ""), facts.get("direction", "")
    if split not in ("runs", "colours") or direction not in DIRECTIONS:
        raise CarpetError(
            f"split {split!r}, direction {direction!r}", allowed=f"runs or colours; {', '.join(DIRECTIONS)}"
        )
    codes = np.full((rows, columns), -1, dtype=np.int32)
    yarn_of = {symbol: index for index, symbol in enumerate(symbols)}
    expanded = _runs(body, columns, yarn_of) if split == "runs" else _colours(body, columns, yarn_of)
    _fill(codes, expanded, direction, len(lines) + 1)
    return WeavingRows(*chart_of_codes(codes), tuple(names), split, direction)


def chart_of_codes(codes: Int32[np.ndarray, "rows columns"]) -> tuple[Indices, Overlay]:
    """Knots and overlay of a chart, the inverse of `row_codes` of all rows."""
    codes = codes[::-1]
    half = codes >= HALF_CODE
    knots = np.where(half, (codes - HALF_CODE) // 256, codes % 256).astype(np.uint8)
    marks = [
        KnotMark(row, column, HALF, int(codes[row, column] - HALF_CODE) % 256)
        for row, column in np.argwhere(half).tolist()
    ]
    for row in np.flatnonzero(((codes >= JUFTI_CODE) & ~half).any(axis=1)).tolist():
        runs = (run for run in runs_of(codes[row]) if run.mark == JUFTI)
        marks += [KnotMark(row, run.first + 2 * knot, JUFTI) for run in runs for knot in range(run.knots)]
    return knots, overlay_of(marks)


def _header(lines: list[str]) -> tuple[dict[str, str], list[str], list[str]]:
    facts: dict[str, str] = {}
    symbols: list[str] = []
    names: list[str] = []
    for at, line in enumerate(lines[1:], start=2):
        key, _, value = line.partition(" ")
        if key == "yarn":
            found = _YARN.fullmatch(value)
            if found is None or found[1] in symbols or len(symbols) >= MOST_YARNS:
                raise _bad(at, line, f"yarn SYMBOL #rrggbb KNOTS NAME, at most {MOST_YARNS}, each symbol once")
            symbols.append(found[1])
            names.append(found[2])
        elif key != "#":
            facts[key] = value
    return facts, symbols, names


def _number(facts: dict[str, str], name: str) -> int:
    value = facts.get(name, "")
    if not re.fullmatch(r"[1-9]\d{0,8}", value):
        raise CarpetError(f"{name} {shortened(value)!r} in the header", allowed="a whole number from 1")
    return int(value)


def _bad(line: int, text: str, allowed: str) -> CarpetError:
    return CarpetError(f"line {line}: {shortened(text)!r}", allowed=allowed)


Entry = tuple[int, int, bool, str, str, list[str]]
"""Of a line: its number, row, whether it is read from left to right, symbol and count of a colour, runs or spans."""


def _entries(body: str) -> Iterator[Entry]:
    """The rows' lines with those that continue them; line numbers are those of the body, from 1."""
    lines = body.split("\n")
    at = 0
    while at < len(lines):
        first, line = at, lines[at]
        at += 1
        if not line:
            continue
        parts = [line]
        while at < len(lines) and lines[at].startswith(" "):
            parts.append(lines[at])
            at += 1
        found = _LINE.fullmatch("".join(parts))
        if found is None:
            raise _bad(first + 1, line, "ROW > RUNS, or ROW > SYMBOL COUNT: CELLS; < for the other direction")
        yield first + 1, int(found[1]), found[2] == ">", found[3] or "", found[4] or "", found[5].split(" ")


Expanded = tuple[int, int, bool, Int32[np.ndarray, " columns"]]
"""A row: its line, number, whether it was read from left to right, and its codes from left to right."""


def _runs(body: str, columns: int, yarn_of: dict[str, int]) -> Iterator[Expanded]:
    for line, row, rightward, symbol, _, parts in _entries(body):
        codes: list[int] = []
        if symbol:
            raise _bad(line, f"{symbol} ...", "runs, as the header states")
        for part in parts:
            found = _RUN.fullmatch(part)
            yarns = [yarn_of.get(sign, -1) for sign in (found[3], found[4]) if sign] if found else []
            if found is None or -1 in yarns or len(yarns) != (2 if found[2] == "½" else 1):
                raise _bad(line, part, "runs like 12A, 3jA, 2½AB, with symbols of the header")
            cells = int(found[1]) * (2 if found[2] == "j" else 1)
            if len(codes) + cells > columns:
                raise _bad(line, part, f"{columns} cells in a row")
            own, other = (yarns if rightward else yarns[::-1]) if found[2] == "½" else (yarns[0], 0)
            codes += [{"": own, "j": JUFTI_CODE + own, "½": HALF_CODE + 256 * own + other}[found[2]]] * cells
        if len(codes) < columns:
            raise _bad(line, f"{len(codes)} cells", f"{columns} cells in a row")
        yield line, row, rightward, np.array(codes if rightward else codes[::-1], dtype=np.int32)


def _colours(body: str, columns: int, yarn_of: dict[str, int]) -> Iterator[Expanded]:
    last: tuple[int, bool] | None = None
    left = right = np.empty(0, dtype=np.int32)
    at = 0
    for line, row, rightward, symbol, count, parts in _entries(body):
        if (row, rightward) != last:
            if last is not None:
                yield at, *last, _joined(at, left, right, last[1])
            last, left, right = (row, rightward), np.full(columns, -1, np.int32), np.full(columns, -1, np.int32)
        at = line
        if symbol not in yarn_of:
            raise _bad(line, symbol, "a symbol of the header")
        if _put_spans(line, parts, yarn_of[symbol], left, right) != int(count):
            raise _bad(line, f"{symbol} {count}", "the number of knots that follow")
    if last is not None:
        yield at, *last, _joined(at, left, right, last[1])


def _put_spans(
    line: int, parts: list[str], yarn: int, left: Int32[np.ndarray, " columns"], right: Int32[np.ndarray, " columns"]
) -> int:
    """Put the knots of a yarn on left and right warps of a row's cells, in the order of reading; their number."""
    knots = 0
    for part in parts:
        found = _SPAN.fullmatch(part)
        first, stop = (int(found[1]) - 1, int(found[2] or found[1])) if found else (0, 0)
        if found is None or not first < stop <= len(left) or (found[3] == "j" and (stop - first) % 2):
            raise _bad(line, part, f"cells 1 to {len(left)}, like 7 or 12-20, with L, R or j (two cells a knot)")
        for side in {"L": (left,), "R": (right,)}.get(found[3], (left, right)):
            if (side[first:stop] >= 0).any():
                raise _bad(line, part, "each cell once")
            side[first:stop] = yarn + (JUFTI_CODE if found[3] == "j" else 0)
        knots += (stop - first) // (2 if found[3] == "j" else 1)
    return knots


def _joined(
    line: int, left: Int32[np.ndarray, " columns"], right: Int32[np.ndarray, " columns"], rightward: bool
) -> Int32[np.ndarray, " columns"]:
    """The codes of a row, from left to right, from the yarns of the left and right warps in the order of reading."""
    if min(left.min(), right.min()) < 0:
        raise CarpetError(f"line {line}: a cell of the row has no knot", allowed="every cell")
    codes = np.where(left == right, left, HALF_CODE + 256 * left + right)
    return np.asarray(codes if rightward else codes[::-1], dtype=np.int32)


def _fill(codes: Int32[np.ndarray, "rows columns"], rows: Iterator[Expanded], direction: str, before: int) -> None:
    """Put the rows into the chart. Raises CarpetError, with the line of the file, where one is missing or wrong."""
    seen: set[tuple[int, bool]] = set()
    try:
        for line, row, rightward, found in rows:
            expected = rightward in directions(row, direction)
            if row > len(codes) or not expected or (row, rightward) in seen:
                raise _bad(
                    line, f"{row} {'>' if rightward else '<'}", f"rows 1 to {len(codes)}, {direction}, each once"
                )
            seen.add((row, rightward))
            if codes[row - 1, 0] >= 0 and not np.array_equal(codes[row - 1], found):
                raise _bad(line, f"row {row}", "the same knots in both directions")
            codes[row - 1] = found
    except CarpetError as failed:
        given = re.sub(r"^line (\d+)", lambda found: f"line {int(found[1]) + before}", failed.given)
        raise CarpetError(given, allowed=failed.allowed, do=failed.do) from None
    missing = [
        row + 1 for row in range(len(codes)) for side in directions(row + 1, direction) if (row + 1, side) not in seen
    ]
    if missing:
        raise CarpetError(f"row {missing[0]} is missing", allowed=f"rows 1 to {len(codes)}")
