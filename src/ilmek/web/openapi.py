"""The API as OpenAPI 3.1, from its table and the functions behind it."""

import inspect
import re
from dataclasses import dataclass
from functools import cache

from ilmek import __version__
from ilmek.jobs.studio.answers import Context
from ilmek.records import JsonObject
from ilmek.web.endpoints import ENDPOINTS, Endpoint
from ilmek.web.framing import JSON
from ilmek.web.schema import answer_type, record_schemas, request_type
from ilmek.web.worker import resolved

ERRORS = {
    400: "The JSON is none, or a field is not right.",
    401: "No token or cookie of the studio, or a wrong one.",
    403: "A request of another site.",
    404: "There is no such work, file or request.",
    413: "The body is too long.",
    415: "The body is of another type.",
    421: "A Host that is not the studio's.",
    422: "The task refuses: the message of the command line.",
    500: "A fault of the studio.",
    503: "Too many requests wait, or the answer took too long.",
    507: "The memory for one request is not enough.",
}
"""Status of an error and what it means."""

_ALWAYS = (401, 403, 421)
_OF_TASKS = (400, 422, 500, 503, 507)
_OF_BODIES = (413, 415)

_DESCRIPTION = """What `ilmek` computes, by HTTP. Numbers are in SI units and radians; a text may have a unit.

Send the token of the printed address as bearer. A long work answers 202 with its number; its progress comes by the
WebSocket `/api/events`, its answer is at `/api/work/{number}`."""

