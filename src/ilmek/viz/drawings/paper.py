"""The paper of a drawing: sizes and frame with zones (ISO 5457), title block (ISO 7200), scales (ISO 5455)."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ilmek.records import record
from ilmek.report.sheet import LineKind, SheetLine, SheetText
from ilmek.sentences import Sentence
from ilmek.viz.drawings.feature_note import edge_mark, surface_mark
from ilmek.viz.drawings.picture import CAPITAL, SheetPicture, words_width
from ilmek.viz.font import text_width

PAPERS = {
    "A4": (210.0, 297.0), "A3": (420.0, 297.0), "A2": (594.0, 420.0), "A1": (841.0, 594.0), "A0": (1189.0, 841.0)
}  # fmt: skip
"""Width and height of trimmed sheets [mm]; ISO 5457: A4 upright, the others lying."""

SCALES = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)
"""True length over that on the paper; ISO 5455."""

LEFT, EDGE = 20.0, 10.0
"""Margins of the frame: left for filing, and all others [mm]."""

BLOCK_WIDTH, BLOCK_HEIGHT = 180.0, 47.0
"""Size of the title block [mm]."""

_ZONE, _BORDER = 50.0, 5.0
_LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"


@record
class TitleFacts:
    """What a title block says of its drawing; ISO 7200.

    number   of the drawing            mass      of a piece, in words     pieces  to be made
    surface  roughness of all surfaces that state no other                treatment  of the material; "": none
    general, edges   general tolerances, and states of outer and inner edges by ISO 13715, if any
    status   of the document           date, revision  of its issue: as given, never of a clock
    """

    number: str
    title: str
    kind: str
    material: str
    mass: str
    stock: str
    pieces: str
    surface: str
    treatment: str
    general: str
    edges: Sequence[str]
    status: str
    owner: str = "—"
    date: str = "—"
    revision: str = "—"


_ROUNDING = 1e-9

_INDENTS = {"sheet.surface": 6.5, "sheet.outer": 9.5, "sheet.inner": 8.5}
"""Room of the symbols before a value [mm]."""


def scale_words(scale: float) -> str:
    """A scale as it is written.

    >>> scale_words(5.0), scale_words(0.5)
    ('1:5', '2:1')
    """
    return f"1:{scale:g}" if scale >= 1 else f"{1 / scale:g}:1"


def fitting(words: str, width: float, height: float, least: float = 1.8, *, bold: bool = False) -> tuple[str, float]:
    """A text, and its height at which it fits a width [mm]; shortened where the least height does not do."""
    natural = words_width(words, height, bold=bold)
    if natural <= width:
        return words, height
    height = max(least, height * width / natural)
    if words_width(words, height, bold=bold) <= width + _ROUNDING:
        return words, height
    while len(words) > 1 and text_width(words, height / CAPITAL, bold) > width + _ROUNDING:
        words = words.rstrip("…")[:-1].rstrip() + "…"
    return words, height


_LETTER, _LINE, _ROW = 2.5, 4.0, 5.0
"""Height of letters in tables, distance of lines in a cell, and height of a row of one line [mm]."""


def wrapped(words: str, width: float, height: float, *, bold: bool = False) -> tuple[str, ...]:
    """A text in as many lines as it needs in a width [mm]; one that fits as it is.

    >>> wrapped("screw of the bracket", 100.0, 2.5), wrapped("screw of the bracket", 20.0, 2.5)
    (('screw of the bracket',), ('screw of', 'the bracket'))
    """
    if words_width(words, height, bold=bold) <= width:
        return (words,)
    lines = [""]
    for word in words.split(" "):
        longer = f"{lines[-1]} {word}".lstrip()
        if lines[-1] and words_width(longer, height, bold=bold) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return tuple(lines)


def row_heights(rows: Sequence[Sequence[str]], widths: Sequence[float], least: float = _ROW) -> list[float]:
    """Heights of the rows of a table with columns of widths [mm]; least  that of one line."""
    lines = (
        max(len(wrapped(words, wide - 2.9, _LETTER)) for words, wide in zip(row, widths, strict=True)) for row in rows
    )
    return [least + _LINE * (number - 1) for number in lines]


def frame(paper: str) -> SheetPicture:
    """The frame of a sheet with its zones and centring marks."""
    width, height = PAPERS[paper]
    low, high = complex(LEFT, EDGE), complex(width - EDGE, height - EDGE)
    lines = [_rectangle(LineKind.FRAME, low, high)]
    outer = complex(_BORDER, _BORDER)
    lines.append(_rectangle(LineKind.DIMENSION, low - outer, high + outer))
    middle = (low + high) / 2
    for side, inward in ((low.real, 1.0), (high.real, -1.0)):
        at = complex(side, height / 2)
        lines.append(SheetLine(LineKind.FRAME, np.array([at - inward * _BORDER, at + inward * _BORDER])))
    for side, upward in ((low.imag, 1j), (high.imag, -1j)):
        at = complex(width / 2 if paper != "A4" else middle.real, side)
        reach = 0.0 if upward == 1j else _BORDER  # the title block lies above the lower one
        lines.append(SheetLine(LineKind.FRAME, np.array([at - upward * _BORDER, at + upward * reach])))
    across = _fields(low.real, high.real, width / 2)
    upwards = _fields(low.imag, high.imag, height / 2)
    texts = []
    for start, outward in ((low.imag, -1j), (high.imag, 1j)):
        lines += [_tick(complex(x, start), outward) for x in across[1:-1]]
        texts += [
            _zone(complex((a + b) / 2, start) + outward * _BORDER / 2, str(number + 1))
            for number, (a, b) in enumerate(pairwise(across))
        ]
    for start, outward in ((low.real, -1.0), (high.real, 1.0)):
        lines += [_tick(complex(start, y), outward) for y in upwards[1:-1]]
        texts += [
            _zone(complex(start, (a + b) / 2) + outward * _BORDER / 2, _LETTERS[len(upwards) - 2 - number])
            for number, (a, b) in enumerate(pairwise(upwards))
        ]
    return SheetPicture(tuple(lines), tuple(texts), ())


def _fields(low: float, high: float, middle: float) -> list[float]:
    """Ends of fields of 50 mm from the middle; a rest joins its neighbour."""
    count_down, count_up = int((middle - low) / _ZONE), int((high - middle) / _ZONE)
    inner = [middle + _ZONE * step for step in range(-count_down, count_up + 1)]
    inner = [at for at in inner if low + 15 < at < high - 15]
    return [low, *inner, high]


def _tick(at: complex, outward: complex) -> SheetLine:
    return SheetLine(LineKind.DIMENSION, np.array([at, at + outward * _BORDER]))


def _zone(at: complex, words: str) -> SheetText:
    return SheetText(at - 1.25j, words, 2.5, "center")


def _rectangle(kind: LineKind, low: complex, high: complex) -> SheetLine:
    corners = [low, complex(high.real, low.imag), high, complex(low.real, high.imag)]
    return SheetLine(kind, np.array(corners), closed=True)


def title_block(facts: TitleFacts, paper: str, scale: float, page: int, pages: int) -> SheetPicture:
    """The title block, in the lower right corner of a sheet."""
    width, _ = PAPERS[paper]
    outer, inner = (*facts.edges, "", "")[:2]
    corner = complex(width - EDGE - BLOCK_WIDTH, EDGE)
    rows = (
        (0.0, 9.0, (
            ("sheet.owner", facts.owner, 40), ("sheet.kind", facts.kind, 42), ("sheet.status", facts.status, 36),
            ("sheet.revision", facts.revision, 14), ("sheet.issued", facts.date, 30),
            ("sheet.page", f"{page}/{pages}", 18),
        )),
        (9.0, 11.0, (("sheet.title", facts.title, 90), ("sheet.number", facts.number, 90))),
        (20.0, 9.0, (
            ("sheet.material", facts.material, 80), ("sheet.mass", facts.mass, 27),
            ("sheet.scale", scale_words(scale), 19), ("sheet.size", paper, 14), ("sheet.pieces", facts.pieces, 16),
            ("sheet.projection", "", 24),
        )),
        (29.0, 9.0, (
            ("sheet.general", facts.general, 36), ("sheet.outer", outer, 36),
            ("sheet.inner", inner, 30), ("sheet.surface", facts.surface, 52), ("sheet.unit", "mm", 26),
        )),
        (38.0, 9.0, (("sheet.stock", facts.stock, 100), ("sheet.treatment", facts.treatment or "—", 80))),
    )  # fmt: skip
    lines = [_rectangle(LineKind.VISIBLE, corner, corner + complex(BLOCK_WIDTH, BLOCK_HEIGHT))]
    texts: list[SheetText] = []
    for y, tall, cells in rows:
        if y:
            start = corner + 1j * y
            lines.append(SheetLine(LineKind.DIMENSION, np.array([start, start + BLOCK_WIDTH])))
        x = 0.0
        for key, value, wide in cells:
            at = corner + complex(x, y)
            if x:
                lines.append(SheetLine(LineKind.DIMENSION, np.array([at, at + 1j * tall])))
            label, high = fitting(Sentence(key), wide - 2.0, 1.8, 1.2)
            texts.append(SheetText(at + complex(1.2, tall - 2.5), label, high, light=True))
            large = 3.5 if key in {"sheet.title", "sheet.number"} else 2.5
            words, height = fitting(value, wide - 3.0, large, bold=key == "sheet.title")
            if words:
                indent = _INDENTS.get(key, 1.5)
                texts.append(SheetText(at + complex(indent, 1.6), words, height, bold=key == "sheet.title"))
            x += wide
    lines += _projection_mark(corner + complex(168.5, 23.6))
    lines += surface_mark(corner + complex(104.0, 30.4))
    if inner:
        lines += [
            *edge_mark(corner + complex(39.5, 31.4), outer=True),
            *edge_mark(corner + complex(74.5, 31.0), outer=False),
        ]
    return SheetPicture(tuple(lines), tuple(texts), ())


def _projection_mark(centre: complex) -> list[SheetLine]:
    """The mark of first-angle projection: a frustum, and on its right the view from its left."""
    cone, rings = centre - 5.5, centre + 4.5
    body = np.array([cone - 3 - 1.25j, cone + 3 - 2.5j, cone + 3 + 2.5j, cone - 3 + 1.25j])
    half = np.ones(2)
    return [
        SheetLine(LineKind.BREAK, body, closed=True),
        *(SheetLine(LineKind.BREAK, np.array([rings + r, rings - r]), half, closed=True) for r in (1.25, 2.5)),
        SheetLine(LineKind.DIMENSION, np.array([cone - 4, cone + 4])),
        SheetLine(LineKind.DIMENSION, np.array([rings - 3.2, rings + 3.2])),
    ]


def table(
    header: Sequence[str],
    rows: Sequence[Sequence[str]],
    title: str = "",
    row: float = _ROW,
    widths: Sequence[float] = (),
) -> SheetPicture:
    """A table with its upper left corner at 0: columns of widths [mm], in which texts are wrapped; default: as wide as
    their widest text.
    """
    columns = range(len(header))
    if not widths:
        heads = [words_width(head, _LETTER, bold=True) for head in header]
        cells = [[words_width(line[k], _LETTER) for line in rows] for k in columns]
        widths = [max(heads[k], *cells[k], 0.0) + 3.0 for k in columns]
    ends = np.concatenate([[0.0], np.cumsum(widths)])
    top = -6.0 if title else 0.0
    texts = [SheetText(complex(0.0, -4.0), title, _LETTER, bold=True)] if title else []
    levels = top - np.cumsum([row, *row_heights(rows, widths, row)])
    for number, (line, y) in enumerate(zip((header, *rows), [top, *levels[:-1].tolist()], strict=True)):
        for k in columns:
            head, wide = number == 0, widths[k] - 2.9
            cell = (line[k],) if head else wrapped(line[k], wide, _LETTER)
            for below, words in enumerate(cell if line[k] else ()):
                fitted, height = fitting(words, wide, _LETTER, bold=head)
                foot = complex(float(ends[k]) + 1.5, y - (row + _LETTER) / 2 - _LINE * below)
                texts.append(SheetText(foot, fitted, height, bold=head))
    bottom = float(levels[-1])
    lines = [
        SheetLine(
            LineKind.HATCH if number else LineKind.VISIBLE, np.array([complex(0, y), complex(float(ends[-1]), y)])
        )
        for number, y in enumerate(levels[:-1].tolist())
    ]
    lines += [SheetLine(LineKind.HATCH, np.array([complex(x, top), complex(x, bottom)])) for x in ends[1:-1].tolist()]
    lines.append(_rectangle(LineKind.VISIBLE, complex(0.0, bottom), complex(float(ends[-1]), top)))
    return SheetPicture(tuple(lines), tuple(texts), ())
