"""A chart as the picture of an order: it comes back as it was, and what the order gives acts on it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from ilmek.carpet.chart import Chart
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize, parse_size
from ilmek.carpet.yarn import Yarn
from ilmek.io.chart.png import KEY, write_chart_png
from ilmek.jobs.chart import ChartResult, chart_results, make_charted
from ilmek.jobs.order import read_order

MEDALLION = Path(__file__).parents[2] / "examples" / "medallion.png"
RED = (150, 48, 40)
YARNS = (
    Yarn("madder", RED, (36.123456789, 41.0, 27.5), 5.0, 3, 14.5),
    Yarn("madder, second dyer", RED, (36.2, 41.0, 27.5), 4.5, 2),
    Yarn("indigo № 3", (27, 36, 66), (15.1, 4.0, -19.0), 2.5, 2, 0.0),
    Yarn("ivory", (239, 230, 208), (91.3, -0.3, 12.2), 2.5, 2),
)
KNOTS = np.random.default_rng(5).integers(0, 4, (45, 30), dtype=np.uint8)
CHART = Chart(KNOTS, YARNS, parse_size("seccade"), Quality(25.0, 25.0), "asymmetric")


@pytest.fixture
def path(tmp_path: Path) -> Path:
    write_chart_png(tmp_path / "chart.png", CHART)
    return tmp_path / "chart.png"


def charted(path: Path, **options: object) -> ChartResult:
    return make_charted(read_order(path, **options))


def test_a_chart_comes_back_bit_for_bit_with_yarns_of_one_colour(path: Path, tmp_path: Path) -> None:
    made = charted(path)
    again = made.chart
    assert np.array_equal(again.knots, KNOTS)
    assert (again.yarns, again.size, again.quality, again.knot) == (YARNS, CHART.size, CHART.quality, CHART.knot)
    assert (again.reading.kind, again.reading.changed, made.notes) == ("exact", 0, ())
    write_chart_png(tmp_path / "again.png", again)
    assert (tmp_path / "again.png").read_bytes() == path.read_bytes()


def test_a_fit_that_is_given_acts_on_a_chart_of_another_size(path: Path) -> None:
    """The size alone would change the quality until the chart fills it."""
    chart = charted(path, size="180x180cm", fit="pad").chart
    assert (chart.knots.shape, chart.reading.fit.kind) == ((45, 45), "pad")


def test_its_own_facts_as_options_change_nothing(path: Path) -> None:
    again = charted(path, size="120x180cm", quality="2.5x2.5/dm", reading="exact", least_patch="0").chart
    assert np.array_equal(again.knots, KNOTS)
    assert (again.yarns, again.size) == (YARNS, CHART.size)


def test_another_knot_alone_is_changed(path: Path) -> None:
    again = charted(path, knot="symmetric").chart
    assert again.knot == "symmetric"
    assert np.array_equal(again.knots, KNOTS)


def test_a_quality_or_a_size_keeps_the_grid_and_the_other_follows(path: Path) -> None:
    finer = charted(path, quality="5x5/dm").chart
    assert (finer.size.width, finer.size.length) == pytest.approx((0.6, 0.9))
    smaller = charted(path, size="60x60cm").chart
    assert (smaller.quality.across, smaller.quality.along) == pytest.approx((50.0, 75.0))
    assert np.array_equal(finer.knots, KNOTS)
    assert np.array_equal(smaller.knots, KNOTS)


def test_size_and_quality_of_another_grid_read_it_as_a_picture(path: Path) -> None:
    again = charted(path, size="60x90cm", quality="10x10/dm").chart
    assert again.knots.shape == (90, 60)
    assert sorted(yarn.name for yarn in again.yarns) == sorted(yarn.name for yarn in YARNS)


def test_other_yarns_take_each_colour_once(path: Path, tmp_path: Path) -> None:
    (tmp_path / "two.csv").write_text("name,srgb,nm\nred,#900000,2\nwhite,#ffffff,2\n")
    again = charted(path, yarn_file=tmp_path / "two.csv").chart
    assert [yarn.name for yarn in again.yarns] == ["red", "white"]
    assert np.array_equal(again.knots, (KNOTS == 3).astype(np.uint8))


def test_rules_of_the_palette_act_on_its_yarns(path: Path) -> None:
    again = charted(path, colours="2").chart
    assert again.colours == 2
    assert set(again.yarns) < set(YARNS)


def spoilt(path: Path, kind: str) -> None:
    """A chart that another program has changed."""
    with Image.open(path) as picture:
        picture.load()
        info = PngInfo()
        info.add_itxt(KEY, picture.text[KEY] if kind != "facts" else "{}")
        if kind == "palette":
            picture.putpalette([7] * 3 + [200] * 9)
        changed = picture.crop((0, 0, 20, 20)) if kind == "grid" else picture
        changed.save(path, pnginfo=info)


@pytest.mark.parametrize("kind", ["palette", "grid", "facts"])
def test_a_chart_that_was_changed_by_another_program_is_a_picture(path: Path, kind: str) -> None:
    spoilt(path, kind)
    made = charted(path, size="60x90cm")
    assert "it is read as a picture" in made.notes[0]


def test_a_size_of_the_same_sides_keeps_its_name(path: Path) -> None:
    assert charted(path, size="120x180cm").chart.size.name == "seccade"
    named = replace(CHART, size=CarpetSize(1.2, 1.8, "a size with a name"))
    write_chart_png(path, named)
    assert charted(path).chart.size.name == "a size with a name"


def test_the_palette_of_the_chart_begins_with_the_yarns_of_the_bill(tmp_path: Path) -> None:
    made = make_charted(read_order(MEDALLION, size="20x30cm", quality="10x10/dm"))
    needs = chart_results(made)["yarn"]
    assert 2 < len(needs) < len(made.chart.yarns)
    write_chart_png(tmp_path / "chart.png", made.chart)
    with Image.open(tmp_path / "chart.png") as picture:
        assert picture.mode == "P"
        counts = np.bincount(np.asarray(picture).ravel())
    assert counts.tolist() == [need["knots"] for need in needs]
    assert [yarn.name for yarn in made.chart.yarns[: len(needs)]] == [need["name"] for need in needs]
    names = {yarn.name for yarn in made.chart.yarns}
    assert {made.chart.yarns[match.yarn].name for match in made.chart.reading.matches} <= names
    for match in made.chart.reading.matches:
        difference = delta_e_2000(srgb_to_lab(np.array(match.srgb, np.uint8)), made.chart.yarns[match.yarn].lab)
        assert float(difference) == pytest.approx(match.delta_e)


def test_a_chart_with_a_yarn_of_no_knot_comes_back_bit_for_bit(tmp_path: Path) -> None:
    write_chart_png(tmp_path / "chart.png", replace(CHART, knots=np.where(KNOTS == 1, 3, KNOTS).astype(np.uint8)))
    write_chart_png(tmp_path / "again.png", charted(tmp_path / "chart.png").chart)
    assert (tmp_path / "again.png").read_bytes() == (tmp_path / "chart.png").read_bytes()
