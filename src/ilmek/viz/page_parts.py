"""The parts of a carpet's page: summary, pictures, yarn."""

import base64
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from PIL import Image

from ilmek.carpet.bill import YarnBill, YarnNeed
from ilmek.carpet.chart import Chart
from ilmek.carpet.colour import LINEAR
from ilmek.progress import SILENT, Progress
from ilmek.report import Check
from ilmek.report.left_out import made_or_left_out
from ilmek.units import format_number
from ilmek.viz.carpet_picture import carpet_picture, close_up
from ilmek.viz.number_format import count, fixed, share

_LARGEST = 1600
"""Largest number of pixels along the longer side of the chart's picture."""


_TALLEST = 960
"""Largest height of a picture on the page [px]."""


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
class PagePicture:
    """A picture of the page: data URL, proportions, caption; `times` is the enlargement on a click."""

    source: str
    width: int
    height: int
    caption: str
    alt: str
    note: str = ""
    pixelated: bool = False
    wide: bool = False
    times: float = 1.0

    @property
    def widest(self) -> int:
        """Largest width on the page [px], so that a runner is not taller than a screen."""
        return max(1, round(_TALLEST * self.width / self.height))


@dataclass(frozen=True, slots=True)
class YarnLine:
    """A line of the yarn table; colour and letter colour are CSS, empty for the ground's yarns."""

    need: YarnNeed
    symbol: str
    colour: str
    letter: str
    share: str


def carpet_facts(chart: Chart, bill: YarnBill, more: Sequence[Fact], checks: Sequence[Check]) -> list[Fact]:
    """The summary: size, knots, colours, yarn, further facts, and the numbers of passed and failed checks."""
    passed = sum(check.ok for check in checks)
    failed = len(checks) - passed
    size, quality = chart.size, chart.quality
    facts = [
        Fact("Size", f"{_cm(size.width)} × {_cm(size.length)} cm", size.name),
        Fact("Knots", count(int(chart.knots.size)), f"{count(chart.columns)} across × {count(chart.rows)} rows"),
        Fact(
            "Quality",
            f"{format_number(quality.across / 10)} × {format_number(quality.along / 10)} / dm",
            f"{chart.knot} knot",
        ),
        Fact("Colours", str(chart.colours), f"mean ΔE {chart.reading.mean_delta_e:.1f} to the picture"),
        Fact("Yarn", f"{fixed(bill.mass, 1, 2)} kg", _pile(bill.pile_mass, size.area)),
        *more,
    ]
    if checks:
        mood, note = ("bad", f"{passed} of {len(checks)} passed") if failed else ("good", "none failed")
        facts.append(Fact("Checks", f"{failed} failed" if failed else f"{passed} passed", note, mood))
    return facts


def _pile(mass: float, area: float) -> str:
    return f"pile {fixed(mass, 1, 2)} kg, {fixed(mass / area, 1, 2)} kg/m²"


def _cm(length: float) -> str:
    return format_number(100 * length)


def pictures(chart: Chart, left_out: list[str], progress: Progress = SILENT) -> list[PagePicture]:
    """The chart, the simulated carpet, and a close-up of its knots; without those that cannot be drawn."""
    makers: dict[str, Callable[[Chart], PagePicture]] = {
        "of the chart": _of_the_chart,
        "of the carpet": partial(_of_the_carpet, progress=progress),
        "of the knots": _of_the_knots,
    }
    made = [made_or_left_out(f"the picture {name}", partial(make, chart), left_out) for name, make in makers.items()]
    progress(1.0)
    return [picture for picture in made if picture is not None]


def _of_the_chart(chart: Chart) -> PagePicture:
    width, height = round(1000 * chart.size.width), round(1000 * chart.size.length)
    return PagePicture(
        _address(_chart_png(chart), "png"), width, height, "Knot chart.", f"Knot chart, {_knots(chart)}",
        "One cell is one knot; click to enlarge.", pixelated=True, times=max(1.0, 3 * chart.columns / width),
    )  # fmt: skip


def _of_the_carpet(chart: Chart, progress: Progress) -> PagePicture:
    whole = carpet_picture(chart, progress=progress)
    return PagePicture(
        _address(whole, "jpeg"), *_size(whole), "The finished carpet.", f"Simulated carpet, {_knots(chart)}",
        "Simulated pile, fringe and selvedge.", times=1.25,
    )  # fmt: skip


def _of_the_knots(chart: Chart) -> PagePicture:
    near = close_up(chart)
    return PagePicture(
        _address(near, "jpeg"), *_size(near), "The knots at its centre.", "Simulated close-up of single tufts",
        "Simulated; each tuft is one knot.", wide=True, times=1.25,
    )  # fmt: skip


def _knots(chart: Chart) -> str:
    return f"{chart.columns} by {chart.rows} knots in {chart.colours} colours"


def _chart_png(chart: Chart) -> bytes:
    """The chart as an indexed PNG; of a very large one, every n-th knot."""
    step = -(-max(chart.rows, chart.columns) // _LARGEST)
    knots = np.ascontiguousarray(chart.knots[::step, ::step])
    picture = Image.frombytes("P", (knots.shape[1], knots.shape[0]), knots.tobytes())
    picture.putpalette([channel for yarn in chart.yarns for channel in yarn.srgb])
    stream = io.BytesIO()
    picture.save(stream, format="PNG")
    return stream.getvalue()


def _size(picture: bytes) -> tuple[int, int]:
    with Image.open(io.BytesIO(picture)) as opened:
        return opened.size


def _address(picture: bytes, kind: str) -> str:
    return f"data:image/{kind};base64,{base64.b64encode(picture).decode('ascii')}"


def yarn_lines(chart: Chart, bill: YarnBill, symbols: str) -> list[YarnLine]:
    """The lines of the bill with the yarns' colours and symbols, which are black or white as in the printed chart."""
    indices = {yarn.name: index for index, yarn in enumerate(chart.yarns)}
    lines = []
    for need in bill.pile:
        index = indices[need.name]
        srgb = chart.yarns[index].srgb
        light = float(LINEAR[list(srgb)] @ np.array([0.2126, 0.7152, 0.0722]))
        letter = "#ffffff" if light < 0.179 else "#000000"
        symbol = symbols[index] if index < len(symbols) else ""
        colour, of_all = "#{:02x}{:02x}{:02x}".format(*srgb), share(need.knots, int(chart.knots.size))
        lines.append(YarnLine(need, symbol, colour, letter, of_all))
    return lines + [YarnLine(need, "", "", "", "") for need in bill.ground]
