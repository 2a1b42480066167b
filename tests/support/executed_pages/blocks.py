"""The blocks of a page, in order."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

RUN = ("sh", "console", "text", "json", "toml", "csv", "python")
"""Languages of blocks that a page's test runs, writes or compares."""

_FENCE = re.compile(r"^(`{3,})(.*)$")
_CAPTION = re.compile(r"`([\w./-]+\.\w+)`[^`]*:$")
_MARK = re.compile(r"^<!-- not run: (.+) -->$")


@dataclass(frozen=True, slots=True)
class Block:
    """A block of a page.

    line      of its first line, from 1      language  of the fence; `doctest`: prose with `>>>` examples
    file      that its caption names, or ""  not_run   why it is not run, or ""
    """

    line: int
    language: str
    text: str
    file: str = ""
    not_run: str = ""


def page_blocks(page: str) -> Iterator[Block]:
    """All blocks of a page. Raises ValueError for a fence that is not closed."""
    lines = page.splitlines()
    prose = 0
    number = 0
    while number < len(lines):
        fence = _FENCE.match(lines[number])
        if fence is None:
            number += 1
            continue
        yield from _doctest(lines, prose, number)
        end = next((line for line in range(number + 1, len(lines)) if lines[line] == fence[1]), None)
        if end is None:
            raise ValueError(f"line {number + 1}: the fence is not closed")
        file, not_run = _heads(lines[:number])
        yield Block(number + 2, fence[2].strip(), "\n".join(lines[number + 1 : end]) + "\n", file, not_run)
        prose = number = end + 1
    yield from _doctest(lines, prose, len(lines))


def _doctest(lines: list[str], begin: int, end: int) -> Iterator[Block]:
    text = "\n".join(lines[begin:end]) + "\n"
    if ">>>" in text:
        yield Block(begin + 1, "doctest", text)


def _heads(lines: list[str]) -> tuple[str, str]:
    """The file of a block's caption, and why it is not run."""
    before = [line for line in lines[-4:] if line.strip()]
    mark = _MARK.match(before[-1]) if before else None
    caption = _CAPTION.search(before[-1]) if before else None
    return caption[1] if caption else "", mark[1] if mark else ""
