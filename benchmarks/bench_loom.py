"""A whole automated loom beside its machines one by one: what joining them costs, and the second that is allowed."""

import time
from collections.abc import Callable

from ilmek.machines import beat_up, hammer, shedding, warp_tension, weaver
from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.automated_loom.parts import parts_of_loom
from ilmek.machines.automated_loom.report import parts_of, report_with

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
    comb, linkage = (design(AutomatedLoomParams(hammer=way)) for way in ("comb", "linkage"))
    assert comb.hammer is not None and linkage.beat_up is not None  # noqa: PT018 - a benchmark, not a test
    beating, striking = comb.hammer.params, linkage.beat_up.params
    alone = {
        "weaver": seconds(lambda: weaver.design(linkage.weaver.params)),
        "shedding": seconds(lambda: shedding.design(linkage.shedding.params)),
        "warp-tension": seconds(lambda: warp_tension.design(linkage.warp_tension.params)),
        "beat-up": seconds(lambda: beat_up.design(striking)),
        "hammer": seconds(lambda: hammer.design(beating)),
    }
    for name, time_alone in alone.items():
        print(f"{name:14} {time_alone * 1e3:7.2f} ms")
    for way, loom in (("linkage", linkage), ("comb", comb)):
        whole = seconds(lambda way=way: design(AutomatedLoomParams(hammer=way)))  # type: ignore[misc]
        parts = sum(alone.values()) - alone["hammer" if way == "linkage" else "beat-up"]
        listed = seconds(lambda loom=loom: parts_of_loom(loom))  # type: ignore[misc]
        told = seconds(lambda loom=loom: report_with(loom, parts_of(loom)))  # type: ignore[misc]
        print(
            f"loom, {way}: design {whole * 1e3:.0f} ms = {whole / parts:.2f} of its machines' {parts * 1e3:.0f} ms, "
            f"{ALLOWED / whole:.0f} times within {ALLOWED:g} s; parts list {listed * 1e3:.1f} ms; report {told:.2f} s"
        )


if __name__ == "__main__":
    run()
