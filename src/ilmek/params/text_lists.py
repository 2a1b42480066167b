"""Lists read from a text: points `(12mm,4mm) (18.5mm,9.5mm)`, poses `(0mm,0mm,10deg)`, angles `20deg 65deg`, bounds.

Every number takes its unit, 0 alone needs none: a list of bare ones is as likely in millimetres and degrees as in SI.
"""

import math
import re
from typing import NamedTuple, TypeAlias

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.errors import ParameterError, UnitError, restated
from ilmek.units import counted, parse_quantity

_BRACKETS = re.compile(r"\(([^()]*)\)")
_ITEM = re.compile(r"[^\s,;]+(?:\s+(?![+\-.\d])[^\s,;]+)?")
"""A number, and its unit after a space."""

_BARE = re.compile(r"[+-]?[\d.]+(?:[eE][+-]?\d+)?")
POINTS, ANGLES = "points are written (12mm,4mm) (18.5mm,9.5mm)", "angles are written 20deg 65deg"
POSES, PAIRS = "poses are written (0mm,0mm,10deg) (25mm,15mm,3deg)", "pairs are written (1,0) (2,0.301)"
REGIONS = "a region is written (0,0) (40mm,20mm), or as the corners of a polygon"
MOST_CORNERS = 60
FREE = "free"
_ITEM_OR_FREE = re.compile(rf"{FREE}|[^\s,;]+(?:\s+(?!{FREE}|[+\-.\d])[^\s,;]+)?")
ANGLES_OR_FREE = f"angles are written 20deg {FREE} 65deg"
BOUNDS = "bounds are written 10mm..60mm, ..60mm, 10mm.. or 60mm alone"


Bounds: TypeAlias = tuple[float, float]
"""Least and most."""


class BodyPoses(NamedTuple):
    """Poses of a body in a list: positions of one of its points [m] and its angles [rad]."""

    points: Complex[np.ndarray, " poses"]
    angles: Float[np.ndarray, " poses"]


def read_points(name: str, text: str) -> ComplexArray:
    """The points of a text as complex numbers [m]. Raises ParameterError where it holds anything else.

    >>> read_points("points", "(1cm,4mm) (0, -2mm)").tolist()
    [(0.01+0.004j), -0.002j]
    """
    return np.array([complex(*row) for row in _rows(name, text, ("mm", "mm"), "points", POINTS)])


def read_poses(name: str, text: str) -> BodyPoses:
    """The poses of a text, x and y of a point and the body's angle. Raises ParameterError where it holds anything else.

    >>> read_poses("poses", "(1cm,4mm,0) (0,-2mm,1rad)").angles.tolist()
    [0.0, 1.0]
    """
    rows = np.array(_rows(name, text, ("mm", "mm", "deg"), "poses", POSES))
    return BodyPoses(rows[:, 0] + 1j * rows[:, 1], rows[:, 2].copy())


def read_pairs(name: str, text: str) -> Float[np.ndarray, "pairs 2"]:
    """The pairs of plain numbers of a text. Raises ParameterError where it holds anything else.

    >>> read_pairs("samples", "(1, 0) (2, 0.301)").tolist()
    [[1.0, 0.0], [2.0, 0.301]]
    """
    return np.array(_rows(name, text, ("", ""), "pairs", PAIRS))


def read_angles(name: str, text: str) -> FloatArray:
    """The angles of a text [rad]. Raises ParameterError where it holds anything else.

    >>> read_angles("angles", "0, 1rad -0.5 rad").tolist()
    [0.0, 1.0, -0.5]
    """
    found = _ITEM.findall(text)
    if not found:
        raise ParameterError(f"{name}={text!r} is no list of angles", do=ANGLES)
    return np.array([_quantity(name, one, "deg") for one in found])


def read_angles_or_free(name: str, text: str) -> FloatArray:
    """The angles of a text [rad], NaN for the word `free`. Raises ParameterError where it holds anything else.

    >>> read_angles_or_free("coupler_angles", "0 free free 1rad 0.5 rad free").tolist()
    [0.0, nan, nan, 1.0, 0.5, nan]
    """
    found = _ITEM_OR_FREE.findall(text)
    if not found:
        raise ParameterError(f"{name}={text!r} is no list of angles", do=ANGLES_OR_FREE)
    return np.array([math.nan if one == FREE else _quantity(name, one, "deg") for one in found])


