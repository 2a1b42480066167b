"""Lines carved into the pile where two colours meet: their length, and the yarn that is cut away.

The borders between cells of two yarns are counted along the four directions e of a cell's neighbours. A direction has
the share D of the half circle that is nearest to it; with a the area of a cell,

    L = sum over e of n(e) a D(e) / (2 |e|)        [Boykov and Kolmogorov 2003, Computing geodesics and minimal surfaces
                                                   via graph cuts, eq. 9]

n(e) are the pairs of cells with a line between them. A circle has its length; a straight line of square cells 5 % less
along the rows and up to 3 % more aslant.

On each side of a line the groove takes depth² tan(angle/2) / 2 of the pile's section, and each of the two legs of a
knot stands in its cell, so that 2 n mu is the mass of the pile in a volume (n knots per area, mu of its yarn):

    mass of a yarn = L of its sides · depth² tan(angle/2) / 2 · 2 n mu
"""

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, Indices
from ilmek.carpet.cells import CellMap
from ilmek.carpet.codes import CODES
from ilmek.carpet.pile import PileParams
from ilmek.carpet.yarn import Yarn
from ilmek.errors import CarpetError
from ilmek.units import format_quantity

if TYPE_CHECKING:
    from ilmek.carpet.chart import Chart

_PAIRS = (
    ((slice(None), slice(None, -1)), (slice(None), slice(1, None)), (1, 0)),
    ((slice(1, None), slice(None, -1)), (slice(None, -1), slice(1, None)), (1, 1)),
    ((slice(1, None), slice(None)), (slice(None, -1), slice(None)), (0, 1)),
    ((slice(1, None), slice(1, None)), (slice(None, -1), slice(None, -1)), (-1, 1)),
)
"""Cells and their neighbours to the right, upper right, above and upper left, and where these are: across, up."""


def carved(knots: Indices, yarns: Sequence[Yarn], cells: CellMap) -> tuple[BoolArray, BoolArray]:
    """Where lines are carved: between each cell and that on its right, and between each cell and that above it.

    Their shapes are those of the pairs of cells. No line is between knots and cells without one, nor at loops.
    """
    across, _, along, _ = (line for line, _ in _lines(knots, yarns, cells))
    return across, along


def carved_length(chart: "Chart") -> float:
    """Length of the carved lines [m]; 0 for a chart without them."""
    return float(_sides(chart).sum()) / 2


def carved_masses(chart: "Chart") -> tuple[float, ...]:
    """Mass of each yarn that is cut away along the carved lines [kg]."""
    if chart.cells is None or chart.cells.carving is None:
        return (0.0,) * len(chart.yarns)
    section = chart.cells.carving.side * 2 * chart.quality.knots_per_area
    sides = _sides(chart).tolist()
    return tuple(section * length * yarn.linear_density for length, yarn in zip(sides, chart.yarns, strict=False))


def require_carved(chart: "Chart", usual: PileParams) -> None:
    """Raise CarpetError for lines as deep as the lowest pile beside them.

    usual  the pile of knots without a height of their own
    """
    if chart.cells is None or chart.cells.carving is None:
        return
    beside = np.zeros(len(chart.cells.kinds), dtype=bool)
    for (line, _), (one, other, _) in zip(_lines(chart.knots, chart.yarns, chart.cells), _PAIRS, strict=True):
        beside[chart.cells.index[one][line]] = beside[chart.cells.index[other][line]] = True
    if not beside.any():
        given = "lines are carved, and no colours meet in a cut pile"
        raise CarpetError(given, allowed="two colours with a cut pile", do="name other yarns, or leave the lines out")
    kinds = [kind for kind, there in zip(chart.cells.kinds, beside, strict=True) if there]
    lowest = min(usual.pile_height if kind.height is None else kind.height for kind in kinds)
    if chart.cells.carving.depth >= lowest:
        depth, pile = format_quantity(chart.cells.carving.depth, "mm"), format_quantity(lowest, "mm")
        given = f"lines are carved {depth} deep into a pile of {pile}"
        raise CarpetError(given, allowed=f"less than {pile}", do="give --carve-depth, or a higher pile")


def _sides(chart: "Chart") -> FloatArray:
    """Length of the sides of carved lines at each code of the chart's knots [m]."""
    sides = np.zeros(CODES)
    if chart.cells is None or chart.cells.carving is None:
        return sides
    pitches = np.array([chart.size.width / chart.columns, chart.size.length / chart.rows])
    steps = [pitches * step for *_, step in _PAIRS]
    angles = [math.atan2(up, across) for across, up in steps]
    turned = np.array([*angles, angles[0] + math.pi]) - angles[0]
    shares = (np.diff(turned) + np.diff([turned[-2] - math.pi, *turned[:-1]])) / 2
    for (line, codes), step, share in zip(_lines(chart.knots, chart.yarns, chart.cells), steps, shares, strict=True):
        weight = pitches.prod() * share / (2 * np.hypot(*step))
        for side in codes:
            sides += weight * np.bincount(side[line], minlength=CODES)
    return sides


def _lines(
    knots: Indices, yarns: Sequence[Yarn], cells: CellMap
) -> Iterator[tuple[BoolArray, tuple[Indices, Indices]]]:
    """For each direction the pairs of cells that have a line between them, and the codes of both cells."""
    assert cells.carving is not None
    names = cells.carving.yarns
    own = np.ones(CODES, dtype=bool)
    own[: len(yarns)] = [not names or yarn.name in names for yarn in yarns]
    cut = np.array([kind.knotted and not kind.loop for kind in cells.kinds])[cells.index]
    for one, other, _ in _PAIRS:
        codes = knots[one], knots[other]
        line = (codes[0] != codes[1]) & cut[one] & cut[other] & (own[codes[0]] | own[codes[1]])
        yield line, codes
