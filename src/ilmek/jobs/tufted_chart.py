"""The chart of a carpet that is not knotted: its resolution is that of machine or cloth; the result and its JSON."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ilmek.carpet.cells import CUT_AWAY, PILE, PLAIN
from ilmek.carpet.picture_points import hex_colour
from ilmek.carpet.quality import Quality
from ilmek.carpet.yarn_plan import parse_count
from ilmek.errors import CarpetError
from ilmek.io.chart.formats import format_of
from ilmek.jobs.chart import ChartResult, job_json, make_charted
from ilmek.jobs.order import CarpetOrder
from ilmek.params import Setting
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject
from ilmek.report import Check, Json, Result
from ilmek.weaving.tufts import Cone


@dataclass(frozen=True, slots=True)
class UnknottedResult:
    """What the carpets by gun, by tufting machine and as kilim have alike: their chart, folder and files."""

    charted: ChartResult
    folder: Path
    written: tuple[str, ...] = field(default=(), kw_only=True)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was changed of the picture."""
        return self.charted.notes

    @property
    def files(self) -> list[str]:
        """The paths of the files."""
        return [str(self.folder / name) for name in self.written]

    def as_json(
        self,
        technique: str,
        params: JsonObject,
        deadline: float | None,
        *,
        found: Mapping[str, Json],
        results: Sequence[Result],
        checks: Sequence[Check],
    ) -> JsonObject:
        """The JSON of the job, without the kind of knot. found: before the results."""
        order = {name: value for name, value in self.charted.order.as_dict().items() if name != "knot"}
        return job_json(
            "weave",
            {**order, technique: params, "deadline": deadline},
            {"technique": technique, **found, **{one.name: one.value for one in results}},
            checks=checks,
            notes=list(self.notes),
            files=self.files,
        )


def yarn_setting(order: CarpetOrder) -> dict[str, Setting]:
    """The setting of the yarn by the count of an order; none where that is left open."""
    if order.plan.yarn_count is None:
        return {}
    count, ply = parse_count(order.plan.yarn_count)
    return {"yarn_density": f"{ply / count} g/m"}


def charted_for(
    order: CarpetOrder,
    quality: Quality,
    progress: Progress = SILENT,
    *,
    noun: str,
    outline: bool = False,
    piles: bool = False,
) -> ChartResult:
    """The chart of an order at the resolution of a machine or a cloth; a picture that is a chart keeps its size.

    outline  whether a shape can be made      piles  and piles of several heights
    Raises CarpetError for cells and carved lines that cannot.
    """
    if order.size is None and order.fit.width is None and order.fit.length is None and format_of(order.picture):
        order = replace(order, size=make_charted(order, progress.part(0.0, 0.3)).chart.size)
    order = replace(order, quality=quality, pdf=False, files=replace(order.files, rows="none"))
    charted = make_charted(order, progress.part(0.3, 1.0))
    cells = charted.chart.cells
    if cells is not None and not (
        outline
        and cells.carving is None
        and (not cells.number(PLAIN) if piles else set(cells.kinds) <= {PILE, CUT_AWAY})
    ):
        with_lines = () if cells.carving is None else ("carved lines",)
        given = f"{noun} of a carpet with {' and '.join((*map(str, cells.kinds), *with_lines))}"
        shape = "an outline" if outline else "a rectangle"
        allowed = f"{shape}, and heights of pile" if piles else f"{shape} of one height"
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
