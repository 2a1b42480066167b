"""Rows to weave by as text, rows.txt: a header, then the rows from the first that is woven (docs/reference/files.md).

    ilmek-rows 1
    ...
    yarn A #8c2d2a 88120 madder
    ...
    1 > 12A 3B 2½AC 1jB 40A            split by runs, read from left to right
    1 < 40A 1jB 2½CA 3B 12A            the same row from right to left
    1 > A 54: 1-12 16-17L 20-59        split by colours

The text of the rows is written by kernels, byte by byte: a carpet of 20 million knots may have as many runs.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ilmek.arrays import Int32, UInt8
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import CODES, NO_KNOT
from ilmek.carpet.rows import DIRECTIONS, HALF_CODE, JUFTI_CODE, row_codes
from ilmek.errors import printable
from ilmek.io.chart.printing import PLAIN, Printing, quality_of, size_of
from ilmek.io.chart.symbols import NO_SIGN, signs_of_codes, symbols
from ilmek.num.compiled import compiled
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence, in_language, noun, translated

MAGIC = "ilmek-rows 1"
"""First line: name and version of the format."""

LONGEST_LINE = 2_000
"""Bytes of a line after which a row goes on in the next one, which begins with a blank."""

_BAND = 1 << 19
"""Knots whose text is written in one call of a kernel: less than 0.1 s, in which an interrupt waits."""

_PER_CELL, _PER_LINE = 20, 32
"""Largest number of bytes of a cell's text, with half knots in two colours, and of the beginnings of a row's lines for
each colour.
"""


def write_rows_text(
    path: Path,
    chart: Chart,
    split: str,
    direction: str = "both",
    progress: Progress = SILENT,
    *,
    printing: Printing = PLAIN,
) -> None:
    """Write the rows of a chart to `path`, with comments and names of yarns in the language of the printing.

    split  runs or colours      direction  of DIRECTIONS
    """
    with path.open("wb") as file:
        with in_language(printing.language):
            file.write(header(chart, split, direction, printing.name).encode("utf-8"))
        for done, part in row_bands(chart, split, direction):
            file.write(part)
            progress(done)


def header(chart: Chart, split: str, direction: str, name: str = "") -> str:
    """The lines before the rows; name: of the carpet."""
    size, quality, tied = chart.size, chart.quality, chart.tied
    signs = symbols(chart.yarns)
    about = Sentence("rows.text", size=size_of(size), quality=quality_of(quality), knot=noun(chart.knot))
    comments = (about, *(Sentence(f"rows.text-{part}") for part in ("signs", split, f"more-{split}")))
    if split == "runs" and chart.cells:
        comments = (*comments, Sentence("rows.text-plain", sign=NO_SIGN))
    lines = [
        MAGIC,
        *((f"# {' '.join(printable(name).split())}",) if name else ()),
        *(f"# {translated(comment)}" for comment in comments),
        f"size {size.width!r} {size.length!r}",
        f"quality {quality.across!r} {quality.along!r}",
        f"knot {chart.knot}",
        f"rows {chart.rows}",
        f"columns {chart.columns}",
        f"split {split}",
        f"direction {direction}",
    ]
    for index, yarn in enumerate(chart.yarns):
        name = " ".join(printable(translated(noun(yarn.name))).split())
        lines.append(f"yarn {signs[index]} {yarn.hex} {tied.of(index)} {name}")
    return "\n".join(lines) + "\n\n"


def row_bands(chart: Chart, split: str, direction: str) -> Iterator[tuple[float, bytes]]:
    """The text of the rows in parts, each with the share of the rows that is then done."""
    glyphs, widths = _glyphs(signs_of_codes(chart.yarns))
    mode, step = DIRECTIONS.index(direction), max(1, _BAND // chart.columns)
    for first in range(0, chart.rows, step):
        stop = min(first + step, chart.rows)
        codes = row_codes(chart, first, stop)
        lines = min(len(chart.yarns), 2 * chart.columns) if split == "colours" else 1
        out = np.empty(2 * (codes.size * _PER_CELL + len(codes) * lines * _PER_LINE), dtype=np.uint8)
        write = _write_colours if split == "colours" else _write_runs
        yield stop / chart.rows, out[: write(codes, first + 1, mode, glyphs, widths, out)].tobytes()


def _glyphs(signs: str) -> tuple[UInt8[np.ndarray, "yarns 4"], UInt8[np.ndarray, " yarns"]]:
    """The symbols in UTF-8, and their lengths [bytes]."""
    encoded = [sign.encode("utf-8") for sign in signs]
    glyphs = np.zeros((len(encoded), 4), dtype=np.uint8)
    for row, data in zip(glyphs, encoded, strict=True):
        row[: len(data)] = list(data)
    return glyphs, np.array([len(data) for data in encoded], dtype=np.uint8)


@compiled
def _read_in(mode: int, number: int, leftward: int) -> bool:
    """Whether a row is read in a direction: 0 both, 1 right, 2 left, 3 alternate."""
    if mode == 3:
        return leftward == (number + 1) % 2
    return mode in (0, leftward + 1)


@compiled
def _put_number(out: UInt8[np.ndarray, " bytes"], at: int, number: int) -> int:
    """Write a number; the position after it."""
    digits = 1
    rest = number
    while rest >= 10:
        rest //= 10
        digits += 1
    rest = number
    for place in range(digits):
        out[at + digits - 1 - place] = 48 + rest % 10
        rest //= 10
    return at + digits


@compiled
def _put_symbol(
    out: UInt8[np.ndarray, " bytes"],
    at: int,
    yarn: int,
    glyphs: UInt8[np.ndarray, "yarns 4"],
    widths: UInt8[np.ndarray, " yarns"],
) -> int:
    """Write a yarn's symbol; the position after it."""
    for byte in range(widths[yarn]):
        out[at + byte] = glyphs[yarn, byte]
    return at + int(widths[yarn])


