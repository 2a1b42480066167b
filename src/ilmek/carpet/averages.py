"""Averages: the mean light of a picture over the knots, which tells what a reading of it loses.

A drawing is read by areas and lines, so its design has no mixtures. What it is compared to is the picture itself, box
averages in linear light [`design.resampled`], on a lattice of LATTICE places: of a large carpet only in the rows that
the lattice needs.

A reading is off at a knot whose average is neither the colour of the knot nor its mixture, in linear light, with that
of one of the eight knots around it. Such mixtures are smoothed edges and thin lines: the reading has them.
"""

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, Indices, IntArray, Rgb, UInt8
from ilmek.carpet.colour import LINEAR, RGB_TO_XYZ, srgb_to_lab, xyz_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.design import resampled, resampled_band
from ilmek.num.threads import in_threads
from ilmek.records import record

LATTICE = 10_000
"""Largest number of places at which a chart and its picture are compared, about."""

ABOVE, STRIP = 1, 8
"""Rows of knots above a place, and in all, that a comparison needs."""

OFF = 5.0
"""CIEDE2000 of an average from what a reading explains, from which it is off."""


@record
class Averages:
    """Mean light of a picture over the knots.

    rows    numbers of the rows of knots, ascending      colours  sRGB (rows, columns, 3)
    """

    rows: IntArray
    colours: Rgb


def lattice_step(rows: int, columns: int) -> int:
    """Knots from place to place of the lattice, an odd number: the dots of a halftone have 2 × 2 knots.

    >>> lattice_step(90, 100), lattice_step(450, 300)
    (1, 5)
    """
    return int(np.ceil(np.sqrt(max(1.0, rows * columns / LATTICE)))) // 2 * 2 + 1


def averages_of(picture: Rgb, grid: tuple[int, int]) -> Averages:
    """The averages of a picture on a grid of rows and columns of knots."""
    rows, step = grid[0], lattice_step(*grid)
    if step <= STRIP:
        return Averages(np.arange(rows), resampled(picture, *grid))
    strips = [slice(max(0, i - ABOVE), min(rows, i - ABOVE + STRIP)) for i in range(0, rows, step)]
    made = [band for _, band in in_threads(lambda strip: resampled_band(picture, grid, strip), strips)]
    return Averages(np.concatenate([np.arange(rows)[strip] for strip in strips]), np.concatenate(made))


def reading_loss(design: Rgb, averages: Averages | None, knots: Indices, yarn_labs: FloatArray) -> float:
    """What the reading adds to the mean CIEDE2000 of a chart and its picture: where it is off, the yarns of the knots
    are compared to the averages instead of the design. 0 without averages.
    """
    if averages is None:
        return 0.0
    step = lattice_step(*design.shape[:2])
    columns = np.arange(step // 2, design.shape[1], step)
    places = np.flatnonzero(averages.rows % step == 0)
    rows = averages.rows[places]
    seen, drawn = averages.colours[places][:, columns], design[rows][:, columns]
    changed = np.any(seen != drawn, axis=-1)
    if not changed.any():
        return 0.0
    y, x = (axis[changed] for axis in np.meshgrid(rows, columns, indexing="ij"))
    seen, drawn = seen[changed], drawn[changed]
    off = _is_off(seen, drawn, _around(design, y, x))
    labs, tied = srgb_to_lab(np.stack([seen, drawn])[:, off]), yarn_labs[knots[y, x]][off]
    return float(np.sum(delta_e_2000(labs[0], tied) - delta_e_2000(labs[1], tied)) / changed.size)


def _around(design: Rgb, y: IntArray, x: IntArray) -> UInt8[np.ndarray, "8 knots 3"]:
    """The colours of the eight knots around each knot (8, knots, 3); beyond the edge those at it."""
    steps = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
    last = np.array(design.shape[:2]) - 1
    return np.stack([design[np.clip(y + i, 0, last[0]), np.clip(x + j, 0, last[1])] for i, j in steps])


def _is_off(
    seen: UInt8[np.ndarray, "knots 3"], drawn: UInt8[np.ndarray, "knots 3"], around: UInt8[np.ndarray, "8 knots 3"]
) -> BoolArray:
    """Whether each average is far from its drawn colour and from the mixtures of that with those around."""
    target, own, others = (LINEAR[colours] for colours in (seen, drawn, around))
    along = others - own
    share = np.sum((target - own) * along, axis=-1) / np.maximum(np.sum(along**2, axis=-1), 1e-12)
    mixtures: FloatArray = own + np.clip(share, 0.0, 1.0)[..., None] * along
    nearest = np.argmin(np.sum((mixtures - target) ** 2, axis=-1), axis=0)
    explained = xyz_to_lab(mixtures[nearest, np.arange(len(target))] @ RGB_TO_XYZ.T)
    return np.asarray(delta_e_2000(srgb_to_lab(seen), explained) >= OFF)
