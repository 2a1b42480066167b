"""What a chart keeps of its picture: its edges, and the colours of a drawing.

Edges: two blocks of 2 × 2 knots side by side, or REACH apart, are an edge of contrast c, CIEDE2000 of their mean CIELAB
in the picture's averages [`averages`], from FAINT on: grain is averaged out, and a pattern counts by what it mixes to.
It is kept as far as the chart has half of its contrast: by min(1, 2 d / c), d the greatest of the means of the yarns of
these blocks, and of those a knot farther to either side: the chart has no smoothed edges. The share that is kept is the
mean of all edges, each with the weight c. The blocks of a lattice begin an edge: of large charts they are a sample.

Colours: of two groups of a drawing's colours [`colour_groups`] that differ visibly and have one yarn, or two within
SAME_YARN, that with the fewer knots is lost, wherever they lie. They differ visibly from VISIBLE on; a group of less
than LEAST_LOST of the knots from VANISHING on, and below LEAST_DETAIL not at all.
"""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float, FloatArray, Indices, Int32, IntArray, Rgb, UInt8
from ilmek.carpet.averages import Averages, lattice_step
from ilmek.carpet.colour import lab_to_srgb, srgb_to_lab
from ilmek.carpet.colour_difference import ciede2000, delta_e_2000
from ilmek.carpet.colour_groups import ColourGroups
from ilmek.carpet.palette import Colours, distinct_colours
from ilmek.carpet.picture_points import hex_colour
from ilmek.num.compiled import compiled, uncounted

FAINT = 6.0
"""CIEDE2000 below which two blocks are no edge."""

REACH = 4
"""Knots from block to block over which a soft edge is seen."""

VISIBLE, VANISHING = 5.0, 10.0
"""CIEDE2000 from which two areas of a drawing have two colours, and from which a detail has one of its own."""

SAME_YARN = 3.0
"""CIEDE2000 of two yarns that look like one in the pile."""

LEAST_LOST, LEAST_DETAIL = 3e-3, 5e-4
"""Least shares of the knots of a colour, and of a detail, that is called lost."""


_FEW = 1 << 19
"""Pixels up to which the table of all codes would take longer than their CIELAB."""


class LostColour(NamedTuple):
    """A colour of a drawing that is lost: in which other, by which yarn (its index), and its share of the knots."""

    srgb: tuple[int, int, int]
    other: tuple[int, int, int]
    yarn: int
    share: float

    @property
    def hex(self) -> str:
        """The colour as `#rrggbb`."""
        return hex_colour(self.srgb)


class Edges(NamedTuple):
    """The edges of a design: row and column of the first knots of their two blocks (edges, 4), and the contrasts."""

    blocks: Int32[np.ndarray, "edges 4"]
    contrasts: Float[np.ndarray, " edges"]


@uncounted
def _mean(rgb: Rgb, index: IntArray, labs: FloatArray, i: int, j: int, out: FloatArray) -> None:  # noqa: PLR0917
    """Write the mean CIELAB of a block of the design; without an index `labs` has the knots themselves."""
    out[:] = 0.0
    for y in range(i, i + 2):
        for x in range(j, j + 2):
            colour = y * rgb.shape[1] + x
            if index.size:
                code = np.int32(rgb[y, x, 0]) << 16 | np.int32(rgb[y, x, 1]) << 8 | rgb[y, x, 2]
                colour = index[code] - 1
            for axis in range(3):
                out[axis] += 0.25 * labs[colour, axis]


@uncounted
def _mean_yarn(knots: Indices, yarns: FloatArray, i: int, j: int, out: FloatArray) -> None:
    """Write the mean CIELAB of the yarns of a block."""
    out[:] = 0.0
    for y in range(i, i + 2):
        for x in range(j, j + 2):
            for axis in range(3):
                out[axis] += 0.25 * yarns[knots[y, x], axis]


