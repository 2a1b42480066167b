"""Axes: which rows (or columns) of one grid lie in each row (or column) of another one, along one direction.

A line is a row or a column. Line i of a grid lies between i and i + 1, its centre at i + 1/2. A line of the new grid
has the old lines whose centres lie in it; where none does, that in which its own centre lies. So a line of an enlarged
grid has one old line, and of a reduced grid each old line has a place.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import BoolArray, FloatArray, IntArray

Span = tuple[int, int]
"""First line, and the line behind the last one."""

_TIE = 1e-9
"""Part of a line within which a centre counts as lying on an edge."""


@dataclass(frozen=True, eq=False, slots=True)
class LineMap:
    """The old lines of each line of a part of a new grid.

    begin        the first line of the part
    first, last  old lines `first` to before `last` of each line of the part; equal where it has none
    scale        new lines for an old one
    """

    begin: int
    first: IntArray
    last: IntArray
    scale: float


def _axis(begin: int, at: FloatArray, step: FloatArray | float, zone: Span) -> LineMap:
    """The axis of old positions.

    at    old position of the centre of each new line; NaN: it has none      step  old lines for a new one
    zone  old lines that may be had
    """
    known = np.isfinite(at)
    place = np.where(known, at, zone[0] - 1.0)
    half = np.broadcast_to(np.abs(np.asarray(step, dtype=float)) / 2, at.shape)
    first = np.ceil(place - half - 0.5 - _TIE).astype(np.int64)
    last = np.ceil(place + half - 0.5 - _TIE).astype(np.int64)
    single = first >= last
    first = np.where(single, np.floor(place + _TIE).astype(np.int64), first)
    last = np.where(single, first + 1, last)
    first, last = np.maximum(first, zone[0]), np.minimum(last, zone[1])
    none = ~known | (first >= last)
    steps = half[known] * 2
    scale = 1.0 / float(np.median(steps)) if steps.size else 1.0
    return LineMap(begin, np.where(none, zone[0], first), np.where(none, zone[0], last), scale)


def _centres(span: Span) -> FloatArray:
    """Centres of the lines of a span, from its begin."""
    return np.arange(span[1] - span[0]) + 0.5


def proportional(old: Span, new: Span, *, reflected: bool = False) -> LineMap:
    """A span that is enlarged or reduced to another one.

    >>> axis = proportional((0, 2), (10, 14))
    >>> axis.first.tolist(), axis.scale
    ([0, 0, 1, 1], 2.0)
    """
    step = (old[1] - old[0]) / (new[1] - new[0])
    at = _centres(new) * step
    return _axis(new[0], old[1] - at if reflected else old[0] + at, step, old)


def _from_edges(new: Span) -> tuple[FloatArray, BoolArray]:
    """Distance of each line's centre from the nearer end of its span, and whether that is the far end."""
    at, length = _centres(new), new[1] - new[0]
    return np.minimum(at, length - at), at > length / 2


def _at_edge(old: Span, away: FloatArray, far: BoolArray) -> FloatArray:
    """Positions at a distance from the near or the far end of a span."""
    return np.asarray(np.where(far, old[1] - away, old[0] + away))


def bordered(old: Span, new: Span, breadths: tuple[int, int], pitches: tuple[float, float] | None) -> LineMap:
    """Across a carpet within the outer edge of a border: the border's breadth at both ends, and its side between.

    breadths  old and new breadth [lines]
    pitches   old and new length of a motif along the side: motifs are counted from the nearer corner, up to the middle
              of the shorter side; None: an even side, which is stretched
    """
    away, far = _from_edges(new)
    inner = (old[1] - old[0]) / 2 - breadths[0], (new[1] - new[0]) / 2 - breadths[1]
    depth, along = breadths[0] / breadths[1], inner[0] / inner[1] if pitches is None else pitches[0] / pitches[1]
    is_corner = away < breadths[1]
    distance = np.where(is_corner, away * depth, breadths[0] + (away - breadths[1]) * along)
    distance = np.where(distance <= inner[0] + breadths[0], distance, np.nan)
    return _axis(new[0], _at_edge(old, distance, far), np.where(is_corner, depth, along), old)


