"""Transparent parts lie on a ground that the art is seen on."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from ilmek.api import carpets
from ilmek.io.picture import read_picture
from ilmek.io.picture_pixels import DARK
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order


def gear(fill: tuple[int, int, int], mode: str = "RGBA") -> Image.Image:
    """A ring of one colour, transparent within and without."""
    picture = Image.new("RGBA", (60, 60), (0, 0, 0, 0))
    draw = ImageDraw.Draw(picture)
    draw.ellipse((6, 6, 54, 54), fill=(*fill, 255))
    draw.ellipse((22, 22, 38, 38), fill=(0, 0, 0, 0))
    return picture.convert(mode)


def saved(picture: Image.Image, folder: Path) -> Path:
    picture.save(folder / "art.png")
    return folder / "art.png"


@pytest.mark.parametrize("mode", ["RGBA", "LA"])
@pytest.mark.parametrize("fill", [(255, 255, 255), (240, 240, 236), (225, 225, 225)])
def test_white_art_is_seen_on_a_dark_ground(tmp_path: Path, fill: tuple[int, int, int], mode: str) -> None:
    made = make_charted(read_order(saved(gear(fill, mode), tmp_path), width="20cm", quality="20x20/dm"))
    assert made.chart.colours > 1
    assert any("put on #202020, because the rest is nearly white; --ground" in note for note in made.notes)
    middle, ring = (made.chart.yarns[made.chart.knots[row, 20]].lab[0] for row in (20, 6))
    assert ring - middle > 50


@pytest.mark.parametrize("fill", [(190, 40, 30), (255, 230, 40), (0, 0, 0), (150, 150, 150)])
def test_other_art_stays_on_white(tmp_path: Path, fill: tuple[int, int, int]) -> None:
    picture = read_picture(saved(gear(fill), tmp_path))
    assert picture.notes == ("transparent parts put on white",)
    assert picture.ground == (255, 255, 255)
    assert picture.rgb[30, 30].tolist() == [255, 255, 255]


def test_white_art_with_black_lines_stays_on_white(tmp_path: Path) -> None:
    picture = gear((255, 255, 255))
    draw = ImageDraw.Draw(picture)
    for box in ((6, 6, 54, 54), (22, 22, 38, 38)):
        draw.ellipse(box, outline=(0, 0, 0, 255), width=2)  # the least lines: all that is seen is nearly white
    assert read_picture(saved(picture, tmp_path)).ground == (255, 255, 255)


def test_a_ground_is_composited_as_pillow_does(tmp_path: Path) -> None:
    rng = np.random.default_rng(4)
    art = Image.fromarray(rng.integers(0, 256, (24, 24, 4), dtype=np.uint8), "RGBA")
    picture = read_picture(saved(art, tmp_path), ground="#9e2b25")
    behind = Image.new("RGBA", art.size, "#9e2b25")
    judge = np.asarray(Image.alpha_composite(behind, art).convert("RGB"), dtype=int)
    assert np.abs(picture.rgb.astype(int) - judge).max() <= 1
    assert picture.ground == (0x9E, 0x2B, 0x25)


def test_margins_have_the_same_ground(tmp_path: Path) -> None:
    file = saved(gear((255, 255, 255)).crop((6, 6, 54, 54)), tmp_path)
    size = {"size": "20x40cm", "quality": "20x20/dm"}
    made = make_charted(read_order(file, **size, fit="pad"))
    assert made.chart.reading.fit.border == "#{:02x}{:02x}{:02x}".format(*DARK)
    red = make_charted(read_order(file, **size, fit="pad", ground="#9e2b25"))
    assert red.chart.reading.fit.border == "#9e2b25"
    called = carpets.make_chart(file, "20x40cm", "20x20/dm", fit="pad", ground="#9e2b25")
    assert np.array_equal(called.knots, red.chart.knots)


def test_a_ground_that_is_not_seen_is_told(tmp_path: Path) -> None:
    made = make_charted(read_order(saved(Image.new("RGB", (20, 20), "red"), tmp_path), ground="#ffffff"))
    assert any("is not seen" in note for note in made.notes)
