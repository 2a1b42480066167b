"""A slider of the studio's form that moves: what one change of a machine costs, from the request to its JSON.

Each parameter with a number is moved by three small steps; the first step of a parameter does not count where a worker
keeps what did not change. View: verdict, checks and results. Figures: the machine in motion and two curves. Required: a
change of beat-up, cams, tufting and knotting machines within 100 ms, of the loom within 300 ms. The time of the
processor is stated beside the time on the clock: other work on the computer lengthens the latter alone.
"""

import gc
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import msgspec
import numpy as np

from ilmek.errors import IlmekError
from ilmek.jobs.studio.answers import Context
from ilmek.jobs.studio.machine.figures import FiguresRequest, figures
from ilmek.jobs.studio.machine.tasks import DesignRequest, MachineName, form
from ilmek.jobs.studio.machine.view import view
from ilmek.params import Setting

MACHINES = (
    "beat-up",
    "cam",
    "shedding",
    "weft",
    "hammer",
    "tension-compensator",
    "warp-tension",
    "tufting",
    "weaver",
    "knotting-four-bar",
    "knotting-dyad",
    "automated-loom",
)
STEPS = (1.002, 1.004, 1.006)
HERE = Context()


@dataclass(frozen=True)
class Taken:
    """Times of one change [s]: of the processor and on the clock, of the view and of the figures."""

    parameter: str
    view: tuple[float, float]
    figures: tuple[float, float]


def run() -> None:
    print(
        f"{'machine':22}{'view: median':>14}{'95 %':>8}{'worst':>8}{'on the clock 95 %':>19}{'figures 95 %':>14}   [ms]"
    )
    for name in MACHINES:
        taken = changes(name)
        seen = np.array([one.view[0] for one in taken]) * 1e3
        clock = np.array([one.view[1] for one in taken]) * 1e3
        drawn = np.array([one.figures[0] for one in taken]) * 1e3
        slowest = max(taken, key=lambda one: one.view[0]).parameter
        print(
            f"{name:22}{np.median(seen):14.0f}{np.percentile(seen, 95):8.0f}{seen.max():8.0f}"
            f"{np.percentile(clock, 95):19.0f}{np.percentile(drawn, 95):14.0f}   slowest: {slowest}"
        )


def changes(name: str) -> list[Taken]:
    """The changes of every parameter that has a number and can be moved."""
    begin = view(DesignRequest(name), HERE)
    gc.collect()
    gc.freeze()  # as a worker does that has prepared itself
    known = figures(FiguresRequest(name, names=()), HERE).known
    moving = [one.name for one in known if one.kind == "animation"][:1]
    chosen = (*moving, *[one.name for one in known if one.kind == "plot"][:2])
    found: list[Taken] = []
    for one in form(MachineName(name), HERE).fields:
        value = begin.parameters[one.name].value
        if one.machine or one.kind != "quantity" or isinstance(value, bool | str) or not value:
            continue
        for step in STEPS:
            settings: dict[str, Setting] = {one.name: value * step}
            try:
                seen = timed(partial(view, DesignRequest(name, settings), HERE))
                drawn = timed(partial(figures, FiguresRequest(name, settings, names=chosen), HERE))
            except IlmekError:
                break
            if step != STEPS[0]:
                found.append(Taken(one.name, seen, drawn))
    return found


def timed(work: Callable[[], object]) -> tuple[float, float]:
    """Time of the processor and on the clock [s] for an answer and its JSON."""
    processor, clock = time.process_time(), time.perf_counter()
    msgspec.json.encode(work())
    return time.process_time() - processor, time.perf_counter() - clock
