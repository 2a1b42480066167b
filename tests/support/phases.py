"""Run targets of make side by side, and print how long each took: `tests/support/phases.py "lint layers" unit browser`.

A lane is one argument: its targets one after the other; the lanes run at once, so that no processor waits for the end
of a phase. Lines are shown as they come. After a target that fails all others still run; its last lines stand again at
the end, and the exit code is 1.
"""

import os
import resource
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass

WIDTH = 12
LAST_LINES = 12
"""Lines of a phase that failed, shown again before the table: a reader of the end of a log sees what failed."""


@dataclass(frozen=True)
class Phase:
    """A target that has ended: status, time by the clock [s], its last lines."""

    name: str
    status: int
    seconds: float
    last: tuple[str, ...] = ()


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
        last: deque[str] = deque(maxlen=LAST_LINES)
        with subprocess.Popen([*make, name], text=True, errors="replace", **options) as process:  # type: ignore[call-overload]
            for line in process.stdout:
                last.append(f"{name:{WIDTH}} | {line.rstrip()}")
                _show(last[-1])
        ended.append(Phase(name, process.returncode, time.monotonic() - begin, tuple(last)))


def table(phases: Sequence[Phase], seconds: float, processor: float) -> str:
    """The last lines of each phase that failed, a line for each phase, and one for all of them."""
    failures = [line for phase in phases if phase.status for line in phase.last]
    lines = [
        f"{phase.name:{WIDTH}} {phase.seconds:6.0f} s{'' if phase.status == 0 else '  FAILED'}" for phase in phases
    ]
    total = f"{'all':{WIDTH}} {seconds:6.0f} s; {processor:.0f} s of processor time on {os.cpu_count()} processors"
    return "\n".join((*failures, *lines, total))


def main() -> int:
    """Run the lanes of the command line."""
    begin = time.monotonic()
    lanes = [lane.split() for lane in sys.argv[1:]]
    phases = run(lanes)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    _show(table(phases, time.monotonic() - begin, used.ru_utime + used.ru_stime))
    return int(any(phase.status for phase in phases))


def _show(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
