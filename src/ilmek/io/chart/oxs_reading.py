"""Reading of OXS charts, ilmek's own and those of cross-stitch programs, as knot charts.

A full stitch is a knot. A three-quarter stitch (direction 1, 2) is a half knot in each of its colours, left and right,
over the cell's full stitch where it has one colour. A half stitch (direction 3, 4), whose thread crosses the cell, is a
knot. A cell without a stitch is bare cloth, flat weave in the carpet; one with a stitch on one half alone is refused.

The file is untrusted: no document type, hence no entities; bounded size, depth, grid and palette. It is parsed in
blocks; every element is checked as it comes.
"""

import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple
from xml.parsers import expat

import numpy as np

from ilmek.arrays import Indices, Int
from ilmek.carpet.cells import PLAIN_GROUND, all_knots
from ilmek.carpet.chart import Chart
from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.exact import has_grid, of_grid
from ilmek.carpet.overlay import HALF, KnotMark, overlay_of
from ilmek.carpet.picture_points import hex_colour, read_colour
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import MOST_YARNS, Yarn
from ilmek.errors import IlmekError, PictureError, is_printable, shortened
from ilmek.io.carpet_facts import ChartFacts, chart_of_facts, read_facts
from ilmek.io.cells_text import read_cells
from ilmek.io.chart.oxs import MOST_OXS_KNOTS
from ilmek.io.data_text import LONGEST_NAME
from ilmek.io.overlay_text import read_overlay
from ilmek.io.regular_file import open_regular
from ilmek.progress import SILENT, Progress
from ilmek.units import counted

LARGEST_OXS = 300_000_000
"""Largest size of an OXS file [bytes]."""

MOST_ITEMS = 2000
"""Largest number of items of a palette, and largest index of one."""

DEEPEST_OXS = 8
"""Largest depth of elements; a chart has three."""

SHORTEST_SIDE = 2

_BLOCK = 1 << 20
_BEGIN = 4096
_WHOLE = re.compile(r"\s*([0-9]{1,7})(?:\.0{1,9})?\s*")
_COLOUR = re.compile(r"\s*#?([0-9a-fA-F]{6})\s*")
_FULL, _LEFT, _RIGHT = range(3)
"""Layers of a chart's stitches: full ones, left and right parts."""

_LEFT_OUT = {
    "backstitch": ("back stitch", "back stitches"),
    "object": ("knot, bead or other ornament", "knots, beads and other ornaments"),
    "commentbox": ("comment", "comments"),
}


def begins_oxs(begin: bytes) -> bool:
    """Whether a file that begins with these bytes is an OXS chart."""
    begin = begin[:_BEGIN]
    return begin.lstrip(b"\xef\xbb\xbf \t\r\n").startswith((b"<?xml", b"<chart")) and b"<chart" in begin


def read_chart_oxs(
    path: Path,
    size: CarpetSize | None = None,
    quality: Quality | None = None,
    progress: Progress = SILENT,
    ground: str | None = None,
) -> tuple[Chart, tuple[str, ...]]:
    """The chart of an OXS file, and notes on what is left out.

    A chart that ilmek wrote comes back as it was. Of another program's chart, the stitches are the knots, the colours
    of the palette the yarns, whose count is left open; its size follows from the quality.

    size, quality  of the carpet, for a chart of another program; default: as of a drawing
    ground         colour of the knots in cells without a stitch, `#rrggbb`: a yarn of the palette or one more, "ground"
    Raises PictureError for a file that is no such chart or exceeds the limits, and for cells with a stitch on one half
    where no ground is given; CarpetError for a grid that no carpet of the size or the quality has; Cancelled.
    """
    reader = _Reader()
    try:
        reader.parse(path, progress)
        stitches, more = reader.grid(None if ground is None else hex_colour(read_colour("ground", ground)))
        return _chart(reader, stitches, more, size, quality)
    except expat.ExpatError as error:
        given = f"{path}, line {error.lineno}: {expat.errors.messages[error.code]}"
        raise PictureError(given, do="it is damaged or truncated; save or copy it again") from None
    except _FaultError as fault:
        raise PictureError(f"{path}, line {reader.line}: {fault.given}", allowed=fault.allowed, do=fault.do) from None
    except OSError as error:
        raise PictureError(f"{path} cannot be read ({error.strerror or error})") from None


