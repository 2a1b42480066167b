"""The studio's server: requests pass to workers, works report by events, and nothing that a task does ends it."""

import json
import os
import socket
import threading
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from processes import PATIENCE, until
from studio_server import JSON, Studio, studio
from websockets.sync.client import ClientConnection


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    with studio(tmp_path_factory.mktemp("project"), grace=0.3, memory=2 * 2**30) as served:
        yield served


def event(socket: ClientConnection, kind: str, work: int | None = None) -> dict[str, Any]:
    """The next event of a kind."""
    while True:
        found: dict[str, Any] = json.loads(socket.recv(PATIENCE))
        if found["type"] == kind and work in (None, found.get("work")):
            return found


def test_an_answer_passes_with_its_times(server: Studio) -> None:
    answer = server.send("POST", "/api/echo", {"a": [1, "é"]})
    assert (answer.status, answer.json["a"]) == (200, [1, "é"])
    assert "task;dur=" in answer.headers["server-timing"]
    assert "total;dur=" in answer.headers["server-timing"]


def test_fields_of_the_path_and_the_query_are_fields_of_the_request(server: Studio) -> None:
    assert server.send("POST", "/api/echo/beat-up", {"a": 1, "name": "other"}).json["name"] == "beat-up"
    assert server.send("GET", "/api/sleep/0.01?text=warp&deaf=true").json["text"] == "warp"
    assert server.send("GET", "/api/sleep/long").status == 400


@pytest.mark.parametrize(
    ("language", "units"), [("tr", "mm, cm, dm, m, in ya da ft"), ("xx", "mm, cm, dm, m, in or ft")]
)
def test_a_refusal_is_in_the_language_of_the_page(server: Studio, language: str, units: str) -> None:
    answer = server.send("POST", "/api/refused", {}, {**server.cookie, "x-language": language})
    assert answer.json["error"]["allowed"] == units
    assert server.send("POST", "/api/refused", {}).json["error"]["allowed"] == "mm, cm, dm, m, in or ft"


def test_packed_arrays_are_aligned(server: Studio) -> None:
    body = server.send("POST", "/api/arrays", {}).body
    size = int.from_bytes(body[:4], "little")
    assert json.loads(body[4 : 4 + size]) == {"sizes": [3, 9]}
    assert (4 + size) % 8 == 0
    assert body[4 + size :] == b"abc" + bytes(5) + b"123456789" + bytes(7)


@pytest.mark.parametrize(
    ("path", "body", "status", "given"),
    [
        ("/api/refused", {}, 422, "crank 1 m"),
        ("/api/fault", {}, 500, "ZeroDivisionError"),
        ("/api/crash", {}, 507, "the worker ended"),
        ("/api/swallow", {}, 507, "memory"),
        ("/api/late", {"seconds": 5.0, "deaf": True}, 503, "longer than 0.3 s"),
        ("/api/sleep", {"seconds": "long"}, 400, "$.seconds"),
        ("/api/sleep", [], 400, "object"),
        ("/api/echo", b'{"a":' + b"[" * 100_000 + b"]" * 100_000 + b"}", 400, "nested too deeply"),
        ("/api/echo", b'{"a": "\xff"}', 400, "no JSON"),
        ("/api/echo", b'{"a": NaN}', 400, "no JSON"),
        ("/api/none", {}, 404, "not in the API"),
    ],
)
def test_an_error_states_what_was_given_and_the_next_request_is_answered(
    server: Studio, path: str, body: Any, status: int, given: str
) -> None:
    answer = server.send("POST", path, body, {**server.cookie, **JSON})
    assert (answer.status, given in answer.given) == (status, True)
    assert server.send("POST", "/api/echo", {}).status == 200


def test_what_a_library_prints_is_no_answer(server: Studio) -> None:
    assert server.send("POST", "/api/printing", {}).json == "kept apart"


def test_requests_of_one_affinity_go_to_the_worker_that_knows_them(server: Studio) -> None:
    first = server.send("POST", "/api/sleep", {}).json["pid"]
    for _ in range(3):
        with ThreadPoolExecutor(3) as many:  # others take its worker too
            list(many.map(lambda _: server.send("POST", "/api/echo", {}), range(6)))
        assert server.send("POST", "/api/sleep", {}).json["pid"] == first


def test_a_client_that_goes_cancels_its_request(server: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server.pool, "grace", PATIENCE)
    before = set(server.pool.processes())
    raw = socket.create_connection(("127.0.0.1", server.port))
    body = b'{"seconds": 30}'
    head = f"POST /api/sleep HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nCookie: {server.cookie['cookie']}\r\n"
    raw.sendall(f"{head}Content-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n".encode() + body)
    until(server.busy, "the request")
    raw.close()
    with ThreadPoolExecutor(3) as many:
        done = list(many.map(lambda _: server.send("POST", "/api/sleep", {"seconds": 0.1}).status, range(6)))
    assert done == [200] * 6
    assert before <= set(server.pool.processes())  # it ended by itself; no worker was ended for it


