"""From a matplotlib figure to SVG text that can stand inside a page.

A page holds many figures: every id gets the figure's prefix, ids that nobody refers to go, lengths are rounded to a
hundredth of a point, and the size is left to the page (the view box keeps the proportions). The text stays text. It is
laid out with the metrics of DejaVu Sans, the widest of the fonts named, so that no fallback runs into its neighbour.
"""

import io
import re
from xml.sax.saxutils import escape, quoteattr

from ilmek.viz.sheet import Sheet

FONTS = "'Helvetica Neue', Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif"

_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")  # no XML may hold these
_DECIMALS = re.compile(r"-?\d+\.\d{3,}")
_ELEMENT = re.compile(r"<[^>]*>")
_ID = re.compile(r'\sid="([^"]+)"')
_REFERENCE = re.compile(r'(?:xlink:href="#|url\(#)([^")]+)')
_TIDY = (
    (re.compile(r"\s*<metadata>.*?</metadata>", re.DOTALL), ""),
    (re.compile(r"<!--.*?-->\s*", re.DOTALL), ""),
    (re.compile(r"\s*<defs>\s*<style.*?</style>\s*</defs>", re.DOTALL), ""),  # it would hold for the whole page
    (re.compile(r' ?font-family: [^;"]*;?'), ""),
    (re.compile(r' transform="rotate\(-?0 [^"]*"'), ""),
    (re.compile(r"\s*\n\s*"), "\n"),
)
_SLUG = re.compile(r"[^A-Za-z0-9]+")


def slug(text: str) -> str:
    """The text as part of an id: letters, digits and single hyphens.

    >>> slug("beat-up: drive torque")
    'beat-up-drive-torque'
    """
    return _SLUG.sub("-", text).strip("-").lower() or "figure"


def inline_svg(sheet: Sheet, title: str, prefix: str, over: str = "") -> str:
    """The sheet as an `<svg>` element with a title, ids that begin with `prefix`, and no fixed size.

    over  SVG that is laid over the sheet

    >>> text = inline_svg(Sheet(72, 36), "a < b", "one")
    >>> text.startswith('<svg') and "a &lt; b" in text
    True
    """
    stream = io.StringIO()
    sheet.figure.savefig(stream, format="svg", metadata=dict.fromkeys(("Date", "Creator", "Format", "Type")))
    text = _CONTROL.sub("", stream.getvalue())
    body = text[text.index(">", text.index("<svg")) + 1 :]
    for pattern, instead in _TIDY:
        body = pattern.sub(instead, body)
    body = _ELEMENT.sub(_rounded, _own_ids(body, prefix))  # the words between elements stay as they are
    body = f"{body[: body.rindex('</svg>')]}{_CONTROL.sub('', over)}</svg>"
    shown = _CONTROL.sub("", title)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" role="img" '
        f'viewBox="0 0 {sheet.width:.6g} {sheet.height:.6g}" style="stroke-linejoin:round;font-family:{FONTS}" '
        f"aria-label={quoteattr(shown)}>\n<title>{escape(shown)}</title>{body}"
    )


def _rounded(element: re.Match[str]) -> str:
    return _DECIMALS.sub(lambda found: f"{float(found[0]):.2f}".rstrip("0").rstrip("."), element[0])


def _own_ids(body: str, prefix: str) -> str:
    """The body with the ids referred to under the prefix, and without the others."""
    used = set(_REFERENCE.findall(body))
    body = _ID.sub(lambda found: f' id="{prefix}-{found[1]}"' if found[1] in used else "", body)
    return _REFERENCE.sub(lambda found: found[0].replace(found[1], f"{prefix}-{found[1]}"), body)
