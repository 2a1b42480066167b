"""Lists of points and of angles, read from a text: `(12mm,4mm) (18.5mm,9.5mm)` and `20deg 65deg`.

Every number takes its unit, 0 alone needs none: a list of bare ones is as likely in millimetres and degrees as in SI.
"""

import re

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.errors import ParameterError, UnitError
from ilmek.units import parse_quantity

_POINT = re.compile(r"\(([^(),;]*)[,;]([^(),;]*)\)")
_ITEM = re.compile(r"[^\s,;]+(?:\s+(?![+\-.\d])[^\s,;]+)?")
"""A number, and its unit after a space."""

_BARE = re.compile(r"[+-]?[\d.]+(?:[eE][+-]?\d+)?")
POINTS, ANGLES = "points are written (12mm,4mm) (18.5mm,9.5mm)", "angles are written 20deg 65deg"


def read_points(name: str, text: str) -> ComplexArray:
    """The points of a text as complex numbers [m]. Raises ParameterError where it holds anything else.

    >>> read_points("points", "(1cm,4mm) (0, -2mm)").tolist()
    [(0.01+0.004j), -0.002j]
    """
    pairs = _POINT.findall(text)
    if not pairs or _POINT.sub("", text).strip(" ,;"):
        raise ParameterError(f"{name}={text!r} is no list of points", do=POINTS)
    return np.array([complex(*(_quantity(name, one, "mm") for one in pair)) for pair in pairs])


def read_angles(name: str, text: str) -> FloatArray:
    """The angles of a text [rad]. Raises ParameterError where it holds anything else.

    >>> read_angles("angles", "0, 1rad -0.5 rad").tolist()
    [0.0, 1.0, -0.5]
    """
    found = _ITEM.findall(text)
    if not found:
        raise ParameterError(f"{name}={text!r} is no list of angles", do=ANGLES)
    return np.array([_quantity(name, one, "deg") for one in found])


def _quantity(name: str, text: str, unit: str) -> float:
    """One number of a list, in SI."""
    item = text.strip()
    if _BARE.fullmatch(item) and item.strip("+-0."):
        raise ParameterError(f"{name}: {item} has no unit", do=f"did you mean {item}{unit}?")
    try:
        return parse_quantity(item, unit)
    except UnitError as error:
        raise ParameterError(f"{name}: {error.given}", allowed=error.allowed, do=error.do) from None
