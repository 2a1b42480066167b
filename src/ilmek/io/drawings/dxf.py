"""A drawing sheet as DXF (R2010): paper in mm, one layer for each kind of line, true DIMENSION entities.

A dimension carries the picture that the sheet has of it as its block, and its true length as its measurement: a program
that opens the file shows what the PDF shows, and reads the value. Lines and texts, which are many, are written as text;
by the attributes of the library it takes five times as long.
"""

import io
import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ezdxf._options import options
from ezdxf.document import Drawing
from ezdxf.entities.dimension import Dimension
from ezdxf.entities.dxfgfx import DXFGraphic
from ezdxf.filemanagement import new
from ezdxf.layouts.layout import Modelspace
from ezdxf.lldxf.tagwriter import AbstractTagWriter
from ezdxf.units import MM

from ilmek.report.sheet import (
    LINE_DASHES,
    LINE_WIDTHS,
    DimensionKind,
    DrawingSheet,
    LineKind,
    SheetDimension,
    SheetLine,
    SheetText,
    arrowhead,
)
from ilmek.sentences import DEFAULT, in_language, translated
from ilmek.units import mm

options.write_fixed_meta_data_for_testing = True  # no time, no random number: the same sheet gives the same bytes

TEXTS, STAMP, STYLE, FONT = "TEXT", "STAMP", "ILMEK", "DejaVu"

_MARK = "\ue000"
"""Before and after the number of a text: a character that no text has."""

_COLOURS = {LineKind.VISIBLE: 7, LineKind.HIDDEN: 5, LineKind.CENTRE: 1, LineKind.PATH: 3, LineKind.FRAME: 7}
_ALIGNMENT = {"left": "", "center": " 72\n1\n", "right": " 72\n2\n"}
_TYPES = {
    DimensionKind.LINEAR: 0, DimensionKind.ALIGNED: 1, DimensionKind.DIAMETER: 3, DimensionKind.RADIUS: 4,
    DimensionKind.ORDINATE: 6,
}  # fmt: skip
_OWN_BLOCK, _USER_TEXT, _ALONG_X = 32, 128, 64
"""Flags of the type of a DIMENSION: its block is its own, its text has its own position, an ordinate is along x."""


def write_sheet_dxf(path: Path, sheet: DrawingSheet, translations: Mapping[str, Path] = MappingProxyType({})) -> None:
    """Write a sheet to a file, and to others with its sentences in other languages. Raises OSError.

    The library makes the file once, with a mark for each text.
    """
    words = list[str]()

    def mark(text: SheetText) -> SheetText:
        words.append(text.words)
        return replace(text, words=f"{_MARK}{len(words) - 1}{_MARK}")

    texts = tuple(mark(text) for text in sheet.texts)
    dimensions = tuple(replace(dimension, text=mark(dimension.text)) for dimension in sheet.dimensions)
    stamp = mark(SheetText(0j, sheet.stamp)).words if sheet.stamp else ""
    document = sheet_document(replace(sheet, texts=texts, dimensions=dimensions, stamp=stamp))
    for name in sorted(document.entitydb.dxf_types_in_use()):  # the library adds them in the order of a set
        document.classes.add_class(name)
    content = io.StringIO()
    document.write(content)
    pieces = content.getvalue().split(_MARK)  # every second one is the number of a text
    numbers = [int(number) for number in pieces[1::2]]
    for language, file in {DEFAULT: path, **translations}.items():
        with in_language(language):
            pieces[1::2] = [translated(words[number]) for number in numbers]
        with file.open("w", encoding=document.output_encoding, errors="dxfreplace", newline="\n") as stream:
            stream.write("".join(pieces))


def sheet_document(sheet: DrawingSheet) -> Drawing:
    """The sheet as a DXF document."""
    document = new("R2010", units=MM)
    document.styles.add(FONT, font="DejaVuSans.ttf")
    for kind in LineKind:
        pattern = _pattern(LINE_DASHES.get(kind, ()))
        if pattern:
            document.linetypes.add(kind.upper(), pattern, description=kind.value)
        weight = round(100 * LINE_WIDTHS[kind])
        line_type = kind.upper() if pattern else "Continuous"
        document.layers.add(kind.upper(), color=_COLOURS.get(kind, 8), linetype=line_type, lineweight=weight)
    document.layers.add(TEXTS, color=7, lineweight=25)
    document.layers.add(STAMP, color=1, lineweight=50)
    style: Any = document.dimstyles.duplicate_entry("Standard", STYLE)
    style.dxf.dimlfac, style.dxf.dimtxt, style.dxf.dimtxsty, style.dxf.dimdec = sheet.scale, 2.5, FONT, 3
    space = document.modelspace()
    space.reset_extents((0, 0, 0), (sheet.width, sheet.height, 0))
    space.reset_limits((0, 0), (sheet.width, sheet.height))
    for line in sheet.lines:
        _line(space, line)
    for text in sheet.texts:
        _text(space, text)
    for dimension in sheet.dimensions:
        _dimension(document, space, dimension)
    if sheet.stamp:
        middle = complex(sheet.width, sheet.height) / 2
        angle = math.atan2(sheet.height, sheet.width)
        _text(space, SheetText(middle, sheet.stamp, min(sheet.width, sheet.height) / 10, "center", angle), STAMP)
    return document


