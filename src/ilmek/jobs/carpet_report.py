"""The page of a carpet from its chart: what `weave` and `chart` show of it."""

from collections.abc import Sequence
from typing import Any

from ilmek.carpet.bill import YarnBill
from ilmek.carpet.chart import Chart
from ilmek.carpet.statistics import ChartStatistics
from ilmek.io.chart.symbols import symbols
from ilmek.jobs.carpet_files import file_notes
from ilmek.jobs.yarn_choice import proposed_shades
from ilmek.units import counted
from ilmek.viz.carpet_page import CarpetPage
from ilmek.viz.number_format import count, share
from ilmek.viz.page_parts import Fact


def page_of(
    title: str, chart: Chart, bill: YarnBill, files: Sequence[str], *, statistics: ChartStatistics, **more: Any
) -> CarpetPage:
    """The contents of the page.

    files  names of the files of the folder      more  further fields of `CarpetPage`
    """
    return CarpetPage(
        title=title,
        lead=f"{chart.size}, {chart.quality}, {chart.knot} knot",
        chart=chart,
        bill=bill,
        statistics=statistics,
        symbols=symbols(chart.yarns),
        reading=reading_lines(chart),
        proposed=proposed_shades(chart),
        files=file_notes(files),
        **more,
    )


def reading_lines(chart: Chart) -> tuple[Fact, ...]:
    """How a picture became a chart: reading, fit, changed and foreign knots, difference of the yarns."""
    made, knots = chart.reading, int(chart.knots.size)
    lines = [Fact("Read as", made.kind, made.reason), Fact("Fit", made.fit.words)]
    note = f"{share(made.changed, knots)} of all" if made.changed else ""
    lines.append(Fact("Changed knots", count(made.changed) if made.changed else "none", note))
    if made.edited:
        lines.append(Fact("Edited knots", count(made.edited), "by the recipe"))
    if len(chart.overlay):
        tied = chart.tied
        lines.append(Fact("Half knots", count(sum(tied.half)), "on one warp each"))
        lines.append(Fact("Jufti knots", count(sum(tied.jufti)), "on four warps each"))
    if made.foreign is not None:
        lines.append(Fact("Knots of a colour that is not in their cell", *_part(made.foreign, knots)))
    exact = sum(one.worst == 0 for one, cells in zip(made.differences, chart.counts, strict=False) if cells)
    if made.differences:
        matched = f"exactly a colour of the picture: {exact} of {counted(chart.colours, 'yarn')}"
        lines.append(Fact("Mean ΔE of the yarns to the picture", f"{made.mean_delta_e:.2f}", matched))
    if made.matches:
        worst = max(made.matches, key=lambda match: match.delta_e)
        far = (
            f"{worst.hex}, {worst.delta_e:.1f} from {chart.yarns[worst.yarn].name}" if worst.delta_e >= 0.05 else "none"
        )
        lines.append(Fact("Colour farthest from its yarn", far, f"of {counted(len(made.matches), 'colour')}"))
    return tuple(lines)


def _part(part: int, whole: int) -> tuple[str, str]:
    return (count(part), f"{share(part, whole)} of all") if part else ("none", "")
