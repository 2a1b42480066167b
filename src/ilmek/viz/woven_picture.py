"""Picture of a carpet on the loom as far as it is woven: bare warps where no knot is, and a mark on every fault."""

import io
import zlib

import numpy as np
from PIL import Image

from ilmek.arrays import ComplexArray, Indices, Rgb, UInt8
from ilmek.carpet.chart import Chart
from ilmek.loom.operations import EMPTY, LoomSetup
from ilmek.loom.twin.comparison import WovenFaultKind, WovenResult
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.viz.canvas import FINER, Canvas
from ilmek.viz.carpet_edges import COTTON
from ilmek.viz.carpet_picture import LONGEST, Pile, draw_carpet
from ilmek.viz.style import INK
from ilmek.viz.tufts import encoded

MOST_MARKS = 200
"""Marks drawn; faults nearer to one another than a mark share one."""

_MARK, _HALO = "#d0006f", "#ffffff"
_PAPER = (255, 255, 255)
_RADIUS = 9.0
_LINE, _TEXT, _MARGIN = 22.0, 13.0, 12.0


@record
class WovenPicture:
    """The picture, and the number of marks on it."""

    image: Image.Image
    marks: int

    @property
    def png(self) -> bytes:
        """The picture as a PNG file."""
        stream = io.BytesIO()
        self.image.save(stream, format="PNG", compress_level=1, compress_type=zlib.Z_HUFFMAN_ONLY)
        return stream.getvalue()


def draw_woven(
    setup: LoomSetup,
    yarns: UInt8[np.ndarray, "rows columns"],
    result: WovenResult,
    *,
    width: int | None = None,
    longest: int = LONGEST,
    progress: Progress = SILENT,
) -> WovenPicture:
    """The carpet of a loom as far as it is woven.

    yarns   of its knots, EMPTY: none, loom row by row from the bottom edge
    width, longest   of the carpet [pixels], as of `draw_carpet`
    Raises CarpetError as `draw_carpet`.
    """
    knots = yarns[::-1]
    chart = Chart(_filled(knots), setup.yarns, setup.size, setup.quality, setup.knot)
    drawn = draw_carpet(chart, width, longest=longest, progress=progress)
    image, pile = drawn.image.copy(), _pixels(drawn.pile, drawn.image.size)
    begun = np.flatnonzero((yarns != EMPTY).any(axis=1))
    _bare(image, pile, knots, 0 if len(begun) == 0 else int(begun[-1]) + 1)
    return _marked(image, pile, setup, result)


def _filled(knots: UInt8[np.ndarray, "rows columns"]) -> Indices:
    """The knots with those of the row below where there are none, which show at the edge of the bare warps alone."""
    filled: Indices = knots.copy()
    filled[-1][filled[-1] == EMPTY] = 0
    for row in range(len(filled) - 2, -1, -1):
        np.copyto(filled[row], filled[row + 1], where=filled[row] == EMPTY)
    return filled


def _pixels(pile: Pile, size: tuple[int, int]) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of the pile [pixels]."""
    width, height = size
    left, top = round(pile.left * width), round(pile.top * height)
    return left, top, left + round(pile.width * width), top + round(pile.height * height)


def _bare(image: Image.Image, pile: tuple[int, int, int, int], knots: np.ndarray, begun: int) -> None:
    """Bare warps above the rows that were begun, up to the picture's edge, and where knots are missing below."""
    left, top, right, bottom = pile
    rows, columns = knots.shape
    empty = Image.fromarray(np.where(knots == EMPTY, 255, 0).astype(np.uint8))
    mask = empty.resize((right - left, bottom - top), _scaling(columns, right - left))
    warps = Image.fromarray(_warps(bottom, right - left, columns))
    if begun < rows:
        fell = bottom - round((bottom - top) * begun / rows)
        image.paste(_PAPER, (0, 0, image.width, fell))
        image.paste(warps.crop((0, 0, right - left, fell)), (left, 0))
    image.paste(warps.crop((0, top, right - left, bottom)), (left, top), mask)


def _scaling(cells: int, pixels: int) -> Image.Resampling:
    return Image.Resampling.NEAREST if pixels >= cells else Image.Resampling.BOX


