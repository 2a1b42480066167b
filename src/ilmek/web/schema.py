"""The types of the API, from its table and the functions behind it.

python -m ilmek.web.schema FOLDER       writes messages.json: all records as one JSON Schema
"""

import json
import re
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, get_type_hints

import msgspec

from ilmek import __version__
from ilmek.jobs.studio.answers import PACKED, Binary, Context
from ilmek.web.endpoints import ENDPOINTS, Endpoint
from ilmek.web.worker import resolved


@dataclass(frozen=True, slots=True)
class SchemaRequest:
    """A request without fields."""


def openapi_answer(request: SchemaRequest, context: Context) -> dict[str, Any]:  # noqa: ARG001 - a task's signature
    """The API as OpenAPI 3.1."""
    return openapi()


def openapi(endpoints: Iterable[Endpoint] = ENDPOINTS) -> dict[str, Any]:
    """The API as OpenAPI 3.1."""
    endpoints = tuple(endpoints)
    schemas, components = _schemas(endpoints, "#/components/schemas/{name}")
    paths: dict[str, Any] = {}
    for endpoint in endpoints:
        request, answer = (schemas[kind] for kind in _types(endpoint))
        operation = _operation(endpoint, _followed(request, components), answer)
        path = re.sub(r":\w+}", "}", endpoint.path)
        paths.setdefault(f"/api{path}", {})[endpoint.method.lower()] = operation
    return {
        "openapi": "3.1.0",
        "info": {"title": "ilmek studio", "version": __version__, "description": _DESCRIPTION},
        "security": [{"token": []}],
        "paths": paths,
        "components": {
            "schemas": components | {"Error": _ERROR},
            "securitySchemes": {"token": {"type": "http", "scheme": "bearer"}},
        },
    }


def messages(endpoints: Iterable[Endpoint] = ENDPOINTS) -> dict[str, Any]:
    """All records of the API as one JSON Schema; the client's types are made from it."""
    _, components = _schemas(tuple(endpoints), "#/definitions/{name}")
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "Messages",
        "description": "The records of the studio's API.",
        "type": "object",
        "additionalProperties": False,
        "definitions": _draft_7(components),
    }


