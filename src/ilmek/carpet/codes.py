"""Arrays that a caller gives, as the 8-bit codes that compiled kernels index by.

A kernel does not check an index: a number outside of its table would read or write memory of something else. So the
records that hold such arrays, `carpet.chart.Chart` and `io.picture.Picture`, check and convert them once, here.
"""

import numpy as np

from ilmek.arrays import BoolArray, UInt8
from ilmek.errors import IlmekError
from ilmek.num.compiled import uncounted

CODES = 256
"""Entries of a table that every 8-bit code is in."""

NO_KNOT = CODES - 1
"""Code of a chart's cell without a knot: there are at most 255 yarns, numbered from 0."""


@uncounted
def _recode(
    codes: UInt8[np.ndarray, "rows columns"], table: UInt8[np.ndarray, "256"], out: UInt8[np.ndarray, "rows columns"]
) -> None:
    for row in range(codes.shape[0]):
        for column in range(codes.shape[1]):
            out[row, column] = table[codes[row, column]]


def recoded(
    codes: UInt8[np.ndarray, "rows columns"], table: UInt8[np.ndarray, " entries"]
) -> UInt8[np.ndarray, "rows columns"]:
    """Codes, each replaced by its entry of a table, which has one for each of them.

    >>> recoded(np.array([[0, 1, 1]], dtype=np.uint8), np.array([7, 5], dtype=np.uint8)).tolist()
    [[7, 5, 5]]
    """
    whole, out = np.zeros(CODES, dtype=np.uint8), np.empty(codes.shape, dtype=np.uint8)
    whole[: len(table)] = table
    _recode(codes, whole, out)
    return out


@uncounted
def _mark(first: UInt8[np.ndarray, "rows columns"], second: UInt8[np.ndarray, "rows columns"], seen: BoolArray) -> None:
    for row in range(first.shape[0]):
        for column in range(first.shape[1]):
            seen[first[row, column], second[row, column]] = True


def pairs_of_codes(
    first: UInt8[np.ndarray, "rows columns"], second: UInt8[np.ndarray, "rows columns"]
) -> UInt8[np.ndarray, "pairs 2"]:
    """The pairs of codes that two arrays have at one place, in ascending order.

    >>> pairs_of_codes(np.array([[3, 0, 3]], dtype=np.uint8), np.array([[1, 2, 1]], dtype=np.uint8)).tolist()
    [[0, 2], [3, 1]]
    """
    seen = np.zeros((CODES, CODES), dtype=bool)
    _mark(first, second, seen)
    return np.argwhere(seen).astype(np.uint8)


def eight_bits(
    values: object, name: str, most: int, meaning: str, error: type[IlmekError], *, kinds: str = "biuf"
) -> UInt8[np.ndarray, "..."]:
    """Whole numbers 0 to `most` <= 255 as uint8 in the order of C; an array that is so already is returned as it is.

    name     of the array, as `knots`          meaning  of its numbers, as `an index in the list of 2 yarns`
    kinds    of NumPy that are converted: b(ool), i(nteger), u(nsigned), f(loat) of whole numbers
    Raises `error` for another type, masked elements, and any number that is not whole or not in the range.

    >>> eight_bits([[0, 1], [1, 0]], "knots", 1, "an index", IlmekError).dtype
    dtype('uint8')
    """
    allowed = f"whole numbers 0 to {most}: {meaning}"
    if np.ma.is_masked(values):
        raise error(f"{name} has masked elements", allowed=allowed, do="fill them first")
    try:
        array = np.asarray(values)
    except ValueError:
        raise error(f"{name} has rows of different lengths", allowed=allowed) from None
    if array.dtype.kind not in kinds:
        raise error(f"{name} has the type {array.dtype}", allowed=allowed)
    if array.dtype != np.uint8 or most < CODES - 1:
        _require_range(array, name, most, allowed, error)
    return np.ascontiguousarray(array, dtype=np.uint8)


def _require_range(array: np.ndarray, name: str, most: int, allowed: str, error: type[IlmekError]) -> None:
    """Raise `error` for the first number that is not whole, below 0 or above `most`."""
    if not array.size or (array.dtype.kind in "bu" and int(array.max()) <= most):
        return
    inside = (array >= 0) & (array <= most)
    if array.dtype.kind == "f":
        inside &= array == np.floor(array)
    if not inside.all():
        first = np.unravel_index(int(np.argmin(inside)), array.shape)
        raise error(f"{name}[{', '.join(map(str, map(int, first)))}] is {array[first]:g}", allowed=allowed)
