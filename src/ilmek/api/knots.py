"""Knots of paths, cyclograms, and the rows of a chart as they are called to a weaver."""

from __future__ import annotations  # so that `help` shows the aliases

from pathlib import Path
from types import MappingProxyType

from ilmek.api.carpets import Settings
from ilmek.arguments import LONGEST, Arguments, Point, Quantity
from ilmek.carpet.calling import CallStep, row_steps
from ilmek.carpet.chart import Chart
from ilmek.errors import CarpetError
from ilmek.jobs import cyclogram as cyclograms
from ilmek.jobs import knot as knots
from ilmek.jobs.call import DIRECTIONS
from ilmek.progress import SILENT, Progress
from ilmek.report import Report

ORDERS = ("runs", "colours")


def knot(
    *ends: object,
    pitch: Quantity = 0.002,
    warps: int = 12,
    first: Point = 0j,
    keep_out: Quantity = 0.0,
    smooth: bool = False,
    closed: bool = False,
) -> Report:
    """The knot that a yarn ties when its end is led along a path through a row of warps; the pile points up.

    ends      the points of the path [m], or of two paths that start at one point, each leads one end of the yarn
    pitch     distance of neighbouring warps [m]             warps   their number
    first     position of warp 1, the leftmost [m]           keep_out  radius around each that must stay free [m]
    smooth    the points are samples of a smooth motion      closed  the path returns to its first point

    The answer is proved: paths that can be deformed into each other without crossing a warp tie the same knot.
    Raises CarpetError for no path and more than two, and for a path that comes too close to a warp.

    >>> between, behind = 0.001 + 0.003j, 0.001 - 0.002j
    >>> turkish = [between, behind, -0.001 - 0.002j, -0.001 + 0.002j, 0.003 + 0.002j, 0.003 - 0.002j, behind, between]
    >>> knot(turkish)["knot"]
    'symmetric'
    """
    given = Arguments("a knot", CarpetError)
    if not 1 <= len(ends) <= 2:
        raise CarpetError(f"{len(ends)} paths", allowed="1, or 2: each leads one end of the yarn")
    request = knots.KnotRequest(
        given.whole("warps", warps, least=1, most=10_000),
        given.length("pitch", pitch),
        given.point("first", first),
        given.number("keep_out", keep_out, "m"),
        given.flag("smooth", smooth),
        given.flag("closed", closed),
    )
    path, tied = knots.judged([given.points("a path", end, most=LONGEST) for end in ends], request)
    return knots.report(path, tied, request)


def cyclogram(
    name: str | Path,
    /,
    *,
    settings: Settings = MappingProxyType({}),
    goal: str | None = None,
    progress: Progress = SILENT,
) -> Report:
    """The cyclogram of a file or of a machine of the catalogue, checked; with a goal its motions are retimed.

    name      a .toml or .json file, MACHINE or MACHINE:CYCLOGRAM      settings  of the machine, by name
    goal      "period" the least period, "acceleration" the least accelerations; default: as it is
    Raises ParameterError, as for constraints that contradict each other; Cancelled.

    >>> cyclogram("weaver").failed
    ()
    """
    given = Arguments("a cyclogram")
    on = given.record("progress", progress, Progress)
    found = cyclograms.find(str(given.path("name", name)), given.mapping("settings", settings, lambda _, value: value))
    if goal is None:
        return cyclograms.report(found)
    solved = cyclograms.solve(found, given.text("goal", goal), on)
    return cyclograms.report(solved.cyclogram, solved)


def call(chart: Chart, row: int, *, by: str = "runs", direction: str = "right") -> tuple[CallStep, ...]:
    """The steps of a row of a chart as they are called to a weaver.

    row  from 1 at the lower edge      by  "runs" of one yarn in their order, "colours" one after the other
    direction  of reading: right, left, alternate
    Raises CarpetError for a row that is not in the chart.

    >>> from ilmek import make_chart
    >>> chart = make_chart("examples/medallion.png", "30x40cm", "10x10/dm", colours=4)
    >>> sum(step.knots for step in call(chart, 1)) == chart.columns
    True
    """
    given = Arguments("a call", CarpetError)
    knotted = given.record("chart", chart, Chart)
    number = given.whole("row", row, least=1, most=knotted.rows)
    return row_steps(knotted, number, given.one_of("by", by, ORDERS), given.one_of("direction", direction, DIRECTIONS))