def _draft_7(schema: Any) -> Any:
    """A schema with the tuples of draft 7, `items` as a list, as the generator of types reads them."""
    if isinstance(schema, list):
        return [_draft_7(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    made = {key: _draft_7(value) for key, value in schema.items() if key != "prefixItems"}
    if "prefixItems" in schema:
        made |= {"items": _draft_7(schema["prefixItems"]), "additionalItems": False}
    return made


_DESCRIPTION = "SI units and radians. Works answer 202 with their number; see /api for how they go on."
_ERROR = {
    "type": "object",
    "properties": {
        "error": {
            "type": "object",
            "properties": {name: {"type": "string"} for name in ("given", "allowed", "do")},
            "required": ["given", "allowed", "do"],
        }
    },
    "required": ["error"],
}


def _types(endpoint: Endpoint) -> tuple[Any, Any]:
    function, request = resolved(endpoint.function)
    return request, get_type_hints(function)["return"]


def _further(endpoint: Endpoint) -> list[Any]:
    module = import_module(f"ilmek.jobs.{endpoint.function.partition(':')[0]}")
    return [getattr(module, name) for name in endpoint.records]


def _schemas(endpoints: tuple[Endpoint, ...], template: str) -> tuple[dict[Any, Any], dict[str, Any]]:
    """The schema of each type of requests and answers, and the records that they refer to, by name."""
    requests = [_types(endpoint)[0] for endpoint in endpoints]
    answers = [_types(endpoint)[1] for endpoint in endpoints]
    answers += [kind for endpoint in endpoints for kind in _further(endpoint)]
    kinds = list(dict.fromkeys(kind for kind in (*requests, *answers) if kind is not Binary))
    found, components = msgspec.json.schema_components(kinds, schema_hook=_any, ref_template=template)
    schemas = dict(zip(kinds, found, strict=True)) | {Binary: {}}
    doubled = sorted(name for name in components if not name.isidentifier())
    if doubled:
        raise TypeError(f"two records of the API have one name: {', '.join(doubled)}")
    asked = _reached([schemas[kind] for kind in requests], components)
    for name, schema in components.items():
        _complete(schema, optional=name in asked)
    return schemas, dict(sorted(components.items()))


def _any(kind: type) -> dict[str, Any]:
    """The schema of `object`: any JSON."""
    if kind is not object:
        raise TypeError(f"{kind} in a record of the API")
    return {"description": "any JSON"}


def _reached(schemas: Iterable[Any], components: dict[str, Any]) -> set[str]:
    """The names of the records that schemas refer to, directly or not."""
    names: set[str] = set()
    waiting = list(schemas)
    while waiting:
        schema = waiting.pop()
        if isinstance(schema, dict):
            name = str(schema.get("$ref", "")).rpartition("/")[2]
            if name and name not in names:
                names.add(name)
                waiting.append(components[name])
            waiting.extend(schema.values())
        elif isinstance(schema, list):
            waiting.extend(schema)
    return names


def _complete(schema: dict[str, Any], *, optional: bool) -> None:
    """Have a record name all its fields as required where it is never part of a request: answers are whole."""
    schema.pop("title", None)
    if "properties" in schema and not optional:
        schema["required"] = list(schema["properties"])
    for part in schema.get("properties", {}).values():
        part.pop("default", None)


def _followed(schema: dict[str, Any], components: dict[str, Any]) -> dict[str, Any]:
    name = str(schema.get("$ref", "")).rpartition("/")[2]
    return dict(components[name]) if name else schema


def _operation(endpoint: Endpoint, request: dict[str, Any], answer: dict[str, Any]) -> dict[str, Any]:
    properties: dict[str, Any] = dict(request.get("properties", {}))
    in_path = {
        name: properties.pop(name, {}) for name in properties.copy() if re.search(rf"{{{name}[:}}]", endpoint.path)
    }
    bodiless = endpoint.method in ("GET", "DELETE") or bool(endpoint.upload)
    required = [name for name in request.get("required", ()) if name in properties and name != "content"]
    operation: dict[str, Any] = {
        "summary": endpoint.summary,
        "operationId": endpoint.function.replace(":", "."),
        "parameters": [
            {"name": name, "in": "path", "required": True, "schema": schema} for name, schema in in_path.items()
        ],
        "responses": _responses(endpoint, answer),
    }
    if bodiless:
        operation["parameters"] += [
            {"name": name, "in": "query", "required": name in required, "schema": schema}
            for name, schema in properties.items()
            if name != "content"
        ]
    if endpoint.upload:
        operation["requestBody"] = {"required": True, "content": {kind: {} for kind in endpoint.upload}}
    elif not bodiless:
        body = {"type": "object", "properties": properties, "required": required}
        operation["requestBody"] = {"content": {"application/json": {"schema": body}}}
    return operation


def _responses(endpoint: Endpoint, answer: dict[str, Any]) -> dict[str, Any]:
    error = {
        "description": "error",
        "content": {"application/json": {"schema": {"$ref": "#/components/schemas/Error"}}},
    }
    if endpoint.work:
        work = {"type": "object", "properties": {"work": {"type": "integer"}}, "required": ["work"]}
        return {"202": {"description": "work", "content": {"application/json": {"schema": work}}}, "default": error}
    kind = "application/json" if answer else PACKED
    return {"200": {"description": "answer", "content": {kind: {"schema": answer}}}, "default": error}


def main() -> None:
    """Write messages.json to the folder that is given."""
    text = json.dumps(messages(), indent=1, ensure_ascii=False)
    (Path(sys.argv[1]) / "messages.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
