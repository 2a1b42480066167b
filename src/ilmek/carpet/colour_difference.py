"""Colour difference: CIEDE2000 of two CIELAB colours, exact, compiled.

    dE² = (dL/SL)² + (dC/SC)² + (dH/SH)² + RT (dC/SC)(dH/SH)                    [Sharma, Wu, Dalal 2005, eq. 22]

The hue angles of the paper are not formed. With the unit vectors u1, u2 of the two (a', b) the same quantities are

    dH = ± sqrt(C1' C2') |u1 - u2|     (2 sin of half the angle between them), sign of the turn from u1 to u2
    mean hue = direction of u1 + u2; for a wide angle, of the normal to u1 - u2, which loses no digits

so the discontinuity at opposite hues is decided by comparing two products, not by rounded angles. The cosines of
multiples of the mean hue are polynomials in its cosine and sine. Where a chroma is zero dH = 0 and the mean hue has no
effect.

Source: G. Sharma, W. Wu, E. N. Dalal, The CIEDE2000 color-difference formula: implementation notes, supplementary test
data, and mathematical observations, Color Research and Application 30 (2005) 21-30.

>>> round(float(delta_e_2000(np.array([50.0, 2.6772, -79.7751]), np.array([50.0, 0.0, -82.7485]))), 4)
2.0425
"""

import math

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.num.compiled import compiled

_25_TO_7 = 25.0**7
_COS_30, _SIN_30 = math.cos(math.radians(30)), math.sin(math.radians(30))
_COS_6, _SIN_6 = math.cos(math.radians(6)), math.sin(math.radians(6))
_COS_63, _SIN_63 = math.cos(math.radians(63)), math.sin(math.radians(63))
_SIN_60 = math.sin(math.radians(60))
_RT_YELLOW = 2 * math.sin(math.radians(60) * math.exp(-((95 / 25) ** 2)))


@compiled
def saturation(chroma: float) -> float:
    """sqrt(C^7 / (C^7 + 25^7)), a factor of G and RC."""
    seventh = chroma * chroma * chroma
    seventh *= seventh * chroma
    return math.sqrt(seventh / (seventh + _25_TO_7))


@compiled
def lightness_weight(mean_lightness: float) -> float:
    """SL [eq. 15]."""
    squared = (mean_lightness - 50.0) ** 2
    return 1.0 + 0.015 * squared / math.sqrt(20.0 + squared)


@compiled
def mean_hue(x1: float, y1: float, x2: float, y2: float) -> tuple[float, float, float]:
    """Direction (cosine, sine) of the mean hue of two unit vectors, and the sign of the turn from the first to the
    second. Exactly opposite hues: the mean of the two angles in 0 to 360 degrees, as in the paper [eq. 14].
    """
    ahead, behind = x1 * y2, x2 * y1
    turn = 1.0 if ahead > behind else -1.0
    if ahead == behind and x1 * x2 + y1 * y2 < 0.0:
        turn = 1.0 if y1 > 0.0 or (y1 == 0.0 and x1 > 0.0) else -1.0
    if x1 * x2 + y1 * y2 >= 0.0:
        x, y = x1 + x2, y1 + y2
    else:
        x, y = (y2 - y1) * turn, (x1 - x2) * turn
    size = math.sqrt(x * x + y * y)
    return x / size, y / size, turn


@compiled
def hue_weight(c: float, s: float) -> float:
    """T of the mean hue h from its cosine and sine [eq. 16]:
    1 - 0.17 cos(h - 30°) + 0.24 cos 2h + 0.32 cos(3h + 6°) - 0.20 cos(4h - 63°).
    """
    c2, s2 = c * c - s * s, 2.0 * s * c
    c3, s3 = c2 * c - s2 * s, s2 * c + c2 * s
    c4, s4 = c2 * c2 - s2 * s2, 2.0 * s2 * c2
    once = c * _COS_30 + s * _SIN_30
    thrice = c3 * _COS_6 - s3 * _SIN_6
    fourfold = c4 * _COS_63 + s4 * _SIN_63
    return 1.0 - 0.17 * once + 0.24 * c2 + 0.32 * thrice - 0.20 * fourfold


