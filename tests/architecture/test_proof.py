"""The proof of a programme shares no code with what compiles programmes."""

import ast
from pathlib import Path

from sources import tree_of

LOOM = Path(__file__).parents[2] / "src" / "ilmek" / "loom"
ALLOWED = {
    "ilmek.loom.operations",
    "ilmek.arrays",
    "ilmek.errors",
    "ilmek.num.compiled",
    "ilmek.progress",
    "ilmek.records",
}


def imported(path: Path) -> set[str]:
    """The modules of the package that a module imports."""
    nodes = list(ast.walk(tree_of(path)))
    found = {str(node.module) for node in nodes if isinstance(node, ast.ImportFrom)}
    found |= {f"{node.module}.{one.name}" for node in nodes if isinstance(node, ast.ImportFrom) for one in node.names}
    found |= {one.name for node in nodes if isinstance(node, ast.Import) for one in node.names}
    return {name for name in found if name.startswith("ilmek.")}


def test_the_proof_imports_the_types_of_operations_alone() -> None:
    own = "ilmek.loom.proof"
    for path in sorted((LOOM / "proof").glob("*.py")):
        others = {name for name in imported(path) if name != own and not name.startswith(f"{own}.")}
        assert all(any(name == one or name.startswith(f"{one}.") for one in ALLOWED) for name in others), path


def test_nothing_of_the_loom_imports_the_proof() -> None:
    others = [path for path in LOOM.rglob("*.py") if path.parent.name != "proof"]
    assert not [path for path in others if any("loom.proof" in name for name in imported(path))]
