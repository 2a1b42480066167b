"""Numbers in large figures of a terminal, in the digits of any script: letters of the printed files' fonts, drawn with
half blocks.
"""

from functools import lru_cache

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ilmek.io.chart.lettering import pieces
from ilmek.io.chart.symbols import STRONG, font_file
from ilmek.sentences import LATIN

LINES = 7
"""Lines of a figure; each has two rows of half blocks."""

_SIZE = 100
_FULL = 0.4
"""Share of a half block from which it is full."""

_PLAIN = str.maketrans("█▀▄½", "##oo")


@lru_cache(maxsize=64)
def large(text: str, digits: str = LATIN) -> tuple[str, ...]:
    """A number in large figures.

    digits  of the script, by whose height all are scaled

    >>> for line in large("17"):
    ...     print(f"|{line}|")
    |▄▄████      ██████████|
    |▀▀▀███      ▀▀▀▀▀▀████|
    |   ███           ▄███ |
    |   ███          ▄███  |
    |   ███         ▄███   |
    |▄▄▄███▄▄▄     ▄███    |
    |█████████▀    ███     |
    """
    drawn, inside = _drawn(text), _drawn(digits).getbbox()
    box = drawn.getbbox()
    if box is None or inside is None:
        return ("",) * LINES
    low, high = min(box[1], inside[1]), max(box[3], inside[3])
    rows = 2 * LINES
    shown = drawn.crop((box[0], low, box[2], high))
    width = max(1, round(shown.width * rows / (inside[3] - inside[1])))
    full = np.asarray(shown.resize((width, rows), Image.Resampling.BOX)) >= 255 * _FULL
    return tuple(
        "".join(" ▀▄█"[upper + 2 * lower] for upper, lower in zip(*pair, strict=True))
        for pair in zip(full[::2].astype(int).tolist(), full[1::2].astype(int).tolist(), strict=True)
    )


def without_blocks(text: str) -> str:
    """Large figures for a terminal without blocks."""
    return text.translate(_PLAIN)


def _drawn(text: str) -> Image.Image:
    """A text in white on black, on one baseline."""
    fonts = [(piece, ImageFont.truetype(str(font_file(font)), _SIZE)) for piece, font in pieces(text, STRONG)]
    picture = Image.new("L", (int(sum(font.getlength(piece) for piece, font in fonts)) + 2 * _SIZE, 3 * _SIZE))
    draw, x = ImageDraw.Draw(picture), float(_SIZE)
    for piece, font in fonts:
        draw.text((x, 2 * _SIZE), piece, fill=255, font=font, anchor="ls")
        x += font.getlength(piece)
    return picture
