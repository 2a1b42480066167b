"""A whole automated loom beside its machines one by one: what joining them costs, and the second that is allowed."""

import time
from collections.abc import Callable

from ilmek.machines.automated_loom import MACHINE, AutomatedLoomParams, design
from ilmek.machines.automated_loom.parts import parts_of_loom

RUNS = 7
ALLOWED = 1.0


def seconds(work: Callable[[], object]) -> float:
    """The least time of the work, after it was done once."""
    work()
    taken = []
    for _ in range(RUNS):
        begun = time.perf_counter()
        work()
        taken.append(time.perf_counter() - begun)
    return min(taken)


def run() -> None:
    for beat in ("linkage", "comb"):
        params = AutomatedLoomParams(hammer=beat)
        loom = design(params)
        alone = {one.name: seconds(lambda one=one: one.component.design(one.design.params)) for one in loom.children}  # type: ignore[misc]
        for name, time_alone in alone.items():
            print(f"{name:14} {time_alone * 1e3:7.2f} ms")
        whole, parts = seconds(lambda params=params: design(params)), sum(alone.values())  # type: ignore[misc]
        listed = seconds(lambda loom=loom: parts_of_loom(loom))  # type: ignore[misc]
        reported = seconds(lambda loom=loom: MACHINE.report(loom))  # type: ignore[misc]
        print(
            f"loom, {beat}: design {whole * 1e3:.0f} ms = {whole / parts:.2f} of its machines' {parts * 1e3:.0f} ms, "
            f"{ALLOWED / whole:.0f} times within {ALLOWED:g} s; "
            f"parts list {listed * 1e3:.1f} ms; report {reported:.2f} s"
        )


if __name__ == "__main__":
    run()
