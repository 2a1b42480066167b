"""Who may use the studio: each refusal over a real connection."""

import asyncio
import contextlib
import errno
import http.client
import json
import os
import socket
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace

import pytest
from processes import PATIENCE, until
from studio_server import Studio, studio
from websockets.exceptions import InvalidStatus

from ilmek.errors import LoomError, ParameterError
from ilmek.web import login
from ilmek.web.safety import LONGEST_BODY, Access
from ilmek.web.serve import StudioOrder, access_to, bound_socket, checked_order, project_secret
from ilmek.web.static_files import within

PNG = {"content-type": "image/png"}


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    with studio(tmp_path_factory.mktemp("project")) as served:
        yield served


@pytest.fixture(scope="module")
def guarded(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    with studio(tmp_path_factory.mktemp("guarded"), password="right horse", size=1) as served:
        yield served


def test_the_token_is_exchanged_for_a_cookie(server: Studio) -> None:
    answer = server.send("GET", f"/?token={server.access.token}", headers={})
    assert (answer.status, answer.headers["location"]) == (303, "/")
    cookie = answer.headers["set-cookie"]
    assert cookie.startswith(server.cookie["cookie"])
    assert "HttpOnly" in cookie
    assert "SameSite=strict" in cookie
    assert server.access.token not in cookie
    assert (
        server.send("GET", f"/?token={server.access.token}").headers["location"] == "/"
    )  # known: it leaves the address


@pytest.mark.parametrize(
    "path", ["/", "/?token=wrong", "/api", "/api/openapi.json", "/files/carpet.toml", "/assets/a.js"]
)
def test_nothing_is_shown_without_token_or_cookie(server: Studio, path: str) -> None:
    for headers in ({}, {"cookie": f"ilmek-studio-{server.port}=wrong"}, {"authorization": "Bearer wrong"}):
        assert server.send("GET", path, headers=headers).status == 401
    assert server.send("POST", "/api/echo", {}, {}).status == 401


def test_the_token_of_the_browser_opens_once(server: Studio) -> None:
    for status in (303, 401):
        assert server.send("GET", f"/?token={server.access.browser_token}", headers={}).status == status
    bearer = {"authorization": f"Bearer {server.access.browser_token}"}
    assert server.send("GET", "/api", headers=bearer).status == 401


def test_a_program_may_send_the_token_as_bearer(server: Studio) -> None:
    headers = {"authorization": f"Bearer {server.access.token}"}
    assert server.send("POST", "/api/echo", {}, headers).status == 200


def test_other_cookies_of_the_host_may_have_any_form(server: Studio) -> None:
    headers = {"cookie": f'a="{{}}; b; =c; {server.cookie["cookie"]}; d=é'.encode().decode("latin-1")}
    assert server.send("POST", "/api/echo", {}, headers).status == 200


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:{port}", "127.0.0.1", "localhost:1", "192.168.1.5:{port}", ""]
)
def test_another_host_name_is_refused(server: Studio, host: str) -> None:
    headers = {**server.cookie, "host": host.format(port=server.port)}
    assert server.send("GET", "/api", headers=headers).status in (400, 421)


@pytest.mark.parametrize("host", ["localhost:{port}", "LOCALHOST:{port}", "127.0.0.1:{port}", "[::1]:{port}"])
def test_the_names_of_this_computer_are_allowed(server: Studio, host: str) -> None:
    assert server.send("GET", "/api", headers={**server.cookie, "host": host.format(port=server.port)}).status == 200


@pytest.mark.parametrize(
    "headers",
    [
        {"origin": "https://evil.example"},
        {"origin": "null"},
        {"origin": "http://127.0.0.1:1"},
        {"sec-fetch-site": "cross-site"},
        {"sec-fetch-site": "same-site"},
        {"referer": "https://evil.example/", "sec-fetch-site": "cross-site", "sec-fetch-mode": "navigate"},
    ],
)
def test_requests_of_other_sites_are_refused_also_websockets(server: Studio, headers: dict[str, str]) -> None:
    assert server.send("POST", "/api/echo", {}, {**server.cookie, **headers}).status == 403
    with pytest.raises(InvalidStatus, match="403"):
        server.events({**server.cookie, **headers})


def test_a_websocket_needs_the_cookie_too(server: Studio) -> None:
    with pytest.raises(InvalidStatus, match="403"):
        server.events({})
    with server.events({**server.cookie, "origin": f"http://127.0.0.1:{server.port}"}) as events:
        assert json.loads(events.recv(PATIENCE))["type"] == "hello"


def test_a_form_of_another_site_is_no_json(server: Studio) -> None:
    for kind in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data"):
        assert server.send("POST", "/api/echo", b"{}", {**server.cookie, "content-type": kind}).status == 415


