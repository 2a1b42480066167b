"""Which files are rendered when they are read: SVG drawings, PDF pages, layers without their merged picture."""

import re
from pathlib import Path

from ilmek.errors import PictureError
from ilmek.io.rendered.layers import is_large, merge_layers
from ilmek.io.rendered.pdf import render_pdf
from ilmek.io.rendered.resolution import Rendering
from ilmek.io.rendered.svg import render_svg

RENDERED = (".svg", ".pdf", ".ai")
"""Endings of files that have other pixels for other knots."""

_PDF, _PSD = b"%PDF", b"8BPS"
EXTRA = "pip install 'ilmek[vector]'"

_MARKUP = re.compile(
    rb"(?>(?:<\?xml[^>]*>|(?><!--.*?-->)|(?><!DOCTYPE[^\[>]*(?:\[.*?\]\s*)?>)|\s+)*)<(?:\w{1,20}:)?svg[\s>/]", re.DOTALL
)
"""Begin of a drawing; what precedes it is matched in one manner only, in a time in proportion to its length."""


def is_svg(data: bytes) -> bool:
    """Whether the bytes of a file begin as an SVG drawing, behind a declaration, comments and a document type.

    >>> is_svg(b'<?xml version="1.0"?> <!-- a rug --><svg width="8">'), is_svg(b"<html><svg>")
    (True, False)
    """
    head = data[:65_536].removeprefix(b"\xef\xbb\xbf")
    if head[:2] in (b"\xff\xfe", b"\xfe\xff"):
        head = head[: len(head) // 2 * 2].decode("utf-16", "ignore").encode()
    return _MARKUP.match(head) is not None


def drawing_endings(data: bytes) -> tuple[str, ...]:
    """Endings of the name of a file that is rendered, or has layers, by its content; none: it is no such file.

    >>> drawing_endings(b"%PDF-1.7"), drawing_endings(b"<svg>"), drawing_endings(b"BM")
    (('.pdf', '.ai'), ('.svg',), ())
    """
    if data.startswith(_PSD):
        return (".psb",) if is_large(data) else (".psd",)
    return (".pdf", ".ai") if data.startswith(_PDF) else (".svg",) if is_svg(data) else ()


def _missing_extra(name: object, reader: str | None) -> PictureError:
    return PictureError(f"{name} needs the extra vector ({reader} is not installed)", do=EXTRA)


def rendered(path: Path, data: bytes, rendering: Rendering) -> tuple[bytes, tuple[str, ...]] | None:
    """A PNG file of the drawing in a file, and notes; None: the file is no drawing.

    Raises PictureError for a drawing that cannot be read, a missing extra, and for a page that is not there.
    """
    made: tuple[bytes, tuple[str, ...]] | None = None
    try:
        if is_svg(data):
            made = render_svg(path, data, rendering.knots)
        elif data.startswith(_PDF):
            return render_pdf(path, data, rendering)
        elif data.startswith(_PSD):
            made = merge_layers(path, data)
    except ImportError as error:
        raise _missing_extra(path, error.name) from None
    if rendering.page != 1:
        raise PictureError(f"page={rendering.page} is given, and {path} has one picture", do="leave it out")
    return made
