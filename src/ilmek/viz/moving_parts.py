"""Moving parts of a figure as SVG: each part refers to its positions in the list of the figure's run."""

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


def line(
    tracks: PointTracks,
    track: Sequence[ComplexArray],
    stroke: str,
    width: float,
    *,
    closed: bool = False,
    fill: str = "none",
) -> str:
    """A line through points."""
    points = [tracks.point(line_point) for line_point in track]
    through = "L".join(tracks.first(point) for point in points) + ("Z" if closed else "")
    look = f'fill="{fill}" stroke="{stroke}" stroke-width="{width:g}" stroke-linecap="round"'
    end = ' data-closed="1"' if closed else ""
    return f'<path data-line="{",".join(map(str, points))}"{end} d="M{through}" {look}/>'


def rigid(tracks: PointTracks, points: ComplexArray, look: str, *, closed: bool) -> str:
    """A line that moves as a whole, by a position and a direction at every frame.

    points  on the sheet [pt], (frames, points)
    """
    far = int(np.argmax(np.abs(points[0] - points[0, 0])))
    along = points[:, far] - points[:, 0]
    local = np.conj((points[0] - points[0, 0]) / (along[0] / abs(along[0])))
    ahead = tracks.point(points[:, far])
    turned = float(np.degrees(-np.angle(along[tracks.start])))
    placed = _placed(tracks, points[:, 0], f" rotate({turned:.2f})")
    return f'<path d="{_path(local)}{"Z" if closed else ""}" {look} data-ahead="{ahead}" {placed}/>'


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


def marked(tracks: PointTracks, at: ComplexArray, corners: ComplexArray, fill: str) -> str:
    """A marker with its corners about a moving point [pt]."""
    look = f'fill="{fill}" stroke="{PAPER}" stroke-width="0.5"'
    return f'<path d="{_path(np.conj(corners))}Z" {look} {_placed(tracks, at)}/>'


def dot(tracks: PointTracks, at: ComplexArray, role: str) -> str:
    """A pin (a circle) or a point (a small disc)."""
    size, look = (3.4, f'fill="{PAPER}" stroke="{INK}" stroke-width="1.1"') if role == "pin" else (2.2, f'fill="{INK}"')
    return f'<circle r="{size:g}" {look} {_placed(tracks, at)}/>'


def block(tracks: PointTracks, at: ComplexArray, along: ComplexArray) -> str:
    """A slider: a rectangle along its guide."""
    ahead = tracks.point(at + 10.0 * along)
    turned = float(np.degrees(-np.angle(along[tracks.start])))
    box = f'x="{-BLOCK.real:g}" y="{-BLOCK.imag:g}" width="{2 * BLOCK.real:g}" height="{2 * BLOCK.imag:g}"'
    look = f'rx="1.5" fill="#e4e8ec" stroke="{STEEL}" stroke-width="1.2"'
    return f'<rect {box} {look} data-ahead="{ahead}" {_placed(tracks, at, f" rotate({turned:.2f})")}/>'


def name(tracks: PointTracks, middle: ComplexArray, text: str) -> str:
    """A bold name with a pale edge that hides lines behind it."""
    edge = f'stroke="{PAPER}" stroke-width="2.6" paint-order="stroke"'
    look = f'font-size="{STRONG:g}px" font-weight="bold" text-anchor="middle" dy="0.35em" fill="{INK}" {edge}'
    return f"<text {look} {_placed(tracks, middle)}>{escape(text)}</text>"


def _placed(tracks: PointTracks, at: ComplexArray, more: str = "") -> str:
    point = tracks.point(at)
    return f'data-at="{point}" transform="translate({tracks.first(point)}){more}"'
