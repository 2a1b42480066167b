"""Gantt charts and stacked bars as SVG."""

import re

import numpy as np

from ilmek.report import Axis, Gantt, GanttLane, StackedBars
from ilmek.viz.svg import svg


def lane(name: str, *spans: tuple[float, float, int]) -> GanttLane:
    starts, ends, kinds = (np.array(column) for column in zip(*spans, strict=True))
    return GanttLane(name, starts.astype(float), ends.astype(float), kinds.astype(np.int64))


def filled(drawn: str) -> list[str]:
    """Colours of the areas, in order."""
    return re.findall(r'Z" fill="(#[0-9a-f]{6})"', drawn)


def test_neighbouring_spans_of_a_kind_are_one_and_short_ones_lie_on_top() -> None:
    chart = Gantt("g", "Heads", Axis("time", "h"), (lane("head 1", (0, 1e6, 0), (10, 11, 1), (1e6, 2e6, 0)),),
                  ("weaves", "waits", "never"), pale=1)  # fmt: skip
    drawn = svg(chart)
    assert "head 1" in drawn
    assert "never" not in drawn
    paper, weaves, waits, *keys = filled(drawn)
    assert paper == "#ffffff"
    assert sorted(keys) == sorted((weaves, waits))  # the legend; two spans are left of three
    assert weaves != waits


def test_a_repeated_short_span_lies_on_the_long_one_each_time() -> None:
    chart = Gantt("g", "Heads", Axis("time", "h"), (lane("head 1", (0, 100, 0), (10, 12, 1), (50, 52, 1)),),
                  ("weaves", "stop"))  # fmt: skip
    *_, weaves, first, second = filled(svg(chart))
    assert first == second != weaves


def test_every_part_of_a_bar_has_a_colour_of_its_own() -> None:
    names = tuple(f"use {number}" for number in range(8))
    bars = StackedBars(
        "b", "Uses", Axis("time", "s"), ("a", "b"), names, (np.ones(8), np.ones(8)), looks=(*range(3, 10), 3)
    )
    shades = filled(svg(bars))
    assert len(set(shades) - {"#ffffff"}) == 8


def test_charts_without_anything_are_drawn() -> None:
    empty = GanttLane("head 1", np.empty(0), np.empty(0), np.empty(0, np.int64))
    assert "<svg" in svg(Gantt("g", "Heads", Axis("time", "h"), (empty,), ("weaves",)))
    assert "<svg" in svg(StackedBars("b", "Uses", Axis("time", "s"), ("a",), ("x",), (np.zeros(1),)))
