"""Sheets of an assembly: its views with item numbers and its list of items, the same taken apart along its axes, and
where its welded pieces stand.

First-angle projection; hidden lines are left out, but dashed where an item is seen from no side. Of rows of pieces that
are nearer than `CLOSE` on the paper some are drawn. [ISO 128, ISO 6433, ISO 7573]
"""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from ilmek.arrays import Float
from ilmek.part.assemblies import (
    AssembledPiece,
    AssemblyItem,
    AssemblyUnit,
    assembly_mass,
    items_of,
    pieces_of_assembly,
)
from ilmek.part.blanks import sold_as
from ilmek.part.exploded import Block, exploded
from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.part.shapes import Sum
from ilmek.part.specification import WELDMENT
from ilmek.part.tree import Tree
from ilmek.part.visible_lines import PlacedShape, extents
from ilmek.records import record
from ilmek.report.sheet import DimensionKind, DrawingSheet, Issue, LineKind, SheetDimension, SheetLine, SheetText
from ilmek.sentences import Sentence
from ilmek.units import format_quantity, mm
from ilmek.viz.drawings.balloons import ROOM, SIDES, Balloon, CrowdedViewError, rows_about
from ilmek.viz.drawings.compose import merged, status_of
from ilmek.viz.drawings.item_views import balloons_on, item_view, rotation_to
from ilmek.viz.drawings.joined import VIEWS
from ilmek.viz.drawings.paper import (
    BLOCK_HEIGHT,
    EDGE,
    LEFT,
    PAPERS,
    SCALES,
    TitleFacts,
    fitting,
    frame,
    row_heights,
    table,
    title_block,
)  # fmt: skip
from ilmek.viz.drawings.picture import SheetPicture
from ilmek.viz.drawings.weldment import positions, welded_pieces

CLOSE, LATTICE = 1.0, 40
"""Distance of pieces in a row from which all are drawn [mm]; members of a lattice, which assemblies about it leave out.
"""

LEAST_SIZE = {"A3": 85.0, "A2": 110.0, "A1": 160.0, "A0": 0.0}
"""Papers, and the least greatest extent of an assembly on them [mm]: below it, the next paper is taken, unless it is
drawn in true size or larger."""

HEADER = tuple(
    map(
        Sentence,
        ("sheet.list-number", "sheet.list-quantity", "sheet.list-part", "sheet.list-material", "sheet.list-drawing",
         "sheet.mass"),
    )
)  # fmt: skip
WIDTHS = {"A3": (9.0, 11.0, 50.0, 42.0, 51.0, 17.0)}
WIDE = (10.0, 12.0, 71.0, 61.0, 58.0, 18.0)
"""Widths of the columns of the list [mm], on A3 and on larger papers."""

VIEW_SIDES = {"front": ("left", "top"), "right": ("top", "right"), "below": ("left", "bottom", "right")}
"""The sides of each view along which its balloons stand: those without dimensions."""

ISOMETRIC = rotation_to((1 / math.sqrt(3),) * 3, (math.sqrt(0.5), 0.0, -math.sqrt(0.5)))

_PAD, _GAP, _SPARE, _LINE, _CAPTION = 6.0, 18.0, 1.3, 9.0, 12.0
"""Distance of anything from the frame, of two views [mm]; balloons that have room for each that is there; distance of a
dimension from its view, height of a caption [mm]."""

_PARTS, _MACHINES = 1.4, 2.2
"""How much larger than views exploded ones are, of parts and of assemblies."""

Size = Float[np.ndarray, " 3"]
ShiftedPiece = tuple[AssembledPiece, Size | float]
Cells = tuple[str, ...]


@record
class AssemblySheet:
    """A sheet, and the balloons on it."""

    sheet: DrawingSheet
    balloons: tuple[Balloon, ...]


