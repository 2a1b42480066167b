"""Round picture: an opaque circle or ellipse that fills its frame, with transparent corners, as of a round rug."""

import numpy as np
from PIL import Image

from ilmek.io.picture_pixels import cover

LEAST_COMMON = 0.98
"""Least area that the opaque part and the ellipse in its bounding box have in common, of the area of both."""

MOST_MARGIN = 0.03
"""Largest share of the frame beside the bounding box, in width and in height."""

_LONGEST = 256
"""Pixels of the longer side of the picture of which that is judged."""


def share_outside(image: Image.Image) -> float:
    """Share of a loaded picture that lies outside of its round or oval outline [-]; 0 of every other picture.

    >>> share_outside(Image.new("RGBA", (40, 40), (0, 0, 0, 255)))
    0.0
    """
    scale = max(1.0, max(image.size) / _LONGEST)
    few = image.resize([max(1, round(side / scale)) for side in image.size], Image.Resampling.NEAREST)
    hiding = cover(few)
    box = None if hiding is None else hiding.point(lambda code: 255 * (code >= 128)).getbbox()
    if hiding is None or box is None:
        return 0.0
    left, top, right, bottom = box
    if right - left < (1 - MOST_MARGIN) * few.width or bottom - top < (1 - MOST_MARGIN) * few.height:
        return 0.0
    seen = np.asarray(hiding) >= 128
    y, x = np.mgrid[0.5 : few.height, 0.5 : few.width]
    across, along = 2 * (x - left) / (right - left) - 1, 2 * (y - top) / (bottom - top) - 1
    oval = across**2 + along**2 <= 1
    common = np.count_nonzero(seen & oval) / np.count_nonzero(seen | oval)
    return 1 - float(np.mean(oval)) if common >= LEAST_COMMON else 0.0
