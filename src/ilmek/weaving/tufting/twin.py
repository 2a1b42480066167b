"""A tufting machine that tufts a programme: where each loop is, how high it stays, what is seen.

The backing goes on, the bar shifts, needles enter where they are; each loop is as high as the loopers hold it until the
next stitch of its needle draws what it is not fed out of it:

    H = h - (2 (h + t) + k d - l) / 2        l fed, d from the stitch before, h by the loopers

The loops of a place cover each other; the one higher than half of the lowest that is to be seen is seen.
"""

import numpy as np

from ilmek.arrays import Float, Int, UInt8
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.weaving.tufting.programme import BARE, OUT, STEPS, UNIT, TuftProgramme
from ilmek.weaving.tufts import tuft_yarn


@record
class TuftedFace:
    """The face of a carpet, row 0 at the top.

    colours  seen at each place; BARE: none             number   of loops that are seen at each place
    heights  of these [m]; NaN: none                    hidden   greatest height of the others [m]
    loops    of all needles                             yarn     of each colour, by needle [m]
    """

    colours: UInt8[np.ndarray, "rows columns"]
    number: Int[np.ndarray, "rows columns"]
    heights: Float[np.ndarray, "rows columns"]
    hidden: float
    loops: int
    yarn: Float[np.ndarray, " colours"]


def tufted_face(programme: TuftProgramme, progress: Progress = SILENT) -> TuftedFace:
    """The carpet that a programme tufts."""
    grid, needles = programme.grid, np.arange(programme.threads.size)
    colours = np.full((programme.rows, programme.columns), BARE, dtype=np.uint8)
    number = np.zeros(colours.shape, dtype=np.int64)
    across, along = (np.full(needles.size, np.nan) for _ in range(2))  # the last stitch of each needle [m]
    fed = np.zeros(needles.size)
    heights = np.full(colours.shape, np.nan)
    hidden, loops, travel = 0.0, 0, 0.0
    for stroke, shift in enumerate(programme.shifts.tolist()):
        if stroke % STEPS == 0:
            progress(stroke / programme.shifts.size)
        (own,) = np.nonzero(programme.feeds[stroke] != OUT)
        x = (programme.first + own + shift) * grid.gauge
        length = programme.feeds[stroke, own] * UNIT
        distance = np.hypot(x - across[own], travel - along[own])
        (again,) = np.nonzero(np.isfinite(distance))
        drawn = tuft_yarn(grid.height, grid.backing, distance[again], grid.back) - length[again]
        height, needle = grid.height - drawn / 2, own[again]
        row = np.floor(along[needle] / grid.stitch + 1e-6).astype(int)
        column = np.rint(across[needle] / grid.gauge).astype(int)
        in_sight = height > grid.low / 2
        if not in_sight.all():
            hidden = max(hidden, float(height[~in_sight].max()))
        inside = in_sight & (row < programme.rows) & (column >= 0) & (column < programme.columns)
        place = row[inside], column[inside]
        colours[place] = programme.threads[needle[inside]]
        heights[place] = height[inside]
        np.add.at(number, place, 1)
        across[own], along[own] = x, travel
        fed[own] += length
        loops += own.size
        travel += programme.advance
    yarn = np.bincount(programme.threads, weights=fed)
    return TuftedFace(colours[::-1], number[::-1], heights[::-1], hidden, loops, yarn)