@record
class _Titles:
    """What all sheets of an assembly say in their title blocks."""

    assembly: AssemblyUnit
    mass: float
    issue: Issue
    pages: int
    general: str

    def sheet(self, paper: str, scale: float, drawn: Sequence[SheetPicture], page: int) -> DrawingSheet:
        """A sheet with its frame and title block."""
        own, issue = self.assembly, self.issue
        stamp = status_of(issue) if issue.unreleased else ""
        title = own.title[:1].upper() + own.title[1:]
        facts = TitleFacts(
            own.drawing, title, Sentence("sheet.assembly-drawing"), Sentence("sheet.see-list"),
            format_quantity(self.mass, "kg", 3), "—",
            str(own.count), "—", "", self.general, (), status_of(issue), issue.owner, issue.date, issue.revision,
        )  # fmt: skip
        whole = merged([frame(paper), title_block(facts, paper, scale, page, self.pages), *drawn])
        width, height = PAPERS[paper]
        return DrawingSheet(
            own.drawing, title, paper, width, height, scale, whole.lines, whole.texts, whole.dimensions, page,
            self.pages, stamp,
        )  # fmt: skip


def assembly_sheets(tree: Tree, assembly: AssemblyUnit, issue: Issue) -> Iterator[AssemblySheet]:
    """The sheets of an assembly: its views with its list; taken apart, where it is of more than one piece; where its
    pieces stand, where some are welded.
    """
    items, pieces = items_of(tree, assembly), pieces_of_assembly(tree, assembly)
    if not pieces:
        return
    blocks = exploded(tree, assembly, pieces)
    welded, apart = welded_pieces(tree, assembly, pieces), len(blocks) > 1
    general = WELDMENT if welded else "—"
    titles = _Titles(assembly, assembly_mass(tree, assembly), issue, 1 + apart + bool(welded), general)
    yield _views_sheet(titles, items, [(piece, 0.0) for piece in pieces])
    if apart:
        yield _exploded_sheet(titles, items, blocks)
    if welded:
        paper, tables = positions(tree, items, welded)
        yield AssemblySheet(titles.sheet(paper, 1.0, tables, titles.pages), ())


def _least_crowded(draw: Callable[[str, float], AssemblySheet], papers: Iterator[tuple[str, float]]) -> AssemblySheet:
    """The sheet on the first paper on which all balloons are clear of leaders. Raises ValueError: on none."""
    for paper, scale in papers:
        try:
            return draw(paper, scale)
        except CrowdedViewError:
            continue
    raise ValueError("more items than a sheet of A0 bears")


def _views_sheet(titles: _Titles, items: Sequence[AssemblyItem], pieces: Sequence[ShiftedPiece]) -> AssemblySheet:
    low, high = extents([_placed(*own) for own in pieces], np.eye(3))
    rows = [_cells(item) for item in items]
    draw = partial(_drawn_views, titles, rows, pieces, high - low)
    return _least_crowded(draw, _papers_of_views(high - low, rows))


def _drawn_views(  # noqa: PLR0917
    titles: _Titles, rows: Sequence[Cells], pieces: Sequence[ShiftedPiece], size: Size, paper: str, scale: float
) -> AssemblySheet:
    shown = _shown(titles.assembly, pieces, scale)
    width, height = PAPERS[paper]
    wide, tall, deep = (size / mm / scale).tolist()
    free = _room(paper) - complex(wide + deep, tall + deep)
    left, top = LEFT + _PAD + ROOM + free.real / 2, height - EDGE - _PAD - ROOM - free.imag / 2
    middles = {
        "front": complex(left + wide / 2, top - tall / 2),
        "right": complex(left + wide + _GAP + deep / 2, top - tall / 2),
        "below": complex(left + wide / 2, top - tall - _GAP - deep / 2),
    }
    views = {
        name: item_view(shown, rotation_to(*VIEWS[name]), scale, middle, len(rows), VIEW_SIDES[name])
        for name, middle in middles.items()
    }
    balloons, dashed = balloons_on([row[0] for row in rows], tuple(views.values()), shown)
    front, side = views["front"].box, views["right"].box
    dimensions = (
        _overall(complex(front[0], front[1]), complex(front[2], front[1]), -1j, wide * scale),
        _overall(complex(front[2], front[1]), complex(front[2], front[3]), 1.0, tall * scale),
        _overall(complex(side[0], side[1]), complex(side[2], side[1]), -1j, deep * scale),
    )
    lines = [*(line for own in views.values() for line in own.strokes(LineKind.CONTOUR, own.picture.lines())), *dashed]
    columns = WIDTHS.get(paper, WIDE)
    listed = table(HEADER, rows, widths=columns).moved(complex(width - EDGE - sum(columns), height - EDGE))
    drawn = [SheetPicture(tuple(lines), (), dimensions), listed, *(balloon.picture for balloon in balloons)]
    return AssemblySheet(titles.sheet(paper, scale, drawn, 1), balloons)


