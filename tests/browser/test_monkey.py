"""Random input for a while: no error, and in a campaign no growth of memory.

Seconds by ILMEK_MONKEY: 5 in `make test`, more in a campaign. Its seed by ILMEK_MONKEY_SEED.
"""

import os

from monkey import walk
from playwright.sync_api import Page
from studio_browser import Seen, Studio, open_view, settled

SECONDS = float(os.environ.get("ILMEK_MONKEY", "5"))
SEED = int(os.environ.get("ILMEK_MONKEY_SEED", "1"))
WARM = 20.0
"""Shortest walk whose growth of memory counts [s]: the server starts its workers in the first seconds."""


def test_a_monkey_finds_no_error(page: Page, running: Studio, seen: Seen) -> None:
    page.on("dialog", lambda dialog: dialog.dismiss())
    seen.expected = ("status of 422", "status of 400", "status of 409", "status of 412")  # what it typed is wrong
    open_view(page, running, "carpet")

    def check() -> None:
        assert seen.faults == []

    walked = walk(page, running.process.pid, SEED, SECONDS, check)
    assert walked.actions > 0
    if SECONDS >= WARM:
        for early, late in (walked.heap, walked.resident):
            assert late < 1.5 * early + 100e6
    page.reload()
    open_view(page, running, "machine")
    settled(page)
    assert page.locator("main h1").count() == 1
