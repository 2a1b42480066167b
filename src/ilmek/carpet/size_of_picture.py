"""The size of a carpet that takes the shape of its picture.

The proportions are those of the picture, width : length. With one side given the other follows. With none the carpet is
one of the standard sizes near seccade, upright or lying, where its proportions are near; else it has seccade's area.
Its sides are whole centimetres and whole knots where both can be.
"""

import math
from dataclasses import replace

from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import LARGEST, SMALLEST, STANDARD_SIZES, CarpetSize
from ilmek.errors import CarpetError
from ilmek.units import cm, format_number

NEAR = 0.02
"""Largest relative difference of proportions within which a standard size is taken: the picture is then stretched by no
more, which is not noticeable, and never cropped.
"""

USUAL_SIZE = STANDARD_SIZES["seccade"]

_OFFERED = [size for size in STANDARD_SIZES.values() if 0.6 < size.area / USUAL_SIZE.area < 1.6]
"""The standard sizes of that kind: a picture of 5 : 8 is no cushion of 25 × 40 cm."""

_AREAS = 1.15
"""Greatest ratio of the area to seccade's, and of seccade's to it, for sides that are whole centimetres and knots."""

_UNEVEN = 0.01
"""Difference of proportions above which a side is rounded to whole knots alone."""

_LARGEST_STEP = 10
"""Longest step [cm] that is tried for whole knots."""

_AREA_WEIGHT = 0.05
"""Weight of the relative difference of the area beside that of the proportions."""


def size_of_picture(
    proportions: float, quality: Quality, *, width: float | None = None, length: float | None = None
) -> CarpetSize:
    """The size of a carpet whose proportions, width : length, are a picture's up to NEAR.

    width, length  of the carpet [m], where one of them is given
    Raises CarpetError for proportions that no carpet has, and for a side out of bounds.

    >>> quality = Quality(250.0, 250.0)
    >>> print(size_of_picture(2 / 3, quality), size_of_picture(4 / 3, quality), sep="; ")
    seccade, 120 × 180 cm; 168 × 126 cm
    >>> print(size_of_picture(3 / 4, quality, width=0.9))
    90 × 120 cm
    """
    if width is not None or length is not None:
        return _of_a_side(proportions, quality, width, length)
    upright = min(proportions, 1 / proportions)
    near = [size for size in _OFFERED if abs(size.width / size.length / upright - 1) <= NEAR]
    if near:
        size = min(near, key=lambda one: (_apart(one.width / one.length, upright), _apart(one.area, USUAL_SIZE.area)))
    else:
        size = _of_the_area(upright, quality if proportions <= 1 else Quality(quality.along, quality.across))
    return size if proportions <= 1 else replace(size, width=size.length, length=size.width)


def unrounded_size(proportions: float, *, width: float | None = None, length: float | None = None) -> CarpetSize:
    """The size with exactly these proportions of which one side is given [m]. Raises CarpetError as `CarpetSize`."""
    if width is None:
        assert length is not None
        width = length * proportions
    return CarpetSize(width, width / proportions if length is None else length)


def _of_a_side(proportions: float, quality: Quality, width: float | None, length: float | None) -> CarpetSize:
    """The size of which one side is given; the other is rounded as far as the proportions allow."""
    exact = unrounded_size(proportions, width=width, length=length)
    if width is None:
        return replace(exact, width=_rounded(exact.width, quality.across))
    return replace(exact, length=_rounded(exact.length, quality.along))


def _rounded(side: float, density: float) -> float:
    for step, allowed in ((_step(density), _UNEVEN), (cm, _UNEVEN), (1 / density, NEAR)):
        found = max(1, round(side / step)) * step
        if abs(found / side - 1) <= allowed:
            return float(round(found, 9))
    return side


def _of_the_area(proportions: float, quality: Quality) -> CarpetSize:
    """The upright size near seccade's area; of sides of whole centimetres and knots those nearest in proportions."""
    width = math.sqrt(USUAL_SIZE.area * proportions)
    if width < SMALLEST or width / proportions > LARGEST:
        raise CarpetError(
            f"a carpet in the picture's proportions, {format_number(1 / proportions)} : 1, would be "
            f"{format_number(width / cm)} × {format_number(width / proportions / cm)} cm",
            allowed=f"sides of {format_number(SMALLEST / cm)} cm to {format_number(LARGEST)} m",
            do="give both sides, like --size 120x180cm, and --fit, or a part of the picture by --crop",
        )
    for steps in ((_step(quality.across), _step(quality.along)), (1 / quality.across, 1 / quality.along)):
        sizes = [
            (across * steps[0], max(1, round(across * steps[0] / proportions / steps[1])) * steps[1])
            for across in range(
                max(1, math.ceil(width / math.sqrt(_AREAS) / steps[0])), int(width * math.sqrt(_AREAS) / steps[0]) + 1
            )
        ]
        fitting = [sides for sides in sizes if _apart(sides[0] / sides[1], proportions) <= NEAR / 2]
        if fitting:
            best = min(fitting, key=lambda sides: _cost(sides, proportions))
            return CarpetSize(round(best[0], 9), round(best[1], 9))
    return CarpetSize(width, width / proportions)


def _cost(sides: tuple[float, float], proportions: float) -> float:
    return _apart(sides[0] / sides[1], proportions) + _AREA_WEIGHT * _apart(sides[0] * sides[1], USUAL_SIZE.area)


def _step(density: float) -> float:
    """The least whole number of centimetres that is a whole number of knots; 1 cm where none is."""
    for centimetres in range(1, _LARGEST_STEP + 1):
        knots = centimetres * cm * density
        if abs(knots - round(knots)) < 1e-6:
            return centimetres * cm
    return cm


def _apart(one: float, other: float) -> float:
    """Relative difference, the same both ways."""
    return abs(math.log(one / other))
