"""Every page of the documentation does what it says: its commands, files, quotations and examples."""

import os
import re
import shutil
from pathlib import Path

import pytest
from executed_pages import Block, PageError, execute, page_blocks
from executed_pages.blocks import RUN

ROOT = Path(__file__).parents[2]


def _is_executed(block: Block) -> bool:
    return not block.not_run and block.language in (*RUN, "doctest")


SLOW = {
    *("a-loom-for-weavers", "automated-loom", "automation-engineer", "check-a-programme", "connect-by-opc-ua"),
    *("factory-planner", "first-machine", "first-studio", "four-bar-for-a-motion", "four-bar-for-a-path"),
    *("machine-designer", "meet-a-deadline", "plan-a-factory", "prepare-a-picture", "read-a-programme", "run-the-loom"),
    *("shape-and-pile", "studio-api", "study-a-design", "take-an-order", "to-the-workshop", "tuft-a-picture"),
    *("tuft-with-a-gun", "use-it-from-python", "verdict", "weave-on-a-loom-that-exists", "weave-row-by-row"),
    "write-a-recipe",
}
"""Pages of more than three seconds of processor time."""

PAGES = [
    page
    for page in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md")))
    if not {"generated", "_build"} & {*page.parts}  # made from the sources, whose examples run where they stand
]
BLOCKS = {page: list(page_blocks(page.read_text(encoding="utf-8"))) for page in PAGES}
EXECUTED = [page for page in PAGES if any(_is_executed(block) for block in BLOCKS[page])]


@pytest.fixture
def shared(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder for carpets that several pages weave, and that the workers weave once for all of them."""
    base = tmp_path_factory.getbasetemp()
    return (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "woven-for-pages"


@pytest.mark.parametrize("page", [page for page in EXECUTED if page.stem not in SLOW], ids=lambda page: page.stem)
def test_a_page_does_what_it_says(page: Path, tmp_path: Path, shared: Path) -> None:
    _require_programs(page)
    assert execute(page, tmp_path, shared) > 0


@pytest.mark.matrix(light=0)
@pytest.mark.parametrize("page", [page for page in EXECUTED if page.stem in SLOW], ids=lambda page: page.stem)
def test_a_long_page_does_what_it_says(page: Path, tmp_path: Path, shared: Path) -> None:
    _require_programs(page)
    assert execute(page, tmp_path, shared) > 0


def test_blocks_that_are_not_run_are_few_and_say_why() -> None:
    reasons = [(page.name, block.not_run) for page in PAGES for block in BLOCKS[page] if block.not_run]
    assert len(reasons) <= 17
    assert sum(block.language in RUN for page in PAGES for block in BLOCKS[page]) > 8 * len(reasons)


def test_a_command_stands_in_a_block_that_is_run() -> None:
    outside = re.compile(r"^ {4}(\$ |ilmek |pip |make )", re.MULTILINE)
    for page in PAGES:
        assert not outside.search(page.read_text(encoding="utf-8")), page.name


def test_a_page_that_is_wrong_is_found(tmp_path: Path) -> None:
    wrong = {
        "exit code": "```sh\nilmek machines nothing\n```",
        "quotation": "```sh\nilmek --version\n```\n\n```text\nilmek 0.0.0\n```",
        "JSON": '```sh\nilmek design tufting --json -\n```\n\n```json\n{"holds": false, "…": "…"}\n```',
        "file": "```toml\na = 1\n```",
        "example": "    >>> 1 + 1\n    3\n",
    }
    for name, text in wrong.items():
        page = tmp_path / f"{name}.md"
        page.write_text(text, encoding="utf-8")
        with pytest.raises(PageError, match="block of line"):
            execute(page, tmp_path / f"{name} folder", tmp_path / "shared")


def _require_programs(page: Path) -> None:
    """Skip a page that calls a program which this machine lacks."""
    commands = " ".join(block.text for block in BLOCKS[page] if block.language in ("sh", "console"))
    for program in ("curl", "openssl"):
        if program in commands and shutil.which(program) is None:
            pytest.skip(f"{program} is missing")
