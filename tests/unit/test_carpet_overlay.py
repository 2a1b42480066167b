"""Half knots and jufti knots of a chart: what fits, what is counted, what yarn they take."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pypdf import PdfReader

from ilmek.carpet.bill import yarn_bill
from ilmek.carpet.chart import Chart
from ilmek.carpet.overlay import HALF, JUFTI, KnotMark, no_overlay, overlay_of
from ilmek.carpet.pile import PileParams, knot_length
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.carpet.yarn_plan import YarnPlanParams
from ilmek.errors import CarpetError
from ilmek.io.chart.pdf import write_chart_pdf
from ilmek.jobs.weave import overlay_checks
from ilmek.units import mm
from ilmek.viz.page_parts import carpet_facts, yarn_lines
from ilmek.viz.page_pictures import pictures
from ilmek.weaving.knots.path import KnotDimensions, wrap_length
from ilmek.weaving.knots.word import SINGLE, knot

KNOTS = np.array([[0, 0, 1, 1, 1], [2, 2, 2, 0, 1]], dtype=np.uint8)
YARNS = tuple(Yarn(name, (n, n, n), (float(n), 0.0, 0.0), 4.0 + n, price=10.0) for n, name in enumerate("abcd"))
PLAIN = Chart(KNOTS, YARNS, CarpetSize(0.05, 0.02), Quality(100.0, 100.0), "symmetric")
MARKED = replace(PLAIN, overlay=overlay_of([(1, 1, JUFTI, 0), (0, 1, HALF, 3), (0, 2, JUFTI, 0)]))


def test_every_knot_is_counted_once() -> None:
    """11 knots: cells of halves have two, jufti knots have two cells."""
    assert PLAIN.tied == ((3, 4, 3, 0), (0, 0, 0, 0), (0, 0, 0, 0))
    assert MARKED.tied == ((2, 2, 1, 0), (1, 0, 0, 1), (0, 1, 1, 0))
    assert MARKED.counts == PLAIN.counts
    assert (MARKED.used, MARKED.colours, PLAIN.colours) == ((0, 1, 2, 3), 4, 3)
    assert (MARKED.overlay.halves, MARKED.overlay.juftis) == (1, 2)


def test_the_bill_has_the_yarn_of_each_form() -> None:
    plan = YarnPlanParams()
    pile, bill = plan.pile(MARKED.quality), yarn_bill(MARKED, plan)
    assert [need.knots for need in bill.pile] == [3, 3, 2, 1]
    for need, yarn, forms in zip(bill.pile, YARNS, zip(*MARKED.tied, strict=True), strict=True):
        lengths = [
            knot_length("symmetric", MARKED.quality, yarn.linear_density, pile, form)
            for form in ("whole", "half", "jufti")
        ]
        assert need.length == pytest.approx(np.dot(forms, lengths), rel=1e-12)
        assert lengths[1] < lengths[0] < lengths[2]


@pytest.mark.parametrize("kind", ["symmetric", "asymmetric"])
def test_the_lengths_are_those_of_the_curves_of_the_knots(kind: str) -> None:
    """One pile yarn in three forms: they differ by the wraps of the knots' curves."""
    quality, pile = Quality(125.0, 125.0), PileParams(warp_diameter=1 * mm)
    yarn = 0.4e-3
    found = {form: knot_length(kind, quality, yarn, pile, form) for form in ("whole", "half", "jufti")}
    size = KnotDimensions(quality.warp_pitch, 1 * mm, _diameter(yarn))
    curves = {"whole": knot(kind), "half": knot(SINGLE), "jufti": knot(kind, each=2)}
    for form, curve in curves.items():
        differs = wrap_length(curve, size) - wrap_length(curves["whole"], size)
        assert found[form] - found["whole"] == pytest.approx(differs, abs=1e-12)


def _diameter(linear_density: float) -> float:
    pile = PileParams()
    return float(np.sqrt(4 * linear_density / (np.pi * pile.fibre_density * pile.packing)))


@pytest.mark.parametrize(
    ("marks", "said"),
    [
        ([(2, 0, HALF, 3)], "row 0, knot 1 is outside of the chart; 2 rows of 5 knots"),
        ([(0, 4, JUFTI, 0)], "row 2, knot 5 is outside"),
        ([(0, 0, JUFTI, 0), (0, 1, HALF, 3)], "half knot at row 2, knot 2 overlaps"),
        ([(0, 0, HALF, 3), (0, 0, HALF, 2)], "row 2, knot 1 overlaps"),
        ([(0, 1, JUFTI, 0)], "jufti knot at row 2, knot 2 has two yarns"),
        ([(0, 0, HALF, 0)], "has no second yarn"),
        ([(0, 0, HALF, 4)], "has no second yarn"),
        ([(0, 0, 3, 0)], "out of bounds"),
        ([(-1, 0, HALF, 1)], "out of bounds"),
    ],
)
def test_what_does_not_fit_is_refused(marks: list[tuple[int, int, int, int]], said: str) -> None:
    with pytest.raises(CarpetError, match=said):
        replace(PLAIN, overlay=overlay_of(marks))


def test_marks_of_some_rows() -> None:
    overlay = MARKED.overlay
    assert list(overlay) == [KnotMark(0, 1, HALF, 3), KnotMark(0, 2, JUFTI), KnotMark(1, 1, JUFTI)]
    assert list(overlay.between(1, 2)) == [KnotMark(1, 1, JUFTI)]
    assert overlay.equals(overlay_of(reversed(list(overlay))))
    assert not overlay.equals(no_overlay())


def test_the_loom_ties_no_half_knot() -> None:
    (check,) = overlay_checks(MARKED)
    assert not check.ok
    assert "rows.pdf" in check.cure
    assert "2 half knots, 2 jufti knots" in check.source
    assert overlay_checks(PLAIN) == ()


def test_printed_charts_show_both_halves_and_the_bar(tmp_path: Path) -> None:
    """The symbols of a sheet: those of its cells, and of each half cell both, over the cell's own."""
    write_chart_pdf(tmp_path / "plain.pdf", PLAIN)
    write_chart_pdf(tmp_path / "marked.pdf", MARKED)
    plain, marked = (PdfReader(tmp_path / f"{name}.pdf").pages[-1].get_contents() for name in ("plain", "marked"))
    assert plain is not None
    assert marked is not None
    assert marked.get_data().count(b" re f") >= plain.get_data().count(b" re f") + 4
    shown = PdfReader(tmp_path / "marked.pdf").pages[-1].extract_text()
    assert shown.count("D") == 1


def test_totals_and_shares_are_of_the_knots_to_tie() -> None:
    """Half cells count twice, jufti knots once: on the page as in the legend, the shares add up to one."""
    bill = yarn_bill(MARKED)
    assert MARKED.tied.total == bill.knots == MARKED.knots.size + 1 - 2
    (knots,) = (fact for fact in carpet_facts(MARKED, bill, (), ()) if fact.label == "Knots")
    assert knots.value == str(bill.knots)
    assert "half and jufti knots" in knots.note
    shares = [float(line.share.split()[0]) for line in yarn_lines(MARKED, bill, "") if line.share]
    assert abs(sum(shares) - 100.0) <= 0.1 * len(shares)


def test_the_page_tells_half_knots_and_jufti_knots() -> None:
    """Cell "row,column": the second yarn, or the left and right cell of a jufti knot."""
    data = pictures(MARKED, None, "", []).data
    assert data["marks"] == {"0,1": 3, "0,2": -1, "0,3": -2, "1,1": -1, "1,2": -2}
    assert pictures(PLAIN, None, "", []).data["marks"] == {}
