"""Views of a part cut from flat stock: its outline with all holes, and its edge."""

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.part.profile import Profile
from ilmek.part.tolerances import FeatureKind
from ilmek.plane.biarcs import as_contour
from ilmek.plane.contours import KeyedCircle, along, as_hole, as_keyed, bounds, keyed_bore
from ilmek.plane.vectors import following
from ilmek.records import record
from ilmek.report import Contour, Hole
from ilmek.report.sheet import DimensionKind, LineKind
from ilmek.sentences import Sentence
from ilmek.viz.drawings.details import DetailCircle, detail_view, details_for, mark_detail
from ilmek.viz.drawings.feature_note import FeatureNote
from ilmek.viz.drawings.features import (
    SAME,
    ArcFeature,
    ContourFeatures,
    HoleGroup,
    contour_features,
    distinct,
    hole_groups,
    split_holes,
    square_of,
)
from ilmek.viz.drawings.fits import Fits
from ilmek.viz.drawings.holes import NamedHole, draw_hole, mark_holes, thread_words
from ilmek.viz.drawings.keyways import keyway
from ilmek.viz.drawings.picture import SheetPicture, millimetres
from ilmek.viz.drawings.view import NO_NOTE, DrawnView, MeasuredLength, coordinate

NO_FITS = Fits()

TABLE_FROM, PARALLEL = 7, 4
"""Holes from which on they stand in a table; coordinates of one direction up to which each has its own row."""

_ARCS = 1e-6
"""Deviation of arcs from the points of a smooth outline, as a share of its size."""


@record
class FlatPart:
    """A section as it is drawn: outline, round holes, bores with keyways, other cutouts, the datum, points of lines to
    scribe, centres of the holes that only a table describes, and whether its datum is marked.
    """

    outline: Contour
    features: ContourFeatures
    round_outline: Hole | None
    groups: tuple[HoleGroup, ...]
    bores: tuple[KeyedCircle, ...]
    cutouts: tuple[Contour, ...]
    datum: complex
    smooth: bool
    scribed: tuple[complex, ...] = ()
    listed: tuple[complex, ...] = ()
    marked: bool = False

    @property
    def holes(self) -> tuple[Hole, ...]:
        """All round holes."""
        return tuple(hole for group in self.groups for hole in group.holes)

    @property
    def contours(self) -> tuple[Contour, ...]:
        """All its closed lines."""
        cuts = *self.cutouts, *(keyed_contour(bore) for bore in self.bores), *(_circle(hole) for hole in self.holes)
        return (self.outline, *cuts)

    @property
    def squares(self) -> tuple[tuple[complex, complex], ...]:
        """Its square bores, by centre and side."""
        squares = ((cut, square_of(cut)) for cut in self.cutouts)
        return tuple(own for cut, own in squares if own is not None and _corners_of(cut, self) == (own[0],))

    @property
    def small(self) -> Iterator[tuple[complex, float]]:
        """What may be too small on its paper: middle and width of holes, but those of a table, and of cutouts [m]."""
        shown = (group for group in self.groups if not self.has_row(group))
        yield from ((hole.at, 2 * hole.radius) for group in shown for hole in group.holes)
        for low, high in map(bounds, self.cutouts):
            yield (low + high) / 2, min((high - low).real, (high - low).imag)
        for start, end in self.edges:
            yield (start + end) / 2, abs(end - start)

    @property
    def edges(self) -> Iterator[tuple[complex, complex]]:
        """Ends of the pieces of an outline that is dimensioned by its corners [m]."""
        if self.dimensioned and self.round_outline is None and as_keyed(self.outline) is None:
            yield from zip(self.outline.points.tolist(), following(self.outline.points).tolist(), strict=True)

    @property
    def dimensioned(self) -> bool:
        """Whether its outline is dimensioned by corners and arcs."""
        return not self.smooth and self.features.fully

    def has_row(self, group: HoleGroup) -> bool:
        """Whether the holes of a group stand in a table."""
        if any(abs(group.holes[0].at - own) < SAME for own in self.listed):
            return True
        return not group.pitch and sum(len(own.holes) for own in self.groups if not own.pitch) >= TABLE_FROM


