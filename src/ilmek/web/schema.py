"""The types of requests and answers, from the table of the API and the functions behind it.

python -m ilmek.web.schema FOLDER       writes messages.json: all records as one JSON Schema
"""

import json
import sys
from collections.abc import Iterable
from importlib import import_module
from pathlib import Path
from typing import Any, get_type_hints

import msgspec
import numpy as np

from ilmek.jobs.studio.answers import Binary
from ilmek.records import JsonObject
from ilmek.web.endpoints import ENDPOINTS, Endpoint
from ilmek.web.worker import resolved


def messages(endpoints: Iterable[Endpoint] = ENDPOINTS) -> JsonObject:
    """All records of the API as one JSON Schema; the client's types are made from it."""
    _, components = record_schemas(tuple(endpoints), "#/definitions/{name}")
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "Messages",
        "description": "The records of the studio's API.",
        "type": "object",
        "additionalProperties": False,
        "definitions": _draft_7(components),
    }


def _draft_7(schema: object) -> Any:
    """A schema with the tuples of draft 7, `items` as a list, as the generator of types reads them."""
    if isinstance(schema, list):
        return [_draft_7(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    made = {key: _draft_7(value) for key, value in schema.items() if key != "prefixItems"}
    if "prefixItems" in schema:
        made |= {"items": _draft_7(schema["prefixItems"]), "additionalItems": False}
    return made


def request_type(endpoint: Endpoint) -> Any:
    """The type of a request."""
    return resolved(endpoint.function)[1]


def answer_type(endpoint: Endpoint) -> Any:
    """The type of an answer, or Binary."""
    return get_type_hints(resolved(endpoint.function)[0])["return"]


def _further(endpoint: Endpoint) -> list[Any]:
    module = import_module(f"ilmek.jobs.{endpoint.function.partition(':')[0]}")
    return [getattr(module, name) for name in endpoint.records]


def record_schemas(endpoints: tuple[Endpoint, ...], template: str) -> tuple[dict[Any, Any], JsonObject]:
    """The schema of each type of requests and answers, and the records that they refer to, by name."""
    requests = [request_type(endpoint) for endpoint in endpoints]
    answers = [answer_type(endpoint) for endpoint in endpoints]
    answers += [kind for endpoint in endpoints for kind in _further(endpoint)]
    kinds = list(dict.fromkeys(kind for kind in (*requests, *answers) if kind is not Binary))
    found, components = msgspec.json.schema_components(kinds, schema_hook=_custom, ref_template=template)
    schemas = dict(zip(kinds, found, strict=True)) | {Binary: {}}
    doubled = sorted(name for name in components if not name.isidentifier())
    if doubled:
        raise TypeError(f"two records of the API have one name: {', '.join(doubled)}")
    asked = _reached([schemas[kind] for kind in requests], components)
    for name, schema in components.items():
        _complete(schema, optional=name in asked)
    return schemas, dict(sorted(components.items()))


def _custom(kind: type) -> JsonObject:
    """The schema of what `json_value` encodes, and of `object`: any JSON."""
    if kind is object:
        return {"description": "any JSON"}
    if kind is complex:
        return {"type": "array", "prefixItems": [{"type": "number"}] * 2, "minItems": 2, "maxItems": 2}
    if getattr(kind, "array_type", kind) is np.ndarray:  # as jaxtyping declares it, where that is loaded
        return {"type": "array", "items": {"type": ["number", "null"]}}
    raise TypeError(f"{kind} in a record of the API")


def _reached(schemas: Iterable[object], components: JsonObject) -> set[str]:
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


def _complete(schema: JsonObject, *, optional: bool) -> None:
    """Have a record name all its fields as required where it is never part of a request: answers are whole."""
    schema.pop("title", None)
    if "properties" in schema and not optional:
        schema["required"] = list(schema["properties"])
    for part in schema.get("properties", {}).values():
        part.pop("default", None)


def main() -> None:
    """Write messages.json to the folder that is given."""
    text = json.dumps(messages(), indent=1, ensure_ascii=False)
    (Path(sys.argv[1]) / "messages.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