class _FaultError(IlmekError):
    """A fault of the file at the line that is read."""


class _Stitches(NamedTuple):
    """The palette's index of each cell's knot on its left and on its right warp, above 0."""

    left: Int[np.ndarray, "rows columns"]
    right: Int[np.ndarray, "rows columns"]


class _Reader:
    """Takes the elements of a file one by one."""

    def __init__(self) -> None:
        self.depth = 0
        self.palette: dict[int, tuple[str, str]] = {}  # name and colour by index
        self.left_out: Counter[tuple[str, str]] = Counter()
        self.facts = self.overlay = self.cells = self.software = ""
        self._stitches: Int[np.ndarray, "layers rows columns"] | None = None
        self._parser: Any = expat.ParserCreate()
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.StartDoctypeDeclHandler = self._refuse_doctype
        self._parser.EntityDeclHandler = self._refuse_doctype

    @property
    def line(self) -> int:
        """The line that is read."""
        return int(self._parser.CurrentLineNumber)

    def parse(self, path: Path, progress: Progress) -> None:
        """Parse the whole file."""
        file, size = open_regular(path)
        with file:
            if size > LARGEST_OXS:
                raise _FaultError(f"it has {size / 1e6:,.0f} MB", allowed=f"at most {LARGEST_OXS // 1_000_000} MB")
            done = 0
            while done < size and (block := file.read(min(_BLOCK, size - done))):
                done += len(block)
                self._parser.Parse(block, False)
                progress(done / size)
            self._parser.Parse(b"", True)

    def grid(self, ground: str | None) -> tuple[_Stitches, tuple[str, ...]]:
        """The palette's index of each knot, on left and right warps, and notes."""
        if self._stitches is None:
            raise _FaultError("it has no stitches", allowed="a chart of full stitches")
        rows, columns = (int(side) - 1 for side in self._stitches.shape[1:])
        beyond = bool(self._stitches[:, rows].any() or self._stitches[:, :, columns].any())
        if beyond and (self._stitches[:, 0].any() or self._stitches[:, :, 0].any()):
            given = f"a stitch is outside of the chart of {columns} × {rows}"
            raise _FaultError(given, allowed=f"x 0 to {columns - 1}, y 0 to {rows - 1}")
        full, left, right = self._stitches[:, 1:, 1:] if beyond else self._stitches[:, :rows, :columns]
        left, right = np.where(left, left, full), np.where(right, right, full)
        bare = (left == 0) | (right == 0) if ground is not None else (left == 0) != (right == 0)
        if not self.cells and bare.any():
            filled = self._ground(ground, int(np.count_nonzero(bare)), left.size)
            left[left == 0], right[right == 0] = filled, filled
        return _Stitches(left, right), ("its stitches are numbered from 1",) if beyond else ()

    def _ground(self, ground: str | None, bare: int, cells: int) -> int:
        """The palette's index of the yarn for cells without a stitch. Raises _FaultError where none is given."""
        if ground is None:
            raise _FaultError(
                f"{bare} of its {counted(cells, 'cell')} have a stitch on one half: the other is bare cloth",
                allowed="a stitch on both halves of a cell, or on none: that is flat weave",
                do="give the colour of these knots, as --ground '#ffffff'",
            )
        colour = ground.removeprefix("#")
        same = [index for index, (_, other) in self.palette.items() if other == colour and index > 0]
        index = same[0] if same else max(self.palette, default=0) + 1
        self.palette.setdefault(index, ("ground", colour))
        return index

    def _refuse_doctype(self, *_: object) -> None:
        raise _FaultError("it has a document type", allowed="an OXS chart has none")

    def _start(self, name: str, given: dict[str, str]) -> None:
        self.depth += 1
        if self.depth > DEEPEST_OXS:
            raise _FaultError("it is nested too deeply", allowed=f"at most {DEEPEST_OXS} levels")
        if self.depth == 1 and name != "chart":
            raise _FaultError(f"it is no OXS chart: it begins with {shortened(name)!r}", allowed="<chart>")
        if name == "stitch":
            self._stitch(given, {_FULL: "palindex"})
        elif name == "partstitch":
            whole = _whole(given, "direction", 4) > 2
            self._stitch(given, {_FULL: "palindex1"} if whole else {_LEFT: "palindex1", _RIGHT: "palindex2"})
        elif name == "palette_item":
            self._palette_item(given)
        elif name == "properties":
            self._properties(given)
        elif name == "ilmek":
            self.facts, self.overlay, self.cells = (given.get(key, "") for key in ("facts", "overlay", "cells"))
        elif name in _LEFT_OUT:
            self.left_out[_LEFT_OUT[name]] += 1

    def _end(self, _name: str) -> None:
        self.depth -= 1

    def _properties(self, given: dict[str, str]) -> None:
        rows = _whole(given, "chartheight", MOST_OXS_KNOTS)
        columns = _whole(given, "chartwidth", MOST_OXS_KNOTS)
        if min(rows, columns) < SHORTEST_SIDE or rows * columns > MOST_OXS_KNOTS:
            allowed = f"{SHORTEST_SIDE} × {SHORTEST_SIDE} to {MOST_OXS_KNOTS:,} in all"
            raise _FaultError(f"a chart of {columns} × {rows} stitches", allowed=allowed)
        if self._stitches is not None:
            raise _FaultError("it has two sections of properties", allowed="one, before the stitches")
        self.software = given.get("software", "")
        self._stitches = np.zeros(
            (3, rows + 1, columns + 1), dtype=np.int16
        )  # one more, for programs that count from 1

    def _palette_item(self, given: dict[str, str]) -> None:
        index = _whole(given, "index", MOST_ITEMS) if "index" in given else len(self.palette)
        if index in self.palette:
            raise _FaultError(f"the palette has two items {index}")
        colour = _COLOUR.fullmatch(given.get("color", "FFFFFF" if index == 0 else "FF00FF"))
        if colour is None:
            raise _FaultError(f"color {shortened(given['color'])!r} is no colour", allowed="six hexadecimal digits")
        number, name = given.get("number", "").split(), given.get("name", "").split()
        words = name if number[:1] == ["ilmek"] or number == name else [*number, *name]
        self.palette[index] = " ".join(words), colour[1].lower()

    def _stitch(self, given: dict[str, str], layers: Mapping[int, str]) -> None:
        """Take a stitch whose colours, by layer, stand in these attributes; the cloth's colour is no stitch."""
        if self._stitches is None:
            raise _FaultError("a stitch comes before the properties", allowed="<properties> with chartwidth first")
        rows, columns = self._stitches.shape[1:]
        x, y = _whole(given, "x", columns - 1), _whole(given, "y", rows - 1)
        for layer, name in layers.items():
            index = _whole(given, name, MOST_ITEMS)
            if index not in self.palette:
                raise _FaultError(f"the stitch at x {x}, y {y} has the colour {index}, which the palette has not")
            self._stitches[layer, y, x] = index or self._stitches[layer, y, x]


