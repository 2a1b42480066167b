"""Balloons: item numbers in circles in rows about a view, each with a straight leader to its item; ISO 6433.

Of all choices of balloons for tips that of the least sum of lengths has no two leaders that cross: two that did could
be exchanged for shorter ones. Leaders flatter than `STEEP` are put off, lest they run through neighbours.
"""

import math
from collections.abc import Sequence

import numpy as np
from scipy.ndimage import distance_transform_edt, find_objects
from scipy.optimize import linear_sum_assignment

from ilmek.arrays import BoolArray, ComplexArray, FloatArray
from ilmek.part.visible_lines import DepthPicture
from ilmek.records import record
from ilmek.report.sheet import LineKind, SheetLine, SheetText
from ilmek.viz.drawings.picture import Box, SheetPicture

RADIUS, PITCH, AWAY, LETTER = 5.0, 12.0, 14.0, 3.5
"""Radius of a balloon, distance of two, distance of their centres from the view, height of letters [mm]."""

ROOM = AWAY + RADIUS + 1.0
"""Room that a row of balloons takes beside a view [mm]."""

STEEP = math.radians(30)
"""Least angle of a leader to the row of its balloon [rad]."""

_FLAT, _DOT, _CLEAR, _FINEST = 1e4, 0.3, 0.4, 300
"""Cost of a flat leader, radius of the dot at its end, least distance from other balloons [mm]; pixels across a region
that are looked at.
"""

SIDES = {"left": (-1.0, 1j), "right": (1.0, 1j), "top": (1j, 1.0), "bottom": (-1j, 1.0)}
"""Direction out of a view, and along its side."""


class CrowdedViewError(ValueError):
    """A view has no room for its balloons."""


@record
class Balloon:
    """An item's number in a circle; a leader from it to a point of the item."""

    name: str
    centre: complex
    tip: complex

    @property
    def picture(self) -> SheetPicture:
        """Circle, leader with its dot, and number."""
        rim = self.centre + RADIUS * (self.tip - self.centre) / abs(self.tip - self.centre)
        lines = (
            _circle(LineKind.LEADER, self.centre, RADIUS),
            SheetLine(LineKind.LEADER, np.array([rim, self.tip])),
            _circle(LineKind.VISIBLE, self.tip, _DOT),
        )
        return SheetPicture(lines, (SheetText(self.centre - 0.5j * LETTER, self.name, LETTER, "center"),), ())


def _circle(kind: LineKind, centre: complex, radius: float) -> SheetLine:
    return SheetLine(kind, np.array([centre + radius, centre - radius]), np.ones(2), closed=True)


def rows_about(box: Box, sides: Sequence[str]) -> tuple[ComplexArray, ComplexArray]:
    """Centres of balloons in rows about a view, and the direction out of it at each."""
    low, high = complex(box[0], box[1]), complex(box[2], box[3])
    centres, outwards = [], []
    for side in sides:
        out, along = SIDES[side]
        half = (high - low) / 2
        reach = abs(half.real if along == 1 else half.imag)
        count = max(1, math.floor(2 * reach / PITCH) + 1)
        across = abs(half.imag if along == 1 else half.real)
        steps = (np.arange(count) - (count - 1) / 2) * PITCH
        centres.append((low + high) / 2 + out * (across + AWAY) + along * steps)
        outwards.append(np.full(count, complex(out)))
    return np.concatenate(centres), np.concatenate(outwards)


def balloons_about(names: Sequence[str], tips: ComplexArray, box: Box, sides: Sequence[str]) -> tuple[Balloon, ...]:
    """Balloons of items about a view. Raises CrowdedViewError where rows have no room for all, or not for leaders."""
    centres, outwards = rows_about(box, sides)
    if len(names) > len(centres):
        raise CrowdedViewError(f"{len(names)} balloons about a view with room for {len(centres)}")
    leaders = centres - tips[:, None]
    steep = (leaders * outwards.conj()).real / np.abs(leaders)
    cost = np.abs(leaders) + _FLAT * np.maximum(math.sin(STEEP) - steep, 0.0)
    items, chosen = linear_sum_assignment(cost)
    chosen = _uncrossed(tips[items], centres, chosen.copy())
    if np.any(_distances(tips[items], centres[chosen]) < RADIUS + _CLEAR):
        raise CrowdedViewError("a leader runs through another balloon")
    return tuple(
        Balloon(names[item], complex(centres[number]), complex(tips[item]))
        for item, number in zip(items.tolist(), chosen.tolist(), strict=True)
    )


def _uncrossed(tips: ComplexArray, centres: ComplexArray, chosen: FloatArray) -> FloatArray:
    """The choice with leaders that cross exchanged, until none do: each exchange makes their sum shorter."""
    while True:
        crossing = np.argwhere(np.triu(crossings(tips, centres[chosen]), 1))
        if not len(crossing):
            return chosen
        first, other = crossing[0].tolist()
        chosen[[first, other]] = chosen[[other, first]]


def _distances(tips: ComplexArray, centres: ComplexArray) -> FloatArray:
    """Distance of each leader from each other balloon's centre [mm]."""
    along = tips - centres
    away = centres - centres[:, None]
    share = np.clip((away * along.conj()[:, None]).real / (np.abs(along) ** 2)[:, None], 0.0, 1.0)
    return np.asarray(np.abs(away - share * along[:, None]) + np.diag(np.full(len(tips), np.inf)))


def crossings(starts: ComplexArray, ends: ComplexArray) -> BoolArray:
    """Which of some straight lines cross which others.

    >>> crossings(np.array([0j, 1 + 0j, 5 + 0j]), np.array([1 + 1j, 1j, 5 + 1j])).tolist()
    [[False, True, False], [True, False, False], [False, False, False]]
    """
    along = ends - starts
    first = (along.conj()[:, None] * (starts - starts[:, None])).imag
    last = (along.conj()[:, None] * (ends - starts[:, None])).imag
    apart = first * last < 0
    return apart & apart.T


def spots(picture: DepthPicture, count: int) -> tuple[ComplexArray, FloatArray]:
    """Of each item the point of the view that is deepest in what is seen of it, and its distance from the rim [m]."""
    points, depths = np.zeros(count, dtype=complex), np.zeros(count)
    for item, region in enumerate(find_objects(picture.items + 1, count)):
        if region is None:
            continue
        rows, columns = region
        step = max(1, (rows.stop - rows.start) // _FINEST, (columns.stop - columns.start) // _FINEST)
        mask = picture.items[rows.start : rows.stop : step, columns.start : columns.stop : step] == item
        inward = distance_transform_edt(np.pad(mask, 1))
        row, column = np.unravel_index(int(inward.argmax()), inward.shape)
        depths[item] = float(inward[row, column]) * step * picture.pixel
        points[item] = picture.point(rows.start + (row - 1) * step, columns.start + (column - 1) * step)
    return points, depths
