"""What a chart keeps of its design: its edges, and the colours of a drawing.

Edges: two knots of a row or a column, 1 or REACH apart, are an edge of contrast c, CIEDE2000 of their colours in the
design, from FAINT on. It is kept as far as the chart has half of its contrast: by min(1, 2 d / c), d CIEDE2000 of their
two yarns. The share that is kept is the mean of all edges, each with the weight c. Up to MOST_KNOTS knots of an even
lattice begin an edge: on larger charts it is a sample, whose standard error is below 0.005.

Colours: two groups of a drawing's colours [`colour_groups`] that touch and differ by VANISHING or more are lost in each
other where their yarns are one, or within SAME_YARN. That with the fewer knots vanishes; its share is that of what is
drawn where the two touch [`assignment.touching`].
"""

import math
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float, FloatArray, Indices, IntArray, Rgb, UInt8
from ilmek.carpet.assignment import touching
from ilmek.carpet.colour import lab_to_srgb
from ilmek.carpet.colour_difference import ciede2000, delta_e_2000
from ilmek.carpet.colour_groups import ColourGroups
from ilmek.carpet.palette import Colours
from ilmek.carpet.picture_points import hex_colour
from ilmek.num.compiled import compiled

FAINT = 6.0
"""CIEDE2000 below which two knots are no edge."""

REACH = 4
"""Knots over which a soft edge is seen."""

VANISHING = 10.0
"""CIEDE2000 from which two colours of a drawing are two."""

SAME_YARN = 3.0
"""CIEDE2000 of two yarns that look like one in the pile."""

MOST_KNOTS = 20_000


class LostColour(NamedTuple):
    """A colour of a drawing that vanishes, the colour beside it that has the same yarn, and the share of the knots."""

    srgb: tuple[int, int, int]
    beside: tuple[int, int, int]
    share: float

    @property
    def hex(self) -> str:
        """The colour as `#rrggbb`."""
        return hex_colour(self.srgb)


@compiled
def _edges(  # noqa: PLR0917
    rgb: Rgb, index: IntArray, labs: FloatArray, knots: Indices, apart: FloatArray, step: int, sums: FloatArray
) -> None:
    rows, columns = knots.shape
    for i in range(0, rows, step):
        for j in range(i // step * 7 % step, columns, step):
            code = np.int32(rgb[i, j, 0]) << 16 | np.int32(rgb[i, j, 1]) << 8 | rgb[i, j, 2]
            l1, a1, b1 = labs[index[code] - 1]
            for turn in range(4):
                reach = REACH if turn >= 2 else 1
                y, x = (i + reach, j) if turn % 2 else (i, j + reach)
                if y >= rows or x >= columns:
                    continue
                other = np.int32(rgb[y, x, 0]) << 16 | np.int32(rgb[y, x, 1]) << 8 | rgb[y, x, 2]
                if other == code:
                    continue
                l2, a2, b2 = labs[index[other] - 1]
                contrast = ciede2000(l1, a1, b1, l2, a2, b2)
                if contrast >= FAINT:
                    sums[0] += contrast
                    sums[1] += min(contrast, 2.0 * apart[knots[i, j], knots[y, x]])


def edges_kept(design: Rgb, colours: Colours, knots: Indices, yarn_labs: Float[np.ndarray, "yarns 3"]) -> float | None:
    """Share of the design's edges that a chart keeps [-]; None: the design has no edge."""
    sums = np.zeros(2)
    step = max(1, math.ceil(math.sqrt(knots.size / MOST_KNOTS)))
    apart = delta_e_2000(yarn_labs[:, None], yarn_labs[None])
    _edges(np.ascontiguousarray(design), colours.index, colours.labs, knots, apart, step, sums)
    return float(sums[1] / sums[0]) if sums[0] > 0 else None


def lost_colours(
    groups: ColourGroups, yarn_of: UInt8[np.ndarray, " groups"], yarn_labs: Float[np.ndarray, "yarns 3"]
) -> tuple[LostColour, ...]:
    """The colours of a drawing that vanish, the largest share first; a colour that vanishes in several is named once.

    yarn_of  index of each group's yarn
    """
    contrast = delta_e_2000(groups.labs[:, None], groups.labs[None])
    apart = delta_e_2000(yarn_labs[:, None], yarn_labs[None])[yarn_of[:, None], yarn_of[None]]
    drawn = np.where((contrast >= VANISHING) & (apart < SAME_YARN), touching(groups), 0.0)
    # Groups are in the order of their knots: below the diagonal the first of the two has fewer.
    shares = np.tril(drawn, -1) / groups.knots.sum()
    codes = [tuple(srgb) for srgb in lab_to_srgb(groups.labs).tolist()]
    found = [
        LostColour(codes[group], codes[int(row.argmax())], float(row.sum()))
        for group, row in enumerate(shares)
        if row.any()
    ]
    return tuple(sorted(found, key=lambda lost: -lost.share))
