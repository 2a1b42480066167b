"""The loom in space: time to its first picture, and pictures a second drawn by the processor, without a graphics card.

    python -m benchmarks studio_loom

Processor time of the browser is printed beside the clock, which others on the computer lengthen.
"""

import tempfile
import time
from pathlib import Path

from benchmarks.bench_studio import studio
from benchmarks.browser import Browser, Page

BY_PROCESSOR = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
WIDE = 'machine = "automated-loom"\n\n[settings]\nwidth = "2.38 m"\nlength = "3 m"\n'
"""A loom with 1,200 warps."""

LEAST = 20.0
"""The promised pictures a second."""

SPAN = 4.0
"""Time in which pictures are counted [s]."""

VIEWS = ("Whole loom", "Fell", "Head")
READY = """new Promise(done => { const look = () => Number(document.querySelector('.loom canvas')?.dataset.pictures) > 0
  ? done() : setTimeout(look, 10); look(); })"""
PLAY = (
    """document.querySelector('.loom canvas').dispatchEvent(new KeyboardEvent('keydown', {key: ' ', bubbles: true}))"""
)
TURN = """window.turning = setInterval(() => document.querySelector('.loom canvas').dispatchEvent(
  new KeyboardEvent('keydown', {key: 'ArrowLeft', bubbles: true})), 4)"""
STILL = "clearInterval(window.turning)"
COUNT = "Number(document.querySelector('.loom canvas').dataset.pictures)"


def counted(browser: Browser, page: Page, name: str, begin: str, end: str) -> None:
    """Print pictures a second and processor time of one while the picture changes."""
    page.evaluate(begin)
    first, began, used = page.evaluate(COUNT), time.perf_counter(), browser.processor_time
    page.evaluate(f"new Promise(done => setTimeout(done, {1000 * SPAN}))")
    pictures = page.evaluate(COUNT) - first
    took, used = time.perf_counter() - began, browser.processor_time - used
    page.evaluate(end)
    print(
        f"{name:44s} {pictures / took:6.1f} pictures a second (at least {LEAST:g})   "
        f"processor {1000 * used / max(pictures, 1):6.1f} ms a picture"
    )


def shown(browser: Browser, page: Page, address: str, name: str) -> None:
    """Print the time to the first picture of a loom, and measure it in motion."""
    began, used = time.perf_counter(), browser.processor_time
    page.visit(address)
    page.evaluate(READY)
    took, used = time.perf_counter() - began, browser.processor_time - used
    print(f"{name + ': first picture':44s} {took:6.2f} s   processor of the browser {used:6.2f} s")
    for view in VIEWS:
        page.evaluate(
            "[...document.querySelectorAll('.loom-views button')]"
            f".find(one => one.textContent.trim() === '{view}').click()"
        )
        counted(browser, page, f"{name}, {view}: played", PLAY, PLAY)
        counted(browser, page, f"{name}, {view}: turned", TURN, STILL)


def run() -> None:
    """Show the loom of the example, and one with 1,200 warps."""
    with tempfile.TemporaryDirectory() as folder, Browser(*BY_PROCESSOR) as browser:
        project = Path(folder) / "project"
        with studio(project) as address:
            page = browser.open(Path(__file__).with_name("browser.py"), 1400, 900)
            shown(browser, page, f"{address}#loom", "loom of the example carpet")
            (project / "machines" / "wide-loom.toml").write_text(WIDE)
            page.evaluate("location.href = 'about:blank'")
            shown(browser, page, f"{address}#loom/machines/wide-loom.toml", "loom with 1,200 warps")
        errors = [one for one in browser.errors if "GPU stall" not in one]  # a processor draws
        assert errors == [], errors
