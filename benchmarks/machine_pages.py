"""Pages of all machines and of mechanism files in a browser: size, where the checks begin, widths, cursors, errors."""

import time
from collections.abc import Iterator
from pathlib import Path

from benchmarks.browser import Browser, Page
from ilmek.io.mechanism_file import read_mechanism
from ilmek.jobs.mechanism.analysis import analysis
from ilmek.jobs.mechanism.report import report
from ilmek.jobs.mechanism.request import MotionRequest
from ilmek.jobs.mechanism.run import run
from ilmek.machines.catalogue import MACHINES
from ilmek.report import Report
from ilmek.viz.page import machine_page

EXAMPLES = Path(__file__).parents[1] / "examples"
MECHANISMS = ("jansen_leg", "geared_five_bar")
LOADS = 500
SCREENS = {"1,400 px": (1400, 900, False), "390 px": (390, 800, True)}
"""Width, height, and whether it is a phone."""

LAYOUT = """(() => {
  for (const folded of document.querySelectorAll("main details")) folded.open = true;
  const check = document.querySelector("tr.pass, tr.fail"), root = document.documentElement;
  const outside = [...document.querySelectorAll("td, th, dd, dt, svg, input, output")]
    .filter((one) => one.checkVisibility() && one.getBoundingClientRect().right > innerWidth + 0.5);
  return { checks: check ? Math.round(check.getBoundingClientRect().top + scrollY) : null, high: root.scrollHeight,
    wide: root.scrollWidth, outside: outside.length };
})()"""
READ = """[...document.querySelectorAll("figure.read .readings:not([hidden]) dd:first-of-type")]
  .map((one) => one.textContent).filter((text) => text && text !== "–").length"""
NUMBERS = "window.bad > 0 || /NaN|undefined|Infinity/.test(document.querySelector('main').innerHTML)"
LATE = """const now = performance.now.bind(performance);
performance.now = () => now() + 40 * Math.random();
const set = Element.prototype.setAttribute;
window.bad = 0;
Element.prototype.setAttribute = function (name, value) {
  if (/NaN|undefined|Infinity/.test(String(value))) window.bad += 1;
  return set.call(this, name, value);
};"""
"""Runs before a page: counts attributes that are no numbers. The clock is ahead of the first frame's time by up to
40 ms, as it may be when a frame is late; animations had a negative phase then."""
FRAME = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))"
"""Waits for two frames: the first of an animation, and the one after it."""


def pages(folder: Path) -> Iterator[tuple[str, float, Path]]:
    """Name, processor time [s] and file of each page, of the designs by default and of example mechanisms."""
    for name, made in _reports():
        start = time.process_time()
        text = machine_page(made)
        seconds = time.process_time() - start
        path = folder / f"{name}.html"
        path.write_text(text, encoding="utf-8")
        yield name, seconds, path


def _reports() -> Iterator[tuple[str, Report]]:
    for name, machine in MACHINES.items():
        yield name, machine.report(machine.design(machine.params.read({})))
    for name in MECHANISMS:
        moved = run(read_mechanism(EXAMPLES / f"{name}.toml"), MotionRequest({}))
        yield name, report(analysis(moved))


def measure(folder: Path) -> None:
    """Print a line for each page, and the number of errors in 500 loads of pages that move."""
    made = list(pages(folder))
    heads = "".join(f" {f'checks at, {name}':>19} {'outside':>8}" for name in SCREENS)
    print(f"{'machine':<22} {'s':>6} {'kB':>6}{heads} {'charts read':>12}")
    with Browser() as browser:
        for name, seconds, path in made:
            cells, read = "", 0
            for width, height, phone in SCREENS.values():
                page = browser.open(path, width, height, phone=phone)
                page.evaluate(FRAME)
                found, read = page.evaluate(LAYOUT), page.evaluate(READ)
                assert found["wide"] <= width, f"{name} needs {found['wide']} px of {width}"
                cells += f" {found['checks'] or '–':>19} {found['outside']:>8}"
                page.close()
            print(f"{name:<22} {seconds:6.2f} {path.stat().st_size / 1e3:6.0f}{cells} {read:>12}")
        moving = [path for _, _, path in made if 'class="moves"' in path.read_text(encoding="utf-8")]
        print(f"{LOADS} loads: {_loads(browser, moving)} pages with NaN, {len(browser.errors)} messages on the console")
        for text in sorted(set(browser.errors)):
            print(f"  {text}")


def _loads(browser: Browser, paths: list[Path]) -> int:
    """The number of loads, of 500 over these pages, after which a page shows NaN."""
    page: Page = browser.open(paths[0], 1400, 2000)
    page.send("Page.addScriptToEvaluateOnNewDocument", {"source": LATE})
    bad = 0
    for number in range(LOADS):
        page.load(paths[number % len(paths)])
        page.evaluate(FRAME)
        bad += bool(page.evaluate(NUMBERS))
    return bad
