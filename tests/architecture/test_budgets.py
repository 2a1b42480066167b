"""The budgets of the house: short files, short functions, imports at the top, no left-overs."""

import ast
import re
import statistics
from collections.abc import Iterator
from pathlib import Path

import pytest
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


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: "/".join(path.parts[-2:]))
def test_file_keeps_its_budget(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 400
    for node in nodes(path, ast.FunctionDef, ast.AsyncFunctionDef):
        assert body_lines(node) <= 50, f"{path.name}: {node.name} is too long"  # type: ignore[attr-defined]
    if INDENTED_IMPORT.search(text) and not LAZY & set(path.parts[-3:-1]):
        for node in nodes(path, ast.FunctionDef, ast.AsyncFunctionDef):
            inner = [child for child in ast.walk(node) if isinstance(child, ast.Import | ast.ImportFrom)]
            assert not inner, f"{path.name}: import inside {node.name}"  # type: ignore[attr-defined]


def test_medians_keep_their_budget() -> None:
    files = [len(path.read_text(encoding="utf-8").splitlines()) for path in CODE]
    functions = [body_lines(node) for path in CODE for node in nodes(path, ast.FunctionDef)]
    assert statistics.median(files) <= 150
    assert statistics.median(functions) <= 10


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: "/".join(path.parts[-2:]))
def test_every_public_name_is_documented(path: Path) -> None:
    tree = tree_of(path)
    assert ast.get_docstring(tree), f"{path} has no docstring"
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not (node.name.startswith("_") or _is_overload(node)):
            assert ast.get_docstring(node), f"{path.name}: {node.name} has no docstring"


def _is_overload(node: ast.FunctionDef | ast.ClassDef) -> bool:
    return any(isinstance(one, ast.Name) and one.id == "overload" for one in node.decorator_list)