@pytest.mark.parametrize("path", ["/", "/api", "/login", "/none", "/api/none"])
def test_every_answer_has_the_headers_of_safety(server: Studio, path: str) -> None:
    for sent in (server.cookie, {}):
        headers = server.send("GET", path, headers=sent).headers
        policy = headers["content-security-policy"]
        assert "unsafe" not in policy
        assert "default-src 'self'" in policy
        assert "frame-ancestors 'none'" in policy
        assert (headers["x-content-type-options"], headers["referrer-policy"]) == ("nosniff", "no-referrer")
        assert "server" not in headers


def test_an_upload_is_taken_by_type(server: Studio) -> None:
    answer = server.send("POST", "/api/uploaded/warp?times=2", b"\x89PNG", {**server.cookie, **PNG})
    assert answer.json == {"name": "warp", "size": 4, "times": 2}
    answer = server.send("POST", "/api/uploaded/warp", b"<html>", {**server.cookie, "content-type": "text/html"})
    assert (answer.status, answer.json["error"]["allowed"]) == (415, "image/png or image/jpeg")


@pytest.mark.parametrize("length", [str(LONGEST_BODY + 1), "9" * 5000, "-1", "1e3"])
def test_a_body_that_states_to_be_long_is_refused_before_it_is_read(server: Studio, length: str) -> None:
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=PATIENCE)
    connection.putrequest("POST", "/api/uploaded/warp")
    for name, value in {**server.cookie, **PNG, "content-length": length}.items():
        connection.putheader(name, value)
    connection.endheaders()
    with connection.getresponse() as reply:
        assert reply.status in (400, 413)
    connection.close()


def test_a_body_that_grows_is_refused_while_it_streams(server: Studio) -> None:
    head = f"POST /api/uploaded/warp HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nCookie: {server.cookie['cookie']}\r\n"
    chunk = b"400000\r\n" + bytes(0x400000) + b"\r\n"
    sent = 0
    with (
        socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE) as raw,
        contextlib.suppress(ConnectionError),
    ):
        raw.sendall(f"{head}Content-Type: image/png\r\nTransfer-Encoding: chunked\r\n\r\n".encode())
        while sent < 3 * LONGEST_BODY:
            sent += 0x400000  # counted before: the reset may come while this chunk is on its way
            raw.sendall(chunk)
    assert LONGEST_BODY <= sent < 3 * LONGEST_BODY
    assert server.send("POST", "/api/echo", {}).status == 200


def test_files_of_the_project_are_strangers_in_a_sandbox(server: Studio) -> None:
    (server.project / "out").mkdir()
    (server.project / "out" / "page.html").write_text("<script>1</script>")
    answer = server.send("GET", "/files/out/page.html")
    assert (answer.status, answer.body) == (200, b"<script>1</script>")
    assert answer.headers["content-security-policy"].startswith("sandbox allow-scripts; default-src 'none'")
    assert "allow-same-origin" not in answer.headers["content-security-policy"]
    saved = server.send("GET", "/files/out/page.html?download=1").headers["content-disposition"]
    assert saved == "attachment; filename*=utf-8''page.html"


def test_no_path_leaves_the_project(server: Studio, tmp_path: Path) -> None:
    (tmp_path / "secret.txt").write_text("secret")
    (server.project / ".studio").mkdir(exist_ok=True)
    (server.project / ".studio" / "secret").write_text("secret")
    (server.project / "link.txt").symlink_to(tmp_path / "secret.txt")
    (server.project / "folder").symlink_to(tmp_path)
    (server.project / "loop").symlink_to(server.project / "loop")
    os.mkfifo(server.project / "pipe")
    outside = str(tmp_path / "secret.txt")
    tries = ["../secret.txt", "..%2fsecret.txt", "%2e%2e/secret.txt", "..%5csecret.txt", outside, f"/{outside}"]
    tries += [
        "link.txt",
        "folder/secret.txt",
        "loop",
        "pipe",
        ".studio/secret",
        "out/../.studio/secret",
        "a%00b",
        "",
        "out",
    ]
    for path in tries:
        answer = server.send("GET", f"/files/{path}")
        assert (path, answer.status, b"secret" in answer.body) == (path, 404, False)
        assert b"secret" not in server.send("GET", f"/{path}").body


def test_a_path_within_a_folder(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "b.txt").write_text("")
    assert within(tmp_path, "a/b.txt") == tmp_path / "a" / "b.txt"
    assert within(tmp_path / "none", "b.txt") is None
    assert within(tmp_path, "a/" + "x" * 5000) is None


