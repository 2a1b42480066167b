"""A page from its first block to its last."""

import contextlib
import doctest
import io
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from executed_pages.blocks import RUN, Block, page_blocks
from executed_pages.quotes import difference, json_difference
from executed_pages.shell import ROOT, Shell, expected_code, logical_lines


class PageError(AssertionError):
    """A page that does not do what it says."""


def execute(page: Path, folder: Path, shared: Path) -> int:
    """Follow a page in an empty folder; the number of blocks that were run, written or compared.

    shared  a folder for carpets that several pages weave. Raises PageError, with the line.
    """
    (folder / "work").mkdir(parents=True)
    shutil.copytree(ROOT / "examples", folder / "work" / "examples", ignore=shutil.ignore_patterns("__pycache__"))
    run = _PageRun(page, Shell(folder / "work", shared, folder))
    try:
        blocks = [block for block in page_blocks(page.read_text(encoding="utf-8")) if not block.not_run]
        return sum(run.block(block) for block in blocks)
    finally:
        run.shell.end()


class _PageRun:
    """What a page has done so far: its folder, the names of its Python blocks, what was printed last."""

    def __init__(self, page: Path, shell: Shell) -> None:
        self.page, self.shell = page, shell
        self.names: dict[str, Any] = {"__name__": "__main__"}
        self.printed: str | None = None

    def block(self, block: Block) -> bool:
        """Run, write or compare a block; whether its language is one of those."""
        if block.file and block.language != "sh":
            file = self.shell.folder / block.file
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(block.text, encoding="utf-8")
        elif block.language in _DO:
            _DO[block.language](self, block)
        elif block.language in RUN:
            self._fail(block, "a block that no line before it names as a file: end that line with `NAME`:")
        return block.language in (*RUN, "doctest")

    def sh(self, block: Block) -> None:
        """Run commands; a quotation behind them is of the last one."""
        outputs = [self._command(line, block) for line in logical_lines(block.text)]
        self.printed = outputs[-1]

    def console(self, block: Block) -> None:
        """Run each command behind `$`, and compare the lines below it."""
        for part in ("\n" + block.text).split("\n$ ")[1:]:
            line, _, quoted = part.partition("\n")
            self._compare(difference(quoted, self._command(line, block)), block)

    def text(self, block: Block) -> None:
        """Compare a quotation with what was printed."""
        self._compare(difference(block.text, self._last(block)), block)

    def json(self, block: Block) -> None:
        """Compare quoted JSON with what was printed."""
        self._compare(json_difference(block.text, self._last(block)), block)

    def python(self, block: Block) -> None:
        """Execute statements, or examples with `>>>`."""
        if ">>>" in block.text:
            self.doctest(block)
            return
        output = io.StringIO()
        with contextlib.chdir(self.shell.folder), contextlib.redirect_stdout(output):
            exec(compile("\n" * (block.line - 1) + block.text, str(self.page), "exec"), self.names)
        self.printed = output.getvalue()

    def doctest(self, block: Block) -> None:
        """Run examples, and compare what they give."""
        parser = doctest.DocTestParser()
        test = parser.get_doctest(block.text, self.names, self.page.stem, str(self.page), block.line - 1)
        report = io.StringIO()
        with contextlib.chdir(self.shell.folder):
            results = doctest.DocTestRunner(verbose=False).run(test, out=report.write, clear_globs=False)
        self.names.update(test.globs)
        if results.failed or not results.attempted:
            self._fail(block, report.getvalue() or "no example could be read")

    def _command(self, line: str, block: Block) -> str:
        code, output = self.shell.run(line)
        if code != expected_code(line):
            self._fail(block, f"{line.strip()!r} ends with exit code {code}:\n{output[-3000:]}")
        return output

    def _last(self, block: Block) -> str:
        if self.printed is None:
            self._fail(block, "nothing was printed before it")
        return self.printed or ""

    def _compare(self, difference: str, block: Block) -> None:
        if difference:
            self._fail(block, difference)

    def _fail(self, block: Block, reason: str) -> None:
        raise PageError(f"{self.page.name}, block of line {block.line}: {reason}")


_DO: Mapping[str, Callable[[_PageRun, Block], None]] = {
    "sh": _PageRun.sh,
    "console": _PageRun.console,
    "text": _PageRun.text,
    "json": _PageRun.json,
    "python": _PageRun.python,
    "doctest": _PageRun.doctest,
}
