"""Array types, named once.

A *field* is a value or an array of values of any batch shape; the leaf formulas take and return fields, so that one
formula serves a single pose and a million. Shapes are checked under pytest only (jaxtyping and beartype).
"""

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from jaxtyping import Bool, Complex, Float, Int, Num, UInt8

FloatArray: TypeAlias = Float[np.ndarray, "..."]
ComplexArray: TypeAlias = Complex[np.ndarray, "..."]
BoolArray: TypeAlias = Bool[np.ndarray, "..."]
IntArray: TypeAlias = Int[np.ndarray, "..."]
NumberArray: TypeAlias = Num[np.ndarray, "..."]

if TYPE_CHECKING:
    # To a type checker numbers of Python and of NumPy are one; it weighs every kind of one operand against every kind
    # of the other, and with all kinds named below takes five times as long.
    RealField: TypeAlias = float | Num[np.ndarray, "..."]
    ComplexField: TypeAlias = complex | Num[np.ndarray, "..."]
else:
    RealField = int | float | np.floating | np.integer | Num[np.ndarray, "..."]
    """A real number or a real array."""

    ComplexField = int | float | complex | np.number | Num[np.ndarray, "..."]
    """A complex number (a planar point or vector) or an array of them."""

Rgb: TypeAlias = UInt8[np.ndarray, "height width 3"]
"""A picture: sRGB, 8 bits a channel, row 0 on top."""

Indices: TypeAlias = UInt8[np.ndarray, "rows columns"]
"""A knot chart: the yarn's place in the list, one a knot, row 0 on top."""