def test_a_password_is_required_and_no_token_replaces_it(guarded: Studio) -> None:
    assert guarded.send("GET", f"/?token={guarded.access.token}", headers={}).headers["location"] == "/login"
    assert guarded.send("GET", "/api", headers={"authorization": f"Bearer {guarded.access.token}"}).status == 401
    page = guarded.send("GET", "/login", headers={})
    assert (page.status, b"script" in page.body, b"style" in page.body) == (200, False, False)
    assert (
        guarded.send("POST", "/login", b"password=right+horse", {})
        .headers["set-cookie"]
        .startswith(guarded.cookie["cookie"])
    )
    assert guarded.send("POST", "/login", b"password=right%20horse%0A", {}).status == 303  # from a file
    assert guarded.send("GET", "/api").status == 200
    assert guarded.send("POST", "/login", b"x" * 5000, {}).status == 413


def test_wrong_passwords_are_slowed(guarded: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    delays: list[float] = []

    async def pause(seconds: float) -> None:
        delays.append(seconds)

    monkeypatch.setattr(login, "pause", pause)
    assert guarded.send("POST", "/login", b"password=right+horse", {}).status == 303
    for body in (b"password=wrong", b"\xff\xfe", *6 * [b"password=wrong"]):
        assert guarded.send("POST", "/login", body, {}).status == 403
    assert delays == [0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 16.0, 16.0]


def test_beyond_the_loopback_a_password_is_required() -> None:
    for host in ("0.0.0.0", "::", "192.168.1.5", "loom.example"):
        with pytest.raises(ParameterError, match="no password"):
            checked_order(StudioOrder(Path(), host))
        with pytest.raises(ParameterError, match="short password"):
            checked_order(StudioOrder(Path(), host, password="short"))
    assert checked_order(StudioOrder(Path(), "0.0.0.0", password="right horse"))
    with pytest.raises(ParameterError, match="port 70000"):
        checked_order(StudioOrder(Path(), port=70000))


def test_everywhere_a_number_address_is_known_and_a_name_is_not() -> None:
    access = access_to(StudioOrder(Path(), "0.0.0.0", password="right horse"), 8420, "secret")
    assert access.knows_host("192.168.1.5:8420")
    assert access.knows_host("[fe80::1]:8420")
    assert access.knows_host(f"{socket.gethostname().lower()}:8420")
    for host in ("evil.example:8420", "192.168.1.5:80", "192.168.1.5", ""):
        assert not access.knows_host(host)


def test_the_cookie_depends_on_secret_and_password() -> None:
    cookies = {Access(frozenset(), secret, password).cookie for secret in "ab" for password in ("", "x", "y")}
    assert len(cookies) == 6


def test_the_secret_is_kept_for_its_owner_alone(tmp_path: Path) -> None:
    secret = project_secret(tmp_path)
    assert project_secret(tmp_path) == secret
    assert (tmp_path / ".studio" / "secret").stat().st_mode & 0o777 == 0o600
    (tmp_path / ".studio" / "secret").chmod(0o644)
    with pytest.raises(LoomError, match="others can read"):
        project_secret(tmp_path)


def test_a_port_of_the_system_is_not_called_in_use(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(socket, "socket", lambda *_: SimpleNamespace(bind=refuse, close=tuple, setsockopt=refuse_not))
    with pytest.raises(LoomError, match="port 80 is for the system alone; give --port 1024 or more"):
        bound_socket("127.0.0.1", 80)


def refuse_not(*_: object) -> None:
    """Take any option."""


def test_the_server_listens_at_the_loopback_alone(server: Studio) -> None:
    assert StudioOrder(Path()).host == "127.0.0.1"
    others = {"127.0.0.2", *socket.gethostbyname_ex(socket.gethostname())[2]} - {"127.0.0.1"}
    for other in others:
        with pytest.raises(OSError, match="refused|timed out"):
            socket.create_connection((other, server.port), timeout=2)


def test_many_passwords_at_a_time_are_refused(guarded: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    passed = threading.Event()

    async def pause(_: float) -> None:
        while not passed.is_set():
            await asyncio.sleep(0.001)

    monkeypatch.setattr(login, "pause", pause)
    with ThreadPoolExecutor(20) as many:
        guesses = [many.submit(guarded.send, "POST", "/login", b"password=wrong", {}) for _ in range(20)]
        until(lambda: sum(guess.done() for guess in guesses) == 20 - login.MOST_WAITING, "the refusal of the others")
        refused = [guess.result().status for guess in guesses if guess.done()]
        passed.set()
    assert set(refused) == {429}
    assert [guess.result().status for guess in guesses].count(403) == login.MOST_WAITING
    assert guarded.send("GET", "/api").status == 200  # those who are in stay in


def test_a_port_in_use_is_followed_by_the_next() -> None:
    with bound_socket("127.0.0.1", 0) as first:
        port = int(first.getsockname()[1])
        with bound_socket("127.0.0.1", port) as second:
            assert port < int(second.getsockname()[1]) <= port + 50
    with pytest.raises(LoomError, match="cannot listen at 203.0.113.7"):
        bound_socket("203.0.113.7", 0)
