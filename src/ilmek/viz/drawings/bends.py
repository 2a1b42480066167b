"""A bent sheet beside its flat pattern: its section with lengths to the sharp corners, and the table of its bends."""

import math
from itertools import pairwise

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.part.folding import FoldedSheet, neutral_share
from ilmek.part.shapes import Prism
from ilmek.plane.contours import STRAIGHT, bounds, counter_clockwise
from ilmek.plane.vectors import following
from ilmek.report import Contour
from ilmek.report.sheet import DimensionKind, LineKind, SheetText
from ilmek.sentences import Sentence
from ilmek.viz.drawings.features import SAME, contour_features, distinct
from ilmek.viz.drawings.paper import SCALES, scale_words, table
from ilmek.viz.drawings.picture import SheetPicture, millimetres
from ilmek.viz.drawings.view import DrawnView, MeasuredLength, coordinate

_WIDEST = 80.0
"""Greatest extent of the section on the paper [mm]."""


def bent_pictures(bent: Prism, sheet: FoldedSheet) -> tuple[SheetPicture, ...]:
    """The section and the table of the bends."""
    return _section(bent.section.outline, sheet), _bend_table(sheet)


def _section(outline: Contour, sheet: FoldedSheet) -> SheetPicture:
    """The section at the largest scale of ISO 5455 that has room, its thickness, radii and sharp corners."""
    low, high = bounds(outline)
    across = high - low
    ratio = next(own for own in SCALES if max(across.real, across.imag) * 1e3 / own <= _WIDEST)
    view = DrawnView(1e3 / ratio)
    view.contour(LineKind.VISIBLE, outline)
    corners = sharp_corners(outline)
    for upright in (False, True):
        ends = sorted(corners.tolist(), key=lambda point: coordinate(point, upright))
        values = distinct([coordinate(point, upright) for point in ends])
        feet = [next(p for p in ends if abs(coordinate(p, upright) - value) <= 2 * SAME) for value in values]
        spans = [
            MeasuredLength(feet[0] * view.scale, foot * view.scale, value - values[0])
            for foot, value in zip(feet[1:], values[1:], strict=True)
        ]
        view.rows(spans, across=upright)
    arcs = contour_features(outline).arcs
    for radius in distinct([bend.radius for bend in sheet.bends]):
        alike = [arc for arc in arcs if abs(arc.radius - radius) < 2 * SAME]
        ends_of = (alike[0].ends[0] * view.scale, alike[0].ends[1] * view.scale)
        view.leader(
            f"{len(alike)}× R{millimetres(radius)}", alike[0].centre * view.scale, radius * view.scale,
            kind=DimensionKind.RADIUS, value=radius, count=len(alike), sector=ends_of,
        )  # fmt: skip
    start, end = _end(outline, sheet)
    view.leader(
        f"t = {millimetres(sheet.thickness)}", start * view.scale, 0.0,
        kind=DimensionKind.ALIGNED, value=sheet.thickness, measured=(start * view.scale, end * view.scale),
    )  # fmt: skip
    top = complex((low.real + high.real) / 2 * view.scale, view.picture.box[3] + 3.0)
    view.text(SheetText(top, Sentence("sheet.bend-sharp", scale=scale_words(ratio)), 2.5, "center"))
    return view.picture


def _end(outline: Contour, sheet: FoldedSheet) -> tuple[complex, complex]:
    """The corners of the first edge of a section."""
    pairs = zip(outline.points.tolist(), following(outline.points).tolist(), strict=True)
    return next((a, b) for a, b in pairs if abs(abs(b - a) - sheet.thickness) < 2 * SAME)


def sharp_corners(outline: Contour) -> ComplexArray:
    """Both corners of each end, and where the outer faces of neighbouring flanks meet [m]."""
    outline = counter_clockwise(outline)
    starts, ends, arcs = outline.points, following(outline.points), np.abs(outline.bulges) > STRAIGHT
    straight = [(complex(a), complex(b)) for a, b, arc in zip(starts, ends, arcs, strict=True) if not arc]
    corners = []
    for (start, end), (after, last) in pairwise([*straight, straight[0]]):
        first, second = end - start, last - after
        turn = (first.conjugate() * second).imag
        share = ((after - start).conjugate() * second).imag / turn
        if turn > 0:  # an outer corner
            corners.append(start + share * first)
    return np.array(corners)


def _bend_table(sheet: FoldedSheet) -> SheetPicture:
    names = ("bend", "bend-middle", "bend-angle", "bend-side", "bend-radius")
    rows = [
        (
            str(number),
            millimetres(bend.middle),
            f"{round(math.degrees(abs(bend.angle)), 2):g}°",
            Sentence("sheet.bend-up" if bend.angle > 0 else "sheet.bend-down"),
            millimetres(bend.radius),
        )
        for number, bend in enumerate(sheet.bends, 1)
    ]
    share = f"{neutral_share(sheet.bends[0].radius, sheet.thickness):.3f}"
    title = Sentence("sheet.bends", width=millimetres(sheet.width), share=share)
    return table([Sentence(f"sheet.{name}") for name in names], rows, title)
