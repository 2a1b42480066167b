"""Rounding of numbers for people: to the resolution of their unit, rounding noise to zero. JSON keeps all digits."""

import math
from collections.abc import Mapping

from ilmek.units import parse_unit

RESOLUTIONS: Mapping[str, float] = {
    "m": 1e-6,
    "dm": 1e-5,
    "cm": 1e-4,
    "mm": 1e-3,
    "um": 1e-3,
    "deg": 1e-2,
    "rad": 1e-4,
    "N": 1e-3,
    "kN": 1e-4,
    "N*m": 1e-4,
    "Nm": 1e-4,
    "MPa": 1e-2,
    "rpm": 1e-2,
    "W": 1e-3,
}
"""Least step that is worth showing of a quantity in this unit."""

NOISE = 1e-3
"""A value below this share of the resolution is rounding noise."""

_OTHER_NOISE = 1e-12
"""The same of a unit without a resolution [that unit]."""

_COARSE = 1e4
"""A value of more resolutions is shown more coarsely than the resolution."""

_OF_SCALE = 1e-6
"""A value below this share of its limit is rounding noise."""


def rounded(value: float, unit: str) -> float:
    """An SI value as it is shown in `unit` [SI]: a multiple of the unit's resolution; below ten of these, two digits.

    A value of more than 10⁴ resolutions is returned as it is: four digits are shown of it anyway.

    >>> rounded(1.735e-17, "mm"), rounded(0.0597375, "mm"), round(rounded(0.00000456, "mm") * 1e3, 9)
    (0.0, 0.0597375, 0.0046)
    """
    if not math.isfinite(value) or value == 0:
        return value
    factor = parse_unit(unit).factor
    resolution = RESOLUTIONS.get(unit, 0.0)
    shown = abs(value) / factor
    if shown < (resolution * NOISE or _OTHER_NOISE):
        return 0.0
    if shown >= _COARSE * resolution:
        return value
    step = resolution if shown >= 10 * resolution else 10.0 ** (math.floor(math.log10(shown)) - 1)
    return math.copysign(round(shown / step) * step * factor, value)


def without_noise(value: float, limit: float, unit: str) -> float:
    """A value as it is shown beside its limit [SI]: 0 where it is far below both the limit and the unit's resolution.

    Beside a limit of 0 it stays: it would hide on which side of the limit the value is.

    >>> without_noise(1e-19, 1e-12, "mm"), without_noise(5e-13, 1e-12, "mm"), without_noise(1e-17, 0.0, "mm")
    (0.0, 5e-13, 1e-17)
    """
    resolution = RESOLUTIONS.get(unit, 0.0) * parse_unit(unit).factor
    noise = min(_OF_SCALE * abs(limit), resolution * NOISE or math.inf)
    return 0.0 if abs(value) < noise else value
