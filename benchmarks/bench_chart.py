"""Picture to knot chart on the sixteen wools, beside Pillow, scikit-image, a majority vote and plain NumPy.

One table. The photo is a synthetic medallion of 2400 × 3600 (field, spandrels, three borders) with abrash (the slow
change of a dyed yarn from row to row) and the grain of a photograph, some 265 thousand distinct colours; a pixel is a
knot. Afar: after a blur of linear light by 3 knots. The drawings are those of the tests, with smooth edges and 4 × 4
pixels a knot: knots whose yarn is that of no colour of their cell, and pieces of lines too many or too few.
"""

import resource
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from scipy import ndimage
from skimage.color import rgb2lab

import ilmek
from ilmek.arrays import FloatArray, Indices, Rgb
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.colour import LINEAR, RGB_TO_XYZ, srgb_to_lab, xyz_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.design import bands
from ilmek.carpet.palette import distinct_colours, nearest_yarns, paint
from ilmek.carpet.quality import Quality
from ilmek.carpet.reading import ReadParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.tally import tally_of
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.io.yarn_file import yarns_from_records
from ilmek.jobs.charting import chart_of_order
from ilmek.jobs.order import CarpetOrder

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from drawings import FLAT, Drawing, colours_in_cells, rendered

Grid = tuple[int, int]
Method = Callable[[Rgb, Grid], Indices]

PIXELS = 4
"""Pixels a knot of the drawings, along each side."""

WIDTH, HEIGHT = 2400, 3600
SIZE, QUALITY = CarpetSize(2.4, 3.6), Quality(1000.0, 1000.0)


def medallion(width: int = WIDTH, height: int = HEIGHT, seed: int = 2) -> Rgb:
    """The test picture: no colour in it is a yarn's, every pixel has grain."""
    y, x = np.mgrid[-1 : 1 : height * 1j, -1 : 1 : width * 1j]
    across, along = x * width / height, y
    radius, angle = np.hypot(across, along), np.arctan2(along, across)
    border = np.minimum((1 - np.abs(x)) * width / height, 1 - np.abs(y))
    shape = radius - 0.36 - 0.05 * np.cos(16 * angle) - 0.06 * np.cos(4 * angle)
    vine = np.sin(38 * across + 3 * np.sin(17 * along)) * np.sin(38 * along + 3 * np.sin(17 * across))
    wave = np.sin(90 * (x + y)) * np.sin(90 * (x - y))
    layers: list[tuple[np.ndarray, tuple[int, int, int]]] = [
        (np.ones_like(x, dtype=bool), (150, 48, 40)),
        (vine > 0.55, (205, 160, 80)),
        (vine < -0.62, (60, 80, 60)),
        (np.hypot(1 - np.abs(x), (1 - np.abs(y)) * 1.5) < 0.62, (42, 62, 105)),
        (shape < 0, (230, 218, 190)),
        (shape < -0.03, (38, 48, 84)),
        ((shape < -0.05) & (vine > 0.3), (190, 110, 100)),
        (radius < 0.14 + 0.02 * np.cos(8 * angle), (110, 32, 36)),
        (border < 0.20, (228, 212, 178)),
        (border < 0.185, (70, 44, 32)),
        ((border < 0.185) & (wave > 0.25), (150, 165, 110)),
        ((border < 0.185) & (wave < -0.3), (180, 90, 60)),
        (border < 0.06, (226, 200, 150)),
        (border < 0.05, (120, 150, 180)),
        (border < 0.02, (36, 30, 28)),
    ]
    picture = np.zeros((height, width, 3))
    for where, colour in layers:
        picture[where] = colour
    rng = np.random.default_rng(seed)
    abrash = np.convolve(rng.normal(size=height + 200), np.ones(201) / 201, "valid") * 60
    grain = rng.normal(scale=4.2, size=(height, width, 1)) + rng.normal(scale=3.0, size=(height, width, 3))
    return np.asarray(np.clip(np.rint(picture + abrash[:, None, None] + grain), 0, 255), dtype=np.uint8)


def wool() -> tuple[Yarn, ...]:
    """The sixteen shipped yarns."""
    text = (Path(ilmek.__file__).parent / "data" / "wool16.toml").read_text(encoding="utf-8")
    return yarns_from_records(tomllib.loads(text)["yarn"])


