"""Each view opens on the example project: legible, accessible, and without a request off the machine."""

from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page
from studio_browser import VIEWS, Seen, Studio, context_of, open_view, settled, violations


@pytest.mark.parametrize("view", VIEWS)
def test_a_view_opens_with_a_finished_example(page: Page, running: Studio, view: str) -> None:
    open_view(page, running, view)
    settled(page)
    assert page.locator("main h1").count() == 1
    assert page.locator("[role=alert]:visible").count() == 0


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("view", VIEWS)
def test_axe_finds_nothing(browser: Browser, running: Studio, seen: Seen, view: str, dark: bool) -> None:
    with context_of(browser, dark=dark) as context:
        page = context.new_page()
        seen.watch(page, running.base)
        open_view(page, running, view)
        settled(page)
        assert violations(page) == []
    assert seen.faults == []


@pytest.mark.parametrize("width", [390, 3840])
@pytest.mark.parametrize("view", VIEWS)
def test_nothing_is_cut_off(browser: Browser, running: Studio, seen: Seen, view: str, width: int) -> None:
    with context_of(browser, width=width, height=844 if width < 500 else 2160) as context:
        page = context.new_page()
        seen.watch(page, running.base)
        open_view(page, running, view)
        settled(page)
        assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert seen.faults == []


def test_the_project_is_one_that_the_command_line_reads(running: Studio) -> None:
    assert (running.project / "carpet.toml").is_file()
    assert list(Path(running.project / "linkages").glob("*.toml"))
