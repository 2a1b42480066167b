"""The studio's server: what it must not import or call, and types that agree with the client's."""

import ast
import inspect
import json
import re
from pathlib import Path
from typing import Any

import pytest
from processes import printed, python
from sources import tree_of

from ilmek.io.mechanism_file import schema
from ilmek.jobs.studio.answers import Binary
from ilmek.web.api_page import with_table
from ilmek.web.endpoints import ENDPOINTS, Endpoint
from ilmek.web.openapi import openapi
from ilmek.web.safety import Access
from ilmek.web.schema import answer_type, messages

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


@pytest.mark.parametrize("name", ["knows_token", "knows_browser_token", "knows_password", "knows_cookie"])
def test_secrets_are_compared_in_constant_time(name: str) -> None:
    source = inspect.getsource(getattr(Access, name))
    assert "compare_digest" in source
    assert "==" not in source


def test_the_server_imports_no_engineering() -> None:
    script = (
        "import sys, ilmek.cli, ilmek.cli.studio; from ilmek.jobs.studio.project.opening import open_project\n"
        "heavy = {'numpy', 'scipy', 'numba', 'PIL', 'tomlkit', 'click.testing', 'ilmek.machines', 'ilmek.params'}\n"
        "print(sorted(heavy & set(sys.modules)))"
    )
    assert printed(python("-c", script), cwd=ROOT) == "[]\n"


def test_the_clients_types_are_those_of_the_server() -> None:
    committed = json.loads((ROOT / "studio" / "src" / "api" / "messages.json").read_text(encoding="utf-8"))
    assert committed == messages(), "run: python -m ilmek.web.schema studio/src/api && npm --prefix studio run types"


def test_the_client_knows_mechanism_files_by_their_declaration() -> None:
    committed = json.loads((ROOT / "studio" / "src" / "api" / "mechanism.json").read_text(encoding="utf-8"))
    assert committed == schema(), "run: make client"


def test_each_record_of_the_messages_is_a_type_of_the_client() -> None:
    text = (ROOT / "studio" / "src" / "api" / "messages.ts").read_text(encoding="utf-8")
    missing = [name for name in messages()["definitions"] if f"export interface {name} " not in text]
    assert [name for name in missing if f"export type {name} " not in text] == []


def test_the_api_is_described_whole() -> None:
    described = openapi()
    operations = {
        (method.upper(), path): operation
        for path, methods in described["paths"].items()
        for method, operation in methods.items()
    }
    assert {(endpoint.method, f"/api{re.sub(r':[a-z]+', '', endpoint.path)}") for endpoint in ENDPOINTS} <= set(
        operations
    )
    assert len({operation["operationId"] for operation in operations.values()}) == len(operations)
    for (method, path), operation in operations.items():
        assert operation["summary"].endswith(".")
        assert operation["description"]
        assert {"200", "202", "204"} & set(operation["responses"])
        assert {"401", "403", "421"} <= set(operation["responses"])
        in_path = {one["name"] for one in operation["parameters"] if one["in"] == "path"}
        assert in_path == set(re.findall(r"{(\w+)}", path))
        assert ("requestBody" in operation) == (method in ("POST", "PUT"))


def test_the_description_is_openapi() -> None:
    described = openapi()
    assert described["openapi"].startswith("3.1.")
    assert set(described) == {"openapi", "info", "security", "paths", "components"}
    waiting: list[Any] = [described]
    while waiting:
        part = waiting.pop()
        waiting.extend(part.values() if isinstance(part, dict) else part if isinstance(part, list) else ())
        if not isinstance(part, dict):
            continue
        if "$ref" in part and isinstance(part["$ref"], str):
            target: Any = described
            for name in part["$ref"].removeprefix("#/").split("/"):
                target = target[name]
        if isinstance(part.get("type"), str) and "scheme" not in part:
            assert part["type"] in {"object", "array", "string", "number", "integer", "boolean", "null"}
        if "required" in part and "properties" in part:
            assert set(part["required"]) <= set(part["properties"])
        if "responses" in part and "summary" in part:
            assert all(re.fullmatch(r"[1-5]\d\d", status) for status in part["responses"])
        if set(part) & {"200", "202"}:
            assert all("$ref" in one or one["description"] for one in part.values())


@pytest.mark.parametrize("endpoint", ENDPOINTS, ids=lambda endpoint: f"{endpoint.method} {endpoint.path}")
def test_an_answer_that_is_no_record_states_its_type(endpoint: Endpoint) -> None:
    assert (answer_type(endpoint) is Binary) == bool(endpoint.answer)


def test_the_page_of_the_api_has_every_request() -> None:
    page = (ROOT / "docs" / "reference" / "studio-api.md").read_text(encoding="utf-8")
    assert page == with_table(page), "run: python -m ilmek.web.api_page docs/reference/studio-api.md"
    assert page.count("| `") >= len(ENDPOINTS)


def test_no_two_endpoints_are_one() -> None:
    assert len({(endpoint.method, endpoint.path) for endpoint in ENDPOINTS}) == len(ENDPOINTS)
