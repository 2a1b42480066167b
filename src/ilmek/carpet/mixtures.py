"""Mixtures: the shares of at most three yarns whose light mixes to a tone.

The shares w make  |M (Σ w l - c)| + PENALTY Σ w d²  least: l is the yarns' light, c that of the tone, M the slope of
CIELAB with light at c, its chroma weighted as in CIEDE2000, and d the CIEDE2000 of each yarn to the tone, so that of
mixtures of one tone that which shows least is taken. Light mixes linearly.

A yarn is in a mixture only where its contrast d with the tone is at most min(CONTRAST, NEAR + WIDER n²), n that of the
nearest yarn, and no more than a tone with the picture's mean of n has [`greatest_contrast`]: a tone that nearly is a
yarn has no strong dots, whatever they would better, and a picture in shades of its own has none. Its difference to the
tone in a, b, divided by 1 + 0.045 C as in CIEDE2000, is at most CHROMA where CONTRAST is allowed, and less in
proportion: yarns of other hues make no skin, and no grey. A yarn of few dots, each of which shows, is left out.
"""

import math

import numpy as np

from ilmek.arrays import FloatArray, IntArray, UInt8
from ilmek.carpet.colour import XYZ_TO_RGB, lab_to_xyz
from ilmek.carpet.colour_difference import ciede2000
from ilmek.carpet.light import LIGHT, lab_of_light
from ilmek.num.compiled import compiled

PENALTY = 1 / 160
"""Weight of the contrast of the yarns with the tone, against the difference of the mixture [1/CIEDE2000]."""

MOST_TRIED = 8
"""Yarns that are tried: those nearest to the tone. Of many shades of one picture, farther ones would only show."""

FLAT = 0.5
"""A tone that is as near to a yarn takes that yarn [CIEDE2000]."""

SPARSE, SHOWING = 0.05, 8.0
"""A yarn with a lesser share of a mixture is left out of it if its contrast with the tone is greater [CIEDE2000]."""

CONTRAST = 31.0
"""Greatest contrast of a yarn of a mixture with its tone [CIEDE2000]."""

CHROMA = 24.0
"""Greatest difference of a yarn of a mixture to its tone in a, b, weighted as in CIEDE2000."""

NEAR, WIDER = 6.0, 0.5
"""Greatest contrast with a tone that is a yarn [CIEDE2000], and what the square of its difference to the nearest adds
[1/CIEDE2000]; with less, charts of ten photographs are beyond 1.1 times error diffusion across the room.
"""

SLOPES = 16
"""Whole numbers of a unit of the slope."""

WHITE = float(LIGHT[255])


def greatest_contrast(mean: float) -> float:
    """Greatest contrast of a yarn of a mixture with its tone, of a picture whose yarns differ by `mean` from it.

    >>> greatest_contrast(2.0), greatest_contrast(9.0)
    (8.0, 31.0)
    """
    return min(CONTRAST, NEAR + WIDER * mean**2)


def yarn_lights(labs: FloatArray) -> FloatArray:
    """Linear light (1 is white) of the CIELAB of each yarn; a yarn beyond sRGB has a negative channel."""
    return np.ascontiguousarray(lab_to_xyz(labs) @ XYZ_TO_RGB.T)


@compiled
def _slope(light: FloatArray, matrix: FloatArray) -> None:
    """The slope of CIELAB with light, its chroma weighted as in CIEDE2000."""
    lab, there = np.empty(3), np.empty(3)
    lab[0], lab[1], lab[2] = lab_of_light(WHITE * light[0], WHITE * light[1], WHITE * light[2])
    chroma = 1.0 + 0.045 * math.sqrt(lab[1] * lab[1] + lab[2] * lab[2])
    for channel in range(3):
        step = light.copy()
        step[channel] += 1e-4
        there[0], there[1], there[2] = lab_of_light(WHITE * step[0], WHITE * step[1], WHITE * step[2])
        for axis in range(3):
            matrix[axis, channel] = (there[axis] - lab[axis]) * 1e4 / (chroma if axis else 1.0)


@compiled
def _dot(one: FloatArray, other: FloatArray) -> float:
    return float(one[0] * other[0] + one[1] * other[1] + one[2] * other[2])


@compiled
def _cost(off: FloatArray, far: FloatArray, yarns: tuple[int, int, int], shares: tuple[float, float, float]) -> float:
    square, apart = 0.0, 0.0
    for axis in range(3):
        square += (
            shares[0] * off[yarns[0], axis] + shares[1] * off[yarns[1], axis] + shares[2] * off[yarns[2], axis]
        ) ** 2
    for k in range(3):
        apart += shares[k] * far[yarns[k]] * far[yarns[k]]
    return math.sqrt(square) + PENALTY * apart


