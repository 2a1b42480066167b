"""One strip of rows.pdf: the cells of a row, the counts and symbols of its runs above, numbers of knots below."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import NamedTuple

from reportlab.pdfbase.pdfmetrics import stringWidth

from ilmek.carpet.codes import NO_KNOT
from ilmek.carpet.overlay import HALF, JUFTI
from ilmek.carpet.rows import Run
from ilmek.io.chart.inks import Inks
from ilmek.io.chart.lettering import codes_of, is_plain, line_width, pieces
from ilmek.io.chart.printing import PrintCanvas
from ilmek.io.chart.rows_layout import LABEL_GAP, LEFT, RULER, SMALLEST, STRIP, RowsLayout
from ilmek.io.chart.symbols import ADVANCE, SIGNS, STRONG, TEXT

_GREY = (0.42, 0.45, 0.49)


@dataclass(frozen=True, slots=True)
class Strip:
    """What a strip shows: number of the row, its runs, first cell and end of the strip, part of the row."""

    number: int
    runs: tuple[Run, ...]
    first: int
    stop: int
    part: str = ""


class RunLabel(NamedTuple):
    """A run's label: its middle [pt], from the left edge of the strip, knots (empty: one) and symbols."""

    middle: float
    knots: str
    signs: str
    width: float


@dataclass(slots=True, eq=False)
class Typesetter:
    """Text in SIGNS at any position, much quicker than one call of the library for each: texts are encoded once."""

    canvas: PrintCanvas
    size: float
    _encoded: dict[str, tuple[str, str]] = field(default_factory=dict)

    def code(self, text: str) -> tuple[str, str]:
        """The operators of PDF that set the font of a text, and those that show it (ISO 32000-1, 9.4)."""
        if text not in self._encoded:
            parts = [(text, SIGNS)] if is_plain(text, SIGNS) else pieces(text, SIGNS)
            font, _, shown = " ".join(self._piece(*part) for part in parts).partition(" TL ")
            self._encoded[text] = f"{font} TL", shown
        return self._encoded[text]

    def _piece(self, text: str, font: str) -> str:
        """A part of a text, in a font whose digits are spaced as those of SIGNS."""
        shown = text if font == SIGNS else codes_of(text, font)
        space = ADVANCE * self.size - stringWidth(shown, font, self.size) / len(text)
        return f"{space:.3f} Tc {self.canvas.operators(shown, font, self.size)}"

    def show(self, texts: list[tuple[float, float, str]]) -> None:
        """Write texts, each centred on x, with its baseline on y."""
        half, before, shown = ADVANCE * self.size / 2, "", ["BT"]
        for x, y, text in texts:
            font, code = self.code(text)
            setting = "" if font == before else font
            shown.append(f"1 0 0 1 {x - half * len(text):.2f} {y:.2f} Tm {setting} {code}")
            before = "" if " Tf " in code else font
        self.canvas.addLiteral("\n".join([*shown, "ET"]))


def strip_labels(strip: Strip, plan: RowsLayout, inks: Inks) -> list[RunLabel]:
    """The labels of a strip's runs, from left to right.

    A run that begins before the strip has an arrow alone; one that goes on beyond it an arrow beside its whole count.
    """
    strip_labels = []
    for run in strip.runs:
        begin, end = max(run.first, strip.first), min(run.first + run.cells, strip.stop)
        if begin >= end:
            continue
        signs = inks.symbols[run.yarn] + (inks.symbols[run.second] if run.mark == HALF else "")
        mark = "½" if run.mark == HALF else "j" if run.mark == JUFTI else ""
        count = "" if run.knots == 1 and not mark else f"{run.knots}{mark}"
        if begin > run.first:
            count = "→"
        elif end < run.first + run.cells:
            count = f"{run.knots}{mark}→"
        middle = ((begin + end) / 2 - strip.first) * plan.cell
        strip_labels.append(RunLabel(middle, count, signs, max(len(count), len(signs)) * ADVANCE * plan.size))
    return strip_labels