def _pattern(dashes: tuple[float, ...]) -> list[float]:
    """A line type: its period, then dashes above 0 and gaps below."""
    signed = [length if number % 2 == 0 else -length for number, length in enumerate(dashes)]
    return [sum(dashes), *signed] if dashes else []


class _Written(DXFGraphic):
    """An entity whose tags, but handle and owner, are text already."""

    def __init__(self, kind: str, tags: str) -> None:
        super().__init__()
        self.DXFTYPE, self.tags = kind, tags

    def export_dxf(self, tagwriter: AbstractTagWriter) -> None:
        """Write it."""
        tagwriter.write_str(
            f"  0\n{self.DXFTYPE}\n  5\n{self.dxf.handle}\n330\n{self.dxf.owner}\n100\nAcDbEntity\n{self.tags}"
        )


def _line(space: Any, line: SheetLine) -> None:
    points = line.points.tolist()
    bulges = [0.0] * len(points) if line.bulges is None else line.bulges.tolist()
    corners = [
        f" 10\n{at.real}\n 20\n{at.imag}\n" + (f" 42\n{bulge}\n" if bulge else "")
        for at, bulge in zip(points, bulges, strict=True)
    ]
    head = f"  8\n{line.kind.upper()}\n100\nAcDbPolyline\n 90\n{len(points)}\n 70\n{int(line.closed)}\n"
    space.add_entity(_Written("LWPOLYLINE", head + "".join(corners)))


def _text(space: Any, text: SheetText, layer: str = TEXTS) -> None:
    x, y = float(text.position.real), float(text.position.imag)
    turned = f" 50\n{math.degrees(text.angle)}\n" if text.angle else ""
    tags = (
        f"  8\n{layer}\n100\nAcDbText\n 10\n{x}\n 20\n{y}\n 30\n0.0\n 40\n{float(text.height)}\n  1\n{text.words}\n"
        f"{turned}  7\n{FONT}\n{_ALIGNMENT[text.anchor]} 11\n{x}\n 21\n{y}\n 31\n0.0\n100\nAcDbText\n"
    )
    space.add_entity(_Written("TEXT", tags))


def _dimension(document: Drawing, space: Modelspace, drawn: SheetDimension) -> None:
    """The entity, and the block with its picture."""
    block = document.blocks.new_anonymous_block(type_char="D")
    for line in drawn.lines:
        _line(block, line)
    for tip, direction in drawn.arrows:
        first, second, third = arrowhead(tip, direction)
        corners = [(at.real, at.imag) for at in (first, second, third, third)]
        block.add_solid(corners, dxfattribs={"layer": LineKind.DIMENSION.upper()})
    _text(block, drawn.text)
    kind = _TYPES[drawn.kind] | _OWN_BLOCK | _USER_TEXT
    if drawn.kind is DimensionKind.ORDINATE and not drawn.across:
        kind |= _ALONG_X
    attributes = {
        "layer": LineKind.DIMENSION.upper(),
        "dimstyle": STYLE,
        "dimtype": kind,
        "geometry": block.name,
        "text": drawn.text.words,
        "text_midpoint": _xyz(drawn.text.position),
        "actual_measurement": drawn.value / mm,
        **dict(_points(drawn)),
    }
    entity = Dimension.new(dxfattribs=attributes, doc=document)
    space.add_entity(entity)


def _points(drawn: SheetDimension) -> Iterator[tuple[str, object]]:
    """Definition points by the kind of a dimension."""
    first, second = drawn.points
    if drawn.kind in {DimensionKind.LINEAR, DimensionKind.ALIGNED}:
        yield from (("defpoint", _xyz(drawn.line)), ("defpoint2", _xyz(first)), ("defpoint3", _xyz(second)))
        if drawn.kind is DimensionKind.LINEAR:
            yield "angle", 90.0 if drawn.across else 0.0
    elif drawn.kind is DimensionKind.ORDINATE:
        yield from (("defpoint", _xyz(first)), ("defpoint2", _xyz(second)), ("defpoint3", _xyz(drawn.line)))
    else:
        yield from (("defpoint", _xyz(first)), ("defpoint4", _xyz(second)))


def _xyz(point: complex) -> tuple[float, float, float]:
    return point.real, point.imag, 0.0
