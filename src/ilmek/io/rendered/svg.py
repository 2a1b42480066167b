"""SVG drawings, by resvg.

A drawing is untrusted. It is read as a tree without its document type; what it takes from outside (pictures in other
files, style sheets, entities) is taken out and noted, so the renderer sees no name of a file. Strokes that would be
thinner than a knot are made as wide as a knot [`strokes`].
"""

import re
from importlib import import_module
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET
from xml.parsers import expat

from ilmek.errors import PictureError
from ilmek.io.picture_file import DamagedError, shortened
from ilmek.io.rendered.resolution import scale_for
from ilmek.io.rendered.strokes import widen_strokes
from ilmek.units import counted

MOST_ELEMENTS, MOST_DEPTH = 500_000, 256
"""Largest number of elements of a drawing, and of those inside each other."""

MOST_ENTITIES, LONGEST_ENTITY = 100, 1000
"""Largest number of short names for texts that a drawing declares, and of characters of one of them."""

FONTS = Path(__file__).parents[2] / "fonts"

Box = tuple[float, float, float, float]
"""Left, top, width and height."""

_INSIDE = re.compile(r"\s*(?:#|data:image/(?:png|jpe?g|gif|webp)\s*[;,])", re.IGNORECASE)
_OUTSIDE = re.compile(r"@import[^;]*;?|url\(\s*['\"]?(?!\s*['\"]?#)[^)]*\)", re.IGNORECASE)
_LENGTH = re.compile(r"\s*(\d*\.?\d+(?:[eE][-+]?\d+)?)\s*(px|pt|pc|mm|cm|in|em|ex)?\s*$")
_UNITS = {"pt": 96 / 72, "pc": 16.0, "mm": 96 / 25.4, "cm": 96 / 2.54, "in": 96.0, "em": 16.0, "ex": 8.0}


def render_svg(path: Path, data: bytes, knots: tuple[int, int]) -> tuple[bytes, tuple[str, ...]]:
    """A PNG file of a drawing, with its transparency, and notes.

    knots  rows and columns of the carpet
    Raises PictureError, and ImportError without the extra.
    """
    resvg = import_module("resvg_py")

    try:
        root = read_tree(data)
        (width, height), box = drawn_sides(root)
    except (expat.ExpatError, ET.ParseError, DamagedError, LookupError, ValueError) as error:
        raise PictureError(f"{path} is damaged or truncated ({shortened(error)})", do="save or copy it again") from None
    scale = scale_for(width, height, knots)
    taken = take_out_references(root)
    widened = widen_strokes(root, box[2] / width / max(knots[0] / height, knots[1] / width))
    sides = max(1, round(width * scale)), max(1, round(height * scale))
    for key, value in zip(("width", "height"), sides, strict=True):
        root.set(key, str(value))
    root.set("viewBox", " ".join(repr(side) for side in box))
    text = ET.tostring(root, encoding="unicode")
    letters = any(element.tag.rpartition("}")[2] == "text" for element in root.iter())
    fonts: dict[str, object] = (
        {"font_dirs": [str(FONTS)], "sans_serif_family": "DejaVu Sans"} if letters else {"skip_system_fonts": True}
    )
    try:
        made = resvg.svg_to_bytes(svg_string=text, **fonts)
    except ValueError as error:
        raise PictureError(f"{path} cannot be rendered ({shortened(error)})", do="save it as PNG") from None
    notes = [f"rendered with {sides[0]} x {sides[1]} pixels"]
    if taken:
        notes.append(f"{counted(taken, 'reference')} to other files left out: nothing outside the drawing is read")
    if widened:
        notes.append(f"{counted(widened, 'stroke')} thinner than a knot drawn as wide as one")
    return bytes(made), tuple(notes)


def read_tree(data: bytes) -> ET.Element:
    """The elements of a drawing. Raises DamagedError for one with too many, and for entities that name others; entities
    in other files are empty.
    """
    builder, parser = ET.TreeBuilder(), expat.ParserCreate(namespace_separator="}")
    depth, count, entities = 0, 0, 0

    def declared(*entity: Any) -> None:
        nonlocal entities
        entities, value = entities + 1, entity[2]
        if entities > MOST_ENTITIES or (value is not None and ("&" in value or len(value) > LONGEST_ENTITY)):
            raise DamagedError("its entities name others, are long or too many")

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal depth, count
        depth, count = depth + 1, count + 1
        if depth > MOST_DEPTH or count > MOST_ELEMENTS:
            raise DamagedError(f"it has more than {MOST_ELEMENTS:,} elements, or {MOST_DEPTH} inside each other")
        builder.start(_named(name), {_named(key): value for key, value in attributes.items()})

    def end(name: str) -> None:
        nonlocal depth
        depth -= 1
        builder.end(_named(name))

    parser.EntityDeclHandler = declared
    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.CharacterDataHandler = builder.data
    parser.Parse(data, True)
    return builder.close()


def _named(name: str) -> str:
    """A name with its namespace as ElementTree writes it; elements of SVG have none left out."""
    return "{" + name if "}" in name else name


def drawn_sides(root: ET.Element) -> tuple[tuple[float, float], Box]:
    """Width and height of a drawing [px], and the part of its plane that it shows. Raises DamagedError without them."""
    found = [float(number) for number in re.findall(r"[-+]?\d*\.?\d+(?:[eE][-+]?\d+)?", root.get("viewBox", ""))]
    box = (found[0], found[1], found[2], found[3]) if len(found) == 4 and min(found[2:]) > 0 else None
    sides = [_length(root.get(key, "")) for key in ("width", "height")]
    if box is None:
        if None in sides:
            raise DamagedError("it states neither width and height nor a viewBox")
        box = (0.0, 0.0, sides[0] or 0.0, sides[1] or 0.0)
    width, height = sides
    width = width or (box[2] if height is None else height * box[2] / box[3])
    height = height or width * box[3] / box[2]
    if min(width, height, *box[2:]) <= 0 or max(width, height) / min(width, height) > 1000:
        raise DamagedError(f"its sides are {width:g} x {height:g}")
    return (width, height), box


def _length(text: str) -> float | None:
    """A length [px]; None: it is not stated, or in percent."""
    found = _LENGTH.match(text)
    return float(found[1]) * _UNITS.get(found[2] or "", 1.0) if found and float(found[1]) > 0 else None


def take_out_references(root: ET.Element) -> int:
    """Take out what a drawing has from outside its file; returns how many references."""
    count = 0
    for element in root.iter():
        name = element.tag.rpartition("}")[2]
        for key, value in list(element.attrib.items()):
            plain = key.rpartition("}")[2]
            if plain in ("href", "src") and name != "a" and not _INSIDE.match(value):
                count += bool(value.strip())
                del element.attrib[key]
            elif plain == "base":
                del element.attrib[key]
            elif "url(" in value.lower():
                element.attrib[key], found = _OUTSIDE.subn("none", value)
                count += found
        if name == "style" and element.text:
            element.text, found = _OUTSIDE.subn("", element.text)
            count += found
    return count
