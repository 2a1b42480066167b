"""One side of a carpet, or none: the same size by every way, and what contradicts itself is an error."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from ilmek.api import carpets
from ilmek.carpet.sizes import CarpetSize, parse_open_size
from ilmek.errors import CarpetError, IlmekError
from ilmek.jobs.chart import ChartResult, chart_order, make_charted
from ilmek.jobs.order import read_order
from ilmek.jobs.recipe import saved_recipe

QUALITY = "10x10/dm"


@pytest.fixture
def picture(tmp_path: Path) -> Path:
    """A photo of 4 : 3."""
    rgb = np.random.default_rng(6).integers(0, 256, (60, 80, 3), dtype=np.uint8)
    Image.fromarray(rgb).save(tmp_path / "photo.png")
    return tmp_path / "photo.png"


def charted(picture: Path, recipe: str = "", **settings: str) -> ChartResult:
    if recipe:
        recipe_file = picture.parent / "carpet.toml"
        recipe_file.write_text(f'picture = "{picture.name}"\n{recipe}')
        picture = recipe_file
    return make_charted(read_order(picture, quality=QUALITY, **settings))


def size(made: ChartResult) -> tuple[float, float]:
    return made.chart.size.width, made.chart.size.length


@pytest.mark.parametrize(
    ("given", "wanted"),
    [
        ({"size": "80cmxauto"}, (0.8, 0.6)),
        ({"size": "80xauto"}, (0.8, 0.6)),
        ({"size": "auto × 6 dm"}, (0.8, 0.6)),
        ({"width": "80cm"}, (0.8, 0.6)),
        ({"length": "0.6m"}, (0.8, 0.6)),
        ({"width": "50cm", "length": "70cm"}, (0.5, 0.7)),
        ({"size": "auto"}, (1.68, 1.26)),
        ({}, (1.68, 1.26)),
    ],
)
def test_every_way_gives_the_same_size(picture: Path, given: dict[str, str], wanted: tuple[float, float]) -> None:
    made = charted(picture, **given)
    assert size(made) == pytest.approx(wanted)
    by_recipe = charted(picture, "".join(f'{key} = "{text}"\n' for key, text in given.items()))
    assert size(by_recipe) == pytest.approx(wanted)
    assert np.array_equal(by_recipe.chart.knots, made.chart.knots)
    called = carpets.make_chart(picture, quality=QUALITY, **given)
    assert np.array_equal(called.knots, made.chart.knots)
    cut = made.chart.reading.fit.cropped
    assert cut == 0.0 or len(given) == 2


def test_what_is_given_beside_a_recipe_overrides_its_size(picture: Path) -> None:
    assert size(charted(picture, 'size = "50x70cm"\n', width="80cm")) == pytest.approx((0.8, 0.6))
    assert size(charted(picture, 'size = "50x70cm"\n', size="auto")) == pytest.approx((1.68, 1.26))
    assert size(charted(picture, 'width = "1m"\n', size="50x70cm")) == pytest.approx((0.5, 0.7))
    assert size(charted(picture, 'width = "1m"\n', length="0.6m")) == pytest.approx((0.8, 0.6))


@pytest.mark.parametrize(
    ("recipe", "given", "said"),
    [
        ("", {"size": "50x70cm", "width": "1m"}, "width given beside the size"),
        ('size = "50x70cm"\nlength = "1m"\n', {}, "line 3.*length beside size"),
        ("", {"size": "50cm"}, "has one side"),
        ("", {"width": "60m"}, "at most 5000 cm"),
    ],
)
def test_contradictions_are_errors(picture: Path, recipe: str, given: dict[str, str], said: str) -> None:
    with pytest.raises(IlmekError, match=said):
        charted(picture, recipe, **given)


def test_texts_of_open_sizes() -> None:
    assert parse_open_size("seccade") == (CarpetSize(1.2, 1.8, "seccade"), {})
    assert parse_open_size("auto x auto") == parse_open_size(" Auto ") == (None, {})
    assert parse_open_size("AUTO x 4ft") == (None, {"length": 1.2192})
    for wrong in ("autox120kg", "1.2xauto", "auto120cm", "120cmxaut"):
        with pytest.raises(CarpetError):
            assert parse_open_size(wrong) == (None, {})


@pytest.mark.parametrize("frame", ['width = "9cm"\n', "width = 7\n"])
def test_the_field_of_a_recipe_keeps_the_pictures_proportions(picture: Path, frame: str) -> None:
    border = f'[[border]]\n{frame}yarn = "madder red"\n'
    made = charted(picture, border)
    fit = made.chart.reading.fit
    assert (fit.cropped, fit.padded) == (0.0, 0.0)
    assert abs(fit.stretch) <= 0.02
    assert made.chart.size.area == pytest.approx(2.16, rel=0.2)
    assert charted(picture, border, width="80cm").chart.size.width == 0.8
    mirrored = charted(picture, f'mirror = "across"\n{border}')
    assert (mirrored.chart.columns, mirrored.chart.reading.fit.cropped) > (mirrored.chart.rows * 2, -1.0)


def test_a_saved_recipe_has_the_size_alone(picture: Path) -> None:
    made = charted(picture, width="80cm")
    text = saved_recipe(made.order, made.chart, picture.parent)
    assert 'size = "80x60cm"' in text
    assert "width" not in text
    (picture.parent / "again.toml").write_text(text)
    again = make_charted(read_order(picture.parent / "again.toml"))
    assert np.array_equal(again.chart.knots, made.chart.knots)


def test_a_chart_keeps_its_knots_on_another_width(picture: Path) -> None:
    first = charted(picture, size="30x40cm")
    carpets.write_chart(picture.parent / "chart.png", first.chart)
    again = make_charted(read_order(picture.parent / "chart.png", width="60cm"))
    assert np.array_equal(again.chart.knots, first.chart.knots)
    assert size(again) == pytest.approx((0.6, 0.8))
    part = make_charted(read_order(picture.parent / "chart.png", width="60cm", crop="0,0 15,40"))
    assert size(part) == pytest.approx((0.6, 1.6))
    assert part.chart.reading.fit.kind == "whole"


def test_the_page_shows_what_is_cut(picture: Path) -> None:
    order = read_order(picture, size="30x60cm", quality=QUALITY, pdf=False)
    made, _ = chart_order(order, picture.parent / "out")
    page = (picture.parent / "out/report.html").read_text(encoding="utf-8")
    assert made.chart.reading.fit.cropped == pytest.approx(0.625, abs=0.01)
    assert "<b>What is cut.</b> 62.5 % of the picture is not shown" in page
    assert any("62.5% of the picture is cut off" in note for note in made.notes)
    chart_order(read_order(picture, size="32x24cm", quality=QUALITY, pdf=False), picture.parent / "whole")
    assert "What is cut" not in (picture.parent / "whole/report.html").read_text(encoding="utf-8")
