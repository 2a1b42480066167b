"""The legend page: the yarn to buy and what the loom is set up by, against the bill and against counting by hand."""

from pathlib import Path

import numpy as np
import pytest
from pypdf import PdfReader

from ilmek.carpet.chart import Chart
from ilmek.carpet.ground import GroundParams
from ilmek.carpet.mounting import mounting
from ilmek.carpet.washing import WashParams
from ilmek.io.chart.legend import mounting_lines
from ilmek.io.chart.pdf import write_chart_pdf
from ilmek.io.yarn_file import default_yarns, read_yarns
from ilmek.jobs.chart import chart_order, make_charted
from ilmek.jobs.order import read_order

CASE = Path(__file__).parents[1] / "data" / "two-indices.bmp"


def plain(text: str) -> str:
    return text.replace("\u202f", "")


def test_the_yarn_to_buy_stands_beside_the_symbols(tmp_path: Path) -> None:
    chart_order(read_order(CASE), tmp_path / "out")
    bill = make_charted(read_order(CASE)).bill
    for file in ("chart.pdf", "rows.pdf"):
        pages = [plain(page.extract_text()) for page in PdfReader(tmp_path / "out" / file).pages]
        legend = next(page for page in pages if page.startswith("Legend"))
        lines = [line.strip() for line in legend.split("\n")]
        for need in bill.needs:
            at = lines.index(need.name)
            written = [
                f"{value:,.{0 if value >= 10 else 1}f}" for value in (need.length, 1e3 * need.mass, 1e3 * need.to_buy)
            ]
            assert lines[at + 1 : at + 5] == [*written, str(need.hanks)]
        assert f"{1e3 * sum(need.to_buy for need in bill.needs):.0f}" in lines[lines.index("All yarns") :]
        assert "88, of which 8 at the edges without knots; two for a knot" in lines  # 2 x 40 and 8


@pytest.mark.parametrize("lang", ["en", "tr"])
def test_the_sign_of_cells_without_a_knot_is_explained(tmp_path: Path, lang: str) -> None:
    words = {"en": "12·: 12 cells without a knot, in plain weave.", "tr": "12·: ilmeksiz 12 göz, bez ayağı dokuma."}
    for shape, shown in (("round", True), (None, False)):
        order = read_order(CASE, size="40x40cm", quality="10x10/dm", shape=shape, lang=lang)
        chart_order(order, tmp_path / str(shape))
        for file in ("chart.pdf", "rows.pdf"):
            text = " ".join(page.extract_text() for page in PdfReader(tmp_path / str(shape) / file).pages)
            assert (words[lang] in text) is shown


@pytest.mark.parametrize(("rows", "columns"), [(40, 30), (41, 31), (7, 1200)])
def test_the_mounting_is_that_of_counted_warps(rows: int, columns: int) -> None:
    """Warps laid one by one, rows beaten one by one, on the loom: they come nearer in washing, and off it."""
    size = f"{columns / 2.5}x{rows / 4}cm"
    chart = Chart(np.zeros((rows, columns), dtype=int), default_yarns()[:2], size, "25x40/dm", "symmetric")
    washing = WashParams(shrink_along=0.02, shrink_across=0.05)
    ground = GroundParams(selvedge_warps=6, fringe=0.05, loom_waste=0.3, warp_strain=0.01, washing=washing)
    made = mounting(chart, ground)
    warps = [at * 0.002 / 0.95 for at in range(6 + 2 * columns)]
    assert (made.warps, made.selvedge_warps) == (len(warps), 6)
    assert made.width == pytest.approx(warps[-1] + 0.002 / 0.95)
    assert made.warp_length == pytest.approx(rows * 0.0025 / 0.98 * 1.03 + 0.4)
    assert made.row_mark == pytest.approx(sum(0.0025 * 1.01 / 0.98 for _ in range(10)))
    assert made.knot_mark == pytest.approx(warps[20])
    lines = dict(mounting_lines(chart, made))
    below = sum(1 for row in range(rows) if row + 1 <= rows / 2)
    expected = f"between rows {below} and {below + 1}" if rows % 2 == 0 else f"in row {below + 1}"
    assert lines["middle row"].startswith(expected)


def test_many_yarns_go_on_with_their_headings(tmp_path: Path) -> None:
    (tmp_path / "many.csv").write_text(
        "name,srgb\n" + "".join(f"yarn {n},#{n:02x}{255 - n:02x}{7 * n % 256:02x}\n" for n in range(90)),
        encoding="utf-8",
    )
    yarns = read_yarns(tmp_path / "many.csv")
    chart = Chart(np.arange(3600).reshape(60, 60) % 90, yarns, "24x24cm", "25x25/dm", "symmetric")
    write_chart_pdf(tmp_path / "chart.pdf", chart)
    text = "\n".join(page.extract_text() for page in PdfReader(tmp_path / "chart.pdf").pages)
    assert text.count("Legend, continued") == 2
    assert all(f"\nyarn {n}\n" in text + "\n" for n in range(90))