_ERROR = {
    "description": "What was given, what is allowed, and what to do.",
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

_WORK = {"type": "object", "properties": {"work": {"type": "integer"}}, "required": ["work"]}

_WORK_STATE = {
    "type": "object",
    "properties": {"work": {"type": "integer"}, "stage": {"type": "string"}, "share": {"type": "number"}},
    "required": ["work", "stage", "share"],
}


@dataclass(frozen=True, slots=True)
class OpenApiRequest:
    """A request without fields."""


def openapi_answer(request: OpenApiRequest, context: Context) -> JsonObject:  # noqa: ARG001 - a task's signature
    """The API as OpenAPI 3.1."""
    return openapi()


@cache
def openapi(endpoints: tuple[Endpoint, ...] = ENDPOINTS) -> JsonObject:
    """The API as OpenAPI 3.1."""
    schemas, components = record_schemas(endpoints, "#/components/schemas/{name}")
    paths: JsonObject = {}
    for endpoint in endpoints:
        path = "/api" + re.sub(r":\w+}", "}", endpoint.path)
        request = _followed(schemas[request_type(endpoint)], components)
        paths.setdefault(path, {})[endpoint.method.lower()] = {
            "summary": endpoint.summary,
            "description": inspect.getdoc(resolved(endpoint.function)[0]) or endpoint.summary,
            "operationId": _name(endpoint.method, path),
            "tags": [path.split("/")[2]],
            **_taken(endpoint, request),
            "responses": _responses(endpoint, schemas[answer_type(endpoint)]),
        }
    return {
        "openapi": "3.1.0",
        "info": {"title": "ilmek studio", "version": __version__, "description": _DESCRIPTION},
        "security": [{"token": []}],
        "paths": paths | _OWN_PATHS,
        "components": {
            "schemas": components | {"Error": _ERROR},
            "responses": {str(status): _error(status) for status in ERRORS},
            "securitySchemes": {"token": {"type": "http", "scheme": "bearer"}},
        },
    }


def _name(method: str, path: str) -> str:
    """The name of a request: `post_machines_name_design`."""
    return "_".join([method.lower(), *re.findall(r"[a-z]+", path.removeprefix("/api"))])


def _followed(schema: JsonObject, components: JsonObject) -> JsonObject:
    name = str(schema.get("$ref", "")).rpartition("/")[2]
    return dict(components[name]) if name else schema


def _taken(endpoint: Endpoint, request: JsonObject) -> JsonObject:
    """The parameters and the body of a request."""
    fields: JsonObject = {name: one for name, one in request.get("properties", {}).items() if name != "content"}
    required = [name for name in request.get("required", ()) if name in fields]
    in_path = [name for name in fields if re.search(rf"{{{name}[:}}]", endpoint.path)]
    further = [name for name in fields if name not in in_path]
    parameters = [_parameter("path", name, fields[name], required=True) for name in in_path]
    if endpoint.upload or not endpoint.has_body:
        parameters += [_parameter("query", name, fields[name], required=name in required) for name in further]
    if endpoint.upload:
        return {
            "parameters": parameters,
            "requestBody": {"required": True, "content": {kind: {} for kind in endpoint.upload}},
        }
    if not endpoint.has_body:
        return {"parameters": parameters}
    needed = [name for name in required if name in further]
    body = {"type": "object", "properties": {name: fields[name] for name in further}, "required": needed}
    if "description" in request:
        body["description"] = request["description"]
    if request.get("additionalProperties") is not None:
        body["additionalProperties"] = request["additionalProperties"]
    return {"parameters": parameters, "requestBody": {"required": bool(needed), "content": {JSON: {"schema": body}}}}


def _parameter(where: str, name: str, schema: JsonObject, *, required: bool) -> JsonObject:
    return {"name": name, "in": where, "required": required, "schema": schema}


def _responses(endpoint: Endpoint, answer: JsonObject) -> JsonObject:
    statuses = sorted((*_ALWAYS, *_OF_TASKS, *(_OF_BODIES if endpoint.has_body else ())))
    errors = {str(status): {"$ref": f"#/components/responses/{status}"} for status in statuses}
    if endpoint.work:
        begun = {"description": "A work has begun.", "content": {JSON: {"schema": _WORK}}, "x-answer": answer}
        return {"202": begun, **errors}
    kind = endpoint.answer or JSON
    schema = {"type": "object"} if endpoint.answer == JSON else answer
    good: JsonObject = {"description": "The answer.", "content": {kind: {"schema": schema} if schema else {}}}
    return {"200": good, **errors}


def _error(status: int) -> JsonObject:
    return {"description": ERRORS[status], "content": {JSON: {"schema": {"$ref": "#/components/schemas/Error"}}}}


def _own(summary: str, parameters: list[JsonObject], answers: JsonObject, *further: int) -> JsonObject:
    """A request that the server answers itself."""
    errors = {str(status): {"$ref": f"#/components/responses/{status}"} for status in sorted((*_ALWAYS, *further))}
    return {
        "summary": summary,
        "description": summary,
        "tags": ["studio"],
        "parameters": parameters,
        "responses": {**answers, **errors},
    }


def _own_paths() -> JsonObject:
    number = _parameter("path", "number", {"type": "integer", "minimum": 1}, required=True)
    path = _parameter("path", "path", {"type": "string"}, required=True)
    download = _parameter("query", "download", {"type": "integer"}, required=False)
    going = {"description": "The work goes on.", "content": {JSON: {"schema": _WORK_STATE}}}
    ended = {"description": "The answer of the work, of the type that its request states.", "content": {JSON: {}}}
    gone = {"description": "It is cancelled, or its answer forgotten."}
    described = {"description": "This description.", "content": {JSON: {"schema": {"type": "object"}}}}
    content = {"description": "The content of the file.", "content": {"application/octet-stream": {}}}
    paths = {
        "/api/work/{number}": {
            "get": _own("The state of a work, or its answer.", [number], {"200": ended, "202": going}, 404, *_OF_TASKS),
            "delete": _own("Cancel a work, or forget its answer.", [number], {"204": gone}, 404),
        },
        "/api/openapi.json": {"get": _own("This API as OpenAPI 3.1.", [], {"200": described})},
        "/files/{path}": {"get": _own("A file of the project.", [path, download], {"200": content}, 404)},
    }
    for address, methods in paths.items():
        for method, operation in methods.items():
            operation["operationId"] = _name(method, address)
    return paths


_OWN_PATHS = _own_paths()