WOOL = wool()
LABS = yarn_labs(WOOL)
SRGB = np.array([yarn.srgb for yarn in WOOL], dtype=np.uint8)


def brute_force(rgb: Rgb, labs: FloatArray) -> Indices:
    """CIEDE2000 of every knot to every yarn, as arrays of plain NumPy."""
    pixels = srgb_to_lab(rgb)
    differences = np.stack([ciede2000_arrays(pixels, lab) for lab in labs])
    return np.asarray(differences.argmin(axis=0), dtype=np.uint8)


def ciede2000_arrays(one: FloatArray, other: FloatArray) -> FloatArray:
    """The paper's formulas, angle by angle, on whole arrays: what one writes first."""
    (l1, a1, b1), (l2, a2, b2) = np.moveaxis(one, -1, 0), other
    mean = (np.hypot(a1, b1) + np.hypot(a2, b2)) / 2
    stretch = 1.5 - 0.5 * np.sqrt(mean**7 / (mean**7 + 25.0**7))
    c1, c2 = np.hypot(stretch * a1, b1), np.hypot(stretch * a2, b2)
    h1, h2 = np.degrees(np.arctan2(b1, stretch * a1)) % 360, np.degrees(np.arctan2(b2, stretch * a2)) % 360
    turn = (h2 - h1 + 180) % 360 - 180
    hue = np.radians(h1 + turn / 2)
    weight = 1 - 0.17 * np.cos(hue - np.radians(30)) + 0.24 * np.cos(2 * hue)
    weight += 0.32 * np.cos(3 * hue + np.radians(6)) - 0.20 * np.cos(4 * hue - np.radians(63))
    chroma, light = (c1 + c2) / 2, ((l1 + l2) / 2 - 50) ** 2
    x = (c2 - c1) / (1 + 0.045 * chroma)
    y = 2 * np.sqrt(c1 * c2) * np.sin(np.radians(turn / 2)) / (1 + 0.015 * chroma * weight)
    blue = 30 * np.exp(-(((np.degrees(hue) % 360 - 275) / 25) ** 2))
    rotation = -2 * np.sqrt(chroma**7 / (chroma**7 + 25.0**7)) * np.sin(np.radians(2 * blue))
    z = (l2 - l1) / (1 + 0.015 * light / np.sqrt(20 + light))
    return np.asarray(np.sqrt(x * x + y * y + z * z + rotation * x * y))


def ilmek_chart(**reading: Any) -> Method:
    """Our chart with parameters of the reading."""

    def chart(rgb: Rgb, grid: Grid) -> Indices:
        size, quality = CarpetSize(grid[1] / 1000, grid[0] / 1000), QUALITY
        return make_chart(rgb, size, quality, WOOL, reading=ReadParams(**reading)).knots

    return chart


def pillow(dither: Image.Dither) -> Method:
    """Pillow's box filter and its quantiser onto the given palette."""

    def chart(rgb: Rgb, grid: Grid) -> Indices:
        return quantised(Image.fromarray(rgb), grid, dither)

    return chart


def quantised(picture: Image.Image, grid: Grid, dither: Image.Dither) -> Indices:
    """A picture at the size of a grid in the sixteen yarns, by Pillow."""
    palette = Image.new("P", (1, 1))
    codes = [code for yarn in WOOL for code in yarn.srgb]
    palette.putpalette(codes + list(WOOL[0].srgb) * (256 - len(WOOL)))
    small = picture.resize((grid[1], grid[0]), Image.Resampling.BOX)
    numbers = np.asarray(small.quantize(palette=palette, dither=dither))
    return np.asarray(np.minimum(numbers, len(WOOL) - 1), dtype=np.uint8)


def scikit_image(rgb: Rgb, grid: Grid) -> Indices:
    """Box filter, scikit-image's CIELAB and the least Euclidean distance."""
    small = np.asarray(Image.fromarray(rgb).resize((grid[1], grid[0]), Image.Resampling.BOX))
    knots = np.empty(grid, dtype=np.uint8)
    for band in bands(grid[0], grid[1], 1 << 19):
        labs = rgb2lab(small[band])
        knots[band] = np.stack([((labs - lab) ** 2).sum(axis=-1) for lab in LABS]).argmin(axis=0)
    return knots