def pictured(
    old: Span, new: Span, shown: tuple[Span | tuple[float, float], tuple[float, float]], *, mirror: bool, copies: bool
) -> LineMap:
    """Across a field whose picture is fitted: what lies at one place of the picture.

    shown   old and new part of the picture that the field shows, as shares of the picture
    mirror  the picture is the first half of the field      copies  the old lines are those of the picture alone, and
            each half of the field has them
    """
    away, far = _from_edges(new) if mirror else (_centres(new), np.zeros(new[1] - new[0], dtype=bool))
    sizes = [
        -(-(span[1] - span[0]) // 2) if halved else span[1] - span[0]
        for span, halved in ((old, mirror and not copies), (new, mirror))
    ]
    (low, high), (new_low, new_high) = shown
    step = sizes[0] / sizes[1] * (new_high - new_low) / (high - low)
    at = (new_low - low) / (high - low) * sizes[0] + away * step
    at = np.where((at >= 0) & (at <= sizes[0]), at, np.nan)
    return _axis(new[0], _at_edge(old, at, far & (not copies)), step, old)


@dataclass(frozen=True, slots=True)
class Tiling:
    """The tiles along one direction of a span.

    span   [lines]      side  of a tile [lines]      first  line of the span at which a tile begins
    whole  only whole tiles are drawn
    """

    span: Span
    side: int
    first: int
    whole: bool

    @property
    def numbers(self) -> Span:
        """Numbers of the whole tiles: the first, and that behind the last one."""
        return -(self.first // self.side), (self.span[1] - self.span[0] - self.first) // self.side

    def number(self, line: FloatArray) -> IntArray:
        """The number of the tile at each position of the span."""
        return np.asarray(np.floor((line - self.first) / self.side), np.int64)

    def shifted(self, by: int) -> "Tiling":
        """The same tiles some lines further."""
        return Tiling(self.span, self.side, self.first + by, self.whole)


def old_tiles(old: Tiling, new: Tiling, numbers: IntArray) -> tuple[IntArray, BoolArray]:
    """The old tile of each number of a new one, and whether there is one.

    Cut tiles are counted from the middle one. Whole tiles are counted from the nearer edge: each of the old ones is
    found once, and the new ones that there are more of, in the middle, have none.
    """
    if not old.whole:
        return numbers, np.ones(numbers.shape, dtype=bool)
    (begin, end), (new_begin, new_end) = old.numbers, new.numbers
    before, after = numbers - new_begin, new_end - 1 - numbers
    counts = end - begin, new_end - new_begin
    near = (2 * before < counts[1]) & (2 * before < counts[0])
    far = (2 * after + 1 < counts[1]) & (2 * after + 1 < counts[0])
    inside = (before >= 0) & (after >= 0)
    return np.where(near, begin + before, end - 1 - after), inside & (near | far)


def tiled(old: Tiling, new: Tiling, *, mirrored: bool = False) -> LineMap:
    """Across a field of tiles of one size: what lies at one place of a tile, and the ground between tiles and edges.

    mirrored  every second tile is reflected
    """
    line = _centres(new.span)
    numbers = new.number(line)
    found, known = old_tiles(old, new, numbers)
    inside = line - new.first - numbers * new.side
    turned = mirrored & ((found - numbers) % 2 == 1)
    at = old.span[0] + old.first + found * old.side + np.where(turned, old.side - inside, inside)
    if old.whole:
        begin, end = (new.first + number * new.side for number in new.numbers)
        after = new.span[1] - new.span[0] - line
        edges = np.where(line < begin, old.span[0] + line, old.span[1] - after)
        is_ground = (line < begin) | (line > end)
        at, known = np.where(is_ground, edges, at), known | is_ground
    return _axis(new.span[0], np.where(known, at, np.nan), 1.0, old.span)
