"""Rows to weave by, expanded, are the chart bit for bit: every split and direction, with half and jufti knots."""

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from benchmarks.rows_reading import chart_of_codes, parse_rows
from effort import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, overlay_of
from ilmek.carpet.quality import Quality
from ilmek.carpet.rows import DIRECTIONS, row_codes, row_runs, spans_by_yarn
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.errors import CarpetError
from ilmek.io.chart.rows_text import LONGEST_LINE, header, row_bands


def text_of(chart: Chart, split: str, direction: str) -> str:
    body = b"".join(part for _, part in row_bands(chart, split, direction))
    return header(chart, split, direction) + body.decode("utf-8")


def random_chart(seed: int, grid: tuple[int, int], yarns: int, share: float, marks: int) -> Chart:
    """A chart of runs (`share` of the knots begin one) with about `marks` half knots and jufti knots."""
    rng, (rows, columns) = np.random.default_rng(seed), grid
    begins = rng.random((rows, columns)) < share
    begins[:, 0] = True
    at = np.maximum.accumulate(np.where(begins, np.arange(columns), 0), axis=1)
    knots = np.take_along_axis(rng.integers(0, yarns, (rows, columns)).astype(np.uint8), at, axis=1)
    threads = tuple(Yarn(f"yarn {n}", (n, 255 - n, n // 2), (0.0, 0.0, 0.0), 4.0) for n in range(yarns))
    quality = Quality(max(100.0, columns / 40), 100.0)
    chart = Chart(knots, threads, CarpetSize(columns / quality.across, rows / quality.along), quality, "symmetric")
    return replace(chart, overlay=overlay_of(random_marks(rng, knots, yarns, marks)))


def random_marks(rng: np.random.Generator, knots: np.ndarray, yarns: int, number: int) -> list[KnotMark]:
    found: dict[tuple[int, int], KnotMark] = {}
    taken: set[tuple[int, int]] = set()
    for row, column in zip(
        rng.integers(0, knots.shape[0], number), rng.integers(0, knots.shape[1], number), strict=True
    ):
        cell = (int(row), int(column))
        beside = (cell[0], cell[1] + 1)
        if cell in taken:
            continue
        if rng.random() < 0.5:
            second = (int(knots[cell]) + 1 + int(rng.integers(0, yarns - 1))) % yarns
            found[cell] = KnotMark(*cell, HALF, second)
            taken.add(cell)
        elif beside[1] < knots.shape[1] and beside not in taken and knots[cell] == knots[beside]:
            found[cell] = KnotMark(*cell, JUFTI)
            taken |= {cell, beside}
    return list(found.values())


charts = st.tuples(
    st.integers(0, 2**32 - 1),
    st.tuples(st.integers(2, 7), st.integers(2, 40)),
    st.sampled_from([2, 3, 40, 255]),
    st.sampled_from([0.05, 0.4, 1.0]),
    st.integers(0, 30),
)


@examples(60)
@given(charts, st.sampled_from(["runs", "colours"]), st.sampled_from(DIRECTIONS))
def test_the_rows_expand_to_the_chart(made: tuple[Any, ...], split: str, direction: str) -> None:
    chart = random_chart(*made)
    found = parse_rows(text_of(chart, split, direction))
    assert np.array_equal(found.knots, chart.knots)
    assert found.overlay.equals(chart.overlay)
    assert found.names == tuple(yarn.name for yarn in chart.yarns)
    assert (found.split, found.direction) == (split, direction)


@settings(max_examples=30, deadline=None)
@given(charts)
def test_codes_runs_and_spans_hold_every_knot(made: tuple[Any, ...]) -> None:
    chart = random_chart(*made)
    codes = row_codes(chart, 0, chart.rows)
    knots, overlay = chart_of_codes(codes)
    assert np.array_equal(knots, chart.knots)
    assert overlay.equals(chart.overlay)
    tied = np.zeros(len(chart.yarns), dtype=int)
    for row in range(chart.rows):
        runs = row_runs(chart, row + 1)
        assert sum(run.cells for run in runs) == chart.columns
        for yarn, spans in spans_by_yarn(runs).items():
            tied[yarn] += sum(span.knots for span in spans)
    assert tied.tolist() == [chart.tied.of(yarn) for yarn in range(len(chart.yarns))]


def test_long_rows_go_on_in_bounded_lines() -> None:
    chart = random_chart(3, (2, 9000), 5, 1.0, 100)
    for split in ("runs", "colours"):
        text = text_of(chart, split, "both")
        assert 1500 < max(len(line.encode()) for line in text.split("\n")) <= LONGEST_LINE + 32
        assert np.array_equal(parse_rows(text).knots, chart.knots)


def test_the_format_by_an_example() -> None:
    yarns = tuple(Yarn(name, (n, n, n), (0.0, 0.0, 0.0), 4.0) for n, name in enumerate(("red", "blue", "ivory")))
    knots = np.array([[0, 0, 0, 1, 1, 1, 0, 2], [1, 1, 1, 1, 1, 1, 1, 1]], dtype=np.uint8)
    overlay = overlay_of([KnotMark(0, 2, HALF, 2), KnotMark(0, 4, JUFTI)])
    chart = Chart(knots, yarns, CarpetSize(0.08, 0.02), Quality(100.0, 100.0), "symmetric", overlay=overlay)
    assert text_of(chart, "runs", "both").partition("\n\n")[2] == (
        "1 > 8B\n1 < 8B\n2 > 2A 1½AC 1B 1jB 1A 1C\n2 < 1C 1A 1jB 1B 1½CA 2A\n"
    )
    assert text_of(chart, "runs", "alternate").partition("\n\n")[2] == "1 > 8B\n2 < 1C 1A 1jB 1B 1½CA 2A\n"
    assert text_of(chart, "colours", "left").partition("\n\n")[2] == (
        "1 < B 8: 1-8\n2 < A 4: 2 6L 7-8\n2 < B 2: 3-4j 5\n2 < C 2: 1 6R\n"
    )
    head = text_of(chart, "runs", "both").partition("\n\n")[0]
    assert "yarn A #000000 4 red" in head
    assert "yarn B #010101 10 blue" in head


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("ilmek-rows 1", "ilmek-rows 2", "line 1"),
        ("rows 2", "rows 0", "rows '0'"),
        ("columns 3", "columns 999999999", "knots"),
        ("split runs", "split words", "split 'words'"),
        ("1 > 3A", "1 > 4A", "line 16: '4A'; 3 cells"),
        ("1 > 3A", "1 > 2A", "2 cells"),
        ("1 > 3A", "1 > 3C", "'3C'"),
        ("1 > 3A", "1 > 3½AB", "same knots in both"),
        ("1 > 3A", "3 > 3A", "rows 1 to 2"),
        ("1 > 3A\n", "", "row 1 is missing"),
        ("1 > 3A", "1 > 3A\n1 > 3A", "each once"),
        ("1 > 3A", "one > 3A", "line 16"),
        ("1 > 3A", "1 > A 3: 1-3", "runs, as the header states"),
    ],
)
def test_a_bad_text_is_refused_with_its_line(old: str, new: str, said: str) -> None:
    yarns = tuple(Yarn(name, (0, 0, 0), (0.0, 0.0, 0.0), 4.0) for name in "ab")
    knots = np.array([[0, 1, 1], [0, 0, 0]], dtype=np.uint8)
    chart = Chart(knots, yarns, CarpetSize(0.03, 0.02), Quality(100.0, 100.0), "symmetric")
    text = text_of(chart, "runs", "both")
    assert old in text
    with pytest.raises(CarpetError, match=re.escape(said)):
        parse_rows(text.replace(old, new, 1))
