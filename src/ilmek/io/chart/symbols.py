"""Symbols for the yarns of a chart: one symbol per yarn, by its index in the list.

The symbols are of DejaVu Sans Mono, a free font that may be embedded and that comes with the package. All have the same
width, so that a row of them is one text. Letters and digits come first, without those easily confused (I O Q 0 1 l);
then shapes, Greek, arrows, signs and Cyrillic.
"""

from functools import lru_cache
from pathlib import Path

from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont

SYMBOLS = (
    "ABCDEFGHJKLMNPRSTUVWXYZ23456789●■▲◆▼★♥♣♠○□△◇▽☆+×÷=≠#%&@?!§abdefghkmnqrtyΓΔΘΛΞΠΣΦΨΩαβγδεζηθλμξπστφψω"
    "←↑→↓↔↕↖↗↘↙⇐⇑⇒⇓⇔⇕∞∂∀∃∇∈∋√∫∴∵≈≡≤≥⊂⊃⊆⊇⊕⊖⊗⊘⊙⊞⊟⊠⊡∩∪∧∨◐◑◒◓◖◗◧◨◩◪◰◱◲◳▣▤▥▦▧▨▩◉◎▶◀◢◣◤◥"
    "БДЖЗИЛФЦЧШЭЮЯ☀☂☎☘☠☮☯☺☻☾♀♂♔♕♖♗♘♙♚♛♜♝♞♟♪♫⚀⚁⚂⚃⚄⚅✂✈✉✎✓✗✚✠✢✦✧✪✭✱✶✹❀❄❖❤$€£¥¢¶ßæðøþđłŋ«»¿¡"
)[:255]
"""Symbols by the yarn's index in the list; a list has at most 255 yarns."""

SIGNS, TEXT, STRONG = "ilmek-signs", "ilmek-text", "ilmek-strong"
"""Names of the fonts of a PDF: symbols, text, headings."""

ADVANCE = 0.60205
"""Width of every symbol, as a share of the size."""

_FONTS = Path(__file__).parents[2] / "fonts"
_FILES = {SIGNS: "DejaVuSansMono.ttf", TEXT: "DejaVuSans.ttf", STRONG: "DejaVuSans-Bold.ttf"}


def symbols(yarns: int) -> str:
    """The symbols of the first `yarns` yarns.

    >>> symbols(4)
    'ABCD'
    """
    return SYMBOLS[:yarns]


@lru_cache(maxsize=1)
def register_fonts() -> None:
    """Register the three fonts with reportlab."""
    for name, file in _FILES.items():
        pdfmetrics.registerFont(TTFont(name, str(_FONTS / file)))
