"""The studio as its user sees it: a server on a copy of the example project, and Chromium driven by Playwright.

Everything that a page must not do is collected: errors on the console, errors of scripts, requests that leave the
machine, answers of the server that are faults.
"""

import re
import shutil
import signal
import tomllib
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Page, Playwright, Request, Response
from processes import ilmek, start, until

ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/\?token=[\w-]+")
VIEWS = ("carpet", "machine", "linkage", "synthesis", "cyclogram", "loom", "files")
FLAGS = (
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-gpu-rasterization",  # without a graphics card it takes seconds for a picture of many curves
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
PATIENCE = 180_000
"""Longest wait for something to appear [ms]: a loom that is designed beside four busy processes on two processors took
more than a minute.
"""

COUNT_REQUESTS = """
window.requestsUnderWay = 0;
const plainFetch = window.fetch;
window.fetch = async (...given) => {
  window.requestsUnderWay += 1;
  try {
    const answer = await plainFetch(...given);
    await answer.clone().arrayBuffer();
    return answer;
  } finally {
    window.requestsUnderWay -= 1;
  }
};
"""
AT_REST = """
async (patience) => {
  const end = performance.now() + patience;
  const found = (selector) => document.querySelector(selector) !== null;
  const isQuiet = () =>
    window.requestsUnderWay === 0 && found("main[data-ready='true']") && !found("main [role='progressbar']");
  await document.fonts.ready;
  for (let quiet = 0; quiet < 4; quiet = isQuiet() ? quiet + 1 : 0) {
    if (performance.now() > end) throw new Error("the page did not come to rest");
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done, 25)));
  }
}
"""


def browser_path() -> str | None:
    """The browser of the system, if any."""
    return next((path for path in map(shutil.which, BROWSERS) if path), None)


def launched(playwright: Playwright) -> Browser:
    """Chromium without a window."""
    return playwright.chromium.launch(executable_path=browser_path(), args=list(FLAGS), headless=True)


@dataclass
class Studio:
    """A running studio.

    project  its folder      address  with the token, as printed
    """

    project: Path
    port: int
    process: Any
    address: str
    _stack: ExitStack

    @property
    def base(self) -> str:
        """The address without the token."""
        return f"http://127.0.0.1:{self.port}/"

    def kill(self) -> None:
        """End the server as a power cut does."""
        self.process.kill()
        self._ended()

    def stop(self) -> None:
        """End the server as its user does, by Ctrl-C."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        self._ended()

    def _ended(self) -> None:
        self.process.wait(PATIENCE / 1000)
        self._stack.close()

    def restore(self, copy: Path) -> None:
        """Make the project what a copy of it is, without the history of its files; start the server where it ended."""
        own = self.project / ".studio"
        kept = {own, own / "secret", own / "served", own / ".gitignore"}
        for path in {*self.project.iterdir(), *own.iterdir()} - kept:
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        shutil.copytree(copy, self.project, dirs_exist_ok=True)
        if self.process.poll() is not None:
            self.restart()

    def restart(self) -> None:
        """Start the server again, on the same port."""
        self.process, self.address = _started(self.project, self.port, self._stack)


def _started(project: Path, port: int, stack: ExitStack) -> tuple[Any, str]:
    command = ilmek("studio", project, "--no-browser", "--port", port)
    process = stack.enter_context(start(command, stderr=None, changes={"PYTHONUNBUFFERED": "1"}))
    for line in process.stdout:
        if address := ADDRESS.search(line):
            return process, address.group()
    raise AssertionError(f"the studio ended with {process.wait()}")


@contextmanager
def studio(project: Path, port: int = 0) -> Iterator[Studio]:
    """A studio on a project, ended afterwards."""
    with ExitStack() as stack:
        process, address = _started(project, port, stack)
        running = Studio(project, int(urlsplit(address).port or 0), process, address, stack)
        yield running
        running.stop()


@dataclass
class Seen:
    """What a page did that it must not do."""

    faults: list[str] = field(default_factory=list)
    expected: tuple[str, ...] = ()
    """Texts of console errors that the test causes itself."""

    def watch(self, page: Page, base: str) -> None:
        """Collect the faults of a page."""
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.faults.append(f"error of a script: {error}"))
        page.on("request", lambda request: self._request(request, base))
        page.on("response", self._response)

    def _console(self, message: ConsoleMessage) -> None:
        if message.type == "error" and not any(text in message.text for text in self.expected):
            self.faults.append(f"console: {message.text}")

    def _request(self, request: Request, base: str) -> None:
        if not request.url.startswith((base, base.replace("http", "ws", 1), "data:", "blob:")):
            self.faults.append(f"request off the machine: {request.url}")

    def _response(self, response: Response) -> None:
        if response.status >= 500:
            self.faults.append(f"{response.status} for {response.url}")


def violations(page: Page, *rules: str) -> list[str]:
    """What axe-core finds on a page: its own rules and targets of 24 px, or some rules; with the elements concerned."""
    chosen = {"runOnly": list(rules)} if rules else {"rules": {"target-size": {"enabled": True}}}
    found = Axe().run(page, options={"resultTypes": ["violations"], **chosen}).response["violations"]
    return [f"{one['id']}: {[node['target'] for node in one['nodes']][:4]}" for one in found]


def open_view(page: Page, running: Studio, view: str) -> None:
    """Go to a view and wait until it has its first content."""
    if not page.url.startswith(running.base):
        page.goto(running.address)
    page.evaluate(f"location.hash = '#{view}'")
    name = view.partition("/")[0]
    page.wait_for_selector(f"main[data-view='{name}'][data-ready='true']", timeout=PATIENCE)


def settled(page: Page) -> None:
    """Wait until the page is at rest: its fonts loaded, no progress shown, no request under way."""
    page.evaluate(AT_REST, PATIENCE)


def context_of(
    browser: Browser, *, width: int = 1400, height: int = 900, dark: bool = False, touch: bool = False
) -> BrowserContext:
    """A fresh visitor with a window of a size [px]."""
    context = browser.new_context(
        viewport={"width": width, "height": height},
        color_scheme="dark" if dark else "light",
        reduced_motion="reduce",
        locale="en-GB",
        has_touch=touch,
    )
    context.set_default_timeout(PATIENCE)
    context.add_init_script(COUNT_REQUESTS)
    return context


def data_of(project: Path, path: str) -> dict[str, Any]:
    """The data of a file of the project."""
    return tomllib.loads((project / path).read_text(encoding="utf-8"))


def until_file(project: Path, path: str, words: str) -> None:
    """Wait until a file of the project has a text."""
    until(lambda: words in (project / path).read_text(encoding="utf-8"), f"{words} in {path}")


def until_data(project: Path, path: str, accepted: Callable[[dict[str, Any]], bool]) -> None:
    """Wait until the data of a file of the project are accepted."""
    until(lambda: accepted(data_of(project, path)), lambda: f"other data than {data_of(project, path)}")


def middle(page: Page, selector: str, number: int = 0) -> tuple[float, float]:
    """Middle of an element on the page [px]."""
    box = page.locator(selector).nth(number).bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
