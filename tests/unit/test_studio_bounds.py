"""What a hostile or slow client can take of the studio: time, memory, connections, and no file but the project's."""

import asyncio
import json
import os
import socket
import struct
import zlib
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from processes import PATIENCE, until
from studio_server import JSON, UNPREPARED, Studio, studio
from studio_tasks import LARGE
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection

from ilmek.jobs.studio.project.opening import open_project
from ilmek.web import events
from ilmek.web.connection import BoundedConnection

OUTSIDE = (
    "../secret.toml",
    "linkages/../../secret.toml",
    "/etc/passwd",
    "link.toml",
    "folder/secret.toml",
    ".studio/secret",
    "a\0b.toml",
    "..\\secret.toml",
    "C:\\secret.toml",
    "//server/share.toml",
    "CON.toml",
    "nul",
    "carpet.toml:stream",
    "linkages/" + "x" * 5000 + ".toml",
    "a/" * 5000 + "b.toml",
    "%2e%2e/secret.toml",
    "",
)
"""Paths that are no file of the project."""

REQUESTS: tuple[tuple[str, dict[str, Any], str], ...] = (
    ("/project/undo", {"base": ""}, "path"),
    ("/project/redo", {"base": ""}, "path"),
    ("/project/new", {"text": "x = 1"}, "path"),
    ("/project/new", {"path": "machines/new.toml", "text": "a"}, "source"),
    ("/project/rename", {"path": "carpet.toml"}, "new"),
    ("/project/rename", {"new": "machines/new.toml"}, "path"),
    ("/project/delete", {"base": ""}, "path"),
    ("/project/pictures/delete", {"base": ""}, "path"),
    ("/project/products", {}, "path"),
    ("/project/out/delete", {}, "path"),
    ("/carpet/picture", {}, "picture"),
    ("/carpet/chart", {"recipe": {"picture": "pictures/medallion.png"}}, "path"),
    ("/loom/scene", {}, "file"),
    ("/loom/plate", {"plate": "a"}, "file"),
)
"""Requests of the API that name a file: path, other fields, the field of the name."""


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project beside a secret, with links to it."""
    base = tmp_path_factory.mktemp("bounds")
    folder = open_project(base / "project")
    (base / "secret.toml").write_text("secret = 1\n")
    (folder / "link.toml").symlink_to(base / "secret.toml")
    (folder / "folder").symlink_to(base)
    return folder


@pytest.fixture(scope="module")
def real(project: Path) -> Iterator[Studio]:
    with studio(project, size=2, real=True) as served:
        yield served


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    with studio(tmp_path_factory.mktemp("project"), size=2) as served:
        yield served


def files_of(folder: Path) -> dict[str, bytes]:
    """The files below a folder that are not the studio's own, with their content."""
    found = (path for path in sorted(folder.rglob("*")) if path.is_file() and ".studio" not in path.parts)
    return {str(path): path.read_bytes() for path in found}


@pytest.mark.parametrize(("path", "fields", "name"), REQUESTS, ids=[f"{path} {name}" for path, _, name in REQUESTS])
def test_no_request_leaves_the_project(
    real: Studio, project: Path, path: str, fields: dict[str, Any], name: str
) -> None:
    before = files_of(project.parent)
    for outside in OUTSIDE:
        if name == "source" and not outside:
            continue  # a file from no other
        answer = real.send("POST", f"/api{path}", {**fields, name: outside})
        assert (outside, answer.status) in ((outside, 422), (outside, 400)), answer.body
        assert b"secret =" not in answer.body
    assert files_of(project.parent) == before


def test_no_file_outside_is_read_or_saved(real: Studio, project: Path) -> None:
    before = files_of(project.parent)
    for outside in ("%2e%2e/secret.toml", "/etc/passwd", "link.toml", "folder/secret.toml", "..%5csecret.toml", "a%00"):
        for method, body in (("GET", None), ("PUT", {"base": "", "text": "x = 1"})):
            answer = real.send(method, f"/api/project/files/{outside}", body)
            assert (outside, answer.status) == (outside, 422)
    assert files_of(project.parent) == before


