"""Whether the cells of a grid are where they seem to be: cells off the course of the others, and a border left out.

A sheet under a camera is smooth: the middles of its cells follow a polynomial of their row and column. Where a lattice
slipped, by letters or where lines are missing, they do not.

The border of a drawing may have the colour of its lines, which do not show there. Then what lies beside the grid has
a colour of the drawing, in whole cells up to an edge on a line of the lattice.
"""

import numpy as np
import scipy

from ilmek.arrays import BoolArray, Float, FloatArray, Indices, UInt8
from ilmek.carpet.paper.colours import APART, DARK, LUMA, cell_lab

RINGS = 5
"""Rows and columns of cells around a grid whose colours are looked at."""

_DEGREE, _ROUNDS, _USUAL = 6, 6, 0.1
"""Degree of the course, number of fits, and distance from it beyond which a cell counts little [pitch]."""

_MOST_OFF, _NEAR = 0.15, 4
"""Largest distance of a cell from the course [pitch], and the cells around one beyond it that are not sure either."""


def off_lattice(x: Float[np.ndarray, "rows columns"], y: Float[np.ndarray, "rows columns"]) -> BoolArray:
    """The cells, with their middles at x, y [pixels], that are off the course of the others, and those near them."""
    places = x + 1j * y
    v, u = np.meshgrid(*(np.linspace(-1, 1, side) for side in places.shape), indexing="ij")
    powers = [(i, j) for i in range(_DEGREE + 1) for j in range(_DEGREE + 1 - i)]
    terms = np.stack([u**i * v**j for i, j in powers], axis=-1).reshape(-1, len(powers))
    pitch = float(np.abs(np.diff(places, axis=1)).mean())
    weights: FloatArray = np.ones(len(terms))
    for _ in range(_ROUNDS):
        weighted = terms * weights[:, None]
        course = np.linalg.solve(weighted.T @ terms + 1e-9 * np.eye(len(powers)), weighted.T @ places.ravel())
        off = np.abs(terms @ course - places.ravel()) / pitch
        weights = 1 / (1 + (off / _USUAL) ** 2) ** 2
    return np.asarray(scipy.ndimage.maximum_filter(off.reshape(places.shape) > _MOST_OFF, 2 * _NEAR + 1))


def border_beside(
    around: Float[np.ndarray, "wider_rows wider_columns 3"], palette: UInt8[np.ndarray, "colours 3"], numbers: Indices
) -> float:
    """The share of a side beside which the drawing seems to go on in whole cells, on the worst side.

    around  colours of the cells with RINGS more on each side [sRGB codes]    numbers  of the cells in the palette
    """
    return max(_beside(np.rot90(around, side), palette, np.rot90(numbers, side)) for side in range(4))


def _beside(around: FloatArray, palette: UInt8[np.ndarray, "colours 3"], numbers: Indices) -> float:
    """That share of the upper side: the ring's colours in the light of the cells beside them."""
    codes = palette.astype(float)
    light = (around[RINGS, RINGS:-RINGS] @ LUMA + DARK) / (codes[numbers[0]] @ LUMA + DARK)
    rings = np.clip((around[:RINGS, RINGS:-RINGS][::-1] + DARK) / light[:, None] - DARK, 0.0, 255.0)
    lab = cell_lab(rings)
    of_drawing = np.linalg.norm(lab[0][:, None] - cell_lab(codes), axis=-1).min(axis=-1) < APART
    changes = np.linalg.norm(np.diff(lab, axis=0), axis=-1) > APART
    first = np.where(changes.any(axis=0), changes.argmax(axis=0), RINGS)
    return max(float(np.mean(of_drawing & (first == ring))) for ring in range(RINGS - 1))
