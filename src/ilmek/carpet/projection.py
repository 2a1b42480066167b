"""Projection: a picture resampled through a plane homography, in linear light.

    (x, y) = (X, Y)/Z,   (X, Y, Z) = M (u, v, 1)

(u, v) is a point of the result, (x, y) one of the picture, both in pixels. Each pixel of the result is the mean of
n × m bilinear samples; n and m are the sides of its image in the picture, rounded up but for a quarter of a pixel, so
that no pixel of the picture is skipped where the result is coarser.

Source of the closed form: P. S. Heckbert, Fundamentals of texture mapping and image warping, UCB/CSD-89-516 (1989),
2.2.3.
"""

import math

import numpy as np

from ilmek.arrays import Float, FloatArray, Rgb, UInt8
from ilmek.carpet.colour import LINEAR
from ilmek.carpet.design import bands, encoded
from ilmek.carpet.picture_points import Points
from ilmek.num.compiled import uncounted
from ilmek.num.threads import in_threads
from ilmek.progress import SILENT, Progress

Homography = Float[np.ndarray, "3 3"]

MadeRgb = UInt8[np.ndarray, "rows columns 3"]
"""A picture made from another one: its height and width are its own."""

_SLICE = 1 << 17
_SLACK = 0.25
"""Part of a pixel by which samples may be farther apart than pixels: a bilinear sample covers two."""

_MOST_SAMPLES = 8
"""Largest number of samples along a side of a pixel of the result."""


def onto_corners(width: float, height: float, corners: Points) -> Homography:
    """The homography from the rectangle (0, 0) to (width, height) onto four corners: top left, top right, bottom
    right, bottom left [Heckbert 1989, 2.2.3].

    >>> square = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    >>> (onto_corners(4.0, 2.0, square) @ [4.0, 1.0, 1.0]).tolist()
    [2.0, 1.0, 1.0]
    """
    (x0, y0), (x1, y1), (x2, y2), (x3, y3) = corners.tolist()
    sum_x, sum_y = x0 - x1 + x2 - x3, y0 - y1 + y2 - y3
    right_x, right_y, below_x, below_y = x1 - x2, y1 - y2, x3 - x2, y3 - y2
    determinant = right_x * below_y - below_x * right_y
    g = (sum_x * below_y - below_x * sum_y) / determinant
    h = (right_x * sum_y - sum_x * right_y) / determinant
    return np.array(
        [
            [(x1 - x0 + g * x1) / width, (x3 - x0 + h * x3) / height, x0],
            [(y1 - y0 + g * y1) / width, (y3 - y0 + h * y3) / height, y0],
            [g / width, h / height, 1.0],
        ]
    )


def rotation_about(angle: float, source: tuple[int, int], result: tuple[int, int]) -> Homography:
    """The homography of a result whose centre is the picture's, and in which the picture is turned clockwise.

    angle  [rad]      source, result  (height, width) of picture and result [pixels]
    """
    c, s = math.cos(angle), math.sin(angle)
    u, v, x, y = 0.5 * result[1], 0.5 * result[0], 0.5 * source[1], 0.5 * source[0]
    return np.array([[c, s, x - c * u - s * v], [-s, c, y + s * u - c * v], [0.0, 0.0, 1.0]])


@uncounted
def _samples(m: FloatArray, u: float, v: float) -> tuple[int, int]:
    """Samples of the pixel around a point of the result, across and along."""
    z = m[2, 0] * u + m[2, 1] * v + m[2, 2]
    x = (m[0, 0] * u + m[0, 1] * v + m[0, 2]) / z
    y = (m[1, 0] * u + m[1, 1] * v + m[1, 2]) / z
    across = math.hypot(m[0, 0] - x * m[2, 0], m[1, 0] - y * m[2, 0]) / abs(z)
    along = math.hypot(m[0, 1] - x * m[2, 1], m[1, 1] - y * m[2, 1]) / abs(z)
    return (
        min(max(math.ceil(across - _SLACK), 1), _MOST_SAMPLES),
        min(max(math.ceil(along - _SLACK), 1), _MOST_SAMPLES),
    )


