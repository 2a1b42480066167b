"""A studio's server in a thread, on a free port, and a client that sends what no browser would."""

import http.client
import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import studio_tasks
import uvicorn
from processes import PATIENCE, python, until
from websockets.sync.client import ClientConnection, connect

from ilmek.web.app import studio_app
from ilmek.web.endpoints import ENDPOINTS
from ilmek.web.pool import Pool
from ilmek.web.safety import Access
from ilmek.web.serve import StudioOrder, access_to, bound_socket, server_settings

JSON = {"content-type": "application/json"}
UNPREPARED = tuple(python(Path(__file__).with_name("unprepared_worker.py")))
"""Starts a worker of the real tasks that prepares nothing."""


@dataclass
class Answer:
    status: int
    headers: dict[str, str]
    body: bytes

    @property
    def json(self) -> Any:
        return json.loads(self.body)

    @property
    def given(self) -> str:
        return str(self.json["error"]["given"])


@dataclass
class Studio:
    port: int
    access: Access
    pool: Pool
    project: Path
    server: uvicorn.Server

    def connections(self) -> int:
        """The number of connections that are open."""
        return len(self.server.server_state.connections)

    @property
    def cookie(self) -> dict[str, str]:
        return {"cookie": f"ilmek-studio-{self.port}={self.access.cookie}"}

    def busy(self) -> list[int]:
        """The processes of the workers that have a request."""
        return [worker.process.pid for worker in self.pool._workers if worker.request is not None]

    def send(self, method: str, path: str, body: Any = None, headers: dict[str, str] | None = None) -> Answer:
        """The answer to a request, with the cookie where no headers are given."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        sent = dict(self.cookie if headers is None else headers)
        if body is not None and not isinstance(body, bytes):
            body, sent = json.dumps(body).encode(), {**JSON, **sent}
        try:
            connection.request(method, path, body, sent)
            reply = connection.getresponse()
            answered = {name.lower(): ", ".join(reply.headers.get_all(name, ())) for name in reply.headers}
            return Answer(reply.status, answered, reply.read())
        finally:
            connection.close()

    def events(self, headers: dict[str, str] | None = None, page: str = "") -> ClientConnection:
        sent = self.cookie if headers is None else headers
        return connect(f"ws://127.0.0.1:{self.port}/api/events?page={page}", additional_headers=sent, proxy=None)


@contextmanager
def studio(
    project: Path, *, password: str = "", size: int = 3, real: bool = False, **pool_fields: Any
) -> Iterator[Studio]:
    """A server of the tasks of `studio_tasks`, or of the real ones."""
    listener = bound_socket("127.0.0.1", 0)
    port = int(listener.getsockname()[1])
    access = access_to(StudioOrder(project, password=password), port, "secret of the test")
    endpoints = ENDPOINTS if real else studio_tasks.ENDPOINTS
    command = {"command": UNPREPARED if real else studio_tasks.COMMAND}
    pool = Pool(str(project), size=size, **{**command, **pool_fields})
    app = studio_app(str(project), access, f"ilmek-studio-{port}", pool, endpoints)
    server = uvicorn.Server(uvicorn.Config(app, **server_settings()))
    thread = threading.Thread(target=server.run, args=([listener],))
    thread.start()
    try:
        until(lambda: server.started or not thread.is_alive(), "the server")
        yield Studio(port, access, pool, project, server)
    finally:
        server.should_exit = True
        thread.join(PATIENCE)
        listener.close()
    assert not thread.is_alive(), "the server does not end"
