"""Drawings and photographs as they come from drawing programs, JPEG files and scanners, each charted and measured.

The truth of a drawing is the drawing itself, sampled 8 x 8 times a knot; what is measured on the chart shares nothing
with the reading of pictures.
"""

from pathlib import Path

import numpy as np
import pytest
import skimage
from drawings import FINISHES, FLAT, Drawing, colours_in_cells, rendered, sunset, vignette
from PIL import Image
from scipy import ndimage

from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.colour import LINEAR, srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.flat import looks_flat
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import ReadParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import yarn_labs
from ilmek.io.yarn_file import default_yarns

QUALITY = Quality(250.0, 250.0)
EIGHT = np.ones((3, 3), dtype=int)
YARNS = default_yarns()
PHOTOGRAPHS = ("astronaut.png", "chelsea.png", "coffee.png", "rocket.jpg")
DULL = (
    "brick.png",
    "camera.png",
    "cell.png",
    "clock_motion.png",
    "coins.png",
    "grass.png",
    "gravel.png",
    "hubble_deep_field.jpg",
    "ihc.png",
    "microaneurysms.png",
    "moon.png",
    "motorcycle_left.png",
    "page.png",
    "retina.jpg",
    "text.png",
)
"""Photographs of low contrast, of few tones, of an even texture, or nearly all black."""
ARTWORK = ("horse.png", "logo.png", "phantom.png")


def charted(rgb: np.ndarray, rows: int, columns: int, reading: str = "auto", halftone: float | None = None) -> Chart:
    size = CarpetSize(columns / QUALITY.across, rows / QUALITY.along)
    return make_chart(rgb, size, QUALITY, YARNS, reading=ReadParams(reading=reading, halftone=halftone))


def yarn_of(drawing: Drawing) -> np.ndarray:
    """The yarn nearest to each colour of a drawing."""
    labs = srgb_to_lab(np.array(drawing.colours, dtype=np.uint8))
    return delta_e_2000(labs[:, None], yarn_labs(YARNS)[None]).argmin(axis=1)


def foreign(chart: Chart, drawing: Drawing) -> float:
    """Share of the knots whose yarn is that of no colour of their cell."""
    known = np.zeros((*chart.knots.shape, len(YARNS)), dtype=bool)
    for number, yarn in enumerate(yarn_of(drawing)):
        known[..., yarn] |= colours_in_cells(drawing)[..., number]
    return 1 - np.take_along_axis(known, chart.knots[..., None].astype(int), axis=2).mean()


def pieces(mask: np.ndarray, least: float = 1) -> int:
    """The number of 8-connected pieces of at least so many points."""
    return int(np.count_nonzero(np.bincount(ndimage.label(mask, EIGHT)[0].ravel())[1:] >= least))


@pytest.mark.matrix(light=10)
@pytest.mark.parametrize("finish", FINISHES)
@pytest.mark.parametrize("name", FLAT)
def test_a_drawing_is_charted_as_it_is_drawn(name: str, finish: str) -> None:
    drawing = FLAT[name]
    chart = charted(rendered(drawing, 4, finish), drawing.rows, drawing.columns)
    assert chart.reading.kind in ("flat", "exact")
    assert set(np.unique(chart.knots)) == set(yarn_of(drawing))
    assert foreign(chart, drawing) <= 1e-3
    for axis in drawing.symmetric:
        assert np.array_equal(chart.knots, chart.knots[:, ::-1] if axis == "x" else chart.knots[::-1])
    for line in drawing.lines:
        fine = drawing.at(drawing.rows * 16, drawing.columns * 16) == line
        # A piece of less than a knot, at a corner of the picture, may be left out.
        assert pieces(fine, 16**2) <= pieces(chart.knots == yarn_of(drawing)[line]) <= pieces(fine)


@pytest.mark.parametrize("name", FLAT)
def test_a_drawing_of_one_pixel_a_knot_is_not_changed(name: str) -> None:
    drawing = FLAT[name]
    chart = charted(rendered(drawing, 1, "hard"), drawing.rows, drawing.columns)
    assert chart.reading.kind == "exact"
    assert chart.reading.changed == 0
    assert np.array_equal(chart.knots, yarn_of(drawing)[drawing.at(drawing.rows, drawing.columns)])


def from_afar(srgb: np.ndarray) -> np.ndarray:
    """CIELAB of a picture as seen from afar: linear light blurred by 3 knots."""
    light = ndimage.gaussian_filter(LINEAR[srgb], (3, 3, 0), mode="nearest")
    codes = np.where(light <= 0.04045 / 12.92, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)
    return srgb_to_lab(np.rint(255 * codes).astype(np.uint8))


def far_difference(chart: Chart, rgb: np.ndarray) -> float:
    shades = np.array([yarn.srgb for yarn in chart.yarns], dtype=np.uint8)
    return float(delta_e_2000(from_afar(shades[chart.knots]), from_afar(rgb)).mean())


@pytest.mark.parametrize("picture", [sunset, vignette], ids=["sunset", "vignette"])
def test_a_gradient_is_a_photo_and_a_halftone_shows_it(picture: object) -> None:
    rgb = picture()  # type: ignore[operator] # a function that draws
    rows, columns = rgb.shape[:2]
    size = CarpetSize(columns / QUALITY.across, rows / QUALITY.along)
    plain = make_chart(rgb, size, QUALITY, YARNS, reading=ReadParams.read({"halftone": "0%"}))
    toned = make_chart(rgb, size, QUALITY, YARNS)
    assert plain.reading.kind == toned.reading.kind == "photo"
    assert far_difference(toned, rgb) <= min(5.0, 0.8 * far_difference(plain, rgb))
    assert toned.lone_fraction <= 0.01


def supplied(name: str) -> np.ndarray:
    """A picture of scikit-image."""
    with Image.open(Path(skimage.__file__).parent / "data" / name) as image:
        return np.asarray(image.convert("RGB"))


@pytest.mark.parametrize("name", PHOTOGRAPHS)
def test_a_photograph_is_read_as_one(name: str) -> None:
    rgb = supplied(name)
    rows, columns = rgb.shape[0] // 3, rgb.shape[1] // 3
    chart = charted(rgb, rows, columns, halftone=0.0)
    assert chart.reading.kind == "photo"
    assert chart.reading.foreign is None
    assert chart.reading.least_delta_e <= chart.reading.mean_delta_e <= 1.05 * chart.reading.least_delta_e


@pytest.mark.matrix(light=5)
@pytest.mark.parametrize("name", DULL)
def test_a_photograph_of_few_tones_is_no_drawing(name: str) -> None:
    rgb = supplied(name)
    assert not looks_flat(rgb).is_flat
    assert not looks_flat((0.4 * rgb + 90).astype(np.uint8)).is_flat


@pytest.mark.parametrize("name", ARTWORK)
def test_artwork_is_a_drawing_with_grain_too(name: str) -> None:
    rgb = supplied(name)
    grain = np.random.default_rng(3).normal(scale=5, size=rgb.shape)
    assert looks_flat(rgb).is_flat
    assert looks_flat(np.rint(rgb + grain).clip(0, 255).astype(np.uint8)).is_flat


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("pixels", [1.7, 2.5])
@pytest.mark.parametrize("finish", FINISHES)
def test_a_drawing_is_seen_at_any_number_of_pixels_a_knot(finish: str, pixels: float) -> None:
    for name in ("checks", "dots", "grid", "kilim steps", "zigzag"):
        assert looks_flat(rendered(FLAT[name], pixels, finish)).is_flat, name
