"""Charts of drawings for tests of their colours, and what Pillow and plain loops see in them."""

from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from ilmek.carpet.colour import srgb_to_lab
from ilmek.carpet.colour_difference import delta_e_2000
from ilmek.jobs.chart import ChartResult, make_charted
from ilmek.jobs.order import read_order

PICTURES = Path(__file__).parent.parent / "pictures"


def charted(picture: Path, size: str, quality: str = "15x15/dm", **settings: Any) -> ChartResult:
    """The chart of a picture; `yarns`: "wool" or a path."""
    yarns = settings.pop("yarns", None)
    return make_charted(read_order(picture, size=size, quality=quality, yarn_file=yarns and Path(yarns), **settings))


def colours_of(made: ChartResult) -> np.ndarray:
    """The sRGB of each knot's yarn."""
    return np.array([yarn.srgb for yarn in made.chart.yarns], dtype=np.uint8)[made.chart.knots]


def yarn_at(made: ChartResult, x: float, y: float) -> str:
    """The name of the yarn at a place, as shares of the width from the left and of the height from the top."""
    rows, columns = made.chart.knots.shape
    return made.chart.yarns[made.chart.knots[int(y * rows), int(x * columns)]].name


def saved(folder: Path, name: str, pixels: np.ndarray) -> Path:
    """A picture in a file."""
    Image.fromarray(np.asarray(pixels, dtype=np.uint8)).save(folder / f"{name}.png")
    return folder / f"{name}.png"


def blocks(colours: list[tuple[int, int, int]], ground: tuple[int, int, int], side: int = 40) -> np.ndarray:
    """Discs of the colours on a ground, in a row."""
    y, x = np.mgrid[:side, :side] - (side - 1) / 2
    disc = x**2 + y**2 <= (0.4 * side) ** 2
    tiles = [np.where(disc[..., None], colour, ground) for colour in colours]
    return np.concatenate(tiles, axis=1).astype(np.uint8)


def chroma(made: ChartResult) -> float:
    """The greatest chroma of a yarn that a knot has."""
    labs = srgb_to_lab(np.array([made.chart.yarns[yarn].srgb for yarn in made.chart.used], dtype=np.uint8))
    return float(np.hypot(labs[:, 1], labs[:, 2]).max())


def edge_share(design: np.ndarray, chart: np.ndarray, least: float) -> float:
    """Share of the neighbours that differ by `least` or more in the design and differ at all in the chart, by loops."""
    seen = kept = 0
    for i, j in product(range(design.shape[0]), range(design.shape[1] - 1)):
        one, other = (srgb_to_lab(design[i, j + k]) for k in (0, 1))
        if float(delta_e_2000(one, other)) >= least:
            seen += 1
            kept += bool((chart[i, j] != chart[i, j + 1]).any())
    return kept / seen if seen else 1.0
