"""What a test may not do: start a program that could outlive it, wait for a time to pass."""

import ast
from collections.abc import Iterator
from pathlib import Path

from sources import tree_of

TESTS = Path(__file__).parents[1]
FORBIDDEN = {"subprocess", "time.sleep", "os.fork", "pty.fork"}
"""`processes.start` and `processes.until` replace them."""


def uses(tree: ast.Module) -> Iterator[str]:
    """Modules that a file imports, and names in modules that it uses."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (node.module or "", *(f"{node.module}.{alias.name}" for alias in node.names))
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            yield f"{node.value.id}.{node.attr}"


def test_programs_are_ended_and_events_awaited() -> None:
    forbidden = {path.name: FORBIDDEN & {*uses(tree_of(path))} for path in TESTS.glob("*/test_*.py")}
    assert {name: found for name, found in forbidden.items() if found} == {}


def test_the_rule_finds_each_way() -> None:
    text = "import subprocess\nfrom time import sleep\nimport os\nos.fork()\npty.fork()\ntime.sleep(1)"
    assert set(uses(ast.parse(text))) >= FORBIDDEN
