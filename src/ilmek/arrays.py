"""Array types, named once.

A *field* is a value or an array of values of any batch shape; the leaf formulas take and return fields, so that one
formula serves a single pose and a million. Shapes are checked under pytest only (jaxtyping and beartype).
"""

from typing import TypeAlias

import numpy as np
from jaxtyping import Bool, Complex, Float, Int, Num, UInt8

FloatArray: TypeAlias = Float[np.ndarray, "..."]
ComplexArray: TypeAlias = Complex[np.ndarray, "..."]
BoolArray: TypeAlias = Bool[np.ndarray, "..."]
IntArray: TypeAlias = Int[np.ndarray, "..."]
NumberArray: TypeAlias = Num[np.ndarray, "..."]

RealField: TypeAlias = int | float | np.floating | np.integer | Num[np.ndarray, "..."]
"""A real number or a real array."""

ComplexField: TypeAlias = int | float | complex | np.number | Num[np.ndarray, "..."]
"""A complex number (a planar point or vector) or an array of them."""

Rgb: TypeAlias = UInt8[np.ndarray, "height width 3"]
"""A picture: sRGB, 8 bits a channel, row 0 on top."""

Indices: TypeAlias = UInt8[np.ndarray, "rows columns"]
"""A knot chart: the yarn's place in the list, one a knot, row 0 on top."""
