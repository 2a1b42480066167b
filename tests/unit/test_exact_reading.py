"""The decision whether the pixels of a picture are the knots: drawings and charts are, artwork and photos are not."""

import re
from pathlib import Path

import numpy as np
import pytest
from drawings import FLAT, rendered, sunset
from PIL import Image

from ilmek.api import carpets
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.exact import USUAL, enlargement, few_colours, find_drawing, measured, of_grid
from ilmek.carpet.quality import Quality, parse_quality
from ilmek.carpet.reading import ReadParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.errors import CarpetError
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.chart import chart_results, make_charted
from ilmek.jobs.order import QUALITY, read_order

PALETTE = np.array([(150, 48, 40), (30, 27, 29), (235, 223, 195), (31, 49, 87), (143, 176, 189)], np.uint8)
FINE = [name for name in FLAT if name not in ("kilim steps", "zigzag", "checks")]
"""Drawings with details of one knot."""


def diagonals(rows: int = 90, columns: int = 60, seed: int = 1) -> np.ndarray:
    """A field with diagonals of one knot at random."""
    rng = np.random.default_rng(seed)
    numbers = np.zeros((rows, columns), np.uint8)
    for line in range(14):
        row, column, slope = rng.integers(rows), rng.integers(columns), rng.choice([-1, 1])
        for step in range(30):
            if 0 <= row + slope * step < rows and column + step < columns:
                numbers[row + slope * step, column + step] = 1 + line % 4
    return PALETTE[numbers]


def reduced(photo: np.ndarray, colours: int, dither: Image.Dither) -> np.ndarray:
    picture = Image.fromarray(photo)
    palette = picture.quantize(colours, method=Image.Quantize.MEDIANCUT)
    return np.asarray(picture.quantize(palette=palette, dither=dither).convert("RGB"))


def test_the_usual_quality_is_that_of_an_order() -> None:
    assert parse_quality(QUALITY) == USUAL


@pytest.mark.parametrize("name", FINE)
def test_a_drawing_of_one_pixel_a_knot_states_its_grid(name: str) -> None:
    rgb = rendered(FLAT[name], 1, "hard")
    found = find_drawing(rgb, None, None)
    assert found is not None
    assert found.rgb is rgb
    assert (found.size.width, found.size.length) == pytest.approx((60 / 250, 72 / 250))


@pytest.mark.matrix(light=8)
@pytest.mark.parametrize("name", FLAT)
@pytest.mark.parametrize(("pixels", "finish"), [(3.7, "hard"), (2.5, "smooth"), (5.7, "smooth"), (4, "jpeg")])
def test_artwork_of_many_pixels_a_knot_does_not(name: str, pixels: float, finish: str) -> None:
    assert find_drawing(rendered(FLAT[name], pixels, finish), None, None) is None


@pytest.mark.parametrize("dither", [Image.Dither.NONE, Image.Dither.FLOYDSTEINBERG])
@pytest.mark.parametrize("colours", [16, 64, 256])
def test_a_gradient_of_few_colours_does_not(colours: int, dither: Image.Dither) -> None:
    assert find_drawing(reduced(sunset(), colours, dither), None, None) is None


@pytest.mark.parametrize("scale", [2, 3, 7])
def test_an_enlarged_drawing_is_reduced(scale: int) -> None:
    drawing = diagonals()
    large = drawing.repeat(scale, 0).repeat(scale, 1)
    found = find_drawing(large, None, None)
    assert found is not None
    assert np.array_equal(found.rgb, drawing)
    assert f"{scale} × {scale} pixels" in found.reason
    stated = find_drawing(large, CarpetSize(0.6, 0.9), Quality(100.0, 100.0))
    assert stated is not None
    assert np.array_equal(stated.rgb, drawing)


def test_enlargement_is_that_of_all_edges() -> None:
    assert enlargement(np.zeros((12, 12), np.uint8)) == 1
    uneven = np.zeros((12, 12), np.uint8)
    uneven[4:, 6:] = 1
    assert enlargement(uneven) == 2
    uneven[1:, 6:] = 1
    assert enlargement(uneven) == 1


def test_size_and_quality_of_the_pixels_are_enough_whatever_is_drawn() -> None:
    noise = np.random.default_rng(3).integers(0, 5, (90, 60))
    found = find_drawing(PALETTE[noise], CarpetSize(0.6, 0.9), Quality(100.0, 100.0))
    assert found is not None
    many = np.random.default_rng(3).integers(0, 256, (90, 60, 3), dtype=np.uint8)
    assert find_drawing(many, CarpetSize(0.6, 0.9), Quality(100.0, 100.0)) is None
    assert find_drawing(PALETTE[noise], None, None) is None


