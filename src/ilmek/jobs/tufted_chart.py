"""The chart of a carpet that is tufted: its resolution is that of the machine, its yarns stand on cones."""

from dataclasses import replace

from ilmek.carpet.cells import PLAIN
from ilmek.carpet.picture_points import hex_colour
from ilmek.carpet.quality import Quality
from ilmek.carpet.yarn_plan import parse_count
from ilmek.errors import CarpetError
from ilmek.io.chart.formats import format_of
from ilmek.jobs.chart import ChartResult, make_charted
from ilmek.jobs.order import CarpetOrder
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.weaving.tufts import Cone


def yarn_setting(order: CarpetOrder) -> dict[str, Setting]:
    """The setting of the yarn by the count of an order; none where that is left open."""
    if order.plan.yarn_count is None:
        return {}
    count, ply = parse_count(order.plan.yarn_count)
    return {"yarn_density": f"{ply / count} g/m"}


def charted_for(
    order: CarpetOrder, quality: Quality, progress: Progress = SILENT, *, noun: str, piles: bool = False
) -> ChartResult:
    """The chart of an order at the resolution of a machine or a cloth; a picture that is a chart keeps its size.

    piles  whether a shape that is cut afterwards, and piles of several heights, can be made
    Raises CarpetError for cells and carved lines that cannot.
    """
    if order.size is None and order.fit.width is None and order.fit.length is None and format_of(order.picture):
        order = replace(order, size=make_charted(order, progress.part(0.0, 0.3)).chart.size)
    order = replace(order, quality=quality, pdf=False, files=replace(order.files, rows="none"))
    charted = make_charted(order, progress.part(0.3, 1.0))
    cells = charted.chart.cells
    if cells is not None and not (piles and not cells.number(PLAIN) and cells.carving is None):
        with_lines = () if cells.carving is None else ("carved lines",)
        given = f"{noun} of a carpet with {' and '.join((*map(str, cells.kinds), *with_lines))}"
        allowed = "an outline that is cut, and heights of pile" if piles else "a rectangle of one pile"
        do = "leave the options of its shape and pile out, and cut the carpet afterwards, or knot it"
        raise CarpetError(given, allowed=allowed, do=do)
    return charted


def cones_of(charted: ChartResult) -> tuple[Cone, ...]:
    """The cone of each yarn of a chart, by its index."""
    wool = charted.order.order.plan.price("pile", "wool")
    return tuple(
        Cone(yarn.name, hex_colour(yarn.srgb), wool if yarn.price is None else yarn.price)
        for yarn in charted.chart.yarns
    )
