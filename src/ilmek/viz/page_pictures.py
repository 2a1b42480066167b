"""The pictures of a carpet's page, and the data by which the page shows row, knot and yarn under the pointer.

The chart's picture is thinned to every n-th row and knot where the chart is large. Each of its pixels is the knot of
that row and column, so what the page shows of a pixel is exact. Yarns of one colour are distinguished by their codes in
the picture, which differ by a step that nobody sees.
"""

import base64
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image

from ilmek.arrays import Rgb
from ilmek.carpet.chart import Chart
from ilmek.carpet.colour import takes_white
from ilmek.carpet.fitting import Fit
from ilmek.carpet.overlay import HALF, JUFTI
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, record
from ilmek.report.left_out import made_or_left_out
from ilmek.units import counted
from ilmek.viz.carpet_picture import WHOLE, DrawnCarpet, Pile, close_up, draw_carpet

LARGEST = 1600
"""Largest number of pixels along the longer side of the chart's picture."""

MOST_POINTED = 50_000
"""Largest number of half knots and jufti knots that the page shows under the pointer: 1 MB."""

_TALLEST = 940
"""Largest height of the compared pictures on the page [px]."""

_SHARP = 700
"""Largest width of a chart whose knots are drawn with sharp edges: each is at least a pixel of the page."""


@dataclass(frozen=True, slots=True)
class PagePicture:
    """A picture of the page: data URL, proportions, description."""

    source: str
    width: int
    height: int
    alt: str
    sharp: bool = False


@record
class CarpetPictures:
    """The pictures of a carpet; None for one that cannot be drawn, or is not there.

    pile  where the picture of the carpet shows the pile
    data  of the chart's picture: rows, columns, step, half knots and jufti knots, and of each yarn code, name, symbol,
          colour of letters
    """

    source: PagePicture | None
    chart: PagePicture | None
    carpet: PagePicture | None
    knots: PagePicture | None
    pile: Pile
    data: JsonObject

    @property
    def widest(self) -> int:
        """Largest width of the compared pictures [px], so that a runner is not taller than a screen."""
        shown = self.carpet or self.chart or self.source
        return 1 if shown is None else max(1, round(_TALLEST * shown.width / shown.height))


def pictures(
    chart: Chart,
    source: Rgb | None,
    symbols: str,
    left_out: list[str],
    *,
    drawn: DrawnCarpet | None = None,
    progress: Progress = SILENT,
) -> CarpetPictures:
    """The pictures of a page; a warning is added to `left_out` for each that cannot be drawn.

    drawn  the carpet, as it was drawn for another file
    """
    step, codes = thinning(chart), yarn_codes(chart)

    def made(what: str, make: Callable[[], PagePicture]) -> PagePicture | None:
        return made_or_left_out(f"the picture of {what}", make, left_out)

    data = {
        "rows": chart.rows,
        "columns": chart.columns,
        "step": step,
        "codes": [red << 16 | green << 8 | blue for red, green, blue in codes],
        "names": [yarn.name for yarn in chart.shades],
        "symbols": list(symbols.ljust(len(chart.shades))),
        "letters": [letter(yarn.srgb) for yarn in chart.shades],
        "marks": _marks(chart),
    }
    what = "the picture of the carpet"
    carpet = drawn or made_or_left_out(what, lambda: draw_carpet(chart, progress=progress), left_out)
    return CarpetPictures(
        None if source is None else made("the source", lambda: _of_the_source(source, chart)),
        made("the chart", lambda: _of_the_chart(chart, step, codes)),
        None if carpet is None else _of_the_carpet(chart, carpet),
        made("the knots", lambda: _of_the_knots(chart)),
        WHOLE if carpet is None else carpet.pile,
        data,
    )


def _marks(chart: Chart) -> dict[str, int]:
    """The yarn of the right half knot of each cell "row,column" that has one, -1 and -2 in the left and the right
    cell of a jufti knot. Empty where there are more than MOST_POINTED: the page would be slow to open.
    """
    if len(chart.overlay) > MOST_POINTED:
        return {}
    marks = {}
    for mark in chart.overlay:
        marks[f"{mark.row},{mark.column}"] = mark.second if mark.kind == HALF else -1
        if mark.kind == JUFTI:
            marks[f"{mark.row},{mark.column + 1}"] = -2
    return marks


