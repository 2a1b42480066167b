"""A headless Chromium driven by the DevTools protocol over a pipe: pages at any width, their console, pictures of them.

    with Browser() as browser:
        page = browser.open(Path("report.html"), width=390, height=800)
        page.evaluate("document.documentElement.scrollWidth")

Protocol: commands and events are JSON texts that end in a zero byte, on file descriptors 3 and 4 of the browser
[chromedevtools.github.io/devtools-protocol].
"""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any

NAMES = ("chromium", "chromium-browser", "google-chrome")
OPTIONS = [
    *("--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--disable-quic"),
    *("--disable-sync", "--disable-background-networking", "--disable-component-update", "--remote-debugging-pipe"),
]
PATIENCE = 60.0
"""Longest time of a command [s]."""


def installed() -> str | None:
    """The path of a browser; None without one."""
    return next(filter(None, map(shutil.which, NAMES)), None)


def processor_time(process: int) -> float:
    """Processor time of a process with all those that it started and that run [s]; Linux."""
    return sum(int(fields[11]) + int(fields[12]) for fields in _processes(process)) / os.sysconf("SC_CLK_TCK")


def _processes(process: int) -> list[list[str]]:
    """The fields of /proc/N/stat, from the state on, of a process and all those that it started."""
    fields = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            fields[int(stat.parent.name)] = stat.read_text().rpartition(")")[2].split()
    own, known = {process}, 0
    while len(own) > known:
        known = len(own)
        own |= {child for child, values in fields.items() if int(values[1]) in own}
    return [fields[one] for one in own if one in fields]


class Browser:
    """A running browser; the messages of all its consoles are in `errors`."""

    def __init__(self, *options: str) -> None:
        name = installed()
        assert name is not None, "no Chromium is installed"
        self.errors: list[str] = []
        self._loaded: set[str] = set()
        self._last, self._unread = 0, b""
        self._folder = tempfile.TemporaryDirectory()
        theirs_in, self._out = os.pipe()
        self._in, theirs_out = os.pipe()

        moved = f'exec "$0" "$@" 3<&{theirs_in} 4>&{theirs_out}'
        self._process = subprocess.Popen(
            ["bash", "-c", moved, name, *OPTIONS, *options, f"--user-data-dir={self._folder.name}", "about:blank"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            pass_fds=(theirs_in, theirs_out),
        )
        os.close(theirs_in)
        os.close(theirs_out)

    def __enter__(self) -> "Browser":
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.send("Browser.close")
        self._process.wait(PATIENCE)
        self._folder.cleanup()

    @property
    def processor_time(self) -> float:
        """Processor time of the browser with all its processes that run [s]; Linux."""
        return processor_time(self._process.pid)

    @property
    def memory(self) -> int:
        """Resident memory of the browser with all its processes that run [byte]; what they share counts in each."""
        return sum(int(fields[21]) for fields in _processes(self._process.pid)) * os.sysconf("SC_PAGE_SIZE")

    def open(self, path: Path, width: int, height: int, *, phone: bool = False) -> "Page":
        """A new page with a file in it, loaded."""
        target = self.send("Target.createTarget", {"url": "about:blank"})["targetId"]
        session = self.send("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]
        page = Page(self, target, session)
        for domain in ("Page", "Runtime", "Log"):
            page.send(f"{domain}.enable")
        screen = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": phone}
        page.send("Emulation.setDeviceMetricsOverride", screen)
        page.load(path)
        return page

    def send(self, method: str, params: Mapping[str, Any] | None = None, session: str = "") -> dict[str, Any]:
        """The result of a command."""
        self._last += 1
        message = {"id": self._last, "method": method, "params": dict(params or {})}
        os.write(self._out, json.dumps(message | ({"sessionId": session} if session else {})).encode() + b"\0")
        result: dict[str, Any] = self.until(lambda one: one.get("id") == self._last).get("result", {})
        return result

    def until(self, wanted: Any) -> dict[str, Any]:
        """The first message that is wanted; those before it are noted."""
        deadline = time.monotonic() + PATIENCE
        while True:
            while b"\0" not in self._unread:
                ready, _, _ = select.select([self._in], [], [], max(deadline - time.monotonic(), 0.0))
                assert ready, "the browser does not answer"
                self._unread += os.read(self._in, 1 << 20)
            text, _, self._unread = self._unread.partition(b"\0")
            message: dict[str, Any] = json.loads(text)
            self._note(message)
            if wanted(message):
                return message

    def _note(self, message: Mapping[str, Any]) -> None:
        method, params = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.errors.append(params["exceptionDetails"].get("exception", {}).get("description", "exception"))
        elif method == "Log.entryAdded" and params["entry"]["level"] in ("error", "warning"):
            self.errors.append(params["entry"]["text"])
        elif method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning", "assert"):
            self.errors.append(str([one.get("value") for one in params["args"]]))


class Page:
    """A page of the browser."""

    def __init__(self, browser: Browser, target: str, session: str) -> None:
        self._browser, self._target, self._session = browser, target, session

    def send(self, method: str, params: Mapping[str, Any] | None = None) -> dict[str, Any]:
        """The result of a command to this page."""
        return self._browser.send(method, params, self._session)

    def load(self, path: Path) -> None:
        """Load a file, again if it is the same."""
        self.visit(path.resolve().as_uri())

    def visit(self, address: str) -> None:
        """Load what is at an address."""
        self.send("Page.navigate", {"url": address})
        self._browser.until(
            lambda one: one.get("method") == "Page.loadEventFired" and one.get("sessionId") == self._session
        )

    def evaluate(self, script: str) -> Any:
        """The value of an expression of the page; of a promise, what it resolves to."""
        options = {"expression": script, "returnByValue": True, "awaitPromise": True}
        answer = self.send("Runtime.evaluate", options)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def press(self, key: str) -> None:
        """Press and release a key."""
        for kind in ("keyDown", "keyUp"):
            self.send("Input.dispatchKeyEvent", {"type": kind, "key": key, "code": key})

    def point(self, x: float, y: float) -> None:
        """Move the mouse to a position in the window [px]."""
        self.send("Input.dispatchMouseEvent", {"type": "mouseMoved", "x": x, "y": y})

    def picture(self, path: Path, top: float = 0.0, height: float = 1500.0) -> None:
        """Write a picture of a part of the page as PNG."""
        width = self.evaluate("innerWidth")
        clip = {"x": 0, "y": top, "width": width, "height": height, "scale": 1}
        shot = self.send("Page.captureScreenshot", {"clip": clip, "captureBeyondViewport": True})
        path.write_bytes(base64.b64decode(shot["data"]))

    def close(self) -> None:
        """Close the page."""
        self._browser.send("Target.closeTarget", {"targetId": self._target})
