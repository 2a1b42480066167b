"""Shear, moment, slope and deflection of a loaded beam: exact values, and extremes.

    E I y'''' = q,   M = -E I y'',   V = M' = -E I y'''

Between breaks of the load E I y is a polynomial of the fifth degree at most (the load being linear), so values at any
position and extremes are exact: extremes are at ends of pieces or at zeros of the derivative of |y|² = conj(y) y.
All values are complex like the loads (see `model`). [Gere and Goodno, Mechanics of Materials, 9.2 to 9.4]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray, NumberArray, RealField
from ilmek.elements.beam.model import Beam
from ilmek.records import record

DEGREE = 5

_SHEAR, _MOMENT, _SLOPE, _DEFLECTION = 3, 2, 1, 0


@dataclass(frozen=True, slots=True)
class BeamExtreme:
    """The value of greatest magnitude, and its position [m]; `value` has the parts and signs of both planes."""

    at: float
    value: complex

    @property
    def size(self) -> float:
        """Magnitude over both planes."""
        return abs(self.value)


@record
class BeamResult:
    """The solved beam.

    breaks        ends of the pieces [m], one more than pieces
    coefficients  E I y of each piece by powers of the distance from its left end [N m³, N m², ...]
    reactions     forces of the supports on the beam, positive against the load [N]
    clamps        moments of the clamped ends on the beam, in the order of `clamped` [N m]
    """

    beam: Beam
    breaks: FloatArray
    coefficients: ComplexArray
    reactions: tuple[complex, ...]
    clamps: tuple[complex, ...]

    def shear(self, x: RealField) -> ComplexArray:
        """Shear force V [N] at positions [m]: reactions minus loads on the left; at a jump the value on its right."""
        return self._at(x, _SHEAR, -1.0)

    def moment(self, x: RealField) -> ComplexArray:
        """Bending moment M [N m] at positions [m]; positive: tension on the side of positive deflection."""
        return self._at(x, _MOMENT, -1.0)

    def slope(self, x: RealField, rigidity: float) -> ComplexArray:
        """Slope y' [rad] at positions [m] for a rigidity E I [N m²]."""
        return self._at(x, _SLOPE, 1 / rigidity)

    def deflection(self, x: RealField, rigidity: float) -> ComplexArray:
        """Deflection y [m] at positions [m] for a rigidity E I [N m²]."""
        return self._at(x, _DEFLECTION, 1 / rigidity)

    @property
    def shear_max(self) -> BeamExtreme:
        """Largest shear force [N]."""
        return self._extreme(_SHEAR, -1.0)

    @property
    def moment_max(self) -> BeamExtreme:
        """Largest bending moment [N m]."""
        return self._extreme(_MOMENT, -1.0)

    def slope_max(self, rigidity: float) -> BeamExtreme:
        """Largest slope [rad] for a rigidity E I [N m²]."""
        return self._extreme(_SLOPE, 1 / rigidity)

    def slope_at_supports(self, rigidity: float) -> BeamExtreme:
        """Largest slope [rad] at a support, relevant for its bearing, for a rigidity E I [N m²]."""
        slopes = self.slope(np.array(self.beam.supports), rigidity)
        worst = int(np.argmax(np.abs(slopes)))
        return BeamExtreme(self.beam.supports[worst], complex(slopes[worst]))

    def deflection_max(self, rigidity: float) -> BeamExtreme:
        """Largest deflection [m] for a rigidity E I [N m²]."""
        return self._extreme(_DEFLECTION, 1 / rigidity)

    def _at(self, x: RealField, order: int, factor: float) -> ComplexArray:
        x = np.asarray(x, dtype=float)
        piece = np.clip(np.searchsorted(self.breaks, x, side="right") - 1, 0, len(self.breaks) - 2)
        powers = factor * derived(self.coefficients, order)[piece]
        return _horner(np.moveaxis(powers, -1, 0), np.asarray(x - self.breaks[piece]))

    def _extreme(self, order: int, factor: float) -> BeamExtreme:
        rows, widths = derived(self.coefficients, order), np.diff(self.breaks)
        scaled = rows * widths[:, None] ** np.arange(rows.shape[1])
        extreme = BeamExtreme(0.0, 0j)
        for piece in _candidates(scaled):
            shares = np.concatenate(([0.0, 1.0], _stationary(scaled[piece])))
            values = _horner(scaled[piece], shares)
            worst = int(np.argmax(np.abs(values)))
            if abs(values[worst]) > extreme.size * (1 + 1e-12):
                extreme = BeamExtreme(float(self.breaks[piece] + widths[piece] * shares[worst]), complex(values[worst]))
        return BeamExtreme(extreme.at, extreme.value * factor)


def derived(coefficients: NumberArray, order: int) -> NumberArray:
    """Coefficients of a derivative, by rising powers along the last axis.

    coefficients  of the power k: [unit of the value/m^k], shape (..., powers)      order  of the derivative, 0 or more
    Returns shape (..., powers - order).
    """
    for _ in range(order):
        coefficients = coefficients[..., 1:] * np.arange(1, coefficients.shape[-1])
    return coefficients


def _horner(coefficients: NumberArray, x: FloatArray) -> ComplexArray:
    """Polynomial by rising powers along the first axis."""
    value: ComplexArray = np.zeros(x.shape, dtype=complex)
    for power in coefficients[::-1]:
        value = np.asarray(value * x + power)
    return value


def _candidates(scaled: NumberArray) -> IntArray:
    """The pieces that may have the largest value, by |p| <= max at ends + max |p''| / 8."""
    powers = np.arange(scaled.shape[1])
    ends = np.maximum(np.abs(scaled[:, 0]), np.abs(scaled.sum(axis=1)))
    above = np.abs(scaled) @ (powers * (powers - 1)) / 8
    return np.flatnonzero(ends + above >= np.max(ends) * (1 - 1e-12))


def _stationary(row: ComplexArray) -> FloatArray:
    """Stationary points of |p| inside (0, 1): roots of Re(conj(p) p')."""
    parts = [(part, derived(part, 1)) for part in (row.real, row.imag) if np.any(part)]
    product = sum((np.convolve(part, slope) for part, slope in parts), np.zeros(1))
    size = float(np.max(np.abs(product)))
    kept = np.trim_zeros(np.where(np.abs(product) > 1e-14 * size, product, 0.0), "b")
    roots = np.roots(kept[::-1]) if len(kept) > 1 else np.zeros(0, dtype=complex)
    real = roots.real[np.abs(roots.imag) < 1e-6]
    return np.asarray(real[(real > 0) & (real < 1)], dtype=float)