def test_a_recipe_reads_no_file_outside(real: Studio) -> None:
    sizes = {"size": "20x20cm", "quality": "25x25/dm"}
    for recipe in ({"picture": "../secret.toml"}, {"picture": "/etc/passwd"}, {"picture": "folder/secret.toml"}):
        answer = real.send("POST", "/api/carpet/chart", {"recipe": {**recipe, **sizes}})
        assert (answer.status, "outside" in answer.given) == (422, True)
    yarns = {"picture": "pictures/medallion.png", "yarns": "/etc/passwd", **sizes}
    assert "outside" in real.send("POST", "/api/carpet/chart", {"recipe": yarns}).given


def test_an_upload_is_what_its_content_is_and_lands_in_pictures(real: Studio, project: Path) -> None:
    kind = {**real.cookie, "content-type": "image/png"}
    before = files_of(project.parent)
    for content in (b"<html><script>", b"#!/bin/sh\n", b"\x7fELF", b"GIF", b""):
        assert real.send("POST", "/api/project/pictures?name=a.png", content, kind).status == 422
    assert files_of(project.parent) == before
    for name in ("../../x.png", "/etc/x.png", "..%5c..%5cx.png", ".studio%2fx.png", "x%00.png", "x.html", "-rf.png"):
        answer = real.send("POST", f"/api/project/pictures?name={name}", png(1, 1, b"\0\0"), kind)
        assert answer.json["path"].startswith("pictures/")
        assert answer.json["path"].endswith(".png")
    new = files_of(project.parent).keys() - before.keys()
    assert {Path(path).parent for path in new} == {project / "pictures"}


