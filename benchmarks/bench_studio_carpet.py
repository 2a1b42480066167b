"""The studio's chart: 1,000 x 1,500 knots while a setting moves, and 20 million knots on the screen.

A photograph and a drawing are charted as drafts, as while a slider moves; each change is a new value of one setting.
Required: 200 ms a change on the clock, pixels on the screen included. The time of the processor is stated beside it:
other work on the computer lengthens the clock alone. The ratio is to Pillow's quantisation of the picture at the
chart's size to the same sixteen yarns: what a picture program would need, without a bill, checks or a chart's rules.
In the browser, without a graphics card: from a step of a slider to the picture of its chart, with the time of the
processor of server and browser, which draw and compute in part side by side, and pictures a second of
20 million knots that are moved and zoomed, with the memory of all its processes.
"""

import os
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from benchmarks.bench_studio import studio
from benchmarks.browser import Browser, Page, installed, processor_time
from ilmek.io.yarn_file import default_yarns
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.carpet.answers import ChartRequest
from ilmek.jobs.studio.carpet.stages import forget
from ilmek.jobs.studio.carpet.tasks import chart, prepare

COLUMNS, ROWS = 1000, 1500
RECIPE = {"picture": "photo.png", "size": "400x600cm", "quality": "25x25/dm"}
ROUNDS = 5
LIMIT = 0.2
BY_PROCESSOR = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
HUGE = {"picture": "photo.png", "size": "1000x1250cm", "quality": "40x40/dm"}
"""A carpet of 4,000 x 5,000 knots."""

SPAN = 4.0
"""Time in which pictures are counted [s]."""

REST = 4.0
"""Time before a step in which the chart of the last one is made, and workers prepare [s]."""

PICTURES = "Number(document.querySelector('.carpet-surface canvas')?.dataset.pictures ?? 0)"
SHOWN = """new Promise(done => { const look = () => document.querySelector('.carpet-status')?.textContent.includes('%s')
  ? requestAnimationFrame(() => requestAnimationFrame(done)) : setTimeout(look, 10); look(); })"""
STEP = """new Promise(done => {
  const slider = document.querySelector('.carpet-side details:nth-of-type(2) input[type=range]');
  const line = document.querySelector('.carpet-timing'), before = line.textContent, began = performance.now();
  new MutationObserver((_, seen) => {
    if (line.textContent === before || !line.textContent.includes('×')) return;
    seen.disconnect();
    requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now() - began)));
  }).observe(line, { characterData: true, childList: true, subtree: true });
  slider.stepUp();
  slider.dispatchEvent(new Event('input', { bubbles: true }));
})"""
SAVED = """new Promise(done => { const look = () => document.querySelector('.project-saved.saved')
  ? done() : setTimeout(look, 10); look(); })"""
MOVE = """(() => {
  const canvas = document.querySelector('.carpet-surface canvas'), box = canvas.getBoundingClientRect();
  const at = { clientX: box.x + box.width / 3, clientY: box.y + box.height / 3, bubbles: true, cancelable: true };
  let turn = 0;
  const step = () => { turn += 1; window.moving = requestAnimationFrame(step);
    canvas.dispatchEvent(new WheelEvent('wheel', { ...at, shiftKey: %s, deltaY: turn %% 60 < 30 ? 20 : -20 })); };
  step(); })()"""
KNOTS = "[...document.querySelectorAll('.carpet-zoom button')].at(-1).click()"


@dataclass(frozen=True, slots=True)
class Change:
    """A setting that moves: its name, the picture, and its values one after the other."""

    name: str
    picture: str
    values: Callable[[], Iterator[dict[str, Any]]]


