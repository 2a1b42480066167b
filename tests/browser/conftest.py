"""One browser and one studio for all tests, a project as new for each file, and no fault of a page unnoticed."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect, sync_playwright
from studio_browser import PATIENCE, Seen, Studio, browser_path, context_of, launched, studio

expect.set_options(timeout=PATIENCE)


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    if browser_path() is None:
        pytest.skip("no Chromium here: make browser installs it where it may")
    with sync_playwright() as playwright:
        browser = launched(playwright)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def example(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Studio, Path]]:
    """A studio on the example project, and a copy of that."""
    folder = tmp_path_factory.mktemp("studio")
    with studio(folder / "project") as served:
        shutil.copytree(served.project, folder / "copy", ignore=shutil.ignore_patterns(".studio"))
        yield served, folder / "copy"


@pytest.fixture(scope="module")
def running(example: tuple[Studio, Path]) -> Studio:
    """The studio, with its project as new."""
    served, copy = example
    served.restore(copy)
    return served


@pytest.fixture
def seen() -> Seen:
    return Seen()


@pytest.fixture
def page(browser: Browser, running: Studio, seen: Seen) -> Iterator[Page]:
    """A page of the studio, already entered; the test fails for each fault of it."""
    with context_of(browser) as context:
        page = context.new_page()
        seen.watch(page, running.base)
        page.goto(running.address)
        yield page
        page.unroute_all(behavior="wait")
    assert seen.faults == []
