"""The edge of a plate: what is seen of its thickness, and the levels of its corners."""

from collections.abc import Iterator

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.plane.contours import along, bounds, polygon
from ilmek.report.sheet import LineKind
from ilmek.viz.drawings.features import SAME, distinct
from ilmek.viz.drawings.flat import FlatPart
from ilmek.viz.drawings.view import DrawnView, MeasuredLength


def edge_view(flat: FlatPart, thickness: float, scale: float, *, below: bool) -> DrawnView:
    """The edge of a plate: seen from the left, or from above where it stands below the outline (first angle)."""
    view = DrawnView(scale)

    def turn(level: float, depth: float) -> complex:
        return complex(level, -depth) if below else complex(depth, level)

    if flat.marked:
        datum = flat.datum.real if below else flat.datum.imag
        view.datum_mark(turn(datum, 0.0), {"X": 1.0, "Z": -1j} if below else {"Z": 1.0, "Y": 1j})
    low, high = bounds(flat.outline)
    start, end = (low.real, high.real) if below else (low.imag, high.imag)
    corners = [turn(start, 0.0), turn(end, 0.0), turn(end, thickness), turn(start, thickness)]
    view.contour(LineKind.VISIBLE, polygon(np.array(corners)))
    for level in distinct(list(edge_levels(flat, below=below))):
        if start + SAME < level < end - SAME:
            view.line(LineKind.VISIBLE, np.array([turn(level, 0.0), turn(level, thickness)]))
    round_holes = [(h.at, h.radius) for h in flat.holes] + [(b.centre, b.radius) for b in flat.bores]
    if len(round_holes) <= 12:
        for centre, radius in round_holes:
            middle = centre.real if below else centre.imag
            for level in (middle - radius, middle + radius):
                view.line(LineKind.HIDDEN, np.array([turn(level, 0.0), turn(level, thickness)]))
            over = 2.5 / scale
            view.line(LineKind.CENTRE, np.array([turn(middle, -over), turn(middle, thickness + over)]), body=False)
    view.rows([MeasuredLength(corners[0] * scale, corners[3] * scale, thickness)], across=below)
    return view


def edge_levels(flat: FlatPart, *, below: bool = False) -> Iterator[float]:
    """Levels of corners that nothing hides: on the side of the outline from which it is seen."""
    return levels_seen(flat, *((1j, 1.0) if below else (-1.0, 1j)))


def levels_seen(flat: FlatPart, eye: complex, up: complex) -> Iterator[float]:
    """Coordinates along `up` of corners of an outline that nothing hides from an eye; both are units, across."""
    if not flat.dimensioned:
        return
    points = _seen(along(flat.outline, 1e-5), eye, up)
    after = np.roll(points, -1)
    for depth, level in ((seen.real, seen.imag) for seen in _seen(np.array(flat.features.corners), eye, up).tolist()):
        hidden = False
        for offset in (-1e-6, 1e-6):
            crossed = (points.imag > level + offset) != (after.imag > level + offset)
            share = (level + offset - points.imag[crossed]) / (after.imag[crossed] - points.imag[crossed])
            before = points.real[crossed] + share * (after.real[crossed] - points.real[crossed])
            hidden = hidden or bool(np.any(before < depth - 1e-5))
        if not hidden:
            yield level


def _seen(points: ComplexArray, eye: complex, up: complex) -> ComplexArray:
    """Points by their depth from an eye, and their coordinate along `up` as imaginary part."""
    return np.asarray(-(points * np.conj(eye)).real + 1j * (points * np.conj(up)).real)
