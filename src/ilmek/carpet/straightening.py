"""Straightening: a carpet photographed at an angle, resampled to a rectangle.

The rectangle has the carpet's true proportions. They follow from the four corners, the picture's centre, at which the
camera points, and the focal length, which the corners give too unless two sides are parallel in the picture.

Source: Z. Zhang, L.-W. He, Whiteboard scanning and image enhancement, Digital Signal Processing 17 (2007) 414-432, 3.
"""

import math

import numpy as np

from ilmek.arrays import Rgb
from ilmek.carpet.picture_points import Points
from ilmek.carpet.projection import MadeRgb, onto_corners, projected
from ilmek.errors import PictureError
from ilmek.progress import SILENT, Progress
from ilmek.sentences import Sentence

ORDER = Sentence("picture.corners-order")

_FOCAL = 0.8
"""Focal length where the corners give none, in long sides of the picture: a lens of 29 mm on film of 36 mm."""

_FOCALS = (0.4, 4.0)
"""Range in which a focal length is credible, likewise."""

_FLATTEST = 0.01
"""Least sine of the angle between two sides at a corner."""


def check_corners(corners: Points, width: int, height: int, given: str) -> None:
    """Raise PictureError unless the corners are in the picture and those of a convex quadrilateral, clockwise."""
    if (corners < 0).any() or (corners > (width, height)).any():
        allowed = Sentence("picture.crop-bounds", width=width, height=height)
        raise PictureError(Sentence("picture.corners-outside", given=given), allowed=allowed)
    ahead, behind = np.roll(corners, -1, axis=0) - corners, corners - np.roll(corners, 1, axis=0)
    turns = behind[:, 0] * ahead[:, 1] - behind[:, 1] * ahead[:, 0]
    lengths = np.hypot(*ahead.T) * np.hypot(*behind.T)
    if (lengths == 0).any():
        raise PictureError(Sentence("picture.corners-one-point", given=given), do=ORDER)
    if (np.abs(turns) < _FLATTEST * lengths).any():
        raise PictureError(Sentence("picture.corners-on-line", given=given), do=ORDER)
    if (turns < 0).all():
        raise PictureError(Sentence("picture.corners-anticlockwise", given=given), do=ORDER)
    if (turns < 0).any():
        raise PictureError(Sentence("picture.corners-cross", given=given), do=ORDER)


def true_proportions(corners: Points, width: int, height: int) -> float:
    """Width over length of the rectangle whose corners are photographed [Zhang and He 2007, eq. 11, 20].

    width, height  of the picture [pixels]
    """
    centred = corners - (0.5 * width, 0.5 * height)
    top_left, top_right, bottom_right, bottom_left = np.column_stack([centred, np.ones(4)])
    across = np.cross(top_left, bottom_right)
    k2 = (across @ bottom_left) / (np.cross(top_right, bottom_right) @ bottom_left)
    k3 = (across @ top_right) / (np.cross(bottom_left, bottom_right) @ top_right)
    n2, n3 = k2 * top_right - top_left, k3 * bottom_left - top_left
    long = max(width, height)
    square = 0.0 if n2[2] * n3[2] == 0 else -float(n2[0] * n3[0] + n2[1] * n3[1]) / float(n2[2] * n3[2])
    focal = math.sqrt(square) if square > 0 else 0.0
    if not _FOCALS[0] * long <= focal <= _FOCALS[1] * long:
        focal = _FOCAL * long
    wide, high = (math.sqrt((n[0] ** 2 + n[1] ** 2) / focal**2 + n[2] ** 2) for n in (n2, n3))
    return wide / high


def straightened(rgb: Rgb, corners: Points, proportions: float, progress: Progress = SILENT) -> MadeRgb:
    """The carpet between four corners as an upright rectangle of those proportions, width over length.

    It is as large as its longer sides in the picture, with at most the picture's number of pixels.
    """
    sides = np.hypot(*(np.roll(corners, -1, axis=0) - corners).T).tolist()
    wide, high = max(sides[0], sides[2]), max(sides[1], sides[3])
    wide, high = max(wide, high * proportions), max(high, wide / proportions)
    scale = min(1.0, math.sqrt(rgb.shape[0] * rgb.shape[1] / (wide * high)))
    shape = max(1, round(scale * high)), max(1, round(scale * wide))
    return projected(rgb, shape, onto_corners(shape[1], shape[0], corners), None, progress)
