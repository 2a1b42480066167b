"""A view of a part on paper: its lines, and dimensions placed so that no text lies on another or on a line.

Rows of dimensions stand below and left of a view, the shorter ones nearer; many coordinates of one direction stand as
running dimensions from the datum. Leaders search a free spot around what they point to. Positions in mm of the paper.
[ISO 129-1: arrangement of dimensions; ISO 128-3: views]
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.plane.contours import circle
from ilmek.records import record
from ilmek.report import Contour
from ilmek.report.sheet import DimensionKind, LineKind, SheetDimension, SheetLine, SheetText, arrowhead
from ilmek.viz.drawings.feature_note import LETTER, FeatureNote
from ilmek.viz.drawings.picture import (
    CAPITAL,
    Box,
    SheetPicture,
    box_around,
    joined_box,
    line_points,
    millimetres,
    overlap,
    text_box,
    words_width,
)
from ilmek.viz.drawings.spots import PAD, TURNS, TakenRoom, box_below, spread, turns_from, within
from ilmek.viz.font import text_width

GAP, ROW = 9.0, 7.5
"""Distance of the first row of dimensions from the view, and of a row from the next [mm]."""

_STEP, _ARROWS = 0.6, 8.0

_ON_TEXT = 1000.0
"""Fault of a spot for a text from which on it covers another."""

NO_NOTE = FeatureNote()
"""Of a feature that must hold nothing but its size."""


@record
class MeasuredLength:
    """A length to be dimensioned in a row: from where to where on the paper, and its true value [m]."""

    start: complex
    end: complex
    value: float
    prefix: str = ""
    suffix: str = ""
    auxiliary: bool = False

    @property
    def words(self) -> str:
        """Its text: an auxiliary dimension in brackets."""
        words = f"{self.prefix}{millimetres(self.value)}{self.suffix}"
        return f"({words})" if self.auxiliary else words


class DrawnView:
    """A view at a scale [mm of the paper per m]."""

    def __init__(self, scale: float) -> None:
        self.scale = scale
        self.crowding = 0.0
        self._lines: list[SheetLine] = []
        self._texts: list[SheetText] = []
        self._dimensions: list[SheetDimension] = []
        self._boxes: list[Box] = []
        self._samples: list[ComplexArray] = []
        self._bodies: list[ComplexArray] = []

    @property
    def picture(self) -> SheetPicture:
        """All that was drawn."""
        return SheetPicture(tuple(self._lines), tuple(self._texts), tuple(self._dimensions))

    @property
    def body(self) -> Box:
        """The box around the part itself."""
        return joined_box([box_around(points) for points in self._bodies])

    def contour(self, kind: LineKind, contour: Contour) -> None:
        """A closed line of the part [m]."""
        bulges = contour.bulges if contour.bulges.any() else None
        self._add(SheetLine(kind, contour.points * self.scale, bulges, closed=True), body=True)

    def line(self, kind: LineKind, points: ComplexArray, *, body: bool = True) -> None:
        """An open line through points of the part [m]."""
        self._add(SheetLine(kind, np.asarray(points) * self.scale), body=body)

    def cross(self, centre: complex, radius: float) -> None:
        """The centre lines of a circle [m], a little beyond it."""
        for arm in (1.0, 1j):
            reach = arm * (radius + min(2.5, 0.7 + radius * self.scale) / self.scale)
            self.line(LineKind.CENTRE, np.array([centre - reach, centre + reach]), body=False)

    def hatch(self, contours: Sequence[ComplexArray], spacing: float = 2.5) -> None:
        """Lines at 45° within closed polygons [m], holes left out."""
        polygons = [np.append(points, points[:1]) * self.scale for points in contours]
        turned = [points * np.exp(-0.25j * math.pi) for points in polygons]
        heights = np.concatenate([points.imag for points in turned])
        for level in np.arange(math.ceil(heights.min() / spacing), heights.max() / spacing) * spacing + 1e-7:
            crossings: list[float] = []
            for points in turned:
                low, high = points[:-1], points[1:]
                cut = (low.imag > level) != (high.imag > level)
                share = (level - low.imag[cut]) / (high.imag[cut] - low.imag[cut])
                crossings += (low.real[cut] + share * (high.real[cut] - low.real[cut])).tolist()
            crossings.sort()
            for first, last in zip(crossings[::2], crossings[1::2], strict=True):
                ends = (np.array([first, last]) + 1j * level) * np.exp(0.25j * math.pi)
                self._add(SheetLine(LineKind.HATCH, ends), body=False)

    def text(self, text: SheetText) -> None:
        """A text at a position of the paper."""
        self._texts.append(text)
        self._boxes.append(text_box(text))

    def rows(self, spans: Sequence[MeasuredLength], *, across: bool, beyond: float = GAP) -> None:
        """Rows of dimensions below the view, or left of it where they measure across (along y)."""
        unit = 1j if across else 1.0
        base = -(self.body[0] if across else self.body[1]) + beyond
        taken: list[list[tuple[float, float]]] = []
        laid: list[tuple[MeasuredLength, float, SheetText, tuple[float, float]]] = []
        for span in sorted(spans, key=lambda one: round(abs(one.end - one.start), 6)):
            low, high = sorted(coordinate(point, across) for point in (span.start, span.end))
            width = words_width(span.words, LETTER)
            middle, interval = _text_in(low, high, width)
            for row in range(60):
                line = base + row * ROW
                position = unit * middle + (-line if across else -1j * line) + (-1.0 if across else 1j)
                text = SheetText(position, span.words, LETTER, "center", math.pi / 2 if across else 0.0)
                while len(taken) <= row:
                    taken.append([])
                free = all(interval[1] <= one[0] + 1e-6 or interval[0] >= one[1] - 1e-6 for one in taken[row])
                room = text_box(text)
                if free and not any(overlap(room, box, PAD) for box in self._boxes):
                    break
            taken[row].append(interval)
            self._boxes.append(room)
            laid.append((span, line, text, (low, high)))
        for span, line, text, ends in laid:
            self._row_dimension(span, line, text, ends, across)

    def _row_dimension(
        self, span: MeasuredLength, line: float, text: SheetText, ends: tuple[float, float], across: bool
    ) -> None:
        unit = 1j if across else 1.0
        out = -1.0 if across else -1j
        low, high = ends
        inside = high - low >= _ARROWS
        first, last = (low, high) if inside else (low - 5, high + 5)
        reached = text_box(text)[1::2] if across else text_box(text)[::2]
        drawn = [np.array([unit * min(first, *reached), unit * max(last, *reached)]) + out * line]
        for point in (span.start, span.end):
            foot = point + 1.0 * out
            tip = unit * coordinate(point, across) + out * (line + 2)
            drawn += self._clear_pieces(foot, tip)
        sign = 1 if inside else -1
        arrows = ((unit * low + out * line, -sign * unit), (unit * high + out * line, sign * unit))
        self._finish(
            SheetDimension(
                DimensionKind.LINEAR,
                span.value,
                (span.start, span.end),
                unit * low + out * line,
                text,
                tuple(SheetLine(LineKind.DIMENSION, points) for points in drawn),
                arrows,
                across,
            )
        )

    def ordinates(self, points: Sequence[complex], datum: complex, *, across: bool) -> None:
        """Running dimensions from a datum below the view, or left of it: a text at the end of each extension line."""
        unit, out = (1j, -1.0) if across else (1.0, -1j)
        base = -(self.body[0] if across else self.body[1])
        ordered = sorted(points, key=lambda point: coordinate(point, across))
        wanted = np.array([coordinate(point, across) for point in ordered])
        positions = spread(wanted, LETTER * 1.75)
        self.crowding = max(self.crowding, float(np.abs(positions - wanted).max()))
        for attempt in range(40):
            line = base + GAP + attempt * ROW
            texts = [
                SheetText(
                    unit * (position - 0.5 * LETTER * (1 if across else -1)) + out * (line + 1),
                    millimetres(abs(coordinate(point - datum, across)) / self.scale),
                    LETTER,
                    "right",
                    0.0 if across else math.pi / 2,
                )
                for point, position in zip(ordered, positions.tolist(), strict=True)
            ]
            rooms = [text_box(text) for text in texts]
            if not any(overlap(room, box, PAD) for room in rooms for box in self._boxes):
                break
        self._boxes += rooms
        for point, position, text in zip(ordered, positions.tolist(), texts, strict=True):
            elbow = unit * coordinate(point, across) + out * (line - 5)
            end = unit * position + out * line
            lines = [*self._clear_pieces(point + out, elbow), np.array([elbow, end])]
            self._finish(
                SheetDimension(
                    DimensionKind.ORDINATE,
                    abs(coordinate(point - datum, across)) / self.scale,
                    (datum, point),
                    end,
                    text,
                    tuple(SheetLine(LineKind.DIMENSION, points) for points in lines),
                    (),
                    across,
                )
            )

    def leader(
        self,
        words: str,
        centre: complex,
        radius: float,
        *,
        kind: DimensionKind | None,
        value: float = 0.0,
        count: int = 1,
        sector: tuple[complex, complex] | None = None,
        measured: tuple[complex, complex] | None = None,
        note: FeatureNote = NO_NOTE,
        lead: str = "",
    ) -> complex:
        """A text beside a circle or arc, or beside a point (radius 0), with a line to it.

        sector    the ends of an arc, counter-clockwise, within which the line ends; None: anywhere
        measured  both ends of what is dimensioned, where they are not those of the circle or arc
        note      what hangs below the text
        lead      first words of it, below which alone the line goes on, to the right; "": below all
        Returns the elbow of the line.
        """
        hung = None if note.is_bare else note.hanging().box
        tip, elbow, text = self._spot(
            words, centre, radius, sector, hung or ((0.0, -LETTER, 0.0, 0.0) if lead else None)
        )
        box = text_box(text)
        shelf = complex(box[2] if text.anchor == "left" else box[0], elbow.imag)
        shelf = elbow + 1.5 + text_width(lead, LETTER / CAPITAL) if lead else shelf
        line = SheetLine(LineKind.DIMENSION, np.array([tip, elbow, shelf]))
        inward = tip - elbow
        self._boxes.append(box)
        if hung is not None:
            self._hang(note, box_below(box, hung, text.anchor))
        if kind is None:
            self._texts.append(text)
            self._add(line, body=False)
            if hung is not None or lead:
                self._add(SheetLine(LineKind.DIMENSION, np.array(arrowhead(tip, inward)), closed=True), body=False)
            return elbow
        far = 2 * centre - tip if kind is DimensionKind.DIAMETER else centre
        ends = measured or (far, tip)
        self._finish(SheetDimension(kind, value, ends, elbow, text, (line,), ((tip, inward),), count=count))
        return elbow

    def _spot(
        self, words: str, centre: complex, radius: float, sector: tuple[complex, complex] | None, hung: Box | None
    ) -> tuple[complex, complex, SheetText]:
        """Tip and elbow of a leader, and its text, at the nearest free spot; hung  room of what hangs below it."""
        taken = self._taken()
        best: tuple[float, complex, complex, SheetText] | None = None
        for distance in (6.0, 10.0, 15.0, 21.0, 28.0, 36.0, 46.0, 58.0, 72.0, 90.0):
            for turn in turns_from(centre, sector):
                direction = complex(math.cos(turn), math.sin(turn))
                tip = centre + radius * direction
                elbow = tip + distance * direction
                right = direction.real > -1e-9
                at = elbow + (1.5 if right else -1.5) + 0.8j
                text = SheetText(at, words, LETTER, "left" if right else "right")
                box = text_box(text)
                box = box if hung is None else joined_box([box, box_below(box, hung, text.anchor)])
                fault = taken.fault(box, tip, elbow, np.inf if best is None else best[0])
                if not fault:
                    return tip, elbow, text
                if best is None or fault < best[0] - 1e-9:
                    best = fault, tip, elbow, text
            if best is not None and best[0] < 3:
                break
        assert best is not None
        return best[1:]

    def draw(self, lines: Sequence[SheetLine]) -> None:
        """Lines at positions of the paper, on which no text may lie."""
        for line in lines:
            self._add(line, body=False)
        self._boxes.append(joined_box([box_around(line_points(line)) for line in lines]))

    def _hang(self, note: FeatureNote, room: Box) -> None:
        """Draw what hangs below a text in its room."""
        hanging = note.hanging()
        below = hanging.moved(complex(room[0] - hanging.box[0], room[3] - hanging.box[3]))
        self._boxes.append(room)
        self._texts += below.texts
        self.draw(below.lines)

    def tag(self, words: str, centre: complex, radius: float) -> None:
        """A short name beside a hole."""
        taken, candidates = self._taken(), []
        for distance in (0.8, 2.0, 4.0):
            for turn in TURNS[:16]:
                direction = complex(math.cos(turn), math.sin(turn))
                at = centre + (radius + distance) * direction - 0.5j * LETTER
                text = SheetText(at, words, LETTER, "left" if direction.real > 0 else "right")
                candidates.append((taken.fault(text_box(text), at, at), text))
        fault, text = min(candidates, key=lambda one: one[0])
        if fault < _ON_TEXT:
            self.text(text)
        else:
            self.leader(words, centre, radius, kind=None)

    def datum_mark(self, at: complex, axes: Mapping[str, complex]) -> None:
        """The datum of coordinates [m] with arrows along their axes, by name and direction on the paper."""
        origin = at * self.scale
        ring = circle(origin, 1.2)
        self._add(SheetLine(LineKind.DATUM, ring.points, ring.bulges, closed=True), body=False)
        for name, along in axes.items():
            tip = origin + 10.0 * along
            self._add(SheetLine(LineKind.DATUM, np.array([origin, tip])), body=False)
            self._add(SheetLine(LineKind.DATUM, np.array(arrowhead(tip, along)), closed=True), body=False)
            aside = -2.6 * sum(other for other in axes.values() if other != along)
            self.text(SheetText(tip + aside - 1j * LETTER / 2, name, LETTER, "center", bold=True))

    def _taken(self) -> TakenRoom:
        samples = np.concatenate([np.zeros(0, complex), *self._samples])
        self._samples = [samples[np.argsort(samples.real, kind="stable")]]  # quick where most are in order
        return TakenRoom(np.array(self._boxes, dtype=float).reshape(-1, 4), self._samples[0])

    def _clear_pieces(self, start: complex, end: complex) -> list[ComplexArray]:
        """A straight line, interrupted where texts lie."""
        length = abs(end - start)
        if length < 1e-9:
            return []
        samples = np.linspace(0.0, 1.0, max(2, int(length / 0.2)))
        points = start + samples * (end - start)
        free = ~np.any([within(points, box) for box in self._boxes] or [np.zeros(len(points), bool)], axis=0)
        starts = np.flatnonzero(free & ~np.append(False, free[:-1]))
        ends = np.flatnonzero(free & ~np.append(free[1:], False))
        return [points[[first, last]] for first, last in zip(starts, ends, strict=True) if last > first]

    def _finish(self, dimension: SheetDimension) -> None:
        self._dimensions.append(dimension)
        for line in dimension.lines:
            self._sample(line)

    def _add(self, line: SheetLine, *, body: bool) -> None:
        self._lines.append(line)
        self._sample(line)
        if body:
            self._bodies.append(line_points(line))

    def _sample(self, line: SheetLine) -> None:
        points = line_points(line, 0.1)
        steps = np.abs(np.diff(points))
        total = float(steps.sum())
        count = max(2, int(total / _STEP) + 1)
        if total > 0 and len(points) == 2:
            self._samples.append(points[0] + (points[1] - points[0]) * (np.arange(count) / (count - 1)))
        elif total > 0:
            length = np.concatenate([[0.0], np.cumsum(steps)])
            marks = np.linspace(0.0, total, count)
            self._samples.append(np.interp(marks, length, points.real) + 1j * np.interp(marks, length, points.imag))


def coordinate(point: complex, across: bool) -> float:
    """Its coordinate in the direction that is measured: y where that is across, else x."""
    return point.imag if across else point.real


def _text_in(low: float, high: float, width: float) -> tuple[float, tuple[float, float]]:
    """Middle of a dimension's text, and the interval that the dimension takes in its row."""
    inside = high - low >= _ARROWS
    if width + 1.0 <= high - low:
        return (low + high) / 2, (low, high) if inside else (low - 5.5, high + 5.5)
    middle = high + 6.0 + width / 2
    return middle, (low - 5.5, middle + width / 2 + 1.0)
