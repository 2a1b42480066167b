"""The options and the paths that `make shapes` runs: unit and property tests of the engine.

A test is one of the engine's where it imports one of its packages, and nothing of the machines, files and commands.
"""

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

from sources import tree_of

ROOT = Path(__file__).parents[2]
ENGINE = ("linkage", "plane", "num", "dynamics", "cams", "carpet", "weaving")
BEYOND = {"machines", "verification", "jobs", "io", "viz", "cli"}
# Packages above and below the engine have protocols that cannot be checked while it runs.
CHECKED = (
    "--jaxtyping-packages=" + ",".join((*(f"ilmek.{package}" for package in ENGINE), "typecheck.checker")),
    "-W=ignore::hypothesis.errors.HypothesisDeprecationWarning",  # the checker tries random items of a list
)


def imported_packages(path: Path) -> set[str]:
    """Packages of ilmek that a test file imports."""
    modules = [node for node in ast.walk(tree_of(path)) if isinstance(node, ast.ImportFrom)]
    names = [f"{node.module}.{alias.name}".split(".") for node in modules for alias in node.names]
    return {name[1] for name in names if name[0] == "ilmek"}


def engine_paths() -> Iterator[str]:
    """Paths relative to the repository."""
    for kind in ("unit", "property"):
        for path in sorted((ROOT / "tests" / kind).glob("test_*.py")):
            packages = imported_packages(path)
            if packages & set(ENGINE) and not packages & BEYOND:
                yield str(path.relative_to(ROOT))


if __name__ == "__main__":
    sys.stdout.write(" ".join((*CHECKED, *engine_paths())))
