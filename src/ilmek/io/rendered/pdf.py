"""A page of a PDF file, by PDFium. Strokes that would be thinner than a knot are made as wide as one."""

import ctypes
import itertools
import math
import threading
from importlib import import_module
from pathlib import Path
from typing import Any

from ilmek.errors import PictureError
from ilmek.io.picture_file import shortened
from ilmek.io.rendered.resolution import Rendering, png_bytes, scale_for
from ilmek.units import counted

MOST_OBJECTS = 200_000
"""Largest number of objects of a page whose strokes are looked at."""

_LOCK = threading.Lock()
"""PDFium keeps one state for all threads."""


def render_pdf(path: Path, data: bytes, rendering: Rendering) -> tuple[bytes, tuple[str, ...]]:
    """A PNG file of a page on white, and notes.

    Raises PictureError for a file that is locked or damaged and for a page that is not there, and ImportError without
    the extra.
    """
    pdfium = import_module("pypdfium2")

    with _LOCK:
        try:
            document = pdfium.PdfDocument(data)
        except pdfium.PdfiumError as error:
            locked = "password" in str(error).lower()
            given = f"{path} is locked by a password" if locked else f"{path} is damaged ({shortened(error)})"
            raise PictureError(given, do="save it without a password" if locked else "save or copy it again") from None
        try:
            return _page(path, document, rendering)
        except pdfium.PdfiumError as error:
            raise PictureError(f"{path} cannot be rendered ({shortened(error)})", do="save it as PNG") from None
        finally:
            document.close()


def _page(path: Path, document: Any, rendering: Rendering) -> tuple[bytes, tuple[str, ...]]:
    pages, number = len(document), rendering.page
    if not 1 <= number <= pages:
        allowed = f"page 1 to {pages}" if pages else "no page is there"
        raise PictureError(f"page={number} is given, and {path} has {counted(pages, 'page')}", allowed=allowed)
    page = document[number - 1]
    width, height = page.get_size()
    if min(width, height) <= 0 or max(width, height) > 1000 * min(width, height):
        raise PictureError(f"{path}: its page is {width:g} x {height:g} points", do="use another page")
    knots = rendering.knots
    widened = _widen(page, 1 / max(knots[0] / height, knots[1] / width))
    pixels = page.render(scale=scale_for(width, height, knots), rev_byteorder=True, prefer_bgrx=True).to_numpy()
    notes = [f"rendered with {pixels.shape[1]} x {pixels.shape[0]} pixels"]
    if pages > 1:
        notes.insert(0, f"page {number} of {pages} is used" + ("" if number > 1 else "; page gives another one"))
    if widened:
        notes.append(f"{counted(widened, 'stroke')} thinner than a knot drawn as wide as one")
    return png_bytes(pixels[..., :3]), tuple(notes)


def _widen(page: Any, least: float) -> int:
    """Make the strokes of a page at least `least` wide [points]; returns how many were made wider."""
    raw = import_module("pypdfium2.raw")

    count, width = 0, ctypes.c_float()
    mode, is_stroked = ctypes.c_int(), ctypes.c_int()
    for one in itertools.islice(page.get_objects(filter=[raw.FPDF_PAGEOBJ_PATH]), MOST_OBJECTS):
        drawn = raw.FPDFPath_GetDrawMode(one.raw, mode, is_stroked) and is_stroked.value
        if drawn and raw.FPDFPageObj_GetStrokeWidth(one.raw, width):
            scale = _scale(one)
            if scale > 0 and width.value * scale < least * (1 - 1e-6):
                count += bool(raw.FPDFPageObj_SetStrokeWidth(one.raw, least / scale))
    return count


def _scale(one: Any) -> float:
    """The root of the determinant of the matrices of an object and of the forms in which it lies."""
    scale, container = 1.0, one
    while container is not None:
        a, b, c, d, _, _ = container.get_matrix().get()
        scale *= math.sqrt(abs(a * d - b * c))
        container = container.container
    return scale
