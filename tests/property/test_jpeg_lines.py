"""Thin lines survive a JPEG with halved chroma: as many pieces as drawn, hardly a knot unlike the chart of the PNG.

Pillow writes and reads the files. The truth is the drawing, or the picture as it was before it became a JPEG.
"""

import io
from pathlib import Path

import numpy as np
import pytest
from drawings import FLAT, GOLD, GREEN, IVORY, MADDER, NAVY, Drawing, colours_in_cells, rendered
from PIL import Image, ImageDraw, ImageFont
from scipy import ndimage

from ilmek.arrays import Rgb
from ilmek.carpet.chart import Chart
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.flat.chroma import NOT_HALVED, halved_axes, whole_chroma
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.io.yarn_file import read_yarns

QUALITY = Quality(250.0, 250.0)
DATA = Path(__file__).parents[1] / "data"
YARNS = read_yarns(DATA / "rays-yarns.csv")
KINDS = {"4:2:0": 2, "4:2:2": 1}


def jpeg(rgb: Rgb, quality: int, subsampling: int = 2) -> Rgb:
    """A picture as it is read from a JPEG file; subsampling 0: 4:4:4, 1: 4:2:2, 2: 4:2:0."""
    file = io.BytesIO()
    Image.fromarray(rgb).save(file, format="JPEG", quality=quality, subsampling=subsampling)
    return np.asarray(Image.open(file))


def charted(rgb: Rgb, rows: int, columns: int) -> Chart:
    return make_chart(rgb, CarpetSize(columns / QUALITY.across, rows / QUALITY.along), QUALITY, YARNS)


def yarn(srgb: tuple[int, int, int]) -> int:
    """The yarn nearest to a colour."""
    labs = srgb_to_lab(np.array([srgb, *(one.srgb for one in YARNS)], dtype=np.uint8))
    return int(np.linalg.norm(labs[1:] - labs[0], axis=-1).argmin())


def pieces(mask: np.ndarray, least: int = 1) -> int:
    """The number of 8-connected pieces of at least so many points."""
    return int(np.count_nonzero(np.bincount(ndimage.label(mask, np.ones((3, 3)))[0].ravel())[1:] >= least))


@pytest.mark.parametrize(("quality", "unlike"), [(85, 100), (75, 400)])
def test_24_thin_rays_stay_one_piece(quality: int, unlike: int) -> None:
    picture = np.asarray(Image.open(DATA / "rays.png").convert("RGB"))
    drawn, chart = charted(picture, 450, 300), charted(jpeg(picture, quality), 450, 300)
    disc = slice(135, 315)
    assert pieces(drawn.knots[disc] == yarn(GOLD)) == pieces(chart.knots[disc] == yarn(GOLD)) == 1
    assert not np.any(chart.knots == yarn(GREEN))
    assert np.count_nonzero(chart.knots != drawn.knots) <= unlike
    mirrored = [np.count_nonzero(one.knots[disc] != one.knots[disc, ::-1]) for one in (drawn, chart)]
    assert mirrored[1] <= (1.2 if quality == 85 else 1.6) * mirrored[0]
    assert "halved chroma" in chart.reading.reason
    assert "halved chroma" not in drawn.reading.reason


