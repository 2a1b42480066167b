"""Squared paper: a photograph of 12 megapixels read cell by cell, beside Pillow's decoding of its JPEG.

Processor time and memory. The sheet has 150 × 110 cells, bent, in perspective and in shadow. The last row is what every
picture without a size costs that is no sheet: its look at a photograph of 1000 × 1500.
"""

import io
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks.bench_chart import medallion
from ilmek.arrays import Rgb
from ilmek.carpet.paper.sheet import read_sheet, squared_paper

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from sheet_readings import wrong_cells
from sheets import photographed, printed, random_design, random_palette

ROWS, COLUMNS, PITCH = 150, 110, 22
WIDTH, HEIGHT = 3000, 4000


def photograph() -> tuple[bytes, np.ndarray]:
    """The JPEG of a sheet, 3000 × 4000 pixels, and its design."""
    rng = np.random.default_rng(7)
    palette, design = random_palette(rng, 7), random_design(rng, ROWS, COLUMNS, 7)
    flat = printed(rng, design, palette, PITCH, margin=2 * PITCH)
    sheet = photographed(rng, flat, perspective=0.1, bend=0.01, turn=0.03, shadow=0.3, noise=3, blur=0.7)
    stored = io.BytesIO()
    Image.fromarray(sheet).resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS).save(stored, "JPEG", quality=88)
    return stored.getvalue(), design


def decoded(jpeg: bytes) -> Rgb:
    """The picture, as Pillow decodes it."""
    return np.asarray(Image.open(io.BytesIO(jpeg)).convert("RGB"))


def seconds(work: Callable[[], object]) -> float:
    """The least processor time of three runs [s]."""
    times = []
    for _ in range(3):
        begin = time.process_time()
        work()
        times.append(time.process_time() - begin)
    return min(times)


def run() -> None:
    jpeg, design = photograph()
    rgb = decoded(jpeg)
    paper = read_sheet(rgb)
    wrong = int(wrong_cells(paper, design).sum()) if paper.grid == design.shape else design.size
    photo = medallion(1000, 1500)
    print(f"Pillow decodes {WIDTH} × {HEIGHT}        {seconds(lambda: decoded(jpeg)):6.2f} s")
    print(f"read, {wrong} of {design.size:,} cells wrong    {seconds(lambda: read_sheet(rgb)):6.2f} s")
    print(f"no sheet, 1000 × 1500            {1000 * seconds(lambda: squared_paper(photo)):6.1f} ms")
