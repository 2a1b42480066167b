"""A loaded beam's shear, moment, slope and deflection: exact everywhere, and where they are largest.

    E I y'''' = q,   M = -E I y'',   V = M' = -E I y'''

Between breaks of the load E I y is a polynomial of the fifth degree at most (the load being linear), so a value at any
place and the largest values are exact: these lie at ends of pieces or where the derivative of |y|² = conj(y) y is 0.
All of them are complex as the loads are (see `model`). [Gere and Goodno, Mechanics of Materials, 9.2 to 9.4]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray, NumberArray, RealField
from ilmek.elements.beam.model import Beam
from ilmek.records import record

DEGREE = 5

_SHEAR, _MOMENT, _SLOPE, _DEFLECTION = 3, 2, 1, 0


@dataclass(frozen=True, slots=True)
class BeamExtreme:
    """The largest value by its magnitude, and its place [m]; `value` has the planes' parts and signs."""

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
    reactions     of the supports on the beam, against the load [N]
    clamps        of the clamped ends on the beam, against its turning, in the beam's order of `clamped` [N m]
    """

    beam: Beam
    breaks: FloatArray
    coefficients: ComplexArray
    reactions: tuple[complex, ...]
    clamps: tuple[complex, ...]

    def shear(self, x: RealField) -> ComplexArray:
        """V [N] at places [m]: the sum of reactions less loads on the left; at a jump the value on its right."""
        return self._at(x, _SHEAR, -1.0)

    def moment(self, x: RealField) -> ComplexArray:
        """M [N m] at places [m]; positive stretches the side to which a positive load pushes."""
        return self._at(x, _MOMENT, -1.0)

    def slope(self, x: RealField, rigidity: float) -> ComplexArray:
        """Y' [rad] at places [m] of a beam of rigidity E I [N m²]."""
        return self._at(x, _SLOPE, 1 / rigidity)

    def deflection(self, x: RealField, rigidity: float) -> ComplexArray:
        """Y [m] at places [m] of a beam of rigidity E I [N m²]."""
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
        """Largest slope [rad] anywhere."""
        return self._extreme(_SLOPE, 1 / rigidity)

    def slope_at_supports(self, rigidity: float) -> BeamExtreme:
        """Largest slope [rad] in a support: what its bearing must bear."""
        slopes = self.slope(np.array(self.beam.supports), rigidity)
        worst = int(np.argmax(np.abs(slopes)))
        return BeamExtreme(self.beam.supports[worst], complex(slopes[worst]))

    def deflection_max(self, rigidity: float) -> BeamExtreme:
        """Largest deflection [m]."""
        return self._extreme(_DEFLECTION, 1 / rigidity)

    def rigidity_for(self, *, slope: float = math.inf, deflection: float = math.inf) -> float:
        """Least E I [N m²] that keeps a slope in the supports [rad] and a deflection anywhere [m].

        >>> from ilmek.elements.beam.model import LineLoad
        >>> from ilmek.elements.beam.solve import bend
        >>> bent = bend(Beam(2.0, (0.0, 2.0), (LineLoad(0.0, 2.0, 24.0),)))
        >>> round(bent.rigidity_for(slope=0.008), 6), round(bent.rigidity_for(deflection=0.005), 6)
        (1000.0, 1000.0)
        """
        return max(self.slope_at_supports(1.0).size / slope, self.deflection_max(1.0).size / deflection)

    def _at(self, x: RealField, order: int, factor: float) -> ComplexArray:
        x = np.asarray(x, dtype=float)
        piece = np.clip(np.searchsorted(self.breaks, x, side="right") - 1, 0, len(self.breaks) - 2)
        powers = factor * derived(self.coefficients, order)[piece]
        return _horner(np.moveaxis(powers, -1, 0), np.asarray(x - self.breaks[piece]))

    def _extreme(self, order: int, factor: float) -> BeamExtreme:
        rows, widths = derived(self.coefficients, order), np.diff(self.breaks)
        scaled = rows * widths[:, None] ** np.arange(rows.shape[1])
        found = BeamExtreme(0.0, 0j)
        for piece in _worth(scaled):
            places = np.concatenate(([0.0, 1.0], _turns(scaled[piece])))
            values = _horner(scaled[piece], places)
            worst = int(np.argmax(np.abs(values)))
            if abs(values[worst]) > found.size * (1 + 1e-12):
                found = BeamExtreme(float(self.breaks[piece] + widths[piece] * places[worst]), complex(values[worst]))
        return BeamExtreme(found.at, found.value * factor)


def derived(coefficients: NumberArray, order: int) -> NumberArray:
    """Coefficients of a derivative, by rising powers along the last axis."""
    for _ in range(order):
        coefficients = coefficients[..., 1:] * np.arange(1, coefficients.shape[-1])
    return coefficients


def _horner(coefficients: NumberArray, x: FloatArray) -> ComplexArray:
    """Polynomial by rising powers along the first axis."""
    value: ComplexArray = np.zeros(x.shape, dtype=complex)
    for power in coefficients[::-1]:
        value = np.asarray(value * x + power)
    return value


def _worth(scaled: NumberArray) -> IntArray:
    """The pieces that can hold the largest value: |p| <= its ends' + max |p''| / 8, against the largest at an end."""
    powers = np.arange(scaled.shape[1])
    ends = np.maximum(np.abs(scaled[:, 0]), np.abs(scaled.sum(axis=1)))
    above = np.abs(scaled) @ (powers * (powers - 1)) / 8
    return np.flatnonzero(ends + above >= np.max(ends) * (1 - 1e-12))


def _turns(row: ComplexArray) -> FloatArray:
    """Where |p| is stationary inside (0, 1): roots of Re(conj(p) p')."""
    parts = [(part, derived(part, 1)) for part in (row.real, row.imag) if np.any(part)]
    product = sum((np.convolve(part, slope) for part, slope in parts), np.zeros(1))
    size = float(np.max(np.abs(product)))
    kept = np.trim_zeros(np.where(np.abs(product) > 1e-14 * size, product, 0.0), "b")
    roots = np.roots(kept[::-1]) if len(kept) > 1 else np.zeros(0, dtype=complex)
    real = roots.real[np.abs(roots.imag) < 1e-6]
    return np.asarray(real[(real > 0) & (real < 1)], dtype=float)
