"""OXS of other programs and of hostile ones: what is read, what is left out, what is refused in one line."""

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from ilmek.carpet.chart import Chart
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn
from ilmek.cli import main
from ilmek.errors import CarpetError, PictureError
from ilmek.io.chart.formats import FORMATS
from ilmek.io.chart.oxs import MOST_OXS_KNOTS, write_chart_oxs
from ilmek.io.chart.oxs_reading import DEEPEST_OXS, read_chart_oxs
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order

PALETTE = """
  <palette_item index="0" number="cloth" name="cloth" color="FFFFFF" printcolor="FFFFFF" blendcolor="nil" strands="2"/>
  <palette_item index="1" number="DMC    310" name="Black" color="2C3225" symbol="100"/>
  <palette_item index="2" number="DMC    310" name="Black" color="A26D20"/>
"""
STITCHES = '<stitch x="0" y="0" palindex="1"/><stitch x="2" y="1" palindex="2" marked="true"/>'


def oxs(stitches: str = STITCHES, palette: str = PALETTE, more: str = "", size: str = '"3" chartheight="2"') -> str:
    return (
        f'<?xml version="1.0" encoding="UTF-8"?>\n<chart>\n<format comments01="for any cross stitch software"/>\n'
        f'<properties software="Ursa Software" chartwidth={size} charttitle="Piggies" stitchesperinch="14"/>\n'
        f"<palette>{palette}</palette><fullstitches>{stitches}</fullstitches>{more}\n</chart>\n"
    )


def read(tmp_path: Path, text: str, ground: str | None = "#ffffff") -> tuple[Chart, tuple[str, ...]]:
    (tmp_path / "design.oxs").write_text(text, encoding="utf-8")
    return read_chart_oxs(tmp_path / "design.oxs", None, Quality(100.0, 100.0), ground=ground)


def test_the_palette_of_another_program_is_the_yarn_list(tmp_path: Path) -> None:
    chart, notes = read(tmp_path, oxs())
    assert chart.knots.tolist() == [[0, 2, 2], [2, 2, 1]]
    assert [yarn.name for yarn in chart.yarns] == ["DMC 310 Black", "DMC 310 Black (2)", "ground"]
    assert [yarn.hex for yarn in chart.yarns] == ["#2c3225", "#a26d20", "#ffffff"]
    assert [yarn.number for yarn in chart.yarns] == [1, 2, 3]
    assert chart.yarns[0].lab == pytest.approx(srgb_to_lab(np.array([0x2C, 0x32, 0x25], np.uint8)).tolist())
    assert (chart.size.width, chart.quality) == (pytest.approx(0.03), Quality(100.0, 100.0))
    assert notes == ("its palette is the yarn list",)


def test_cloth_that_is_covered_is_no_yarn(tmp_path: Path) -> None:
    every = "".join(f'<stitch x="{x}" y="{y}" palindex="{1 + (x + y) % 2}"/>' for x in range(3) for y in range(2))
    chart, _ = read(tmp_path, oxs(every), ground=None)
    assert len(chart.yarns) == 2


def test_stitches_that_are_no_knots_are_counted_and_left_out(tmp_path: Path) -> None:
    more = '<backstitches><backstitch x1="1" x2="2" y1="0" y2="1" palindex="1"/></backstitches>'
    more += '<ornaments_inc_knots_and_beads><object x1="1" y1="1" palindex="1" objecttype="bead"/>'
    more += '<object x1="1" y1="0" palindex="1" objecttype="knot"/></ornaments_inc_knots_and_beads>'
    _, notes = read(tmp_path, oxs(more=more))
    assert notes[0] == ("left out of the chart: 1 back stitch, 2 knots, beads and other ornaments")


def test_programs_that_count_from_1_are_understood(tmp_path: Path) -> None:
    chart, notes = read(tmp_path, oxs('<stitch x="1" y="1" palindex="1"/><stitch x="3" y="2" palindex="2"/>'))
    assert chart.knots.tolist() == [[0, 2, 2], [2, 2, 1]]
    assert "its stitches are numbered from 1" in notes


def test_a_chart_that_another_program_has_changed_keeps_its_knots(tmp_path: Path) -> None:
    yarns = tuple(Yarn(name, (value, 0, 0), (0.0, 0.0, 0.0), 5.0) for name, value in (("a", 9), ("b", 200)))
    knots = np.random.default_rng(2).integers(0, 2, (8, 9), dtype=np.uint8)
    write_chart_oxs(tmp_path / "a.oxs", Chart(knots, yarns, CarpetSize(0.9, 0.8), Quality(10.0, 10.0), "symmetric"))
    text = (tmp_path / "a.oxs").read_text(encoding="utf-8").replace('color="C80000"', 'color="00C800"')
    chart, notes = read(tmp_path, text)
    assert np.array_equal(chart.knots, knots)
    assert [(yarn.name, yarn.hex) for yarn in chart.yarns] == [("a", "#090000"), ("b", "#00c800")]
    assert "read as that of another program" in notes[0]


