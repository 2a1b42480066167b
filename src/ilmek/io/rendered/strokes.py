"""Least widths: strokes of an SVG drawing that are thinner than a knot are made as wide as one.

The width of a stroke is that of its element or the nearest one around it, by attribute, style sheet (rules for a name,
a class or an id) or style, in this order, times the root of the determinant of the transforms. A letter of less than a
knot's stem gets an outline of its own colour, if it is at least `LEAST_LETTER` knots high: smaller ones cannot be read.
"""

import math
import re
from collections.abc import Iterator, Mapping
from xml.etree.ElementTree import Element

SHAPES = frozenset(("path", "line", "rect", "circle", "ellipse", "polyline", "polygon", "text"))

STEM = 0.09
"""Width of a stem, as a share of the size of a letter."""

LEAST_LETTER = 5.0
"""Least size of a letter whose stems are made wider [knots]."""

_KEYS = ("stroke", "stroke-width", "fill", "font-size")
_NUMBER = r"[-+]?\d*\.?\d+(?:[eE][-+]?\d+)?"
_LENGTH = re.compile(rf"\s*({_NUMBER})\s*(px|pt|pc|mm|cm|in|em|%)?\s*(?:!important)?\s*$")
_UNITS = {"pt": 96 / 72, "pc": 16.0, "mm": 96 / 25.4, "cm": 96 / 2.54, "in": 96.0}
_TRANSFORM = re.compile(r"(matrix|scale)\s*\(([^)]*)\)")
_RULE = re.compile(r"([^{}]+)\{([^{}]*)\}")

Values = Mapping[str, str]


def widen_strokes(root: Element, least: float) -> int:
    """Make strokes at least `least` wide, in units of the drawing; returns how many were made wider.

    >>> root = Element("svg")
    >>> line = Element("line", {"stroke": "red", "transform": "scale(2)"})
    >>> root.append(line)
    >>> widen_strokes(root, 4.0), line.get("style")
    (1, 'stroke-width:2')
    """
    count = 0
    for element, values, scale in _styled(root, _rules(root)):
        name = element.tag.rpartition("}")[2]
        if name not in SHAPES or scale <= 0:
            continue
        width = _length(values.get("stroke-width", "1"))
        if values.get("stroke", "none").strip() != "none":
            if width is not None and 0 < width * scale < least * (1 - 1e-6):
                count += _outline(element, least / scale)
        elif name == "text":
            size = _length(values.get("font-size", "16")) or 16.0
            missing = least - STEM * size * scale
            if missing > 0 and size * scale >= LEAST_LETTER * least and values.get("fill", "black") != "none":
                count += _outline(element, missing / scale, values.get("fill", "black"))
    return count


def _outline(element: Element, width: float, colour: str = "") -> int:
    """Give an element a stroke; the later declaration of a style prevails."""
    stroke = f"stroke:{colour};stroke-linejoin:round;" if colour else ""
    style = element.get("style", "").rstrip("; ")
    element.set("style", f"{style}{';' if style else ''}{stroke}stroke-width:{width:.6g}")
    return 1


def _styled(root: Element, rules: Mapping[str, Values]) -> Iterator[tuple[Element, Values, float]]:
    """Each element with the values that it has or inherits, and the scale of its transforms."""
    stack: list[tuple[Element, Values, float]] = [(root, {}, 1.0)]
    while stack:
        element, inherited, scale = stack.pop()
        values = dict(inherited)
        values.update({key: element.attrib[key] for key in _KEYS if key in element.attrib})
        names = [element.tag.rpartition("}")[2], *(f".{name}" for name in element.get("class", "").split())]
        for name in (*names, f"#{element.get('id', '')}"):
            values.update(rules.get(name, {}))
        values.update(_declarations(element.get("style", "")))
        scale *= _scale(element.get("transform", ""))
        yield element, values, scale
        stack.extend((child, values, scale) for child in element)


def _rules(root: Element) -> dict[str, dict[str, str]]:
    """The declarations of the style sheets by selectors of one name, class or id."""
    rules: dict[str, dict[str, str]] = {}
    for element in root.iter():
        if element.tag.rpartition("}")[2] == "style" and element.text:
            text = re.sub(r"/\*.*?\*/", "", element.text, flags=re.DOTALL)
            for names, body in _RULE.findall(text):
                for name in names.split(","):
                    rules.setdefault(name.strip(), {}).update(_declarations(body))
    return rules


def _declarations(text: str) -> dict[str, str]:
    """The declarations of a style that concern strokes and letters."""
    pairs = (part.partition(":") for part in text.split(";"))
    return {key.strip(): value.strip() for key, _, value in pairs if key.strip() in _KEYS}


def _length(text: str) -> float | None:
    """A length in units of the drawing; None: it is in percent, or no length."""
    found = _LENGTH.match(text)
    if found is None or found[2] == "%":
        return None
    return float(found[1]) * (16.0 if found[2] == "em" else _UNITS.get(found[2] or "", 1.0))


def _scale(text: str) -> float:
    """The root of the determinant of transforms."""
    scale = 1.0
    for kind, body in _TRANSFORM.findall(text):
        numbers = [float(number) for number in re.findall(_NUMBER, body)]
        if kind == "matrix" and len(numbers) == 6:
            scale *= math.sqrt(abs(numbers[0] * numbers[3] - numbers[1] * numbers[2]))
        elif kind == "scale" and numbers:
            scale *= math.sqrt(abs(numbers[0] * numbers[-1]))
    return scale
