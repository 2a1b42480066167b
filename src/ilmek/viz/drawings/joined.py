"""Views of parts of several shapes by hidden-line removal of the solid: from the front, the left, and above.

Each member's ends are dimensioned from the datum, the lower left corner of each view; members themselves stand in the
cut list, by section and length.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.part.placement import IDENTITY, Placement
from ilmek.part.shapes import Prism, Sum, Turned
from ilmek.part.tolerances import FeatureKind
from ilmek.part.twisted import TwistedBar
from ilmek.plane.contours import KeyedCircle, along, as_hole, as_keyed, bounds
from ilmek.report.sheet import DimensionKind, LineKind
from ilmek.sentences import Sentence
from ilmek.viz.drawings.face_notes import Z, face_notes
from ilmek.viz.drawings.features import SAME, distinct, split_holes
from ilmek.viz.drawings.fits import Fits
from ilmek.viz.drawings.flat import PARALLEL, square
from ilmek.viz.drawings.keyways import keyway
from ilmek.viz.drawings.paper import table
from ilmek.viz.drawings.picture import SheetPicture, millimetres
from ilmek.viz.drawings.projector import Axis, Projector
from ilmek.viz.drawings.view import NO_NOTE, DrawnView, MeasuredLength, coordinate

VIEWS: dict[str, tuple[Axis, Axis]] = {
    "front": ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)),
    "right": ((-1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "below": ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0)),
}
"""Direction to the eye, and to the right on the paper."""

MOST_ENDS, MOST_LABELS = 14, 6
"""Ends of members that a view dimensions in a direction; more of them stand in the cut list alone."""

MOST_MEMBERS = 16
"""Members of which each has its row with its position."""

PIECES = tuple(map(Sentence, ("sheet.item", "sheet.pieces", "sheet.section", "sheet.length")))

Member = tuple[object, Placement]


def joined_views(
    shape: object, scale: float, project: Projector, fits: Fits
) -> tuple[dict[str, DrawnView], tuple[SheetPicture, ...]]:
    """The three views of a shape, a pictorial one, and the list of its members."""
    members = tuple(members_of(shape))
    views = {}
    for name, (eye, right) in VIEWS.items():
        view = DrawnView(scale)
        visible, hidden = project(shape, eye, right)
        for line in hidden:
            view.line(LineKind.HIDDEN, line)
        for line in visible:
            view.line(LineKind.VISIBLE, line)
        across, upwards, towards = np.array(right), np.cross(eye, right), np.array(eye)
        if name == "front":
            _dimension(view, members, across, upwards, towards)
            _circles(view, members, (across, upwards, towards), fits)
            _squares(view, (across, upwards), _seen(fits, towards))
            face_notes(view, fits, across, upwards)
        else:
            centres = _fitted(view, (across, upwards, towards), fits)
            _lengths(view, members, (across, upwards), centres, whole=name == "right")
        if name == "right":  # faces that the front view shows from before
            face_notes(view, _seen(fits, Z), across, upwards)
        views[name] = view
    pictorial = DrawnView(scale)
    corner = 1 / math.sqrt(3)
    visible, _ = project(shape, (corner, corner, corner), (math.sqrt(0.5), 0.0, -math.sqrt(0.5)))
    for line in visible:
        pictorial.line(LineKind.VISIBLE, line)
    views["corner"] = pictorial
    twisted = [shape for shape, _ in members if isinstance(shape, TwistedBar)]
    for bar in dict.fromkeys(twisted):
        foot, side = bar.side / 2 * (1 + 1j) * scale, bar.side * scale
        views["front"].leader(
            f"□{millimetres(bar.side)}", foot, 0.0, kind=DimensionKind.ALIGNED, value=bar.side,
            measured=(foot, foot - side),
        )  # fmt: skip
    return views, (_cut_list(members), *map(_twist_table, dict.fromkeys(twisted)))


def _twist_table(bar: TwistedBar) -> SheetPicture:
    """The lengths of a twisted bar, with the angle, the lead and the hand of each."""
    rows = []
    for (start, end), (first, last) in zip(pairwise(bar.stations), pairwise(bar.angles), strict=True):
        turn = last - first
        angle, lead = (
            f"{math.degrees(abs(turn)):.4g}°",
            millimetres((end - start) * 2 * math.pi / abs(turn or math.inf)),
        )
        hand = Sentence("sheet.twist-right" if turn > 0 else "sheet.twist-left") if turn else "—"
        rows.append((millimetres(start), millimetres(end), angle, lead if turn else "—", hand))
    names = ("twist-from", "twist-to", "bend-angle", "twist-lead", "twist-hand")
    return table([Sentence(f"sheet.{name}") for name in names], rows, Sentence("sheet.twist"))


def members_of(shape: object, position: Placement = IDENTITY) -> Iterator[Member]:
    """Prisms and turned shapes of a sum, each at its position."""
    if isinstance(shape, Sum):
        for member in shape.members:
            for own in member.positions:
                yield from members_of(member.shape, position.after(own))
    else:
        yield shape, position


def reach(member: Member, direction: FloatArray) -> tuple[float, float]:
    """Least and greatest coordinate of a member along a direction [m]."""
    shape, position = member
    own = position.rotation.T @ direction
    base = float(position.origin @ direction)
    if isinstance(shape, Prism):
        contour = shape.section.outline
        if abs(own[0]) > 1 - 1e-12 or abs(own[1]) > 1 - 1e-12 or abs(own[2]) > 1 - 1e-12:
            low, high = bounds(contour)
            ends = np.array([[low.real, low.imag], [high.real, high.imag]]) @ own[:2]
        else:
            points = along(contour, 1e-7)
            ends = np.array([points.real, points.imag]).T @ own[:2]
        lengths = [0.0, shape.length * float(own[2])]
        return base + float(ends.min()) + min(lengths), base + float(ends.max()) + max(lengths)
    if isinstance(shape, Turned):
        points, across = along(shape.profile.outline, 1e-7), math.sqrt(max(0.0, 1 - float(own[2]) ** 2))
        far = points.real * own[2]
        return base + float((far - across * points.imag).min()), base + float((far + across * points.imag).max())
    points_3d = shape.mesh().points @ own  # type: ignore[attr-defined]
    return base + float(points_3d.min()), base + float(points_3d.max())


def _dimension(
    view: DrawnView, members: tuple[Member, ...], right: FloatArray, up: FloatArray, eye: FloatArray
) -> None:
    """Ends of the members from the datum; of one that is seen as a circle its centre."""
    corners: dict[bool, list[tuple[float, complex]]] = {False: [], True: []}
    for member in members:
        x, y = reach(member, right), reach(member, up)
        if _seen_round(member, eye):
            x, y = (sum(x) / 2,) * 2, (sum(y) / 2,) * 2
        corners[False] += [(end, complex(end, y[0])) for end in x]
        corners[True] += [(end, complex(x[0], end)) for end in y]
        for hole in _holes_seen(member, eye):
            at = complex(float(hole @ right), float(hole @ up))
            corners[False].append((at.real, at))
            corners[True].append((at.imag, at))
    for across, ends in corners.items():
        values = distinct([value for value, _ in ends])
        if len(values) > MOST_ENDS:
            values = [values[0], values[-1]]
        feet = [
            min((p for v, p in ends if abs(v - value) <= 2 * SAME), key=lambda p: coordinate(p, not across))
            for value in values
        ]
        drawn = [foot * view.scale for foot in feet]
        whole = _over_all(view, members, (up, right) if across else (right, up), values, across=across)
        if len(values) <= PARALLEL + 1:
            spans = [
                MeasuredLength(drawn[0], foot, value - values[0])
                for foot, value in zip(drawn[1:], values[1:], strict=True)
            ]
            view.rows([*spans, *whole], across=across)
        else:
            view.ordinates(drawn, drawn[0], across=across)
            side = 0 if across else 1
            view.rows(whole, across=across, beyond=view.body[side] - view.picture.box[side] + 6.0)


def _over_all(
    view: DrawnView,
    members: tuple[Member, ...],
    axes: tuple[FloatArray, FloatArray],
    values: list[float],
    *,
    across: bool,
) -> list[MeasuredLength]:
    """The size over all in brackets, where the ends of the members, some of them centres, do not give it; axes  along
    it, and across it.
    """
    reaches = [reach(member, axes[0]) for member in members]
    low, high = min(ends[0] for ends in reaches), max(ends[1] for ends in reaches)
    if high - low <= values[-1] - values[0] + 2 * SAME:
        return []
    foot = min(reach(member, axes[1])[0] for member in members)
    ends = (complex(foot, end) if across else complex(end, foot) for end in (low, high))
    first, last = (end * view.scale for end in ends)
    return [MeasuredLength(first, last, high - low, auxiliary=True)]


def _seen_round(member: Member, eye: FloatArray) -> bool:
    """Whether a member is seen as a circle."""
    shape, position = member
    if abs(float(position.rotation[:, 2] @ eye)) < 1 - 1e-9:
        return False
    return isinstance(shape, Turned) or (isinstance(shape, Prism) and as_hole(shape.section.outline) is not None)


def _holes_seen(member: Member, eye: FloatArray) -> Iterator[FloatArray]:
    """Centres of the round holes of a prism whose axis points to the eye [m]."""
    shape, position = member
    if isinstance(shape, Prism) and abs(float(position.rotation[:, 2] @ eye)) > 1 - 1e-9:
        holes, _ = split_holes(shape.section.holes)
        yield from (position.points(np.array([hole.at.real, hole.at.imag, 0.0])) for hole in holes)


def _fitted(view: DrawnView, axes: tuple[FloatArray, FloatArray, FloatArray], fits: Fits) -> list[complex]:
    """Labels of the fitted diameters that are seen as circles in a view beside the front one; their centres [m]."""
    right, up, eye = axes
    seen = _seen(fits, eye)
    sizes: dict[tuple[float, FeatureKind], list[complex]] = {}
    for feature in seen.features:
        if feature.kind in {FeatureKind.BORE, FeatureKind.JOURNAL}:
            centre = complex(float(feature.position.origin @ right), float(feature.position.origin @ up))
            centres = sizes.setdefault((feature.nominal, feature.kind), [])
            if all(abs(centre - other) > SAME for other in centres):
                centres.append(centre)
    _squares(view, (right, up), seen)
    for (size, kind), centres in sizes.items():
        note, times = seen.note(size, kind), f"{len(centres)}× " if len(centres) > 1 else ""
        for each in centres:
            view.cross(each, size / 2)
        view.leader(
            f"{times}⌀{millimetres(size)}{note.words}",
            max(centres, key=lambda c: c.real + c.imag) * view.scale,
            size / 2 * view.scale,
            kind=DimensionKind.DIAMETER,
            value=size,
            count=len(centres),
            note=note,
        )
    return [centre for centres in sizes.values() for centre in centres]


def _seen(fits: Fits, eye: FloatArray) -> Fits:
    """The features whose axis points to the eye."""
    facing = (feature for feature in fits.features if abs(feature.position.rotation[:, 2] @ eye) > 1 - 1e-9)
    return replace(fits, features=tuple(facing))


def _squares(view: DrawnView, axes: tuple[FloatArray, FloatArray], seen: Fits) -> None:
    """Labels of the fitted square bores that a view shows as squares, those on one axis once; axes  right and up."""
    labelled: dict[complex, complex] = {}
    for feature in seen.features:
        if feature.kind is FeatureKind.SQUARE_BORE:
            centre, side = (
                complex(*(round(float(own @ axis), 9) for axis in axes))
                for own in (feature.position.origin, feature.nominal * feature.position.rotation[:, 0])
            )
            labelled.setdefault(centre, side)
    for centre, side in labelled.items():
        square(view, centre, side, seen)


def _lengths(
    view: DrawnView,
    members: tuple[Member, ...],
    axes: tuple[FloatArray, FloatArray],
    centres: list[complex],
    *,
    whole: bool,
) -> None:
    """Where centres are from the lower left corner of a view beside the front one; whole  the ends of members too."""
    low, bottom = (min(reach(member, axis)[0] for member in members) for axis in axes)
    if centres:
        foot = complex(low, bottom) * view.scale
        heights = [value for value in distinct([centre.imag for centre in centres]) if value - bottom > SAME]
        up = [MeasuredLength(foot, complex(low, value) * view.scale, value - bottom) for value in heights]
        view.rows(up, across=True)
    ends = [end for member in members for end in reach(member, axes[0])] if whole else []
    values = distinct([*ends, *([low] if centres else []), *(centre.real for centre in centres)])
    values = values if len(values) <= MOST_ENDS else [values[0], values[-1]]
    drawn = [complex(value, bottom) * view.scale for value in values]
    if len(values) <= PARALLEL + 1:
        spans = [
            MeasuredLength(drawn[0], foot, value - values[0]) for foot, value in zip(drawn[1:], values[1:], strict=True)
        ]
        view.rows(spans, across=False)
    else:
        view.ordinates(drawn, drawn[0], across=False)


def _circles(
    view: DrawnView, members: tuple[Member, ...], axes: tuple[FloatArray, FloatArray, FloatArray], fits: Fits
) -> None:
    """Labels of the diameters whose axis points to the eye, each size once; axes  right, up, and to the eye."""
    right, up, eye = axes
    sizes: dict[float, list[complex]] = {}
    for shape, position in members:
        if abs(float(position.rotation[:, 2] @ eye)) < 1 - 1e-9:
            continue
        rings: list[tuple[complex, float]] = []
        if isinstance(shape, Turned):
            points = shape.profile.outline.points
            rings = [(0j, radius) for radius in distinct([abs(z) for z in points.imag.tolist()]) if radius > SAME]
        elif isinstance(shape, Prism):
            holes = [as_hole(contour) for contour in (shape.section.outline, *shape.section.holes)]
            rings = [(hole.at, hole.radius) for hole in holes if hole is not None]
            shaft = as_keyed(shape.section.outline)
            if shaft is not None:
                rings.append((shaft.centre, shaft.radius))
                keyway(view, _seen_keyed(shaft, position, right, up), fits, FeatureKind.JOURNAL)
            for bore in filter(None, map(as_keyed, shape.section.holes)):
                rings.append((bore.centre, bore.radius))
                keyway(view, _seen_keyed(bore, position, right, up), fits, FeatureKind.BORE)
        for centre, radius in rings:
            at = position.points(np.array([centre.real, centre.imag, 0.0]))
            sizes.setdefault(round(radius, 8), []).append(complex(float(at @ right), float(at @ up)))
    for radius, centres in sorted(sizes.items(), reverse=True)[:MOST_LABELS]:
        different = list(dict.fromkeys(complex(round(c.real, 7), round(c.imag, 7)) for c in centres))
        times = f"{len(different)}× " if len(different) > 1 else ""
        centre = max(different, key=lambda c: c.real + c.imag)
        for each in different:
            view.cross(each, radius)
        notes = (fits.note(2 * radius, kind) for kind in (FeatureKind.BORE, FeatureKind.JOURNAL))
        note = next((one for one in notes if one.words), NO_NOTE)
        view.leader(
            f"{times}⌀{millimetres(2 * radius)}{note.words}", centre * view.scale, radius * view.scale,
            kind=DimensionKind.DIAMETER, value=2 * radius, count=len(different), note=note,
        )  # fmt: skip


def _seen_keyed(bore: KeyedCircle, position: Placement, right: FloatArray, up: FloatArray) -> KeyedCircle:
    """A bore with keyways as a view shows it."""

    def seen(point: complex, origin: FloatArray | float) -> complex:
        own = position.rotation @ np.array([point.real, point.imag, 0.0]) + origin
        return complex(float(own @ right), float(own @ up))

    directions = tuple(seen(own, 0.0) for own in bore.directions)
    return bore._replace(centre=seen(bore.centre, position.origin), directions=directions)


def members_by_section(members: tuple[Member, ...]) -> dict[tuple[str, str], list[Member]]:
    """Members by section and length in words: the items of the cut list, in their order."""
    kinds: dict[tuple[str, str], list[Member]] = {}
    for member in members:
        kinds.setdefault(_section(member[0]), []).append(member)
    return kinds


def _cut_list(members: tuple[Member, ...]) -> SheetPicture:
    """Members by section and length, each with where it lies from the lower left rear corner; of many those of one kind
    as a row.
    """
    kinds = members_by_section(members)
    if len(members) > MOST_MEMBERS:
        rows = [(str(k), str(len(own)), *words) for k, (words, own) in enumerate(kinds.items(), 1)]
        return table(PIECES, rows[:30], Sentence("sheet.members"))
    axes = np.eye(3)
    low = [min(reach(member, axis)[0] for member in members) for axis in axes]
    placed = [
        (
            str(k),
            "1",
            *words,
            *(span_words(*(np.array(reach(member, axis)) - least)) for axis, least in zip(axes, low, strict=True)),
        )
        for k, (words, own) in enumerate(kinds.items(), 1)
        for member in own
    ]
    return table((*PIECES, "X", "Y", "Z"), placed, Sentence("sheet.members-placed"))


def span_words(low: float, high: float) -> str:
    """From where to where [mm], to 0.001 mm: `15…39`, or one value."""
    return "…".join(dict.fromkeys(millimetres(value + 0.0) for value in (low, high)))


def _section(shape: object) -> tuple[str, str]:
    if isinstance(shape, Turned):
        low, high = bounds(shape.profile.outline)
        bore = f", bore ⌀{millimetres(2 * low.imag)}" if low.imag > SAME else ""
        return f"round ⌀{millimetres(2 * high.imag)}{bore}", millimetres(high.real - low.real)
    if isinstance(shape, TwistedBar):
        return f"□{millimetres(shape.side)}", millimetres(shape.length)
    assert isinstance(shape, Prism)
    return _outline(shape), millimetres(shape.length)


def _outline(shape: Prism) -> str:
    low, high = bounds(shape.section.outline)
    ring = as_hole(shape.section.outline)
    size = high - low
    words = f"⌀{millimetres(2 * ring.radius)}" if ring else f"{millimetres(size.real)} × {millimetres(size.imag)}"
    holes = [as_hole(hole) for hole in shape.section.holes]
    bores = ", ".join(f"bore ⌀{millimetres(2 * hole.radius)}" for hole in holes if hole is not None)
    return f"{words}, {bores}" if bores else words