def lattice(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Lines of 1.1 knots at 33 and 147 degrees in a border."""
    c, s = np.cos(np.radians(33)), np.sin(np.radians(33))
    lines = np.any([np.abs((t := s * x + sign * c * y + 0.4) - 9 * np.rint(t / 9)) < 0.55 for sign in (1, -1)], axis=0)
    inset = np.minimum(np.minimum(x, 60 - x), np.minimum(y, 72 - y))
    return np.where(inset < 6, 2, lines).astype(np.int64)


def lettering(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Three lines of letters, strokes of about a knot."""
    scale = 16
    sheet = Image.new("L", (60 * scale, 72 * scale), 0)
    for line, text in enumerate(("Zer af", "guldan", "1347 H")):
        font = ImageFont.load_default(size=15 * scale)
        ImageDraw.Draw(sheet).text((5 * scale, (6 + 20 * line) * scale), text, fill=255, font=font)
    ink = np.asarray(sheet) > 127
    return np.asarray(ink[(y * scale).astype(int), (x * scale).astype(int)], dtype=np.int64)


OWN = {
    "lattice": Drawing(lattice, (NAVY, GOLD, MADDER), lines=(1,)),
    "lettering": Drawing(lettering, (MADDER, IVORY), lines=(1,)),
}


@pytest.mark.parametrize("quality", [75, 85, 95])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", OWN)
def test_lines_have_as_many_pieces_as_drawn(name: str, kind: str, quality: int) -> None:
    drawing = OWN[name]
    picture = jpeg(rendered(drawing, 8 / 3, "smooth"), quality, KINDS[kind])
    chart = charted(picture, drawing.rows, drawing.columns)
    (line,) = drawing.lines
    fine = drawing.at(16 * drawing.rows, 16 * drawing.columns) == line
    # A piece of less than a knot, at a corner of the lattice, may be left out.
    assert pieces(fine, 16**2) <= pieces(chart.knots == yarn(drawing.colours[line])) <= pieces(fine)
    of_cells = np.zeros((drawing.rows, drawing.columns, len(YARNS)), dtype=bool)
    for number, colour in enumerate(drawing.colours):
        of_cells[..., yarn(colour)] |= colours_in_cells(drawing)[..., number]
    foreign = ~np.take_along_axis(of_cells, chart.knots[..., None].astype(int), axis=2)
    assert foreign.mean() <= 1e-3


@pytest.mark.parametrize("subsampling", [1, 2])
@pytest.mark.parametrize(("name", "left"), [("rosette", 0.9), ("star", 0.9), ("lattice", 0.65), ("lettering", 0.7)])
def test_chroma_comes_nearer_to_the_drawing_and_turns_with_it(name: str, left: float, subsampling: int) -> None:
    drawn = rendered({**FLAT, **OWN}[name], 8 / 3, "smooth")
    read = jpeg(drawn, 85, subsampling)
    assert halved_axes(read) == (0, 0 if subsampling == 2 else NOT_HALVED)
    whole = whole_chroma(read)
    chroma = [np.asarray(Image.fromarray(one).convert("YCbCr"), dtype=float)[..., 1:] for one in (drawn, read, whole)]
    assert np.abs(chroma[2] - chroma[0]).mean() < left * np.abs(chroma[1] - chroma[0]).mean()
    luma = [np.asarray(Image.fromarray(one).convert("L"), dtype=int) for one in (read, whole)]
    assert np.mean(np.abs(luma[1] - luma[0]) <= 1) > 0.99  # but where a code of red, green or blue is clipped
    for axes in ((1, 0, 2), (0, 1, 2)):
        turned = [np.ascontiguousarray(one.transpose(axes)[::-1]) for one in (read, whole)]
        assert np.array_equal(whole_chroma(turned[0]), turned[1])


def test_a_crop_by_an_odd_number_of_pixels_is_found() -> None:
    read = jpeg(rendered(FLAT["star"], 8 / 3, "smooth"), 85)
    assert halved_axes(np.ascontiguousarray(read[1:, 3:])) == (1, 1)
    assert halved_axes(np.ascontiguousarray(read[2:, 1:])) == (1, 0)


@pytest.mark.parametrize("name", FLAT)
def test_whole_chroma_is_left_alone(name: str) -> None:
    drawn = rendered(FLAT[name], 2, "smooth")
    doubled = np.asarray(Image.fromarray(drawn).resize((240, 288), Image.Resampling.BILINEAR))
    for picture in (drawn, rendered(FLAT[name], 2, "hard"), jpeg(drawn, 85, 0), doubled):
        assert whole_chroma(picture) is picture
