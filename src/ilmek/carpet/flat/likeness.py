"""Likeness: whether a picture that is read as a drawing still looks like itself.

A picture may pass the decision and yet lose what it shows: a texture of one hue, a plant whose leaves are finer than
its true colours, a picture of 16 × 16 pixels whose tones are fewer pixels than make a true colour. So the picture is
read, on at most SIDE pixels along its longer side, and compared with itself by the mean light of blocks of BLOCK ×
BLOCK pixels; small pictures, where each pixel is several knots, pixel by pixel. It does not look like itself where

    the mean CIEDE2000 is above MOST_OFF; of a small picture, where one block in twenty is above it; or
    of the contrasts between blocks that are neighbours, less than LEAST_CONTRAST are kept; or
    on more than MOST_FAR of its pixels all AREA × AREA around differ by FAR or more: a highlight that became the ground

The limits were set by looking at 137 pictures of free packages; all that were read well are within 0.85 of MOST_OFF,
and within 0.6 of MOST_FAR. Smoothed edges are too narrow to fill an area.
"""

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter

from ilmek.arrays import Float, FloatArray, Rgb
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.design import resampled
from ilmek.carpet.flat.reading import flat_design
from ilmek.carpet.flat.true_colours import TrueColours

SIDE, BLOCK = 640, 16
"""Longer side on which a picture is read, and of a block [pixels]: 40 blocks."""

SMALL = 96
"""Longer side [pixels] up to which each pixel counts."""

MOST_OFF, LEAST_CONTRAST = 3.2, 0.8
"""Greatest mean CIEDE2000 of the blocks, and least share of their contrasts."""

AREA, FAR, MOST_FAR = 5, 12.0, 4e-3
"""Side of an area [pixels], CIEDE2000 from which it has another colour, and largest share of such pixels."""

_FAINT = 6.0
"""CIEDE2000 from which two blocks are a contrast; a picture without any has none to lose, but for grain."""

_CODES = 5
"""Greatest difference of a channel below which no two colours differ by FAR."""


def looks_like_itself(rgb: Rgb, true: TrueColours) -> bool:
    """Whether the drawing of these true colours looks like its picture."""
    height, width = rgb.shape[:2]
    scale, small = min(1.0, SIDE / max(height, width)), max(height, width) <= SMALL
    grid = max(1, round(scale * height)), max(1, round(scale * width))
    picture = resampled(rgb, *grid)
    drawing = flat_design(picture, grid, true=true).colours
    block = 1 if small else min(BLOCK, *grid)
    seen, read = (_blocks(design, block) for design in (picture, drawing))
    off = delta_e_2000(seen, read)
    if float(np.percentile(off, 95) if small else off.mean()) > MOST_OFF:
        return False
    if not small and _share_far(picture, drawing) > MOST_FAR:
        return False
    contrasts = np.concatenate([_contrasts(seen, read, axis) for axis in (0, 1)], axis=-1)
    return float(contrasts[1].sum()) >= LEAST_CONTRAST * float(contrasts[0].sum())


def _blocks(design: Rgb, block: int) -> Float[np.ndarray, "rows columns 3"]:
    """CIELAB of the mean light of the blocks; what is left over at the edges is left out."""
    rows, columns = design.shape[0] // block, design.shape[1] // block
    return np.asarray(srgb_to_lab(resampled(design[: rows * block, : columns * block], rows, columns)))


def _share_far(picture: Rgb, drawing: Rgb) -> float:
    """The share of the pixels in areas that are far; by codes first, which are quick."""
    codes = np.maximum(picture, drawing) - np.minimum(picture, drawing)
    apart = minimum_filter(codes.max(axis=-1), AREA) >= _CODES
    if np.mean(apart) <= MOST_FAR:
        return 0.0
    near = maximum_filter(apart, AREA)
    off = np.zeros(near.shape)
    off[near] = delta_e_2000(srgb_to_lab(picture[near]), srgb_to_lab(drawing[near]))
    return float(np.mean(minimum_filter(off, AREA) >= FAR))


def _contrasts(seen: FloatArray, read: FloatArray, axis: int) -> FloatArray:
    """CIEDE2000 of neighbours along an axis, where it is a contrast, and what the drawing keeps of it."""
    one, other = [slice(None)] * 2, [slice(None)] * 2
    one[axis], other[axis] = slice(1, None), slice(None, -1)
    there, kept = (delta_e_2000(labs[tuple(one)], labs[tuple(other)]) for labs in (seen, read))
    clear = there >= _FAINT
    return np.stack([there[clear], np.minimum(there, 2.0 * kept)[clear]])
