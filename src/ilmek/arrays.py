"""Array types of the package.

A *field* is a value or an array of values of any batch shape; formulas take and return fields, so that one
formula applies to one pose or a million.

Shapes and kinds of arrays are declared by `Float[np.ndarray, "rows columns"]` and its like. They are those of jaxtyping
for a type checker, and where jaxtyping is loaded before this module: in the tests that check shapes (jaxtyping and
beartype). Elsewhere they are not used; loading jaxtyping would take half the time of loading numpy.
"""

import sys
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

__all__ = [
    "Bool",
    "BoolArray",
    "Complex",
    "ComplexArray",
    "ComplexField",
    "Float",
    "Float32",
    "FloatArray",
    "Indices",
    "Inexact",
    "Int",
    "Int8",
    "Int32",
    "Int64",
    "IntArray",
    "Num",
    "NumberArray",
    "Pixels",
    "RealField",
    "Rgb",
    "UInt8",
]

if TYPE_CHECKING or "jaxtyping" in sys.modules:
    from jaxtyping import Bool, Complex, Float, Float32, Inexact, Int, Int8, Int32, Int64, Num, UInt8
else:

    class Unchecked:
        """An array type without checks of kind and shape: `Unchecked[np.ndarray, "n 2"]` is `np.ndarray`."""

        def __class_getitem__(cls, array_and_shape: tuple[type, str]) -> type:
            """The type of the array alone."""
            return array_and_shape[0]

    Bool = Complex = Float = Float32 = Inexact = Int = Int8 = Int32 = Int64 = Num = UInt8 = Unchecked

FloatArray: TypeAlias = Float[np.ndarray, "..."]
ComplexArray: TypeAlias = Complex[np.ndarray, "..."]
BoolArray: TypeAlias = Bool[np.ndarray, "..."]
IntArray: TypeAlias = Int[np.ndarray, "..."]
NumberArray: TypeAlias = Num[np.ndarray, "..."]

if TYPE_CHECKING:
    # For a type checker numbers of Python and NumPy are equal. It compares every kind of one operand with every kind of
    # the other; with all kinds below it takes five times as long.
    RealField: TypeAlias = float | Num[np.ndarray, "..."]
    ComplexField: TypeAlias = complex | Num[np.ndarray, "..."]
else:
    RealField = int | float | np.floating | np.integer | Num[np.ndarray, "..."]
    """A real number or a real array."""

    ComplexField = int | float | complex | np.number | Num[np.ndarray, "..."]
    """A complex number (a planar point or vector) or an array of them."""

Rgb: TypeAlias = UInt8[np.ndarray, "height width 3"]
"""A picture: sRGB, 8 bits a channel, row 0 on top."""

Pixels: TypeAlias = UInt8[np.ndarray, "_ _ 3"]
"""A picture of a size of its own, where a function has several."""

Indices: TypeAlias = UInt8[np.ndarray, "rows columns"]
"""A knot chart: index of the yarn in the list for each knot, row 0 on top."""