def flat_part(
    section: Profile,
    fits: Fits = NO_FITS,
    *,
    smooth: bool = False,
    scribed: tuple[complex, ...] = (),
    listed: tuple[complex, ...] = (),
) -> FlatPart:
    """The features of a section; a smooth outline is a curve, with no corners to dimension."""
    holes, cuts = split_holes(section.holes)
    bores = tuple(bore for bore in map(as_keyed, cuts) if bore is not None)
    others = tuple(cut for cut in cuts if as_keyed(cut) is None)
    outline = section.outline
    if section.smooth:
        low, high = bounds(outline)
        outline = as_contour(outline.points, _ARCS * abs(high - low))
    ring = as_hole(outline)
    centres = [*(hole.at for hole in holes), *(bore.centre for bore in bores), *([ring.at] if ring else [])]
    shaft = as_keyed(outline)
    centres += [shaft.centre] if shaft else []
    if square_of(outline) is None:  # else it is a tube
        centres += [square[0] for square in map(square_of, others) if square is not None]
    features = contour_features(outline)
    datum = _datum(features, bounds(outline)[0], centres, [*holes])
    curve = smooth or section.smooth
    groups = hole_groups(holes, lambda hole: (bore_note(fits, hole), any(abs(hole.at - own) < SAME for own in listed)))
    return FlatPart(outline, features, ring, groups, bores, others, datum, curve, scribed, listed)


def _datum(features: ContourFeatures, corner: complex, centres: list[complex], holes: list[Hole]) -> complex:
    """The origin where a bore is there, else the lower left corner if there is one, else the largest hole or an arc."""
    if any(abs(centre) < SAME for centre in centres):
        return 0j
    if any(abs(point - corner) < SAME for point in features.corners):
        return corner
    if holes:
        return max(holes, key=lambda hole: hole.radius).at
    return next(iter((*centres, *(arc.centre for arc in features.arcs))), corner)


def bore_note(fits: Fits, hole: Hole) -> FeatureNote:
    """What a round hole must hold, its words with the diameter, or the thread: `⌀12 H7 (+0.018/0)`, `M12 - 6H`."""
    size = millimetres(2 * hole.radius)
    thread = fits.note(2 * hole.radius, FeatureKind.THREAD, hole.at)
    if thread.words:
        return thread._replace(words=thread_words(2 * hole.radius, thread.words))
    fit = fits.note(2 * hole.radius, FeatureKind.BORE, hole.at)
    return fit._replace(words=f"⌀{size}{fit.words}")


def outline_view(
    flat: FlatPart,
    scale: float,
    fits: Fits = NO_FITS,
    *,
    paths: Mapping[str, ComplexArray | Contour] | None = None,
    marks: Mapping[str, ComplexArray] | None = None,
    circles: Mapping[str, float] | None = None,
    named: Sequence[NamedHole] = (),
) -> tuple[DrawnView, tuple[SheetPicture, ...]]:
    """The view on the outline with its dimensions, and its details.

    named    holes with names, seen from the front
    circles  about the origin to draw and to label: radii [m] by the keys of their words
    """
    view = DrawnView(scale)
    if flat.marked:
        view.datum_mark(flat.datum, {"X": 1.0, "Y": 1j})
    details = details_for([*flat.small], scale)
    _holes(view, flat, fits, named)
    shaft = as_keyed(flat.outline)
    for bore in (*flat.bores, *([shaft] if shaft else [])):
        view.cross(bore.centre, max(bore.floor, bore.radius))
    if flat.round_outline is not None:
        view.cross(flat.round_outline.at, flat.round_outline.radius)
    for line in (paths or {}).values():
        points = along(line, 1e-5) if isinstance(line, Contour) else line
        view.line(LineKind.PATH, np.append(points, points[:1]))
    for line in (marks or {}).values():
        view.line(LineKind.DIMENSION, line, body=False)
    for radius in (circles or {}).values():
        view.contour(LineKind.CENTRE, _circle(Hole(0j, radius)))
    _patterns(view, flat)
    _linear(view, flat)
    _labels(view, flat, fits, details)
    for name, radius in (circles or {}).items():
        _diameter(view, Sentence(name, size=millimetres(2 * radius)), 0j, radius)
    for detail in details:
        mark_detail(view, detail)
    mark_holes(view, [own for own in named if not any(detail.has(own.centre) for detail in details)])
    return view, tuple(_enlarged(detail, flat, fits, named).picture for detail in details)


def _holes(view: DrawnView, flat: FlatPart, fits: Fits, named: Sequence[NamedHole]) -> None:
    """The outline with all cutouts and holes."""
    for contour in flat.contours[: len(flat.contours) - len(flat.holes)]:
        view.contour(LineKind.VISIBLE, contour)
    for group in flat.groups:
        for hole in group.holes:
            draw_hole(view, hole.at, (2 * hole.radius,), threaded=bore_note(fits, hole).words.startswith("M"))
    for own in named:
        draw_hole(view, own.centre, own.diameters, threaded=own.threaded)


