"""The terms of a turning machine as Fourier series: exact to rounding, and a thousand times quicker to evaluate.

Of a machine whose input turns fully, J and Q are periodic and analytic. With f analytic in the strip
|Im q| < a and |f| <= C there, the trigonometric interpolant on N equal steps of the turn is off by

    |f - p_N| <= 4 C e^{-a N / 2} / (e^a - 1)           [Trefethen and Weideman, SIAM Review 56 (2014), theorem 3.1 ff]

N is doubled until the error, measured against the engine half-way between the nodes (where 1 - e^{iNq}, the factor of
the leading term, is greatest), is `ACCURACY` of the function or no longer falls.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, Float
from ilmek.dynamics.reduced import ReducedMechanism
from ilmek.linkage.model import Rotation
from ilmek.num.compiled import compiled
from ilmek.units import turn

ACCURACY = 2e-14
"""Error that is rounding: nothing is gained by more terms."""

USABLE = 1e-11
"""Greatest error of a table, of the greatest value; a machine that does not reach it is run on the engine."""

MOST = 8192
"""Most nodes on a turn."""


@dataclass(frozen=True, slots=True)
class FourierTerms:
    """J, Q of the weights and of the other steady loads: the real part of Σ c_k e^{ikq}.

    error  the greatest found, of each one's greatest value
    """

    coefficients: Complex[np.ndarray, "terms 3"]
    error: float

    def __call__(self, position: float) -> tuple[float, float, float]:
        """The three at one input angle [rad]."""
        found: tuple[float, float, float] = evaluate(self.coefficients, position)
        return found


@compiled
def evaluate(coefficients: np.ndarray, position: float) -> tuple[float, float, float]:
    """Three series at one angle by Horner's rule in z = e^{iq}."""
    z = complex(np.cos(position), np.sin(position))
    a, b, c = 0j, 0j, 0j
    for k in range(coefficients.shape[0] - 1, -1, -1):
        a = a * z + coefficients[k, 0]
        b = b * z + coefficients[k, 1]
        c = c * z + coefficients[k, 2]
    return a.real, b.real, c.real


def tabulate(reduced: ReducedMechanism) -> FourierTerms | None:
    """The table of a machine; None where its input slides or does not turn fully, or the terms are too sharp."""
    if not isinstance(reduced.plan.mechanism.inputs[0], Rotation):
        return None
    best: FourierTerms | None = None
    nodes = 64
    while nodes <= MOST:
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
    """The table from that many nodes; None where the machine does not close all round."""
    at = np.arange(2 * nodes) * (turn / (2 * nodes))
    found = reduced.terms(at)
    if found.status.any():
        return None
    values = np.stack((found.inertia, found.weight, found.push), axis=1)
    series = np.fft.rfft(values[::2], axis=0)[: nodes // 2]
    half_step = np.exp(1j * at[1] * np.arange(nodes // 2))
    between = np.fft.irfft(series * half_step[:, None], nodes, axis=0)
    size = np.maximum(np.max(np.abs(values), axis=0), np.finfo(float).tiny)
    series[1:] *= 2
    return FourierTerms(_trimmed(series / nodes, size), float(np.max(np.abs(between - values[1::2]) / size)))


def _trimmed(series: Complex[np.ndarray, "terms 3"], size: Float[np.ndarray, " 3"]) -> Complex[np.ndarray, "kept 3"]:
    """Without the trailing terms that together are below a thousandth of rounding."""
    tail = np.cumsum(np.max(np.abs(series) / size, axis=1)[::-1])[::-1]
    kept = max(int(np.count_nonzero(tail > 1e-19)), 1)
    return np.ascontiguousarray(series[:kept])
