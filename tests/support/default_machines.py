"""Reports that many tests read, made once in a process: of the machines at their defaults, and of looms."""

import base64
import gzip
import json
import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache, lru_cache
from typing import Any

from ilmek.machines.automated_loom import MACHINE, LoomDesign
from ilmek.machines.catalogue import MACHINES
from ilmek.machines.hand_loom import MACHINE as HAND_LOOM
from ilmek.report import Report
from ilmek.viz.page import machine_page

SETTLED = {"knotting": "cams", "knot_cycle": "1.8s", "weft": "rapier"}
"""Settings of a loom for tests that are not of its choice: what is left open, heads and beat, takes a tenth of it."""

SETTLED_OPTIONS = tuple(word for one in SETTLED.items() for word in ("--loom", "=".join(one)))
"""The same for `ilmek weave`."""


@cache
def default_design(machine: str) -> Any:
    """The design of a machine."""
    return MACHINES[machine].designed(MACHINES[machine].params.read({}))


@cache
def default_report(machine: str) -> Report:
    """The report of a machine."""
    return MACHINES[machine].report(default_design(machine))


@lru_cache(maxsize=16)
def loom_report(loom: LoomDesign) -> Report:
    """The report of a loom without tables and figures, and without its parts in space."""
    return MACHINE.report(loom, illustrated=False, assembled=False)


@contextmanager
def out_of_space() -> Iterator[None]:
    """Looms whose parts are not compared in space, which takes most of the time of a design; nor for another beat."""
    whole = {(loom, name): getattr(loom, name) for loom in (MACHINE, HAND_LOOM) for name in ("assembly", "with_room")}
    for loom in (MACHINE, HAND_LOOM):
        object.__setattr__(loom, "assembly", None)
        object.__setattr__(loom, "with_room", lambda design, _: design)
    try:
        yield
    finally:
        for (loom, name), value in whole.items():
            object.__setattr__(loom, name, value)


@cache
def default_page(machine: str) -> tuple[str, tuple[str, ...]]:
    """The page of a machine, and what is left out of it."""
    left_out: list[str] = []
    return machine_page(default_report(machine), left_out), tuple(left_out)


def page_data(page: str) -> list[dict[str, Any]]:
    """The data of the figures that a page holds for the client, in their order."""
    held = re.findall(r'<script type="text/plain">(.*?)</script>', page, flags=re.DOTALL)
    return [json.loads(gzip.decompress(base64.b64decode(one))) for one in held]
