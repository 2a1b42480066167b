"""Synthesis and cyclogram of the studio: a point or a motion dragged, each state answered; the search after it.

    python -m benchmarks studio_synthesis

Processor time of the engine's part is printed beside the round trip, which others on the computer lengthen.
"""

import copy
import tempfile
import time
import tomllib
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from benchmarks.bench_studio import Client, line, studio
from benchmarks.bench_studio_linkage import processor
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.cyclogram.tasks import CyclogramRequest, SolveRequest, solved, view
from ilmek.jobs.studio.synthesis.tasks import SynthesisRequest, candidates

TASKS = ("flat-d", "flap", "square")
"""Tasks of the example project: a path, a motion, a function."""

MOVES = 20
SHORT = 0.3
"""Promised processor time of a short search [s]."""

VIEW = 0.03
"""Promised processor time of a cyclogram that is dragged [s]."""


def moved(data: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The states of a drag: the first point goes up by 0.1 mm each; a function's end by a hundredth."""
    for number in range(MOVES):
        settings = dict(data["settings"])
        for name in ("points", "poses"):
            if name in settings:
                settings[name] = settings[name].replace("0mm,", f"{0.1 * number:g}mm,", 1)
        if "stop" in settings:
            settings["stop"] = str(1 + 0.01 * number)
        yield {**data, "settings": settings}


def shifted(data: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The states of a drag: the die of the press goes down half a degree later each."""
    for number in range(MOVES):
        state = copy.deepcopy(data)
        state["tracks"]["die"]["motions"]["down"] |= {
            "start": f"{160 + 0.5 * number}deg",
            "end": f"{205 + 0.5 * number}deg",
        }
        yield state


def round_trips(address: str, path: str, requests: Sequence[dict[str, Any]]) -> list[float]:
    """Time of each request from sending to its last byte [s], the first one left out: it starts a worker."""
    client, times = Client(address), []
    for request in requests:
        began = time.perf_counter()
        client.send("POST", path, request)
        times.append(time.perf_counter() - began)
    client.close()
    return times[1:]


def drag_points(address: str, name: str, data: dict[str, Any]) -> None:
    """Drag the first point of a task, then search it in full."""
    states = list(moved(data))
    trips = round_trips(address, "/api/synthesis/candidates", [{"data": one, "quick": True} for one in states])
    line(f"{name}: round trip of a short search", trips, 0.0)
    quick = [processor(partial(candidates, SynthesisRequest(one, quick=True), Context())) for one in states]
    line(f"{name}: processor time of a short search", quick[1:], SHORT if name != "square" else 0.0)
    full = processor(partial(candidates, SynthesisRequest(data), Context()))
    print(f"{name + ': processor time of the full search':44s} once   {1000 * full:8.1f} ms")


def run() -> None:
    """Drag three tasks and a cyclogram by the API; solve the cyclogram for both goals."""
    with tempfile.TemporaryDirectory() as folder, studio(Path(folder) / "project") as address:

        def example(path: str) -> dict[str, Any]:
            return tomllib.loads((Path(folder) / "project" / path).read_text(encoding="utf-8"))

        for name in TASKS:
            drag_points(address, name, example(f"synthesis/{name}.toml"))
        for name in ("press", "loom-row"):
            data = example(f"cyclograms/{name}.toml")
            states = list(shifted(data)) if name == "press" else [data] * MOVES
            trips = round_trips(address, "/api/cyclogram/view", [{"data": one} for one in states])
            line(f"{name}: round trip of a drag", trips, 0.0)
            engine = [processor(partial(view, CyclogramRequest(one), Context())) for one in states]
            line(f"{name}: processor time of a view", engine[1:], VIEW)
        press = example("cyclograms/press.toml")
        for goal in ("acceleration", "period"):
            once = processor(partial(solved, SolveRequest(press, goal), Context()))
            print(f"{f'press: processor time of least {goal}':44s} once   {1000 * once:8.1f} ms")
