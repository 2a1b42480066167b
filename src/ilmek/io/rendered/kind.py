"""Which files are rendered, and their pixels as a PNG file, which is then read as any other.

A drawing has no pixels of its own. It is rendered with at least `PIXELS` on each side of a knot, also where the carpet
shows only a part of it, so that a true colour of each knot is seen.
"""

import io
import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from ilmek.arrays import UInt8
from ilmek.errors import PictureError

PIXELS = 4
"""Pixels on a side of a knot."""

LARGEST = 40_000_000
"""Largest number of pixels that are rendered."""

USUAL = (450, 300)
"""Rows and columns of knots for which a drawing is rendered where they are not known."""

RENDERED = (".svg", ".pdf", ".ai")
"""Endings of files that have other pixels for other knots."""

EXTRA = "pip install 'ilmek[vector]'"

_MARKUP = re.compile(
    rb"\s*(?:<\?xml[^>]*>|<!--.*?-->|<!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>|\s)*<(?:\w+:)?svg[\s>/]", re.DOTALL
)


@dataclass(frozen=True, slots=True)
class Rendering:
    """How a drawing is rendered: the page of a file of several, from 1; rows and columns of the knots."""

    page: int = 1
    knots: tuple[int, int] = USUAL


def is_svg(data: bytes) -> bool:
    """Whether the bytes of a file begin as an SVG drawing, behind a declaration, comments and a document type.

    >>> is_svg(b'<?xml version="1.0"?> <!-- a rug --><svg width="8">'), is_svg(b"<html><svg>")
    (True, False)
    """
    head = data[:65_536].removeprefix(b"\xef\xbb\xbf")
    if head[:2] in (b"\xff\xfe", b"\xfe\xff"):
        head = head[: len(head) // 2 * 2].decode("utf-16", "ignore").encode()
    return _MARKUP.match(head) is not None


def scale_for(width: float, height: float, knots: tuple[int, int]) -> float:
    """Pixels for a unit of a drawing, whose smaller overhang the carpet may cut off.

    >>> scale_for(100, 150, (450, 300))
    12.0
    """
    wanted = PIXELS * max(knots[0] / height, knots[1] / width)
    return min(wanted, math.sqrt(LARGEST / (width * height)))


def png_bytes(pixels: UInt8[np.ndarray, "rows columns channels"]) -> bytes:
    """A PNG file of pixels, hardly compressed."""
    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(pixels)).save(file, "PNG", compress_level=1)
    return file.getvalue()


def rendered(path: Path, data: bytes, rendering: Rendering) -> tuple[bytes, tuple[str, ...]] | None:
    """A PNG file of the drawing in a file, and notes; None: the file is no drawing.

    Raises PictureError for a drawing that cannot be read, a missing extra, and for a page that is not there.
    """
    made: tuple[bytes, tuple[str, ...]] | None = None
    try:
        if is_svg(data):
            from ilmek.io.rendered.svg import render_svg

            made = render_svg(path, data, rendering.knots)
        elif data.startswith(b"%PDF"):
            from ilmek.io.rendered.pdf import render_pdf

            return render_pdf(path, data, rendering)
        elif data.startswith(b"8BPS"):
            from ilmek.io.rendered.layers import merge_layers

            made = merge_layers(path, data)
    except ImportError as error:
        raise PictureError(f"{path} needs the extra vector ({error.name} is not installed)", do=EXTRA) from None
    if rendering.page != 1:
        raise PictureError(f"page={rendering.page} is given, and {path} has one picture", do="leave it out")
    return made
