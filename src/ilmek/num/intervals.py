"""Interval arithmetic with outward rounding, for arrays: every result contains the exact one.

Each operation rounds correctly to within half a unit in the last place; the next number outward is a safe bound.
[Moore, Kearfott and Cloud, Introduction to Interval Analysis, 2009]
"""

from typing import Any, TypeAlias, Union

import numpy as np

from ilmek.records import record

Numbers: TypeAlias = np.ndarray | np.floating
"""Real numbers of double or extended precision, of any shape."""


@record
class Intervals:
    """Intervals from `low` to `high`, of one shape; a number is an interval without extent.

    Operations on numbers of extended precision (`numpy.longdouble`) are rounded in extended precision.

    >>> third = Intervals.of(1.0) * Intervals.of(0.1)
    >>> bool(third.low < 0.1 < third.high)
    True
    """

    low: Numbers
    high: Numbers

    @classmethod
    def of(cls, values: Numbers | float) -> "Intervals":
        """The numbers themselves."""
        return cls(np.asarray(values), np.asarray(values))

    @classmethod
    def around(cls, centre: Numbers, radius: Numbers) -> "Intervals":
        """Intervals that contain centre - radius to centre + radius."""
        return _outward(centre - radius, centre + radius)

    def __add__(self, other: Union["Intervals", Numbers, float]) -> "Intervals":
        one = _intervals(other)
        return _outward(self.low + one.low, self.high + one.high)

    def __sub__(self, other: Union["Intervals", Numbers, float]) -> "Intervals":
        one = _intervals(other)
        return _outward(self.low - one.high, self.high - one.low)

    def __neg__(self) -> "Intervals":
        return Intervals(-self.high, -self.low)

    def __mul__(self, other: Union["Intervals", Numbers, float]) -> "Intervals":
        one = _intervals(other)
        products = np.stack(
            np.broadcast_arrays(self.low * one.low, self.low * one.high, self.high * one.low, self.high * one.high)
        )
        return _outward(products.min(axis=0), products.max(axis=0))

    def rounded(self, kind: np.dtype[Any]) -> "Intervals":
        """Intervals of numbers of another precision that contain these; themselves where it is the same."""
        if self.low.dtype == kind:
            return self
        return _outward(self.low.astype(kind), self.high.astype(kind))

    @property
    def square(self) -> "Intervals":
        """The squares of the numbers; at least 0."""
        ends = np.stack([self.low * self.low, self.high * self.high])
        least = np.where((self.low <= 0) & (self.high >= 0), 0.0, np.nextafter(ends.min(axis=0), -np.inf))
        return Intervals(least, np.nextafter(ends.max(axis=0), np.inf))

    @property
    def middle(self) -> np.ndarray:
        """A number near the middle of each interval."""
        return np.asarray(0.5 * (self.low + self.high))

    @property
    def radius(self) -> np.ndarray:
        """Distance from `middle` within which each interval lies."""
        middle = self.middle
        return np.asarray(np.nextafter(np.maximum(middle - self.low, self.high - middle), np.inf))

    def __getitem__(self, index: Any) -> "Intervals":
        return Intervals(np.asarray(self.low)[index], np.asarray(self.high)[index])


def stacked(parts: list[Intervals], axis: int) -> Intervals:
    """Intervals of one shape along a new axis."""
    return Intervals(np.stack([part.low for part in parts], axis), np.stack([part.high for part in parts], axis))


def _intervals(value: Intervals | Numbers | float) -> Intervals:
    return value if isinstance(value, Intervals) else Intervals.of(value)


def _outward(low: Numbers, high: Numbers) -> Intervals:
    return Intervals(np.nextafter(low, -np.inf), np.nextafter(high, np.inf))