def png(width: int, height: int, rows: bytes) -> bytes:
    """A grey PNG of one byte a pixel."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def most_memory(process: int) -> int:
    """The most memory that a process has had [bytes]."""
    status = Path(f"/proc/{process}/status").read_text(encoding="ascii")
    return 1024 * int(status.partition("VmHWM:")[2].split()[0])


@pytest.mark.parametrize("side", [30_000, 100])
def test_a_decompression_bomb_takes_no_memory(real: Studio, side: int) -> None:
    """A picture of 900 million pixels by its head; one whose data unpack to more than its head states."""
    content = png(side, side, bytes(40_000_000))
    assert len(content) < 100_000
    kind = {**real.cookie, "content-type": "image/png"}
    name = real.send("POST", f"/api/project/pictures?name=bomb-{side}.png", content, kind).json["path"]
    answer = real.send("POST", "/api/carpet/picture", {"picture": name})
    assert answer.status == (422 if side == 30_000 else 200)
    assert max(map(most_memory, real.pool.processes())) < 800_000_000
    assert real.send("GET", "/api/machines").status == 200


@pytest.mark.parametrize(
    "path", ["/mechanism", "/cyclogram/view", "/commands", "/synthesis/candidates", "/machines/beat-up/design"]
)
def test_deeply_nested_data_are_refused(real: Studio, path: str) -> None:
    for depth in (500, 1_000_000):
        nested = b'{"a":' * depth + b"1" + b"}" * depth
        body = b'{"mechanism":%b,"cyclogram":%b,"settings":%b,"data":%b,"kind":"linkage"}' % ((nested,) * 4)
        answer = real.send("POST", f"/api{path}", body, {**real.cookie, **JSON})
        assert answer.status in (400, 422), answer.body


def until_closed(raw: socket.socket) -> bytes:
    """What comes until the server closes the connection."""
    raw.settimeout(PATIENCE)
    taken = b""
    try:
        while part := raw.recv(65536):
            taken += part
    except ConnectionError:
        pass
    return taken


@pytest.mark.parametrize("sent", ["", "GET / HT", "GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nX: "])
def test_a_head_that_does_not_arrive_is_not_awaited(server: Studio, monkeypatch: pytest.MonkeyPatch, sent: str) -> None:
    monkeypatch.setattr(BoundedConnection, "head_time", 0.2)
    with socket.create_connection(("127.0.0.1", server.port)) as raw:
        raw.sendall(sent.format(port=server.port).encode())
        until_closed(raw)


def drip(raw: socket.socket) -> None:
    """Send a space again and again."""
    until(lambda: raw.sendall(b" "), "the end of the connection")


@pytest.mark.parametrize("known", [True, False])
def test_a_body_that_comes_byte_by_byte_is_not_awaited(
    server: Studio, monkeypatch: pytest.MonkeyPatch, known: bool
) -> None:
    monkeypatch.setattr(BoundedConnection, "body_time", 0.3)
    head = f"POST /api/echo HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nContent-Length: 1000\r\n"
    head += f"Cookie: {server.cookie['cookie']}\r\n" if known else ""
    with socket.create_connection(("127.0.0.1", server.port)) as raw:
        raw.sendall(f"{head}Content-Type: application/json\r\n\r\n".encode())
        with pytest.raises(ConnectionError):
            drip(raw)
    assert server.send("POST", "/api/echo", {}).status == 200


def test_an_answer_that_is_not_taken_is_not_kept(server: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(BoundedConnection, "reading_time", 0.2)
    head = f"POST /api/large HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nCookie: {server.cookie['cookie']}\r\n"
    with socket.create_connection(("127.0.0.1", server.port)) as raw:
        raw.sendall(f"{head}Content-Type: application/json\r\nContent-Length: 2\r\n\r\n{{}}".encode())
        assert raw.recv(1) == b"H"
        until(lambda: not server.connections(), "the end of the connection")
        assert len(until_closed(raw)) < LARGE


def flood(page: ClientConnection, size: int) -> None:
    """Send messages of a size, 100 MB in all."""
    for _ in range(100_000_000 // size):
        page.send("x" * size)


@pytest.mark.parametrize("size", [1, 1000, 1_000_000])
def test_a_page_that_sends_is_disconnected(server: Studio, size: int) -> None:
    with server.events() as page:
        assert json.loads(page.recv(PATIENCE))["type"] == "hello"
        with pytest.raises(ConnectionClosed):
            flood(page, size)
    assert server.send("POST", "/api/echo", {}).status == 200


def test_pages_are_bounded(server: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(events, "MOST_PAGES", 2)
    with server.events() as one, server.events() as two:
        assert json.loads(one.recv(PATIENCE))["type"] == json.loads(two.recv(PATIENCE))["type"] == "hello"
        with pytest.raises(Exception, match="403"):
            server.events()


def test_a_page_that_reads_nothing_is_forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(events, "MOST_UNREAD", 3)
    hub = events.EventHub({}, lambda _: None)
    queue: asyncio.Queue[bytes | None] = asyncio.Queue()
    hub._pages[queue] = "one"
    for _ in range(10):
        hub.send({"type": "changed"})
    assert not hub.has("one")
    assert queue.qsize() == 4


def test_a_worker_that_is_killed_ends_its_request_alone(server: Studio) -> None:
    pid = server.send("POST", "/api/sleep", {}).json["pid"]
    with ThreadPoolExecutor(1) as one:
        going = one.submit(server.send, "POST", "/api/sleep", {"seconds": 20.0})
        until(lambda: pid in server.busy(), "the request")
        os.kill(pid, 9)
        answer = going.result()
    assert (answer.status, "ended while it answered" in answer.given) == (507, True)
    assert [server.send("POST", "/api/sleep", {}).status for _ in range(3)] == [200, 200, 200]


def test_where_nothing_can_be_written_an_error_says_what_to_do_and_all_stays(project: Path) -> None:
    """As on a full disc: the system refuses every byte that a worker writes to a file."""
    command = ("/bin/sh", "-c", 'ulimit -f 0; exec "$0" "$@"', *UNPREPARED)
    before = files_of(project)
    with studio(project, size=1, real=True, command=command) as served:
        base = served.send("GET", "/api/project/files/carpet.toml").json["digest"]
        for method, path, body in (
            ("PUT", "files/carpet.toml", {"base": base, "text": "size = '1x1m'"}),
            ("POST", "new", {"path": "machines/new.toml", "text": "machine = 'cam'"}),
            ("POST", "delete", {"path": "carpet.toml", "base": base}),
        ):
            answer = served.send(method, f"/api/project/{path}", body)
            assert (answer.status, "cannot be written" in answer.given) == (422, True), answer.body
            assert answer.json["error"]["do"]
    assert files_of(project) == before
