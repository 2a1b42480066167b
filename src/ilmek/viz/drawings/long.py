"""Views of turned parts, in half section, and of bars and tubes of stock with their section; long ones interrupted."""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.elements.machine_screws import core_of
from ilmek.part.profile import Profile
from ilmek.part.tolerances import FeatureKind, groove_tolerance
from ilmek.part.welds import Weld
from ilmek.plane.contours import along, bounds, counter_clockwise
from ilmek.records import record
from ilmek.report import Contour
from ilmek.report.sheet import DimensionKind, LineKind
from ilmek.sentences import Sentence
from ilmek.viz.drawings.edge import edge_levels
from ilmek.viz.drawings.feature_note import FeatureNote
from ilmek.viz.drawings.features import SAME, ContourFeatures, contour_features, distinct
from ilmek.viz.drawings.fits import Fits, Span, span_of
from ilmek.viz.drawings.flat import PARALLEL, FlatPart
from ilmek.viz.drawings.holes import thread_words
from ilmek.viz.drawings.picture import millimetres
from ilmek.viz.drawings.view import NO_NOTE, DrawnView, MeasuredLength
from ilmek.viz.drawings.weld_symbols import weld_symbols

MOST_DIAMETERS = 10
"""Diameters of a turned part that are labelled; of more, the largest and smallest."""

FINE = 400
"""Points of a profile that is a curve: its outside is what is farther from the axis than half of it."""

MOST_SEATS = 10
"""Ends of welds that are dimensioned along a bar; more stand in the table of the welds alone."""


@record
class Shortening:
    """A view with its longest even stretch cut out: from `start` to `end` only `kept` is drawn [m]; none: whole."""

    start: float = 0.0
    end: float = 0.0
    kept: float = 0.0

    @property
    def whole(self) -> bool:
        """Whether nothing is cut out."""
        return self.end <= self.start

    def drawn(self, z: FloatArray | float) -> FloatArray:
        """Where coordinates are drawn [m]."""
        z = np.asarray(z, dtype=float)
        if self.whole:
            return z
        share = np.clip((z - self.start) / (self.end - self.start), 0.0, 1.0)
        return np.asarray(np.minimum(z, self.start) + share * self.kept + np.maximum(z - self.end, 0.0))


def shortening(levels: Sequence[float], across: float) -> Shortening:
    """The shortening of a part with steps at ascending levels and a greatest width [m]: of its longest stretch."""
    gaps = np.diff(levels)
    longest = int(np.argmax(gaps))
    kept = max(2.5 * across, (levels[-1] - levels[0] - gaps[longest]) * 0.5)
    if gaps[longest] < 2.0 * kept:
        return Shortening()
    return Shortening(levels[longest], levels[longest + 1], kept)


def _break_lines(view: DrawnView, cut: Shortening, half: float) -> None:
    """Two zigzag lines where a view is interrupted."""
    if cut.whole:
        return
    middle, gap, tooth = cut.start + cut.kept / 2, 1.2 / view.scale, 1.5 / view.scale
    for z in (middle - gap, middle + gap):
        over = half + 2.0 / view.scale
        bent = tooth * complex(0.7, 0.4)
        zigzag = np.array([-1j * over, -1j * tooth, -bent, bent, 1j * tooth, 1j * over])
        view.line(LineKind.BREAK, z + zigzag, body=False)


def _stretch(cut: Shortening, start: complex, end: complex, gap: float) -> list[ComplexArray]:
    """A straight line of the part as drawn, open where the view is interrupted."""
    first, last = (complex(float(cut.drawn(p.real)), p.imag) for p in (start, end))
    if cut.whole or not min(start.real, end.real) <= cut.start < cut.end <= max(start.real, end.real):
        return [np.array([first, last])]
    middle = cut.start + cut.kept / 2
    shares = sorted((middle + side * gap - first.real) / (last.real - first.real) for side in (-1, 1))
    near, far = (first + share * (last - first) for share in shares)
    return [np.array([first, near]), np.array([far, last])]


