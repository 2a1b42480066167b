"""The studio's chart while a setting moves: 1,000 x 1,500 knots, from the request to the bytes of its answer.

A photograph and a drawing are charted as drafts, as a slider asks for them; each change is a new value of one setting.
Required: 200 ms a change on the clock, pixels on the screen included. The time of the processor is stated beside it:
other work on the computer lengthens the clock alone. The ratio is to Pillow's quantisation of the picture at the
chart's size to the same sixteen yarns: what a picture program would need, without a bill, checks or a chart's rules.
"""

import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.carpet.answers import ChartRequest
from ilmek.jobs.studio.carpet.stages import forget
from ilmek.jobs.studio.carpet.tasks import chart, prepare

COLUMNS, ROWS = 1000, 1500
RECIPE = {"picture": "photo.png", "size": "400x600cm", "quality": "25x25/dm"}
ROUNDS = 5
LIMIT = 0.2


@dataclass(frozen=True, slots=True)
class Change:
    """A setting that moves: its name, the picture, and its values one after the other."""

    name: str
    picture: str
    values: Callable[[], Iterator[dict[str, Any]]]


CHANGES = (
    Change("brightness of a photo", "photo.png", lambda: ({"brightness": 0.01 * one} for one in count(1))),
    Change("number of yarns of a photo", "photo.png", lambda: ({"colours": one} for one in count(5))),
    Change("crop of a photo", "photo.png", lambda: ({"crop": f"{one}%,0% 100%,100%"} for one in count(1))),
    Change("pencil on a photo", "photo.png", lambda: ({"edits": [f"set {one},9 ivory"]} for one in count(1))),
    Change("brightness of a drawing", "drawing.png", lambda: ({"brightness": 0.01 * one} for one in count(1))),
    Change("pencil on a drawing", "drawing.png", lambda: ({"edits": [f"set {one},9 ivory"]} for one in count(1))),
)


def run() -> None:
    """Print the times."""
    with tempfile.TemporaryDirectory() as folder:
        pictures(Path(folder))
        prepare()
        base = min(timed(lambda: quantised(Path(folder) / "photo.png")) for _ in range(ROUNDS))
        print(f"{'Pillow: 1,000 x 1,500 to sixteen yarns':32}{1e3 * base[0]:9.0f} ms of the processor")
        print(f"{'change':32}{'processor':>12}{'clock':>9}{'longest':>9}  [ms]   ratio (limit {1e3 * LIMIT:g} ms)")
        context = Context(folder)
        for change in CHANGES:
            taken = np.array(list(times(change, context)))
            processor, clock = np.median(taken, axis=0)
            print(
                f"{change.name:32}{1e3 * processor:12.0f}{1e3 * clock:9.0f}{1e3 * taken[:, 1].max():9.0f}"
                f"{processor / base[0]:14.2f}"
            )


def times(change: Change, context: Context) -> Iterator[tuple[float, float]]:
    """Times of the changes [s]: of the processor and on the clock; the first chart does not count."""
    forget()
    recipe = {**RECIPE, "picture": change.picture}
    chart(ChartRequest(recipe, draft=True), context)
    for _, values in zip(range(ROUNDS), change.values(), strict=False):
        request = ChartRequest({**recipe, **values}, draft=True)
        yield timed(lambda request=request: chart(request, context))


def timed(action: Callable[[], object]) -> tuple[float, float]:
    """Time of the processor and on the clock [s]."""
    processor, clock = time.process_time(), time.perf_counter()
    action()
    return time.process_time() - processor, time.perf_counter() - clock


def quantised(path: Path) -> Image.Image:
    """The picture in the sixteen yarns, as a picture program does it."""
    palette = Image.new("P", (1, 1))
    palette.putpalette([code for yarn in default_yarns() for code in bytes.fromhex(yarn.hex[1:])])
    picture = Image.open(path).convert("RGB").resize((COLUMNS, ROWS), Image.Resampling.LANCZOS)
    return picture.quantize(palette=palette, dither=Image.Dither.NONE)


def pictures(folder: Path) -> None:
    """A photograph of 2,000 x 3,000 pixels, and a drawing of few colours."""
    across, down = np.meshgrid(np.arange(2000), np.arange(3000))
    waves = [127 + 100 * np.sin(across / 170 + down / 310 + turn) for turn in (0, 2, 4)]
    noise = np.random.default_rng(1).normal(0, 8, (3000, 2000, 3))
    Image.fromarray((np.stack(waves, axis=-1) + noise).clip(0, 255).astype(np.uint8)).save(folder / "photo.png")
    stripes = (across // 60 + down // 80) % 7 + (across // 9 + down // 11) % 2
    colours = np.array([yarn.srgb for yarn in default_yarns()][:8]) if False else _colours()
    Image.fromarray(colours[stripes]).save(folder / "drawing.png")


def _colours() -> np.ndarray[Any, np.dtype[np.uint8]]:
    """Eight colours of the yarns."""
    return np.array([list(bytes.fromhex(yarn.hex[1:])) for yarn in default_yarns()[:8]], dtype=np.uint8)


if __name__ == "__main__":
    run()
