"""Residual vibration of an elastic follower after a rise.

A mass x on a spring whose foot y follows the cam has the deviation z = x - y. Over u = t/T, with z in lifts L,

    z'' + 2 zeta W z' + W^2 z = -a(u),     W = 2 pi T/tau                  [Norton, Cam Design and Manufacturing, 10-12]

T is the time of the rise, tau the natural period of the follower, T/tau the time ratio. After the rise z vibrates
freely with

    amplitude = |integral of a(u) e^(m (1 - u)) du| / (W sqrt(1 - zeta^2)),   m = W (-zeta + i sqrt(1 - zeta^2))

at the end of the rise: without damping, the Fourier transform of the law's acceleration at the natural frequency, over
W. In closed form, n = T/tau, zeta = 0:

    uniform |sin pi n| / (pi n)          parabolic 4 sin^2(pi n/2) / (pi n)^2
    harmonic |cos pi n| / |4 n^2 - 1|    cycloidal |sin pi n| / (pi n |n^2 - 1|)
"""

import itertools
import math

import numpy as np

from ilmek.arrays import FloatArray, RealField
from ilmek.cams.laws import Law
from ilmek.errors import ParameterError
from ilmek.num.brackets import bracketed_roots
from ilmek.num.piecewise import supremum

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_BLOCK = 64
"""Number of time ratios per block; the largest ratio of a block sets the number of panels."""

_LEAST_SHARE, _MOST_SHARE = 1e-5, 0.5
_GRID = 24
"""Points per unit of the time ratio; the lobes of a spectrum are one unit wide."""


def residual(law: Law, ratio: RealField, damping: float = 0.0) -> FloatArray:
    """Residual amplitude over the lift [-] at the end of the rise.

    ratio    time ratios T/tau [-], above 0, any shape
    damping  ratio zeta to the critical damping [-], 0 to below 1

    The impulses of a law whose velocity jumps at its ends are included.
    Raises ParameterError for a damping or a time ratio outside these bounds.

    >>> from ilmek.cams.laws import LAWS
    >>> round(float(residual(LAWS["harmonic"], 1.5)), 12)
    0.0
    """
    if not 0 <= damping < 1:
        raise ParameterError(f"damping={damping:g} of the critical", allowed="0 to below 1")
    ratios = np.asarray(ratio, float)
    if ratios.size and not np.min(ratios) > 0:
        raise ParameterError(f"a time ratio of {np.min(ratios):g}", allowed="above 0")
    flat = ratios.ravel()
    blocks = [_transform(law, flat[at : at + _BLOCK], damping) for at in range(0, flat.size, _BLOCK)]
    return np.concatenate(blocks).reshape(ratios.shape) if blocks else ratios


def _transform(law: Law, ratios: FloatArray, damping: float) -> FloatArray:
    u, weights = _nodes(law, float(np.max(ratios)))
    weighted = weights * np.asarray(law.a(u))
    swing = math.sqrt(1.0 - damping**2)
    w = 2 * math.pi * ratios
    m = w * complex(-damping, swing)
    kicks = float(law.v(0.0)) * np.exp(m) - float(law.v(1.0))
    return np.asarray(np.abs(np.exp(m[:, None] * (1.0 - u)) @ weighted + kicks) / (w * swing))


def _nodes(law: Law, ratio: float) -> tuple[FloatArray, FloatArray]:
    """Gauss nodes and weights over panels of at most a natural period, where 12 nodes are exact to rounding."""
    knots = np.array([0.0, *law.breaks, 1.0])
    edges = [np.linspace(a, b, 4 + math.ceil(ratio * (b - a))) for a, b in itertools.pairwise(knots)]
    low = np.concatenate([row[:-1] for row in edges])
    half = 0.5 * (np.concatenate([row[1:] for row in edges]) - low)
    return (low[:, None] + half[:, None] * (1.0 + _NODES)).ravel(), (half[:, None] * _WEIGHTS).ravel()


def least_ratio(law: Law, share: float, damping: float = 0.0) -> float:
    """Least time ratio [-] above which the residual amplitude stays within a share [-] of the lift.

    The zeros of a spectrum are useless at a slightly different speed; this bound holds for all larger ratios.
    Raises ParameterError for a share outside 1e-5..0.5, and for a law of infinite acceleration.

    >>> from ilmek.cams.laws import LAWS
    >>> round(least_ratio(LAWS["cycloidal"], 0.01), 3)
    2.796
    """
    if not _LEAST_SHARE <= share <= _MOST_SHARE:
        allowed = f"{_LEAST_SHARE:g} to {_MOST_SHARE:g}"
        raise ParameterError(f"residual share {share:g} of the lift", allowed=allowed)
    if not math.isfinite(law.acceleration_peak):
        raise ParameterError(f"law {law.name}: its velocity jumps", allowed="a law of finite acceleration")
    # At ratio 0 the amplitude is the whole lift, so the spectrum starts above any share.
    most = _bounded(law, share * math.sqrt(1.0 - damping**2))
    ratios = np.arange(1, math.ceil(most * _GRID) + 2) / _GRID
    sizes = residual(law, ratios, damping)
    inner = sizes[1:-1]
    tops = 1 + np.flatnonzero((inner >= sizes[:-2]) & (inner >= sizes[2:]) & (inner > 0.95 * share))
    for top in tops[::-1]:
        at, peak = _summit(law, damping, float(ratios[top - 1]), float(ratios[top + 1]))
        if peak > share:
            below = top + 1 + int(np.argmax(sizes[top + 1 :] <= share))
            return _last_above(law, share, damping, at, float(ratios[below]))
    last = int(np.flatnonzero(sizes > share)[-1])
    return _last_above(law, share, damping, float(ratios[last]), float(ratios[last + 1]))


def _summit(law: Law, damping: float, low: float, high: float) -> tuple[float, float]:
    """Time ratio and height of the maximum between two time ratios."""
    top = supremum(lambda ratio: residual(law, ratio, damping), np.array([low, high]), samples=16)
    return top.at, top.value


def _last_above(law: Law, share: float, damping: float, above: float, below: float) -> float:
    def excess(ratio: FloatArray) -> FloatArray:
        return residual(law, ratio, damping) - share

    return float(bracketed_roots(excess, np.array([below]), np.array([above]))[0])


def _bounded(law: Law, share: float) -> float:
    """A time ratio beyond which the residual is below the share: by parts, |z| <= variation of a / W^2."""
    knots = np.array([0.0, *law.breaks, 1.0])
    u = np.concatenate([np.linspace(a + 1e-12, b - 1e-12, 200) for a, b in itertools.pairwise(knots)])
    variation = np.sum(np.abs(np.diff(np.concatenate([[0.0], np.asarray(law.a(u)), [0.0]]))))
    ratio = math.sqrt(float(variation) / share) / (2 * math.pi)
    if math.isfinite(law.jerk_peak):
        jerk = np.sum(np.abs(np.diff(np.concatenate([[0.0], np.asarray(law.j(u)), [0.0]]))))
        ratio = min(ratio, (float(jerk) / share) ** (1 / 3) / (2 * math.pi))
    return 1.05 * ratio + 1.0
