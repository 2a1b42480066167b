"""The first page of a printed knot chart: the whole carpet with its sheets."""

from PIL import Image
from reportlab.lib.utils import ImageReader

from ilmek.carpet.cells import OUTSIDE
from ilmek.carpet.chart import Chart
from ilmek.io.chart.legend import colours_in_words, thousands
from ilmek.io.chart.printing import PrintCanvas, size_of, title_of
from ilmek.io.chart.sheets import SheetLayout
from ilmek.io.chart.symbols import STRONG, TEXT
from ilmek.sentences import Sentence, noun
from ilmek.units import format_number

_LEFT, _TOP, _WIDTH, _HEIGHT = 54.0, 800.0, 487.0, 620.0
_GREY = (0.36, 0.40, 0.44)


def draw_overview(canvas: PrintCanvas, chart: Chart, plan: SheetLayout) -> None:
    """Draw the carpet in true proportion under the grid of sheets; each number is a link to its sheet."""
    canvas.bookmarkPage("overview")
    canvas.addOutlineEntry(canvas.numerals(Sentence("chart.whole")), "overview", 0)
    canvas.setFont(STRONG, 16)
    canvas.write(_LEFT, _TOP, Sentence("chart.title", name=title_of(chart, canvas.printing)))
    canvas.setFont(TEXT, 9)
    canvas.setFillColorRGB(*_GREY)
    for line, text in enumerate(_facts(chart, plan)):
        canvas.write(_LEFT, _TOP - 19.0 - 13.0 * line, text)
    proportion = plan.cell_height / plan.cell_width
    scale = min(_WIDTH / chart.columns, _HEIGHT / chart.rows / proportion)
    width, height = scale * chart.columns, scale * chart.rows * proportion
    canvas.saveState()
    canvas.translate(_LEFT + (_WIDTH - width) / 2, _TOP - 66.0 - height)
    canvas.drawImage(ImageReader(_thumbnail(chart)), 0, 0, width, height)
    _sheet_grid(canvas, plan, scale, scale * proportion)
    canvas.restoreState()
    canvas.showPage()


def _facts(chart: Chart, plan: SheetLayout) -> tuple[str, ...]:
    across, along = (format_number(count / 10) for count in (chart.quality.across, chart.quality.along))
    sheets = Sentence(
        "chart.sheets" if plan.count > 1 else "chart.one-sheet",
        columns=chart.columns,
        rows=chart.rows,
        knots=thousands(chart.tally().knots),
        colours=colours_in_words(chart.colours),
        sheets=thousands(plan.count),
        across=plan.sheet_columns,
        up=plan.sheet_rows,
    )
    order = Sentence("chart.order")
    return (
        Sentence("chart.facts", size=size_of(chart.size), across=across, along=along, knot=noun(chart.knot)),
        sheets,
        Sentence("chart.two", first=order, second=Sentence("chart.shaded")) if plan.count > 1 else order,
    )


def _thumbnail(chart: Chart) -> Image.Image:
    """The chart as a picture of at most 1200 pixels per side."""
    colours = chart.colour_table[chart.knots]
    if chart.cells is not None:
        colours[chart.cells.are(OUTSIDE)] = 255
    picture = Image.fromarray(colours)
    return picture.reduce(max(1, -(-max(picture.size) // 1200)))


def _sheet_grid(canvas: PrintCanvas, plan: SheetLayout, wide: float, high: float) -> None:
    """Draw the borders of the sheets, white under black to be visible on any colour, and their numbers."""
    boxes = [
        (s.left * wide, s.low * high, (s.right - s.left) * wide, (s.high - s.low) * high, s.number)
        for s in plan.sheets()
    ]
    for grey, width in ((1.0, 1.6), (0.0, 0.5)):
        canvas.setStrokeGray(grey)
        canvas.setLineWidth(width)
        for x, y, across, up, _ in boxes:
            canvas.rect(x, y, across, up, stroke=1, fill=0)
    size = min(11.0, 0.42 * plan.sheet_columns * wide, 0.6 * plan.sheet_rows * high)
    canvas.setFont(STRONG, size)
    for x, y, across, up, number in boxes:
        middle, half = (x + across / 2, y + up / 2), canvas.stringWidth(str(number), STRONG, size) / 2 + 0.3 * size
        canvas.setFillColorRGB(1, 1, 1, alpha=0.88)
        canvas.roundRect(middle[0] - half, middle[1] - 0.7 * size, 2 * half, 1.4 * size, 0.3 * size, stroke=0, fill=1)
        canvas.setFillColorRGB(0.1, 0.1, 0.1, alpha=1)
        canvas.drawCentredString(middle[0], middle[1] - 0.36 * size, str(number))
        canvas.linkRect("", f"sheet-{number}", (x, y, x + across, y + up), relative=1, thickness=0)
