"""Fingers on the canvases: two that part zoom, one drags a joint or turns a force, and the page does not move."""

from collections.abc import Iterator
from math import hypot

import pytest
from playwright.sync_api import Browser, CDPSession, Page, expect
from studio_browser import Seen, Studio, context_of, data_of, middle, open_view, settled, until_data

LINKAGE = "linkages/four-bar.toml"
PRESS = "linkages/slider-crank-press.toml"


class Fingers:
    """Fingers on a touch screen, by the protocol of the browser's developer tools."""

    def __init__(self, page: Page) -> None:
        self._session: CDPSession = page.context.new_cdp_session(page)

    def _send(self, kind: str, *points: tuple[float, float]) -> None:
        touches = [{"x": x, "y": y, "id": finger} for finger, (x, y) in enumerate(points)]
        self._session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})

    def part(self, at: tuple[float, float], before: float, after: float) -> None:
        """Two fingers, so far apart [px], go on one line to another distance."""
        x, y = at
        self._send("touchStart", (x - before / 2, y), (x + before / 2, y))
        for step in (0.25, 0.5, 0.75, 1.0):
            apart = before + step * (after - before)
            self._send("touchMove", (x - apart / 2, y), (x + apart / 2, y))
        self._send("touchEnd")

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """A finger goes along a line."""
        self._send("touchStart", start)
        (x, y), (to_x, to_y) = start, end
        for step in (0.2, 0.4, 0.6, 0.8, 1.0):
            self._send("touchMove", (x + step * (to_x - x), y + step * (to_y - y)))
        self._send("touchEnd")


@pytest.fixture
def touched(browser: Browser, running: Studio) -> Iterator[Page]:
    seen = Seen()
    with context_of(browser, touch=True) as context:
        page = context.new_page()
        seen.watch(page, running.base)
        yield page
    assert seen.faults == []


def _apart(page: Page) -> float:
    (ax, ay), (bx, by) = (middle(page, f"[data-joint={name}] .pin") for name in ("A0", "B0"))
    return hypot(bx - ax, by - ay)


def test_two_fingers_zoom_a_linkage_and_one_drags_a_joint(touched: Page, running: Studio) -> None:
    open_view(touched, running, "linkage/four-bar")
    settled(touched)
    fingers = Fingers(touched)
    before = _apart(touched)
    fingers.part(middle(touched, ".linkage-canvas"), 200, 100)
    assert _apart(touched) / before == pytest.approx(0.5, rel=0.02)
    length = data_of(running.project, LINKAGE)["bodies"]
    x, y = middle(touched, "[data-joint=B0] .pin")
    fingers.drag((x, y), (x + 60, y))
    until_data(running.project, LINKAGE, lambda data: data["bodies"] != length)
    assert touched.evaluate("scrollY") == 0


def test_a_finger_turns_a_force_by_its_tip(touched: Page, running: Studio) -> None:
    open_view(touched, running, "linkage/slider-crank-press")
    settled(touched)
    x, y = middle(touched, "[data-load=cutting]")
    start = data_of(running.project, PRESS)["loads"]["cutting"]
    assert (start["force"], start["direction"]) == ("4kN", "90deg")
    Fingers(touched).drag((x, y), (x + 84, y))  # 84 px upwards are 4 kN: now 84 to the right beside
    until_data(running.project, PRESS, lambda data: data["loads"]["cutting"]["direction"] == "45deg")
    assert data_of(running.project, PRESS)["loads"]["cutting"]["force"] == "5660N"


def test_two_fingers_zoom_the_drawing_of_a_machine(touched: Page, running: Studio) -> None:
    open_view(touched, running, "machine/beat-up")
    settled(touched)
    stage = touched.locator(".fig-stage").first
    fit = stage.get_by_role("button", name="Show all", exact=True)
    expect(fit).to_be_disabled()
    Fingers(touched).part(middle(touched, ".fig-stage .fig-view"), 60, 180)
    expect(fit).to_be_enabled()
    fit.click()
    expect(fit).to_be_disabled()