@compiled
def _find(  # noqa: PLR0917
    rgb: Rgb, place: IntArray, index: IntArray, labs: FloatArray, step: int, blocks: IntArray, contrasts: FloatArray
) -> int:
    """The number of edges, which are written; `place`: the row of the picture of each row of knots."""
    rows, columns = len(place), rgb.shape[1]
    one, other, count = np.empty(3), np.empty(3), 0
    for i in range(0, rows - 1, step):
        for j in range(i // step * 7 % step, columns - 1, step):
            _mean(rgb, index, labs, place[i], j, one)
            for turn in range(4):
                reach = REACH if turn >= 2 else 2
                y, x = (i + reach, j) if turn % 2 else (i, j + reach)
                if y + 1 >= rows or x + 1 >= columns:
                    continue
                _mean(rgb, index, labs, place[y], x, other)
                contrast = ciede2000(one[0], one[1], one[2], other[0], other[1], other[2])
                if contrast >= FAINT:
                    blocks[count, 0], blocks[count, 1], blocks[count, 2], blocks[count, 3] = i, j, y, x
                    contrasts[count] = contrast
                    count += 1
    return count


@compiled
def _kept(edges: Edges, knots: Indices, yarns: FloatArray) -> float:
    """The sum of the contrasts as far as they are kept."""
    rows, columns = knots.shape
    one, other, kept = np.empty(3), np.empty(3), 0.0
    for edge in range(len(edges.contrasts)):
        i, j, y, x = edges.blocks[edge]
        down, drawn = int(y > i), 0.0
        for shift in (0, -1, 1):
            if 2.0 * drawn >= edges.contrasts[edge]:
                break
            top, left, low, right = i + shift * down, j + shift * (1 - down), y + shift * down, x + shift * (1 - down)
            if top >= 0 and left >= 0 and low + 1 < rows and right + 1 < columns:
                _mean_yarn(knots, yarns, top, left, one)
                _mean_yarn(knots, yarns, low, right, other)
                drawn = max(drawn, ciede2000(one[0], one[1], one[2], other[0], other[1], other[2]))
        kept += min(edges.contrasts[edge], 2.0 * drawn)
    return kept


def edges_of(design: Rgb, colours: Colours, averages: Averages | None = None) -> Edges:
    """The edges of a picture on the grid of a design (rows, columns, 3) that was read from it.

    colours  of the design      averages  of the picture; default: the design
    """
    rows, columns = int(design.shape[0]), int(design.shape[1])
    place, picture, index, labs = np.arange(rows), design, colours.index, colours.labs
    if averages is not None:
        place[averages.rows], picture = np.arange(len(averages.rows)), averages.colours
        index, labs = _colours_of(picture)
    step = lattice_step(rows, columns)
    most = 4 * -(-rows // step) * -(-columns // step)
    blocks, contrasts = np.empty((most, 4), dtype=np.int32), np.empty(most)
    rgb = np.ascontiguousarray(picture)
    count = _find(rgb, place, index, labs, step, blocks, contrasts)
    return Edges(blocks[:count], contrasts[:count])


def _colours_of(picture: Rgb) -> tuple[IntArray, FloatArray]:
    """The index and CIELAB of the distinct colours of a large picture; of a small one CIELAB of each pixel."""
    if picture.size > 3 * _FEW:
        colours = distinct_colours(picture)
        return colours.index, colours.labs
    return np.zeros(0, dtype=np.int32), srgb_to_lab(picture).reshape(-1, 3)


def colours_beside(edges: Edges, design: Rgb, colours: Colours) -> IntArray:
    """The numbers of the distinct colours that the blocks beside the edges have: on no other do they depend."""
    rows, columns = edges.blocks.reshape(-1, 2).T
    is_beside = np.zeros(len(colours.counts), dtype=bool)
    for down, right in ((0, 0), (0, 1), (1, 0), (1, 1)):
        red, green, blue = design[rows + down, columns + right].astype(np.int32).T
        is_beside[colours.index[red << 16 | green << 8 | blue] - 1] = True
    return np.flatnonzero(is_beside)


def edges_kept(edges: Edges, knots: Indices, yarn_labs: Float[np.ndarray, "yarns 3"]) -> float | None:
    """Share of a design's edges that a chart keeps [-]; None: the design has no edge."""
    if not len(edges.contrasts):
        return None
    return float(_kept(edges, knots, yarn_labs) / edges.contrasts.cumsum()[-1])


def lost_colours(
    groups: ColourGroups, yarn_of: UInt8[np.ndarray, " groups"], yarn_labs: Float[np.ndarray, "yarns 3"]
) -> tuple[LostColour, ...]:
    """The colours of a drawing that are lost, the largest share first, each in the largest that has its yarn.

    yarn_of  index of each group's yarn
    """
    contrast = delta_e_2000(groups.labs[:, None], groups.labs[None])
    apart = delta_e_2000(yarn_labs[:, None], yarn_labs[None])[yarn_of[:, None], yarn_of[None]]
    shares = groups.knots / groups.knots.sum()
    visible = np.where(shares >= LEAST_LOST, VISIBLE, np.where(shares >= LEAST_DETAIL, VANISHING, np.inf))
    # Groups are in the order of their knots: below the diagonal the first of the two has fewer.
    merged = np.tril((contrast >= visible[:, None]) & (apart < SAME_YARN), -1)
    codes = [tuple(srgb) for srgb in lab_to_srgb(groups.labs).tolist()]
    return tuple(
        LostColour(codes[group], codes[int(merged[group].argmax())], int(yarn_of[group]), float(shares[group]))
        for group in np.flatnonzero(merged.any(axis=1)).tolist()
    )
