"""A part's sheet: the smallest paper and the largest scale at which its views, dimensions and tables have room.

First-angle projection (ISO 5456-2): the view from the left stands right of the front view, that from above below it.
"""

import math
from collections.abc import Callable, Sequence
from functools import cache, lru_cache
from typing import cast

import numpy as np

from ilmek.part.shapes import Prism, Shape, Sum, Turned, shape_box
from ilmek.part.specification import YARN_ROUGH
from ilmek.part.tolerances import FeatureKind, FitDuty
from ilmek.plane.contours import bounds
from ilmek.records import record
from ilmek.report.sheet import DrawingSheet, Issue, SheetText
from ilmek.sentences import Sentence
from ilmek.units import mm, um
from ilmek.viz.drawings.cam import cam_notes, is_cam, radius_tables
from ilmek.viz.drawings.coaxial import coaxial, end_view
from ilmek.viz.drawings.details import step_detail
from ilmek.viz.drawings.drawn_part import DrawnPart
from ilmek.viz.drawings.fits import Fits
from ilmek.viz.drawings.hole_tables import face_views, hole_tables, named_holes
from ilmek.viz.drawings.joined import joined_views, members_of
from ilmek.viz.drawings.long import turned_view
from ilmek.viz.drawings.member_outlines import member_outlines
from ilmek.viz.drawings.packing import BETWEEN, PAD, packed, top_left
from ilmek.viz.drawings.paper import (
    BLOCK_HEIGHT,
    BLOCK_WIDTH,
    EDGE,
    LEFT,
    PAPERS,
    SCALES,
    TitleFacts,
    frame,
    table,
    title_block,
    wrapped,
)
from ilmek.viz.drawings.picture import Box, SheetPicture, joined_box, millimetres
from ilmek.viz.drawings.prism import flat_foot, prism_views
from ilmek.viz.drawings.projector import Projector
from ilmek.viz.drawings.view import DrawnView
from ilmek.viz.drawings.weld_symbols import cut_list, weld_symbols, weld_table

_SPARE = 1.0
"""What the quick look allows for chords of arcs [mm]."""

LEAST_SIZE = {"A4": 70.0, "A3": 80.0, "A2": 110.0, "A1": 150.0}
"""Least greatest extent of a part on a paper [mm]: below it, the next paper is taken."""

MOST_CROWDED = 12.0
"""Greatest shift of a running dimension from its point [mm]; beyond it, the next paper is taken."""

_SMALL = ("A4", "A3")
"""Papers that are left where running dimensions crowd."""

MOST_ENLARGED, _CLEARED = 90.0, 300.0
"""Greatest extent of a section that is drawn larger than it is, and of one whose dimensions are crowded at full size
[mm of the paper]."""


@record
class Arrangement:
    """Views by where they stand: `front`, `left` or `right` of it, `below` it; and tables."""

    views: dict[str, DrawnView]
    tables: tuple[SheetPicture, ...] = ()

    @property
    def crowded(self) -> bool:
        """Whether running dimensions stand far from their points."""
        return max(view.crowding for view in self.views.values()) > MOST_CROWDED


def arranged(part: DrawnPart, scale: float, project: Projector | None) -> Arrangement | None:
    """The views of a part at a scale [mm of the paper per m]; None: the kernel is needed, and missing."""
    fits, shape = Fits(part.features, part.stated.roughness if part.stated else None), part.shape
    fit_table = fits.table()
    tables = () if fit_table is None else (fit_table,)
    if part.cut is not None:
        tables = (*tables, cut_list(part.cut, part.pieces))
    if isinstance(shape, Prism):
        views, more = prism_views(part, shape, fits, scale)
        return Arrangement(views, (*tables, *more))
    if part.welds:
        tables = (*tables, weld_table(part.welds, shape_box(cast(Shape, shape))[0], part.pieces))
    if isinstance(shape, Turned):
        front = turned_view(shape.profile, scale, fits)
        detail = step_detail(front, shape.profile.outline)
        return Arrangement({"front": front}, tables if detail is None else (*tables, detail))
    members = tuple(members_of(shape))
    one_axis = coaxial(members)
    if one_axis is not None:
        views = {"front": turned_view(one_axis.profile, scale, fits, one_axis.grooves, one_axis.half_widths)}
        if one_axis.ends or one_axis.bores or one_axis.squares:
            views["right"] = end_view(one_axis, scale, fits)
        return Arrangement(views, tables)
    if project is None:
        return None
    views, more = joined_views(shape, scale, project, fits)
    own = cast(Shape, shape)
    named, datum = named_holes(own, None, fits, part.kinds), shape_box(own)[0]
    if named:
        views["front"].datum_mark(complex(*datum[:2]), {"X": 1.0, "Y": 1j})
    more = (*hole_tables(named, datum, part.kinds), *face_views(own, project, named, datum), *more)
    weld_symbols(views["front"], part.welds, flat_foot(scale))
    return Arrangement(views, (*tables, *more, *member_outlines(members, scale)))


