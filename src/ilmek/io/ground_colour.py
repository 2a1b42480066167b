"""Ground: the colour that is put behind the transparent parts of a picture, so that its outline is seen.

The picture is averaged to about the knots of a small carpet. Its outline are the points that cover more than half of
the ground, as far as the picture covers it at all, and touch points that do not. A point of it is seen where it, or a
neighbour within the outline, differs from the ground by SEEN: art with a dark contour is seen on white whatever it is
filled with.
"""

from typing import NamedTuple

import numpy as np
from PIL import Image

from ilmek.arrays import FloatArray
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.picture_points import Colour

WHITE, DARK, GREY = (255, 255, 255), (32, 32, 32), (128, 128, 128)
"""Colours of the ground, white first."""

SEEN = 15.0
"""CIEDE2000 from which a point differs from the ground: less is lost where a drawing's colours become few."""

MOST_HIDDEN = 0.08
"""Share of the outline that may be hidden on white; beyond it, a ground that hides less than half of that is taken."""

_POINTS = 160
"""Points of the longer side, about, on which a picture is judged."""


class Ground(NamedTuple):
    """The colour behind transparent parts, and the share of the outline that is hidden on it [-]."""

    colour: Colour
    hidden: float = 0.0


def contrasting_ground(art: Image.Image) -> Ground:
    """The ground for a picture in the mode RGBA.

    >>> art = Image.new("RGBA", (60, 60))
    >>> art.paste((250, 250, 250, 255), (10, 10, 50, 50))
    >>> contrasting_ground(art)
    Ground(colour=(32, 32, 32), hidden=0.0)
    """
    few = art.reduce(max(1, max(art.size) // _POINTS))
    codes = np.asarray(few, dtype=float)
    cover = codes[..., 3] / 255
    inside = cover > 0.5 * cover.max()
    outline = inside & (_greatest_around(~inside) > 0)
    if not outline.any():
        return Ground(WHITE)

    def hidden(colour: Colour) -> float:
        mixed = cover[..., None] * codes[..., :3] + (1 - cover[..., None]) * colour
        labs = srgb_to_lab(np.rint(mixed).astype(np.uint8))
        contrast = delta_e_2000(labs, srgb_to_lab(np.array(colour, dtype=np.uint8)))
        return float(np.mean(_greatest_around(np.where(inside, contrast, 0.0))[outline] < SEEN))

    white, *others = (Ground(colour, hidden(colour)) for colour in (WHITE, DARK, GREY))
    if white.hidden <= MOST_HIDDEN:
        return white
    best = min(others, key=lambda ground: ground.hidden)
    return best if best.hidden < white.hidden / 2 else white


def _greatest_around(values: FloatArray) -> FloatArray:
    """The greatest of each value and its eight neighbours."""
    padded = np.pad(values, 1, mode="edge")
    return np.lib.stride_tricks.sliding_window_view(padded, (3, 3)).max(axis=(-2, -1))
