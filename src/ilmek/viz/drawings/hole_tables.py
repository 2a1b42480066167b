"""The table of a part's round holes from one datum, and views of the faces in which they have their mouths.

Holes have numbers, H1, H2 and so on, alike ones in a row: letters are of datums. What is seen from the front has its
name in the front view; of each other direction stands a view along it.
"""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, product
from string import ascii_lowercase

import numpy as np

from ilmek.arrays import Float
from ilmek.part.features import drillings, round_holes
from ilmek.part.hole_kinds import HoleKinds
from ilmek.part.shapes import Drilling, Prism, Shape, shape_box
from ilmek.part.tolerances import FeatureKind
from ilmek.report import Contour
from ilmek.report.sheet import LineKind, SheetText
from ilmek.sentences import Sentence
from ilmek.viz.drawings.edge import levels_seen
from ilmek.viz.drawings.face_notes import FRONT, Direction, X, Y, Z
from ilmek.viz.drawings.feature_note import FeatureNote
from ilmek.viz.drawings.features import SAME, distinct
from ilmek.viz.drawings.fits import Fits
from ilmek.viz.drawings.flat import FlatPart
from ilmek.viz.drawings.holes import NamedHole, draw_hole, hole_words
from ilmek.viz.drawings.paper import SCALES, scale_words, table
from ilmek.viz.drawings.picture import SheetPicture, millimetres
from ilmek.viz.drawings.projector import Projector
from ilmek.viz.drawings.view import NO_NOTE, DrawnView

MOST_ROWS = 30
"""Rows of a table of holes; more stand beside it."""

_LONG, _LONGER, _MANY = 120.0, 250.0, 3
"""Greatest extent of a view of a face [mm], and that of one with more than so many holes."""


def listed_centres(shape: Prism, kinds: HoleKinds | None) -> tuple[complex, ...]:
    """Centres of the holes of a section that only the table describes: with counterbores, and not in all pieces."""
    holes = round_holes(shape)
    some = [kinds is not None and len(kinds.holes[number]) < len(kinds.pieces) for number in range(len(holes))]
    return tuple(
        complex(*hole.position.origin[:2])
        for hole, limited in zip(holes, some, strict=True)
        if _is_along(hole) and hole.through and (len(hole.steps) > 1 or limited)
    )


def _is_along(hole: Drilling) -> bool:
    return bool(abs(hole.position.rotation[2, 2]) > 1 - SAME)


def named_holes(shape: Shape, flat: FlatPart | None, fits: Fits, kinds: HoleKinds | None) -> tuple[NamedHole, ...]:
    """The holes of a part that its table has: all that are drilled, and those of its section that have a row."""
    rows = () if flat is None else tuple(own.at for group in flat.groups if flat.has_row(group) for own in group.holes)
    drilled = len(drillings(shape))
    alike: dict[tuple[object, ...], list[NamedHole]] = defaultdict(list)
    for number, hole in enumerate(round_holes(shape)):
        at = complex(*hole.position.origin[:2])
        if number >= drilled and not any(abs(own - at) < SAME for own in rows):
            continue
        has = () if kinds is None or len(kinds.holes[number]) == len(kinds.pieces) else kinds.holes[number]
        threaded, note = _note(hole, fits)
        words = hole_words(hole, note, threaded=threaded)
        own = NamedHole(0, hole, words, note, " ".join(ascii_lowercase[kind] for kind in has), threaded)
        alike[not own.is_in_front, tuple(np.round(own.into, 3) + 0.0), words, note, own.kinds].append(own)
    groups = (sorted(group, key=_order) for _, group in sorted(alike.items(), key=lambda each: str(each[0])))
    return tuple(replace(own, number=number) for number, own in enumerate(chain.from_iterable(groups), 1))


def _order(own: NamedHole) -> tuple[float, ...]:
    x, y, z = own.hole.position.origin.round(6).tolist()
    return z, y, x


def _note(hole: Drilling, fits: Fits) -> tuple[bool, FeatureNote]:
    """Whether the last step of a hole is a thread, and what the hole must hold."""
    size, lies = hole.steps[-1][0], hole.position
    for kind in (FeatureKind.THREAD, FeatureKind.BORE):
        there = [
            feature
            for feature in fits.features
            if feature.kind is kind and abs(feature.nominal - size) < 2 * SAME
            if np.linalg.norm(np.cross(feature.position.origin - lies.origin, lies.rotation[:, 2])) < 2 * SAME
        ]
        if there:
            return kind is FeatureKind.THREAD, fits.joined(there)
    return False, NO_NOTE


def hole_tables(
    named: Sequence[NamedHole], datum: Float[np.ndarray, " 3"], kinds: HoleKinds | None
) -> Iterator[SheetPicture]:
    """Mouth from the datum, direction into the part, and sizes of each hole [mm], to 0.01 mm, with a fit to 0.001."""
    heads: tuple[str, ...] = (
        Sentence("sheet.hole"),
        "X",
        "Y",
        "Z",
        Sentence("sheet.direction"),
        Sentence("sheet.dimension"),
    )
    title, own = Sentence("sheet.holes"), kinds if any(hole.kinds for hole in named) else None
    if own is not None:
        each = ", ".join(f"{name} {number}×" for name, number in zip(ascii_lowercase, own.pieces, strict=False))
        title, heads = Sentence("sheet.holes-of-kinds", kinds=each), (*heads, Sentence("sheet.kinds"))
    rows = []
    for hole in named:
        fine = 6 if hole.note.frames else 5
        at = (millimetres(round(value, fine)) for value in (hole.hole.position.origin - datum).tolist())
        row = hole.tag, *at, _direction(hole.into), hole.words
        rows.append(row if own is None else (*row, hole.kinds or Sentence("sheet.all-pieces")))
    for begin in range(0, len(rows), MOST_ROWS):
        yield table(heads, rows[begin : begin + MOST_ROWS], title)


