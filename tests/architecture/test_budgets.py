"""The budgets of the house: short files, short functions, imports at the top, no left-overs."""

import ast
import re
import statistics
from collections.abc import Iterator
from pathlib import Path

from sources import tree_of

SOURCES = sorted((Path(__file__).parents[2] / "src" / "ilmek").rglob("*.py"))
LAZY = {"cli", "jobs"}
"""Packages that import in a function what a command may not need."""
INDENTED_IMPORT = re.compile(r"^[ \t]+(import|from) ", re.MULTILINE)
CODE = [path for path in SOURCES if path.name != "__init__.py"]


def nodes(path: Path, *kinds: type[ast.AST]) -> Iterator[ast.AST]:
    yield from (node for node in ast.walk(tree_of(path)) if isinstance(node, kinds))


def body_lines(node: ast.AST) -> int:
    """Lines of a function or class without its docstring."""
    assert isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef)
    assert node.end_lineno is not None
    documented = ast.get_docstring(node, clean=False)
    docstring = node.body[0].end_lineno - node.body[0].lineno + 1 if documented else 0  # type: ignore[operator]
    return node.end_lineno - node.lineno + 1 - docstring


def over_budget(path: Path) -> Iterator[str]:
    text = path.read_text(encoding="utf-8")
    if len(text.splitlines()) > 400:
        yield f"{path}: over 400 lines"
    may_import = LAZY & set(path.parts[-3:-1]) or not INDENTED_IMPORT.search(text)
    for node in nodes(path, ast.FunctionDef, ast.AsyncFunctionDef):
        name = f"{path}: {node.name}"  # type: ignore[attr-defined]
        if body_lines(node) > 50:
            yield f"{name} is over 50 lines"
        if not may_import and any(isinstance(child, ast.Import | ast.ImportFrom) for child in ast.walk(node)):
            yield f"{name} imports"


def test_files_keep_their_budget() -> None:
    assert [fault for path in SOURCES for fault in over_budget(path)] == []


def test_medians_keep_their_budget() -> None:
    files = [len(path.read_text(encoding="utf-8").splitlines()) for path in CODE]
    functions = [body_lines(node) for path in CODE for node in nodes(path, ast.FunctionDef)]
    assert statistics.median(files) <= 150
    assert statistics.median(functions) <= 10


def undocumented(path: Path) -> Iterator[str]:
    tree = tree_of(path)
    if not ast.get_docstring(tree):
        yield str(path)
    for node in tree.body:
        named = isinstance(node, ast.FunctionDef | ast.ClassDef) and not ast.get_docstring(node)
        if named and not (node.name.startswith("_") or _is_overload(node)):
            yield f"{path}: {node.name}"


def test_every_public_name_is_documented() -> None:
    assert [name for path in SOURCES for name in undocumented(path)] == []


def _is_overload(node: ast.FunctionDef | ast.ClassDef) -> bool:
    return any(isinstance(one, ast.Name) and one.id == "overload" for one in node.decorator_list)
