"""Nearest true colour of a pixel's own colour, by CIELAB."""

import numpy as np

from ilmek.arrays import FloatArray, Rgb, UInt8
from ilmek.carpet.colour import LINEAR, RGB_TO_XYZ, WHITE
from ilmek.num.compiled import uncounted

UNKNOWN = 255
_MATRIX = RGB_TO_XYZ / WHITE[:, None]


@uncounted
def _root(t: float) -> float:
    return t ** (1 / 3) if t > 216 / 24389 else (24389 / 27 * t + 16) / 116


@uncounted
def _nearest(red: int, green: int, blue: int, labs: FloatArray) -> tuple[int, float]:
    """The index of the nearest true colour, and the square of its difference."""
    r, g, b = LINEAR[red], LINEAR[green], LINEAR[blue]
    x = _root(_MATRIX[0, 0] * r + _MATRIX[0, 1] * g + _MATRIX[0, 2] * b)
    y = _root(_MATRIX[1, 0] * r + _MATRIX[1, 1] * g + _MATRIX[1, 2] * b)
    z = _root(_MATRIX[2, 0] * r + _MATRIX[2, 1] * g + _MATRIX[2, 2] * b)
    lightness, a, b = 116 * y - 16, 500 * (x - y), 200 * (y - z)
    best, least = 0, np.inf
    for label in range(labs.shape[0]):
        apart = (labs[label, 0] - lightness) ** 2 + (labs[label, 1] - a) ** 2 + (labs[label, 2] - b) ** 2
        if apart < least:
            best, least = label, apart
    return best, least


@uncounted
def raw_label(rgb: Rgb, y: int, x: int, table: UInt8[np.ndarray, " codes"], labs: FloatArray) -> int:
    """The true colour nearest to a pixel's own; `table` keeps those of the codes that have occurred."""
    red, green, blue = int(np.int64(rgb[y, x, 0])), int(np.int64(rgb[y, x, 1])), int(np.int64(rgb[y, x, 2]))
    code = red << 16 | green << 8 | blue
    if table[code] == UNKNOWN:
        table[code] = _nearest(red, green, blue, labs)[0]
    return int(table[code])


@uncounted
def label_rows(
    rgb: Rgb, table: UInt8[np.ndarray, " codes"], labs: FloatArray, labels: UInt8[np.ndarray, "h w"]
) -> None:
    """The true colour nearest to each pixel's own."""
    for y in range(rgb.shape[0]):
        for x in range(rgb.shape[1]):
            labels[y, x] = raw_label(rgb, y, x, table, labs)


@uncounted
def count_near(
    colours: UInt8[np.ndarray, "pixels 3"], table: UInt8[np.ndarray, " codes"], labs: FloatArray, difference: float
) -> int:
    """Number of colours within a difference of a true colour; `table` keeps the answers, UNKNOWN before."""
    near = 0
    for pixel in range(colours.shape[0]):
        red, green, blue = (
            int(np.int64(colours[pixel, 0])),
            int(np.int64(colours[pixel, 1])),
            int(np.int64(colours[pixel, 2])),
        )
        code = red << 16 | green << 8 | blue
        if table[code] == UNKNOWN:
            table[code] = _nearest(red, green, blue, labs)[1] <= difference * difference
        near += table[code]
    return near
