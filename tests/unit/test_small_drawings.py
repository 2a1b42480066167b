"""Small drawings of few colours are drawn knot by knot, icons with smoothed edges and thumbnails of photos are not."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from ilmek.api import carpets
from ilmek.arrays import Rgb
from ilmek.carpet.exact import find_drawing
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order

DATA = Path(__file__).parents[1] / "data"
PALETTE = np.array([(150, 48, 40), (30, 27, 29), (235, 223, 195), (31, 49, 87)], np.uint8)
HEART = ("0110 0110", "1221 1221", "12222 2221", "122222221", "012222210", "001222100", "000121000", "000010000")


def heart() -> Rgb:
    rows = [line.replace(" ", "")[:8].ljust(8, "0") for line in HEART]
    return PALETTE[np.array([[int(one) for one in line] for line in rows])]


def blocks(rows: int, columns: int, side: int, seed: int) -> Rgb:
    numbers = np.random.default_rng(seed).integers(0, 4, (rows, columns))
    return PALETTE[numbers].repeat(side, 0).repeat(side, 1)


def icon(side: int, smooth: int) -> Rgb:
    """A disc and a bar, with edges smoothed over `smooth` × `smooth` samples."""
    large = Image.new("RGB", (side * smooth, side * smooth), (235, 223, 195))
    draw = ImageDraw.Draw(large)
    unit = side * smooth / 16
    draw.ellipse((2 * unit, 2 * unit, 14 * unit, 14 * unit), fill=(31, 49, 87))
    draw.line((3 * unit, 12.5 * unit, 13 * unit, 4 * unit), fill=(150, 48, 40), width=int(2 * unit))
    return np.asarray(large.resize((side, side), Image.Resampling.BOX))


def test_the_blocks_are_one_pixel_one_knot() -> None:
    chart = make_charted(read_order(DATA / "blocks.png")).chart
    with Image.open(DATA / "blocks.png") as picture:
        pixels = np.asarray(picture.convert("RGB"))
    assert (chart.columns, chart.rows, chart.reading.kind, chart.reading.changed) == (24, 48, "exact", 0)
    yarn_of = {match.srgb: match.yarn for match in chart.reading.matches}
    assert len(yarn_of) == 4
    assert all(chart.knots[at] == yarn_of[tuple(pixels[at].tolist())] for at in np.ndindex(48, 24))


@pytest.mark.parametrize(
    "rgb", [heart(), blocks(9, 12, 5, 1), blocks(10, 4, 12, 2), icon(64, 1)], ids=["8x8", "5", "12", "disc"]
)
def test_hard_edges_are_knots(rgb: Rgb) -> None:
    found = find_drawing(rgb, None, None)
    assert found is not None
    assert np.array_equal(found.rgb, rgb)


@pytest.mark.parametrize("side", [24, 32, 48, 64, 96])
def test_an_icon_with_smoothed_edges_is_a_picture(side: int) -> None:
    smoothed = icon(side, 8)
    few = Image.fromarray(smoothed).quantize(12, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    for rgb in (smoothed, np.asarray(few.convert("RGB"))):
        assert find_drawing(rgb, None, None) is None


def test_a_width_gives_the_quality_of_a_drawing() -> None:
    chart = carpets.make_chart(DATA / "blocks.png", "auto", "20x20/dm", width="12cm")
    assert (chart.columns, chart.rows, chart.reading.kind) == (24, 48, "exact")
    made = make_charted(read_order(DATA / "blocks.png", width="8cm"))
    assert (made.chart.size.length, made.chart.quality.across) == pytest.approx((0.16, 300.0))


def test_pixels_of_as_many_colours_are_no_drawing(tmp_path: Path) -> None:
    noise = np.random.default_rng(1).integers(0, 256, (8, 8, 3), dtype=np.uint8)
    Image.fromarray(noise).save(tmp_path / "noise.png")
    assert make_charted(read_order(tmp_path / "noise.png", quality="10x10/dm")).chart.reading.kind == "photo"
