"""Sine and cosine by arithmetic alone: no branch, no table, no call, so that a compiled loop over them is vectorised.

    k = nearest integer to x / (pi/2),    r = x - k pi/2 in three parts,    |r| <= pi/4 (and rounding)
    sin r and cos r by polynomials,       then rotated by k quarter turns

[Cody and Waite, Software Manual for the Elementary Functions, chapter 8; polynomials: Moshier, Cephes, sin.c.]
"""

from ilmek.arrays import RealField

NEAREST = 6755399441055744.0  # 1.5 * 2^52: adding and taking it away rounds to the nearest integer
QUARTERS = 0.6366197723675814  # 2 / pi
HIGH, MIDDLE, LOW = 1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21  # pi / 2


def sincos(x: RealField) -> tuple[RealField, RealField]:
    """Sine and cosine of an angle x [rad], both within 2e-16 for |x| <= 1e4; beyond 1e6 the error grows with x.

    >>> import math
    >>> sincos(0.0) == (0.0, 1.0), abs(sincos(100.0)[0] - math.sin(100.0)) < 2e-16
    (True, True)
    """
    k = (x * QUARTERS + NEAREST) - NEAREST
    r = ((x - k * HIGH) - k * MIDDLE) - k * LOW
    q = r * r
    p = 1.58962301576546568060e-10 * q - 2.50507477628578072866e-8
    p = (p * q + 2.75573136213857245213e-6) * q - 1.98412698295895385996e-4
    p = (p * q + 8.33333333332211858878e-3) * q - 1.66666666666666307295e-1
    s = r + r * (q * p)
    p = -1.13585365213876817300e-11 * q + 2.08757008419747316778e-9
    p = (p * q - 2.75573141792967388112e-7) * q + 2.48015872888517045348e-5
    p = (p * q - 1.38888888888730564116e-3) * q + 4.16666666666665929218e-2
    c = 1.0 - (0.5 * q - q * q * p)
    half = (0.5 * k - 0.25 + NEAREST) - NEAREST  # floor(k / 2), never at a tie
    odd = k - 2.0 * half  # 0 or 1
    quarter = (0.5 * half - 0.25 + NEAREST) - NEAREST
    sign = 1.0 - 2.0 * (half - 2.0 * quarter)
    even = 1.0 - odd
    return sign * (even * s + odd * c), sign * (even * c - odd * s)
