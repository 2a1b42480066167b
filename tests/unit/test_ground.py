"""Transparent parts lie on a ground that the art is seen on."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageDraw

from ilmek.api import carpets
from ilmek.io.ground_colour import DARK
from ilmek.io.picture import read_picture
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
    assert any("put on #202020, because white would hide a part of the outline" in note for note in made.notes)
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


@pytest.mark.parametrize(
    ("fills", "ground"),
    [
        (["#007229", "#ffffff", "#e11b22"], (32, 32, 32)),
        (["#ffffff", "#1c57a7", "#e11b22"], (32, 32, 32)),
        (["#2b5797", "#f5c400", "#c1272d"], (255, 255, 255)),
        (["#ffffff", "#101010", "#ffffff"], (128, 128, 128)),
        (["#101010", "#202020", "#e11b22"], (255, 255, 255)),
    ],
)
def test_all_stripes_of_a_flag_are_seen(tmp_path: Path, fills: list[str], ground: tuple[int, int, int]) -> None:
    """A transparent margin around a flag; in its chart each stripe, in the middle, has another yarn than the margin."""
    flag = Image.new("RGBA", (128, 96))
    for number, fill in enumerate(fills):
        flag.paste(fill, (16 + 32 * number, 16, 48 + 32 * number, 80))
    made = make_charted(read_order(saved(flag, tmp_path), width="64cm", quality="10x10/dm"))
    knots, (rows, columns) = made.chart.knots, made.chart.knots.shape
    stripes = [knots[rows // 2, columns * share // 4] for share in (1, 2, 3)]
    assert read_picture(tmp_path / "art.png").ground == ground
    assert knots[1, 1] not in stripes
    assert all(check.ok for check in made.checks)


def test_an_outline_that_no_ground_shows_is_a_failed_check_unless_the_ground_is_given(tmp_path: Path) -> None:
    disc = Image.new("RGBA", (128, 128))
    for number, fill in enumerate(["#ffffff", "#202020", "#808080"]):
        ImageDraw.Draw(disc).pieslice((16, 16, 112, 112), 120 * number, 120 * (number + 1), fill=fill)
    order = {"width": "64cm", "quality": "10x10/dm"}
    made = make_charted(read_order(saved(disc, tmp_path), **order))
    check = next(check for check in made.checks if not check.ok)
    assert (check.name, check.value > 0.25) == ("outline of the picture hidden on its ground", True)
    assert "--ground" in check.cure
    assert all(check.ok for check in make_charted(read_order(tmp_path / "art.png", **order, ground="#9e2b25")).checks)


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


@pytest.mark.parametrize("box", [(20, 30, 50, 60), (0, 150, 120, 200), (198, 298, 200, 300)])
def test_a_note_has_the_crop_of_art_in_a_wide_margin(tmp_path: Path, box: tuple[int, int, int, int]) -> None:
    page = Image.new("RGBA", (200, 300))
    page.paste("#c1272d", box)
    note = read_picture(saved(page, tmp_path)).notes[-1]
    crop = note.split('"')[1]
    made = make_charted(read_order(tmp_path / "art.png", crop=crop, quality="10x10/dm"))
    red = np.isclose([yarn.srgb[0] for yarn in made.chart.yarns], 0xC1, atol=3)[made.chart.knots]
    page_share = (box[2] - box[0]) * (box[3] - box[1]) / (200 * 300)
    assert red.mean() > min(0.2, 10 * page_share)
    judge = Image.new("RGBA", (200, 300))
    left, top, right, bottom = (float(text.strip("%")) / 100 for text in crop.replace(" ", ",").split(","))
    judge.paste("#c1272d", (round(200 * left), round(300 * top), round(200 * right), round(300 * bottom)))
    assert (np.asarray(judge)[..., 3] >= np.asarray(page)[..., 3]).all()


def test_art_that_fills_its_page_has_no_such_note(tmp_path: Path) -> None:
    page = Image.new("RGBA", (200, 300))
    page.paste("#c1272d", (40, 60, 160, 240))
    assert read_picture(saved(page, tmp_path)).notes == ("transparent parts put on white",)