def _enlarged(detail: DetailCircle, flat: FlatPart, fits: Fits, named: Sequence[NamedHole]) -> DrawnView:
    """A detail with the labels of the holes and squares that are all in it."""
    view = detail_view(detail, flat.contours)
    for group in flat.groups:
        if all(detail.has(hole.at) for hole in group.holes):
            for hole in group.holes:
                view.cross(hole.at - detail.centre, hole.radius)
            _hole_label(view, flat, group, fits, detail.centre)
    for centre, side in flat.squares:
        if detail.has(centre):
            square(view, centre - detail.centre, side, fits)
    ends = [end for edge in flat.edges if all(map(detail.has, edge)) for end in edge]
    for across in (False, True) if ends else ():
        low = min(ends, key=lambda point: coordinate(point, across))
        values = distinct([coordinate(point - low, across) for point in ends])
        feet = [(_foot(ends, coordinate(low, across) + value, across) - detail.centre) * view.scale for value in values]
        spans = [MeasuredLength(feet[0], foot, value) for foot, value in zip(feet[1:], values[1:], strict=True)]
        view.rows(spans, across=across)
    mark_holes(view, [own for own in named if detail.has(own.centre)], detail.centre)
    return view


def keyed_contour(bore: KeyedCircle) -> Contour:
    """The contour of a bore with keyways, or of a shaft with its grooves."""
    own = keyed_bore(bore.radius, bore.width, bore.floor - bore.radius, len(bore.directions))
    turned = own.points * bore.directions[0] + bore.centre
    return Contour(turned, own.bulges)


def _circle(hole: Hole) -> Contour:
    return Contour(np.array([hole.at + hole.radius, hole.at - hole.radius]), np.ones(2))


def _coordinates(flat: FlatPart) -> tuple[complex, ...]:
    """Points whose coordinates a drawing needs: corners, centres of arcs and of holes that no table has."""
    by_circle = flat.round_outline is not None or as_keyed(flat.outline) is not None
    own = flat.features.points if flat.dimensioned and not by_circle else ()
    unlisted = [group for group in flat.groups if not flat.has_row(group)]
    holes = tuple(hole.at for group in unlisted if not group.pitch for hole in group.holes)
    centres = tuple(group.centre for group in unlisted if group.pitch)
    cuts = tuple(point for cut in flat.cutouts for point in _corners_of(cut, flat))
    return (*own, *holes, *centres, *(bore.centre for bore in flat.bores), *cuts, *flat.scribed)


def _corners_of(cut: Contour, flat: FlatPart) -> tuple[complex, ...]:
    """Points of a cutout to dimension: a square's middle; of a tube's hollow its lower left corner: the wall."""
    (low, high), (first, last) = bounds(cut), bounds(flat.outline)
    even = abs((first + last) - (low + high)) < SAME and abs((low - first).real - (low - first).imag) < SAME
    if even and flat.round_outline is None:
        return (low,)
    square = square_of(cut)
    return contour_features(cut).points if square is None else (square[0],)


def _linear(view: DrawnView, flat: FlatPart) -> None:
    """Distances from the datum, and the size over all."""
    points = _coordinates(flat)
    for across in (False, True):
        datum = coordinate(flat.datum, across)
        values = [value for value in distinct([coordinate(p, across) - datum for p in points]) if abs(value) > SAME]
        spans = _over_all(view, flat, values, across)
        feet = [_foot(points, datum + value, across) * view.scale for value in values]
        start = flat.datum * view.scale
        if len(values) <= PARALLEL:
            spans += [MeasuredLength(start, foot, abs(value)) for foot, value in zip(feet, values, strict=True)]
            view.rows(spans, across=across)
        else:
            view.ordinates([start, *feet], start, across=across)
            side = 0 if across else 1
            view.rows(spans, across=across, beyond=view.body[side] - view.picture.box[side] + 6.0)


def _over_all(view: DrawnView, flat: FlatPart, values: list[float], across: bool) -> list[MeasuredLength]:
    """The size over all, unless it stands there already, in brackets where arcs give it; of a curve also the distance
    of the datum from its end.
    """
    low, high = bounds(flat.outline)
    ends, datum = (coordinate(low, across), coordinate(high, across)), coordinate(flat.datum, across)
    size = ends[1] - ends[0]
    at_end = min(abs(end - datum) for end in ends) < SAME
    if flat.round_outline is not None or (at_end and any(abs(abs(value) - size) < SAME for value in values)):
        return []
    known = {round(datum, 8), *(round(datum + value, 8) for value in values)}
    auxiliary = flat.dimensioned and not all(round(end, 8) in known for end in ends)
    feet = [(complex(low.real, end) if across else complex(end, low.imag)) * view.scale for end in ends]
    whole = MeasuredLength(feet[0], feet[1], size, auxiliary=auxiliary)
    if flat.dimensioned or not ends[0] + SAME < datum < ends[1] - SAME or values:
        return [whole]
    return [MeasuredLength(feet[0], flat.datum * view.scale, datum - ends[0]), whole]