def turned_view(
    profile: Profile,
    scale: float,
    fits: Fits,
    grooves: Sequence[tuple[float, float, float]] = (),
    squares: Sequence[float] = (),
) -> DrawnView:
    """A turned part with its axis horizontal: in half section where it is bored.

    grooves  for keys: begin and end along the axis, distance of the floor from it [m]
    squares  half widths of square lengths [m]: their flats are marked by diagonals
    """
    view, contour = DrawnView(scale), counter_clockwise(profile.outline)
    features = contour_features(contour)
    corners = features.corners
    low, high = bounds(contour)
    seats = [span_of(feature) for feature in fits.features if feature.length > 0 and features.fully]
    levels = distinct([*(c.real for c in corners), *(z for ends in (*grooves, *seats) for z in ends[:2])])
    cut = shortening(levels, 2 * high.imag) if features.fully else Shortening()
    gap = 1.2 / scale
    drilled = with_cores(contour, fits)
    points = along(drilled, 0.01 / scale)
    after = np.roll(points, -1)
    outer = _outer(points, after)
    hollow = len(points) <= FINE and bool(np.any(~outer & (np.minimum(points.imag, after.imag) > SAME)))
    bored = low.imag > SAME or bool(profile.holes) or hollow
    for start, end, outside in zip(points.tolist(), after.tolist(), outer.tolist(), strict=True):
        on_axis = max(start.imag, end.imag) < SAME
        for piece in () if on_axis else _stretch(cut, start, end, gap):
            if bored or outside:
                view.line(LineKind.VISIBLE, piece)
            if outside:
                view.line(LineKind.VISIBLE, piece.conj())
    edges = contour_features(drilled).corners
    for corner in edges if features.fully else (low, complex(high.real, low.imag)):
        _edge_lines(view, cut, corner, drilled, bored)
    if bored:
        for radius, span in threads_of(fits):
            view.line(LineKind.DIMENSION, cut.drawn(np.array(span)) + 1j * radius)
        loops = (drilled, *profile.holes)
        view.hatch([_drawn_loop(cut, along(loop, 0.01 / scale)) for loop in loops])
        for hole in profile.holes:
            view.contour(LineKind.VISIBLE, Contour(_drawn_loop(cut, hole.points), hole.bulges))
    for start, end, floor in grooves:
        floor_ends = cut.drawn(np.array([start, end])) + 1j * floor
        view.line(LineKind.HIDDEN, floor_ends)
    _seat_ends(view, cut, fits, levels=[corner.real for corner in corners])
    _break_lines(view, cut, high.imag)
    over = 3.0 / scale
    ends = cut.drawn(np.array([low.real, high.real]))
    view.line(LineKind.CENTRE, np.array([ends[0] - over + 0j, ends[1] + over + 0j]), body=False)
    _lengths(view, cut, levels, low, high, features)
    _diameters(view, cut, features, contour, fits, squares)
    return view


def _seat_ends(view: DrawnView, cut: Shortening, fits: Fits, *, levels: Sequence[float]) -> None:
    """Thin lines where a seat ends on a diameter that goes on, and along the core of an outer thread."""
    for feature in fits.features:
        if feature.kind is FeatureKind.OUTER_THREAD:
            for core in (feature.nominal / 2 - 0.8 / view.scale) * np.array([-1j, 1j]):
                view.line(LineKind.DIMENSION, cut.drawn(np.array(span_of(feature))) + core, body=False)
        if feature.kind is FeatureKind.JOURNAL:
            for end in (z for z in span_of(feature) if all(abs(z - level) > SAME for level in levels)):
                half = feature.nominal / 2 * 1j
                view.line(LineKind.DIMENSION, float(cut.drawn(end)) + np.array([-half, half]), body=False)


def threads_of(fits: Fits) -> Iterator[tuple[float, Span]]:
    """Radius, begin and end along the axis of the threads of a turned part [m]."""
    yield from (
        (feature.nominal / 2, span_of(feature)) for feature in fits.features if feature.kind is FeatureKind.THREAD
    )


def with_cores(contour: Contour, fits: Fits) -> Contour:
    """A profile with the cores of its threads, as they are drilled: narrower than the thread, and deeper."""
    points = contour.points.copy()
    for radius, ends in threads_of(fits):
        core = core_of(2 * radius)
        if core is None:
            continue
        for end, sense in zip(ends, (-1, 1), strict=True):
            at_end = np.abs(contour.points.real - end) < SAME
            if (at_end & (contour.points.imag < SAME)).any():  # its floor
                points[at_end & (contour.points.imag < radius + SAME)] += sense * core[1]
        own = (contour.points.real > ends[0] - SAME) & (contour.points.real < ends[1] + SAME)
        own &= np.abs(contour.points.imag - radius) < SAME
        points[own] -= 1j * (radius - core[0] / 2)
    return Contour(points, contour.bulges)


def _drawn_loop(cut: Shortening, points: ComplexArray) -> ComplexArray:
    return np.asarray(cut.drawn(points.real) + 1j * points.imag)


def _outer(points: ComplexArray, after: ComplexArray) -> np.ndarray:
    """Whether each piece is on the outside of the part: nothing lies farther from the axis."""
    middle = (points + after) / 2
    upright = np.abs((after - points).real) < SAME
    outside = np.ones(len(points), dtype=bool)
    if len(points) > FINE:
        return np.asarray(middle.imag > 0.5 * middle.imag.max())
    for number, at in enumerate(middle.tolist()):
        spans = (np.minimum(points.real, after.real) < at.real) & (np.maximum(points.real, after.real) > at.real)
        spans[number] = False
        reach = 0.0
        if spans.any():
            share = (at.real - points.real[spans]) / (after.real[spans] - points.real[spans])
            reach = float(np.max(points.imag[spans] + share * (after.imag[spans] - points.imag[spans])))
        outside[number] = at.imag >= reach - SAME
    return np.asarray(outside & ~(upright & (middle.imag < SAME)))


