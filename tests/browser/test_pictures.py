"""Each view looks as it did: light, dark and on a phone, compared with kept pictures.

The kept pictures are in tests/browser/pictures. After a change of the looks, look at the views, then keep new pictures:

    RENEW_PICTURES=1 .venv/bin/pytest -n 0 tests/browser/test_pictures.py

A picture that differs is written beside the kept one as NAME.seen.png, which git ignores.
"""

import os
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page
from studio_browser import VIEWS, Studio, context_of, open_view, settled

from pictures import SHARE, difference, keep

FOLDER = Path(__file__).parent / "pictures"
MOST_BYTES = 1_500_000
RENEW = "RENEW_PICTURES" in os.environ
TRIES = 4


@pytest.mark.matrix(light=4)
@pytest.mark.parametrize("view", VIEWS)
def test_a_view_looks_as_it_did(browser: Browser, running: Studio, view: str) -> None:
    with context_of(browser) as context:
        page = context.new_page()
        open_view(page, running, view)
        found = [_differing(page, f"{view}-light")]
        page.emulate_media(color_scheme="dark")
        found.append(_differing(page, f"{view}-dark"))
        page.emulate_media(color_scheme="light")
        page.set_viewport_size({"width": 390, "height": 844})
        found.append(_differing(page, f"{view}-phone"))
    assert max(found) <= SHARE, f"shares of the pictures that differ: {found}; see the docstring of this file"


def _differing(page: Page, name: str) -> float:
    """How far a page differs from the kept picture: it gets some time to look the same."""
    path = FOLDER / f"{name}.png"
    share = 1.0
    for _ in range(1 if RENEW else TRIES):
        settled(page)
        screenshot = page.screenshot()
        if RENEW:
            keep(screenshot, path)
        share = difference(screenshot, path)
        if share <= SHARE:
            return share
    keep(screenshot, path.with_suffix(".seen.png"))
    return share


def test_the_kept_pictures_are_small() -> None:
    assert sum(path.stat().st_size for path in FOLDER.glob("*.png") if ".seen" not in path.name) <= MOST_BYTES
