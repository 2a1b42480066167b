"""Colour names: a shade in words, from its CIELAB, like dark green.

A name is a hue, by the angle of (a, b), and at most one word on lightness or chroma; brown, beige and olive are the
names of dark and of pale orange and yellow. The bounds are chosen by this project on the colours of sRGB: its red lies
at 40 degrees, yellow 103, green 136, cyan 196, blue 306 and magenta 328.
"""

from collections.abc import Iterable

import numpy as np

from ilmek.arrays import FloatArray

_NEUTRAL = 6.0
"""Chroma below which a colour is a grey."""

_GREYS = ((12.0, "black"), (27.0, "charcoal"), (46.0, "dark grey"), (66.0, "mid grey"), (83.0, "light grey"),
          (95.0, "pale grey"))  # fmt: skip
"""Lightness up to which a grey has a name; white above."""

_HUES = ((16.0, "rose"), (50.0, "red"), (68.0, "orange"), (88.0, "amber"), (108.0, "yellow"), (128.0, "lime"),
         (165.0, "green"), (186.0, "sea green"), (225.0, "turquoise"), (272.0, "sky blue"), (311.0, "blue"),
         (324.0, "violet"), (345.0, "magenta"), (360.0, "rose"))  # fmt: skip
"""Hue angle in degrees up to which a hue has a name."""

_EARTHS = frozenset({"red", "orange", "amber", "yellow", "lime"})
_PLAIN = frozenset({"cream", "beige"})
_BRIGHT = frozenset({"yellow", "lime", "green", "sea green", "turquoise"})
"""Hues that are light where they are strong."""


def colour_name(lab: FloatArray) -> str:
    """The name of a colour; it has no number.

    lab  CIELAB, (3,)

    >>> colour_name(np.array([28.8, -15.6, 10.0])), colour_name(np.array([53.2, 80.1, 67.2]))
    ('dark green', 'bright red')
    >>> colour_name(np.array([50.0, 0.0, 0.0])), colour_name(np.array([30.0, 11.0, 18.0]))
    ('mid grey', 'dark brown')
    """
    lightness, a, b = (float(one) for one in lab)
    chroma, angle = float(np.hypot(a, b)), float(np.degrees(np.arctan2(b, a)) % 360)
    if chroma < _NEUTRAL:
        return next((name for most, name in _GREYS if lightness < most), "white")
    hue = next(name for most, name in _HUES if angle <= most)
    named = _earth(hue, lightness, chroma) if hue in _EARTHS else hue
    if named in _PLAIN:
        return named
    if chroma > 75:
        return f"bright {named}"
    dark, light = (45.0, 88.0) if hue in _BRIGHT and named == hue else (33.0, 76.0)
    if lightness < dark:
        return f"dark {named}"
    if lightness > light:
        return f"pale {named}" if chroma < 25 else f"light {named}"
    return f"soft {named}" if chroma < 20 else named


def _earth(hue: str, lightness: float, chroma: float) -> str:
    """The name of a red, orange or yellow that is dark or pale."""
    if hue == "red":
        return "pink" if lightness > 55 and chroma < 55 else "brown" if chroma < 28 else hue
    if hue in ("yellow", "lime"):
        return "olive" if lightness < 65 else "cream" if lightness > 82 and chroma < 30 else hue
    return "beige" if lightness > 68 and chroma < 35 else "brown" if lightness < 56 and chroma < 62 else hue


def unique_name(name: str, taken: Iterable[str]) -> str:
    """The name, with the least number from 2 on that makes it another than those taken; case does not count.

    >>> unique_name("dark green", ["Dark green", "dark green 2"])
    'dark green 3'
    """
    others = {one.casefold() for one in taken}
    number, free = 1, name
    while free.casefold() in others:
        number += 1
        free = f"{name} {number}"
    return free
