"""One yarn bill, told in four places: the chart's knots, the JSON, yarn.csv and the report's table."""

import csv
import math
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from ilmek.arrays import Indices
from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart
from ilmek.carpet.pile import knot_length
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.statistics import chart_statistics
from ilmek.carpet.yarn import Yarn
from ilmek.carpet.yarn_plan import YarnPlanParams
from ilmek.elements.knot_kinds import WRAPS
from ilmek.io.chart.symbols import symbols
from ilmek.io.yarn_csv import write_yarn_csv
from ilmek.io.yarn_file import yarns_from_records
from ilmek.jobs.chart import ChartResult, chart_results
from ilmek.jobs.order import CarpetOrder
from ilmek.viz.page_parts import yarn_lines

PLAN = YarnPlanParams(pile_height=0.0065)
YARN = st.fixed_dictionaries(
    {"srgb": st.integers(0, 0xFFFFFF).map("#{:06x}".format), "nm": st.floats(0.5, 20.0), "ply": st.integers(1, 4)},
    optional={"price": st.floats(0.0, 99.0)},
)


YARNS = st.lists(YARN, min_size=2, max_size=12)
DENSITY = st.floats(20.0, 190.0)
KNOTS = arrays(np.uint8, st.tuples(st.integers(2, 9), st.integers(2, 9)), elements=st.integers(0, 11))


def charted(records: list[dict[str, Any]], knots: Indices, across: float, along: float, kind: str) -> ChartResult:
    """The chart of such knots, each knot's number taken as far as there are yarns; not every yarn has a knot."""
    yarns = yarns_from_records([{"name": f'yarn {place}, "fine"', **one} for place, one in enumerate(records)])
    knots = knots % np.uint8(len(yarns))
    quality = Quality(across, along)
    size = CarpetSize(knots.shape[1] / across, knots.shape[0] / along)
    chart = Chart(knots, yarns, size, quality, kind)
    order = CarpetOrder(Path("x.png"), size, quality, kind, yarns, plan=PLAN).resolved()
    return ChartResult(order, chart, yarn_bill(chart, PLAN), chart_statistics(chart), ())


def written(made: ChartResult) -> list[dict[str, str]]:
    with TemporaryDirectory() as folder:
        write_yarn_csv(Path(folder) / "yarn.csv", made.bill, made.chart.yarns)
        with (Path(folder) / "yarn.csv").open(encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))


@settings(max_examples=40)
@given(YARNS, KNOTS, DENSITY, DENSITY, st.sampled_from(sorted(WRAPS)))
def test_the_yarn_is_the_same_everywhere(
    records: list[dict[str, Any]], cells: Indices, across: float, along: float, kind: str
) -> None:
    made = charted(records, cells, across, along, kind)
    knots = Counter(made.chart.knots.ravel().tolist())
    used: list[Yarn] = [made.chart.yarns[place] for place in sorted(knots)]
    results, lines, shown = (
        chart_results(made),
        written(made),
        yarn_lines(made.chart, made.bill, symbols(made.chart.yarns)),
    )

    named = [yarn.name for yarn in used]
    pile = results["yarn"]
    assert [need["name"] for need in pile] == named == [line.need.name for line in shown if line.colour]
    assert [line["yarn"] for line in lines] == [line.need.name for line in shown]
    assert [line["srgb"] for line in lines if line["srgb"]] == [yarn.hex for yarn in used]
    assert [line.colour for line in shown if line.colour] == [yarn.hex for yarn in used]
    assert [line.symbol for line in shown if line.symbol] == [
        symbols(made.chart.yarns)[place] for place in sorted(knots)
    ]

    counts = [knots[place] for place in sorted(knots)]
    assert [need["knots"] for need in pile] == counts == [line.need.knots for line in shown if line.colour]
    assert [int(line["knots"]) for line in lines if line["knots"]] == counts
    for need, yarn, count in zip(pile, used, counts, strict=True):
        length = count * knot_length(made.chart.knot, made.chart.quality, yarn.linear_density, made.pile)
        assert math.isclose(need["length"], length, rel_tol=1e-12)
        assert math.isclose(need["mass"], length * yarn.ply / (1000 * yarn.metric_count), rel_tol=1e-12)

    every = [*pile, *results["ground"]]
    for need, line, one in zip(every, lines, shown, strict=True):
        assert abs(float(line["length [m]"]) - need["length"]) <= 0.0501
        assert abs(float(line["mass [g]"]) - 1000 * need["mass"]) <= 0.0501
        assert abs(float(line["to buy [g]"]) - 1000 * need["to_buy"]) <= 0.0501
        assert abs(float(line["price [EUR]"]) - need["price"]) <= 0.00501
        assert (line["count"], int(line["hanks"]), int(line["lots"])) == (need["count"], need["hanks"], need["lots"])
        assert (one.need.length, one.need.mass) == (need["length"], need["mass"])
    assert math.isclose(results["yarn_mass"], sum(need["mass"] for need in every), rel_tol=1e-12)
    assert math.isclose(results["price"], sum(need["price"] for need in every), rel_tol=1e-12)
    assert math.isclose(results["pile_mass"], sum(need["mass"] for need in pile), rel_tol=1e-12)
    assert results["knots"] == sum(counts)