@compiled
def _put_run(  # noqa: PLR0917
    out: UInt8[np.ndarray, " bytes"],
    at: int,
    cells: int,
    code: int,
    leftward: int,
    glyphs: UInt8[np.ndarray, "yarns 4"],
    widths: UInt8[np.ndarray, " yarns"],
) -> int:
    """Write a run; the position after it."""
    yarn, second = code, -1
    if code >= HALF_CODE:
        yarn, second = (code - HALF_CODE) // 256, (code - HALF_CODE) % 256
        if leftward:
            yarn, second = second, yarn
        at = _put_number(out, at, cells)
        out[at] = 194  # ½ in UTF-8
        out[at + 1] = 189
        at += 2
    elif code >= JUFTI_CODE:
        yarn = code - JUFTI_CODE
        at = _put_number(out, at, cells // 2)
        out[at] = 106  # j
        at += 1
    else:
        at = _put_number(out, at, cells)
    if 48 <= glyphs[yarn, 0] <= 57:
        out[at] = 58  # a colon
        at += 1
    at = _put_symbol(out, at, yarn, glyphs, widths)
    return _put_symbol(out, at, second, glyphs, widths) if second >= 0 else at


@compiled
def _put_space(out: UInt8[np.ndarray, " bytes"], at: int, line: int) -> tuple[int, int]:
    """Write a space, before it a line end where the line from `line` is too long; position and begin of the line."""
    if at - line > LONGEST_LINE:
        out[at] = 10
        at += 1
        line = at
    out[at] = 32
    return at + 1, line


@compiled
def _put_head(out: UInt8[np.ndarray, " bytes"], at: int, number: int, leftward: int) -> int:
    """Write the number of a row and its direction; the position after it."""
    at = _put_number(out, at, number)
    out[at] = 32
    out[at + 1] = 60 if leftward else 62  # < or >
    return at + 2


@compiled
def _write_runs(  # noqa: PLR0917
    codes: Int32[np.ndarray, "rows columns"],
    first: int,
    mode: int,
    glyphs: UInt8[np.ndarray, "yarns 4"],
    widths: UInt8[np.ndarray, " yarns"],
    out: UInt8[np.ndarray, " bytes"],
) -> int:
    """Write rows from number `first` by runs; returns the number of bytes."""
    at, columns = 0, codes.shape[1]
    for row in range(codes.shape[0]):
        for leftward in range(2):
            if not _read_in(mode, first + row, leftward):
                continue
            line = at
            at = _put_head(out, at, first + row, leftward)
            cells = 0
            for place in range(columns):
                column = columns - 1 - place if leftward else place
                following = column - 1 if leftward else column + 1
                cells += 1
                if place == columns - 1 or codes[row, following] != codes[row, column]:
                    at, line = _put_space(out, at, line)
                    at = _put_run(out, at, cells, codes[row, column], leftward, glyphs, widths)
                    cells = 0
            out[at] = 10
            at += 1
    return at


@compiled
def _collect(
    codes: Int32[np.ndarray, " columns"],
    leftward: int,
    spans: Int32[np.ndarray, "spans 4"],
    heads: Int32[np.ndarray, "yarns 2"],
) -> None:
    """The spans of a row by yarn, in the order of reading: each has first position, cells, part and the next one of its
    yarn; `heads` has the first and the last span of each yarn, -1: none.
    """
    columns, made, start = codes.shape[0], 0, 0
    heads[:] = -1
    for place in range(columns):
        column = columns - 1 - place if leftward else place
        code = codes[column]
        following = codes[column - 1 if leftward else column + 1] if place < columns - 1 else -1
        if following == code:
            continue
        half = code >= HALF_CODE
        for side in range(2 if half else 1):
            yarn = code
            part = 0
            if half:
                yarn = (code - HALF_CODE) % 256 if side else (code - HALF_CODE) // 256
                part = 2 + side
            elif code >= JUFTI_CODE:
                yarn = code - JUFTI_CODE
                part = 1
            spans[made, 0], spans[made, 1], spans[made, 2], spans[made, 3] = start, place + 1 - start, part, -1
            if heads[yarn, 0] < 0:
                heads[yarn, 0] = made
            else:
                spans[heads[yarn, 1], 3] = made
            heads[yarn, 1] = made
            made += 1
        start = place + 1


@compiled
def _put_span(out: UInt8[np.ndarray, " bytes"], at: int, span: Int32[np.ndarray, " 4"]) -> int:
    """Write the cells of a span; the position after it."""
    at = _put_number(out, at, span[0] + 1)
    if span[1] > 1:
        out[at] = 45  # -
        at = _put_number(out, at + 1, span[0] + span[1])
    if span[2] > 0:
        out[at] = 106 if span[2] == 1 else 76 if span[2] == 2 else 82  # j, L, R
        at += 1
    return at


@compiled
def _write_colours(  # noqa: PLR0917
    codes: Int32[np.ndarray, "rows columns"],
    first: int,
    mode: int,
    glyphs: UInt8[np.ndarray, "yarns 4"],
    widths: UInt8[np.ndarray, " yarns"],
    out: UInt8[np.ndarray, " bytes"],
) -> int:
    """Write rows from number `first` by colours; returns the number of bytes."""
    at = 0
    spans = np.empty((2 * codes.shape[1], 4), dtype=np.int32)
    heads = np.empty((CODES, 2), dtype=np.int32)
    for row in range(codes.shape[0]):
        for leftward in range(2):
            if not _read_in(mode, first + row, leftward):
                continue
            _collect(codes[row], leftward, spans, heads)
            for yarn in range(NO_KNOT):
                if heads[yarn, 0] < 0:
                    continue
                knots, span = 0, heads[yarn, 0]
                while span >= 0:
                    knots += spans[span, 1] // 2 if spans[span, 2] == 1 else spans[span, 1]
                    span = spans[span, 3]
                line = at
                at = _put_head(out, at, first + row, leftward)
                out[at] = 32
                at = _put_symbol(out, at + 1, yarn, glyphs, widths)
                out[at] = 32
                at = _put_number(out, at + 1, knots)
                out[at] = 58  # a colon
                at += 1
                span = heads[yarn, 0]
                while span >= 0:
                    at, line = _put_space(out, at, line)
                    at = _put_span(out, at, spans[span])
                    span = spans[span, 3]
                out[at] = 10
                at += 1
    return at
