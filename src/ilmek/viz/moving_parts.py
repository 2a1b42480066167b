"""Moving parts of a figure, positions on its sheet [pt] over the frames, and their SVG: each part refers to its
positions in the list of the figure's run.
"""

from dataclasses import field
from typing import TypeAlias
from xml.sax.saxutils import escape

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import record
from ilmek.viz.strokes import BLOCK
from ilmek.viz.style import INK, PAPER, STEEL, STRONG

PITCH = (7.0, 2.0, 1.5, 2.0)
"""Dashes of a pitch circle [pt]."""

DOT_RADII = {"pin": 3.4, "point": 2.2}
"""Radii of dots by their role [pt]."""


@record
class MovingLine:
    """A line through points (frames, points); dashes: lengths of dash, gap, dash ... [pt]."""

    points: ComplexArray
    stroke: str
    width: float
    closed: bool = False
    fill: str = "none"
    dashes: tuple[float, ...] = ()


@record
class MovingMarker:
    """A filled shape with its corners about a moving point."""

    at: ComplexArray
    corners: ComplexArray
    fill: str


@record
class MovingCircle:
    """A pin (a circle) or a point (a small disc)."""

    at: ComplexArray
    role: str


@record
class MovingBlock:
    """A slider: a rectangle along its guide."""

    at: ComplexArray
    along: ComplexArray


@record
class MovingName:
    """A bold name with a pale edge that hides lines behind it; `at`: its middle."""

    at: ComplexArray
    text: str


MovingPart: TypeAlias = MovingLine | MovingMarker | MovingCircle | MovingBlock | MovingName


@record
class PointTracks:
    """Positions of all points at every frame, in the figure's units, each point once.

    height     of the sheet [pt]: y points up on a sheet and down in a figure
    start      the frame that is written out
    positions  x0, y0, x1, y1 ... of each point over the frames
    """

    height: float
    start: int
    positions: list[list[float]] = field(default_factory=list)

    def point(self, points: ComplexArray) -> int:
        """The number of a point, given by its positions on the sheet at every frame [pt]."""
        figure = np.column_stack([points.real, self.height - points.imag])
        entry = [round(float(number), 2) for number in figure.ravel()]
        if entry not in self.positions:
            self.positions.append(entry)
        return self.positions.index(entry)

    def first(self, point: int) -> str:
        """The point's position at the frame that is written out."""
        x, y = self.positions[point][2 * self.start : 2 * self.start + 2]
        return f"{x:g} {y:g}"


def part_svg(tracks: PointTracks, part: MovingPart) -> str:
    """A moving part as SVG; a line that keeps its shape is moved as a whole, which needs two points and no more."""
    if isinstance(part, MovingLine):
        return _rigid(tracks, part) if is_rigid(part.points) else _line(tracks, part)
    if isinstance(part, MovingMarker):
        look = f'fill="{part.fill}" stroke="{PAPER}" stroke-width="0.5"'
        return f'<path d="{_path(np.conj(part.corners))}Z" {look} {_placed(tracks, part.at)}/>'
    if isinstance(part, MovingCircle):
        look = f'fill="{PAPER}" stroke="{INK}" stroke-width="1.1"' if part.role == "pin" else f'fill="{INK}"'
        return f'<circle r="{DOT_RADII[part.role]:g}" {look} {_placed(tracks, part.at)}/>'
    if isinstance(part, MovingBlock):
        return _block(tracks, part)
    edge = f'stroke="{PAPER}" stroke-width="2.6" paint-order="stroke"'
    look = f'font-size="{STRONG:g}px" font-weight="bold" text-anchor="middle" dy="0.35em" fill="{INK}" {edge}'
    return f"<text {look} {_placed(tracks, part.at)}>{escape(part.text)}</text>"


def _look(part: MovingLine) -> str:
    broken = f' stroke-dasharray="{" ".join(f"{length:g}" for length in part.dashes)}"' if part.dashes else ""
    return f'fill="{part.fill}" stroke="{part.stroke}" stroke-width="{part.width:g}" stroke-linecap="round"{broken}'


def _line(tracks: PointTracks, part: MovingLine) -> str:
    """A line through points."""
    points = [tracks.point(track) for track in part.points.T]
    through = "L".join(tracks.first(point) for point in points) + ("Z" if part.closed else "")
    end = ' data-closed="1"' if part.closed else ""
    return f'<path data-line="{",".join(map(str, points))}"{end} d="M{through}" {_look(part)}/>'


def _rigid(tracks: PointTracks, part: MovingLine) -> str:
    """A line that moves as a whole, by a position and a direction at every frame."""
    points = part.points
    far = int(np.argmax(np.abs(points[0] - points[0, 0])))
    along = points[:, far] - points[:, 0]
    local = np.conj((points[0] - points[0, 0]) / (along[0] / abs(along[0])))
    ahead = tracks.point(points[:, far])
    turned = float(np.degrees(-np.angle(along[tracks.start])))
    placed = _placed(tracks, points[:, 0], f" rotate({turned:.2f})")
    return f'<path d="{_path(local)}{"Z" if part.closed else ""}" {_look(part)} data-ahead="{ahead}" {placed}/>'


def _block(tracks: PointTracks, part: MovingBlock) -> str:
    ahead = tracks.point(part.at + 10.0 * part.along)
    turned = float(np.degrees(-np.angle(part.along[tracks.start])))
    box = f'x="{-BLOCK.real:g}" y="{-BLOCK.imag:g}" width="{2 * BLOCK.real:g}" height="{2 * BLOCK.imag:g}"'
    look = f'rx="1.5" fill="#e4e8ec" stroke="{STEEL}" stroke-width="1.2"'
    return f'<rect {box} {look} data-ahead="{ahead}" {_placed(tracks, part.at, f" rotate({turned:.2f})")}/>'


def _path(points: ComplexArray) -> str:
    """The path through points of a figure, whose y axis points down."""
    return "M" + "L".join(f"{round(at.real, 2):g} {round(at.imag, 2):g}" for at in points.tolist())


def is_rigid(points: ComplexArray) -> bool:
    """Whether a line of more than three points moves without changing its shape; points (frames, points)."""
    if points.shape[1] <= 3 or not np.isfinite(points).all():
        return False
    off = points - points[:, :1]
    far = int(np.argmax(np.abs(off[0])))
    size = abs(off[0, far])
    if size == 0 or np.any(off[:, far] == 0):
        return False
    turned = off[:, far] / off[0, far]
    return bool(np.max(np.abs(off - turned[:, np.newaxis] * off[0])) < 1e-6 * size)


def _placed(tracks: PointTracks, at: ComplexArray, more: str = "") -> str:
    point = tracks.point(at)
    return f'data-at="{point}" transform="translate({tracks.first(point)}){more}"'
