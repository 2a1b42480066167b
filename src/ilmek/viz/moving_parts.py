"""What moves in a figure, as SVG: each part names its places in the list of the figure's run."""

from collections.abc import Sequence
from dataclasses import field
from xml.sax.saxutils import escape

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import record
from ilmek.viz.strokes import BLOCK
from ilmek.viz.style import INK, PAPER, STEEL, STRONG


@record
class PointTracks:
    """The places of all points at every frame, in the figure's units, each point once.

    height  of the sheet [pt]: a sheet counts upward, a figure downward      start  the frame that is written out
    """

    height: float
    start: int
    places: list[list[float]] = field(default_factory=list)

    def point(self, places: ComplexArray) -> int:
        """The number of a point, from its places on the sheet [pt] at every frame: x0, y0, x1, y1 ..."""
        figure = np.column_stack([places.real, self.height - places.imag])
        entry = [round(float(number), 2) for number in figure.ravel()]
        if entry not in self.places:
            self.places.append(entry)
        return self.places.index(entry)

    def first(self, point: int) -> str:
        """The point's place at the frame that is written out."""
        x, y = self.places[point][2 * self.start : 2 * self.start + 2]
        return f"{x:g} {y:g}"


def line(
    course: PointTracks,
    track: Sequence[ComplexArray],
    stroke: str,
    width: float,
    *,
    closed: bool = False,
    fill: str = "none",
) -> str:
    """A line through points."""
    points = [course.point(places) for places in track]
    through = "L".join(course.first(point) for point in points) + ("Z" if closed else "")
    look = f'fill="{fill}" stroke="{stroke}" stroke-width="{width:g}" stroke-linecap="round"'
    end = ' data-closed="1"' if closed else ""
    return f'<path data-line="{",".join(map(str, points))}"{end} d="M{through}" {look}/>'


def dot(course: PointTracks, at: ComplexArray, role: str) -> str:
    """A pin (a circle) or a point (a small disc)."""
    size, look = (3.4, f'fill="{PAPER}" stroke="{INK}" stroke-width="1.1"') if role == "pin" else (2.2, f'fill="{INK}"')
    return f'<circle r="{size:g}" {look} {_placed(course, at)}/>'


def block(course: PointTracks, at: ComplexArray, along: ComplexArray) -> str:
    """A slider: a rectangle along its guide."""
    ahead = course.point(at + 10.0 * along)
    turned = float(np.degrees(-np.angle(along[course.start])))
    box = f'x="{-BLOCK.real:g}" y="{-BLOCK.imag:g}" width="{2 * BLOCK.real:g}" height="{2 * BLOCK.imag:g}"'
    look = f'rx="1.5" fill="#e4e8ec" stroke="{STEEL}" stroke-width="1.2"'
    return f'<rect {box} {look} data-ahead="{ahead}" {_placed(course, at, f" rotate({turned:.2f})")}/>'


def name(course: PointTracks, middle: ComplexArray, text: str) -> str:
    """A bold name with a pale edge, so that a line behind it does not cross it."""
    edge = f'stroke="{PAPER}" stroke-width="2.6" paint-order="stroke"'
    look = f'font-size="{STRONG:g}px" font-weight="bold" text-anchor="middle" dy="0.35em" fill="{INK}" {edge}'
    return f"<text {look} {_placed(course, middle)}>{escape(text)}</text>"


def _placed(course: PointTracks, at: ComplexArray, more: str = "") -> str:
    point = course.point(at)
    return f'data-at="{point}" transform="translate({course.first(point)}){more}"'