@uncounted
def _project(rgb: Rgb, out: Rgb, first: int, m: FloatArray, outside: FloatArray, keep_edges: bool) -> None:  # noqa: PLR0917
    height, width = rgb.shape[0], rgb.shape[1]
    parallel = m[2, 0] == 0.0 and m[2, 1] == 0.0 and m[2, 2] == 1.0  # parallels stay: no point needs a division
    n, k = _samples(m, 0.5, first + 0.5)
    for row in range(out.shape[0]):
        for column in range(out.shape[1]):
            if not parallel:
                n, k = _samples(m, column + 0.5, first + row + 0.5)
            red, green, blue = 0.0, 0.0, 0.0
            for j in range(k):
                for i in range(n):
                    u, v = column + (i + 0.5) / n, first + row + (j + 0.5) / k
                    x, y = m[0, 0] * u + m[0, 1] * v + m[0, 2], m[1, 0] * u + m[1, 1] * v + m[1, 2]
                    if not parallel:
                        z = m[2, 0] * u + m[2, 1] * v + m[2, 2]
                        x, y = x / z, y / z
                    if not keep_edges and (x < 0.0 or y < 0.0 or x > width or y > height):
                        red += outside[0]
                        green += outside[1]
                        blue += outside[2]
                        continue
                    x = min(max(x - 0.5, 0.0), width - 1.0)
                    y = min(max(y - 0.5, 0.0), height - 1.0)
                    left, top = int(x), int(y)
                    right, bottom = min(left + 1, width - 1), min(top + 1, height - 1)
                    east, south = x - left, y - top
                    west, north = 1.0 - east, 1.0 - south
                    nw, ne, sw, se = west * north, east * north, west * south, east * south
                    red += nw * LINEAR[rgb[top, left, 0]] + ne * LINEAR[rgb[top, right, 0]]
                    red += sw * LINEAR[rgb[bottom, left, 0]] + se * LINEAR[rgb[bottom, right, 0]]
                    green += nw * LINEAR[rgb[top, left, 1]] + ne * LINEAR[rgb[top, right, 1]]
                    green += sw * LINEAR[rgb[bottom, left, 1]] + se * LINEAR[rgb[bottom, right, 1]]
                    blue += nw * LINEAR[rgb[top, left, 2]] + ne * LINEAR[rgb[top, right, 2]]
                    blue += sw * LINEAR[rgb[bottom, left, 2]] + se * LINEAR[rgb[bottom, right, 2]]
            out[row, column, 0] = encoded(red / (n * k))
            out[row, column, 1] = encoded(green / (n * k))
            out[row, column, 2] = encoded(blue / (n * k))


def projected(
    rgb: Rgb,
    shape: tuple[int, int],
    homography: Homography,
    outside: tuple[int, int, int] | None = None,
    progress: Progress = SILENT,
) -> MadeRgb:
    """A picture of that (height, width) whose points (u, v) show the points M (u, v, 1) of `rgb`.

    outside  colour of what lies outside the picture; default: that of the nearest pixel
    """
    rgb = np.ascontiguousarray(rgb)
    out = np.empty((*shape, 3), dtype=np.uint8)
    light = LINEAR[np.array(outside or (0, 0, 0))]
    parts = bands(*shape, _SLICE)
    for band, _ in in_threads(
        lambda band: _project(rgb, out[band], band.start, homography, light, outside is None), parts
    ):
        progress(band.stop / shape[0])
    return out


def inner_rectangle(width: int, height: int, angle: float) -> tuple[int, int]:
    """(height, width) of the largest upright rectangle in a picture that is turned by an angle [rad], rounded down.

    With s = |sin|, c = |cos| and the long side a and short side b of the picture: where b <= 2 s c a two corners of
    the rectangle lie on the middle line of the long side, and its sides are b/2s and b/2c; else all four corners lie on
    sides of the picture, and its sides are (w c - h s)/cos 2a and (h c - w s)/cos 2a.

    >>> inner_rectangle(300, 200, 0.0), inner_rectangle(100, 100, math.pi / 4)
    ((200, 300), (70, 70))
    """
    s, c = abs(math.sin(angle)), abs(math.cos(angle))
    long, short = max(width, height), min(width, height)
    if short <= 2 * s * c * long or abs(s - c) < 1e-9:
        one, other = 0.5 * short / s, 0.5 * short / c
        wide, high = (one, other) if width >= height else (other, one)
    else:
        double = c * c - s * s
        wide, high = (width * c - height * s) / double, (height * c - width * s) / double
    return max(1, int(high + 1e-9)), max(1, int(wide + 1e-9))


def outer_rectangle(width: int, height: int, angle: float) -> tuple[int, int]:
    """(height, width) of the upright rectangle around a picture that is turned by an angle [rad], rounded up."""
    s, c = abs(math.sin(angle)), abs(math.cos(angle))
    return math.ceil(width * s + height * c - 1e-9), math.ceil(width * c + height * s - 1e-9)
