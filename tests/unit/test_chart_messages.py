"""What a chart's summary and warnings say: numbers with their nouns, and nothing of a swatch's mass."""

from dataclasses import replace

import numpy as np
import pytest

from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart
from ilmek.carpet.design import knot_grid
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, overlay_of
from ilmek.carpet.quality import parse_quality
from ilmek.carpet.sizes import parse_size
from ilmek.carpet.yarn import Yarn
from ilmek.cli.carpet_summary import changes_in_words, overlay_in_words
from ilmek.jobs.yarn_warnings import mass_warning

RED, BLUE = (Yarn(name, (k, 0, 255 - k), (40.0, 0.0, 0.0), 1.3, 2) for k, name in enumerate(("red", "blue")))


def plain(size: str, count: float = 1.3) -> Chart:
    """A chart of one yarn at 25 knots per dm, where masses from 4.23 to 4.80 kg/m2 are published."""
    grid = knot_grid(parse_size(size), parse_quality("25x25/dm"))
    yarns = tuple(replace(yarn, metric_count=count) for yarn in (RED, BLUE))
    return Chart(np.zeros(grid, int), yarns, size, "25x25/dm", "symmetric")


@pytest.mark.parametrize(
    ("size", "count", "warned"),
    [
        ("3x3cm", 1.3, False),
        ("16x16cm", 1.3, False),
        ("16x16cm", 0.4, False),
        ("32x32cm", 1.26, False),
        ("25x40cm", 0.4, True),
        ("120x180cm", 0.4, True),
        ("120x180cm", 1.3, False),
        ("120x180cm", 9.0, True),
    ],
)
def test_the_mass_of_a_carpet_is_compared_and_that_of_a_swatch_is_not(size: str, count: float, warned: bool) -> None:
    chart = plain(size, count)
    assert ("the carpet weighs" in mass_warning(yarn_bill(chart), chart.quality)) == warned


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        (0, "no knot changed"),
        (1, "1 knot changed"),
        (2, "2 knots changed"),
        (2100, "2,100 knots changed"),
    ],
)
def test_one_knot_is_a_knot(changed: int, words: str) -> None:
    chart = plain("16x16cm")
    text = changes_in_words(replace(chart, reading=replace(chart.reading, changed=changed)))
    assert text.startswith(f"{words}, ")


def test_one_half_knot_and_one_jufti_knot() -> None:
    chart = replace(plain("16x16cm"), overlay=overlay_of([KnotMark(0, 0, HALF, 1), KnotMark(1, 1, JUFTI)]))
    assert overlay_in_words(chart) == "2 half knots, 1 jufti knot; 1,600 knots to tie"
