"""Drawings on the grid of knots: lines that hold, colours that are there, charts that mirror with their picture."""

import io
from pathlib import Path

import numpy as np
import pytest
from drawings import FLAT, colours_in_cells, rendered
from PIL import Image, ImageDraw
from scipy import ndimage

from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.flat import flat_design, looks_flat, looks_like_itself
from ilmek.carpet.flat.survey import survey
from ilmek.carpet.flat.true_colours import true_colours
from ilmek.carpet.nearest_colour import nearest
from ilmek.carpet.yarn import yarn_labs
from ilmek.io.yarn_file import default_yarns

NAVY, IVORY, MADDER, GOLD, BLACK = (31, 49, 87), (235, 223, 195), (158, 43, 37), (200, 149, 60), (30, 27, 29)
EIGHT = np.ones((3, 3), dtype=int)
ROOT = Path(__file__).parents[2]
Picture = np.ndarray


def pieces(mask: np.ndarray) -> int:
    return int(ndimage.label(mask, EIGHT)[1])


def small_patches(knots: np.ndarray) -> int:
    sizes = [np.bincount(ndimage.label(knots == yarn, EIGHT)[0].ravel())[1:] for yarn in np.unique(knots)]
    return int(np.count_nonzero(np.concatenate(sizes) <= 3))


def yarns_of(rgb: Picture) -> np.ndarray:
    """The nearest yarn of each pixel or knot."""
    codes, position = np.unique(rgb.reshape(-1, 3) @ np.array([65536, 256, 1]), return_inverse=True)
    colours = np.stack([codes >> 16, (codes >> 8) & 255, codes & 255], axis=-1).astype(np.uint8)
    return nearest(srgb_to_lab(colours), yarn_labs(default_yarns()))[0][position].reshape(rgb.shape[:2])


