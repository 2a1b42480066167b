"""Mixtures: the shares of at most three yarns whose light mixes to a tone.

The shares w make  |M (Σ w l - c)| + PENALTY Σ w d  least: l is the yarns' light, c that of the tone, M the slope of
CIELAB with light at c, its chroma weighted as in CIEDE2000, and d the CIEDE2000 of each yarn to the tone, so that of
mixtures of one tone that of the nearest yarns is taken. Light mixes linearly.
"""

import math

import numpy as np

from ilmek.arrays import FloatArray, IntArray
from ilmek.carpet.colour import XYZ_TO_RGB, lab_to_xyz
from ilmek.carpet.colour_difference import ciede2000
from ilmek.carpet.light import LIGHT, lab_of_light
from ilmek.num.compiled import compiled

PENALTY = 0.5
"""Weight of the differences of the yarns from the tone, against the difference of the mixture."""

MOST_TRIED = 16
"""Yarns that are tried: those nearest to the tone."""

FLAT = 2.0
"""A tone that is as near to a yarn takes that yarn [CIEDE2000]."""

LEAST_SHARE = 0.05
"""Lesser shares are left out: they would be single dots, not a tone."""

WHITE = float(LIGHT[255])


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
        apart += shares[k] * far[yarns[k]]
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
def _whole(yarns: IntArray, shares: FloatArray, dark: IntArray) -> None:
    """Leave out the lesser shares, and sort the yarns from dark to light."""
    total = 0.0
    for k in range(3):
        shares[k] = shares[k] if shares[k] >= LEAST_SHARE else 0.0
        total += shares[k]
    for k in range(3):
        shares[k] /= total
    for a, b in ((0, 1), (1, 2), (0, 1)):
        if dark[yarns[b]] < dark[yarns[a]]:
            yarns[a], yarns[b] = yarns[b], yarns[a]
            shares[a], shares[b] = shares[b], shares[a]


@compiled
def mix(  # noqa: PLR0917
    tones: FloatArray, labs: FloatArray, lights: FloatArray, dark: IntArray, strength: float, yarns: IntArray,
    shares: FloatArray
) -> None:  # fmt: skip
    """Write the yarns, from dark to light, and the shares of the mixture of each tone.

    tones  linear light, 1 is white (tones, 3)     labs, lights  CIELAB and light of the yarns
    dark   order of the yarns from dark to light    strength      the tone aimed at lies at this share of the path from
                                                                   the light of the nearest yarn to that of the tone
    """
    count = len(labs)
    off, far, matrix = np.empty((count, 3)), np.empty(count), np.empty((3, 3))
    for tone in range(len(tones)):
        light = tones[tone].copy()
        lightness, a, b = lab_of_light(WHITE * light[0], WHITE * light[1], WHITE * light[2])
        for yarn in range(count):
            far[yarn] = ciede2000(lightness, a, b, labs[yarn, 0], labs[yarn, 1], labs[yarn, 2])
        tried = np.argsort(far, kind="mergesort")[:MOST_TRIED]
        nearest = tried[0]
        yarns[tone, :] = nearest
        shares[tone, 0], shares[tone, 1], shares[tone, 2] = 1.0, 0.0, 0.0
        if far[nearest] <= FLAT:
            continue
        for channel in range(3):
            aim = strength * light[channel] + (1.0 - strength) * lights[nearest, channel]
            light[channel] = min(max(aim, 0.0), 1.0)
        _slope(light, matrix)
        for yarn in range(count):
            for axis in range(3):
                off[yarn, axis] = 0.0
                for channel in range(3):
                    off[yarn, axis] += matrix[axis, channel] * (lights[yarn, channel] - light[channel])
        _best_mixture(off, far, tried, yarns[tone], shares[tone])
        _whole(yarns[tone], shares[tone], dark)