def _papers_of_views(size: Size, rows: Sequence[Cells]) -> Iterator[tuple[str, float]]:
    """The papers on which views, balloons and the list of items have room, and the largest scale on each."""
    for paper, least in LEAST_SIZE.items():
        if not _listed(rows, paper):
            continue
        for scale in SCALES:
            wide, tall, deep = (size / mm / scale).tolist()
            free = _room(paper) - complex(wide + deep, tall + deep)
            if free.real < 0 or free.imag < 0:
                continue
            boxes = {"front": (wide, tall), "right": (deep, tall), "below": (wide, deep)}
            balloons = sum(len(rows_about((0.0, 0.0, *boxes[name]), own)[0]) for name, own in VIEW_SIDES.items())
            if balloons >= _SPARE * len(rows) and (scale <= 1 or max(wide, tall, deep) >= least):
                yield paper, scale
            break


def _listed(rows: Sequence[Cells], paper: str) -> bool:
    """Whether the list has room on a paper, and on a small one each text in its column."""
    widths = WIDTHS.get(paper)
    heights = row_heights(rows, widths or WIDE)
    tall = PAPERS[paper][1] - 2 * EDGE - BLOCK_HEIGHT - _PAD >= math.fsum((5.0, *heights))
    cells = [] if widths is None else [pair for row in rows for pair in zip(row, widths, strict=True)]
    return tall and all(fitting(words, width - 2.9, 2.5)[0] == words for words, width in cells)


def _room(paper: str) -> complex:
    """Room of the three views beside the list, without that of balloons and dimensions [mm]."""
    width, height = PAPERS[paper]
    beside = complex(LEFT + EDGE + sum(WIDTHS.get(paper, WIDE)) + 3 * _PAD, 2 * EDGE + 2 * _PAD)
    return complex(width, height) - beside - (2 * ROOM + _GAP) * (1 + 1j)


def _shown(assembly: AssemblyUnit, pieces: Sequence[ShiftedPiece], scale: float) -> list[PlacedShape]:
    """Pieces that are drawn, shifted: no lattices of inner assemblies, of rows as many lines as the paper bears."""
    inner = {body.id for own in assembly.assemblies for body in own.all_bodies}
    solid = {piece.item for piece, _ in pieces if not _is_lattice(piece.part)}
    shown = list[PlacedShape]()
    before: AssembledPiece | None = None
    for piece, shift in pieces:
        if piece.body.id in inner and piece.item in solid and _is_lattice(piece.part):
            continue
        step = math.inf
        if before is not None and before.part is piece.part and piece.row:
            step = float(np.linalg.norm(piece.position.origin - before.position.origin)) / mm / scale
        stride = math.ceil(CLOSE / step) if 0 < step < CLOSE else 1
        shown.append(_placed(piece, shift, outlined=piece.row % stride == 0))
        before = piece
    return shown


def _is_lattice(part: Part) -> bool:
    return isinstance(part.shape, Sum) and sum(len(own.positions) for own in part.shape.members) >= LATTICE


def _placed(piece: AssembledPiece, shift: Size | float = 0.0, *, outlined: bool = True) -> PlacedShape:
    assert piece.part.shape is not None
    position = Placement(piece.position.origin + shift, piece.position.rotation)
    return PlacedShape(piece.item, piece.part.shape, position, outlined)