def levels_of(labels: list[RunLabel]) -> list[int]:
    """The level of each label, 0 the lowest: the lowest one on which it keeps its distance from the one before."""
    last = -math.inf
    for label in labels:
        if last + LABEL_GAP > label.middle - label.width / 2 + 1e-6:
            break
        last = label.middle + label.width / 2
    else:
        return [0] * len(labels)
    ends: list[float] = []
    found = []
    for label in sorted(labels, key=lambda one: one.middle - one.width / 2):
        left, right = label.middle - label.width / 2, label.middle + label.width / 2
        level = next((number for number, end in enumerate(ends) if end + LABEL_GAP <= left + 1e-6), len(ends))
        ends[level:] = [right] if level == len(ends) else [right, *ends[level + 1 :]]
        found.append((label, level))
    by_label = {id(label): level for label, level in found}
    return [by_label[id(label)] for label in labels]


def draw_strip(setter: Typesetter, strip: Strip, plan: RowsLayout, inks: Inks, reading: str) -> None:
    """Draw a strip; the origin is the lower left corner of its cells, behind the space for box and number.

    reading  "right", "left" or "both": from which edges the knots are numbered
    """
    canvas, wide = setter.canvas, (strip.stop - strip.first) * plan.cell
    _cells(canvas, strip, plan, inks)
    _frame(canvas, strip, plan, reading)
    labels = strip_labels(strip, plan, inks)
    placed = list(zip(labels, levels_of(labels), strict=True))
    base = STRIP + 1.8
    canvas.setStrokeGray(0.65)
    canvas.setLineWidth(0.25)
    leaders = [(one.middle, STRIP, one.middle, base + level * plan.level) for one, level in placed if level]
    if leaders:
        canvas.lines(leaders)
    _dividers(canvas, strip, plan, labels)
    canvas.setFillGray(0.0)
    texts = []
    for one, level in placed:
        low = base + level * plan.level
        texts.append((one.middle, low, one.signs))
        if one.knots:
            texts.append((one.middle, low + 1.02 * plan.size, canvas.numerals(one.knots)))
    setter.show(texts)
    _numbers(canvas, strip, wide)


def _dividers(canvas: PrintCanvas, strip: Strip, plan: RowsLayout, labels: list[RunLabel]) -> None:
    """A fine line between neighbouring labels that keep within their runs, so that 2 and 2 are not read as 22."""
    runs = [run for run in strip.runs if run.first < strip.stop and run.first + run.cells > strip.first]
    within = [label.width <= run.cells * plan.cell for run, label in zip(runs, labels, strict=True)]
    ends = ((run.first - strip.first) * plan.cell for run in runs[1:])
    lines = [
        (x, STRIP, x, STRIP + plan.level)
        for x, one, two in zip(ends, within[:-1], within[1:], strict=True)
        if one and two
    ]
    if lines:
        canvas.setStrokeGray(0.7)
        canvas.setLineWidth(0.2)
        canvas.lines(lines)


def _cells(canvas: PrintCanvas, strip: Strip, plan: RowsLayout, inks: Inks) -> None:
    """Fill the runs, mark half knots and jufti knots."""
    whole: dict[int, list[str]] = {}
    marks = []
    for run in strip.runs:
        begin, end = max(run.first, strip.first) - strip.first, min(run.first + run.cells, strip.stop) - strip.first
        if begin >= end:
            continue
        whole.setdefault(run.yarn, []).append(f"{begin} 0 {end - begin} 1 re f")
        if run.mark == HALF:
            right = " ".join(f"{cell}.5 0 .5 1 re" for cell in range(begin, end))
            marks.append(f"{_filling(inks.fills[run.second])} {right} f")
        elif run.mark == JUFTI:
            pairs = [run.first + 2 * knot - strip.first for knot in range(run.knots)]
            shown = [max(at, 0) for at in pairs if begin - 2 < at < end]
            bars = " ".join(f"{at}.3 {3.5 / STRIP:.3f} 1.4 {2 / STRIP:.3f} re" for at in shown)
            marks.append(f"{int(inks.white[run.yarn])} g {bars} f" if shown else "")
    cells = (f"{_filling(inks.fills[yarn])} {' '.join(boxes)}" for yarn, boxes in whole.items())
    # The unit is a cell; each box is filled alone, which keeps its edges sharp.
    canvas.addLiteral("\n".join([f"q {plan.cell:.4f} 0 0 {STRIP} 0 0 cm", *cells, *marks, "Q"]))


