"""Moments of a body up to the second order, from which mass, mass centre and inertia tensor follow.

    V = integral dV,      f = integral r dV,      S = integral r r^T dV;      centre c = f / V
    inertia about the centre  I = (tr C) 1 - C,   C = S - V c c^T              [Goldstein, Classical Mechanics, 5-3]

Moments about one origin add; a body moved by r -> o + R r has

    V,    V o + R f,    V o o^T + o (R f)^T + (R f) o^T + R S R^T
"""

from collections.abc import Iterable

import numpy as np

from ilmek.arrays import Float
from ilmek.part.placement import Placement
from ilmek.records import record


@record
class Moments:
    """Moments of a volume (m^3, m^4, m^5), or times a density of a mass (kg, kg m, kg m²), about the frame's origin."""

    zeroth: float
    first: Float[np.ndarray, " 3"]
    second: Float[np.ndarray, "3 3"]

    def __add__(self, other: "Moments") -> "Moments":
        return Moments(self.zeroth + other.zeroth, self.first + other.first, self.second + other.second)

    def __mul__(self, factor: float) -> "Moments":
        return Moments(factor * self.zeroth, factor * self.first, factor * self.second)

    @property
    def centre(self) -> Float[np.ndarray, " 3"]:
        """Centre [m]; the origin for nothing."""
        return self.first / self.zeroth if self.zeroth else np.zeros(3)

    @property
    def inertia(self) -> Float[np.ndarray, "3 3"]:
        """Inertia tensor about the centre: m^5 of a volume, kg m² of a mass."""
        central = self.second - self.zeroth * np.outer(self.centre, self.centre)
        return np.asarray(np.trace(central) * np.eye(3) - central)

    def placed(self, placement: Placement) -> "Moments":
        """The moments of the body at another place."""
        origin = placement.origin
        turned = placement.rotation @ self.first
        across = np.outer(origin, turned)
        second = placement.rotation @ self.second @ placement.rotation.T
        return Moments(
            self.zeroth,
            self.zeroth * origin + turned,
            self.zeroth * np.outer(origin, origin) + across + across.T + second,
        )


NOTHING = Moments(0.0, np.zeros(3), np.zeros((3, 3)))
"""Moments of no matter."""


def together(moments: Iterable[Moments]) -> Moments:
    """The moments of several bodies in one frame."""
    return sum(moments, NOTHING)
