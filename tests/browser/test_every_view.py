"""Each view opens on the example project: legible, accessible, and without a request off the machine.

One page for each view serves all of its tests; each test leaves it as it was.
"""

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page
from studio_browser import VIEWS, Seen, Studio, context_of, open_view, settled, violations

WINDOW = {"width": 1400, "height": 900}
PHONE = {"width": 390, "height": 844}
WALL = {"width": 3840, "height": 2160}

FOCUSED = """
async () => {
  const [element, before] = [document.activeElement, window.focusedBefore];
  if (element === document.body) return null;
  window.focusedBefore = element;
  const isInSight = () => {
    const box = element.getBoundingClientRect();
    return box.right > 0 && box.bottom > 0 && box.left < innerWidth && box.top < innerHeight;
  };
  if (!isInSight()) await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  const [box, last] = [element.getBoundingClientRect(), before?.getBoundingClientRect()];
  const colour = document.createElement("i");
  colour.style.color = "var(--focus)";
  document.body.append(colour);
  const focus = getComputedStyle(colour).color;
  colour.remove();
  const inRows = ![element, before].some((one) => one instanceof SVGElement);
  const isSeen = (part) => {
    const { outlineStyle, outlineWidth, stroke } = getComputedStyle(part);
    return (outlineStyle !== "none" && parseFloat(outlineWidth) >= 1) || stroke === focus;
  };
  const parts = [element, element.parentElement, element.closest("label"), ...element.querySelectorAll("circle, rect")];
  return {
    name: `${element.tagName} ${element.getAttribute("aria-label") ?? element.textContent}`.slice(0, 60),
    isFirst: element.className === "app-skip",
    isSeen: parts.some((part) => part && isSeen(part)),
    isInSight: isInSight(),
    isBack: inRows && last !== undefined && box.bottom <= last.top && box.right <= last.left,
  };
}
"""
"""The element that has the focus: whether that is seen, and whether it is left of the one before and above it."""
MOST_STOPS = 300


@pytest.fixture(scope="module", params=VIEWS)
def opened(request: pytest.FixtureRequest, browser: Browser, running: Studio) -> Iterator[Page]:
    """A view at rest on a page of its own; any fault of the page fails its last test."""
    seen = Seen()
    with context_of(browser) as context:
        page = context.new_page()
        seen.watch(page, running.base)
        open_view(page, running, request.param)
        settled(page)
        yield page
    assert seen.faults == []


def _sized(page: Page, size: Any) -> None:
    page.set_viewport_size(size)
    settled(page)


def test_it_opens_with_a_finished_example(opened: Page) -> None:
    assert opened.locator("main h1").count() == 1
    assert opened.locator("[role=alert]:visible").count() == 0


def test_axe_finds_nothing(opened: Page) -> None:
    assert violations(opened) == []


@pytest.mark.matrix(light=3)
def test_axe_finds_nothing_on_a_dark_phone(opened: Page) -> None:
    opened.emulate_media(color_scheme="dark")
    assert violations(opened, "color-contrast") == []
    _sized(opened, PHONE)
    found = violations(opened)
    opened.emulate_media(color_scheme="light")
    _sized(opened, WINDOW)
    assert found == []


@pytest.mark.matrix(light=5)
@pytest.mark.parametrize("size", [PHONE, WALL], ids=["phone", "wall"])
def test_nothing_is_cut_off(opened: Page, size: dict[str, int]) -> None:
    _sized(opened, size)
    widths = opened.evaluate(
        "[document.documentElement, document.querySelector('main')].map(e => [e.scrollWidth, e.clientWidth])"
    )
    _sized(opened, WINDOW)
    assert all(content <= shown for content, shown in widths), widths


@pytest.mark.matrix(light=3)
def test_the_tab_key_goes_through_everything(opened: Page) -> None:
    opened.locator(".app-skip").focus()
    stops: list[dict[str, Any]] = []
    while len(stops) < MOST_STOPS and not (stops and stops[-1]["isFirst"]):
        opened.keyboard.press("Tab")
        if (stop := opened.evaluate(FOCUSED)) is not None:
            stops.append(stop)
    names = [stop["name"] for stop in stops]
    assert len(VIEWS) < len(stops) < MOST_STOPS, f"no exit from {names[-3:]}"
    assert [name for name, stop in zip(names, stops, strict=True) if not stop["isSeen"]] == []
    assert [name for name, stop in zip(names, stops, strict=True) if not stop["isInSight"]] == []
    back = [pair for pair, stop in zip(pairwise(names), stops[1:-1], strict=False) if stop["isBack"]]
    assert len(back) <= 1, f"in no order of reading: {back}"


@pytest.mark.matrix(light=2)
def test_its_help_lists_the_keys(opened: Page) -> None:
    opened.locator("main").focus()
    opened.keyboard.press("?")
    help_dialog = opened.get_by_role("dialog")
    help_dialog.locator("kbd").last.wait_for()
    assert violations(opened) == []
    opened.keyboard.press("Escape")
    help_dialog.wait_for(state="hidden")


def test_the_project_is_one_that_the_command_line_reads(running: Studio) -> None:
    assert (running.project / "carpet.toml").is_file()
    assert list(Path(running.project / "linkages").glob("*.toml"))
