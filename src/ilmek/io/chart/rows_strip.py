"""One strip of rows.pdf: the cells of a row, the counts and symbols of its runs above, numbers of knots below."""

from collections.abc import Callable
from dataclasses import dataclass, field

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


@dataclass(frozen=True, slots=True)
class RunLabel:
    """A run's label: its middle [pt], from the left edge of the strip, count (empty: one knot) and symbols."""

    middle: float
    count: str
    signs: str
    width: float


@dataclass(slots=True, eq=False)
class Typesetter:
    """Text in SIGNS at any position, much quicker than one call of the library for each: texts are encoded once."""

    canvas: PrintCanvas
    size: float
    _encoded: dict[str, str] = field(default_factory=dict)

    def code(self, text: str) -> str:
        """The operators of PDF that show a text (ISO 32000-1, 9.4), font included."""
        if text not in self._encoded:
            parts = [(text, SIGNS)] if is_plain(text, SIGNS) else pieces(text, SIGNS)
            self._encoded[text] = " ".join(self._piece(*part) for part in parts)
        return self._encoded[text]

    def _piece(self, text: str, font: str) -> str:
        """A part of a text, in a font whose digits are spaced as those of SIGNS."""
        made = self.canvas.beginText()
        made.setFont(font, self.size)
        made._curSubset = -1  # each text names its font, so that texts can follow in any order
        shown = text if font == SIGNS else codes_of(text, font)
        space = ADVANCE * self.size - stringWidth(shown, font, self.size) / len(text)
        return f"{space:.3f} Tc {made._formatText(shown)}"

    def show(self, texts: list[tuple[float, float, str]]) -> None:
        """Write texts, each centred on x, with its baseline on y."""
        half = ADVANCE * self.size / 2
        shown = [f"1 0 0 1 {x - half * len(text):.2f} {y:.2f} Tm {self.code(text)}" for x, y, text in texts]
        self.canvas._code.append("\n".join(["BT", *shown, "ET"]))


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
        if one.count:
            texts.append((one.middle, low + 1.02 * plan.size, canvas.numerals(one.count)))
    setter.show(texts)
    _rulers(canvas, strip, plan, reading)
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
    """Fill the runs, mark half knots and jufti knots, frame the strip."""
    code = canvas._code
    for run in strip.runs:
        begin, end = max(run.first, strip.first), min(run.first + run.cells, strip.stop)
        if begin >= end:
            continue
        x, width = (begin - strip.first) * plan.cell, (end - begin) * plan.cell
        code.append("{:.3f} {:.3f} {:.3f} rg".format(*inks.fills[run.yarn]) + f" {x:.2f} 0 {width:.2f} {STRIP} re f")
        if run.mark == HALF:
            code.append("{:.3f} {:.3f} {:.3f} rg".format(*inks.fills[run.second]))
            right = [(x + (cell + 0.5) * plan.cell) for cell in range(end - begin)]
            code.append(" ".join(f"{at:.2f} 0 {plan.cell / 2:.2f} {STRIP} re" for at in right) + " f")
        elif run.mark == JUFTI:
            pairs = [(run.first + 2 * knot - strip.first) * plan.cell for knot in range(run.knots)]
            ink = "1 g" if inks.white[run.yarn] else "0 g"
            shown = [max(at, 0.0) for at in pairs if x - 2 * plan.cell < at < x + width]
            bars = " ".join(f"{at + 0.3 * plan.cell:.2f} 3.5 {1.4 * plan.cell:.2f} 2 re" for at in shown)
            code.append(f"{ink} {bars} f" if shown else "")
    canvas.setStrokeGray(0.25)
    canvas.setLineWidth(0.4)
    canvas.rect(0, 0, (strip.stop - strip.first) * plan.cell, STRIP, stroke=1, fill=0)


def _rulers(canvas: PrintCanvas, strip: Strip, plan: RowsLayout, reading: str) -> None:
    """The numbers below the cells, which are drawn once for all strips of the same knots."""
    name = f"ruler-{strip.first}-{reading}"
    if not canvas.hasForm(name):
        canvas.beginForm(name, -LEFT, -plan.pitch, plan.width, STRIP)
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
    """The box to tick and the number of the row, at both sides."""
    canvas.setStrokeGray(0.2)
    canvas.setLineWidth(0.6)
    canvas.rect(-LEFT, -0.5, 9.0, 9.0, stroke=1, fill=0)
    canvas.setFillGray(0.0)
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