@compiled
def _best_mixture(off: FloatArray, far: FloatArray, tried: IntArray, yarns: IntArray, shares: FloatArray) -> None:
    """Write the yarns and shares of least cost.

    off  of each yarn from the tone, in CIELAB by the slope      far  CIEDE2000 of each yarn to the tone
    """
    least = np.inf
    for a in range(len(tried)):
        i = tried[a]
        for b in range(a, len(tried)):
            j = tried[b]
            u = off[j] - off[i]
            uu, ui = _dot(u, u), -_dot(u, off[i])
            share = min(max(ui / uu, 0.0), 1.0) if uu > 0.0 else 0.0
            cost = _cost(off, far, (i, j, j), (1.0 - share, share, 0.0))
            if cost < least:
                least = cost
                yarns[0], yarns[1], yarns[2] = i, j, j
                shares[0], shares[1], shares[2] = 1.0 - share, share, 0.0
            for c in range(b + 1, len(tried) if b > a else 0):
                k = tried[c]
                v = off[k] - off[i]
                uv, vv, vi = _dot(u, v), _dot(v, v), -_dot(v, off[i])
                determinant = uu * vv - uv * uv
                if determinant <= 1e-9 * uu * vv:
                    continue
                second, third = (ui * vv - vi * uv) / determinant, (vi * uu - ui * uv) / determinant
                if second < 0.0 or third < 0.0 or second + third > 1.0:
                    continue
                cost = _cost(off, far, (i, j, k), (1.0 - second - third, second, third))
                if cost < least:
                    least = cost
                    yarns[0], yarns[1], yarns[2] = i, j, k
                    shares[0], shares[1], shares[2] = 1.0 - second - third, second, third


@compiled
def _leave_out_specks(far: FloatArray, yarns: UInt8[np.ndarray, "3"], shares: FloatArray) -> None:
    """Leave a yarn out of a mixture whose dots would be few and each would show; the others keep their proportions."""
    whole = 0.0
    for k in range(3):
        if shares[k] < SPARSE and far[yarns[k]] > SHOWING:
            shares[k] = 0.0
        whole += shares[k]
    first = np.argmax(shares)
    for k in range(3):
        shares[k] /= whole
        if shares[k] == 0.0:
            yarns[k] = yarns[first]


@compiled
def _allowed(far: FloatArray, labs: FloatArray, a: float, b: float, most: float, tried: IntArray) -> int:  # noqa: PLR0917
    """Write the yarns that a mixture of a tone may have, the nearest first; returns their number."""
    count, weight = 0, 1.0 + 0.045 * math.hypot(a, b)
    order = np.argsort(far, kind="mergesort")
    contrast = min(most, NEAR + WIDER * far[order[0]] ** 2)
    chroma = CHROMA / CONTRAST * contrast
    for yarn in order:
        apart = math.hypot(labs[yarn, 1] - a, labs[yarn, 2] - b) / weight
        if count < len(tried) and (count == 0 or (far[yarn] <= contrast and apart <= chroma)):
            tried[count] = yarn
            count += 1
    return count


@compiled
def mix(  # noqa: PLR0917
    tone: FloatArray, labs: FloatArray, lights: FloatArray, strength: float, contrast: float,
    yarns: UInt8[np.ndarray, "3"], aim: IntArray, position: IntArray, slope: IntArray
) -> None:  # fmt: skip
    """Write the mixture of a tone in whole numbers.

    yarns  of the mixture      aim  its light in units of LIGHT
    position  of each yarn, as seen from the mixture: axes of CIELAB in units of 1/(256 SLOPES)
    slope  of CIELAB with light there, in units of SLOPES

    tone  linear light, 1 is white      labs, lights  CIELAB and light of the yarns
    contrast  greatest of a yarn with the tone [CIEDE2000]
    strength  the light aimed at lies at this share of the path from that of the nearest yarn to that of the tone
    """
    count = len(labs)
    off, far, matrix = np.empty((count, 3)), np.empty(count), np.empty((3, 3))
    tried, shares, light = np.empty(MOST_TRIED, dtype=np.int64), np.zeros(3), np.empty(3)
    lightness, a, b = lab_of_light(WHITE * tone[0], WHITE * tone[1], WHITE * tone[2])
    for yarn in range(count):
        far[yarn] = ciede2000(lightness, a, b, labs[yarn, 0], labs[yarn, 1], labs[yarn, 2])
    some = _allowed(far, labs, a, b, contrast, tried)
    yarns[:], shares[0] = tried[0], 1.0
    for channel in range(3):
        light[channel] = min(max(strength * tone[channel] + (1.0 - strength) * lights[tried[0], channel], 0.0), 1.0)
    _slope(light, matrix)
    if far[tried[0]] > FLAT:
        for yarn in range(count):
            for axis in range(3):
                off[yarn, axis] = 0.0
                for channel in range(3):
                    off[yarn, axis] += matrix[axis, channel] * (lights[yarn, channel] - light[channel])
        _best_mixture(off, far, tried[:some], yarns, shares)
        _leave_out_specks(far, yarns, shares)
    _in_whole_numbers(lights, shares, matrix, yarns, aim, position, slope)


@compiled
def _in_whole_numbers(  # noqa: PLR0917
    lights: FloatArray, shares: FloatArray, matrix: FloatArray, yarns: UInt8[np.ndarray, "3"], aim: IntArray,
    position: IntArray, slope: IntArray
) -> None:  # fmt: skip
    """Write the aim, positions and slope of a mixture [`mix`]; `matrix`: the slope."""
    for channel in range(3):
        mixed = 0.0
        for k in range(3):
            mixed += shares[k] * lights[yarns[k], channel]
            slope[k, channel] = round(SLOPES * matrix[k, channel])
        aim[channel] = round(WHITE * mixed)
    for k in range(3):
        for axis in range(3):
            seen = 0.0
            for channel in range(3):
                seen += matrix[axis, channel] * (WHITE * lights[yarns[k], channel] - aim[channel])
            position[k, axis] = round(SLOPES * seen / 65536)