@compiled
def rotation(c: float, s: float, mean_chroma: float) -> float:
    """RT = -RC sin(2 · 30° exp(-((h - 275°)/25°)²)) [eq. 17, 18, 21]."""
    if s > 0.0 and c > -0.5:
        return 0.0  # 0 to 120 degrees: rounded off, below 2^-54
    hue = math.degrees(math.atan2(s, c))
    hue += 360.0 if hue < 0.0 else 0.0
    return -2.0 * saturation(mean_chroma) * math.sin(math.radians(60.0 * math.exp(-(((hue - 275.0) / 25.0) ** 2))))


@compiled
def ciede2000(  # noqa: PLR0917
    l1: float, a1: float, b1: float, l2: float, a2: float, b2: float
) -> float:
    """CIEDE2000 of two CIELAB colours, kL = kC = kH = 1 [eq. 2 to 22]."""
    stretch = 1.5 - 0.5 * saturation(0.5 * (math.sqrt(a1 * a1 + b1 * b1) + math.sqrt(a2 * a2 + b2 * b2)))
    a1, a2 = stretch * a1, stretch * a2
    c1, c2 = math.sqrt(a1 * a1 + b1 * b1), math.sqrt(a2 * a2 + b2 * b2)
    mean_chroma = 0.5 * (c1 + c2)
    lightness = (l2 - l1) / lightness_weight(0.5 * (l1 + l2))
    chroma = (c2 - c1) / (1.0 + 0.045 * mean_chroma)
    if c1 == 0.0 or c2 == 0.0:
        return math.sqrt(lightness * lightness + chroma * chroma)
    x1, y1, x2, y2 = a1 / c1, b1 / c1, a2 / c2, b2 / c2
    cosine, sine, turn = mean_hue(x1, y1, x2, y2)
    apart = turn * math.sqrt(c1 * c2) * math.sqrt((x2 - x1) ** 2 + (y2 - y1) ** 2)
    hue = apart / (1.0 + 0.015 * mean_chroma * hue_weight(cosine, sine))
    square = lightness * lightness + chroma * chroma + hue * hue + rotation(cosine, sine, mean_chroma) * chroma * hue
    return math.sqrt(max(square, 0.0))


@compiled
def least_turned(b1: float, b2: float, largest: float) -> float:
    """A lower bound of (x² + y² + RT x y)/(x² + y²) of colours with b >= b1 and b2, and mean C' <= `largest`.

    It is 1 - |RT|/2 with |RT| <= RC sin 60°. With both b >= 0 the mean hue lies in 0 to 180 degrees, at least 95 from
    275, so that |RT| is below 2e-6.
    """
    most = _RT_YELLOW if b1 >= 0.0 and b2 >= 0.0 else 2.0 * _SIN_60 * saturation(largest)
    return 1.0 - 0.5 * most


@compiled
def least_square(  # noqa: PLR0917
    l1: float, a1: float, b1: float, l2: float, a2: float, b2: float, mean_chroma: float
) -> float:
    """A lower bound of CIEDE2000², cheap: no hue is formed. `mean_chroma` is that of (a, b).

    dC² + dH² = |(a', b)1 - (a', b)2|² and SH <= SC (for 0.015 T <= 0.015 · 1.93 < 0.045), and C' <= (1 + G) C.
    """
    stretch = 1.5 - 0.5 * saturation(mean_chroma)
    largest = stretch * mean_chroma
    lightness = (l2 - l1) / lightness_weight(0.5 * (l1 + l2))
    plane = ((stretch * (a2 - a1)) ** 2 + (b2 - b1) ** 2) / (1.0 + 0.045 * largest) ** 2
    return lightness * lightness + least_turned(b1, b2, largest) * plane


@compiled
def _pairs(first: FloatArray, second: FloatArray, out: FloatArray) -> None:
    for i in range(len(out)):
        out[i] = ciede2000(first[i, 0], first[i, 1], first[i, 2], second[i, 0], second[i, 1], second[i, 2])


def delta_e_2000(first: Float[np.ndarray, "*#batch 3"], second: Float[np.ndarray, "*#batch 3"]) -> FloatArray:
    """CIEDE2000 of CIELAB colours (*batch, 3), broadcast over all axes but the last."""
    one, other = np.broadcast_arrays(first, second)
    out = np.empty(one.shape[:-1])
    # Copies: NumPy warns of a broadcast array that a kernel might write to.
    left, right = (np.array(labs, dtype=float, order="C").reshape(-1, 3) for labs in (one, other))
    _pairs(left, right, out.reshape(-1))
    return out