def _whole(given: dict[str, str], name: str, most: int) -> int:
    found = _WHOLE.fullmatch(given.get(name, ""))
    if found is None or int(found[1]) > most:
        written = f"{name} {shortened(given[name])!r}" if name in given else f"no {name}"
        raise _FaultError(f"an element has {written}", allowed=f"a whole number, 0 to {most:,}")
    return int(found[1])


def _chart(
    reader: _Reader, stitches: _Stitches, notes: tuple[str, ...], size: CarpetSize | None, quality: Quality | None
) -> tuple[Chart, tuple[str, ...]]:
    left_out = [counted(count, *names) for names, count in sorted(reader.left_out.items())]
    if left_out:
        notes = (*notes, f"left out of the chart: {', '.join(left_out)}")
    if reader.facts:
        try:
            return _own(reader, stitches), notes
        except IlmekError as error:
            if reader.cells and not stitches.left.all():
                raise
            notes = (*notes, f"its data of ilmek cannot be used ({error.given}); it is read as that of another program")
    yarns, position = _yarns(reader, stitches)
    knots, seconds = position[stitches.left], position[stitches.right]
    rows, columns = np.nonzero(knots != seconds)
    halves = zip(rows.tolist(), columns.tolist(), seconds[rows, columns].tolist(), strict=True)
    grid = (int(knots.shape[0]), int(knots.shape[1]))
    if size is None or quality is None or not has_grid(grid, size, quality):
        size, quality = of_grid(grid, None if quality else size, quality)
    bare = stitches.left == 0
    cells = all_knots(*grid).woven(bare, PLAIN_GROUND).merged()
    if cells is not None:
        notes = (*notes, f"{counted(int(bare.sum()), 'cell')} without a stitch: flat weave; --ground makes them knots")
    chart = chart_of_facts(knots, ChartFacts(size, quality, "symmetric", yarns), "an OXS chart", cells)
    overlay = overlay_of(KnotMark(row, column, HALF, second) for row, column, second in halves)
    return replace(chart, overlay=overlay), (*notes, "its palette is the yarn list")


