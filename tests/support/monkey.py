"""A monkey: random input on a page of the studio, from a seed, and the growth of its memory."""

import os
import random
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Error, Page
from studio_browser import VIEWS

KEYS = (
    *("Tab", "Shift+Tab", "Enter", "Space", "Escape", "Delete", "Home", "Control+z", "5", "-", "m"),
    *("ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"),
)
TYPED = ("0", "60mm", "1e9", "-3deg", "nan", "<b>x</b>", "ğüşıöç", "", "12 rad/s")
CLICKABLE = ", ".join(f"main {one}:visible" for one in ("button", "input", "select", "[role=tab]", "summary"))


@dataclass(frozen=True, slots=True)
class Walk:
    """What a walk did: number of actions, and memory [B] at its first third and at its end.

    heap      of the page, after a collection, as (early, late)
    resident  of the server and its workers, likewise
    """

    actions: int
    heap: tuple[float, float]
    resident: tuple[float, float]


def walk(page: Page, server: int, seed: int, seconds: float, check: Callable[[], None]) -> Walk:
    """Act at random for a time; `check` is called after every action. server: its process."""
    chance = random.Random(seed)
    began, actions, early = time.monotonic(), 0, (0.0, 0.0)
    while (spent := time.monotonic() - began) < seconds:
        _act(page, chance)
        check()
        actions += 1
        if not early[0] and spent > seconds / 3:
            early = heap(page), resident(server)
    return Walk(actions, (early[0], heap(page)), (early[1], resident(server)))


def resident(process: int) -> float:
    """Bytes in memory of a process and of those that it started."""
    try:
        tasks = list(Path(f"/proc/{process}/task").iterdir())
        children = [int(child) for task in tasks for child in (task / "children").read_text().split()]
        pages = int(Path(f"/proc/{process}/statm").read_text().split()[1])
    except OSError:  # the process or a thread of it has ended, or the system has no such folder
        return 0.0
    return pages * os.sysconf("SC_PAGESIZE") + sum(resident(child) for child in children)


def heap(page: Page) -> float:
    """Bytes in use of the page's heap, after a collection."""
    session = page.context.new_cdp_session(page)
    session.send("HeapProfiler.collectGarbage")
    used = session.send("Runtime.getHeapUsage")["usedSize"]
    session.detach()
    return float(used)


def _act(page: Page, chance: random.Random) -> None:
    kind = chance.random()
    size = page.viewport_size or {"width": 1400, "height": 900}
    x, y = chance.uniform(0, size["width"] - 1), chance.uniform(0, size["height"] - 1)
    try:
        if kind < 0.06:
            page.evaluate(f"location.hash = '#{chance.choice(VIEWS)}'")
        elif kind < 0.4:
            _click_one(page, chance)
        elif kind < 0.6:
            page.mouse.click(x, y)
        elif kind < 0.75:
            page.mouse.move(x, y)
            page.mouse.down()
            page.mouse.move(chance.uniform(0, size["width"] - 1), chance.uniform(0, size["height"] - 1), steps=4)
            page.mouse.up()
        elif kind < 0.9:
            page.keyboard.press(chance.choice(KEYS))
        elif kind < 0.95:
            page.mouse.wheel(0, chance.uniform(-600, 600))
        else:
            page.keyboard.type(chance.choice(TYPED))
    except Error as error:  # an element that left while the monkey reached for it
        if "Target" in str(error) or "crash" in str(error).lower():
            raise


def _click_one(page: Page, chance: random.Random) -> None:
    found = page.locator(CLICKABLE)
    count = found.count()
    if count:
        found.nth(chance.randrange(count)).click(timeout=500, force=chance.random() < 0.3)
