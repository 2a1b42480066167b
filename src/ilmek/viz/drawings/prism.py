"""Views of plates, and of bars of stock: with the tables of holes and welds from the datum, which a mark shows."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ilmek.part.folding import folded_sheet
from ilmek.part.shapes import Prism
from ilmek.plane.contours import bounds
from ilmek.viz.drawings.bends import bent_pictures
from ilmek.viz.drawings.cam import cam_circles, is_cam, mark_cam
from ilmek.viz.drawings.drawn_part import DrawnPart
from ilmek.viz.drawings.edge import edge_view
from ilmek.viz.drawings.face_notes import FRONT, X, Y, Z, face_notes
from ilmek.viz.drawings.fits import Fits
from ilmek.viz.drawings.flat import FlatPart, flat_part, outline_view
from ilmek.viz.drawings.hole_tables import face_views, hole_tables, listed_centres, named_holes
from ilmek.viz.drawings.holes import NamedHole
from ilmek.viz.drawings.long import bar_view, is_long
from ilmek.viz.drawings.picture import SheetPicture
from ilmek.viz.drawings.view import DrawnView
from ilmek.viz.drawings.weld_symbols import Foot, weld_symbols, weld_table

_Views = tuple[dict[str, DrawnView], tuple[SheetPicture, ...]]


def prism_views(part: DrawnPart, shape: Prism, fits: Fits, scale: float) -> _Views:
    """A bar from its side with its section, or a plate with its edge; views of the faces with holes, and tables."""
    listed = listed_centres(shape, part.kinds)
    bar = is_long(shape.section, shape.length)
    sheet = None if bar else folded_sheet(part.bent)
    scribed = () if sheet is None else tuple(1j * bend.middle for bend in sheet.bends)
    flat = flat_part(shape.section, fits, smooth=part.smooth and not bar, scribed=scribed, listed=listed)
    datum = np.array([flat.datum.real, flat.datum.imag, 0.0])
    named = named_holes(shape, flat, fits, part.kinds)
    front = [] if bar else [hole for hole in named if hole.is_in_front]
    flat = replace(flat, marked=bool(named or part.welds))
    views, tables = _bar(part, shape, flat, fits, scale) if bar else _plate(part, shape, flat, fits, scale, front)
    others = [hole for hole in named if hole not in front]
    tables = (*hole_tables(named, datum, part.kinds), *face_views(shape, flat, others, datum), *tables)
    return views, (weld_table(part.welds, datum, part.pieces), *tables) if part.welds else tables


def _bar(part: DrawnPart, shape: Prism, flat: FlatPart, fits: Fits, scale: float) -> _Views:
    """A bar from its side, and its section on the left of it: the view from the right (first angle)."""
    section, tables = outline_view(flat, scale, fits)
    face_notes(section, fits, *FRONT)
    return {"front": bar_view(flat, shape.length, scale, part.welds), "left": section}, tables


def _plate(  # noqa: PLR0917
    part: DrawnPart, shape: Prism, flat: FlatPart, fits: Fits, scale: float, named: Sequence[NamedHole]
) -> _Views:
    """A plate with its edge, of a cam and of a bent part also what these have."""
    sheet = folded_sheet(part.bent)
    circles = cam_circles(part) if is_cam(part) else None
    front, tables = outline_view(flat, scale, fits, paths=part.paths, marks=part.marks, circles=circles, named=named)
    if is_cam(part):
        mark_cam(front, part)
    if sheet is not None and part.bent is not None:
        tables = (*tables, *bent_pictures(part.bent, sheet))
    low, high = bounds(flat.outline)
    below = edge_below(high - low)
    edge = edge_view(flat, shape.length, scale, below=below)
    face_notes(front, fits, *FRONT)
    face_notes(edge, fits, *((X, -Z) if below else (Z, Y)))
    ends = [weld for weld in part.welds if weld.all_round]
    weld_symbols(front, [weld for weld in part.welds if not weld.all_round], flat_foot(scale))
    weld_symbols(edge, ends, _edge_foot(high, scale, below=below))
    return {"front": front, "below" if below else "right": edge}, tables


def _edge_foot(high: complex, scale: float, *, below: bool) -> Foot:
    """Where welds round the ends are in the view on the edge of a plate; high  its upper right corner."""
    if below:
        return lambda weld: complex(high.real, -float(weld.middle[2])) * scale
    return lambda weld: complex(float(weld.middle[2]), high.imag) * scale


def flat_foot(scale: float) -> Foot:
    """Where welds are in the front view of a plate."""
    return lambda weld: complex(float(weld.middle[0]), float(weld.middle[1])) * scale


def edge_below(size: complex) -> bool:
    """Whether the edge of a plate of a width and height is seen below its front view, not right of it."""
    return size.real > size.imag * 1.2
