"""Halftone of a sunset on the sixteen wools, at viewing distance, beside Pillow's error diffusion.

Viewing distance: CIEDE2000 after a Gaussian blur of linear light, of 3 knots.
"""

import numpy as np
import pytest
from PIL import Image
from scipy import ndimage

from ilmek.carpet import halftone
from ilmek.carpet.blue_noise import SIDE, blue_noise
from ilmek.carpet.chart import Chart, make_chart
from ilmek.carpet.colour import LINEAR, RGB_TO_XYZ, xyz_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.design import bands
from ilmek.carpet.halftone import CELL, draw_halftone
from ilmek.carpet.palette import distinct_colours, nearest_yarns, paint
from ilmek.carpet.palette_rules import PaletteParams
from ilmek.carpet.patches import count_patches
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import ReadParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.tally import tally_of
from ilmek.carpet.yarn import yarn_labs
from ilmek.errors import PictureError
from ilmek.io.yarn_file import default_yarns

YARNS = default_yarns()
LABS = yarn_labs(YARNS)
SRGB = np.array([yarn.srgb for yarn in YARNS], dtype=np.uint8)
SKIES = {
    "sunset": [(40, 50, 90), (130, 80, 100), (200, 110, 80), (225, 180, 100)],
    "dusk": [(30, 40, 80), (110, 70, 110), (190, 90, 80), (220, 140, 70), (235, 200, 120)],
    "greys": [(0, 0, 0), (255, 255, 255)],
}


def sky(name: str, rows: int = 450, columns: int = 300) -> np.ndarray:
    """A gradient from the top to the bottom, a little bent."""
    y, x = np.mgrid[0 : 1 : rows * 1j, 0 : 1 : columns * 1j]
    along = np.clip(y + 0.04 * np.sin(3 * x), 0, 1)
    stops = np.array(SKIES[name], dtype=float)
    channels = [np.interp(along, np.linspace(0, 1, len(stops)), channel) for channel in stops.T]
    return np.rint(np.stack(channels, axis=-1)).astype(np.uint8)


def far(rgb: np.ndarray, knots: np.ndarray) -> float:
    """Mean CIEDE2000 at viewing distance."""
    labs = [
        xyz_to_lab(ndimage.gaussian_filter(LINEAR[codes], (3, 3, 0)) @ RGB_TO_XYZ.T) for codes in (rgb, SRGB[knots])
    ]
    return float(delta_e_2000(*labs).mean())


def chart(rgb: np.ndarray, **reading: float) -> Chart:
    size, quality = CarpetSize(rgb.shape[1] / 1000, rgb.shape[0] / 1000), Quality(1000.0, 1000.0)
    every = PaletteParams(neutral="no")
    return make_chart(rgb, size, quality, YARNS, reading=ReadParams(reading="photo", **reading), palette=every)


def pillow(rgb: np.ndarray) -> np.ndarray:
    palette = Image.new("P", (1, 1))
    palette.putpalette([*SRGB.ravel().tolist(), *SRGB[0].tolist() * (256 - len(SRGB))])
    quantised = Image.fromarray(rgb).quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)
    return np.minimum(np.asarray(quantised), len(YARNS) - 1).astype(np.uint8)


@pytest.mark.parametrize(("name", "most"), [("sunset", 3.2), ("dusk", 4.0), ("greys", 4.2)])
def test_a_sky_at_viewing_distance(name: str, most: float) -> None:
    rgb = sky(name)
    plain, made, peer = chart(rgb), chart(rgb, halftone=1.0), pillow(rgb)
    assert far(rgb, plain.knots) > 9.0
    assert far(rgb, made.knots) < most
    assert far(rgb, made.knots) < far(rgb, peer)
    assert made.lone_fraction == 0.0
    assert tally_of(peer, len(YARNS)).lone / peer.size > 0.35
    assert count_patches(made.knots, CELL**2 - 1) == 0
    assert "patterns on" in made.reading.reason


def test_half_the_strength_lies_between() -> None:
    rgb = sky("dusk")
    none, half, full = (far(rgb, chart(rgb, halftone=share).knots) for share in (0.0, 0.5, 1.0))
    assert full < half < none


def test_no_pattern_at_outlines_nor_in_areas_of_a_yarn() -> None:
    rgb = np.full((80, 80, 3), SRGB[5], dtype=np.uint8)
    rgb[20:60, 20:60] = SRGB[2]
    rgb[30:50, 60:] = (120, 110, 115)
    rgb[39, 64:] = (0, 0, 0)
    colours = distinct_colours(rgb)
    knots = paint(rgb, colours, nearest_yarns(colours, LABS)[0])
    made, drawn = draw_halftone(knots, rgb, LABS, 1.0)
    same = np.ones((80, 80), dtype=bool)
    same[30:50, 60:] = False
    same[38:41, 64:] = True
    assert np.array_equal(made[same], knots[same])
    assert not np.array_equal(made, knots)
    assert drawn.any()


def test_confetti_keeps_the_pattern() -> None:
    rgb = sky("sunset", 120, 90)
    assert np.array_equal(chart(rgb, halftone=1.0, least_patch=12).knots, chart(rgb, halftone=1.0, least_patch=0).knots)


@pytest.mark.parametrize("shape", [(1, 9), (9, 1), (5, 7), (64, 3)])
def test_any_grid(shape: tuple[int, int]) -> None:
    rgb = np.full((*shape, 3), (120, 110, 115), dtype=np.uint8)
    made, drawn = draw_halftone(np.full(shape, 15, dtype=np.uint8), rgb, LABS, 1.0)
    assert made.shape == shape
    assert drawn.shape == (max(1, shape[0] // CELL), max(1, shape[1] // CELL))


def test_blue_noise_is_even_and_has_no_slow_waves() -> None:
    noise = blue_noise()
    assert sorted(noise.ravel().tolist()) == list(range(SIDE**2))
    for share in (0.1, 0.3, 0.5):
        power = np.abs(np.fft.fft2(noise < share * SIDE**2)) ** 2
        waves = np.hypot(*np.meshgrid(np.fft.fftfreq(SIDE), np.fft.fftfreq(SIDE)))
        slow = power[(waves > 0) & (waves < 0.1)].mean()
        assert slow < 0.08 * power[waves > 0.25].mean()


def test_a_drawing_has_no_halftone() -> None:
    rgb = np.full((40, 40, 3), SRGB[5], dtype=np.uint8)
    rgb[10:30, 10:30] = SRGB[0]
    with pytest.raises(PictureError, match="--read photo"):
        make_chart(rgb, CarpetSize(0.4, 0.4), Quality(100.0, 100.0), YARNS, reading=ReadParams(halftone=0.5))


def test_slices_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    rgb = sky("dusk", 61, 47)
    rgb[20:23, 10:30] = 0
    whole = chart(rgb, halftone=1.0).knots
    monkeypatch.setattr(halftone, "bands", lambda rows, columns, *_: bands(rows, columns, 300))
    assert np.array_equal(chart(rgb, halftone=1.0).knots, whole)
