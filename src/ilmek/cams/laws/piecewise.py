"""Piecewise polynomials and their exact peaks.

Each piece is a polynomial of t = (u - begin)/length. The extremes are taken at the roots of the derivative, so a law
that overshoots has its exact bounds. [derived here]
"""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray, RealField
from ilmek.cams.laws.law import Law, LawValues, Parameters
from ilmek.records import record

_SAME = 1e-9
"""Share of a derivative's peak below which its step at a knot, or its value at an end, counts as rounding."""

_EXACT = 1e-12
"""Distance from a whole number below which a value is snapped to it."""

_REAL = 1e-4
"""Imaginary part below which a root counts as real: a double one is found as a pair of complex ones."""


@record
class Piecewise:
    """Polynomials between ascending knots from 0 to 1.

    knots  (pieces + 1,)      rows  coefficients of each piece by its t, the constant first, (pieces, terms)
    """

    knots: FloatArray
    rows: FloatArray

    def __call__(self, u: RealField) -> RealField:
        """Values at u of any shape; at a knot, those of the piece that begins."""
        if len(self.rows) == 1:
            return _horner(self.rows[0], u)
        piece, t = self.local(u)
        return _horner(self.rows.T[:, piece], t)

    def local(self, u: RealField) -> tuple[IntArray, FloatArray]:
        """The piece of each u, and its t in [0, 1]; at a knot, the piece that begins."""
        u = np.asarray(u, float)
        piece = np.asarray(np.searchsorted(self.knots[1:-1], u, side="right"))
        return piece, np.asarray((u - self.knots[piece]) / np.diff(self.knots)[piece])

    def motion(self, u: RealField) -> LawValues:
        """Values and the first three derivatives by u, in one pass of Horner's scheme."""
        piece, t = self.local(u)
        per_length = 1.0 / np.diff(self.knots)[piece]
        value, first, second, third = np.zeros((4, *t.shape))
        for coefficient in self.rows.T[::-1, piece]:
            third = third * t + second
            second = second * t + first
            first = first * t + value
            value = value * t + coefficient
        return LawValues(value, first * per_length, 2.0 * second * per_length**2, 6.0 * third * per_length**3)

    def derivative(self) -> "Piecewise":
        """The derivative by u."""
        powers = np.arange(1, self.rows.shape[1])
        if not powers.size:
            return Piecewise(self.knots, 0.0 * self.rows)
        return Piecewise(self.knots, self.rows[:, 1:] * powers / np.diff(self.knots)[:, None])

    def times(self, other: "Piecewise") -> "Piecewise":
        """The product with another piecewise polynomial over the same knots."""
        pairs = zip(self.rows, other.rows, strict=True)
        return Piecewise(self.knots, np.array([np.convolve(first, second) for first, second in pairs]))

    def bounds(self) -> tuple[float, float]:
        """Least and greatest value, from the ends of each piece and the roots of its derivative."""
        slopes = self.rows[:, 1:] * np.arange(1, self.rows.shape[1])
        if slopes.shape[1] > 1 and np.all(slopes[:, [0, -1]] != 0.0):
            roots = _roots(slopes)
            near = np.clip(np.where(np.abs(roots.imag) < _REAL, roots.real, 0.0), 0.0, 1.0)
            with_ends = np.pad(near, ((0, 0), (1, 1)), constant_values=(0.0, 1.0))
            values = np.asarray(_horner(self.rows.T[:, :, None], with_ends))
        else:
            values = np.concatenate([_extremes(row) for row in self.rows])
        return float(values.min()), float(values.max())

    def peak(self) -> float:
        """Largest magnitude."""
        return max(abs(bound) for bound in self.bounds())

    def integral(self) -> float:
        """Integral over u from 0 to 1."""
        powers = np.arange(1, self.rows.shape[1] + 1)
        return float(np.sum(np.diff(self.knots) * np.sum(self.rows / powers, axis=1)))

    def steps(self) -> FloatArray:
        """Steps at the inner knots, (pieces - 1,)."""
        return np.asarray(self.rows[1:, 0] - self.rows[:-1].sum(axis=1))


def law_of_pieces(name: str, s: Piecewise, parameters: Parameters) -> Law:
    """The law with the displacement s(u) [1] and exact peaks; inf where the law does not start and end at rest."""
    v = s.derivative()
    a = v.derivative()
    j = a.derivative()
    ends = np.array([0.0, 1.0])
    lowest, highest, first, last = (_snapped(value) for value in (*s.bounds(), *np.asarray(s(ends)).tolist()))
    velocity, acceleration = v.peak(), a.peak()
    torque, rms = v.times(a).peak(), float(np.sqrt(a.times(a).integral()))
    stays = np.all(np.abs(v(ends)) <= _SAME * velocity)
    joins = np.all(np.abs(a(ends)) <= _SAME * acceleration) and np.all(np.abs(a.steps()) <= _SAME * acceleration)
    return Law(
        name,
        s,
        v,
        a,
        j,
        velocity_peak=velocity,
        acceleration_peak=acceleration if stays else float("inf"),
        jerk_peak=j.peak() if stays and joins else float("inf"),
        torque_peak=torque if stays else float("inf"),
        acceleration_rms=rms if stays else float("inf"),
        breaks=tuple(float(knot) for knot in s.knots[1:-1]),
        parameters=parameters,
        lowest=lowest,
        highest=highest,
        first=first,
        last=last,
        at_once=s.motion if len(s.rows) > 1 else None,
    )


def _snapped(value: float) -> float:
    return float(round(value)) if abs(value - round(value)) < _EXACT else value


def _horner(coefficients: FloatArray, t: RealField) -> RealField:
    value: RealField = coefficients[-1] + 0.0 * np.asarray(t)
    for coefficient in coefficients[-2::-1]:
        value = value * t + coefficient
    return value


def _roots(rows: FloatArray) -> ComplexArray:
    """Roots of polynomials of one degree by ascending coefficients, first and last not 0: all at once."""
    companions = np.zeros((len(rows), rows.shape[1] - 1, rows.shape[1] - 1))
    companions[:, 1:, :-1] = np.eye(rows.shape[1] - 2)
    companions[:, 0] = -rows[:, -2::-1] / rows[:, -1:]
    return np.asarray(np.linalg.eigvals(companions), dtype=complex)


def _extremes(row: FloatArray) -> FloatArray:
    """Values of a polynomial at 0, 1 and where its derivative is 0 between."""
    slope = row[1:] * np.arange(1, row.size)
    roots = np.roots(slope[::-1]) if slope.size else np.array([])
    near = np.clip(roots.real[np.abs(roots.imag) < _REAL], 0.0, 1.0)
    return np.asarray(_horner(row, np.concatenate([[0.0, 1.0], near])))
