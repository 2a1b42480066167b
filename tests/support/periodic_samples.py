"""Periodic functions from samples at equal steps of one period: derivatives to machine precision where smooth."""

import numpy as np

from ilmek.arrays import Float, Inexact
from ilmek.errors import IlmekError
from ilmek.units import counted


def periodic_derivative(
    samples: Inexact[np.ndarray, " samples"], period: float = 2 * np.pi, order: int = 1
) -> Inexact[np.ndarray, " samples"]:
    """Derivative of a periodic function from its samples at k period / n, k = 0 .. n - 1: f -> F^-1 (i w)^order F f.

    Real or complex. Exact for trigonometric polynomials below n / 2; the error falls faster than any power of 1/n for
    a smooth function [Trefethen, Spectral Methods in MATLAB, chapter 3]. Rounding is amplified by (n / 2)^order.
    Raises IlmekError where there are fewer than 3 samples.

    >>> angle = np.arange(8) * np.pi / 4
    >>> np.allclose(periodic_derivative(np.sin(angle)), np.cos(angle))
    True
    """
    count = len(samples)
    if count < 3:
        raise IlmekError(f"{counted(count, 'sample')} of a period", allowed="at least 3 for a derivative")
    factor = (2j * np.pi / period * np.fft.fftfreq(count, 1 / count)) ** order
    if count % 2 == 0 and order % 2:
        factor[count // 2] = 0  # the derivative of the highest frequency is undefined
    derived = np.fft.ifft(factor * np.fft.fft(samples))
    return derived if np.iscomplexobj(samples) else derived.real


def periodic_mean(samples: Float[np.ndarray, " samples"]) -> float:
    """Mean over one period from samples at equal steps: the trapezium rule, with spectral accuracy.

    samples  at k period / n, k = 0 .. n - 1, shape (n,)      [Trefethen and Weideman, SIAM Review 56 (2014)]

    >>> periodic_mean(np.array([1.0, 3.0, 1.0, 3.0]))
    2.0
    """
    return float(np.mean(samples))
