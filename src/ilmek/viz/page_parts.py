"""The parts of a carpet's page in words and numbers: summary, yarn, files."""

from collections.abc import Sequence
from dataclasses import dataclass

from ilmek.carpet.bill import YarnBill, YarnNeed
from ilmek.carpet.chart import Chart
from ilmek.carpet.differences import YarnDifference
from ilmek.carpet.picture_points import hex_colour
from ilmek.report import Check
from ilmek.units import format_number
from ilmek.viz.number_format import count, fixed, share
from ilmek.viz.page_pictures import letter


@dataclass(frozen=True, slots=True)
class Fact:
    """An entry of the summary; mood is "", "good" or "bad"."""

    label: str
    value: str
    note: str = ""
    mood: str = ""


@dataclass(frozen=True, slots=True)
class FileNote:
    """A file of the output folder and its contents."""

    name: str
    meaning: str


@dataclass(frozen=True, slots=True)
class YarnLine:
    """A line of the yarn table; colour and letter colour are CSS, empty for the ground's yarns."""

    need: YarnNeed
    symbol: str = ""
    colour: str = ""
    letter: str = ""
    share: str = ""
    difference: YarnDifference | None = None


def carpet_facts(chart: Chart, bill: YarnBill, more: Sequence[Fact], checks: Sequence[Check]) -> list[Fact]:
    """The summary: size, knots, colours, yarn, mass, further facts, and the numbers of passed and failed checks."""
    passed = sum(check.ok for check in checks)
    failed = len(checks) - passed
    size, quality = (
        chart.size,
        f"{format_number(chart.quality.across / 10)} × {format_number(chart.quality.along / 10)}",
    )
    to_buy = sum(need.to_buy for need in bill.needs)
    facts = [
        Fact("Size", f"{_cm(size.width)} × {_cm(size.length)} cm", f"{quality} / dm, {chart.knot} knot"),
        Fact("Knots", count(bill.knots), _grid(chart)),
        Fact("Colours", str(chart.colours), f"mean ΔE {chart.reading.mean_delta_e:.1f} to the picture"),
        Fact("Yarn to buy", f"{fixed(to_buy, 1, 2)} kg", _price(bill)),
        Fact("Mass of the carpet", f"{fixed(bill.mass_per_area, 1, 2)} kg/m²", _published(bill)),
        *more,
    ]
    if checks:
        mood, note = ("bad", f"{passed} of {len(checks)} passed") if failed else ("good", "none failed")
        facts.append(Fact("Checks", f"{failed} failed" if failed else f"{passed} passed", note, mood))
    return facts


def _grid(chart: Chart) -> str:
    grid = f"{count(chart.columns)} across × {count(chart.rows)} rows"
    if chart.cells is not None:
        bare = chart.cells.index.size - chart.tally().knots
        grid = f"{grid} of cells, {count(bare)} without a knot" if bare else grid
    return f"{grid} of cells, with half and jufti knots" if len(chart.overlay) else grid


def _price(bill: YarnBill) -> str:
    return "no price given" if bill.price is None else f"{fixed(bill.price, 1, 2)} {bill.currency}"


def _published(bill: YarnBill) -> str:
    if bill.band is None:
        return "none is published for this density"
    least, most = format_number(bill.band.least, 3), format_number(bill.band.most, 3)
    return f"published: {least} to {most} kg/m²"


def _cm(length: float) -> str:
    return format_number(100 * length)


def yarn_lines(chart: Chart, bill: YarnBill, symbols: str) -> list[YarnLine]:
    """The lines of the bill with the yarns' colours and symbols, which are black or white as in the printed chart."""
    indices = {yarn.name: index for index, yarn in enumerate(chart.yarns)}
    differences = chart.reading.differences
    lines = []
    for need in bill.pile:
        index = indices[need.name]
        srgb = chart.yarns[index].srgb
        symbol = symbols[index] if index < len(symbols) else ""
        colour, of_all = hex_colour(srgb), share(need.knots, bill.knots)
        difference = differences[index] if index < len(differences) else None
        lines.append(YarnLine(need, symbol, colour, letter(srgb), of_all, difference))
    return lines + [YarnLine(need) for need in bill.ground]