def _exploded_sheet(titles: _Titles, items: Sequence[AssemblyItem], blocks: Sequence[Block]) -> AssemblySheet:
    low, high = extents([_placed(piece, block.shift) for block in blocks for piece in block.pieces], ISOMETRIC)
    least = _MACHINES if titles.assembly.assemblies else _PARTS
    draw = partial(_drawn_exploded, titles, [item.name for item in items], blocks)
    return _least_crowded(draw, _papers_of_exploded(high - low, len(items), least))


def _drawn_exploded(
    titles: _Titles, names: Sequence[str], blocks: Sequence[Block], paper: str, scale: float
) -> AssemblySheet:
    moved = _shown(titles.assembly, [(piece, block.shift) for block in blocks for piece in block.pieces], scale)
    low, high = _area(paper)
    view = item_view(moved, ISOMETRIC, scale, (low + high) / 2, len(names), tuple(SIDES))
    balloons, dashed = balloons_on(names, [view], moved)
    axes = np.array([block.line for block in blocks])
    lines = [
        *view.strokes(LineKind.CONTOUR, view.picture.lines()),
        *view.strokes(LineKind.CENTRE, view.picture.unhidden(axes)),
        *dashed,
    ]
    caption = SheetText(complex(LEFT + _PAD, PAPERS[paper][1] - EDGE - _PAD - 3.5), Sentence("sheet.exploded"), 3.5)
    drawn = [SheetPicture(tuple(lines), (caption,), ()), *(balloon.picture for balloon in balloons)]
    return AssemblySheet(titles.sheet(paper, scale, drawn, 2), balloons)


def _area(paper: str) -> tuple[complex, complex]:
    """Lower left and upper right corner of the room above the title block [mm]."""
    low = complex(LEFT + _PAD, EDGE + BLOCK_HEIGHT + _PAD)
    return low, complex(*PAPERS[paper]) - complex(EDGE + _PAD, EDGE + _PAD + _CAPTION)


def _papers_of_exploded(size: Size, count: int, larger: float) -> Iterator[tuple[str, float]]:
    """The papers on which view and balloons have room, and the largest scale on each."""
    for paper, least in LEAST_SIZE.items():
        low, high = _area(paper)
        room = high - low - 2 * ROOM * (1 + 1j)
        for scale in SCALES:
            wide, tall, _ = (size / mm / scale).tolist()
            if wide > room.real or tall > room.imag:
                continue
            balloons = len(rows_about((0.0, 0.0, wide, tall), tuple(SIDES))[0])
            if balloons >= _SPARE * count and (scale <= 1 or max(wide, tall) >= larger * least):
                yield paper, scale
            break


def _cells(item: AssemblyItem) -> Cells:
    own = item.made_of
    mass = "—" if math.isnan(item.mass) else format_quantity(item.mass, "kg" if item.mass >= 0.1 else "g", 3)
    title = own.title[:1].upper() + own.title[1:]
    if isinstance(own, AssemblyUnit):
        return item.name, str(item.quantity), title, Sentence("sheet.assembly"), own.drawing, mass
    if own.purchase is not None:
        return item.name, str(item.quantity), title, own.purchase.row or own.process, "—", mass
    assert own.material is not None
    return item.name, str(item.quantity), title, sold_as(own), own.id, mass


def _overall(first: complex, second: complex, out: complex, length: float) -> SheetDimension:
    """A dimension of a whole between two corners of a view; out of the view; the length [mm], to a whole one."""
    along = (second - first) / abs(second - first)
    line = _LINE * out
    middle = (first + second) / 2 + line + (1j if along == 1 else -1.0)
    words = f"({length:.0f})"
    text = SheetText(middle, words, 2.5, "center", 0.0 if along == 1 else math.pi / 2)
    drawn = [
        np.array([first + line, second + line]), np.array([first + out, first + line + 2 * out]),
        np.array([second + out, second + line + 2 * out]),
    ]  # fmt: skip
    strokes = tuple(SheetLine(LineKind.DIMENSION, points) for points in drawn)
    arrows = (first + line, -along), (second + line, along)
    across = along != 1
    return SheetDimension(
        DimensionKind.LINEAR, round(length) * mm, (first, second), first + line, text, strokes, arrows, across
    )