def test_twenty_clients_at_once_are_all_answered(server: Studio) -> None:
    def ask(number: int) -> list[int]:
        kinds = [("echo", {}), ("sleep", {"seconds": 0.005}), ("crash", {}) if number == 7 else ("echo", {})]
        return [server.send("POST", f"/api/{name}", body).status for name, body in kinds]

    with ThreadPoolExecutor(20) as many:
        statuses = list(many.map(ask, range(20)))
    assert statuses == [[200, 200, 507] if number == 7 else [200, 200, 200] for number in range(20)]


def test_a_work_reports_and_keeps_its_answer(server: Studio) -> None:
    with server.events() as socket:
        assert event(socket, "hello")["version"]
        started = server.send("POST", "/api/long", {"seconds": 0.2, "text": "warp"})
        number = started.json["work"]
        assert started.status == 202
        assert server.send("GET", f"/api/work/{number}").status == 202
        assert 0 <= event(socket, "step", number)["share"] <= 1
        assert event(socket, "news", number)["news"] == {"shown": "warp"}
        assert event(socket, "announced")["news"] == {"announced": "warp"}
        assert event(socket, "done", number)["time"] >= 0.2
    assert server.send("GET", f"/api/work/{number}").json["text"] == "warp"
    assert server.send("DELETE", f"/api/work/{number}").status == 204
    assert server.send("GET", f"/api/work/{number}").status == 404


def test_works_end_by_a_cancellation_or_a_crash(server: Studio) -> None:
    with server.events() as socket:
        number = server.send("POST", "/api/long", {"seconds": 30}).json["work"]
        event(socket, "step", number)
        assert server.send("DELETE", f"/api/work/{number}").status == 204
        event(socket, "cancelled", number)
        number = server.send("POST", "/api/long-crash", {}).json["work"]
        assert "ended" in event(socket, "failed", number)["error"]["given"]


def test_long_works_leave_a_worker_to_requests(server: Studio) -> None:
    numbers = [server.send("POST", "/api/long", {"seconds": 600}).json["work"] for _ in range(5)]
    assert server.send("POST", "/api/echo", {}).status == 200
    for number in numbers:
        assert server.send("GET", f"/api/work/{number}").status == 202  # it goes on, or waits
        assert server.send("DELETE", f"/api/work/{number}").status == 204


def test_a_work_reports_to_its_page_alone(server: Studio) -> None:
    with server.events(page="one") as one, server.events(page="two") as two:
        headers = {**server.cookie, "x-page": "one"}
        number = server.send("POST", "/api/long", {"text": "for one"}, headers).json["work"]
        assert event(one, "news", number)["news"] == {"shown": "for one"}
        event(one, "done", number)
        assert event(two, "announced")["news"] == {"announced": "for one"}
        (server.project / "carpet.toml").write_text("")
        assert event(two, "changed")["paths"] == ["carpet.toml"]


def test_a_deaf_request_is_ended_and_its_worker_replaced(server: Studio) -> None:
    until(lambda: not server.busy(), "the end of earlier works")  # else the work waits, and has no worker to be ended
    number = server.send("POST", "/api/long", {"seconds": 30, "deaf": True}).json["work"]
    until(server.busy, "the work")
    before = set(server.pool.processes())
    server.send("DELETE", f"/api/work/{number}")
    until(lambda: not before <= set(server.pool.processes()), "the end of its worker")
    assert server.send("POST", "/api/echo", {}).status == 200


def test_a_closed_server_leaves_no_process(tmp_path: Path) -> None:
    with studio(tmp_path) as served:
        threading.Thread(target=lambda: served.send("POST", "/api/late", {"seconds": 9, "deaf": True})).start()
        served.send("POST", "/api/echo", {})
        workers = served.pool.processes()
    assert workers
    for number in workers:
        with pytest.raises(ProcessLookupError):
            os.kill(number, 0)


def test_workers_that_cannot_start_are_reported(tmp_path: Path) -> None:
    with studio(tmp_path) as served:
        served.pool.command = ("/bin/false",)
        for number in (killed := served.pool.processes()):
            os.kill(number, 9)
        until(lambda: not set(killed) & set(served.pool.processes()), "the end of the workers")
        answer = served.send("POST", "/api/echo", {})
    assert (answer.status, "before they are ready" in answer.given) == (503, True)