def _edge_lines(view: DrawnView, cut: Shortening, corner: complex, contour: Contour, bored: bool) -> None:
    """The circle of an edge, seen from the side: on the outside below the axis, of a bore above it."""
    z = float(cut.drawn(corner.real))
    points = along(contour, 1e-5)
    after = np.roll(points, -1)
    near = points[np.abs(points.real - corner.real) < SAME]
    spans = np.minimum(points.real, after.real) < corner.real - SAME
    spans &= np.maximum(points.real, after.real) > corner.real + SAME
    share = (corner.real - points.real[spans]) / (after.real[spans] - points.real[spans])
    beside = points.imag[spans] + share * (after.imag[spans] - points.imag[spans])
    outside, inside = max(near.imag.max(), *beside, 0.0), min(near.imag.min(), *beside, math.inf)
    if corner.imag >= outside - SAME:
        view.line(LineKind.VISIBLE, np.array([complex(z, 0.0), complex(z, -corner.imag)]))
        if not bored:
            view.line(LineKind.VISIBLE, np.array([complex(z, 0.0), complex(z, corner.imag)]))
    if bored and corner.imag <= inside + SAME:
        view.line(LineKind.VISIBLE, np.array([complex(z, 0.0), complex(z, corner.imag)]))


def _lengths(  # noqa: PLR0917
    view: DrawnView, cut: Shortening, levels: list[float], low: complex, high: complex, features: ContourFeatures
) -> None:
    """Lengths of the steps from the left face."""
    shown = levels[1:] if features.fully else [high.real]
    drawn = [complex(float(cut.drawn(z)), low.imag - (high.imag + low.imag)) * view.scale for z in (low.real, *shown)]
    if len(shown) <= PARALLEL or not cut.whole:
        spans = [MeasuredLength(drawn[0], at, z - low.real) for at, z in zip(drawn[1:], shown, strict=True)]
        view.rows(spans, across=False)
    else:
        view.ordinates(drawn, drawn[0], across=False)


def _diameters(  # noqa: PLR0917
    view: DrawnView,
    cut: Shortening,
    features: ContourFeatures,
    contour: Contour,
    fits: Fits,
    squares: Sequence[float],
) -> None:
    """Each diameter once, at its longest stretch."""
    points = contour.points if features.fully else along(contour, 1e-4)
    after = np.roll(points, -1)
    level = (np.abs((after - points).imag) < SAME) & (points.imag > SAME)
    stretches = sorted(zip(points[level].tolist(), after[level].tolist(), strict=True), key=lambda s: -abs(s[1] - s[0]))
    radii = distinct([start.imag for start, _ in stretches])
    if len(radii) > MOST_DIAMETERS:
        radii = [radii[0], radii[-1]]
    labels: dict[tuple[float, bool, str, FeatureNote], list[Span]] = {}
    for start, end in stretches:
        radius = next((size for size in radii if abs(start.imag - size) < 2 * SAME), None)
        if radius is None:
            continue
        inner = start.real < end.real  # the profile runs counter-clockwise: bores to the right
        square = any(abs(radius - side) < SAME for side in squares)
        kind = FeatureKind.SQUARE if square else FeatureKind.BORE if inner else FeatureKind.JOURNAL
        own = (min(start.real, end.real), max(start.real, end.real))
        threads = fits.along(2 * radius, FeatureKind.THREAD if inner else FeatureKind.OUTER_THREAD)
        there = {
            note: [span for span in spans if own[0] - SAME < sum(span) / 2 < own[1] + SAME]
            for note, spans in (threads or fits.along(2 * radius, kind)).items()
        }
        sign = "□" if square else "M" if threads and any(there.values()) else "⌀"
        for note, spans in there.items() if any(there.values()) else [(NO_NOTE, [own])]:
            if spans:
                labels.setdefault((radius, inner, sign, note), []).extend(spans)
    for (radius, _, sign, _), spans in labels.items():
        if sign == "□":  # before any label, which keeps off lines
            _flats(view, cut, radius, spans[0])
    for (radius, _, sign, note), spans in sorted(labels.items(), key=lambda own: own[0][0]):
        if len(labels) == 1 and features.fully and note.is_bare:
            foot = float(cut.drawn(bounds(contour)[0].real))
            ends = complex(foot, -radius) * view.scale, complex(foot, radius) * view.scale
            view.rows([MeasuredLength(*ends, 2 * radius, "⌀", note.words)], across=True)
        else:
            low = None if radius == radii[-1] else bounds(contour)[0].real
            _diameter(view, cut, radius, spans, note, sign, low)


