"""The yarn to buy is enough and no hank too many; dye lots change in the rows that are named; finer carpets take finer
yarn and a lower pile."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ilmek.arrays import Indices
from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.usual_pile import USUAL_FILL, usual_count, usual_pile_height, with_counts
from ilmek.carpet.yarn import Yarn
from ilmek.carpet.yarn_plan import YarnPlanParams, parse_count, parse_hank, write_count
from ilmek.units import mm

KNOTS = arrays(np.uint8, st.tuples(st.integers(15, 60), st.integers(15, 20)), elements=st.integers(0, 2))
DENSITY = st.floats(100.0, 1500.0)
KIND = st.sampled_from(sorted(USUAL_FILL))
HANKS = st.one_of(st.floats(1.0, 5000.0).map("{:.3f} g".format), st.floats(0.1, 9000.0).map("{:.3f}m".format))


def carpet(knots: Indices, density: float, kind: str = "symmetric") -> Chart:
    """A chart of three wools, as large as its knots at the density."""
    quality = Quality(density, density)
    wools = with_counts((Yarn(str(n), (n, n, n), (float(n), 0.0, 0.0)) for n in range(3)), quality, kind)
    length, width = (side / density for side in knots.shape)
    return Chart(knots, wools, CarpetSize(width, length), quality, kind)


@settings(max_examples=25)
@given(KNOTS, DENSITY, KIND, st.integers(0, 200).map(lambda n: n / 100), HANKS)
def test_hanks_cover_the_need_and_one_less_does_not(
    knots: Indices, density: float, kind: str, reserve: float, hank: str
) -> None:
    bill, holds = yarn_bill(carpet(knots, density, kind), YarnPlanParams(reserve=reserve, hank=hank)), parse_hank(hank)
    for need in bill.needs:
        assert need.to_buy == pytest.approx(need.mass * (1 + reserve), rel=1e-12)
        amount, each = (need.to_buy, holds.mass) if holds.mass else (need.length * (1 + reserve), holds.length or 0.0)
        assert need.hanks * each >= amount * (1 - 1e-8)
        assert (need.hanks - 1) * each < amount
        assert 0 <= need.kept <= need.mass * (1 + 1e-12)
    assert bill.price == pytest.approx(sum(need.price or math.nan for need in bill.needs), rel=1e-12)
    assert bill.mass_per_area * bill.area == pytest.approx(sum(need.kept for need in bill.needs), rel=1e-12)


@settings(max_examples=25)
@given(KNOTS, st.floats(0.1, 0.5))
def test_each_dye_lot_ends_in_the_row_that_is_named(knots: Indices, lot: float) -> None:
    """At a knot of about 1 kg: the knots below a new lot's row fit the lots before it, with those of the row they do
    not; the field is the yarn of the most knots."""
    plan = YarnPlanParams(pile_height=0.1, calibration=10.0, yarn_count="0.05/64", lot=20 * lot)
    chart = carpet(knots, 100.0)
    heavy = plan.counted(chart.yarns, chart.quality, "symmetric")
    chart = Chart(chart.knots, heavy, chart.size, chart.quality, "symmetric")
    bill = yarn_bill(chart, plan)
    assert bill.field.knots == max(chart.counts)
    for need in bill.pile:
        tied = np.cumsum(np.count_nonzero(chart.knots[::-1] == int(need.name), axis=1)) * need.to_buy / need.knots
        assert need.lots * plan.lot >= need.to_buy * (1 - 1e-8)
        assert len(need.lot_rows) == need.lots - 1
        for number, row in enumerate(need.lot_rows, start=1):
            before = tied[row - 2] if row > 1 else 0.0
            assert before <= number * plan.lot * (1 + 1e-9)
            assert tied[row - 1] >= number * plan.lot * (1 - 1e-9)


@settings(max_examples=25)
@given(DENSITY, st.floats(1.0, 3.0), KIND)
def test_a_finer_carpet_has_a_finer_yarn_and_a_lower_pile(density: float, finer: float, kind: str) -> None:
    coarse, fine = Quality(density, density), Quality(density * finer, density * finer)
    assert usual_count(fine, kind) >= usual_count(coarse, kind)
    assert 2 * mm < usual_pile_height(fine) <= usual_pile_height(coarse) <= 15 * mm


@settings(max_examples=25)
@given(st.integers(1, 4999).map(lambda n: n / 10), st.integers(1, 64))
def test_a_count_reads_back(count: float, ply: int) -> None:
    assert parse_count(write_count(Yarn("x", (0, 0, 0), (0.0, 0.0, 0.0), count, ply))) == (count, ply)
