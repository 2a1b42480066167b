"""What a tufting machine does for a picture, stroke by stroke: position of the needle bar, yarn of each needle.

Of c colours needle i has colour i mod c, and is over column i - (c - 1) + q where the bar is q gauges from its first
position. In the c strokes of a row q goes from 0 to c - 1 and back in the next, a gauge at a time, so that each column
comes under c needles that follow each other: under each colour once.

The needles go to one depth, for loops of the height h. What is not fed is drawn out of the loop before of the same
needle, so that the yarn of a stroke sets the height H of that loop:

    l = 2 (H + t) + k d        backing t; d from the stitch before, k the yarn on the back over it; first stitch: H = h

A needle that is fed low is hidden, one that is not selected does not enter the backing. After the last row all needles
tuft once more, which sets their last loops; what they tuft then is beyond the end of the carpet.
                                                                            [balance of the yarn of a needle; geometry]
"""

import numpy as np

from ilmek.arrays import Float, Int, Int32, UInt8
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.units import mm
from ilmek.weaving.tufts import tuft_yarn

UNIT = 0.01 * mm
"""Unit of a feed [m]."""

BARE = 255
"""Colour of a place without a loop that is seen."""

OUT = -1
"""Feed of a needle that does not enter the backing."""

STEPS = 128
"""Strokes between reports of progress."""


@record
class TuftGrid:
    """Distances, heights and backing of tufts.

    gauge   distance of the needles [m]      stitch  distance of the rows of tufts [m]
    height, low, hidden   of the highest and lowest loops that are to be seen, and of others [m]
    backing  thickness [m]                   back    yarn on the back over its distance [-]
    """

    gauge: float
    stitch: float
    height: float
    low: float
    hidden: float
    backing: float
    back: float


@record
class TuftProgramme:
    """The strokes of a carpet of rows x columns.

    threads  colour of each needle            first    column of the first needle where the bar is in its first position
    shifts   of the bar from there [gauges], by stroke
    advance  of the backing from stroke to stroke [m]
    feeds    yarn by stroke and needle [UNIT]; OUT: the needle does not enter the backing
    """

    grid: TuftGrid
    rows: int
    columns: int
    threads: Int[np.ndarray, " needles"]
    first: int
    shifts: Int[np.ndarray, " strokes"]
    advance: float
    feeds: Int32[np.ndarray, "strokes needles"]


def serpentine(strokes: int, colours: int) -> Int[np.ndarray, " strokes"]:
    """Positions of the bar: there and back.

    >>> serpentine(7, 3).tolist()
    [0, 1, 2, 2, 1, 0, 0]
    """
    row, turn = np.divmod(np.arange(strokes), colours)
    return np.asarray(np.where(row % 2 == 0, turn, colours - 1 - turn))


def tuft_programme(
    labels: UInt8[np.ndarray, "rows columns"],
    colours: int,
    grid: TuftGrid,
    *,
    heights: Float[np.ndarray, "rows columns"] | None = None,
    by_needle: bool = False,
    progress: Progress = SILENT,
) -> TuftProgramme:
    """The programme of labels 0 .. colours - 1, BARE: none, the row at the bottom first.

    heights    of the loops at each place [m], (rows, columns); default: all are those of the grid
    by_needle  the needles of the wanted colour alone tuft; False: all do, the others hidden
    """
    rows, columns = labels.shape
    needles, strokes = np.arange(columns + colours - 1), rows * colours + 1
    threads, shifts = needles % colours, serpentine(strokes, colours)
    feeds = np.full((strokes, needles.size), OUT, dtype=np.int32)
    last = np.full((2, needles.size), np.nan)  # where each needle was in the backing: shift, and along
    height = np.full(needles.size, grid.height)
    for stroke, shift in enumerate(shifts.tolist()):
        if stroke % STEPS == 0:
            progress(stroke / strokes)
        row, column = rows - 1 - stroke // colours, needles - (colours - 1) + shift
        over = (column >= 0) & (column < columns) & (row >= 0)
        wanted = over & (labels[row, np.clip(column, 0, columns - 1)] == threads)
        enters = wanted | (not by_needle) | (row < 0)
        place = np.array([shift * grid.gauge, stroke * grid.stitch / colours])[:, None]
        distance = np.nan_to_num(np.hypot(*(place - last)))
        fed = np.asarray(tuft_yarn(height, grid.backing, distance, grid.back))
        feeds[stroke, enters] = np.rint(fed[enters] / UNIT).astype(np.int32)
        own = grid.height if heights is None else heights[row, np.clip(column, 0, columns - 1)]
        height = np.where(enters, np.where(wanted, own, grid.hidden), height)
        last = np.where(enters, place, last)
    return TuftProgramme(grid, rows, columns, threads, 1 - colours, shifts, grid.stitch / colours, feeds)
