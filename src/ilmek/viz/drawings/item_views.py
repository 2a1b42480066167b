"""Views of what stands as items: the lines that are seen; balloons, one for each item, on the view that shows it best.

An item that is seen from no side is dashed on the view with most room; one without a shape has no balloon.
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.part.visible_lines import DepthPicture, PlacedShape, Rotation, depth_picture, extents
from ilmek.records import record
from ilmek.report.sheet import LineKind, SheetLine
from ilmek.viz.drawings.balloons import Balloon, CrowdedViewError, balloons_about, crossings, rows_about, spots
from ilmek.viz.drawings.picture import Box
from ilmek.viz.drawings.projector import Axis

PIXEL = 0.12
"""Size of the pixels by which is found what is seen [mm of the paper]."""

_VISIBLE, _DEEP, _CROWDED = 0.25, 2.0, 1.0
"""Least distance of a tip from the rim of what is seen of its item, and that from which more is no better [mm]; what a
view that is full of balloons loses of its goodness."""

_TO_MM = 1e3


@record
class ItemView:
    """A view on the paper [mm]: the box about it, and the sides along which its balloons stand.

    shift   of the paper's origin          tips, inward   of each item the deepest point of what is seen, and how deep
    """

    rotation: Rotation
    scale: float
    shift: complex
    box: Box
    sides: tuple[str, ...]
    picture: DepthPicture
    tips: ComplexArray
    inward: FloatArray

    @property
    def capacity(self) -> int:
        """How many balloons stand about it."""
        return len(rows_about(self.box, self.sides)[0])

    def strokes(self, kind: LineKind, lines: Sequence[ComplexArray]) -> Iterator[SheetLine]:
        """Lines of the view [m] on the paper."""
        return (SheetLine(kind, line * (_TO_MM / self.scale) + self.shift) for line in lines)


def rotation_to(eye: Axis, right: Axis) -> Rotation:
    """From the axes of a tree to those of a view: right, up, towards the eye."""
    return np.array([right, np.cross(eye, right), eye])


def item_view(  # noqa: PLR0917
    pieces: Sequence[PlacedShape], rotation: Rotation, scale: float, middle: complex, count: int, sides: tuple[str, ...]
) -> ItemView:
    """A view of the shapes of so many items about a middle on the paper [mm]; scale: true length over that on it."""
    (low, high), per_metre = extents(pieces, rotation), _TO_MM / scale
    half = complex(*(high - low)[:2]) * per_metre / 2
    shift = middle - half - complex(*low[:2]) * per_metre
    picture = depth_picture(pieces, rotation, PIXEL / per_metre)
    tips, inward = spots(picture, count)
    first, last = middle - half, middle + half
    box = first.real, first.imag, last.real, last.imag
    return ItemView(rotation, scale, shift, box, sides, picture, tips * per_metre + shift, inward * per_metre)


def balloons_on(
    names: Sequence[str], views: Sequence[ItemView], pieces: Sequence[PlacedShape]
) -> tuple[tuple[Balloon, ...], tuple[SheetLine, ...]]:
    """A balloon for each item, and lines of those that no view shows. Raises CrowdedViewError."""
    first = {piece.item: piece for piece in reversed(pieces)}
    chosen = _views_of_items(views, len(names))
    balloons, dashed = list[Balloon](), list[SheetLine]()
    for number, view in enumerate(views):
        items = [item for item, own in enumerate(chosen) if own == number and item in first]
        tips = view.tips.copy()
        for item in items:
            if view.inward[item] < _VISIBLE:
                alone = depth_picture([first[item]], view.rotation, view.picture.pixel)
                dashed += view.strokes(LineKind.HIDDEN, alone.lines())
                point, _ = spots(alone, item + 1)
                tips[item] = point[item] * (_TO_MM / view.scale) + view.shift
        balloons += balloons_about([names[item] for item in items], tips[items], view.box, view.sides) if items else ()
    if crossings(np.array([own.tip for own in balloons]), np.array([own.centre for own in balloons])).any():
        raise CrowdedViewError("leaders of two views cross")
    return tuple(balloons), tuple(dashed)


def _views_of_items(views: Sequence[ItemView], count: int) -> list[int]:
    """The view of each item's balloon: those that few views show choose first."""
    inward = np.array([view.inward for view in views])
    capacity, load = np.array([view.capacity for view in views]), np.zeros(len(views))
    chosen = [0] * count
    for item in np.argsort((inward >= _VISIBLE).sum(0), kind="stable").tolist():
        good = np.where(inward[:, item] >= _VISIBLE, 1 + np.minimum(inward[:, item] / _DEEP, 1.0), 0.0)
        good = np.where(load < capacity, good - _CROWDED * load / capacity, -math.inf)
        chosen[item] = int(good.argmax())
        load[chosen[item]] += 1
    return chosen