def _flats(view: DrawnView, cut: Shortening, half: float, span: Span) -> None:
    """Diagonals that mark the flats of a square length."""
    for corner in (-half * 1j, half * 1j):
        for piece in _stretch(cut, span[0] - corner, span[1] + corner, 1.2 / view.scale):
            view.line(LineKind.DIMENSION, piece, body=False)


def _diameter(  # noqa: PLR0917
    view: DrawnView,
    cut: Shortening,
    radius: float,
    spans: list[Span],
    note: FeatureNote,
    sign: str,
    datum: float | None,
) -> None:
    """A diameter, or width across flats, of equal stretches of the axis with what they must hold, at the first.

    datum  end of the part along the axis, from which a row of grooves is measured [m]; None: it is the lands
    """
    starts = distinct([span[0] for span in spans])
    count = len(starts)
    times = f"{count}× " if count > 1 and datum is not None else ""
    deep = round(spans[0][1] - spans[0][0], 9)
    own = thread_words(2 * radius, note.words, deep) if sign == "M" else f"{sign}{millimetres(2 * radius)}{note.words}"
    size = f"{times}{own}"
    if count > MOST_DIAMETERS and datum is not None:
        pitch = float(np.median(np.diff(starts)))
        wide = float(np.median(np.diff(spans)))
        size = Sentence(
            "sheet.grooves",
            size=size,
            wide=millimetres(wide),
            pitch=millimetres(pitch),
            first=millimetres(starts[0] + wide / 2 - datum),
            error=millimetres(groove_tolerance(pitch)),
        )
    first, last = cut.drawn(np.array(spans[0]))
    share = 0.5 if cut.whole else 0.8
    at = complex(first + share * (last - first), radius) * view.scale
    view.leader(
        size, at, 0.0,
        kind=DimensionKind.ALIGNED if sign == "□" else DimensionKind.DIAMETER, value=2 * radius, count=count,
        measured=(at.conjugate(), at), note=note,
    )  # fmt: skip


def bar_view(flat: FlatPart, length: float, scale: float, welds: Sequence[Weld] = ()) -> DrawnView:
    """A bar or tube of stock from the side, its length horizontal; hollows as hidden lines; welds at its ends."""
    view = DrawnView(scale)
    if flat.marked:
        view.datum_mark(1j * flat.datum.imag, {"Z": 1.0, "Y": 1j})
    low, high = bounds(flat.outline)
    cut = shortening([0.0, length], (high - low).imag)
    gap = 1.2 / scale
    visible = [low.imag, high.imag, *(y for y in edge_levels(flat) if low.imag + SAME < y < high.imag - SAME)]
    for y in distinct(visible):
        for piece in _stretch(cut, complex(0.0, y), complex(length, y), gap):
            view.line(LineKind.VISIBLE, piece)
    hollows = [bounds(hollow) for hollow in flat.cutouts]
    hollows += [(h.at - h.radius * 1j, h.at + h.radius * 1j) for h in flat.holes]
    for y in distinct([corner.imag for box in hollows for corner in box]):
        for piece in _stretch(cut, complex(0.0, y), complex(length, y), gap):
            view.line(LineKind.HIDDEN, piece)
    ends = cut.drawn(np.array([0.0, length]))
    for z in ends.tolist():
        view.line(LineKind.VISIBLE, np.array([complex(z, low.imag), complex(z, high.imag)]))
    middle = (low.imag + high.imag) / 2
    over = 3.0 / scale
    view.line(LineKind.CENTRE, np.array([complex(-over, middle), complex(ends[1] + over, middle)]), body=False)
    if not cut.whole:
        half = (high - low).imag / 2
        shifted = DrawnView(scale)
        _break_lines(shifted, cut, half)
        for line in shifted.picture.lines:
            view.line(LineKind.BREAK, line.points / scale + 1j * middle, body=False)
    feet = (complex(0.0, low.imag) * scale, complex(float(ends[1]), low.imag) * scale)
    spans = [MeasuredLength(*feet, length)]
    seats = [round(z, 4) for weld in welds for z in weld.box[:, 2].tolist() if SAME < z < length - SAME]
    seats = distinct(seats) if len(distinct(seats)) < MOST_SEATS else []
    spans += [MeasuredLength(feet[0], complex(float(cut.drawn(z)), low.imag) * scale, z) for z in seats]
    view.rows(spans, across=False)
    weld_symbols(view, welds, lambda weld: complex(float(cut.drawn(weld.middle[2])), high.imag) * scale)
    return view


def is_long(section: Profile, length: float) -> bool:
    """Whether a prism is drawn as a bar: longer than its section is wide."""
    low, high = bounds(section.outline)
    return length > max((high - low).real, (high - low).imag) * math.sqrt(2)
