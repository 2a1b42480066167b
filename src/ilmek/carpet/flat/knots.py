"""Knots: one label for each knot, from the labels of the pixels.

Area rule. A knot takes the label with the largest area of its cell.

Line rule. A line takes each knot at whose centre line it crosses the knot (`lines`).

Dot rule. A dot between four centres crosses no centre line. It takes the knot, of those four, that has the most of it.

Ties are decided by the colours and by the distance from the centre of the picture, never by the order of the scan: the
mirror image of a picture gives the mirror image of the chart. All areas are integers.
"""

import numpy as np

from ilmek.arrays import Indices, Int64, IntArray, NumberArray, UInt8
from ilmek.carpet.flat.areas import NONE, area_share, take_knot
from ilmek.carpet.flat.lines import centre_lines, claim_lines
from ilmek.num.compiled import compiled, uncounted
from ilmek.progress import SILENT, Progress

_SLICE = 1 << 21
_LEAST_DOT = 0.25
"""Least area of a dot, in knots."""


@uncounted
def _is_even(labels: UInt8[np.ndarray, "h w"], top: int, bottom: int, left: int, right: int) -> bool:
    """Whether a rectangle has one label."""
    own = labels[top, left]
    for y in range(top, bottom):
        for x in range(left, right):
            if labels[y, x] != own:
                return False
    return True


@uncounted
def _clear(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"], top: int, bottom: int, left: int, right: int, areas: IntArray
) -> None:
    for y in range(top, bottom):
        for x in range(left, right):
            areas[labels[y, x]] = 0


@uncounted
def _largest(labels: UInt8[np.ndarray, "h w"], rows: int, columns: int, row: int, column: int, areas: IntArray) -> int:  # noqa: PLR0917
    """The label with the largest area of a cell; `areas` is zero before and after."""
    height, width = labels.shape
    top, bottom = row * height // rows, ((row + 1) * height - 1) // rows + 1
    left, right = column * width // columns, ((column + 1) * width - 1) // columns + 1
    if _is_even(labels, top, bottom, left, right):
        return int(labels[top, left])
    best = 0
    for y in range(top, bottom):
        deep = min((row + 1) * height, (y + 1) * rows) - max(row * height, y * rows)
        for x in range(left, right):
            wide = min((column + 1) * width, (x + 1) * columns) - max(column * width, x * columns)
            areas[labels[y, x]] += deep * wide
    for y in range(top, bottom):
        for x in range(left, right):
            label = int(labels[y, x])
            if areas[label] > areas[best] or (areas[label] == areas[best] and label < best):
                best = label
    _clear(labels, top, bottom, left, right, areas)
    return best


@compiled
def _vote(labels: UInt8[np.ndarray, "h w"], rows: int, first: int, knots: Indices) -> None:
    areas = np.zeros(256, dtype=np.int64)
    for index in range(knots.shape[0]):
        for column in range(knots.shape[1]):
            knots[index, column] = _largest(labels, rows, knots.shape[1], first + index, column, areas)


@compiled
def _claim_dots(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"],
    knots: Indices,
    across: IntArray,
    down: IntArray,
    claims: Indices,
    shares: NumberArray,
    first: int,
    stop: int,
) -> None:
    rows, columns = knots.shape
    height, width = labels.shape
    areas = np.zeros(256, dtype=np.int64)
    for row in range(first, stop):
        top, bottom = down[row, 1] + 1, down[row + 1, 0]
        for column in range(columns - 1):
            left, right = across[column, 1] + 1, across[column + 1, 0]
            if top >= bottom or left >= right or _is_even(labels, top, bottom, left, right):
                continue
            for y in range(top, bottom):
                for x in range(left, right):
                    areas[labels[y, x]] += rows * columns
            for label in range(NONE):
                large = areas[label] >= _LEAST_DOT * height * width
                if large and not _on_frame(labels, top, bottom, left, right, label):
                    _claim_dot(labels, knots, claims, shares, row, column, label)
            _clear(labels, top, bottom, left, right, areas)


@uncounted
def _on_frame(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"], top: int, bottom: int, left: int, right: int, label: int
) -> bool:
    """Whether a label occurs on the centre lines around a rectangle."""
    height, width = labels.shape
    for x in range(max(left - 1, 0), min(right + 1, width)):
        if labels[max(top - 1, 0), x] == label or labels[min(bottom, height - 1), x] == label:
            return True
    for y in range(top, bottom):
        if labels[y, max(left - 1, 0)] == label or labels[y, min(right, width - 1)] == label:
            return True
    return False


@uncounted
def _claim_dot(  # noqa: PLR0917
    labels: UInt8[np.ndarray, "h w"],
    knots: Indices,
    claims: Indices,
    shares: NumberArray,
    row: int,
    column: int,
    label: int,
) -> None:
    rows, columns = knots.shape
    most = 0
    for down in range(2):
        for right in range(2):
            if knots[row + down, column + right] == label:
                return
            most = max(most, area_share(labels, rows, columns, row + down, column + right, label))
    nearest = rows + columns + 2
    for down in range(2):
        for right in range(2):
            far = abs(2 * (row + down) + 1 - rows) + abs(2 * (column + right) + 1 - columns)
            if area_share(labels, rows, columns, row + down, column + right, label) == most:
                nearest = min(nearest, far)
    for down in range(2):
        for right in range(2):
            far = abs(2 * (row + down) + 1 - rows) + abs(2 * (column + right) + 1 - columns)
            share = area_share(labels, rows, columns, row + down, column + right, label)
            if share == most and far == nearest:
                take_knot(claims, shares, row + down, column + right, label, share)


def knot_labels(
    labels: UInt8[np.ndarray, "height width"], grid: tuple[int, int], progress: Progress = SILENT
) -> Indices:
    """The label of each knot."""
    if labels.shape == grid:
        return labels
    (height, width), (rows, columns) = labels.shape, grid
    knots = np.empty(grid, dtype=np.uint8)
    step = max(1, _SLICE // (width * -(-height // rows) + columns))
    for first in range(0, rows, step):
        _vote(labels, rows, first, knots[first : first + step])
        progress(0.4 * min(first + step, rows) / rows)
    claims, shares = np.full(grid, NONE, dtype=np.uint8), np.zeros(grid, dtype=np.uint16)
    claim_lines(labels, knots, claims, claims, shares, progress.part(0.4, 0.6))
    np.copyto(knots, claims, where=claims != NONE)
    second = np.full(grid, NONE, dtype=np.uint8)
    shares[:] = 0
    claim_lines(labels, knots, claims, second, shares, progress.part(0.6, 0.8))
    np.copyto(knots, second, where=second != NONE)
    np.copyto(claims, second, where=second != NONE)
    second[:] = NONE
    shares[:] = 0
    across, down = _frames(*centre_lines(width, columns)), _frames(*centre_lines(height, rows))
    for first in range(0, rows - 1, step):
        _claim_dots(labels, knots, across, down, second, shares, first, min(first + step, rows - 1))
        progress(0.8 + 0.2 * min(first + step, rows) / rows)
    np.copyto(knots, second, where=(second != NONE) & (claims == NONE))
    return knots


def _frames(pixels: IntArray, index: IntArray) -> Int64[np.ndarray, "cells 2"]:
    """The first and the last centre line of each cell."""
    begin = np.flatnonzero(np.diff(index, prepend=-1))
    end = np.flatnonzero(np.diff(index, append=index[-1] + 1))
    return np.stack([pixels[begin], pixels[end]], axis=-1)
