"""Widths of texts, from the advance widths of DejaVu Sans, which comes with the package.

A page names several fonts; the browser uses the first one installed. DejaVu Sans is the widest of them, so that a text
laid out by its widths overlaps nothing in any other font.

Tables of the font file: OpenType specification 1.9, cmap (format 12), head, hhea, hmtx.
"""

import struct
from functools import lru_cache
from pathlib import Path

FONTS = Path(__file__).parents[1] / "fonts"
ASCENT, DESCENT = 0.76, 0.24
"""Height of an upright letter above the baseline and depth of a letter below it, as shares of the size."""

_UNKNOWN = 1.0
"""Width of a letter that is missing in the font, as a share of the size."""


@lru_cache(maxsize=4096)
def text_width(text: str, size: float, bold: bool = False) -> float:
    """Width of a line of text [pt] in the widest font of a page, at `size` [pt].

    >>> round(text_width("Hello", 10.0), 1), text_width("", 10.0)
    (25.3, 0.0)
    """
    advances = _advances("DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf")
    return size * sum(advances.get(ord(letter), _UNKNOWN) for letter in text)


@lru_cache(maxsize=2)
def _advances(file: str) -> dict[int, float]:
    """Advance width of each character by its code point, as a share of the size."""
    data = (FONTS / file).read_bytes()
    tables = {
        data[at : at + 4]: struct.unpack_from(">L", data, at + 8)[0]
        for at in range(12, 12 + 16 * struct.unpack_from(">H", data, 4)[0], 16)
    }
    (em,) = struct.unpack_from(">H", data, tables[b"head"] + 18)
    (count,) = struct.unpack_from(">H", data, tables[b"hhea"] + 34)
    widths = struct.unpack_from(">" + "Hh" * count, data, tables[b"hmtx"])[::2]
    advances = {}
    for first, last, glyph in _groups(data, tables[b"cmap"]):
        for code in range(first, last + 1):
            advances[code] = widths[min(glyph + code - first, count - 1)] / em
    return advances


def _groups(data: bytes, cmap: int) -> list[tuple[int, int, int]]:
    """Groups (first code point, last code point, first glyph) of the character map of format 12."""
    for entry in range(struct.unpack_from(">H", data, cmap + 2)[0]):
        (offset,) = struct.unpack_from(">L", data, cmap + 8 + 8 * entry)
        if struct.unpack_from(">H", data, cmap + offset)[0] == 12:
            (count,) = struct.unpack_from(">L", data, cmap + offset + 12)
            return list(struct.iter_unpack(">LLL", data[cmap + offset + 16 : cmap + offset + 16 + 12 * count]))
    raise ValueError("the font has no character map of format 12")
