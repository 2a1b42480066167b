"""Which test files run which function of the package, and how long they take."""

import ast
import hashlib
import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from mutants.operators import Mutant
from mutants.worker import Task, outcomes

KINDS = ("unit", "property", "reference")
"""Folders of tests that mutants are shown to: those of the architecture read sources, those of peers and golden runs
are slow."""
OF_DISPLAY = ("test_viz_*", "test_docs_*", "test_cli_*", "test_animation*", "test_mutants*", "test_chart_*")
"""Test files of what is looked at: they run everything slowly and check none of its numbers."""


@dataclass(frozen=True)
class TestFile:
    """A test file: seconds that it takes, `module function` of all that it runs, modules that it imports."""

    __test__ = False
    path: str
    seconds: float
    functions: frozenset[str]
    modules: frozenset[str]


def table(
    root: Path, package: str, kept: Path, *, jobs: int, show: Callable[[str], None], stale: bool = False
) -> list[TestFile]:
    """The table of all test files, made by running them; kept until a source or a test changes, longer if `stale`."""
    files = [
        str(path.relative_to(root))
        for kind in KINDS
        for path in sorted((root / "tests" / kind).glob("test_*.py"))
        if not any(path.match(pattern) for pattern in OF_DISPLAY)
    ]
    stamp = _stamp([*(root / "src").rglob("*.py"), *(root / file for file in files)])
    if kept.exists():
        found = json.loads(kept.read_text(encoding="utf-8"))
        if stale or found["stamp"] == stamp:
            return [_read(one) for one in found["files"] if (root / one["path"]).exists()]
    found = []
    for file, outcome in outcomes(root, ((file, Task((file,), record=package)) for file in files), jobs):
        if outcome.test:
            show(f"{file}: fails without a mutant, left out: {outcome.test}")
            continue
        seconds, used = (
            sum(outcome.seconds.values()),
            sorted({one for used in outcome.functions.values() for one in used}),
        )
        found.append({"path": file, "seconds": seconds, "functions": used, "modules": sorted(imported(root / file))})
        show(f"{file}: {len(used)} functions, {seconds:.1f} s")
    kept.parent.mkdir(parents=True, exist_ok=True)
    kept.write_text(json.dumps({"stamp": stamp, "files": found}), encoding="utf-8")
    return [_read(one) for one in found]


def concerned(files: Iterable[TestFile], mutant: Mutant, most_seconds: float) -> list[TestFile]:
    """The test files that run the mutant's function, or its module's for a constant of a module.

    Those that import its module come first, then the quick ones, until they would take too long.
    """
    name = f"{mutant.module} {mutant.function}"
    module = f"{mutant.module} "

    def runs(file: TestFile) -> bool:
        return any(used.startswith(module) for used in file.functions)

    exact = [file for file in files if mutant.function and name in file.functions]
    found = exact if exact else [file for file in files if mutant.module in file.modules or runs(file)]
    chosen: list[TestFile] = []
    for file in sorted(found, key=lambda file: (mutant.module not in file.modules, file.seconds, file.path)):
        if not chosen or sum(one.seconds for one in chosen) + file.seconds <= most_seconds:
            chosen.append(file)
    return chosen


def imported(path: Path) -> set[str]:
    """Modules that a file imports, and those whose names it imports."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
    return found


def _stamp(paths: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in sorted(paths):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _read(one: dict[str, object]) -> TestFile:
    path, seconds, functions, modules = one["path"], one["seconds"], one["functions"], one["modules"]
    assert isinstance(path, str)
    assert isinstance(seconds, float)
    assert isinstance(functions, list)
    assert isinstance(modules, list)
    return TestFile(path, seconds, frozenset(functions), frozenset(modules))
