"""Terms of the reduced equation as Fourier series: exact to rounding and about 1,000 times faster to evaluate.

J and Q of a machine whose input rotates fully are periodic and analytic. If f is analytic in the strip |Im q| < a with
|f| <= C, the error of the trigonometric interpolant on N equal steps of the turn is

    |f - p_N| <= 4 C e^{-a N / 2} / (e^a - 1)           [Trefethen and Weideman, SIAM Review 56 (2014), theorem 3.1 ff]

N is doubled until the relative error is `ACCURACY` or no longer falls. The error is measured half-way between the
nodes, where the factor 1 - e^{iNq} of the leading term is greatest.
"""

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.dynamics.reduced import ReducedMechanism
from ilmek.linkage.model import Rotation
from ilmek.records import record
from ilmek.units import turn

ACCURACY = 2e-14
"""Relative error at the level of rounding."""

USABLE = 1e-11
"""Greatest error of a table, relative to the greatest value; otherwise the mechanism's equations are used."""

MAX_NODES = 8192
"""Greatest number of nodes on a turn."""

_WAVES = 1j * np.arange(MAX_NODES // 2)
"""Exponents of all waves at an angle of 1 rad."""


@record
class FourierTerms:
    """J, Q of gravity, Q of the other steady loads and its fall by the speed, each as the real part of Σ c_k e^{ikq}.

    coefficients  c_k, one column per term
    error         greatest error found, relative to the greatest value of its term
    """

    coefficients: Complex[np.ndarray, "terms 4"]
    error: float

    def __call__(self, position: float) -> tuple[float, float, float, float]:
        """J [kg m²], the two Q [N m] and the fall of Q [N m s] at an input angle [rad]."""
        # NumPy, not a kernel: loading the compiler takes longer than a whole run-up.
        waves = np.exp(_WAVES[: len(self.coefficients)] * position)
        inertia, weight, push, drag = (waves @ self.coefficients).real.tolist()
        return inertia, weight, push, drag

    def torque(self, angle: FloatArray, speed: float) -> FloatArray:
        """Torque on the input at a constant speed [rad/s], J' w² / 2 - Q [N m], at its angles [rad]."""
        waves = _WAVES[: len(self.coefficients)]
        inertia, weight, push, drag = self.coefficients.T
        series = waves * inertia * speed**2 / 2 - weight - push + drag * speed
        return np.asarray((np.exp(np.multiply.outer(angle, waves)) @ series).real)


def tabulate(reduced: ReducedMechanism) -> FourierTerms | None:
    """The table of a machine.

    None where the input slides or does not rotate fully, or the error of the table stays above `USABLE`.
    """
    if not isinstance(reduced.plan.mechanism.inputs[0], Rotation):
        return None
    best: FourierTerms | None = None
    nodes = 64
    while nodes <= MAX_NODES:
        tried = _on(reduced, nodes)
        if tried is None:
            return None
        if best is not None and tried.error > 0.5 * best.error and best.error < USABLE:
            break
        best = tried
        if tried.error <= ACCURACY:
            break
        nodes *= 2
    return best if best is not None and best.error < USABLE else None


def _on(reduced: ReducedMechanism, nodes: int) -> FourierTerms | None:
    """The table from a number of nodes; None where the mechanism does not close over the whole turn."""
    at = np.arange(2 * nodes) * (turn / (2 * nodes))
    found = reduced.terms(at)
    if found.status.any():
        return None
    values = np.stack((found.inertia, found.weight, found.push, found.drag), axis=1)
    series = np.fft.rfft(values[::2], axis=0)[: nodes // 2]
    half_step = np.exp(1j * at[1] * np.arange(nodes // 2))
    between = np.fft.irfft(series * half_step[:, None], nodes, axis=0)
    size = np.maximum(np.max(np.abs(values), axis=0), np.finfo(float).tiny)
    series[1:] *= 2
    return FourierTerms(_trimmed(series / nodes, size), float(np.max(np.abs(between - values[1::2]) / size)))


def _trimmed(series: Complex[np.ndarray, "terms 4"], size: Float[np.ndarray, " 4"]) -> Complex[np.ndarray, "kept 4"]:
    """The series without trailing terms whose sum is below a thousandth of rounding."""
    tail = np.cumsum(np.max(np.abs(series) / size, axis=1)[::-1])[::-1]
    kept = max(int(np.count_nonzero(tail > 1e-19)), 1)
    return np.ascontiguousarray(series[:kept])
