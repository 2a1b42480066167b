"""Picture to knot chart: 2400 × 3600 knots onto the sixteen wools, beside Pillow's palette quantiser and plain NumPy.

The picture is a synthetic medallion (field, spandrels, three borders) with abrash (the slow change of a dyed yarn from
row to row) and the grain of a photograph: some 265 thousand distinct colours.
"""

import time
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

import ilmek
from ilmek.arrays import FloatArray, Indices, Rgb
from ilmek.carpet.chart import make_chart
from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.carpet.confetti import count_lone
from ilmek.carpet.quality import Quality
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.yarn import Yarn, yarn_labs
from ilmek.io.yarn_file import yarns_from_records

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


def pillow(rgb: Rgb, yarns: tuple[Yarn, ...]) -> Indices:
    """Pillow's quantiser onto the given palette, without dithering."""
    palette = Image.new("P", (1, 1))
    palette.putpalette([code for yarn in yarns for code in yarn.srgb] + list(yarns[0].srgb) * (256 - len(yarns)))
    quantised = Image.fromarray(rgb).quantize(palette=palette, dither=Image.Dither.NONE)
    return np.asarray(np.minimum(np.asarray(quantised), len(yarns) - 1), dtype=np.uint8)


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


def best_of(runs: int, work: Callable[[], Indices]) -> tuple[float, Indices]:
    """The least wall time of some runs, and the answer."""
    seconds = []
    for _ in range(runs):
        start = time.perf_counter()
        answer = work()
        seconds.append(time.perf_counter() - start)
    return min(seconds), answer


def line(name: str, seconds: float, rgb: Rgb, knots: Indices, labs: FloatArray) -> str:
    """One row of the table."""
    difference = delta_e_2000(srgb_to_lab(rgb), labs[knots]).mean()
    changes = np.count_nonzero(knots[:, 1:] != knots[:, :-1]) / knots.size
    return f"{name:<42} {seconds:8.2f} {difference:9.3f} {count_lone(knots) / knots.size:9.3%} {changes:9.4f}"


def run() -> None:
    """Print the table."""
    rgb, yarns = medallion(), wool()
    labs = yarn_labs(yarns)
    small = make_chart(rgb[:60, :40], CarpetSize(0.04, 0.06), QUALITY, yarns)  # compiles the kernels
    distinct = len(np.unique(rgb.reshape(-1, 3) @ np.array([65536, 256, 1])))
    print(f"{WIDTH} × {HEIGHT} picture, {distinct:,} distinct colours, {len(small.yarns)} yarns")
    print(f"{'method':<42} {'s':>8} {'mean dE00':>9} {'lone':>9} {'chg/knot':>9}")
    exact, knots = best_of(3, lambda: make_chart(rgb, SIZE, QUALITY, yarns).knots)
    print(line("ilmek, exact CIEDE2000", exact, rgb, knots, labs))
    seconds, knots = best_of(3, lambda: pillow(rgb, yarns))
    print(line("Pillow, quantize to the palette", seconds, rgb, knots, labs))
    part = np.ascontiguousarray(rgb[::6, ::6])
    seconds, knots = best_of(1, lambda: brute_force(part, labs))
    print(line("NumPy CIEDE2000, every knot (1/36, × 36)", 36 * seconds, part, knots, labs))


if __name__ == "__main__":
    run()