def _direction(into: Direction) -> str:
    """An axis with its sense, or the components.

    >>> _direction(np.array([0.0, 0.0, -1.0]))
    '−Z'
    """
    axis = int(np.abs(into).argmax())
    if abs(into[axis]) > 1 - SAME:
        return f"{'+' if into[axis] > 0 else '−'}{'XYZ'[axis]}"
    return " ".join(f"{value:.4f}" for value in into)


def face_views(
    shape: Shape, flat: FlatPart | Projector, named: Sequence[NamedHole], datum: Float[np.ndarray, " 3"]
) -> Iterator[SheetPicture]:
    """A view along each direction of holes, with their names, and the axes from the datum.

    flat  the section of a prism, or what projects another shape
    """
    sides: dict[tuple[float, ...], list[NamedHole]] = defaultdict(list)
    for own in named:
        sides[tuple(np.round(own.into, 3) + 0.0)].append(own)
    for into, holes in sides.items():
        yield _face_view(shape, flat, (np.array(into), holes), datum)


def _face_view(
    shape: Shape,
    flat: FlatPart | Projector,
    side: tuple[Direction, Sequence[NamedHole]],
    datum: Float[np.ndarray, " 3"],
) -> SheetPicture:
    into, holes = side
    low, high = shape_box(shape)
    right, up = _axes(into, high - low)
    corners = np.array(list(product(*np.stack([low, high], axis=1))))
    across, upwards = corners @ right, corners @ up
    extent = max(np.ptp(across), np.ptp(upwards)) * 1e3
    most = _LONG if len(holes) <= _MANY else _LONGER
    drawn = next(own for own in SCALES if extent / own <= most)
    view = DrawnView(1e3 / drawn)

    def seen(point: Direction) -> complex:
        return complex(float(point @ right), float(point @ up))

    if isinstance(flat, FlatPart):
        _prism_lines(view, flat, (into, right, up), (low, high))
    else:
        visible, _ = flat(shape, tuple((-into).tolist()), tuple(right.tolist()))
        for line in visible:
            view.line(LineKind.VISIBLE, line)
    for own in holes:
        draw_hole(view, seen(own.hole.position.origin), own.diameters, threaded=own.threaded)
    names = {name: seen(axis) for name, axis in zip("XYZ", (X, Y, Z), strict=True)}
    view.datum_mark(seen(datum), {name: turn for name, turn in names.items() if abs(turn) > 0.5})
    for own in holes:
        view.tag(own.tag, seen(own.hole.position.origin) * view.scale, own.radius * view.scale)
    top = complex(view.body[0], view.picture.box[3] + 3.0)
    view.text(
        SheetText(top, Sentence("sheet.seen-along", axis=_direction(into), scale=scale_words(drawn)), 2.5, bold=True)
    )
    return view.picture


def _prism_lines(
    view: DrawnView,
    flat: FlatPart,
    axes: tuple[Direction, Direction, Direction],
    ends: tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 3"]],
) -> None:
    """A prism seen along its axis, or across; axes  into the paper, right, upwards; ends  least and greatest corner."""
    into, right, up = axes
    if abs(into[2]) > 1 - SAME:
        for contour in (flat.outline, *flat.cutouts):
            mirrored = Contour(-contour.points.conj(), -contour.bulges)
            view.contour(LineKind.VISIBLE, mirrored if right[0] < 0 else contour)
        return
    corners = np.array(list(product(*np.stack(ends, axis=1))))
    across, upwards = corners @ right, corners @ up
    view.contour(
        LineKind.VISIBLE,
        _rectangle(complex(across.min(), upwards.min()), complex(across.max(), upwards.max())),
    )
    level = right if abs(right[2]) < SAME else up
    for value in distinct(list(levels_seen(flat, -complex(*into[:2]), complex(*level[:2])))):
        line = np.array([value * level + end[2] * Z for end in ends])
        view.line(LineKind.VISIBLE, line @ right + 1j * (line @ up))


def _axes(into: Direction, size: Float[np.ndarray, " 3"]) -> tuple[Direction, Direction]:
    """Directions to the right and upwards on the paper of a view along a direction."""
    if abs(into[2]) > 1 - SAME:
        return FRONT if into[2] < 0 else (-X, Y)
    longest = max((axis for axis in (X, Y, Z) if abs(float(axis @ into)) < 0.5), key=lambda axis: float(size @ axis))
    right = longest - (longest @ into) * into
    right = right / np.linalg.norm(right)
    return right, np.cross(-into, right)


def _rectangle(low: complex, high: complex) -> Contour:
    points = np.array([low, complex(high.real, low.imag), high, complex(low.real, high.imag)])
    return Contour(points, np.zeros(4))
