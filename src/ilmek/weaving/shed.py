"""The shed: lengthening of a warp, and its tension, force and work.

A warp is fixed at a distance a in front of the point of lift and at a distance b behind it. Lifted by s,

    dL = (sqrt(a² + s²) - a) + (sqrt(b² + s²) - b),      d(dL)/ds = s / sqrt(a² + s²) + s / sqrt(b² + s²)
    T  = T0 + k dL,      F = T d(dL)/ds,      W = T0 dL + k dL² / 2

k = (1 - c) EA / l is the gain of tension over lengthening: EA the stiffness of the warp, l the length that stretches,
c the share of the lengthening that the warp cylinder takes up. With k = 0 the tension does not change. Without friction
at the point of lift F is exact, whatever the lengths of the two sides.           [derived; virtual work]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray, RealField


def shed_lengthening(lift: RealField, front: float, back: float) -> FloatArray:
    """Lengthening dL [m] of a warp in the shed; 0 without lift.

    lift         s [m], a number or an array of any shape
    front, back  a and b [m], above 0

    The difference is computed as s² / (sqrt(a² + s²) + a), which loses no digits for a small lift.

    >>> round(float(shed_lengthening(0.060, 0.170, 0.170)), 6)
    0.020555
    """
    square = np.square(lift)
    return np.asarray(sum(square / (np.hypot(lift, span) + span) for span in (front, back)))


@dataclass(frozen=True, slots=True)
class ShedWarp:
    """A warp in the shed.

    tension      T0, of the warp at rest [N]
    front, back  a and b, from the point of lift to the fixed points of the warp [m], above 0
    rate         k, gain of tension over lengthening [N/m]; 0: the tension does not change
    """

    tension: float
    front: float
    back: float
    rate: float

    def lengthening(self, lift: RealField) -> FloatArray:
        """Lengthening dL [m] at lifts [m] of any shape."""
        return shed_lengthening(lift, self.front, self.back)

    def slope(self, lift: RealField) -> FloatArray:
        """d(dL)/ds at lifts [m] of any shape: the sum of the sines of the warp's slopes in front and behind."""
        return np.asarray(lift / np.hypot(lift, self.front) + lift / np.hypot(lift, self.back))

    def tension_at(self, lift: RealField) -> FloatArray:
        """Tension T [N] at lifts [m] of any shape."""
        return np.asarray(self.tension + self.rate * self.lengthening(lift))

    def force(self, lift: RealField) -> FloatArray:
        """Force F [N] against the lift, at lifts [m] of any shape."""
        return np.asarray(self.tension_at(lift) * self.slope(lift))

    def work(self, lift: float) -> float:
        """Work W [J] of lifting the warp to a lift [m]."""
        longer = float(self.lengthening(lift))
        return self.tension * longer + self.rate * longer**2 / 2
