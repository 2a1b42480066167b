"""Serve the studio of a project until the process ends."""

import errno
import secrets
import socket
import threading
import webbrowser
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import uvicorn

from ilmek.errors import LoomError, ParameterError
from ilmek.io.secret_file import read_bounded, write_secret
from ilmek.jobs.studio.project.opening import served_alone
from ilmek.records import JsonObject
from ilmek.web.app import studio_app
from ilmek.web.connection import BoundedConnection
from ilmek.web.safety import Access

PORT = 8420
"""Port where none is given."""

TRIES = 50
"""Ports that are tried one after the other."""

MOST_CONNECTIONS = 300
"""Connections at a time; more are answered 503."""

SHORTEST_PASSWORD = 8
"""Fewest characters of a password."""

_BACKLOG = 256
_LOOPBACK = ("127.0.0.1", "localhost", "::1")
_EVERYWHERE = ("", "0.0.0.0", "::")


@dataclass(frozen=True, slots=True)
class StudioOrder:
    """What is served: folder of the project, where the server listens, and the password that it requires."""

    project: Path
    host: str = "127.0.0.1"
    port: int = PORT
    password: str = ""

    @property
    def local(self) -> bool:
        """Whether the server is seen from this computer alone."""
        return self.host in _LOOPBACK


def checked_order(order: StudioOrder) -> StudioOrder:
    """The order. Raises ParameterError for a host without a password, a port that does not exist."""
    if not 0 <= order.port <= 65535:
        raise ParameterError(f"port {order.port}", allowed="0 to 65535; 0: any that is free")
    if not order.local and len(order.password) < SHORTEST_PASSWORD:
        given = f"host {order.host} with {'a short' if order.password else 'no'} password"
        raise ParameterError(given, allowed=f"{SHORTEST_PASSWORD} characters or more", do="give --password-file FILE")
    return order


def bound_socket(host: str, port: int) -> socket.socket:
    """A socket that listens at a port, or at the next one that is free. Raises LoomError where there is none."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    for number in range(port, min(port + TRIES, 65536)) if port else (0,):
        listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)  # known to be TCP: no delay of answers
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((host, number))
            listener.listen(_BACKLOG)
        except OSError as error:
            listener.close()
            if error.errno == errno.EACCES:
                raise LoomError(f"port {number} is for the system alone", do="give --port 1024 or more") from None
            if error.errno != errno.EADDRINUSE:
                raise LoomError(
                    f"the studio cannot listen at {host} ({error.strerror})", do="give another --host"
                ) from None
        else:
            return listener
    raise LoomError(f"ports {port} to {port + TRIES - 1} are in use", do="give another --port")


def project_secret(project: Path) -> str:
    """The secret of a project; a new one where there is none. Raises LoomError, OutputError."""
    path = project / ".studio" / "secret"
    if not path.exists():
        write_secret(path, secrets.token_urlsafe(32).encode())
    return read_bounded(path, "secret").decode("ascii", "replace")


def access_to(order: StudioOrder, port: int, secret: str) -> Access:
    """Who may use a studio that listens at a port."""
    names = {*_LOOPBACK, order.host, socket.gethostname()} - {*_EVERYWHERE}
    hosts = {f"[{name}]:{port}" if ":" in name else f"{name.lower()}:{port}" for name in names}
    everywhere = 0 if order.local else port
    return Access(frozenset(hosts), secret, order.password, everywhere_port=everywhere)


def serve(order: StudioOrder, note: Callable[[str], None], show: Callable[[str], None], *, browser: bool) -> None:
    """Serve a project until the process ends.

    note  receives a line where the port is another, or the project is open elsewhere      show  receives the address
    browser  open the address in the user's browser
    """
    checked_order(order)
    secret = project_secret(order.project)
    listener = bound_socket(order.host, order.port)
    port = int(listener.getsockname()[1])
    if order.port and port != order.port:
        note(f"port {order.port} is in use; the studio takes {port}")
    access = access_to(order, port, secret)
    host = socket.gethostname() if order.host in _EVERYWHERE else f"[{order.host}]" if ":" in order.host else order.host
    address = f"http://{host}:{port}/"
    app = studio_app(str(order.project.resolve()), access, f"ilmek-studio-{port}")
    with served_alone(order.project) as alone:
        if not alone:
            note("the project is open in another studio too; each shows what the other saves")
        show(address if order.password else f"{address}?token={access.token}")
        if browser:
            opened = address if order.password else f"{address}?token={access.browser_token}"
            threading.Thread(target=webbrowser.open, args=(opened,), daemon=True).start()
        uvicorn.Server(uvicorn.Config(app, **server_settings())).run(sockets=[listener])


def server_settings() -> JsonObject:
    """How uvicorn serves the studio."""
    return {
        "loop": "asyncio",
        "http": BoundedConnection,
        "ws": "websockets-sansio",
        "ws_max_size": 65536,
        "ws_ping_interval": 20.0,
        "lifespan": "on",
        "log_config": None,
        "log_level": "error",
        "access_log": False,
        "server_header": False,
        "date_header": False,
        "limit_concurrency": MOST_CONNECTIONS,
        "timeout_keep_alive": 30,
        "timeout_graceful_shutdown": 2,
    }
