"""A figure, written as SVG, on a page of a PDF: paths of straight lines, rectangles and texts, as figures have them.

The y axis of SVG points down, that of a page up; lengths are points.
"""

import re
from xml.etree import ElementTree as ET

from reportlab.lib.colors import HexColor
from reportlab.platypus import Flowable

from ilmek.io.chart.printing import PrintCanvas
from ilmek.io.chart.symbols import STRONG, TEXT

_MOVES = re.compile(r"([ML])(-?[\d.e+-]+) (-?[\d.e+-]+)")
_TURN = re.compile(r"rotate\(([^ ]+) ([^ ]+) ([^ ]+)\)")
_NAMESPACE = re.compile(r"\{.*\}")


class SvgPicture(Flowable):  # type: ignore[misc]
    """A picture that fills the width of a column, but is not higher than a limit [pt]."""

    def __init__(self, text: str, highest: float) -> None:
        super().__init__()
        self.spaceAfter = 8.0
        self.root = ET.fromstring(text)
        self.size = tuple(float(side) for side in self.root.attrib["viewBox"].split()[2:])
        self.highest, self.scale = highest, 1.0

    def wrap(self, width: float, height: float) -> tuple[float, float]:  # noqa: ARG002 - as of reportlab
        """Its size in a column of a width [pt]."""
        wide, high = self.size
        self.scale = min(width / wide, self.highest / high)
        self.width, self.height = width, high * self.scale
        return self.width, self.height

    def draw(self) -> None:
        """Draw it in the middle of the column."""
        canvas = self.canv
        canvas.translate((self.width - self.size[0] * self.scale) / 2, self.height)
        canvas.scale(self.scale, -self.scale)
        canvas.setLineCap(1)
        canvas.setLineJoin(1)
        for mark in self.root.iter():
            draw = {"path": _path, "rect": _rectangle, "text": _text}.get(_NAMESPACE.sub("", mark.tag))
            if draw is not None:
                canvas.saveState()
                draw(canvas, mark)
                canvas.restoreState()


def _path(canvas: PrintCanvas, mark: ET.Element) -> None:
    through = canvas.beginPath()
    for kind, x, y in _MOVES.findall(mark.attrib["d"]):
        (through.moveTo if kind == "M" else through.lineTo)(float(x), float(y))
    if mark.attrib["d"].endswith("Z"):
        through.close()
    _paint(canvas, mark)
    canvas.drawPath(through, stroke="stroke" in mark.attrib, fill="fill" in mark.attrib)


def _rectangle(canvas: PrintCanvas, mark: ET.Element) -> None:
    _turn(canvas, mark)
    _paint(canvas, mark)
    corner_and_size = (float(mark.attrib[name]) for name in ("x", "y", "width", "height"))
    canvas.rect(*corner_and_size, stroke="stroke" in mark.attrib, fill="fill" in mark.attrib)


def _text(canvas: PrintCanvas, mark: ET.Element) -> None:
    look = mark.attrib
    _turn(canvas, mark)
    canvas.translate(float(look["x"]), float(look["y"]))
    canvas.scale(1, -1)
    canvas.setFillColor(HexColor(look["fill"]))
    canvas.setFont(STRONG if look.get("font-weight") == "bold" else TEXT, float(look["font-size"]))
    draw = {"middle": canvas.drawCentredString, "end": canvas.drawRightString}
    draw.get(look.get("text-anchor", ""), canvas.drawString)(0, 0, mark.text or "")


def _turn(canvas: PrintCanvas, mark: ET.Element) -> None:
    turned = _TURN.fullmatch(mark.attrib.get("transform", ""))
    if turned is not None:
        angle, x, y = map(float, turned.groups())
        canvas.translate(x, y)
        canvas.rotate(angle)
        canvas.translate(-x, -y)


def _paint(canvas: PrintCanvas, mark: ET.Element) -> None:
    look = mark.attrib
    if "fill" in look:
        canvas.setFillColor(HexColor(look["fill"]))
    if "stroke" in look:
        canvas.setStrokeColor(HexColor(look["stroke"]))
        canvas.setLineWidth(float(look["stroke-width"]))
    if "stroke-dasharray" in look:
        canvas.setLineCap(0)
        canvas.setDash([float(length) for length in look["stroke-dasharray"].split()])