def _foot(points: Sequence[complex], value: float, across: bool) -> complex:
    """The point at a coordinate that lies nearest to the dimension line."""
    near = [point for point in points if abs(coordinate(point, across) - value) <= 2 * SAME]
    return min(near, key=lambda point: coordinate(point, not across))


def _patterns(view: DrawnView, flat: FlatPart) -> None:
    """Pitch circles of evenly spread holes."""
    for group in flat.groups:
        if group.pitch:
            view.contour(LineKind.CENTRE, _circle(Hole(group.centre, group.pitch)))


def _labels(view: DrawnView, flat: FlatPart, fits: Fits, details: Sequence[DetailCircle]) -> None:
    """Diameters of holes and bores, radii, widths of keyways; but what is all in a detail."""
    if flat.round_outline is not None:
        ring = flat.round_outline
        _diameter(view, f"⌀{millimetres(2 * ring.radius)}", ring.at, ring.radius)
    shaft = as_keyed(flat.outline)
    for bore in (*flat.bores, *([shaft] if shaft else [])):
        kind = FeatureKind.JOURNAL if bore is shaft else FeatureKind.BORE
        note = fits.note(2 * bore.radius, kind)
        _diameter(view, f"⌀{millimetres(2 * bore.radius)}{note.words}", bore.centre, bore.radius, note=note)
        keyway(view, bore, fits, kind)
    for group in flat.groups:
        if not any(all(detail.has(hole.at) for hole in group.holes) for detail in details):
            _hole_label(view, flat, group, fits)
    if flat.dimensioned and flat.round_outline is None and shaft is None:
        _radii(view, flat.features.arcs)
    for cut in flat.cutouts:
        _radii(view, contour_features(cut).arcs)
    for centre, side in flat.squares:
        if not any(detail.has(centre) for detail in details):
            square(view, centre, side, fits)


def _hole_label(view: DrawnView, flat: FlatPart, group: HoleGroup, fits: Fits, origin: complex = 0j) -> None:
    """The diameter of a group of holes, unless a table has it, in a view about an origin [m]."""
    if flat.has_row(group):
        return
    count = len(group.holes)
    hole = max(group.holes, key=lambda one: (one.at.real + one.at.imag, one.at.real))
    note = bore_note(fits, hole)
    words = f"{f'{count}× ' if count > 1 else ''}{note.words}"
    if group.pitch:
        words = Sentence("sheet.on-circle", holes=words, circle=millimetres(2 * group.pitch))
    _diameter(view, words, hole.at - origin, hole.radius, count, note)


def square(view: DrawnView, centre: complex, side: complex, fits: Fits) -> None:
    """Width across flats of a square bore, with its angle where it is turned; side  from corner to corner [m]."""
    size, angle = abs(side), math.degrees(float(np.angle(side))) % 90
    corner = centre + side * (1 + 1j) / 2
    ends = (corner * view.scale, (corner - side) * view.scale)
    view.cross(centre, size / 2)
    note = fits.note(size, FeatureKind.SQUARE_BORE)
    words = f"□{millimetres(size)}{note.words}"
    if 1e-6 < angle < 90 - 1e-6:
        words = Sentence("sheet.square-turned", size=words, angle=f"{angle:.4g}°")
    view.leader(words, ends[0], 0.0, kind=DimensionKind.ALIGNED, value=size, measured=ends, note=note)


def _diameter(  # noqa: PLR0917
    view: DrawnView, words: str, centre: complex, radius: float, count: int = 1, note: FeatureNote = NO_NOTE
) -> None:
    at, reach = centre * view.scale, radius * view.scale
    view.leader(words, at, reach, kind=DimensionKind.DIAMETER, value=2 * radius, count=count, note=note)


def _radii(view: DrawnView, arcs: tuple[ArcFeature, ...]) -> None:
    """Each radius once, with the number of its arcs."""
    for radius in distinct([arc.radius for arc in arcs]):
        equal = [arc for arc in arcs if abs(arc.radius - radius) < 2 * SAME]
        arc = max(equal, key=lambda one: one.centre.real + one.centre.imag)
        words = f"{f'{len(equal)}× ' if len(equal) > 1 else ''}R{millimetres(radius)}"
        ends = (arc.ends[0] * view.scale, arc.ends[1] * view.scale)
        view.leader(
            words, arc.centre * view.scale, radius * view.scale, kind=DimensionKind.RADIUS, value=radius,
            count=len(equal), sector=ends,
        )  # fmt: skip