def test_an_order_gives_yarns_quality_and_size(tmp_path: Path) -> None:
    large = "".join(f'<stitch x="{x}" y="{y}" palindex="{1 + x % 2}"/>' for x in range(30) for y in range(20))
    (tmp_path / "design.oxs").write_text(oxs(large, size='"30" chartheight="20"'), encoding="utf-8")
    (tmp_path / "two.csv").write_text("name,srgb,nm\nblack,#000000,4\ngold,#b08030,4\n", encoding="utf-8")
    made = make_charted(read_order(tmp_path / "design.oxs", quality="10x20/dm", yarn_file=tmp_path / "two.csv"))
    assert made.chart.knots.tolist() == [[0, 1] * 15] * 20
    assert (made.chart.size.width, made.chart.size.length) == pytest.approx((0.3, 0.1))
    assert [yarn.name for yarn in made.chart.yarns] == ["black", "gold"]
    own = make_charted(read_order(tmp_path / "design.oxs")).chart
    assert own.knots.tolist() == [[0, 1] * 15] * 20
    assert all(yarn.metric_count for yarn in own.yarns)
    other = make_charted(read_order(tmp_path / "design.oxs", size="60x40cm", quality="10x10/dm"))
    assert other.chart.knots.shape == (40, 60)


DTD = '<?xml version="1.0"?><!DOCTYPE chart [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]><chart>&b;</chart>'
OUTSIDE = '<?xml version="1.0"?><!DOCTYPE chart SYSTEM "file:///etc/passwd"><chart/>'
BAD = {
    "entities": (DTD, "document type"),
    "external": (OUTSIDE, "document type"),
    "cut": (oxs()[:-60], "line"),
    "no-stitches": ("<chart/>", "no stitches"),
    "other-root": ("<svg><chart/></svg>", "no OXS chart: it begins with 'svg'"),
    "text": ("a note", "line 1"),
    "outside": (oxs('<stitch x="3" y="0" palindex="1"/><stitch x="0" y="0" palindex="1"/>'), "outside of the chart"),
    "far-outside": (oxs('<stitch x="900" y="0" palindex="1"/>'), "x '900'"),
    "negative": (oxs('<stitch x="-1" y="0" palindex="1"/>'), "x '-1'"),
    "no-colour": (oxs('<stitch x="1" y="0" palindex="7"/>'), "colour 7"),
    "no-index": (oxs('<stitch x="1" y="0"/>'), "no palindex"),
    "huge": (oxs(size='"9999999" chartheight="9999999"'), "chartheight '9999999'"),
    "large": (oxs(size='"3000" chartheight="3000"'), "3000 × 3000"),
    "tiny": (oxs(size='"1" chartheight="1"'), "1 × 1"),
    "no-size": (oxs().replace("chartwidth", "wide"), "no chartwidth"),
    "twice": (oxs(more='<properties chartwidth="4" chartheight="4"/>'), "two sections of properties"),
    "colour": (oxs(palette=PALETTE.replace("A26D20", "red")), "'red' is no colour"),
    "same-index": (oxs(palette=PALETTE.replace('index="2"', 'index="1"')), "two items 1"),
    "deep": ("<chart>" + "<a>" * DEEPEST_OXS, "nested too deeply"),
    "early": ('<chart><stitch x="0" y="0" palindex="0"/></chart>', "before the properties"),
    "empty": ("", "no element found"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_refused_in_one_line(tmp_path: Path, name: str) -> None:
    text, reason = BAD[name]
    (tmp_path / "design.oxs").write_text(text, encoding="utf-8")
    with pytest.raises(PictureError) as caught:
        read_chart_oxs(tmp_path / "design.oxs")
    assert reason in str(caught.value)
    assert "design.oxs" in caught.value.given
    result = CliRunner().invoke(main, ["chart", str(tmp_path / "design.oxs"), "--json", "-"])
    assert result.exit_code == 2
    assert len(result.stderr.strip().splitlines()) == 1
    assert "Traceback" not in result.stderr


def test_a_palette_of_one_colour_is_refused(tmp_path: Path) -> None:
    one = '<palette_item index="1" number="1" name="Black" color="000000"/>'
    every = "".join(f'<stitch x="{x}" y="{y}" palindex="1"/>' for x in range(3) for y in range(2))
    with pytest.raises(PictureError, match="its palette has 1 colour;"):
        read(tmp_path, oxs(every, palette=one))


def test_too_many_knots_are_refused_before_any_work() -> None:
    FORMATS["oxs"].require(MOST_OXS_KNOTS)
    with pytest.raises(CarpetError, match="--oxs"):
        read_order(Path("nowhere.png"), size="10x10m", quality="40x40/dm", oxs=True)
