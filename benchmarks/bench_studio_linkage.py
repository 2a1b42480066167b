"""The linkage editor: a joint dragged, each state answered at 360 positions; the share of the server.

    python -m benchmarks studio_linkage

Processor time of the engine's part is printed beside the round trip, which others on the computer lengthen.
"""

import cmath
import tempfile
import time
import tomllib
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import msgspec

from benchmarks.bench_studio import Client, line, studio
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.linkage.quality import quality
from ilmek.jobs.studio.linkage.tasks import DraggedJoint, MechanismRequest, mechanism

LINKAGES = (("four-bar", "B", 0.03), ("watt-six-bar", "B", 0.0), ("jansen-leg", "P", 0.0), ("class-three", "Q", 0.0))
"""File of the example project, the joint that is dragged, and the promised round trip [s]; 0: none is promised."""

MOVES = 200
SERVER = 0.01
"""The server's promised share of a four-bar [s]."""


def drag_of(data: dict[str, Any], joint: str) -> Callable[[int], dict[str, Any]]:
    """The request of each state of a drag: the joint moves on a circle of 3 mm."""
    answer = mechanism(MechanismRequest(data), Context())
    assert answer.motion is not None
    at = 40
    poses = {body: (one.x[at], one.y[at], one.angle[at]) for body, one in answer.motion.poses.items()}
    dragged = next(one for one in answer.joints if one.file_joint == joint)
    body = dragged.bodies[0]
    x, y, angle = poses.get(body, (0.0, 0.0, 0.0))
    local = next(one.points for one in answer.bodies if one.name == body)[dragged.name]
    assert x is not None and y is not None and angle is not None  # noqa: PT018
    start = complex(x, y) + complex(*local) * cmath.rect(1, angle)

    def request(number: int) -> dict[str, Any]:
        to = start + 0.003 * cmath.rect(1, 0.1 * number)
        return {"mechanism": data, "poses": poses, "steps": 360, "drag": {"joint": joint, "x": to.real, "y": to.imag}}

    return request


def processor(action: Callable[[], object]) -> float:
    """Processor time of an action [s]."""
    began = time.process_time()
    action()
    return time.process_time() - began


def round_trip(client: Client, request: dict[str, Any]) -> float:
    """Time of a request from sending to its last byte [s]."""
    began = time.perf_counter()
    client.send("POST", "/api/mechanism", request)
    return time.perf_counter() - began


def answered(request: MechanismRequest) -> bytes:
    """The JSON of an answer of the engine."""
    return msgspec.json.encode(mechanism(request, Context()))


def run() -> None:
    """Drag joints of four linkages by the API."""
    with tempfile.TemporaryDirectory() as folder, studio(Path(folder) / "project") as address:
        client = Client(address)
        for name, joint, limit in LINKAGES:
            data = tomllib.loads((Path(folder) / "project" / "linkages" / f"{name}.toml").read_text(encoding="utf-8"))
            request = drag_of(data, joint)
            typed = [msgspec.convert(request(number), MechanismRequest) for number in range(MOVES)]
            assert isinstance(typed[0].drag, DraggedJoint)
            client.send("POST", "/api/mechanism", request(0))
            line(f"{name}: round trip of a drag", [round_trip(client, request(n)) for n in range(MOVES)], limit)
            engine = [processor(partial(answered, one)) for one in typed]
            line(f"{name}: processor time of the engine", engine, SERVER if limit else 0.0)
            later = processor(partial(quality, MechanismRequest(data), Context()))
            print(f"{name + ': circuits, quality, checks at rest':44s} once   {1000 * later:8.1f} ms")
        client.close()
