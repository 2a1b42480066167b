"""The syntax trees of source files, parsed once in a process."""

import ast
from functools import cache
from pathlib import Path


@cache
def tree_of(path: Path) -> ast.Module:
    """The syntax tree of a file. It is shared: read only."""
    return ast.parse(path.read_text(encoding="utf-8"))
