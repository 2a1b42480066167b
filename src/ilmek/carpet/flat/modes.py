"""Modes: the summits of a distribution of colours, and the colours that belong to each.

The colours are counted in cells of the sRGB cube. From the densest cell down, each cell joins the summit of its densest
neighbour; two summits are one if the saddle between them is not clearly lower than the lower of both (clustering by
persistence: Chazal, Guibas, Oudot, Skraba, Persistence-based clustering in Riemannian manifolds, 2013). A dye that
changes from row to row makes a ridge in the cube, and stays one summit.
"""

import numpy as np

from ilmek.arrays import Float, FloatArray, Int64, IntArray, UInt8
from ilmek.num.compiled import compiled

_BITS = 6
_SIDE = 1 << _BITS


def modes(
    codes: UInt8[np.ndarray, "pixels 3"], least: int
) -> tuple[Float[np.ndarray, "modes 3"], Int64[np.ndarray, " modes"]]:
    """Mean sRGB codes of each mode with at least `least` pixels, and its pixels, most first."""
    if len(codes) == 0:
        return np.empty((0, 3)), np.empty(0, dtype=np.int64)
    cells = _cells(codes)
    counts = np.bincount(cells, minlength=_SIDE**3)
    density = _smoothed(counts)
    occupied = np.flatnonzero(counts)
    order = occupied[np.lexsort((occupied, -density[occupied]))]
    root = np.full(_SIDE**3, -1, dtype=np.int64)
    _climb(order, density, root)
    group = root[cells]
    core = density[cells] >= 0.25 * density[group]
    size = np.bincount(group, minlength=_SIDE**3)
    summits = np.flatnonzero(size >= least)
    summits = summits[np.lexsort((summits, -size[summits]))]
    weight = np.bincount(group[core], minlength=_SIDE**3)[summits]
    means = [np.bincount(group[core], codes[core, i].astype(float), _SIDE**3)[summits] / weight for i in range(3)]
    return np.stack(means, axis=-1), size[summits]


def _cells(codes: UInt8[np.ndarray, "pixels 3"]) -> Int64[np.ndarray, " pixels"]:
    red, green, blue = (codes.astype(np.int64) >> (8 - _BITS)).T
    return np.asarray((red << 2 * _BITS) | (green << _BITS) | blue)


def _smoothed(counts: IntArray) -> IntArray:
    """Sums over a cell and its neighbours along each axis, weights 1, 2, 1."""
    cube = counts.reshape(_SIDE, _SIDE, _SIDE)
    for axis in range(3):
        padded = np.pad(cube, [(1, 1) if each == axis else (0, 0) for each in range(3)])
        middle = [slice(1, -1) if each == axis else slice(None) for each in range(3)]
        below = [slice(None, -2) if each == axis else slice(None) for each in range(3)]
        above = [slice(2, None) if each == axis else slice(None) for each in range(3)]
        cube = 2 * padded[tuple(middle)] + padded[tuple(below)] + padded[tuple(above)]
    return np.asarray(cube.ravel())


@compiled
def _summit(root: IntArray, cell: int) -> int:
    while root[cell] != cell:
        root[cell] = root[root[cell]]
        cell = root[cell]
    return cell


@compiled
def _climb(order: IntArray, density: FloatArray, root: IntArray) -> None:
    for cell in order:
        red, green, blue = cell >> 2 * _BITS, (cell >> _BITS) & (_SIDE - 1), cell & (_SIDE - 1)
        best = -1
        around = [cell for _ in range(0)]
        for r in range(max(red - 1, 0), min(red + 2, _SIDE)):
            for g in range(max(green - 1, 0), min(green + 2, _SIDE)):
                for b in range(max(blue - 1, 0), min(blue + 2, _SIDE)):
                    other = (r << 2 * _BITS) | (g << _BITS) | b
                    if root[other] >= 0:
                        summit = _summit(root, other)
                        around.append(summit)
                        higher = best < 0 or density[summit] > density[best]
                        if higher or (density[summit] == density[best] and summit < best):
                            best = summit
        root[cell] = cell if best < 0 else best
        for summit in around:
            lower = _summit(root, summit)
            if lower != best and density[lower] - density[cell] < _height(density[lower]):
                root[lower] = best
    for cell in order:
        root[cell] = _summit(root, cell)


@compiled
def _height(density: float) -> float:
    """The least height of a summit over its saddle; densities are 64 times a number of pixels."""
    return float(max(0.35 * density, 24.0 * density**0.5))
