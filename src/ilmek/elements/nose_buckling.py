"""Buckling of the nose of a thin plate cam under the force on its tip.

The nose stands free over the circle up to which its neighbours hold it. The force N on the tip, inclined to the radius
by the pressure angle mu, spreads at 45 degrees to both sides: the nose is a wedge of constant thickness t, with the
width 2 x at the distance x from the tip, along the force a = h / cos(mu) long, clamped at its foot. Its second moment
of area, I(x) = 2 x t^3 / 12, grows in proportion to x, so that

    x w'' + (N a / (E I_a)) w = 0,   w = sqrt(x) J1(2 sqrt(b x)),   w'(a) = 0:   J0(2 sqrt(b a)) = 0

    N_cr = (j0/2)^2 E I_a / a^2 = 1.4458 E t^3 / (6 a),   j0 = 2.40483

[Timoshenko and Gere, Theory of Elastic Stability, 2nd ed., 2.14: columns of varying cross section, I in proportion to
the distance; spreading at 45 degrees: assumed by this project. The stiffening of the plate by 1/(1 - nu^2) and the
guide cams on both sides are left out, which is conservative.]
"""

from ilmek.arrays import FloatArray, RealField

_FIRST_ZERO = 2.404825557695773
"""First zero of the Bessel function J0."""

WEDGE = (_FIRST_ZERO / 2) ** 2
"""Factor of a wedge clamped at its foot: N_cr = 1.4458 E I_foot / a^2."""


def nose_buckling(thickness: RealField, height: RealField, cosine: RealField, modulus: float) -> FloatArray | float:
    """Force [N] on the tip of a nose at which it buckles: 1.4458 E t^3 cos(mu) / (6 h).

    thickness  t of the plate [m]      height   h of the tip above the circle that holds the plate [m], above 0
    cosine     of the pressure angle   modulus  E [Pa]

    >>> round(float(nose_buckling(0.3e-3, 0.06, 1.0, 200e9)), 2)
    21.69
    """
    return WEDGE * modulus * thickness**3 * cosine / (6 * height)
