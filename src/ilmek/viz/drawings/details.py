"""Detail views of what is too small on its paper: a thin circle with a letter, and the same enlarged; ISO 128-3.

A feature narrower than 2 mm on the paper is drawn again at the first scale of ISO 5455 at which it is 5 mm wide.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.plane.contours import along, circle
from ilmek.records import record
from ilmek.report import Contour
from ilmek.report.sheet import LineKind, SheetText
from ilmek.viz.drawings.features import SAME
from ilmek.viz.drawings.paper import SCALES, scale_words
from ilmek.viz.drawings.picture import SheetPicture
from ilmek.viz.drawings.view import DrawnView, MeasuredLength

LEAST, CLEAR, WIDEST = 2.0, 5.0, 90.0
"""Width below which a feature has a detail, its least width there, and the greatest diameter of a detail [mm]."""

_NEAR, _AROUND = 20.0, 5.0
"""Distance of features that share a detail, and room about them, on the main view [mm]."""

_LETTERS = "WVUTSRQP"
"""Of details: X, Y and Z are axes, the first ones datums."""


@record
class DetailCircle:
    """A detail: its letter, and the circle that it shows [m]; scale  in mm of the paper per m."""

    letter: str
    centre: complex
    radius: float
    scale: float

    def has(self, point: complex) -> bool:
        """Whether a point of the part is in it."""
        return abs(point - self.centre) < self.radius


def details_for(features: Sequence[tuple[complex, float]], scale: float) -> tuple[DetailCircle, ...]:
    """The details of features by middle and width [m] in a view at a scale [mm of the paper per m]."""
    groups: list[list[tuple[complex, float]]] = []
    for at, width in features:
        if width * scale < LEAST:
            near = next((own for own in groups if abs(at - own[0][0]) * scale < _NEAR), None)
            if near is None:
                groups.append([(at, width)])
            else:
                near.append((at, width))
    return tuple(_detail(letter, group, scale) for letter, group in zip(_LETTERS, groups, strict=False))


def _detail(letter: str, group: list[tuple[complex, float]], scale: float) -> DetailCircle:
    middles = np.array([at for at, _ in group])
    centre = complex(middles.real.min() + middles.real.max(), middles.imag.min() + middles.imag.max()) / 2
    least = min(width for _, width in group)
    radius = max(abs(at - centre) + width / 2 for at, width in group) + _AROUND / scale
    offered = [1e3 / one for one in reversed(SCALES) if 1e3 / one > scale and 2 * radius * 1e3 / one <= WIDEST]
    enlarged = next((one for one in offered if least * one >= CLEAR), max(offered, default=2 * scale))
    return DetailCircle(letter, centre, radius, enlarged)


def mark_detail(view: DrawnView, detail: DetailCircle) -> None:
    """The circle of a detail in the main view, with its letter."""
    ring = along(circle(detail.centre, detail.radius), 0.02 / view.scale)
    view.line(LineKind.DIMENSION, np.append(ring, ring[:1]), body=False)
    view.leader(detail.letter, detail.centre * view.scale, detail.radius * view.scale, kind=None)


def detail_view(detail: DetailCircle, curves: Sequence[Contour]) -> DrawnView:
    """What closed curves have in the circle of a detail, enlarged about its centre, below letter and scale."""
    view = DrawnView(detail.scale)
    for curve in curves:
        points = along(curve, 0.01 / detail.scale) - detail.centre
        for piece in clipped(np.append(points, points[:1]), detail.radius):
            view.line(LineKind.VISIBLE, piece)
    ring = along(circle(0j, detail.radius), 0.02 / detail.scale)
    view.line(LineKind.DIMENSION, np.append(ring, ring[:1]))
    top = 1j * (detail.radius * detail.scale + 3.0)
    view.text(SheetText(top, f"{detail.letter} ({scale_words(1e3 / detail.scale)})", 3.5, "center"))
    return view


def clipped(points: ComplexArray, radius: float) -> list[ComplexArray]:
    """The pieces of a line through points that lie in a circle about 0.

    >>> [piece.tolist() for piece in clipped(np.array([-2 + 0j, 2 + 0j]), 1.0)]
    [[(-1+0j), (1+0j)]]
    """
    pieces: list[list[complex]] = []
    for start, end in zip(points[:-1].tolist(), points[1:].tolist(), strict=True):
        along_it, square = end - start, abs(end - start) ** 2
        middle = -(start.conjugate() * along_it).real / square if square else 0.0
        reach = radius**2 - abs(start + middle * along_it) ** 2
        if not square or reach <= 0:
            continue
        half = (reach / square) ** 0.5
        first, last = max(0.0, middle - half), min(1.0, middle + half)
        if last > first:
            ends = start + first * along_it, start + last * along_it
            if pieces and pieces[-1][-1] == ends[0]:
                pieces[-1].append(ends[1])
            else:
                pieces.append([*ends])
    return [np.array(piece) for piece in pieces]


def step_detail(view: DrawnView, contour: Contour) -> SheetPicture | None:
    """The detail of the smallest steps and grooves of a turned part that is too small in a view; None: there are none.

    Its lengths and depths are dimensioned there, each once; of a whole part that is thin there is none.
    """
    starts, ends = contour.points, np.roll(contour.points, -1)
    whole = float(np.ptp(starts.real))
    small = (starts.imag + ends.imag > 0) & (np.abs(ends - starts) * view.scale < LEAST)
    small &= np.abs(ends - starts) < whole * (1 - 1e-9)
    if not small.any():
        return None
    sizes = np.where(small, np.abs(ends - starts), np.inf)
    first = int(np.flatnonzero(sizes < sizes.min() + SAME)[0])
    centre, width = complex(starts[first] + ends[first]) / 2, float(sizes[first])
    least = next((1e3 / scale for scale in reversed(SCALES) if width * 1e3 / scale >= CLEAR), 1e3 / SCALES[0])
    detail = DetailCircle(_LETTERS[0], centre, 4 * width, least)
    far = centre.real - float(starts.real.min()) > whole / 2  # a shortened view keeps distances from its ends
    shift = view.body[2] / view.scale - float(starts.real.max()) if far else 0.0
    mark_detail(view, replace(detail, centre=centre + shift, radius=max(detail.radius, _AROUND / 2 / view.scale)))
    enlarged = detail_view(detail, [contour])
    spans: dict[bool, dict[float, MeasuredLength]] = {False: {}, True: {}}
    for start, end in zip(starts.tolist(), ends.tolist(), strict=True):
        if detail.has(start) and detail.has(end):
            for across, length in ((False, abs(end.real - start.real)), (True, abs(end.imag - start.imag))):
                if length > SAME:
                    tips = (start - centre) * least, (end - centre) * least
                    spans[across].setdefault(round(length, 7), MeasuredLength(*tips, length))
    for across, lengths in spans.items():
        enlarged.rows(tuple(lengths.values()), across=across)
    return enlarged.picture
