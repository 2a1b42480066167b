"""Photographs of few colours are not taken for drawings: reduced to a palette, dithered or not, as GIF files are."""

from pathlib import Path

import numpy as np
import pytest
import skimage
from PIL import Image

from ilmek.carpet.exact import find_drawing
from ilmek.jobs.chart import make_charted
from ilmek.jobs.order import read_order

PHOTOS = Path(skimage.__file__).parent / "data"
NAMES = ("coffee.png", "chelsea.png", "astronaut.png", "camera.png", "ihc.png", "hubble_deep_field.jpg", "retina.jpg")


def photo(name: str, width: int) -> Image.Image:
    picture = Image.open(PHOTOS / name).convert("RGB")
    return picture.resize((width, round(width * picture.height / picture.width)), Image.Resampling.LANCZOS)


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize(("name", "width"), [*((name, 120) for name in NAMES), ("coffee.png", 360)])
def test_a_photo_of_few_colours_is_no_drawing(name: str, width: int) -> None:
    picture = photo(name, width)
    for colours in (16, 32, 64, 128, 256):
        palette = picture.quantize(colours, method=Image.Quantize.MEDIANCUT)
        for dither in (Image.Dither.NONE, Image.Dither.FLOYDSTEINBERG):
            few = picture.quantize(palette=palette, dither=dither)
            assert find_drawing(np.asarray(few.convert("RGB")), None, None) is None, (colours, dither)
    web = picture.convert("P", palette=Image.Palette.WEB)
    assert find_drawing(np.asarray(web.convert("RGB")), None, None) is None


def test_a_gif_of_a_photo_has_the_default_size(tmp_path: Path) -> None:
    photo("coffee.png", 300).quantize(64).save(tmp_path / "coffee.gif")
    chart = make_charted(read_order(tmp_path / "coffee.gif")).chart
    assert chart.reading.kind != "exact"
    assert chart.size.name == "seccade"
