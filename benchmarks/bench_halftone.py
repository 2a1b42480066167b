"""Photographs of scikit-image at viewing distance and at arm's length: our charts beside Pillow.

Two shelves: the sixteen wools, and sixteen shades dyed to the photo. Mean CIEDE2000 by scikit-image after a blur of
linear light by 3 knots (room) and by 1 knot (arm), and the share of lone knots. A pixel is a knot.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import skimage
from PIL import Image
from scipy import ndimage
from skimage.color import deltaE_ciede2000, rgb2lab

from benchmarks.bench_chart import QUALITY, wool
from ilmek.arrays import FloatArray, Indices, Rgb
from ilmek.carpet.chart_making import make_chart
from ilmek.carpet.colour import LINEAR, encode, srgb_to_lab
from ilmek.carpet.palette import distinct_colours
from ilmek.carpet.proposal import propose_shades
from ilmek.carpet.reading import ReadParams
from ilmek.carpet.sizes import CarpetSize
from ilmek.carpet.tally import tally_of
from ilmek.carpet.yarn import Yarn

Shelf = tuple[Yarn, ...]
Method = Callable[[Rgb, Shelf], Indices]
NAMES = ("astronaut.png", "coffee.png", "chelsea.png", "rocket.jpg")
LONGEST = 300
"""Knots on the longer side."""


def photo(name: str) -> Rgb:
    """A photograph of scikit-image."""
    with Image.open(Path(skimage.__file__).parent / "data" / name) as image:
        scale = LONGEST / max(image.size)
        size = (round(scale * image.width), round(scale * image.height))
        return np.asarray(image.convert("RGB").resize(size, Image.Resampling.BOX))


def own_shades(rgb: Rgb) -> Shelf:
    """Sixteen yarns dyed to the photo."""
    shades = propose_shades(distinct_colours(rgb), 16, drawn=False)
    labs = srgb_to_lab(np.array([shade.srgb for shade in shades], dtype=np.uint8)).tolist()
    return tuple(
        replace(yarn, name=shade.hex, srgb=shade.srgb, lab=(lab[0], lab[1], lab[2]))
        for yarn, shade, lab in zip(wool(), shades, labs, strict=False)
    )


def ilmek_chart(halftone: float | None) -> Method:
    """Our chart of a photo."""

    def chart(rgb: Rgb, yarns: Shelf) -> Indices:
        size = CarpetSize(rgb.shape[1] / 1000, rgb.shape[0] / 1000)
        reading = ReadParams(reading="photo", halftone=halftone)
        return make_chart(rgb, size, QUALITY, yarns, reading=reading).knots

    return chart


def pillow(dither: Image.Dither) -> Method:
    """Pillow's quantiser onto the yarns."""

    def chart(rgb: Rgb, yarns: Shelf) -> Indices:
        codes = [code for yarn in yarns for code in yarn.srgb]
        palette = Image.new("P", (1, 1))
        palette.putpalette(codes + list(yarns[0].srgb) * (256 - len(yarns)))
        quantised = np.asarray(Image.fromarray(rgb).quantize(palette=palette, dither=dither))
        return np.where(quantised < len(yarns), quantised, 0).astype(np.uint8)

    return chart


METHODS: dict[str, Method] = {
    "ilmek, the default": ilmek_chart(None),
    "ilmek, no halftone": ilmek_chart(0.0),
    "Pillow, nearest": pillow(Image.Dither.NONE),
    "Pillow, Floyd-Steinberg": pillow(Image.Dither.FLOYDSTEINBERG),
}


def seen(codes: Rgb, spread: float) -> FloatArray:
    """CIELAB after a blur of linear light."""
    return np.asarray(rgb2lab(encode(ndimage.gaussian_filter(LINEAR[codes], (spread, spread, 0)))))


def apart(rgb: Rgb, made: Rgb, spread: float) -> float:
    """Mean CIEDE2000 after a blur."""
    difference = deltaE_ciede2000(seen(rgb, spread), seen(made, spread))  # type: ignore[no-untyped-call]
    return float(np.mean(difference))


def main() -> None:
    """Print a row for each photograph, shelf and method."""
    print(f"{'photograph':15}{'shelf':12}{'method':26}{'room':>6}{'arm':>6}{'lone':>8}")
    for name in NAMES:
        rgb = photo(name)
        for shelf, yarns in {"wool": wool(), "own shades": own_shades(rgb)}.items():
            for title, method in METHODS.items():
                knots = method(rgb, yarns)
                made = np.array([yarn.srgb for yarn in yarns], dtype=np.uint8)[knots]
                room, arm = (apart(rgb, made, spread) for spread in (3.0, 1.0))
                lone = tally_of(knots, len(yarns)).lone / knots.size
                print(f"{name:15}{shelf:12}{title:26}{room:6.2f}{arm:6.2f}{lone:8.1%}")


if __name__ == "__main__":
    main()
