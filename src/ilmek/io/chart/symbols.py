"""Symbols for the yarns of a chart: one sign a yarn, the same for the same place in the list everywhere.

The signs come from DejaVu Sans Mono, a free font that may be embedded and that comes with the package; all are equally
wide, so that a row of them is one piece of text. Letters and digits come first, without those taken for one another
(I O Q 0 1 l); then shapes, Greek, arrows, signs and Cyrillic.
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
"""Signs by the yarn's place in the list; a list holds at most 255 yarns."""

SIGNS, TEXT, STRONG = "ilmek-signs", "ilmek-text", "ilmek-strong"
"""Names of the fonts of a PDF: symbols, text, headings."""

ADVANCE = 0.60205
"""Width of every sign, as a share of the size."""

_FONTS = Path(__file__).parents[2] / "fonts"
_FILES = {SIGNS: "DejaVuSansMono.ttf", TEXT: "DejaVuSans.ttf", STRONG: "DejaVuSans-Bold.ttf"}


def symbols(yarns: int) -> str:
    """The signs of the first `yarns` yarns.

    >>> symbols(4)
    'ABCD'
    """
    return SYMBOLS[:yarns]


@lru_cache(maxsize=1)
def register_fonts() -> None:
    """Make the three fonts known to reportlab."""
    for name, file in _FILES.items():
        pdfmetrics.registerFont(TTFont(name, str(_FONTS / file)))
