"""Every page of the documentation does what it says: its commands, files, quotations and examples."""

import os
from pathlib import Path

import pytest
from executed_pages import execute, page_blocks
from executed_pages.blocks import RUN

ROOT = Path(__file__).parents[2]
SLOW: set[str] = set()
"""Pages of more than four seconds of processor time; they run in `make campaigns`."""

PAGES = [
    page
    for page in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md")))
    if not {"generated", "_build"} & {*page.parts}  # made from the sources, whose examples run where they stand
]
BLOCKS = {page: list(page_blocks(page.read_text(encoding="utf-8"))) for page in PAGES}
EXECUTED = [page for page in PAGES if any(block.language in (*RUN, "doctest") for block in BLOCKS[page])]


def _parameter(page: Path) -> object:
    marks = [pytest.mark.campaign] if page.stem in SLOW else []
    return pytest.param(page, id=page.stem, marks=marks)


@pytest.mark.parametrize("page", [_parameter(page) for page in EXECUTED])
def test_page_does_what_it_says(page: Path, tmp_path: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    shared = tmp_path_factory.getbasetemp() / "woven-for-pages"
    if "PYTEST_XDIST_WORKER" in os.environ:  # the workers weave a carpet once for all of them
        shared = shared.parents[1] / shared.name
    assert execute(page, tmp_path, shared) > 0
