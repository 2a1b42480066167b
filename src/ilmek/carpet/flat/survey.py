"""Survey: a sample of the pixels of a picture, and what surrounds each of them.

A pixel lies in an *area* if its 3 × 3 pixels are alike up to the noise. It lies on a *ridge* if, across one of four
directions, it differs from both sides in the same sense: lines and dots have no area, but they have ridges. On a *ramp*
its colour lies between those of two opposite neighbours: an edge that is not sharp.

The sample is mirrored and turned with the picture.
"""

import numpy as np

from ilmek.arrays import Int64, Rgb, UInt8
from ilmek.num.compiled import uncounted
from ilmek.records import record

_SAMPLE = 200_000
"""Pixels of the sample, about."""


@record
class Survey:
    """The sampled pixels.

    codes   their sRGB                    means  mean sRGB of their 3 × 3 pixels
    spread  largest range of a channel over the 3 × 3 pixels
    ridge   contrast to both sides of a line through the pixel; 0: none
    ramp    contrast of the two opposite neighbours that the pixel lies between; 0: none
    beside  sRGB beside the ridge
    """

    codes: UInt8[np.ndarray, "pixels 3"]
    means: UInt8[np.ndarray, "pixels 3"]
    spread: UInt8[np.ndarray, " pixels"]
    ridge: UInt8[np.ndarray, " pixels"]
    ramp: UInt8[np.ndarray, " pixels"]
    beside: UInt8[np.ndarray, "pixels 3"]


def sample_positions(length: int, step: int) -> Int64[np.ndarray, " positions"]:
    """Every `step`-th pixel of a side, counted from both of its ends.

    >>> sample_positions(9, 3).tolist()
    [1, 4, 7]
    """
    position = np.arange(length)
    return np.asarray(position[np.minimum(position, length - 1 - position) % step == step // 2])


def survey(rgb: Rgb) -> Survey:
    """The survey of a picture."""
    height, width = rgb.shape[:2]
    step = max(1, round((height * width / _SAMPLE) ** 0.5))
    step = min(step, (min(height, width) + 1) // 2)
    rows, columns = sample_positions(height, step), sample_positions(width, step)
    size = len(rows) * len(columns)
    survey = Survey(
        np.empty((size, 3), np.uint8),
        np.empty((size, 3), np.uint8),
        np.empty(size, np.uint8),
        np.empty(size, np.uint8),
        np.empty(size, np.uint8),
        np.zeros((size, 3), np.uint8),
    )
    _survey(rgb, rows, columns, survey.codes, survey.means, survey.spread, survey.ridge, survey.ramp, survey.beside)
    return survey


@uncounted
def _inside(position: int, length: int) -> int:
    return min(max(position, 0), length - 1)


@uncounted
def _profile(rgb: Rgb, y: int, x: int, down: int, right: int) -> tuple[int, int, int, int]:
    """Contrast of the ridge and of the ramp at a pixel along one direction; row and column of a pixel beside it."""
    height, width = rgb.shape[:2]
    ridge = ramp = 0
    row, column = y, x
    for before in range(1, 3):
        up, left = _inside(y - before * down, height), _inside(x - before * right, width)
        for behind in range(1, 3):
            low, far = _inside(y + behind * down, height), _inside(x + behind * right, width)
            product = least = most = 0
            for channel in range(3):
                one = int(np.int64(rgb[y, x, channel])) - int(np.int64(rgb[up, left, channel]))
                two = int(np.int64(rgb[y, x, channel])) - int(np.int64(rgb[low, far, channel]))
                product += one * two
                least, most = max(least, abs(one)), max(most, abs(two))
            if product > 0 and min(least, most) > ridge:
                ridge = min(least, most)
                row, column = up, left
            elif product < 0 and before == 1 and behind == 1 and 4 * min(least, most) > max(least, most):
                ramp = least + most
    return ridge, min(ramp, 255), row, column


@uncounted
def _survey(  # noqa: PLR0917
    rgb: Rgb,
    rows: Int64[np.ndarray, " rows"],
    columns: Int64[np.ndarray, " columns"],
    codes: UInt8[np.ndarray, "pixels 3"],
    means: UInt8[np.ndarray, "pixels 3"],
    spreads: UInt8[np.ndarray, " pixels"],
    ridges: UInt8[np.ndarray, " pixels"],
    ramps: UInt8[np.ndarray, " pixels"],
    beside: UInt8[np.ndarray, "pixels 3"],
) -> None:
    height, width = rgb.shape[:2]
    pixel = 0
    for y in rows:
        for x in columns:
            spread = 0
            for channel in range(3):
                least, most, total = 255, 0, 0
                for down in range(-1, 2):
                    for right in range(-1, 2):
                        code = int(np.int64(rgb[_inside(y + down, height), _inside(x + right, width), channel]))
                        least, most = min(least, code), max(most, code)
                        total += code
                spread = max(spread, most - least)
                codes[pixel, channel] = rgb[y, x, channel]
                means[pixel, channel] = (2 * total + 9) // 18
            spreads[pixel] = spread
            ridge = ramp = 0
            if spread > 3:
                for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
                    here, slope, row, column = _profile(rgb, y, x, down, right)
                    ramp = max(ramp, slope)
                    if here > ridge:
                        ridge = here
                        for channel in range(3):
                            beside[pixel, channel] = rgb[row, column, channel]
            ridges[pixel], ramps[pixel] = ridge, ramp
            pixel += 1
