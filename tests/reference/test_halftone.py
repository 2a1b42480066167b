"""Halftone of skies and photographs, at viewing distance, beside Pillow's error diffusion.

Viewing distance: CIEDE2000 after a Gaussian blur of linear light, of 3 knots; by scikit-image.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import skimage
from PIL import Image
from scipy import ndimage
from skimage.color import deltaE_ciede2000, rgb2lab

from ilmek.carpet import halftone
from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.design import bands
from ilmek.carpet.halftone import CELL, STEP, draw_halftone
from ilmek.carpet.mixtures import CHROMA, CONTRAST, NEAR, WIDER
from ilmek.carpet.palette import distinct_colours, nearest_yarns, paint
from ilmek.carpet.palette_rules import PaletteParams
from ilmek.carpet.patches import count_patches
from ilmek.carpet.proposal import propose_shades
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import ReadParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.tally import tally_of
from ilmek.carpet.yarn import Yarn, yarn_labs
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


def codes_of(knots: np.ndarray, yarns: tuple[Yarn, ...] = YARNS) -> np.ndarray:
    return np.array([yarn.srgb for yarn in yarns], dtype=np.uint8)[knots]


def seen(codes: np.ndarray, spread: float) -> np.ndarray:
    """CIELAB after a blur of linear light."""
    share = codes / 255
    light = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)
    blurred = ndimage.gaussian_filter(light, (spread, spread, 0))
    encoded = np.where(blurred <= 0.0031308, 12.92 * blurred, 1.055 * np.maximum(blurred, 1e-9) ** (1 / 2.4) - 0.055)
    return np.asarray(rgb2lab(encoded))


def far(rgb: np.ndarray, knots: np.ndarray, yarns: tuple[Yarn, ...] = YARNS) -> float:
    """Mean CIEDE2000 at viewing distance."""
    return float(deltaE_ciede2000(seen(rgb, 3), seen(codes_of(knots, yarns), 3)).mean())


def chart(rgb: np.ndarray, yarns: tuple[Yarn, ...] = YARNS, **reading: float) -> Chart:
    size, quality = CarpetSize(rgb.shape[1] / 1000, rgb.shape[0] / 1000), Quality(1000.0, 1000.0)
    every = PaletteParams(neutral="no")
    return make_chart(rgb, size, quality, yarns, reading=ReadParams(reading="photo", **reading), palette=every)


def pillow(rgb: np.ndarray, yarns: tuple[Yarn, ...] = YARNS) -> np.ndarray:
    codes = [list(yarn.srgb) for yarn in yarns]
    palette = Image.new("P", (1, 1))
    palette.putpalette([code for colour in codes + codes[:1] * (256 - len(codes)) for code in colour])
    quantised = np.asarray(Image.fromarray(rgb).quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG))
    return np.where(quantised < len(yarns), quantised, 0).astype(np.uint8)


def photo(name: str, longest: int = 200) -> np.ndarray:
    """A photograph of scikit-image, a pixel a knot."""
    with Image.open(Path(skimage.__file__).parent / "data" / name) as image:
        size = tuple(round(side * longest / max(image.size)) for side in image.size)
        return np.asarray(image.convert("RGB").resize(size, Image.Resampling.BOX))


def own_shades(rgb: np.ndarray) -> tuple[Yarn, ...]:
    """Sixteen yarns dyed to the photo."""
    shades = propose_shades(distinct_colours(rgb), 16, drawn=False)
    labs = srgb_to_lab(np.array([shade.srgb for shade in shades], dtype=np.uint8)).tolist()
    return tuple(
        replace(yarn, name=shade.hex, srgb=shade.srgb, lab=tuple(lab))
        for yarn, shade, lab in zip(YARNS, shades, labs, strict=False)
    )


UNSEEN = 0.5
"""Mean CIEDE2000 at viewing distance below which nothing is seen, whatever a peer reaches."""


@pytest.mark.parametrize("name", ["astronaut.png", "chelsea.png", "coffee.png", "rocket.jpg", "camera.png"])
@pytest.mark.parametrize("own", [False, True], ids=["wool", "own shades"])
def test_the_default_of_a_photo_at_viewing_distance(name: str, own: bool) -> None:
    rgb = photo(name)
    yarns = own_shades(rgb) if own else YARNS
    made, plain, peer = chart(rgb, yarns), chart(rgb, yarns, halftone=0.0), pillow(rgb, yarns)
    assert far(rgb, made.knots, yarns) <= max(1.10 * far(rgb, peer, yarns), UNSEEN)
    assert far(rgb, made.knots, yarns) <= max(0.9 * far(rgb, plain.knots, yarns), UNSEEN)
    assert made.lone_fraction <= 0.01 < tally_of(peer, len(yarns)).lone / peer.size
    assert "(without: --halftone 0%)" in made.reading.reason
    assert "(with: --halftone 100%)" in plain.reading.reason


@pytest.mark.parametrize("name", ["astronaut.png", "chelsea.png", "coffee.png"])
def test_no_dot_contrasts_with_its_tone(name: str) -> None:
    rgb = photo(name)[:126]
    made, dots = draw_halftone(nearest_knots(rgb), rgb, LABS, 1.0, off=9.0)
    where = np.repeat(np.repeat(dots, CELL, axis=0), CELL, axis=1)[: len(rgb), : rgb.shape[1]]
    rgb, made = rgb[: len(where), : where.shape[1]], made[: len(where), : where.shape[1]]
    tones, yarns = seen(rgb, 0), seen(codes_of(made), 0)
    contrast, nearest = deltaE_ciede2000(tones, yarns), deltaE_ciede2000(tones, seen(codes_of(nearest_knots(rgb)), 0))
    slack = STEP  # a tone is rounded, and a knot of a smooth cell is not its mean
    assert np.all((contrast <= CONTRAST + slack)[where] | (contrast <= nearest + slack)[where])
    limit = np.minimum(CONTRAST, NEAR + WIDER * (nearest + 2.0) ** 2)
    assert np.mean((contrast <= limit + 2.0)[where]) > 0.98
    chroma = np.hypot(*np.moveaxis(yarns - tones, -1, 0)[1:]) / (1 + 0.045 * np.hypot(tones[..., 1], tones[..., 2]))
    assert np.mean((chroma <= CHROMA)[where] | (contrast <= nearest + slack)[where]) > 0.98


def ripples(seed: int) -> np.ndarray:
    """Sand: low waves along a field that bends, with grain."""
    rng = np.random.default_rng(seed)
    bent = ndimage.gaussian_filter(rng.normal(0, 1, (150, 150)), 12) * 90
    light = 7 * np.sin((np.mgrid[:150, :150][0] + bent) / 1.6) + rng.normal(0, 3, (150, 150))
    return np.clip(np.array([196, 190, 166]) + light[..., None], 0, 255).astype(np.uint8)


TEXTURES = {
    "brick": (lambda: photo("brick.png", 150), 0.96),
    "sand": (lambda: ripples(1), 0.9),
    "other sand": (lambda: ripples(2), 0.9),
}
"""Textures, and least correlation of the lightness of their charts; with dots in them it was 0.95 and 0.82."""


@pytest.mark.parametrize("name", TEXTURES)
def test_a_texture_of_its_own_shades_is_not_hidden_by_dots(name: str) -> None:
    picture, least = TEXTURES[name]
    rgb = picture()
    yarns = own_shades(rgb)
    made = chart(rgb, yarns)
    tones, tied = (rgb2lab(codes)[..., 0].ravel() for codes in (rgb, codes_of(made.knots, yarns)))
    assert np.corrcoef(tones, tied)[0, 1] > least


@pytest.mark.parametrize("name", ["chelsea.png", "coffee.png"])
def test_dots_of_own_shades_hardly_contrast(name: str) -> None:
    rgb = photo(name)
    yarns = own_shades(rgb)
    colours, labs = distinct_colours(rgb), yarn_labs(yarns)
    index, off = nearest_yarns(colours, labs)
    mean = float(np.average(off, weights=colours.counts))
    made, dots = draw_halftone(paint(rgb, colours, index), rgb, labs, 1.0, off=mean)
    where = np.repeat(np.repeat(dots, CELL, axis=0), CELL, axis=1)
    rgb, made = rgb[: len(where), : where.shape[1]], made[: len(where), : where.shape[1]]
    contrast = deltaE_ciede2000(seen(rgb, 0), seen(codes_of(made, yarns), 0))[where[: len(rgb), : rgb.shape[1]]]
    assert np.quantile(contrast, 0.98) <= NEAR + WIDER * mean**2 + 3.0 < 0.6 * CONTRAST


def test_greys_of_coloured_yarns_have_no_opposing_hues() -> None:
    rgb = np.repeat(np.arange(256, dtype=np.uint8)[None, :, None], 60, axis=0).repeat(3, axis=2)
    tied = {YARNS[yarn].name for yarn in np.unique(chart(rgb).knots)}
    assert not tied & {"rose", "terracotta", "madder red", "sage green", "weld yellow", "gold"}


def nearest_knots(rgb: np.ndarray) -> np.ndarray:
    colours = distinct_colours(rgb)
    return paint(rgb, colours, nearest_yarns(colours, LABS)[0])


@pytest.mark.parametrize(("name", "most"), [("sunset", 3.2), ("dusk", 4.0), ("greys", 4.2)])
def test_a_sky_at_viewing_distance(name: str, most: float) -> None:
    rgb = sky(name)
    plain, made, peer = chart(rgb, halftone=0.0), chart(rgb), pillow(rgb)
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


def test_lines_and_areas_of_a_yarn_stay() -> None:
    rgb = np.full((80, 80, 3), SRGB[5], dtype=np.uint8)
    rgb[20:60, 20:60] = SRGB[2]
    rgb[30:50, 60:] = (120, 110, 115)
    rgb[39, 64:] = (0, 0, 0)
    knots = nearest_knots(rgb)
    made, drawn = draw_halftone(knots, rgb, LABS, 1.0, off=9.0)
    same = np.ones((80, 80), dtype=bool)
    same[30:50, 60:] = False
    same[39, 64:] = True
    assert np.mean(made[same] == knots[same]) > 0.998  # beside an outline what is carried on moves an edge
    assert np.array_equal(made[39, 64:], knots[39, 64:])
    assert not np.array_equal(made, knots)
    assert drawn.any()


def test_confetti_keeps_the_pattern() -> None:
    rgb = sky("sunset", 120, 90)
    assert np.array_equal(chart(rgb, halftone=1.0, least_patch=12).knots, chart(rgb, halftone=1.0, least_patch=0).knots)


@pytest.mark.parametrize("shape", [(1, 9), (9, 1), (5, 7), (64, 3)])
def test_any_grid(shape: tuple[int, int]) -> None:
    rgb = np.full((*shape, 3), (120, 110, 115), dtype=np.uint8)
    made, drawn = draw_halftone(np.full(shape, 15, dtype=np.uint8), rgb, LABS, 1.0, off=9.0)
    assert made.shape == shape
    assert drawn.shape == (max(1, shape[0] // CELL), max(1, shape[1] // CELL))


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