def majority(rgb: Rgb, grid: Grid) -> Indices:
    """Nearest yarn of every pixel, and the most frequent one of each cell, of whole pixels."""
    colours = distinct_colours(rgb)
    pixels = paint(rgb, colours, nearest_yarns(colours, LABS)[0])
    down, across = pixels.shape[0] // grid[0], pixels.shape[1] // grid[1]
    cells = pixels.reshape(grid[0], down, grid[1], across)
    best, knots = np.full(grid, -1), np.zeros(grid, dtype=np.uint8)
    for yarn in range(len(WOOL)):
        votes = (cells == yarn).sum(axis=(1, 3))
        knots[votes > best], best = yarn, np.maximum(votes, best)
    return knots


METHODS: dict[str, tuple[Method, Method]] = {
    "ilmek": (ilmek_chart(reading="photo"), ilmek_chart()),
    "ilmek, photo": (ilmek_chart(reading="photo"), ilmek_chart(reading="photo")),
    "ilmek, photo, no confetti rule": (
        ilmek_chart(reading="photo", least_patch=0),
        ilmek_chart(reading="photo", least_patch=0),
    ),
    "ilmek, photo, no halftone": (
        ilmek_chart(reading="photo", halftone=0.0),
        ilmek_chart(reading="photo", halftone=0.0),
    ),
    "Pillow, nearest": (pillow(Image.Dither.NONE), pillow(Image.Dither.NONE)),
    "Pillow, Floyd-Steinberg": (pillow(Image.Dither.FLOYDSTEINBERG), pillow(Image.Dither.FLOYDSTEINBERG)),
    "scikit-image, nearest in CIELAB": (scikit_image, scikit_image),
    "majority vote": (majority, majority),
}
"""By name the methods for the photo and for the drawings."""


def best_of(runs: int, work: Callable[[], Indices]) -> tuple[float, Indices]:
    """The least processor time of some runs, of all threads, and the answer."""
    seconds = []
    for _ in range(runs):
        start = time.process_time()
        answer = work()
        seconds.append(time.process_time() - start)
    return min(seconds), answer


def afar(rgb: Rgb, knots: Indices) -> float:
    """Mean CIEDE2000 at viewing distance, on every 16th knot of every 16th row."""
    labs = []
    for codes in (rgb, SRGB[knots]):
        blurred = np.stack([ndimage.gaussian_filter(LINEAR[codes[..., axis]], 3)[::16, ::16] for axis in range(3)], -1)
        labs.append(xyz_to_lab(blurred @ RGB_TO_XYZ.T))
    return float(delta_e_2000(*labs).mean())


def drawing_faults(method: Method, drawings: dict[str, Drawing]) -> tuple[float, int]:
    """Share of the knots with a yarn of no colour of their cell, and pieces of lines too many or too few."""
    foreign, knots_in_all, broken = 0, 0, 0
    for drawing in drawings.values():
        knots = method(rendered(drawing, PIXELS, "smooth"), (drawing.rows, drawing.columns))
        yarns = delta_e_2000(srgb_to_lab(np.array(drawing.colours, np.uint8))[:, None], LABS[None]).argmin(axis=1)
        has = np.zeros((drawing.rows, drawing.columns, len(WOOL)), dtype=bool)
        for number, yarn in enumerate(yarns):
            has[..., yarn] |= colours_in_cells(drawing)[..., number]
        foreign += int((~np.take_along_axis(has, knots[..., None].astype(int), axis=2)).sum())
        knots_in_all += knots.size
        for line in drawing.lines:
            fine = drawing.at(16 * drawing.rows, 16 * drawing.columns) == line
            broken += abs(pieces(knots == yarns[line]) - pieces(fine))
    return foreign / knots_in_all, broken


def pieces(mask: np.ndarray) -> int:
    """Number of 8-connected pieces."""
    return int(ndimage.label(mask, np.ones((3, 3)))[1])


