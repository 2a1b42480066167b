"""Tasks of a studio that do nothing but behave well or badly, and a worker that has them.

python studio_tasks.py MEMORY       a worker whose tasks are those of this module
"""

import os
import sys
import time
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

from ilmek.errors import ParameterError
from ilmek.jobs.studio.answers import Binary, Context, packed
from ilmek.sentences import Sentence
from ilmek.web import worker
from ilmek.web.endpoints import Endpoint

LARGE = 12_000_000
"""Size of a large answer [bytes]."""

COMMAND = (sys.executable, __file__)


@dataclass(frozen=True, slots=True)
class SleepRequest:
    seconds: float = 0.0
    deaf: bool = False
    text: str = ""


@dataclass(frozen=True, slots=True)
class UploadedRequest:
    name: str
    content: bytes
    times: int = 1


def echo(request: dict[str, Any], context: Context) -> dict[str, Any]:
    return {**request, "pid": os.getpid()}


def sleep(request: SleepRequest, context: Context) -> dict[str, Any]:
    """Sleep; deaf: without a look whether it is cancelled."""
    end = time.monotonic() + request.seconds
    while (left := end - time.monotonic()) > 0:
        time.sleep(min(left, 0.01))
        if not request.deaf:
            context.progress(1 - left / max(request.seconds, 1e-9))
    context.show({"shown": request.text})
    context.announce({"announced": request.text})
    return {"pid": os.getpid(), "text": request.text}


def crash(request: SleepRequest, context: Context) -> None:
    os._exit(3)


def fault(request: SleepRequest, context: Context) -> None:
    raise ZeroDivisionError("a fault of the test")


def refused(request: SleepRequest, context: Context) -> None:
    raise ParameterError("crank 1 m", allowed=Sentence("size.units"), do="shorten it")


def swallow(request: SleepRequest, context: Context) -> int:
    """Take more memory than there is."""
    return len(bytearray(2**40))


def printing(request: SleepRequest, context: Context) -> str:
    sys.stdout.write("a library prints")
    sys.stdout.flush()
    return "kept apart"


def arrays(request: SleepRequest, context: Context) -> Binary:
    return packed({"sizes": [3, 9]}, b"abc", b"123456789")


def large(request: SleepRequest, context: Context) -> Binary:
    """More than the buffers of a connection hold."""
    return Binary("application/octet-stream", bytes(LARGE))


def uploaded(request: UploadedRequest, context: Context) -> dict[str, Any]:
    return {"name": request.name, "size": len(request.content), "times": request.times}


def task(name: str, method: str = "POST", **fields: Any) -> Endpoint:
    return Endpoint(method, f"/{name}", f"studio_tasks:{name.partition('/')[0]}", name, **fields)


ENDPOINTS = (
    *(task(name) for name in ("echo", "crash", "fault", "refused", "swallow", "printing", "arrays", "large")),
    task("sleep", affinity="sleep"),
    task("sleep/{seconds}", "GET"),
    Endpoint("POST", "/late", "studio_tasks:sleep", "ended after 0.3 s", limit=0.3),
    Endpoint("POST", "/long", "studio_tasks:sleep", "a work", work=True),
    Endpoint("POST", "/long-crash", "studio_tasks:crash", "a work that crashes", work=True),
    Endpoint("POST", "/echo/{name}", "studio_tasks:echo", "with a field in the path"),
    task("uploaded/{name}", upload=("image/png", "image/jpeg")),
)

if __name__ == "__main__":
    sys.modules["ilmek.jobs.studio_tasks"] = sys.modules["__main__"]
    sys.modules["ilmek.jobs.studio.warm_up"] = SimpleNamespace(preparations=tuple, preparations_for=tuple)  # type: ignore[assignment]
    worker.main()