@lru_cache(maxsize=512)
def _filling(colour: tuple[float, float, float]) -> str:
    return "{:.3f} {:.3f} {:.3f} rg".format(*colour)


def _frame(canvas: PrintCanvas, strip: Strip, plan: RowsLayout, reading: str) -> None:
    """The frame of the cells, the numbers below them and the box to tick, drawn once for strips of the same knots."""
    name = f"frame-{strip.first}-{reading}"
    if not canvas.hasForm(name):
        canvas.beginForm(name, -LEFT - 1.0, -plan.pitch, plan.width, STRIP + 1.0)
        canvas.setStrokeGray(0.25)
        canvas.setLineWidth(0.4)
        canvas.rect(0, 0, (strip.stop - strip.first) * plan.cell, STRIP, stroke=1, fill=0)
        canvas.setStrokeGray(0.2)
        canvas.setLineWidth(0.6)
        canvas.rect(-LEFT, -0.5, 9.0, 9.0, stroke=1, fill=0)
        for line, rightward in enumerate({"right": (True,), "left": (False,)}.get(reading, (True, False))):
            _ruler(canvas, strip, plan, line, rightward)
        canvas.endForm()
    canvas.doForm(name)


def _ruler(canvas: PrintCanvas, strip: Strip, plan: RowsLayout, line: int, rightward: bool) -> None:
    """Ticks below the cells, longer at fives and tens, and the numbers of the tens, in grey where they count from the
    right.
    """
    low = -RULER * line - 8.2
    canvas.setStrokeGray(0.3)
    canvas.setLineWidth(0.25)
    canvas.setFont(TEXT, SMALLEST)
    canvas.setFillColorRGB(*((0.1, 0.1, 0.1) if rightward else _GREY))
    for number in range(strip.first + 1, strip.stop + 1):
        counted = number if rightward else plan.columns + 1 - number
        x = (number - strip.first - 0.5) * plan.cell
        if line == 0:
            canvas.line(x, 0.0, x, -1.0 if counted % 5 else -2.8 if counted % 10 else -3.6)
        if counted % 10 == 0 or counted == 1:
            canvas.drawCentredString(x, low, str(counted))
    canvas.drawRightString(-4.0, low, "→" if rightward else "←")


def _numbers(canvas: PrintCanvas, strip: Strip, wide: float) -> None:
    """The number of the row, at both sides."""
    size = 10.0 if strip.number < 10_000 else 8.0
    canvas.setFont(STRONG, size)
    canvas.drawRightString(-5.0, 1.0, str(strip.number))
    canvas.drawString(wide + 4.0, 1.0, str(strip.number))
    if strip.part:
        canvas.setFont(TEXT, SMALLEST)
        canvas.setFillColorRGB(*_GREY)
        canvas.drawString(-LEFT, 11.0, strip.part)


def knots_in_words(strip: Strip, inks: Inks, wide: float, numerals: Callable[[str], str] = str) -> str:
    """The knots of each yarn in the row of a strip, as many as one line has space for: `A 212  B 88`.

    numerals  writes a number in the digits of the page
    """
    counts: dict[int, int] = {}
    for run in strip.runs:
        counts[run.yarn] = counts.get(run.yarn, 0) + run.knots
        if run.mark == HALF:
            counts[run.second] = counts.get(run.second, 0) + run.knots
    counts.pop(NO_KNOT, None)
    words = [f"{inks.symbols[yarn]} {numerals(str(count))}" for yarn, count in sorted(counts.items())]
    for shown in range(len(words), 0, -1):
        rest = f"   … +{numerals(str(len(words) - shown))}" if shown < len(words) else ""
        text = "   ".join(words[:shown]) + rest
        if line_width(text, SMALLEST, SIGNS, rightward=True) <= wide:
            return text
    return ""
