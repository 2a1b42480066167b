"""Figures of reports as plain data: nothing lost that a screen could show, and small."""

from itertools import repeat

import msgspec
import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.jobs.design import design_machine
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.machine.figures import TablesRequest, tables
from ilmek.records import JsonObject, json_value
from ilmek.report import Animation, Gantt, Plot, StackedBars, Timing
from ilmek.report.figure import Axis, GanttLane, Lane, Series
from ilmek.viz.plain import ShownFigure, rounded, shown_figures
from ilmek.web.schema import messages


@pytest.fixture(scope="module")
def figures() -> list[ShownFigure]:
    return shown_figures(design_machine("beat-up", {}).report.figures)


def test_figures_are_json_as_their_schema_states(figures: list[ShownFigure]) -> None:
    records = messages()["definitions"]
    for figure in msgspec.json.decode(msgspec.json.encode(figures, enc_hook=json_value)):
        check(figure, records["ShownFigure"], records)


def check(value: object, schema: JsonObject, records: JsonObject) -> None:
    """Hold a value against its schema: names and types of all that is in it."""
    if "anyOf" in schema:
        (schema,) = (one for one in schema["anyOf"] if (one.get("type") == "null") == (value is None))
    if "$ref" in schema:
        schema = records[schema["$ref"].rpartition("/")[2]]
    types = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    assert any(isinstance(value, TYPES[one] or type(None)) for one in types), (value, schema)
    if isinstance(value, dict):
        assert list(value) == schema["required"]
        for name, one in value.items():
            check(one, schema["properties"][name], records)
    elif isinstance(value, list):
        items = schema["items"]
        for one, own in zip(value, items if isinstance(items, list) else repeat(items, len(value)), strict=True):
            check(one, own, records)


TYPES = {
    "object": dict,
    "array": list,
    "string": str,
    "number": int | float,
    "integer": int,
    "boolean": bool,
    "null": type(None),
}


def test_tables_of_a_machine_and_of_a_machine_in_it() -> None:
    made = tables(TablesRequest("beat-up"), Context()).tables
    assert [one.name for one in made] == [one.name for one in design_machine("beat-up", {}).report.tables]
    with pytest.raises(ParameterError, match="no part 'reed'"):
        tables(TablesRequest("beat-up", part="reed"), Context())


def test_numbers_have_six_digits() -> None:
    values = np.array([np.pi * 10.0**power for power in range(-12, 13)])
    six = rounded(values)
    assert np.max(np.abs(six / values - 1)) <= 5e-6
    assert max(len(f"{value!r}") for value in six.tolist()) <= 16


def test_a_moving_machine_is_that_of_the_report() -> None:
    report = design_machine("beat-up", {}).report
    (given,) = (one for one in report.figures if isinstance(one, Animation))
    made = next(one.animation for one in shown_figures(report.figures) if one.animation is not None)
    tracks = made.tracks
    size = max(np.ptp(stroke.points.real) for stroke in given.strokes)
    for stroke, shape in zip(given.strokes, made.shapes, strict=True):
        if len(shape.shape):
            along = tracks[shape.tracks[1]] - tracks[shape.tracks[0]]
            points = tracks[shape.tracks[0]][:, np.newaxis] + shape.shape * (along / abs(along))[:, np.newaxis]
        else:
            points = np.stack([tracks[number] for number in shape.tracks], axis=1)
        assert np.max(np.abs(points - stroke.points)) < 1e-4 * size


def test_a_body_has_one_look_in_all_figures(figures: list[ShownFigure]) -> None:
    looks: dict[str, set[int]] = {}
    for figure in figures:
        strokes = figure.drawing.strokes if figure.drawing else []
        shapes = figure.animation.shapes if figure.animation else []
        for one in (*strokes, *shapes):
            if one.role == "link":
                looks.setdefault(one.label.split()[0], set()).add(one.look)
    assert looks
    assert all(len(found) == 1 for found in looks.values())


def test_every_kind_of_figure() -> None:
    time = Axis("time", "s")
    axis = np.linspace(0, 1, 5000)
    made = shown_figures(
        (
            Plot("p", "Plot", time, Axis("y", "mm"), (Series("a", axis, np.sin(40 * axis)),)),
            Timing("t", "Cyclogram", 2.0, (Lane("shed", "cam", 2 * np.pi * axis, axis),)),
            Gantt("g", "Heads", time, (GanttLane("1", axis[:2], axis[1:3], np.array([0, 1])),), ("ties", "waits")),
            StackedBars("b", "Times", time, ("row",), ("a", "b"), (np.array([1.0, np.nan]),)),
        )
    )
    assert [one.name for each in made for one in (each.plot, each.timing, each.gantt, each.bars) if one] == [*"ptgb"]
    assert made[0].plot is not None
    assert len(made[0].plot.series[0].x) <= 720
    assert made[3].bars is not None
    assert msgspec.json.encode(made[3].bars.values, enc_hook=json_value) == b"[[1.0,null]]"
