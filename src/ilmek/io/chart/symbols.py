"""Symbols of yarns, by their numbers in the yarn list: a yarn of one list has one symbol on every chart.

The symbols are of DejaVu Sans Mono, a free font that may be embedded and that comes with the package. All have the same
width, so that a row of them is one text. Letters and digits come first, without those easily confused (I O Q 0 1 l);
then shapes, Greek, arrows, signs and Cyrillic.
"""

import re
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont

from ilmek.carpet.codes import CODES
from ilmek.carpet.yarn import Yarn

SYMBOLS = (
    "ABCDEFGHJKLMNPRSTUVWXYZ23456789●■▲◆▼★♥♣♠○□△◇▽☆+×÷=≠#%&@?!§abdefghkmnqrtyΓΔΘΛΞΠΣΦΨΩαβγδεζηθλμξπστφψω"
    "←↑→↓↔↕↖↗↘↙⇐⇑⇒⇓⇔⇕∞∂∀∃∇∈∋√∫∴∵≈≡≤≥⊂⊃⊆⊇⊕⊖⊗⊘⊙⊞⊟⊠⊡∩∪∧∨◐◑◒◓◖◗◧◨◩◪◰◱◲◳▣▤▥▦▧▨▩◉◎▶◀◢◣◤◥"
    "БДЖЗИЛФЦЧШЭЮЯ☀☂☎☘☠☮☯☺☻☾♀♂♔♕♖♗♘♙♚♛♜♝♞♟♪♫⚀⚁⚂⚃⚄⚅✂✈✉✎✓✗✚✠✢✦✧✪✭✱✶✹❀❄❖❤$€£¥¢¶ßæðøþđłŋ«»¿¡"
)[:255]
"""Symbols by the yarn's number in its list, less 1; a list has at most 255 yarns."""

NO_SIGN = "·"
"""Sign of a cell without a knot."""

SIGNS, TEXT, STRONG = "ilmek-signs", "ilmek-text", "ilmek-strong"
ARABIC, HEBREW, DEVANAGARI = "ilmek-arabic", "ilmek-hebrew", "ilmek-devanagari"
HAN, HANGUL = "ilmek-han", "ilmek-hangul"
"""Names of the fonts of a PDF: symbols, text, headings; names in other scripts."""

ADVANCE = 0.60205
"""Width of every symbol, as a share of the size."""

_PRIVATE = 0xE000
"""First code of the glyphs that no character stands for: the private use area."""

_CODE = re.compile(r"> <([EF][0-9A-F]{3})>")
# The fonts are whole: of Han, a subset by frequent characters would lack names of colours, like 绯 and 绛.
_FONTS = Path(__file__).parents[2] / "fonts"
_FILES = {
    SIGNS: "DejaVuSansMono.ttf",
    TEXT: "DejaVuSans.ttf",
    STRONG: "DejaVuSans-Bold.ttf",
    ARABIC: "NotoNaskhArabic-Regular.ttf",
    HEBREW: "NotoSansHebrew-Regular.ttf",
    DEVANAGARI: "NotoSansDevanagari-Regular.ttf",
    HAN: "DroidSansFallback.ttf",
    HANGUL: "NotoSansHangul-Regular.ttf",
}


def symbols(yarns: Sequence[Yarn]) -> str:
    """The symbol of each yarn of a chart.

    Yarns without a number, and those whose number an earlier one has, take the first symbols that are free.

    >>> symbols([Yarn(name, (0, 0, 0), (0.0, 0.0, 0.0), number=n) for name, n in (("a", 3), ("b", None), ("c", 1))])
    'CBA'
    """
    found: dict[int, str] = {}
    for index, yarn in enumerate(yarns):
        if yarn.number is not None and SYMBOLS[yarn.number - 1] not in found.values():
            found[index] = SYMBOLS[yarn.number - 1]
    free = iter(sign for sign in SYMBOLS if sign not in set(found.values()))
    return "".join(found[index] if index in found else next(free) for index in range(len(yarns)))


def signs_of_codes(yarns: Sequence[Yarn]) -> str:
    """The sign of each code of a chart's knots: the symbols, and NO_SIGN for the code of no knot."""
    return symbols(yarns).ljust(CODES, NO_SIGN)


class ShapedFont(TTFont):  # type: ignore[misc]
    """A font of which any glyph can be drawn; those that no character stands for have codes of their own.

    texts  what such a code is read as, where the text of a page is searched or copied
    """

    def __init__(self, name: str, file: str) -> None:
        super().__init__(name, file)
        self.texts: dict[int, str] = {}

    def code(self, glyph: int, width: float, text: str) -> int:
        """The code of a glyph of some width [1/1000 of the size], which stands for a text."""
        code = _PRIVATE + glyph
        self.face.charToGlyph[code], self.face.charWidths[code] = glyph, width
        self.texts.setdefault(code, text)
        return code

    def addObjects(self, doc: Any) -> None:
        """As of reportlab, with the texts of the codes in the ToUnicode maps (ISO 32000-1, 9.10.3)."""
        fonts = doc.idToObject["BasicFonts"].dict
        before = set(fonts)
        super().addObjects(doc)
        for name in fonts.keys() - before:
            stream = doc.idToObject[fonts[name].ToUnicode.name]
            stream.content = _CODE.sub(self._text, stream.content)

    def _text(self, found: re.Match[str]) -> str:
        text = self.texts.get(int(found[1], 16))
        return found[0] if text is None else f"> <{text.encode('utf-16-be').hex().upper()}>"


def font_file(name: str) -> Path:
    """The file of a font."""
    return _FONTS / _FILES[name]


@lru_cache(maxsize=1)
def register_fonts() -> None:
    """Register the fonts with reportlab."""
    for name, file in _FILES.items():
        pdfmetrics.registerFont(ShapedFont(name, str(_FONTS / file)))