def thinning(chart: Chart) -> int:
    """Every which row and knot the page's picture of the chart shows; 1: all."""
    return -(-max(chart.rows, chart.columns) // LARGEST)


def yarn_codes(chart: Chart) -> list[tuple[int, int, int]]:
    """The sRGB code of each yarn in the page's picture of the chart: its own, or the nearest that no other one has."""
    taken: set[tuple[int, int, int]] = {yarn.srgb for yarn in chart.shades}
    seen: set[tuple[int, int, int]] = set()
    codes = []
    for yarn in chart.shades:
        code = yarn.srgb
        if code in seen:
            code = next(near for near in _near(code) if near not in taken)
        seen.add(code)
        taken.add(code)
        codes.append(code)
    return codes


def _near(code: tuple[int, int, int]) -> Sequence[tuple[int, int, int]]:
    """The codes about a code, the nearest first; more of them than yarns."""
    red, green, blue = code
    reach = range(-8, 9)
    near = [(red + r, green + g, blue + b) for r in reach for g in reach for b in reach]
    inside = [one for one in near if all(0 <= channel <= 255 for channel in one)]
    return sorted(inside, key=lambda one: sum((a - b) ** 2 for a, b in zip(one, code, strict=True)))


def letter(srgb: tuple[int, int, int]) -> str:
    """The colour of a symbol on a yarn's colour: black or white, as in the printed chart."""
    return "#ffffff" if takes_white(srgb) else "#000000"


def _of_the_source(source: Rgb, chart: Chart) -> PagePicture:
    stream, alt = io.BytesIO(), "The picture, as it is fitted to the carpet"
    if source.shape[:2] == chart.knots.shape and chart.columns <= _SHARP:
        Image.fromarray(source).save(stream, format="PNG")
        return PagePicture(address(stream.getvalue(), "png"), *_proportions(chart), alt, sharp=True)
    Image.fromarray(source).save(stream, format="JPEG", quality=88)
    return PagePicture(address(stream.getvalue(), "jpeg"), *_proportions(chart), alt)


@record
class CutPicture:
    """A picture with the frame of what the carpet shows of it.

    path    of the part that is not shown, in pixels of the picture      cut  its share of the picture [-]
    """

    picture: PagePicture
    path: str
    cut: float


def cut_picture(whole: Rgb, fit: Fit, left_out: list[str]) -> CutPicture | None:
    """A picture that is cropped to the carpet's proportions, with what is cut shaded; None where it is not cropped."""
    if fit.kind != "crop":
        return None
    height, width = int(whole.shape[0]), int(whole.shape[1])
    left, top, right, bottom = (round(one * side, 1) for one, side in zip(fit.shown, 2 * (width, height), strict=True))

    def made() -> PagePicture:
        stream = io.BytesIO()
        Image.fromarray(whole).save(stream, format="JPEG", quality=85)
        return PagePicture(address(stream.getvalue(), "jpeg"), width, height, "The picture before it is cropped")

    picture = made_or_left_out("the picture of what is cut", made, left_out)
    if picture is None:
        return None
    path = f"M0 0H{width}V{height}H0ZM{left} {top}V{bottom}H{right}V{top}Z"
    return CutPicture(picture, path, 1 - (right - left) * (bottom - top) / (width * height))


def _of_the_chart(chart: Chart, step: int, codes: Sequence[tuple[int, int, int]]) -> PagePicture:
    knots = np.ascontiguousarray(chart.shaded[::step, ::step])
    picture = Image.frombytes("P", (knots.shape[1], knots.shape[0]), knots.tobytes())
    picture.putpalette([channel for code in codes for channel in code])
    stream = io.BytesIO()
    picture.save(stream, format="PNG")
    sharp = knots.shape[1] <= _SHARP
    return PagePicture(
        address(stream.getvalue(), "png"), *_proportions(chart), f"Knot chart, {_knots(chart)}", sharp=sharp
    )


def _of_the_carpet(chart: Chart, drawn: DrawnCarpet) -> PagePicture:
    return PagePicture(address(drawn.jpeg, "jpeg"), *drawn.image.size, f"Simulated carpet, {_knots(chart)}")


def _of_the_knots(chart: Chart) -> PagePicture:
    near = close_up(chart)
    return PagePicture(address(near, "jpeg"), *_size(near), "Simulated close-up of single tufts")


def _proportions(chart: Chart) -> tuple[int, int]:
    return max(1, round(1000 * chart.size.width)), max(1, round(1000 * chart.size.length))


def _knots(chart: Chart) -> str:
    return f"{chart.columns} by {chart.rows} knots in {counted(chart.colours, 'colour')}"


def _size(picture: bytes) -> tuple[int, int]:
    with Image.open(io.BytesIO(picture)) as opened:
        return opened.size


def address(picture: bytes, kind: str) -> str:
    """The picture as the address of an image in a page that stands alone."""
    return f"data:image/{kind};base64,{base64.b64encode(picture).decode('ascii')}"