def line(name: str, runs: int, rgb: Rgb) -> str:
    """One row of the table."""
    photo, drawn = METHODS[name]
    seconds, knots = best_of(runs, lambda: photo(rgb, rgb.shape[:2]))
    near = float(
        np.mean([delta_e_2000(srgb_to_lab(rgb[band]), LABS[knots[band]]).mean() for band in bands(3600, 2400)])
    )
    tally, (foreign, broken) = tally_of(knots, len(WOOL)), drawing_faults(drawn, FLAT)
    lone, changes = tally.lone / knots.size, tally.changes / knots.size
    figures = f"{seconds:7.2f} {near:6.2f} {afar(rgb, knots):6.2f} {lone:7.2%} {tally.small_patches:9,d} {changes:6.3f}"
    return f"{name:<34} {figures} {foreign:8.2%} {broken:7d}"


def from_files(rgb: Rgb) -> None:
    """Charts of files of so many pixels as knots, decoding included, beside Pillow's decoding and its quantiser."""
    drawing = SRGB[ndimage.median_filter(pillow(Image.Dither.NONE)(rgb, (HEIGHT, WIDTH)), 9)]
    larger = Image.fromarray(drawing).resize((3 * WIDTH // 2, 3 * HEIGHT // 2), Image.Resampling.BICUBIC)
    nearest, diffused = Image.Dither.NONE, Image.Dither.FLOYDSTEINBERG
    cases = (
        ("exact", Image.fromarray(drawing), "auto", nearest, 2.0),
        ("flat", larger, "flat", diffused, 3.0),
        ("photo", Image.fromarray(rgb), "photo", diffused, 3.0),
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, picture, reading, dither, limit in cases:
            path = Path(folder) / f"{name}.png"
            picture.save(path)
            order = CarpetOrder(path, SIZE, QUALITY, reading=ReadParams(reading=reading))

            def decoded(path: Path = path, dither: Image.Dither = dither) -> Indices:
                return quantised(Image.open(path).convert("RGB"), (HEIGHT, WIDTH), dither)

            def charted(order: CarpetOrder = order) -> Indices:
                return chart_of_order(order).chart.knots

            seconds, _ = best_of(5, charted)
            base, _ = best_of(5, decoded)
            print(
                f"{name + ', from a file, own shades':<34} {seconds:7.2f} s, Pillow {base:.2f} s: "
                f"{seconds / base:.2f} (limit {limit:g})"
            )


def large() -> None:
    """Time and memory of 20 million knots, in this process alone."""
    rgb = np.tile(medallion(1000, 1250), (4, 4, 1))
    base = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    seconds, knots = best_of(2, lambda: ilmek_chart(reading="photo")(rgb, rgb.shape[:2]))
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(f"{knots.size / 1e6:.0f} million knots: {seconds:.2f} s, {peak / 1e3:,.0f} MB ({base / 1e3:,.0f} MB before)")


def run() -> None:
    """Print the table."""
    rgb = medallion()
    for photo, drawn in METHODS.values():  # compiles the kernels
        photo(rgb[:60, :40].copy(), (60, 40)), drawn(rgb[:60, :40].copy(), (30, 20))
    distinct = len(np.unique(rgb.reshape(-1, 3) @ np.array([65536, 256, 1])))
    print(f"{WIDTH} × {HEIGHT} photo, {distinct:,} distinct colours, {len(WOOL)} yarns; {len(FLAT)} drawings")
    names = f"{'s':>7} {'dE00':>6} {'afar':>6} {'lone':>7} {'patches':>9} {'chg':>6} {'foreign':>8} {'broken':>7}"
    print(f"{'method':<34} {names}")
    for name in METHODS:
        print(line(name, 5 if name.startswith(("ilmek", "Pillow")) else 1, rgb))
    part = np.ascontiguousarray(rgb[::6, ::6])
    seconds, _ = best_of(1, lambda: brute_force(part, LABS))
    print(f"{'NumPy CIEDE2000, every knot':<34} {36 * seconds:7.2f} (1/36, × 36)")
    seconds, _ = best_of(5, lambda: ilmek_chart(reading="photo")(rgb, (1500, 1000)))
    print(f"preview of 1,000 × 1,500 knots of the photo: {seconds:.3f} s")
    from_files(rgb)
    subprocess.run([sys.executable, "-c", "from benchmarks.bench_chart import large; large()"], check=True)


if __name__ == "__main__":
    run()
