"""Text in all scripts on the pages of a PDF: parts of one direction and one font, shaped by HarfBuzz.

Persian, Arabic and Urdu letters join, Devanagari forms its conjuncts, marks stand on their letters; `bidi` orders the
parts. To be searched, each glyph has the text of its letters; a part read to the right, whose glyphs may stand in
another order than its letters, is marked with its text (ActualText, ISO 32000-1, 14.9.4).
"""

import unicodedata
from collections.abc import Iterator
from functools import lru_cache
from typing import Any, NamedTuple

import uharfbuzz
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import ShapeData, ShapedStr
from reportlab.pdfgen.canvas import Canvas

from ilmek.errors import JOINERS
from ilmek.io.chart.bidi import visual_runs
from ilmek.io.chart.symbols import ARABIC, DEVANAGARI, HAN, HANGUL, HEBREW, STRONG, TEXT, register_fonts
from ilmek.sentences import language_spoken

_SCRIPTS = {HEBREW: ((0x0590, 0x05FF),), ARABIC: ((0x0600, 0x06FF), (0x0750, 0x077F)), DEVANAGARI: ((0x0900, 0x097F),)}
"""Code points for which a font comes before TEXT, which has no joined forms and no marks in place."""


_HEAVY = 0.035
"""Width of the line around a letter of a script without a bold font, as a share of the size."""


class _Part(NamedTuple):
    """A part of a line: text, font, glyphs for reportlab, width at a size of 1, and whether its text is marked."""

    text: str
    font: str
    glyphs: str
    width: float
    marked: bool = False


def line_width(text: str, size: float, base: str = TEXT, rightward: bool | None = None) -> float:
    """Width of a line of text [pt] in type of `size` [pt]; base, rightward  as of `draw_line`."""
    return size * sum(part.width for part in _parts(text, base, rightward))


def draw_line(
    canvas: Canvas, x: float, y: float, text: str, size: float, *, base: str = TEXT, rightward: bool | None = None
) -> None:
    """Draw a line of text with its left edge at x and its baseline at y [pt].

    base       font of the letters that it has; the scripts are as heavy as STRONG where it is that
    rightward  whether the line begins at the left; None: by its first letter
    """
    for part in _parts(text, base, rightward):
        heavy = base == STRONG and part.font in _SCRIPTS
        if heavy:
            canvas.saveState()
            ink = canvas._fillColorObj
            canvas.setStrokeGray(*ink) if isinstance(ink, tuple) and len(ink) == 1 else canvas.setStrokeColor(ink)
            canvas.setLineWidth(_HEAVY * size)
            canvas.addLiteral("2 Tr")
        canvas.setFont(part.font, size)
        if part.marked:
            actual = part.text.encode("utf-16-be").hex().upper()
            canvas.addLiteral(f"/Span <</ActualText <FEFF{actual}>>> BDC")
        Canvas.drawString(canvas, x, y, part.glyphs)
        if part.marked:
            canvas.addLiteral("EMC")
        if heavy:
            canvas.restoreState()
        x += size * part.width


def is_plain(text: str, font: str) -> bool:
    """Whether a font of reportlab shows a text as it is: it has every letter, none is read to the left, and no digit
    has a form of the language that is spoken.
    """
    return _is_plain(text, font, language_spoken().local)


@lru_cache(maxsize=4096)
def _is_plain(text: str, font: str, local: bool) -> bool:
    if local and any("۰" <= letter <= "۹" for letter in text):
        return False
    return all(unicodedata.bidirectional(letter) not in ("R", "AL") and _has(font, ord(letter)) for letter in text)


def codes_of(text: str, font: str) -> str:
    """The codes of a font for a text that is read to the right, letter by letter."""
    return "".join(str(_shaped(letter, font, True, language_spoken().local).glyphs) for letter in text)


@lru_cache(maxsize=4096)
def missing_letters(text: str) -> str:
    """The characters of a text that none of the fonts has, each once.

    >>> missing_letters("madder قرمز 羊毛 དཀར")
    'དཀར'
    """
    return "".join(dict.fromkeys(letter for letter in text if _font_of(letter, TEXT, TEXT) is None))


