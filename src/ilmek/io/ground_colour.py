"""Ground: the colour that is put behind the transparent parts of a picture, so that its outline is seen.

The picture is averaged to about the knots of a small carpet. Its outline are the points that cover more than half of
the ground, as far as the picture covers it at all, and touch points that do not. A point of it is seen where it, or a
neighbour within the outline, differs from the ground by SEEN: art with a dark contour is seen on white whatever it is
filled with; of a shadow, which covers a part of the ground at most, that part of SEEN is enough.
"""

import math
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


LEAST_ART = 0.25
"""Share of the picture in the bounding box of what is not transparent, below which the margin is worth cropping."""


class Ground(NamedTuple):
    """The colour behind transparent parts, and the share of the outline that is hidden on it [-].

    art  left, top, right and bottom of what is not transparent, whole percent of the sides, a percent of margin with it
    rim  the most frequent colour beside the outline
    """

    colour: Colour
    hidden: float = 0.0
    art: tuple[int, int, int, int] = (0, 0, 100, 100)
    rim: Colour = WHITE

    @property
    def crop(self) -> str | None:
        """The art alone, as the option crop has it; None where the picture has no wide margin."""
        left, top, right, bottom = self.art
        small = (right - left) * (bottom - top) < LEAST_ART * 100**2
        return f"{left}%,{top}% {right}%,{bottom}%" if small else None


def _art(cover: FloatArray) -> tuple[int, int, int, int]:
    """The bounding box of what covers the ground."""
    sides = []
    for axis in (0, 1):
        shares = 100 * np.flatnonzero(cover.max(axis=axis) > 0.05) / cover.shape[1 - axis]
        width = 100 / cover.shape[1 - axis]
        sides.append((math.floor(max(0.0, shares[0] - 1)), math.ceil(min(100.0, shares[-1] + width + 1))))
    (left, right), (top, bottom) = sides
    return left, top, right, bottom


def contrasting_ground(art: Image.Image) -> Ground:
    """The ground for a picture in the mode RGBA.

    >>> art = Image.new("RGBA", (60, 60))
    >>> art.paste((250, 250, 250, 255), (10, 10, 50, 50))
    >>> contrasting_ground(art)
    Ground(colour=(32, 32, 32), hidden=0.0, art=(15, 15, 85, 85), rim=(250, 250, 250))
    """
    few = art.reduce(max(1, max(art.size) // _POINTS))
    codes = np.asarray(few, dtype=float)
    cover = codes[..., 3] / 255
    inside = cover > 0.5 * cover.max()
    outline = inside & (_greatest_around(~inside) > 0)
    if not outline.any():
        return Ground(WHITE)
    box, rim = _art(cover), _rim(codes[(cover == cover.max()) & (_greatest_around(_greatest_around(~inside)) > 0)])

    def hidden(colour: Colour) -> float:
        mixed = cover[..., None] * codes[..., :3] + (1 - cover[..., None]) * colour
        labs = srgb_to_lab(np.rint(mixed).astype(np.uint8))
        contrast = delta_e_2000(labs, srgb_to_lab(np.array(colour, dtype=np.uint8)))
        return float(np.mean(_greatest_around(np.where(inside, contrast, 0.0))[outline] < SEEN * cover.max()))

    white, *others = (Ground(colour, hidden(colour), box, rim) for colour in (WHITE, DARK, GREY))
    if white.hidden <= MOST_HIDDEN:
        return white
    best = min(others, key=lambda ground: ground.hidden)
    return best if best.hidden < white.hidden / 2 else white


def _rim(codes: FloatArray) -> Colour:
    """The most frequent of the codes of red, green, blue and cover."""
    if not len(codes):
        return WHITE
    colours, counts = np.unique(np.rint(codes[:, :3]).astype(int), axis=0, return_counts=True)
    red, green, blue = colours[counts.argmax()].tolist()
    return red, green, blue


def _greatest_around(values: FloatArray) -> FloatArray:
    """The greatest of each value and its eight neighbours."""
    padded = np.pad(values, 1, mode="edge")
    greatest: FloatArray = np.lib.stride_tricks.sliding_window_view(padded, (3, 3)).max(axis=(-2, -1))
    return greatest
