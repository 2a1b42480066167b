"""A whole automated loom beside its machines one by one: what joining them costs, and the times that are allowed."""

import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace

from ilmek.machines import BEATS
from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, design
from ilmek.machines.automated_loom.assembly import assembly
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.report import all_checks
from ilmek.part.drive_balance import drive_balance

RUNS, AFRESH_RUNS = 7, 5
"""Of the same work, and of fresh processes: the least counts, others on the computer lengthen processor time too."""
ALLOWED, CHOOSING = 0.1, 0.5
"""Of a design with everything given, and of the choice of all that is left open [s]."""

CHOICES: tuple[dict[str, str], ...] = ({}, {"aim": "price"}, {"aim": "time"}, {"width": "2.5m", "length": "3.5m"})

GIVEN = {"knotting": "cams", "knot_cycle": "1.4s", "weft": "rapier", "heads": "1"}

AFRESH = """
import sys, time
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.catalogue import MACHINES
params = AutomatedLoomParams.read(dict(one.split("=") for one in sys.argv[1:]))
modules = [MACHINES[name].design for name in MACHINES]
begun = time.process_time()
search = design(params).search
print(time.process_time() - begun, *((len(search.costs), len(search.offers)) if search else (1, 1)))
"""
"""A choice in a process that has loaded its modules and designed nothing."""

SPACE = 2.5
"""Of the comparison of all parts in space, in a fresh process for the first beat [s]."""


def seconds(work: Callable[[], object]) -> float:
    """The least time of the work, after it was done once."""
    work()
    taken = []
    for _ in range(RUNS):
        begun = time.perf_counter()
        work()
        taken.append(time.perf_counter() - begun)
    return min(taken)


def processor_seconds(work: Callable[[], object]) -> float:
    """Processor time of the work, done once."""
    begun = time.process_time()
    work()
    return time.process_time() - begun


def chosen_afresh(settings: dict[str, str]) -> tuple[float, ...]:
    """Processor time of a choice [s], looms that it designed, and those from which it chose."""
    words = [f"{name}={value}" for name, value in settings.items()]
    ended = subprocess.run([sys.executable, "-c", AFRESH, *words], capture_output=True, text=True, check=True)
    return tuple(map(float, ended.stdout.split()))


def run() -> None:
    for beat in BEATS:
        params = AutomatedLoomParams(beat=beat)
        loom = design(params)
        alone = {one.name: seconds(lambda one=one: one.component.design(one.design.params)) for one in loom.children}  # type: ignore[misc]
        for name, time_alone in alone.items():
            print(f"{name:18} {time_alone * 1e3:7.2f} ms")
        whole = min(chosen_afresh({"beat": beat, **GIVEN})[0] for _ in range(AFRESH_RUNS))
        parts = sum(alone.values())
        checked = seconds(lambda loom=loom: all_checks(replace(loom)))  # type: ignore[misc]
        reported = seconds(lambda loom=loom: MACHINE.report(replace(loom)))  # type: ignore[misc]
        spaced = processor_seconds(lambda loom=loom: assembly(replace(loom)))  # type: ignore[misc]
        free = processor_seconds(lambda loom=loom: drive_balance(loom_tree(loom)))  # type: ignore[misc]
        print(
            f"loom, {beat}: in space {spaced:.2f} s of processor time, {SPACE / spaced:.1f} times within {SPACE:g} s; "
            f"degrees of freedom {free * 1e3:.0f} ms"
        )
        print(
            f"loom, {beat}: design {whole * 1e3:.0f} ms = {whole / parts:.2f} of its machines' {parts * 1e3:.0f} ms, "
            f"{ALLOWED / whole:.1f} times within {ALLOWED:g} s; checks {checked:.2f} s, report {reported:.2f} s"
        )
    for settings in CHOICES:
        shown = " ".join(f"{name}={value}" for name, value in settings.items()) or "usual carpet"
        chosen, designed, looms = min(chosen_afresh(settings) for _ in range(AFRESH_RUNS))
        print(
            f"choice, {shown}: {chosen:.2f} s of processor time in a fresh process, {CHOOSING / chosen:.1f} times "
            f"within {CHOOSING:g} s; {designed:.0f} of {looms:.0f} looms designed"
        )


if __name__ == "__main__":
    run()