def test_the_size_or_the_quality_that_is_open_follows() -> None:
    drawing = diagonals()
    by_quality = find_drawing(drawing, None, Quality(400.0, 300.0))
    assert by_quality is not None
    assert (by_quality.size.width, by_quality.size.length) == pytest.approx((0.15, 0.3))
    by_size = find_drawing(drawing, CarpetSize(0.2, 0.3), None)
    assert by_size is not None
    assert (by_size.quality.across, by_size.quality.along) == pytest.approx((300.0, 300.0))
    # 60 knots over 120 cm: no quality that a drawing is made for.
    assert find_drawing(drawing, CarpetSize(1.2, 1.8), None) is None


def test_a_grid_without_a_carpet_is_refused() -> None:
    with pytest.raises(CarpetError, match="side"):
        of_grid((9000, 4000), None, Quality(10.0, 10.0))


def test_more_colours_than_counted_are_none() -> None:
    ramp = np.repeat(np.arange(256, dtype=np.uint8).reshape(16, 16, 1), 3, axis=2)
    assert few_colours(ramp, 255) is None
    few = few_colours(ramp[:-1], 255)
    assert few is not None
    assert np.array_equal(few.palette[few.numbers], ramp[:-1])


def test_measures_by_hand() -> None:
    # A line of one pixel through 10 x 10: 10 thin pixels; 20 of 180 pairs have two colours.
    rgb = np.zeros((10, 10, 3), np.uint8)
    rgb[:, 4] = 255
    few = few_colours(rgb, 2)
    assert few is not None
    details = measured(few)
    assert (details.fine, details.mixed, details.alike, details.contrast) == pytest.approx((0.1, 0.0, 160 / 180, 1.0))
    # A grey column between black and white is a mix.
    rgb[:, :4], rgb[:, 4], rgb[:, 5:] = 0, 120, 255
    few = few_colours(rgb, 3)
    assert few is not None
    assert (measured(few).fine, measured(few).mixed) == pytest.approx((0.0, 0.1))


@pytest.fixture
def drawn(tmp_path: Path) -> Path:
    Image.fromarray(diagonals()).save(tmp_path / "drawn.png")
    return tmp_path / "drawn.png"


def test_a_drawing_needs_no_option_and_no_knot_changes(drawn: Path) -> None:
    made = make_charted(read_order(drawn))
    chart = made.chart
    assert (chart.reading.kind, chart.reading.changed, chart.knots.shape) == ("exact", 0, (90, 60))
    yarn_of = {match.srgb: match.yarn for match in chart.reading.matches}
    wanted = np.apply_along_axis(lambda colour: yarn_of[tuple(colour.tolist())], 2, diagonals())
    assert np.array_equal(chart.knots, wanted)
    assert sum(match.knots for match in chart.reading.matches) == 90 * 60


@pytest.mark.parametrize("reading", ["flat", "photo"])
def test_the_reading_can_be_given(drawn: Path, reading: str) -> None:
    made = make_charted(read_order(drawn, size="30x45cm", reading=reading))
    assert made.chart.reading.kind == reading


def test_exact_reading_of_another_grid_states_both(drawn: Path) -> None:
    order = read_order(drawn, size="120x180cm", quality="25x25/dm", reading="exact")
    with pytest.raises(CarpetError, match=re.escape("60 × 90 pixels")) as caught:
        make_charted(order)
    assert "300 × 450 knots" in str(caught.value)
    with pytest.raises(CarpetError, match="too coarse"):
        make_charted(read_order(drawn, size="20x20m", reading="exact"))


def test_a_part_of_a_drawing_is_exact(drawn: Path) -> None:
    chart = make_charted(read_order(drawn, crop="20,10 80,50", turn="90deg")).chart
    assert (chart.reading.kind, chart.knots.shape) == ("exact", (40, 60))


def test_a_padded_drawing_is_exact_where_it_then_has_the_knots(drawn: Path) -> None:
    order = read_order(drawn, size="32x36cm", quality="25x25/dm", fit="pad", reading="exact")
    chart = make_charted(order).chart
    assert (chart.reading.kind, chart.knots.shape, chart.reading.fit.kind) == ("exact", (90, 80), "pad")
    again = carpets.make_chart(drawn, "32x36cm", "25x25/dm", fit="pad", reading="exact")
    assert np.array_equal(again.knots, chart.knots)


def test_a_colour_a_step_beside_another_is_no_loss(tmp_path: Path) -> None:
    drawing = diagonals()
    drawing[:, :5] = (152, 50, 42)
    Image.fromarray(drawing).save(tmp_path / "twins.png")
    made = make_charted(read_order(tmp_path / "twins.png"))
    assert all(check.ok for check in made.checks)
    assert not [warning for warning in made.warnings if "same yarn" in warning]
    assert {one["colour"]: one["merged_with"] for one in chart_results(made)["assignment"]}["#98322a"] == []


def test_pixels_and_knots_agree_for_knots_that_are_not_square() -> None:
    drawing = diagonals(90, 60)
    chart = make_chart(drawing, CarpetSize(0.3, 0.3), Quality(200.0, 300.0), default_yarns(), reading=ReadParams())
    assert (chart.reading.kind, chart.reading.fit.stretch) == ("exact", 0.0)