def _warps(height: int, width: int, columns: int) -> Rgb:
    """Two warps for each column, or as many as can be distinguished, over a dark gap."""
    pitch = max(width / (2 * columns), 4.0)
    phase = (np.arange(width) + 0.5) / pitch % 1.0
    thread = np.clip(1.3 * np.sin(np.pi * phase), 0.22, 1.0)
    light = np.repeat((thread[:, np.newaxis] * np.array(COTTON))[np.newaxis], height, axis=0)
    return encoded(light.astype(np.float32))


def _marked(image: Image.Image, pile: tuple[int, int, int, int], setup: LoomSetup, result: WovenResult) -> WovenPicture:
    """The picture with marks, above a caption; points on the canvas are pixels from its lower left corner."""
    lines = _caption(result)
    width, height = image.width, image.height + round(_LINE * len(lines) + _MARGIN)
    canvas = Canvas(width, height, FINER)
    canvas.picture.paste(image.resize((FINER * image.width, FINER * image.height), Image.Resampling.NEAREST), (0, 0))
    left, top, right, bottom = pile
    across, along = (right - left) / setup.columns, (bottom - top) / setup.rows
    marks = _apart(
        [(fault.kind, complex(left + (fault.column + 0.5) * across, height - bottom + (fault.row + 0.5) * along))
         for fault in result.faults]
    )  # fmt: skip
    for kind, centre in marks:
        _mark(canvas, kind, centre)
    for one in result.end_faults[:MOST_MARKS]:
        end = height - bottom + (one.row + 1) * along
        for x in (left, right):
            _stroke(canvas, np.array([complex(x - _RADIUS, end), complex(x + _RADIUS, end)]))
    for number, (symbol, words) in enumerate(lines):
        at = complex(_MARGIN, height - image.height - (number + 0.9) * _LINE)
        if symbol is not None:
            _mark(canvas, symbol, at + complex(_RADIUS, 0.35 * _TEXT))
        canvas.text(at + (0 if symbol is None else 2.6 * _RADIUS), words, _TEXT, INK)
    return WovenPicture(canvas.reduced().crop((0, 0, width, height)), len(marks))


def _caption(result: WovenResult) -> list[tuple[WovenFaultKind | None, str]]:
    """The lines below the carpet, each with the mark that it explains."""
    share = 100 * result.knots / result.total
    found: list[tuple[WovenFaultKind | None, str]] = [
        (None, f"{result.knots:,} of {result.total:,} knots ({share:.1f} %), {result.rows:,} rows complete")
    ]
    counts = {
        WovenFaultKind.MISSING: result.missing,
        WovenFaultKind.DOUBLE: result.double,
        WovenFaultKind.WRONG_YARN: result.wrong,
    }
    found += [(kind, f"{kind}: {count:,}") for kind, count in counts.items() if count]
    if result.ends:
        found.append((None, f"wefts, beats and take-ups missing or double: {result.ends:,} (bars at the edge)"))
    return found


def _apart(faults: list[tuple[WovenFaultKind, complex]]) -> list[tuple[WovenFaultKind, complex]]:
    """The marks to draw: one of a kind in each square of a mark's size, at most MOST_MARKS."""
    found: dict[tuple[WovenFaultKind, int, int], complex] = {}
    for kind, at in faults:
        found.setdefault((kind, int(at.real / _RADIUS), int(at.imag / _RADIUS)), at)
    return [(kind, at) for (kind, _, _), at in found.items()][:MOST_MARKS]


def _mark(canvas: Canvas, kind: WovenFaultKind, centre: complex) -> None:
    """A ring, a square or a triangle, which are distinguished without their colour."""
    corners = {WovenFaultKind.MISSING: 32, WovenFaultKind.DOUBLE: 4, WovenFaultKind.WRONG_YARN: 3}[kind]
    turn = 0.25 * np.pi if corners == 4 else 0.5 * np.pi
    angles = turn + 2 * np.pi * np.arange(corners + 1) / corners
    _stroke(canvas, centre + _RADIUS * np.exp(1j * angles))


def _stroke(canvas: Canvas, points: ComplexArray) -> None:
    canvas.line(points, _HALO, 5.0)
    canvas.line(points, _MARK, 2.4)
