"""Round numbers along an axis."""

import itertools

import numpy as np

from ilmek.arrays import FloatArray

_ANGLES = ("deg", "°")
_MINUS = str.maketrans("-", "−")


def span(values: FloatArray) -> tuple[float, float]:
    """The least and the greatest finite value. An empty span is widened; without values it is 0 to 1.

    >>> span(np.array([2.0, np.nan, 5.0])), span(np.array([]))
    ((2.0, 5.0), (0.0, 1.0))
    """
    finite = values[np.isfinite(values)]
    if not len(finite):
        return 0.0, 1.0
    low, high = float(finite.min()), float(finite.max())
    if high - low > 1e-9 * max(abs(low), abs(high)):
        return low, high
    slack = 0.1 * abs(high) or 1.0
    return low - slack, high + slack


def ticks(low: float, high: float, unit: str = "", count: int = 6) -> list[float]:
    """About `count` tick values within [low, high]; angles in degrees step by 5, 10, 15, 30, 45, 60, 90 or 180.

    >>> ticks(0.0, 360.0, "deg", 9)
    [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 360.0]
    """
    slack = 1e-9 * (high - low)
    if unit in _ANGLES and high - low > 20:
        step = next((step for step in (5, 10, 15, 30, 45, 60, 90) if (high - low) / step <= count), 180)
        first, last = np.ceil((low - slack) / step), np.floor((high + slack) / step)
        return [float(step * number) + 0.0 for number in np.arange(first, last + 1)]
    apart = _round_step((high - low) / count)
    return [float(apart * number) for number in np.arange(np.ceil((low - slack) / apart), (high + slack) // apart + 1)]


def _round_step(least: float) -> float:
    """The least of 1, 2, 2.5, 5, 10 ... times a power of ten that is not below `least`.

    >>> _round_step(0.21), _round_step(51.0)
    (0.25, 100.0)
    """
    decade = 10.0 ** np.floor(np.log10(least))
    return float(next(decade * step for step in (1.0, 2.0, 2.5, 5.0, 10.0) if decade * step >= least * (1 - 1e-9)))


def tick_labels(values: list[float]) -> list[str]:
    r"""The tick values as text, with as many decimals as the step needs and true minus signs.

    >>> tick_labels([-0.5, 0.0, 0.5]), tick_labels([0.0, 200000.0])
    (['−0.5', '0.0', '0.5'], ['0', '200\u2009000'])
    """
    step = min((abs(b - a) for a, b in itertools.pairwise(values)), default=1.0) or 1.0
    largest = max((abs(value) for value in values), default=0.0)
    if largest >= 1e6 or (largest and largest < 1e-3):
        return [f"{value:.3g}".translate(_MINUS) for value in values]
    decimals = next((d for d in range(7) if abs(step * 10**d - round(step * 10**d)) < 1e-6 * 10**d * step), 6)
    return [f"{value + 0.0:,.{decimals}f}".replace(",", "\u2009").translate(_MINUS) for value in values]
