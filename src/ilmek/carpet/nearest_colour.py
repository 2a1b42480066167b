"""Nearest colour of a list by CIEDE2000, exact.

CIELAB is divided into cubes of SIDE. When a colour of a cube comes first, the list is put in the order of a
proven lower bound of CIEDE2000 to the cube, its nearest colour in front. A search then ends where the bound is above
the least difference so far: after two or three of sixteen colours. A colour outside of the cubes goes through the whole
list.
"""

import math
from typing import NamedTuple

import numpy as np

from ilmek.arrays import BoolArray, Float, FloatArray, Indices, UInt8
from ilmek.carpet.colour_difference import ciede2000, least_square, least_turned, lightness_weight, saturation
from ilmek.num.compiled import compiled, embedded, uncounted

SIDE = 8
"""Side of a cube of CIELAB."""

_ALONG, _LIGHTNESSES = 256 // SIDE, 104 // SIDE
"""Cubes along a and b, -128 to 128, and along the lightness, 0 to 104."""

_SLACK = 1.0 + 1e-9


class NearestSearch(NamedTuple):
    """A list of colours, and what is known of it.

    labs, chromas  CIELAB (colours, 3) and chroma of each
    known  of each cube whether its order is known; the last one is for the colours outside
    order  (cubes, colours): indices      bounds  of CIEDE2000² to the cube; the first one's is not used
    """

    labs: FloatArray
    chromas: FloatArray
    known: BoolArray
    order: Indices
    bounds: FloatArray


def nearest_search(labs: Float[np.ndarray, "colours 3"]) -> NearestSearch:
    """The search in a list of at most 256 colours in CIELAB."""
    cubes = _LIGHTNESSES * _ALONG**2 + 1
    return NearestSearch(
        np.ascontiguousarray(labs, dtype=float),
        np.hypot(labs[:, 1], labs[:, 2]),
        np.zeros(cubes, dtype=bool),
        np.empty((cubes, len(labs)), dtype=np.uint8),  # memory that is never touched costs nothing
        np.empty((cubes, len(labs))),
    )


@compiled
def cube_bound(  # noqa: PLR0917
    l1: float, a1: float, b1: float, half: float, l2: float, a2: float, b2: float
) -> float:
    """A lower bound of CIEDE2000² of a colour 2 to any colour of a cube around 1, of twice `half` a side.

    As `least_square`, with the least of each difference and the greatest of each weight in the cube.
    """
    chroma, other, reach = math.sqrt(a1 * a1 + b1 * b1), math.sqrt(a2 * a2 + b2 * b2), math.sqrt(2.0) * half
    most = 0.5 * (chroma + reach + other)
    stretch = 1.5 - 0.5 * saturation(most)
    largest = (1.5 - 0.5 * saturation(0.5 * (max(chroma - reach, 0.0) + other))) * most
    weight = max(lightness_weight(0.5 * (l1 - half + l2)), lightness_weight(0.5 * (l1 + half + l2)))
    lightness = max(abs(l2 - l1) - half, 0.0) / weight
    green, blue = max(abs(a2 - a1) - half, 0.0), max(abs(b2 - b1) - half, 0.0)
    plane = ((stretch * green) ** 2 + blue**2) / (1.0 + 0.045 * largest) ** 2
    return lightness * lightness + least_turned(b1 - half, b2, largest) * plane


@compiled
def _sort(search: NearestSearch, cube: int) -> None:
    """Put the list in its order for a cube."""
    count = len(search.labs)
    search.known[cube] = True
    if cube == len(search.known) - 1:
        for colour in range(count):
            search.order[cube, colour], search.bounds[cube, colour] = colour, 0.0
        return
    half = 0.5 * SIDE
    lightness = SIDE * (cube // _ALONG**2) + half
    a, b = SIDE * (cube // _ALONG % _ALONG) + half - 128.0, SIDE * (cube % _ALONG) + half - 128.0
    chroma = math.sqrt(a * a + b * b)
    bounds, middles = np.empty(count), np.empty(count)
    for colour in range(count):
        l2, a2, b2 = search.labs[colour, 0], search.labs[colour, 1], search.labs[colour, 2]
        bounds[colour] = cube_bound(lightness, a, b, half, l2, a2, b2)
        middles[colour] = least_square(lightness, a, b, l2, a2, b2, 0.5 * (chroma + search.chromas[colour]))
    first = int(np.argmin(middles))
    search.order[cube, 0], search.bounds[cube, 0] = first, 0.0
    place = 1
    for colour in np.argsort(bounds, kind="mergesort"):
        if colour != first:
            search.order[cube, place], search.bounds[cube, place] = colour, bounds[colour]
            place += 1


@embedded
def nearest_of(search: NearestSearch, lightness: float, a: float, b: float) -> tuple[int, float]:
    """Index and CIEDE2000 of the colour of a list that is nearest to a colour; of equal ones the first in the list."""
    cube = len(search.known) - 1
    if 0.0 <= lightness < SIDE * _LIGHTNESSES and abs(a) < 128.0 and abs(b) < 128.0:
        cube = (int(lightness) // SIDE * _ALONG + int(a + 128.0) // SIDE) * _ALONG + int(b + 128.0) // SIDE
    if not search.known[cube]:
        _sort(search, cube)
    labs, chroma = search.labs, math.sqrt(a * a + b * b)
    best = int(search.order[cube, 0])
    least = ciede2000(lightness, a, b, labs[best, 0], labs[best, 1], labs[best, 2])
    for place in range(1, len(labs)):
        most = least * least * _SLACK
        if search.bounds[cube, place] > most:
            break
        colour = int(search.order[cube, place])
        l2, a2, b2 = labs[colour, 0], labs[colour, 1], labs[colour, 2]
        if least_square(lightness, a, b, l2, a2, b2, 0.5 * (chroma + search.chromas[colour])) <= most:
            difference = ciede2000(lightness, a, b, l2, a2, b2)
            if difference < least or (difference == least and colour < best):
                best, least = colour, difference
    return best, least


@uncounted
def _nearest(
    colours: FloatArray, search: NearestSearch, index: UInt8[np.ndarray, " colours"], delta: FloatArray
) -> None:
    for i in range(len(colours)):
        index[i], delta[i] = nearest_of(search, colours[i, 0], colours[i, 1], colours[i, 2])


def nearest(
    colours: Float[np.ndarray, "colours 3"], yarns: Float[np.ndarray, "yarns 3"]
) -> tuple[UInt8[np.ndarray, " colours"], Float[np.ndarray, " colours"]]:
    """Index of the yarn nearest to each colour by CIEDE2000, and its difference; for equal ones the first in the list.

    colours, yarns  CIELAB, at most 256 yarns
    Yarns are excluded only by a proven lower bound, so the result is exact.
    """
    index, delta = np.empty(len(colours), dtype=np.uint8), np.empty(len(colours))
    _nearest(np.ascontiguousarray(colours), nearest_search(yarns), index, delta)
    return index, delta