def foreign_knots(knots: np.ndarray, pixels: np.ndarray) -> int:
    """Knots whose yarn is that of no pixel of their cell; a whole number of pixels a knot."""
    rows, columns = knots.shape
    cells = pixels.reshape(rows, len(pixels) // rows, columns, -1)
    return int(np.count_nonzero(~np.any(cells == knots[:, None, :, None], axis=(1, 3))))


def line_picture(pixels: float, degrees: float, width: float, offset: float, finish: str) -> Picture:
    """A navy line through the middle of 40 × 40 knots."""
    fine = 1 if finish == "hard" else 4
    side = round(40 * pixels)
    axis = (np.arange(side * fine) + 0.5) * 40 / (side * fine) - 20
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    cover = np.abs(s * axis[None] - c * axis[:, None] + offset) < width / 2
    cover = cover.reshape(side, fine, side, fine).mean(axis=(1, 3))[..., None]
    rgb = np.array(IVORY) * (1 - cover) + np.array(NAVY) * cover
    if finish == "grain":
        rgb = rgb + np.random.default_rng(3).normal(scale=5, size=rgb.shape)
    rgb = np.rint(rgb.clip(0, 255)).astype(np.uint8)
    if finish == "jpeg":
        file = io.BytesIO()
        Image.fromarray(rgb).save(file, format="JPEG", quality=60, subsampling=0)
        return np.asarray(Image.open(file).convert("RGB"))
    return rgb


def is_line(rgb: Picture) -> np.ndarray:
    ground, line = (np.abs(rgb.astype(int) - colour).sum(axis=-1) for colour in (IVORY, NAVY))
    return line < ground


@pytest.mark.matrix(light=5)
@pytest.mark.parametrize("finish", ["hard", "smooth", "grain", "jpeg"])
@pytest.mark.parametrize("pixels", [2.5, 4.0, 5.7])
def test_a_line_of_any_angle_stays_in_one_piece_and_keeps_its_width(pixels: float, finish: str) -> None:
    rng = np.random.default_rng(7)
    for degrees, width, offset in zip(
        [0.0, 45.0, *rng.uniform(0, 180, 10)],
        rng.choice([0.6, 0.7, 1.0, 1.5, 3.0], 12),
        rng.uniform(-0.45, 0.45, 12),
        strict=True,
    ):
        mask = is_line(flat_design(line_picture(pixels, degrees, width, offset, finish), (40, 40)).colours)
        name = f"{degrees:.1f}° {width} knots"
        assert pieces(mask) == 1, name
        assert max(np.count_nonzero(mask.any(axis=0)), np.count_nonzero(mask.any(axis=1))) >= 38, name
        length = 40 / max(abs(np.cos(np.radians(degrees))), abs(np.sin(np.radians(degrees))))
        assert mask.sum() / length <= width + 1, name


def test_two_lines_with_a_knot_between_them_do_not_join() -> None:
    axis = (np.arange(160) + 0.5) / 4
    for degrees in (0, 20, 45, 70, 90):
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        apart = np.abs(np.abs(s * (axis[None] - 20) - c * (axis[:, None] - 20)) - 1.3)
        rgb = np.where((apart < 0.5)[..., None], NAVY, IVORY).astype(np.uint8)
        assert pieces(is_line(flat_design(rgb, (40, 40)).colours)) == 2, degrees


def test_a_dot_between_four_knots_keeps_one() -> None:
    for y, x in ((80, 80), (82, 79), (81, 84)):
        rgb = np.full((160, 160, 3), IVORY, dtype=np.uint8)
        rgb[y - 1 : y + 2, x - 1 : x + 2] = NAVY
        assert 1 <= is_line(flat_design(rgb, (40, 40)).colours).sum() <= 4


def scribble(rng: np.random.Generator, height: int, width: int, smooth: bool) -> Picture:
    fine = 4 if smooth else 1
    image = Image.new("RGB", (width * fine, height * fine), IVORY)
    pen = ImageDraw.Draw(image)
    for _ in range(25):
        colour = (NAVY, MADDER, IVORY, GOLD, BLACK)[rng.integers(5)]
        corners = [(int(rng.integers(width * fine)), int(rng.integers(height * fine))) for _ in range(3)]
        if rng.random() < 0.5:
            pen.line(corners, fill=colour, width=int(rng.integers(1, 3 * fine)))
        else:
            pen.polygon(corners, fill=colour)
    return np.asarray(image.resize((width, height), Image.Resampling.BOX) if smooth else image)


@pytest.mark.parametrize("seed", range(6))
def test_a_mirrored_or_turned_picture_gives_the_mirrored_or_turned_chart(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows, columns = (int(side) for side in rng.integers(12, 40, 2))
    scale = rng.uniform(0.7, 5)
    rgb = scribble(rng, round(rows * scale), round(columns * scale), seed % 2 == 0)
    if seed % 3 == 0:
        rgb = np.clip(rgb + rng.integers(-6, 7, rgb.shape), 0, 255).astype(np.uint8)
    colours = flat_design(rgb, (rows, columns)).colours
    for change in (np.fliplr, np.flipud):
        assert np.array_equal(flat_design(change(rgb), (rows, columns)).colours, change(colours))
    assert np.array_equal(flat_design(np.rot90(rgb), (columns, rows)).colours, np.rot90(colours))
    for whole, many in ((np.concatenate([rgb, rgb[:, ::-1]], axis=1), 2 * columns), (rgb[:, ::-1][:, 1:], 0)):
        if many == 0:
            whole, many = np.concatenate([rgb, whole], axis=1), 2 * columns - 1
        both = flat_design(whole, (rows, many))
        assert np.array_equal(both.colours, both.colours[:, ::-1])
        assert "vertical" in both.symmetric


@pytest.mark.matrix(light=8)
@pytest.mark.parametrize("name", ["eyes", "rosette", "star", "borders", "kilim steps", "letters", "scales"])
@pytest.mark.parametrize("finish", ["hard", "smooth", "grain"])
def test_no_knot_has_a_colour_that_its_cell_has_not(name: str, finish: str) -> None:
    drawing = FLAT[name]
    read = flat_design(rendered(drawing, 4, finish), (drawing.rows, drawing.columns))
    true = yarns_of(np.array([drawing.colours], dtype=np.uint8))[0]
    knots = yarns_of(read.colours)
    assert set(np.unique(knots)) <= set(true)
    present = np.any([colours_in_cells(drawing)[..., i] & (knots == yarn) for i, yarn in enumerate(true)], axis=0)
    assert 1 - present.mean() <= 1e-3
    assert read.foreign <= 1e-3 * knots.size


def test_the_medallion_in_its_own_yarns() -> None:
    rgb = np.asarray(Image.open(ROOT / "examples" / "medallion.png").convert("RGB"))
    read = flat_design(rgb, (450, 300))
    knots = yarns_of(read.colours)
    assert len(read.true) == 12
    assert read.symmetric == ("vertical", "horizontal")
    assert np.array_equal(knots, knots[:, ::-1])
    assert np.array_equal(knots, knots[::-1])
    assert read.foreign <= 10
    assert foreign_knots(knots, yarns_of(rgb)) <= 10  # area averages: 8,974
    assert small_patches(knots) <= 80
    black = yarns_of(np.array([[BLACK]], dtype=np.uint8))[0, 0]
    star = knots[205:245, 130:170] == black
    assert pieces(star) == 1


def test_a_gradient_is_no_drawing_and_a_drawing_is_one() -> None:
    sky = np.linspace(IVORY, NAVY, 300)[:, None].repeat(200, axis=1).round().astype(np.uint8)
    assert not looks_flat(sky).is_flat
    assert looks_flat(rendered(FLAT["rosette"], 4, "jpeg")).is_flat


def test_a_drawing_looks_like_itself_and_a_small_picture_of_many_tones_or_a_plant_of_fine_leaves_does_not() -> None:
    for name in FLAT:
        drawn = rendered(FLAT[name], 4, "smooth")
        assert looks_like_itself(drawn, looks_flat(drawn).true), name
    rng = np.random.default_rng(5)
    blade = np.full((16, 16, 3), 255, dtype=np.uint8)
    blade[3:13, 3:13] = np.array([96, 104, 118, 131, 150])[rng.integers(0, 5, (10, 10, 1))]
    plant = np.full((300, 300, 3), 255, dtype=np.uint8)
    plant[60:240, 60:240] = np.array([(12, 12, 12), (150, 70, 160), (60, 120, 50)])[
        rng.choice(3, (180, 180), p=[0.8, 0.1, 0.1])
    ]
    black = true_colours(
        survey(np.where(plant < 200, 12, 255).astype(np.uint8))
    )  # what is seen of it by its even areas
    assert not looks_like_itself(plant, black)
    few = np.where(blade < 255, 118, 255).astype(np.uint8)
    assert not looks_like_itself(blade, true_colours(survey(few)))
    assert looks_like_itself(few, true_colours(survey(few)))


def test_a_photo_in_an_even_frame_is_no_drawing() -> None:
    grain = np.random.default_rng(2).normal(scale=9, size=(200, 200, 3))
    light = np.linspace(40, 200, 200)[:, None, None] * np.array([1.0, 0.8, 0.6]) + grain
    framed = np.pad(light.clip(0, 255).astype(np.uint8), ((150, 150), (150, 150), (0, 0)), constant_values=255)
    assert not looks_flat(framed).is_flat


def test_a_picture_coarser_than_the_grid_gets_no_new_colours() -> None:
    rgb = scribble(np.random.default_rng(1), 30, 20, smooth=False)
    colours = flat_design(rgb, (90, 60)).colours
    assert np.array_equal(colours, rgb.repeat(3, axis=0).repeat(3, axis=1))
