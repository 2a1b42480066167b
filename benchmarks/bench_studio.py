"""The studio: cold start to a page, round trips of requests, a drag of a four-bar, 20 clients at once.

The limits are those that are promised; a share of 95 % of the requests is within the time that is printed.
"""

import http.client
import json
import os
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.browser import Browser, installed

ROUNDS = 200
CLIENTS = 20
STARTS = 3
MACHINES = (("beat-up", "swing", 30, 0.1, 30), ("shedding", "dwell", 60, 0.1, 30))
"""Machine, the parameter that moves, its first value [deg], limit of a design [s], and how many designs."""

ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
"""As after an installation: compiled modules are kept."""


class Client:
    """Requests over one connection, with the token of the first address."""

    def __init__(self, address: str) -> None:
        found = re.fullmatch(r"http://([\d.]+):(\d+)/\?token=(\S+)", address)
        assert found is not None, address
        self._connection = http.client.HTTPConnection(found[1], int(found[2]), timeout=60)
        self._headers = {"authorization": f"Bearer {found[3]}", "content-type": "application/json"}

    def send(self, method: str, path: str, body: Any = None) -> bytes:
        """The body of a good answer."""
        content = None if body is None else json.dumps(body).encode()
        self._connection.request(method, path, content, self._headers)
        reply = self._connection.getresponse()
        answer = reply.read()
        assert reply.status == 200, (path, reply.status, answer[:300])
        return answer

    def close(self) -> None:
        """End the connection."""
        self._connection.close()


@contextmanager
def studio(project: Path) -> Iterator[str]:
    """The address of a studio in a process of its own."""
    command = [sys.executable, "-m", "ilmek", "studio", str(project), "--no-browser", "--port", "0"]
    process = subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        assert process.stdout is not None
        yield process.stdout.readline().strip()
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(10)


def line(name: str, times: list[float], limit: float = 0.0) -> None:
    """Print median and 95th percentile [s] in milliseconds."""
    times = sorted(times)
    most = times[min(len(times) - 1, int(0.95 * len(times)))]
    promised = f"   (limit {1000 * limit:g} ms)" if limit else ""
    print(f"{name:44s} median {1000 * statistics.median(times):8.1f} ms   95 % {1000 * most:8.1f} ms{promised}")


def timed(action: Callable[[], object]) -> float:
    """Duration of an action [s]."""
    began = time.perf_counter()
    action()
    return time.perf_counter() - began


def cold_start(folder: Path) -> None:
    """From the command to the address, the page's first bytes, the first answer of a worker, and the usable page."""
    addresses, pages, answers = [], [], []
    for number in range(STARTS):
        began = time.perf_counter()
        with studio(folder / str(number)) as address, closing(Client(address)) as client:
            addresses.append(time.perf_counter() - began)
            client.send("GET", "/")
            pages.append(time.perf_counter() - began)
            client.send("GET", "/api/project")
            answers.append(time.perf_counter() - began)
    line("cold start: address", addresses)
    line("cold start: page served", pages, 1.5)
    line("cold start: files of the project", answers)
    if installed() is not None:
        line("cold start: usable page in Chromium", [usable(folder / "browser") for _ in range(STARTS)], 2.5)


def usable(project: Path) -> float:
    """Time from the command until the first view shows its carpet in a browser that is open already [s]."""
    with Browser() as browser:
        page = browser.open(Path(__file__).with_name("browser.py"), 1400, 900)
        began = time.perf_counter()
        with studio(project) as address:
            page.visit(address)
            page.evaluate(
                "new Promise(done => { const look = () => document.querySelector('main[data-ready=true]')"
                " ? done() : setTimeout(look, 10); look(); })"
            )
            return time.perf_counter() - began


def requests(client: Client, project: Path) -> None:
    """Round trips of single requests, one after the other."""
    client.send("GET", "/api/machines")
    line("list of machines", [timed(lambda: client.send("GET", "/api/machines")) for _ in range(ROUNDS)])
    path = next(
        iter(sorted((project / "linkages").glob("*four*.toml")) or sorted((project / "linkages").glob("*.toml")))
    )
    mechanism = tomllib.loads(path.read_text(encoding="utf-8"))

    def drag() -> None:
        client.send("POST", "/api/mechanism", {"mechanism": mechanism, "steps": 360})

    drag()
    line(f"{path.stem}: motion at 360 positions", [timed(drag) for _ in range(ROUNDS)], 0.03)
    for machine, setting, value, limit, rounds in MACHINES:
        form = f"/api/machines/{machine}/view"
        bodies = [{"settings": {setting: f"{value + 0.01 * number}deg"}} for number in range(rounds + 1)]
        client.send("POST", form, bodies.pop())
        line(f"{machine}: design", [timed(partial(client.send, "POST", form, body)) for body in bodies], limit)


def many(address: str) -> None:
    """Clients at once: each sends requests one after the other; none may fail."""

    def one(_: int) -> list[float]:
        with closing(Client(address)) as client:
            return [timed(lambda: client.send("GET", "/api/machines")) for _ in range(10)]

    with ThreadPoolExecutor(CLIENTS) as pool:
        times = [took for took_by_one in pool.map(one, range(CLIENTS)) for took in took_by_one]
    line(f"{CLIENTS} clients at once, {len(times)} requests, none failed", times)


def run() -> None:
    """Print the times."""
    with tempfile.TemporaryDirectory() as folder:
        ENVIRONMENT["PYTHONPYCACHEPREFIX"] = str(Path(folder) / "compiled")
        project = Path(folder) / "project"
        with studio(project) as address, closing(Client(address)) as client:
            client.send("GET", "/api/project")
        cold_start(Path(folder))
        with studio(project) as address:
            with closing(Client(address)) as client:
                requests(client, project)
            many(address)
