"""Differences: CIEDE2000 between the yarns of a chart and the colours of its design."""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float, FloatArray, Indices, Int32, IntArray, Rgb, UInt8
from ilmek.carpet.colour_difference import ciede2000
from ilmek.carpet.design import PART, bands
from ilmek.carpet.palette import Colours
from ilmek.num.compiled import uncounted
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress

Known = Int32[np.ndarray, "colours yarns"]

_UNIT = 2.0**24

_MOST_KNOWN = 1 << 24
"""Most differences that are kept, since a pattern asks for each many times."""


class YarnDifference(NamedTuple):
    """CIEDE2000 between a yarn and the colours of the design that it stands for: mean over the knots, and the worst."""

    mean: float
    worst: float


class Differences(NamedTuple):
    """CIEDE2000 of a chart to its design.

    mean     over the knots      of_yarns  of each yarn, 0 for one without a knot
    """

    mean: float
    of_yarns: tuple[YarnDifference, ...]


@uncounted
def _move(  # noqa: PLR0917
    rgb: Rgb, index: IntArray, labs: FloatArray, difference: IntArray, before: Indices, knots: Indices,
    yarn_labs: FloatArray, known: Known, sums: IntArray, counts: IntArray, worst: FloatArray
) -> None:  # fmt: skip
    """Add what the changed knots change; `known`: 1 + differences of colours and yarns, 0 where not known, or none."""
    # In whole units, so that the sums do not depend on the order.
    for row in range(rgb.shape[0]):
        for column in range(rgb.shape[1]):
            old, yarn = before[row, column], knots[row, column]
            if old != yarn:
                code = np.int32(rgb[row, column, 0]) << 16 | np.int32(rgb[row, column, 1]) << 8 | rgb[row, column, 2]
                colour = index[code] - 1
                units = np.int64(known[colour, yarn]) - 1 if known.size else -1
                if units < 0:
                    l1, a1, b1 = labs[colour, 0], labs[colour, 1], labs[colour, 2]
                    delta = ciede2000(l1, a1, b1, yarn_labs[yarn, 0], yarn_labs[yarn, 1], yarn_labs[yarn, 2])
                    units = round(delta * _UNIT)
                    worst[yarn] = max(worst[yarn], delta)
                    if known.size:
                        known[colour, yarn] = units + 1
                sums[yarn] += units
                sums[old] -= difference[colour]
                counts[yarn] += 1
                counts[old] -= 1


def differences(  # noqa: PLR0917
    design: Rgb,
    colours: Colours,
    taken: tuple[UInt8[np.ndarray, " colours"], Float[np.ndarray, " colours"]],
    charts: tuple[Indices, Indices],
    yarn_labs: Float[np.ndarray, "yarns 3"],
    progress: Progress = SILENT,
) -> Differences:
    """The differences of a chart to its design.

    taken   yarn of each distinct colour and its difference
    charts  knots with these yarns, and of the chart
    """
    (yarn_of, difference), (before, knots), yarns = taken, charts, len(yarn_labs)
    design = np.ascontiguousarray(design)

    units = np.rint(difference * _UNIT).astype(np.int64)
    known = np.zeros((len(difference) if len(difference) * yarns <= _MOST_KNOWN else 0, yarns), dtype=np.int32)

    def move(band: slice) -> tuple[IntArray, IntArray, FloatArray]:
        sums, counts, worst = np.zeros(yarns, dtype=np.int64), np.zeros(yarns, dtype=np.int64), np.zeros(yarns)
        args = (colours.index, colours.labs, units, before[band], knots[band], yarn_labs, known)
        _move(design[band], *args, sums, counts, worst)
        return sums, counts, worst

    begun = float(np.sum(colours.counts * difference))  # a dot product's order depends on the threads
    sums, counts, worst = np.zeros(yarns, dtype=np.int64), np.zeros(yarns, dtype=np.int64), np.zeros(yarns)
    np.maximum.at(worst, yarn_of, difference)
    for band, found in in_threads(move, () if before is knots else bands(knots.shape[0], knots.shape[1], PART)):
        sums, counts, worst = sums + found[0], counts + found[1], np.maximum(worst, found[2])
        progress(band.stop / len(knots))
    added = sums / _UNIT
    total = np.bincount(yarn_of, weights=colours.counts * difference, minlength=yarns) + added
    number = np.bincount(yarn_of, weights=colours.counts, minlength=yarns) + counts
    of_yarns = np.where(number > 0, total / np.maximum(number, 1), 0.0), np.where(number > 0, worst, 0.0)
    mean = (begun + float(added.sum())) / knots.size
    pairs = zip(of_yarns[0].tolist(), of_yarns[1].tolist(), strict=True)
    return Differences(mean, tuple(YarnDifference(*pair) for pair in pairs))