def _own(reader: _Reader, stitches: _Stitches) -> Chart:
    """The chart that ilmek wrote. Raises an IlmekError where another program has changed it."""
    facts = read_facts(reader.facts)
    colours = [f"#{colour}" for index, (_, colour) in sorted(reader.palette.items()) if index > 0]
    if colours != [yarn.hex for yarn in facts.yarns]:
        raise _FaultError("the palette was changed")
    knots = (stitches.left - 1).astype(np.uint8)  # bare cloth: NO_KNOT
    cells = read_cells(reader.cells, knots)
    if cells is not None and not np.array_equal(cells.tied, knots != NO_KNOT):
        raise _FaultError("the stitches were changed")
    overlay = read_overlay(reader.overlay, knots, len(facts.yarns))
    expected, halves = stitches.left.copy(), overlay.kinds == HALF
    expected[overlay.rows[halves], overlay.columns[halves]] = overlay.seconds[halves] + 1
    if not np.array_equal(expected, stitches.right):
        raise _FaultError("the stitches were changed")
    return replace(chart_of_facts(knots, facts, "an OXS chart of ilmek", cells), overlay=overlay)


def _yarns(reader: _Reader, stitches: _Stitches) -> tuple[tuple[Yarn, ...], Indices]:
    """The yarns of the palette, and the yarn of each of its items. Raises _FaultError for too few or too many."""
    seen = {index for side in stitches for index in np.flatnonzero(np.bincount(side.ravel())).tolist()}
    listed = [index for index in sorted(reader.palette) if index > 0]
    if len(listed) > MOST_YARNS:
        listed = [index for index in listed if index in seen]
    if not 2 <= len(listed) <= MOST_YARNS:
        raise _FaultError(f"its palette has {counted(len(listed), 'colour')}", allowed=f"2 to {MOST_YARNS}")
    names: set[str] = set()
    yarns = []
    for place, index in enumerate(listed, start=1):
        name, colour = reader.palette[index]
        red, green, blue = bytes.fromhex(colour)
        lightness, a, b = srgb_to_lab(np.array([red, green, blue], dtype=np.uint8)).tolist()
        name = _unlike(name, index, names)
        yarns.append(Yarn(name, (red, green, blue), (lightness, a, b), number=place))
    position = np.zeros(MOST_ITEMS + 2, dtype=np.uint8)
    position[listed] = np.arange(len(listed))
    return tuple(yarns), position


def _unlike(name: str, index: int, names: set[str]) -> str:
    """A printable name that no other yarn has."""
    clean = "".join(letter if is_printable(letter) else " " for letter in name)[: LONGEST_NAME - 8].strip()
    clean = clean or f"colour {index}"
    if clean.casefold() in names:
        clean = f"{clean} ({index})"
    while clean.casefold() in names:
        clean = f"{clean}'"
    names.add(clean.casefold())
    return clean