CHANGES = (
    Change("brightness of a photo", "photo.png", lambda: ({"brightness": 0.01 * one} for one in count(1))),
    Change("contrast of a photo", "photo.png", lambda: ({"contrast": 0.01 * one} for one in count(1))),
    Change("saturation of a photo", "photo.png", lambda: ({"saturation": 0.01 * one} for one in count(1))),
    Change("halftone of a photo", "photo.png", lambda: ({"halftone": 1 - 0.05 * one} for one in count(1))),
    Change("least patch of a photo", "photo.png", lambda: ({"least_patch": one} for one in count(5))),
    Change("number of yarns of a photo", "photo.png", lambda: ({"colours": one} for one in count(5))),
    Change("crop of a photo", "photo.png", lambda: ({"crop": f"{one}%,0% 100%,100%"} for one in count(1))),
    Change("turn of a photo", "photo.png", lambda: ({"turn": f"{one}deg"} for one in count(1))),
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
        if installed() is not None:
            on_screen(Path(folder))


def on_screen(folder: Path) -> None:
    """Print what the browser takes for a change, and for 20 million knots."""
    write(folder, RECIPE)
    with Browser(*BY_PROCESSOR) as browser, studio(folder) as address:
        page = browser.open(Path(__file__).with_name("browser.py"), 1400, 900)
        page.visit(f"{address}#carpet")
        page.evaluate(SHOWN % "1,500 rows")
        steps = np.array([step(page) for _ in range(1 + ROUNDS)])[1:]  # the first one prepares drafts
        clock, processor = np.median(steps, axis=0)
        print(
            f"{'from a step of a slider to its picture':44s}{clock:9.0f} ms, least {steps[:, 0].min():.0f} ms "
            f"(limit {1e3 * LIMIT:g} ms)   processor {processor:.0f} ms   load {os.getloadavg()[0]:.1f}"
        )
        page.evaluate(SAVED)
        before = browser.memory
        write(folder, HUGE)
        page.evaluate(SHOWN % "5,000 rows")
        print(f"{'20 million knots: memory of the browser':44s}{(browser.memory - before) / 1e6:9.0f} MB more")
        counted(browser, page, "20 million knots: whole, zoomed", MOVE % "false")
        page.evaluate(KNOTS)
        counted(browser, page, "20 million knots: single knots, moved", MOVE % "true")


def step(page: Page) -> tuple[float, float]:
    """A step of a slider to its picture: time on the clock, and of the processor by server and browser [ms]."""
    time.sleep(REST)
    began = processor_time(os.getpid())
    clock: float = page.evaluate(STEP)
    return clock, 1e3 * (processor_time(os.getpid()) - began)


def counted(browser: Browser, page: Page, name: str, begin: str) -> None:
    """Print pictures a second and processor time of one while the view moves."""
    page.evaluate(begin)
    first, began, used = page.evaluate(PICTURES), time.perf_counter(), browser.processor_time
    page.evaluate(f"new Promise(done => setTimeout(done, {1000 * SPAN}))")
    shown = page.evaluate(PICTURES) - first
    took, used = time.perf_counter() - began, browser.processor_time - used
    page.evaluate("cancelAnimationFrame(window.moving)")
    print(f"{name:44s}{shown / took:9.1f} pictures a second   processor {1e3 * used / max(shown, 1):6.1f} ms a picture")


def write(folder: Path, recipe: dict[str, str]) -> None:
    """The recipe of the project."""
    lines = (f'{key} = "{value}"' for key, value in recipe.items())
    (folder / "carpet.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")


def times(change: Change, context: Context) -> Iterator[tuple[float, float]]:
    """Times of the changes [s]: of the processor and on the clock; the first chart, which is whole, does not count."""
    forget()
    recipe = {**RECIPE, "picture": change.picture}
    chart(ChartRequest(recipe), context)
    for _, values in zip(range(ROUNDS), change.values(), strict=False):
        request = ChartRequest({**recipe, **values}, draft=True)
        yield timed(partial(chart, request, context))


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
    colours = np.array([list(bytes.fromhex(yarn.hex[1:])) for yarn in default_yarns()[:8]], dtype=np.uint8)
    Image.fromarray(colours[stripes]).save(folder / "drawing.png")
