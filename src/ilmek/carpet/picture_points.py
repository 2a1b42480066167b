"""Points of a picture and colours, read from texts: `10%,5% 90%,95%`, `120,80 1910,95 ...`, `#e8dfc8`."""

import re
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from ilmek.arrays import Float
from ilmek.errors import ParameterError, shortened
from ilmek.sentences import Sentence

Points: TypeAlias = Float[np.ndarray, "points 2"]
"""x to the right and y downwards [pixels]; (0, 0) is the upper left corner of the first pixel."""

Colour: TypeAlias = tuple[int, int, int]
"""Codes of sRGB, 0 to 255."""

LONGEST = 400
"""Largest number of characters of a list of points."""

_NUMBER = r"([+-]?(?:[0-9]{1,9}(?:\.[0-9]{0,9})?|\.[0-9]{1,9}))(%|px)?"
_POINT = re.compile(rf"\(?\s*{_NUMBER}\s*,\s*{_NUMBER}\s*\)?")
_BETWEEN = re.compile(r"[\s;]*")
_COLOUR = re.compile(r"#?([0-9a-fA-F]{2})([0-9a-fA-F]{2})([0-9a-fA-F]{2})")


def read_points(name: str, text: str, count: int, example: str) -> tuple[tuple[tuple[float, bool], ...], ...]:
    """The points of a text: for each the two numbers, and whether these are shares of the side (percent).

    Raises ParameterError unless the text holds `count` points; `example` shows how to write them.

    >>> read_points("crop", "10%,5% 300,200", 2, "")
    (((0.1, True), (0.05, True)), ((300.0, False), (200.0, False)))
    """
    given = f"{name}={shortened(text)!r}"
    if len(text) > LONGEST:
        raise ParameterError(
            Sentence("value.too-long", value=given),
            allowed=Sentence("value.at-most-characters", count=LONGEST),
            do=example,
        )
    points, at = [], 0
    while at < len(text.rstrip(" ;")):
        found = _POINT.match(text, at)
        if found is None:
            raise ParameterError(Sentence("picture.no-points", given=given), do=example)
        pairs = ((found[1], found[2]), (found[3], found[4]))
        points.append(tuple((float(value) * (0.01 if unit == "%" else 1.0), unit == "%") for value, unit in pairs))
        between = _BETWEEN.match(text, found.end())
        at = between.end() if between else found.end()
    if len(points) != count:
        raise ParameterError(
            Sentence("picture.one-point" if len(points) == 1 else "picture.points", given=given, count=len(points)),
            allowed=Sentence("picture.points-allowed", count=count),
            do=example,
        )
    return tuple(points)


def in_pixels(points: tuple[tuple[tuple[float, bool], ...], ...], width: int, height: int) -> Points:
    """The points in a picture of that width and height [pixels]."""
    sides = (width, height)
    return np.array(
        [
            [value * side if share else value for (value, share), side in zip(point, sides, strict=True)]
            for point in points
        ]
    )


def hex_colour(srgb: Sequence[int]) -> str:
    """The codes of a colour as `read_colour` reads them.

    >>> hex_colour((232, 223, 200))
    '#e8dfc8'
    """
    return "#{:02x}{:02x}{:02x}".format(*srgb)


def read_colour(name: str, text: str) -> tuple[int, int, int]:
    """The codes of `#rrggbb`, also without #. Raises ParameterError.

    >>> read_colour("ground", "#e8dfc8")
    (232, 223, 200)
    """
    found = _COLOUR.fullmatch(text)
    if found is None:
        raise ParameterError(
            Sentence("picture.no-colour", name=name, text=shortened(text)),
            allowed=Sentence("picture.colour-digits"),
            do=Sentence("picture.colour-example"),
        )
    return int(found[1], 16), int(found[2], 16), int(found[3], 16)