def sheets_of(part: DrawnPart, issue: Issue, project: Projector | None) -> tuple[DrawingSheet, ...]:
    """All sheets of a part; none: the kernel is needed for them, and missing."""
    sheet = composed(part, issue, project)
    if sheet is None:
        return ()
    return (sheet, _radii_sheet(part, issue)) if is_cam(part) else (sheet,)


def _radii_sheet(part: DrawnPart, issue: Issue) -> DrawingSheet:
    """The second sheet of a cam: its radii at each degree."""
    listed = merged(radius_tables(part))
    wide = listed.box[2] + LEFT + EDGE + PAD
    paper, height = next((name, tall) for name, (across, tall) in PAPERS.items() if wide <= across)
    radius, step = (millimetres(size) for size in (part.cam.tolerance, part.cam.increment)) if part.cam else ("", "")
    within = Sentence("sheet.radii-within", tolerance=radius, increment=step) if part.cam else ""
    words = Sentence("sheet.radii", within=within)
    caption = SheetText(complex(LEFT + PAD, height - EDGE - 8.0), words, 2.5, bold=True)
    corner = complex(LEFT + PAD, height - EDGE - 11.0)
    laid = merged([top_left(listed, corner), SheetPicture((), (caption,), ())])
    return _sheet(part, issue, paper, 1.0, laid, 2)


def composed(part: DrawnPart, issue: Issue, project: Projector | None) -> DrawingSheet | None:
    """The sheet of a part; None: the kernel is needed for it, and missing."""
    project = None if project is None else lru_cache(maxsize=8)(project)  # the same at every scale
    needed = _joined_extent(part.shape)
    drawn = cache(lambda scale: arranged(part, 1e3 / scale, project))  # the same on every paper
    for paper in PAPERS:
        for scale in SCALES:
            most = _CLEARED if paper not in _SMALL and _is_crowded(drawn) else MOST_ENLARGED
            arrangement = drawn(scale) if _may_fit(part, needed, paper, scale, most) else None
            if arrangement is None:
                continue
            body = arrangement.views["front"].body
            if scale > 1 and max(body[2] - body[0], body[3] - body[1]) < LEAST_SIZE.get(paper, 0.0):
                break  # it is smaller still at all further scales
            laid = _laid(arrangement, part, paper)
            if laid is None:
                continue
            if arrangement.crowded and paper in _SMALL:
                break
            return _sheet(part, issue, paper, scale, laid)
    if project is None and arranged(part, 1.0, None) is None:
        return None
    raise ValueError(f"{part.number} fits no sheet")


def _is_crowded(drawn: Callable[[float], Arrangement | None]) -> bool:
    """Whether running dimensions are crowded at full size."""
    arrangement = drawn(1.0)
    return arrangement is not None and arrangement.crowded


def _may_fit(part: DrawnPart, needed: complex, paper: str, scale: float, most: float) -> bool:
    """Whether a part's views could have room: a quick look, before anything is drawn.

    needed  least extent of all its views [m]
    most  extent on the paper if enlarged [mm]
    """
    size, (low_x, low_y, high_x, high_y) = _extent(part.shape) * 1e3 / scale, _area(paper)
    if scale < 1 and max(size.real, size.imag) > most:
        return False
    size = max(size.real, needed.real * 1e3 / scale) + 1j * max(size.imag, needed.imag * 1e3 / scale)
    return size.real < high_x - low_x + _SPARE and size.imag < high_y - low_y + _SPARE


def _joined_extent(shape: object) -> complex:
    """Width and height that the views of a sum take at least [m], without the room between them; else 0."""
    if not isinstance(shape, Sum) or coaxial(tuple(members_of(shape))) is not None:
        return 0j
    wide, tall, deep = np.ptp(shape_box(shape), axis=0).tolist()
    return complex(wide + deep, tall + deep)


def _extent(shape: object) -> complex:
    """Width and height that no front or section view of a shape falls below [m]; long parts are interrupted."""
    if isinstance(shape, Prism):
        low, high = bounds(shape.section.outline)
        return high - low
    return 2j * shape.outer_radius if isinstance(shape, Turned) else 0j


def _area(paper: str) -> Box:
    """The room of the views on a paper."""
    width, height = PAPERS[paper]
    return LEFT + PAD, EDGE + BLOCK_HEIGHT + PAD, width - EDGE - PAD, height - EDGE - PAD


