"""Run targets of make side by side, and print how long each took: `tests/support/phases.py "lint layers" unit browser`.

A lane is one argument: its targets one after the other; the lanes run at once, so that no processor waits for the end
of a phase. Lines are shown as they come. A target that fails ends its lane; the others go on, and the exit code is 1.
"""

import os
import resource
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass

WIDTH = 12


@dataclass(frozen=True)
class Phase:
    """A target that has ended: status, time by the clock [s]."""

    name: str
    status: int
    seconds: float


def run(lanes: Sequence[Sequence[str]], make: Sequence[str] = ("make", "--no-print-directory")) -> list[Phase]:
    """All phases of all lanes, in the order in which they ended."""
    ended: list[Phase] = []
    threads = [threading.Thread(target=_run_lane, args=(lane, make, ended)) for lane in lanes]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return ended


def _run_lane(lane: Sequence[str], make: Sequence[str], ended: list[Phase]) -> None:
    for name in lane:
        begin = time.monotonic()
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "stdin": subprocess.DEVNULL}
        with subprocess.Popen([*make, name], text=True, errors="replace", **options) as process:  # type: ignore[call-overload]
            for line in process.stdout:
                _show(f"{name:{WIDTH}} | {line.rstrip()}")
        ended.append(Phase(name, process.returncode, time.monotonic() - begin))
        if process.returncode:
            return


def table(phases: Sequence[Phase], seconds: float, processor: float) -> str:
    """A line for each phase, and one for all of them."""
    lines = [
        f"{phase.name:{WIDTH}} {phase.seconds:6.0f} s{'' if phase.status == 0 else '  FAILED'}" for phase in phases
    ]
    total = f"{'all':{WIDTH}} {seconds:6.0f} s; {processor:.0f} s of processor time on {os.cpu_count()} processors"
    return "\n".join((*lines, total))


def main() -> int:
    """Run the lanes of the command line."""
    begin = time.monotonic()
    lanes = [lane.split() for lane in sys.argv[1:]]
    phases = run(lanes)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    _show(table(phases, time.monotonic() - begin, used.ru_utime + used.ru_stime))
    whole = len(phases) == sum(map(len, lanes))
    return int(not whole or any(phase.status for phase in phases))


def _show(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
