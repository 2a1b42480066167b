"""Records with arrays or mappings compare by identity, or can be hashed: neither == nor hash ever raises."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from sources import tree_of

SOURCES = sorted((Path(__file__).parents[2] / "src" / "ilmek").rglob("*.py"))
ARRAYS = re.compile(r"ndarray|Array\b|Float\[|Complex\[|Num\[|Int\[|Int8|Bool\[|Rgb|Indices|RealField|ComplexField")
MAPPINGS = re.compile(r"Mapping|dict\[|list\[|\bset\[")


@cache
def compared_by_value() -> tuple[tuple[str, ast.ClassDef], ...]:
    """The public dataclasses that compare by value."""
    return tuple(_compared_by_value())


def _compared_by_value() -> Iterator[tuple[str, ast.ClassDef]]:
    for path in SOURCES:
        for node in ast.walk(tree_of(path)):
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                decorators = " ".join(ast.unparse(one) for one in node.decorator_list)
                if re.search(r"\bdataclass\b|value_record", decorators) and "eq=False" not in decorators:
                    yield f"{path.stem}.{node.name}", node


def annotations(node: ast.ClassDef) -> str:
    """The types of a class's fields, those left out of the comparison excluded."""
    fields = [one for one in node.body if isinstance(one, ast.AnnAssign)]
    kept = [one for one in fields if one.value is None or "compare=False" not in ast.unparse(one.value)]
    return " ".join(ast.unparse(one.annotation) for one in kept if "ClassVar" not in ast.unparse(one.annotation))


def test_records_with_arrays_compare_by_identity() -> None:
    assert [name for name, node in compared_by_value() if ARRAYS.search(annotations(node))] == []


def test_records_with_mappings_can_be_hashed() -> None:
    hashed = "__hash__"
    unhashable = [
        name
        for name, node in compared_by_value()
        if MAPPINGS.search(annotations(node))
        and hashed not in {one.name for one in node.body if isinstance(one, ast.FunctionDef)}
    ]
    assert unhashable == []