def _laid(arrangement: Arrangement, part: DrawnPart, paper: str) -> SheetPicture | None:
    """All pictures at their positions on the paper; None: they have no room."""
    width, area = PAPERS[paper][0], _area(paper)
    views = _projected(arrangement.views)
    box = joined_box([view.box for view in views])
    notes = _notes(part)
    beside = (LEFT + PAD, EDGE + PAD, width - EDGE - BLOCK_WIDTH - PAD, EDGE + BLOCK_HEIGHT + PAD)
    placed: list[SheetPicture] = []
    if notes is not None:
        tall, wide = notes.box[3] - notes.box[1], notes.box[2] - notes.box[0]
        if wide <= beside[2] - beside[0] and tall <= beside[3] - beside[1]:
            placed.append(top_left(notes, complex(beside[0], beside[3] - PAD)))
        else:
            placed.append(notes.moved(complex(area[0] - notes.box[0], area[1] - notes.box[1])))
            area = (area[0], area[1] + tall + PAD, area[2], area[3])
    beside_views = packed(arrangement.tables, area, complex(box[2] - box[0], box[3] - box[1]))
    if beside_views is None:
        return None
    tables, area = beside_views
    free = complex(area[2] - area[0] - box[2] + box[0], area[3] - area[1] - box[3] + box[1])
    if min(free.real, free.imag) < 0:
        return None
    by = complex(area[0] - box[0], area[1] - box[1]) + free / 2
    return merged([*(view.moved(by) for view in views), *placed, *tables])


def _projected(views: dict[str, DrawnView]) -> list[SheetPicture]:
    """The views about the front view, aligned with it."""
    front = views["front"].picture
    pictures = [front]
    if "left" in views:
        view = views["left"]
        pictures.append(view.picture.moved(front.box[0] - BETWEEN - view.picture.box[2]))
    if "right" in views:
        view = views["right"]
        pictures.append(view.picture.moved(front.box[2] + BETWEEN - view.picture.box[0]))
    if "below" in views:
        view = views["below"]
        pictures.append(view.picture.moved(1j * (front.box[1] - BETWEEN - view.picture.box[3])))
    if "corner" in views:
        view, box = views["corner"], joined_box([picture.box for picture in pictures])
        left = pictures[1].box[0] if "right" in views else box[2] + BETWEEN
        top = min(front.box[1], pictures[1].box[1] if "right" in views else box[1]) - PAD
        pictures.append(top_left(view.picture, complex(left, top)))
    return pictures


def merged(pictures: Sequence[SheetPicture]) -> SheetPicture:
    """Pictures as one."""
    return SheetPicture(
        tuple(line for picture in pictures for line in picture.lines),
        tuple(text for picture in pictures for text in picture.texts),
        tuple(dimension for picture in pictures for dimension in picture.dimensions),
    )


def _notes(part: DrawnPart) -> SheetPicture | None:
    """What the workshop must know besides."""
    lines = [*part.notes, *(() if part.cam is None else cam_notes(part.cam))]
    hard = part.stated is not None and part.stated.hardening is not None
    if hard and any(own.kind in {FeatureKind.THREAD, FeatureKind.OUTER_THREAD} for own in part.features):
        lines.append(Sentence("sheet.soft-threads"))
    if part.stated is not None and part.stated.yarn_edge:
        radius, rough = millimetres(part.stated.yarn_edge), f"{YARN_ROUGH / um:g}"
        lines.append(Sentence("sheet.yarn-edges", radius=radius, rough=rough))
    ends = [own.nominal for own in part.features if own.kind is FeatureKind.JOURNAL and own.duty in _CHAMFERED]
    if ends:
        size = next(size for most, size in _CHAMFERS if min(ends) <= most)
        lines.append(Sentence("sheet.chamfers", size=millimetres(size)))
    if part.file:
        lines.append(Sentence("sheet.contour", file=part.file))
    if not lines:
        return None
    rows = [
        row
        for number, line in enumerate(lines, 1)
        for row in wrapped(Sentence("sheet.note", number=number, line=line), 168.0, 2.5)
    ]
    return table((Sentence("sheet.notes"),), [(row,) for row in rows])


_CHAMFERED = {FitDuty.BEARING, FitDuty.KEYED}
_CHAMFERS = ((10 * mm, 0.5 * mm), (30 * mm, 1 * mm), (80 * mm, 1.5 * mm), (math.inf, 2 * mm))
"""Largest journal, and chamfer of its end, over which a bearing or hub comes [m]; assumed by this project."""


def status_of(issue: Issue) -> Sentence:
    """The status of a document in words."""
    if issue.unreleased:
        return Sentence("paper.not-released")
    return Sentence("sheet.for-production") if issue.given else Sentence("sheet.not-issued")


def _sheet(  # noqa: PLR0917
    part: DrawnPart, issue: Issue, paper: str, scale: float, laid: SheetPicture, page: int = 1
) -> DrawingSheet:
    pages = 2 if is_cam(part) else 1
    facts = TitleFacts(
        part.number, part.title, Sentence("sheet.part-drawing"), part.material, part.mass_words,
        part.stock, str(part.pieces), part.surface, part.treatment, part.general, part.edges, status_of(issue),
        issue.owner, issue.date, issue.revision,
    )  # fmt: skip
    whole = merged([frame(paper), title_block(facts, paper, scale, page, pages), laid])
    width, height = PAPERS[paper]
    stamp = status_of(issue) if issue.unreleased else ""
    return DrawingSheet(
        part.number, part.title, paper, width, height, scale, whole.lines, whole.texts, whole.dimensions, page, pages,
        stamp,
    )  # fmt: skip