def cut_line(text: str, size: float, room: float) -> str:
    """The text, or as much of its beginning and its end as the room [pt] takes: names often differ at the end."""
    half = len(text) // 2
    head, tail = text[:half], text[half:]
    while line_width(shown := f"{head}…{tail}" if len(head + tail) < len(text) else text, size) > room:
        head, tail = head[:-1], tail[1:]
    return shown


def two_lines(text: str, size: float, room: float) -> tuple[str, str]:
    """The text in two lines that break at a blank where they can; the second one is as long as it may be."""
    words = text.split(" ")
    fitting = [count for count in range(1, len(words) + 1) if line_width(" ".join(words[:count]), size) <= room]
    count = fitting[-1] if fitting else 1
    return " ".join(words[:count]), " ".join(words[count:])


def _parts(text: str, base: str = TEXT, rightward: bool | None = None) -> tuple[_Part, ...]:
    """The parts of a line from left to right."""
    return _all_parts(text, base, rightward, language_spoken().local)


@lru_cache(maxsize=4096)
def _all_parts(text: str, base: str, rightward: bool | None, local: bool) -> tuple[_Part, ...]:
    register_fonts()
    if all(_font_of(letter, base, base) == base for letter in text):
        return (_Part(text, base, text, pdfmetrics.stringWidth(text, base, 1.0)),)
    parts: list[_Part] = []
    for run, to_right in visual_runs(text, rightward):
        shaped = [_shaped(piece, font, to_right, local) for piece, font in pieces(run, base)]
        parts += shaped if to_right else shaped[::-1]
    return tuple(parts)


def pieces(text: str, base: str = TEXT) -> Iterator[tuple[str, str]]:
    """The parts of one font, in reading order; base: the first font of letters without a script of their own."""
    piece, current = "", base
    for letter in text:
        font = _font_of(letter, current, base) or base
        if font != current and piece:
            yield piece, current
            piece = ""
        piece, current = piece + letter, font
    yield piece, current


def _font_of(letter: str, current: str, base: str) -> str | None:
    """The font of a letter; blanks, joiners and marks stay in the current one. None: no font has it."""
    code = ord(letter)
    if (letter in JOINERS or letter == " " or unicodedata.combining(letter)) and _has(current, code):
        return current
    own = next((font for font, ranges in _SCRIPTS.items() if any(a <= code <= b for a, b in ranges)), base)
    return next((font for font in (own, base, TEXT, HAN, HANGUL) if _has(font, code)), None)


def _has(font: str, code: int) -> bool:
    register_fonts()
    return code in pdfmetrics.getFont(font).face.charToGlyph


def _shaped(text: str, name: str, rightward: bool, local: bool) -> _Part:
    """A part of one font and direction, shaped.

    local  with local forms, which a font may have by default
    """
    font = pdfmetrics.getFont(name)
    buffer = uharfbuzz.Buffer()
    buffer.add_str(text)
    buffer.guess_segment_properties()
    buffer.direction = "ltr" if rightward else "rtl"
    buffer.cluster_level = uharfbuzz.BufferClusterLevel.MONOTONE_CHARACTERS
    uharfbuzz.shape(_harfbuzz_font(name), buffer, {"locl": local})
    begins = sorted({info.cluster for info in buffer.glyph_infos})
    ends = dict(zip(begins, [*begins[1:], len(text)], strict=True))
    codes, places = [], []
    for info, position in zip(buffer.glyph_infos, buffer.glyph_positions, strict=True):
        width, along, up = map(font.pdfScale, (position.x_advance, position.x_offset, position.y_offset))
        letters = text[info.cluster : ends[info.cluster]]
        plain = font.face.charToGlyph.get(ord(letters[0])) == info.codepoint
        codes.append(ord(letters[0]) if plain else font.code(info.codepoint, width, letters))
        places.append(ShapeData(info.cluster, width, 0, along, up, font.face.charWidths[codes[-1]]))
    wide = sum(place.x_advance for place in places) / 1000
    return _Part(text, name, ShapedStr("".join(map(chr, codes)), places), wide, rightward and name in _SCRIPTS)


@lru_cache(maxsize=8)
def _harfbuzz_font(font: str) -> Any:
    return uharfbuzz.Font(uharfbuzz.Face(uharfbuzz.Blob(pdfmetrics.getFont(font).face._ttf_data)))
