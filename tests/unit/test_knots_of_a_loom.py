"""Report and choice of a loom count the knots of a carpet with a shape, not the cells of its chart: by brute count."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from default_machines import SETTLED, out_of_space

from ilmek.carpet.codes import NO_KNOT
from ilmek.jobs.chart import ChartResult, make_charted
from ilmek.jobs.loom import LoomResult, make_loomed, read_loom_order
from ilmek.jobs.loom_setup import loom_digest
from ilmek.jobs.order import read_order
from ilmek.machines.automated_loom import AutomatedLoomParams

MEDALLION = Path(__file__).parents[2] / "examples" / "medallion.png"
BY_HAND = {"knotting": "hand", "shed": "hand", "beat": "hand", "weavers": "2"}
LOOMS = {"hand loom": BY_HAND, "weavers": {"knotting": "hand", "weavers": "2", "beat": "comb"}, "heads": SETTLED}

pytestmark = pytest.mark.usefixtures("nothing_near")


@pytest.fixture(scope="module", autouse=True)
def not_in_space() -> Iterator[None]:
    with out_of_space():
        yield


def loomed(loom: dict[str, str], shape: str | None, deadline: str | None = None) -> tuple[ChartResult, LoomResult]:
    order = read_order(MEDALLION, size="150x150cm", quality="12x12/dm", shape=shape)
    charted = make_charted(order)
    return charted, make_loomed(
        read_loom_order(order, loom=loom, heads=1 if loom is SETTLED else None, deadline=deadline),
        charted,
        illustrated=False,
    )


@pytest.mark.parametrize("name", LOOMS)
def test_a_loom_for_a_round_carpet_reports_its_knots_and_not_its_cells(name: str) -> None:
    charted, round_one = loomed(LOOMS[name], "round")
    _, whole = loomed(LOOMS[name], None)
    knots = charted.chart.knots
    tied = int(np.count_nonzero(knots != NO_KNOT))
    assert 0.75 < tied / knots.size < 0.8
    assert round_one.report["knots"] == tied
    assert whole.report["knots"] == knots.size
    assert round_one.made is not None
    each = round_one.made.params.hand_knot if name != "heads" else None
    spent, all_cells = round_one.report["weaving_time"], whole.report["weaving_time"]
    if each is not None:  # two weavers: what of the rows is not knots stays
        assert all_cells - spent == pytest.approx((knots.size - tied) / 2 * each, rel=0.01)
        in_turn = sum(-(-int(row) // 2) for row in np.count_nonzero(knots != NO_KNOT, axis=1))
        rest = all_cells - len(knots) * -(-knots.shape[1] // 2) * each
        assert round_one.weaving_time == pytest.approx(rest + in_turn * each, rel=1e-9)
    else:
        assert round_one.programme is not None
        assert spent == pytest.approx(round_one.programme.duration, rel=0.03)
    cost = round_one.cost
    assert cost is not None
    assert cost.knots == tied


def test_the_deadline_of_a_hand_loom_is_kept_by_the_knots_that_there_are() -> None:
    _, round_one = loomed(BY_HAND, "round")
    _, whole = loomed(BY_HAND, None)
    between = (float(round_one.report["weaving_time"]) + float(whole.report["weaving_time"])) / 2  # type: ignore[arg-type]
    late = {}
    for shape in ("round", None):
        _, judged = loomed(BY_HAND, shape, deadline=f"{between / 3600}h")
        late[shape] = [
            check.name for check in judged.report.all_checks if not check.ok and "weaving time" in check.name
        ]
    assert late["round"] == []
    assert late[None] != []


def test_the_share_of_knots_is_not_of_the_loom() -> None:
    assert loom_digest(AutomatedLoomParams(knotted_share=0.7)) == loom_digest(AutomatedLoomParams())
    assert AutomatedLoomParams(knotted_share=0.7).knots == round(0.7 * AutomatedLoomParams().knots)
