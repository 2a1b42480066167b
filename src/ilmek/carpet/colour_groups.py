"""Colour groups: the colours of a drawing as one sees them, and how they touch.

Colours nearer than TWIN to a colour with more knots are one with it: grain, the noise of a JPEG file, a blend. The
contact of two groups is the number of pairs of neighbouring knots, in a row or in a column, of which one has either.
"""

import numpy as np

from ilmek.arrays import Float, FloatArray, Int64, IntArray, Rgb, UInt8
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.design import PART, bands
from ilmek.carpet.palette import Colours, paint
from ilmek.num.compiled import compiled
from ilmek.num.threads import in_threads
from ilmek.records import record

TWIN = 2.5
"""CIEDE2000 below which two colours of a drawing are taken for one; one step of a code is below 1.2."""

MOST_GROUPS = 160
"""Largest number of groups; further colours are of the nearest group."""


@record
class ColourGroups:
    """The groups of a drawing's colours, that with the most knots first.

    of        group of each distinct colour      labs  CIELAB of each group's most frequent colour
    knots     of each group                      contact  pairs of neighbouring knots of two groups, symmetric
    """

    of: UInt8[np.ndarray, " colours"]
    labs: Float[np.ndarray, "groups 3"]
    knots: Float[np.ndarray, " groups"]
    contact: Float[np.ndarray, "groups groups"]

    def __len__(self) -> int:
        return len(self.knots)


@compiled
def _count_contacts(groups: UInt8[np.ndarray, "rows columns"], stop: int, out: IntArray) -> None:
    """Add the pairs of neighbours of two groups; the last rows, from `stop` on, are only neighbours below."""
    rows, columns = groups.shape
    for i in range(stop):
        for j in range(columns):
            own = groups[i, j]
            if j + 1 < columns and groups[i, j + 1] != own:
                out[own, groups[i, j + 1]] += 1
            if i + 1 < rows and groups[i + 1, j] != own:
                out[own, groups[i + 1, j]] += 1


def contacts(groups: UInt8[np.ndarray, "rows columns"], number: int) -> FloatArray:
    """Pairs of neighbouring knots of each two of `number` groups, symmetric; 0 on the diagonal.

    >>> contacts(np.array([[0, 0, 1], [0, 2, 1]], dtype=np.uint8), 3).tolist()
    [[0.0, 1.0, 2.0], [1.0, 0.0, 1.0], [2.0, 1.0, 0.0]]
    """
    rows, columns = groups.shape

    def count(band: slice) -> Int64[np.ndarray, "groups groups"]:
        found = np.zeros((number, number), dtype=np.int64)
        _count_contacts(groups[band.start : min(band.stop + 1, rows)], band.stop - band.start, found)
        return found

    total = np.zeros((number, number), dtype=np.int64)
    for _, found in in_threads(count, bands(rows, columns, PART)):
        total += found
    return (total + total.T).astype(float)


def colour_groups(design: Rgb, colours: Colours) -> ColourGroups:
    """The groups of the colours of a drawing."""
    leaders, of = _leaders(colours)
    knots = np.bincount(of, weights=colours.counts, minlength=len(leaders))
    order = np.argsort(-knots, kind="stable")
    place = np.empty(len(order), dtype=np.uint8)
    place[order] = np.arange(len(order), dtype=np.uint8)
    of = place[of]
    contact = contacts(paint(design, colours, of), len(order))
    return ColourGroups(of, colours.labs[np.array(leaders)[order]], knots[order], contact)


def _leaders(colours: Colours) -> tuple[list[int], UInt8[np.ndarray, " colours"]]:
    """The colours that lead a group, and the group of each colour."""
    order = np.argsort(-colours.counts, kind="stable")
    leaders: list[int] = []
    least, of = np.full(len(order), np.inf), np.zeros(len(order), dtype=np.uint8)
    for number in order.tolist():
        if leaders and (least[number] < TWIN or len(leaders) == MOST_GROUPS):
            continue
        difference = delta_e_2000(colours.labs, colours.labs[number])
        nearer = difference < least
        of[nearer], least[nearer] = len(leaders), difference[nearer]
        leaders.append(number)
    return leaders, of
