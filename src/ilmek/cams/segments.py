"""Parts of a cam's programme: rises, falls, dwells, constant speed, and free polynomials.

s = base + scale law.s(u),   s' = scale/span law.v(u),   ...        u = (theta - begin)/span in [0, 1]
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.cams.laws import LAWS, REST, Law, law_of
from ilmek.cams.laws.law import LawValues
from ilmek.records import value_record

_BESIDE = 1e-12
"""Share of a part at which a one-sided value is taken beside a break inside it."""


@value_record
class CamSegment:
    """A part of the turn: `change` [m] of the follower over `span` [rad] by a law.

    scale  factor of the law [m]; default: `change`, for a law from 0 to 1
    """

    name: str
    span: float
    change: float
    law: Law
    scale: float | None = None

    @property
    def factor(self) -> float:
        """Factor of the law [m]."""
        return self.change if self.scale is None else self.scale

    @property
    def size(self) -> float:
        """Range of the displacement [m]: the scale of its derivatives."""
        return abs(self.factor) * max(self.law.highest - self.law.lowest, _BESIDE)

    def derivative(self, u: float, order: int) -> float:
        """Derivative of order 1 to 3 by the cam angle [m/rad, m/rad^2, m/rad^3] at u in [0, 1]."""
        curve = (self.law.s, self.law.v, self.law.a, self.law.j)[order]
        return self.factor / self.span**order * float(curve(u))

    def sides(self, at: float, order: int) -> tuple[float, float]:
        """The derivative just before and just after u = at inside the part."""
        return self.derivative(at - _BESIDE, order), self.derivative(at + _BESIDE, order)

    def motion(self, u: FloatArray) -> LawValues:
        """Displacement from the start of the part [m], and its derivatives by the cam angle, at u in [0, 1]."""
        at, factor, rate = self.law.motion(u), self.factor, 1.0 / self.span
        v, a, j = factor * rate, factor * rate**2, factor * rate**3
        return LawValues(factor * at.s, v * at.v, a * at.a, j * at.j)


@dataclass(frozen=True, slots=True)
class OpenSegment:
    """A part without a law: `joined` fills it with a polynomial that joins both neighbours; span [rad], change [m]."""

    name: str
    span: float
    change: float


def rise(span: float, lift: float, law: Law | str) -> CamSegment:
    """The follower moves out by `lift` [m] over `span` [rad]; law: a motion law or its name."""
    return CamSegment("rise", span, lift, law_of(law) if isinstance(law, str) else law)


def fall(span: float, lift: float, law: Law | str) -> CamSegment:
    """The follower returns by `lift` [m] over `span` [rad]; law: a motion law or its name."""
    return CamSegment("fall", span, -lift, law_of(law) if isinstance(law, str) else law)


def dwell(span: float) -> CamSegment:
    """The follower rests over `span` [rad]."""
    return CamSegment("dwell", span, 0.0, REST)


def even(span: float, change: float) -> CamSegment:
    """The follower moves by `change` [m] over `span` [rad] at constant speed."""
    return CamSegment("constant speed", span, change, LAWS["uniform"])


def blend(span: float, change: float) -> OpenSegment:
    """The follower moves by `change` [m] over `span` [rad] so that it joins both neighbours; for `joined`."""
    return OpenSegment("blend", span, change)


def free(
    span: float, change: float, start: Sequence[float] = (0.0, 0.0), end: Sequence[float] = (0.0, 0.0)
) -> CamSegment:
    """A polynomial part with given derivatives at its ends.

    span, change  [rad, m]
    start, end    s', s'', s''' [m/rad, m/rad^2, m/rad^3] at the start and at the end, one to three values each

    >>> free(1.0, 0.0, (1.0, 0.0), (-1.0, 0.0)).law.highest > 0.3
    True
    """
    scale = max(abs(change), *(abs(value) * span**k for row in (start, end) for k, value in enumerate(row, 1)), 0.0)
    scale = scale or 1.0
    first, last = (tuple(value * span**k / scale for k, value in enumerate(row, 1)) for row in (start, end))
    law = law_of("polynomial", {"start": (0.0, *first), "end": (change / scale, *last)})
    return CamSegment("blend", span, change, law, scale)


def bounds(parts: Sequence[CamSegment]) -> tuple[float, float]:
    """Least and greatest displacement [m] over consecutive parts, from 0 at their start; overshoot is included."""
    base, lowest, highest = 0.0, math.inf, -math.inf
    for part in parts:
        ends = base + part.factor * np.array([part.law.lowest, part.law.highest])
        lowest, highest = min(lowest, float(ends.min())), max(highest, float(ends.max()))
        base += part.change
    return lowest, highest
