"""How long a loom weaves, estimated before there is a chart, and its programme once there is one.

    estimate = rows * ( wefts + (n_first + n_second) * k (t_knot + c t_change) ) + stops

n cells of the widest part in each half of a row, k the share of cells with a knot, c colour changes a knot; stops to
change bobbins of weft. Waiting for the slower of two heads is not in the estimate; a programme has it.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.carpet.design import knot_grid
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.loom.bobbins import stop_time
from ilmek.machines.automated_loom.design import LoomDesign, of_mean_cell, times_at
from ilmek.records import computed, record, result


def estimated_time(loom: LoomDesign, number: int | None = None, weft: float | None = None) -> float:
    """Weaving time [s] without a chart, for the loom's heads or weavers or another number, wefts and beats or their
    time [s].
    """
    busy = of_mean_cell(replace(loom.times, weft=weft or loom.times.weft), loom.params)
    return loom.head.least_time(loom.rows, loom.columns, number or loom.knotters, busy, loom.bobbins)


def estimated_times_at(loom: LoomDesign, pitch: float, numbers: Sequence[int]) -> FloatArray:
    """Weaving times [s] of the same carpet on warps of another pitch [m], rows closer by the same measure, by number of
    heads or weavers.

    Wefts, beats and the knot itself take what they take on this loom; steps of the carriage are of the other pitch.
    Usual wefts are the thinner the finer the pitch, so that the stops for their bobbins are as many.
    """
    finer = loom.task.cloth.warp_pitch / pitch
    quality = loom.params.quality
    size = CarpetSize(loom.params.width, loom.params.length)
    rows, columns = knot_grid(size, Quality(quality.across * finer, quality.along * finer))
    own = times_at(loom.params, loom.head, 2 * pitch, loom.times.weft)
    times, stops = of_mean_cell(own, loom.params), stop_time(loom.bobbins, loom.rows)
    return np.array([loom.head.least_time(rows, columns, number, times) + stops for number in numbers])


def time_for_knots(loom: LoomDesign, deadline: float) -> float:
    """What a deadline [s] leaves of a row for its knots [s]."""
    return (deadline - stop_time(loom.bobbins, loom.rows)) / loom.rows - loom.times.weft


@record
class TimeShares:
    """Where the estimated time goes: tying, colour changes, wefts with beats, stops for bobbins; together 1."""

    knotting: float
    colour_changes: float
    wefts: float
    stops: float
    utilisation: float = result("%", "time that a head or a weaver ties or changes colour, as the mean of all")

    @computed("%", "where the time goes")
    def time_shares(self) -> dict[str, float]:
        return {
            "knotting": self.knotting,
            "colour changes": self.colour_changes,
            "wefts and beats": self.wefts,
            "stops for bobbins": self.stops,
        }

    @computed("", "the largest share of the time")
    def bottleneck(self) -> str:
        shares: dict[str, float] = self.time_shares
        return max(shares, key=lambda name: shares[name])


def time_shares(loom: LoomDesign) -> TimeShares:
    """Where the estimated time of a loom goes."""
    times, changes, total = loom.times, loom.params.changes_per_knot, estimated_time(loom)
    wefts = loom.rows * times.weft / total
    stops = stop_time(loom.bobbins, loom.rows) / total
    change = changes * times.colour_change
    tying = 1 - wefts - stops
    knotting = tying * times.knot / (times.knot + change)
    busy = loom.params.knots * (times.knot + change) / loom.knotters
    return TimeShares(knotting, tying - knotting, wefts, stops, busy / total)
