"""Mounting: the warps of a carpet on the loom, and the marks by which its knots are counted and checked.

    warps = 2 · columns + selvedge warps,   width on the loom = warps · pitch,   pitch = widening/(2 · across)

Every 10th row and every 10th knot has a mark: 10 lengthening/along of the length on the loom, 10 widening/across of the
width; the finished carpet is shorter and narrower [ilmek.carpet.washing].
"""

from ilmek.carpet.chart import Chart
from ilmek.carpet.ground import GroundParams
from ilmek.records import record

TENS = 10
"""Rows, and knots of a row, from mark to mark."""


@record
class Mounting:
    """Warps and marks of a carpet.

    warps, selvedge_warps  all of them; of these without knots, both edges together
    pitch        distance of neighbouring warps [m]           width         of all warps [m]
    warp_length  of each, ends and loom waste included [m]    fringe        beyond the pile at each end [m]
    row_mark, knot_mark    from mark to mark: TENS rows along, TENS knots across [m]
    middle_row, middle_knot  the line of the middle is after so many rows and knots; half ones: it is in the next one
    """

    warps: int
    selvedge_warps: int
    pitch: float
    width: float
    warp_length: float
    fringe: float
    row_mark: float
    knot_mark: float
    middle_row: float
    middle_knot: float


def mounting(chart: Chart, ground: GroundParams | None = None) -> Mounting:
    """The mounting of a chart.

    ground  default: that of the class

    >>> from ilmek import read_yarns
    >>> made = mounting(Chart([[0] * 5, [1] * 5, [0] * 5], read_yarns()[:2], "10x6cm", "5x5/dm", "symmetric"))
    >>> made.warps, made.pitch, made.width, round(made.row_mark, 4), made.middle_row, made.middle_knot
    (18, 0.01, 0.18, 0.2043, 1.5, 2.5)
    """
    ground, quality = ground or GroundParams(), chart.quality
    warps, pitch = 2 * chart.columns + ground.selvedge_warps, ground.warp_pitch(quality)
    return Mounting(
        warps,
        ground.selvedge_warps,
        pitch,
        warps * pitch,
        ground.warp_length(chart.size.length),
        ground.fringe,
        TENS / quality.along * ground.lengthening,
        TENS * 2 * pitch,
        chart.rows / 2,
        chart.columns / 2,
    )
