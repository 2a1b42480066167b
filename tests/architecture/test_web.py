"""The studio's server: what it must not import or call, and types that agree with the client's."""

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest
from sources import tree_of

from ilmek.web.endpoints import ENDPOINTS
from ilmek.web.schema import messages, openapi

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "src" / "ilmek"
SOURCES = [path for folder in ("web", "jobs/studio") for path in sorted((PACKAGE / folder).rglob("*.py"))]
UNSAFE = {
    "pickle",
    "marshal",
    "shelve",
    "dill",
    "cloudpickle",
    "subprocess",
    "multiprocessing",
    "concurrent",
    "code",
    "pty",
}
UNSAFE_CALLS = {
    "eval",
    "exec",
    "compile",
    "system",
    "popen",
    "spawnl",
    "spawnv",
    "create_subprocess_shell",
    "__import__",
}


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_no_pickle_no_shell_no_code(path: Path) -> None:
    found: set[str] = set()
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.Import):
            found |= {alias.name.partition(".")[0] for alias in node.names} & UNSAFE
        elif isinstance(node, ast.ImportFrom):
            found |= {(node.module or "").partition(".")[0]} & UNSAFE
        elif isinstance(node, ast.Call):
            name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            allowed = isinstance(node.func, ast.Attribute) and getattr(node.func.value, "id", "") == "re"
            found |= {name} & UNSAFE_CALLS if not allowed else set()
            found |= {"shell"} & {keyword.arg for keyword in node.keywords}
    assert found == set()


def test_the_server_imports_no_engineering() -> None:
    script = (
        "import sys, ilmek.cli, ilmek.cli.studio; from ilmek.jobs.studio.project.opening import open_project\n"
        "heavy = {'numpy', 'scipy', 'numba', 'PIL', 'tomlkit', 'click.testing', 'ilmek.machines', 'ilmek.params'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    shown = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True)
    assert shown.stdout.strip() == "[]"


def test_the_clients_types_are_those_of_the_server() -> None:
    committed = json.loads((ROOT / "studio" / "src" / "api" / "messages.json").read_text(encoding="utf-8"))
    assert committed == messages(), "run: python -m ilmek.web.schema studio/src/api && npm --prefix studio run types"


def test_each_record_of_the_messages_is_a_type_of_the_client() -> None:
    text = (ROOT / "studio" / "src" / "api" / "messages.ts").read_text(encoding="utf-8")
    missing = [name for name in messages()["definitions"] if f"export interface {name} " not in text]
    assert [name for name in missing if f"export type {name} " not in text] == []


def test_the_api_is_described_whole() -> None:
    paths = openapi()["paths"]
    described = {(method.upper(), path) for path, methods in paths.items() for method in methods}
    assert len(described) == len(ENDPOINTS)
    for methods in paths.values():
        for operation in methods.values():
            assert operation["summary"].endswith(".")


def test_no_two_endpoints_are_one() -> None:
    assert len({(endpoint.method, endpoint.path) for endpoint in ENDPOINTS}) == len(ENDPOINTS)
