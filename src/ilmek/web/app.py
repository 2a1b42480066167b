"""The server's application: the table of the API, events, works, the client's files, who may use them."""

import asyncio
import re
import time
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path

import msgspec
from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import BaseRoute, Route, WebSocketRoute
from starlette.websockets import WebSocket

from ilmek import __version__
from ilmek.jobs.studio.project.watch import INTERVAL, ProjectWatch
from ilmek.web.api_page import api_page
from ilmek.web.endpoints import ENDPOINTS, FIRST, Endpoint
from ilmek.web.events import EventHub
from ilmek.web.framing import JSON, News, Reply, StepMessage, error_body
from ilmek.web.login import login_routes
from ilmek.web.pool import Pool, PoolFull
from ilmek.web.safety import CLOSE, LONGEST_BODY, Access, Guard
from ilmek.web.static_files import client_file, project_file
from ilmek.web.works import Works

GONE = 499
"""Status of an answer that nobody waits for."""

_INNER = (Endpoint("GET", "/openapi.json", "ilmek.web.openapi:openapi_answer", "This API as OpenAPI 3.1."),)


def studio_app(
    project: str,
    access: Access,
    cookie_name: str,
    pool: Pool | None = None,
    endpoints: tuple[Endpoint, ...] = ENDPOINTS,
) -> Starlette:
    """The application that serves a project.

    project    folder      access, cookie_name  who may use it      pool  default: one of its own
    endpoints  the API; default: all of it
    """
    pool = pool or Pool(project, first=FIRST)
    hub = EventHub({"version": __version__, "start": time.time_ns() // 1_000_000}, lambda page: works.page_left(page))  # noqa: PLW0108 - works follows
    works = Works(pool, hub)

    @asynccontextmanager
    async def life(app: Starlette) -> AsyncIterator[None]:  # noqa: ARG001 - starlette gives it
        start = asyncio.ensure_future(pool.start())
        watch = asyncio.ensure_future(_announced_changes(Path(project), hub))
        try:
            yield
        finally:
            watch.cancel()
            hub.close()
            await start
            await works.close()
            await pool.close()

    async def events(socket: WebSocket) -> None:
        await hub.serve(socket)

    routes: list[BaseRoute] = [
        *(_route(endpoint, pool, works, hub) for endpoint in (*endpoints, *_INNER)),
        Route("/api/work/{number:int}", _work(works), methods=["GET", "DELETE"]),
        WebSocketRoute("/api/events", events),
        Route("/api", api_page),
        Route("/api/{path:path}", _unknown, methods=["GET", "POST", "PUT", "DELETE"]),
        *login_routes(access, cookie_name),
        Route("/files/{path:path}", project_file),
        Route("/", client_file),
        Route("/{path:path}", client_file),
    ]
    app = Starlette(
        routes=routes, middleware=[Middleware(Guard, access=access, cookie_name=cookie_name)], lifespan=life
    )
    app.state.project, app.state.endpoints = project, endpoints
    return app


async def _announced_changes(project: Path, hub: EventHub) -> None:
    """Tell the pages which files of the project have changed, whoever changed them."""
    watch = ProjectWatch(project)
    while True:
        await asyncio.sleep(INTERVAL)
        if paths := await asyncio.to_thread(watch.changes):
            hub.send({"type": "changed", "paths": paths})


def _route(endpoint: Endpoint, pool: Pool, works: Works, hub: EventHub) -> Route:
    def follow(message: StepMessage | News) -> None:
        if isinstance(message, News) and message.everyone:
            hub.send({"type": "announced", "news": msgspec.Raw(message.body)})

    async def answered(request: Request) -> Response:
        began = time.perf_counter()
        taken = await _taken(request, endpoint)
        if isinstance(taken, Response):
            return taken
        body, content = taken
        language = request.headers.get("x-language", "")[:8]
        try:
            if endpoint.work:
                page = request.headers.get("x-page", "")[:64]
                number = works.start(endpoint.function, body, endpoint.limit, page, content, language)
                return Response(msgspec.json.encode({"work": number}), 202, media_type=JSON)
            answer = await _while_wanted(
                request,
                pool.answer(
                    endpoint.function,
                    body,
                    limit=endpoint.limit,
                    affinity=endpoint.affinity,
                    lax=not endpoint.has_body,
                    content=content,
                    language=language,
                    follow=follow,
                ),
            )
        except PoolFull:
            return _error(503, "too many requests wait", do="try again in a moment")
        if answer is None:
            return Response(status_code=GONE)
        return _response(answer, time.perf_counter() - began)

    return Route(f"/api{endpoint.path}", answered, methods=[endpoint.method])


async def _taken(request: Request, endpoint: Endpoint) -> tuple[bytes, bytes | None] | Response:
    """The JSON of a request, and the content of an upload; or the refusal."""
    fields: dict[str, object] = dict(request.path_params)
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if endpoint.upload or not endpoint.has_body:
        fields = {**request.query_params, **fields}
    if not endpoint.has_body:
        return msgspec.json.encode(fields), None
    if kind not in (endpoint.upload or (JSON,)):
        return _error(415, f"a body of {kind or 'no type'}", allowed=" or ".join(endpoint.upload or (JSON,)))
    body = await _body(request)
    if body is None:
        refusal = _error(413, f"a body of more than {LONGEST_BODY:,} bytes", do="take a smaller file")
        refusal.headers.update(CLOSE)
        return refusal
    if endpoint.upload:
        return msgspec.json.encode(fields), body
    return _merged(body, fields), None


def _merged(body: bytes, fields: dict[str, object]) -> bytes:
    """The JSON of a body with further fields behind its own, which are not read here.

    >>> _merged(b'{"a": 1} ', {"name": "x"})
    b'{"a": 1,"name":"x"}'
    >>> _merged(b"", {})
    b'{}'
    """
    body = body.strip() or b"{}"
    if not fields or not body.endswith(b"}"):
        return body
    inside = body[:-1].rstrip()
    return inside + (b"" if inside == b"{" else b",") + msgspec.json.encode(fields)[1:]


async def _body(request: Request) -> bytes | None:
    """The body of a request; None: it is too long, whatever its headers state."""
    parts: list[bytes] = []
    size = 0
    async for part in request.stream():
        size += len(part)
        if size > LONGEST_BODY:
            return None
        parts.append(part)
    return b"".join(parts)


async def _while_wanted(request: Request, answer: Awaitable[Reply]) -> Reply | None:
    """The answer; None: the client has gone, and the request was cancelled."""
    task = asyncio.ensure_future(answer)
    gone = asyncio.ensure_future(_disconnected(request))
    try:
        await asyncio.wait((task, gone), return_when=asyncio.FIRST_COMPLETED)
        return task.result() if task.done() else None
    finally:
        task.cancel()
        gone.cancel()


async def _disconnected(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass


def _work(works: Works) -> Callable[[Request], Awaitable[Response]]:
    async def work(request: Request) -> Response:
        number = request.path_params["number"]
        if request.method == "DELETE":
            return Response(status_code=204) if works.cancel(number) else _no_work(number)
        answer = works.state(number)
        return _no_work(number) if answer is None else _response(answer, answer.time)

    return work


def _no_work(number: int) -> Response:
    return _error(404, f"there is no work {number}", do="start it again")


def _response(answer: Reply, total: float) -> Response:
    times = f"task;dur={1000 * answer.time:.1f}, wait;dur={1000 * max(total - answer.time, 0.0):.1f}"
    headers = {"server-timing": times, "cache-control": "no-store"}
    return Response(answer.body, answer.status, headers, media_type=answer.kind)


def _error(status: int, given: str, *, allowed: str = "", do: str = "") -> Response:
    return Response(error_body(given, allowed=allowed, do=do), status, media_type=JSON)


async def _unknown(request: Request) -> Response:
    if request.path_params["path"] == "":
        return RedirectResponse("/api")
    path = re.sub(r"[^ -~]", "?", request.url.path)[:200]
    return _error(404, f"{request.method} {path} is not in the API", do="see /api")