def read_two_points(name: str, text: str) -> ComplexArray:
    """Two points that differ, one for each link [m]. Raises ParameterError where the text holds anything else."""
    found = read_points(name, text)
    if len(found) != 2:
        raise ParameterError(f"{name} holds {counted(len(found), 'point')}", allowed="two, one for each link")
    if found[0] == found[1]:
        raise ParameterError(f"both {name} are one point", do="give two that differ")
    return found


def read_region(name: str, text: str) -> ComplexArray:
    """Corners of a polygon [m], counter-clockwise; of two points the rectangle between them.

    Raises ParameterError where the text holds anything else, the polygon has no area, or two of its sides cross.

    >>> read_region("region", "(0,0) (2cm,1cm)").tolist()
    [0j, (0.02+0j), (0.02+0.01j), 0.01j]
    """
    corners = read_points(name, text)
    if len(corners) == 2:
        low, high = corners
        corners = np.array([low, complex(high.real, low.imag), high, complex(low.real, high.imag)])
    if not 3 <= len(corners) <= MOST_CORNERS:
        raise ParameterError(
            f"{name} holds {counted(len(corners), 'point')}",
            allowed=f"two opposite corners of a rectangle, or 3 to {MOST_CORNERS} corners of a polygon",
        )
    area = 0.5 * float(np.sum(np.imag(np.conj(corners) * np.roll(corners, -1))))
    if abs(area) <= 1e-12 * float(np.max(np.abs(corners - corners[0]))) ** 2:
        raise ParameterError(f"{name} has no area", do=REGIONS)
    if _sides_cross(corners):
        raise ParameterError(f"two sides of {name} cross", do="give its corners in order")
    return corners if area > 0 else corners[::-1].copy()


def _sides_cross(corners: ComplexArray) -> bool:
    """Whether two sides of a polygon that are no neighbours meet."""
    count, ends = len(corners), np.roll(corners, -1)
    for one in range(count):
        for other in range(one + 2, count - (one == 0)):
            sides = corners[[one, other]], ends[[one, other]]
            if _apart(*sides) <= 0 and _apart(sides[0][::-1], sides[1][::-1]) <= 0:
                return True
    return False


def _apart(starts: ComplexArray, ends: ComplexArray) -> float:
    """Above 0 where both ends of the second side are on one side of the first."""
    along = np.conj(ends[0] - starts[0])
    return float(np.imag(along * (starts[1] - starts[0])) * np.imag(along * (ends[1] - starts[0])))


def read_bounds(name: str, text: str, unit: str = "mm", *, least: float = -math.inf) -> Bounds:
    """Least and most of a text like `10mm..60mm` [SI]; where one is left out, `..60mm`, it is `least` or infinite.

    A quantity alone is both.

    Raises ParameterError where it holds anything else, or the least is above the most.

    >>> read_bounds("crank", "0..60mm"), read_bounds("crank", "1cm.."), read_bounds("crank", "2cm")
    ((0.0, 0.06), (0.01, inf), (0.02, 0.02))
    """
    ends = [part.strip() for part in text.split("..")]
    if len(ends) == 1:
        ends *= 2
    if len(ends) != 2 or not any(ends):
        raise ParameterError(f"{name}={text!r} is no pair of bounds", do=BOUNDS)
    low, high = (
        _quantity(name, end, unit) if end else default for end, default in zip(ends, (least, math.inf), strict=True)
    )
    if low > high and all(ends):
        raise ParameterError(f"{name}={text}: the least is above the most", do=f"did you mean {ends[1]}..{ends[0]}?")
    return low, high


def _rows(name: str, text: str, units: tuple[str, ...], what: str, written: str) -> list[list[float]]:
    """Numbers of every bracket of a list, as many as there are units, in SI."""
    found = _BRACKETS.findall(text)
    if not found or _BRACKETS.sub("", text).strip(" ,;"):
        raise ParameterError(f"{name}={text!r} is no list of {what}", do=written)
    rows = [re.split("[,;]", one) for one in found]
    for row, one in zip(rows, found, strict=True):
        if len(row) != len(units):
            raise ParameterError(f"{name}: ({one}) holds {len(row)} numbers, not {len(units)}", do=written)
    return [[_quantity(name, *item) for item in zip(row, units, strict=True)] for row in rows]


def _quantity(name: str, text: str, unit: str) -> float:
    """One number of a list, in SI."""
    item = text.strip()
    if unit and _BARE.fullmatch(item) and item.strip("+-0."):
        raise ParameterError(f"{name}: {item} has no unit", do=f"did you mean {item}{unit}?")
    with restated(ParameterError, f"{name}: ", of=UnitError):
        return parse_quantity(item, unit)
