"""Light: sums of linear light that do not depend on the order, and CIELAB of one light, in compiled loops."""

import numpy as np

from ilmek.carpet.colour import LINEAR, RGB_TO_XYZ, WHITE, decode
from ilmek.num.compiled import compiled

LIGHT = np.rint(LINEAR * (1 << 24)).astype(np.int64)
"""Linear light of each of the 256 codes of a channel, as a whole number; 2^24 is white."""

_STEP = 12
# The greatest light of each code, and the code at even steps of light.
_MOST = np.append(np.floor(decode((np.arange(255) + 0.5) / 255) * (1 << 24)), 1 << 62).astype(np.int64)
_GUESSES = np.searchsorted(_MOST, np.arange(0, (1 << 24) + 1, 1 << _STEP))

_TO_WHITE = RGB_TO_XYZ / WHITE[:, None] / (1 << 24)
_EPSILON, _KAPPA = 216 / 24389, 24389 / 27


@compiled
def _root(t: float) -> float:
    return float(t ** (1 / 3)) if t > _EPSILON else (_KAPPA * t + 16.0) / 116.0


@compiled
def lab_of_light(red: float, green: float, blue: float) -> tuple[float, float, float]:
    """CIELAB of linear light in the units of LIGHT, as `colour.xyz_to_lab`."""
    x = _root(_TO_WHITE[0, 0] * red + _TO_WHITE[0, 1] * green + _TO_WHITE[0, 2] * blue)
    y = _root(_TO_WHITE[1, 0] * red + _TO_WHITE[1, 1] * green + _TO_WHITE[1, 2] * blue)
    z = _root(_TO_WHITE[2, 0] * red + _TO_WHITE[2, 1] * green + _TO_WHITE[2, 2] * blue)
    return 116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)


@compiled
def code_of_light(light: int) -> int:
    """The code of a channel nearest to a light in the units of LIGHT, by the encoded value; 0 or 255 beyond."""
    code: int = _GUESSES[min(max(light, 0), 1 << 24) >> _STEP]
    while light > _MOST[code]:
        code += 1
    return code
