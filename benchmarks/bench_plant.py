"""The loom as a plant, from event to event: processor time of a knot. Limit: 15 microseconds.

Beside it, what a knot costs at least: an order and a report made, and a report chained into the digest.
"""

import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from ilmek.drivers.twin_port import TwinPort
from ilmek.io.recording_file import read_recording, recording_text
from ilmek.io.woven_file import open_woven
from ilmek.loom.control.ports import Done, Order, PortReport, Tie
from ilmek.loom.twin.comparison import compare
from ilmek.loom.twin.events import chained
from ilmek.loom.twin.model import NO_FAULTS, plant_model
from ilmek.loom.twin.recording import Recorder, replay

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from plant_driver import weave  # type: ignore[import-not-found]
from small_programme import small_programme  # type: ignore[import-not-found]

ROWS, COLUMNS, YARNS = 100, 450, 12


class TimedPort(TwinPort):
    """A port that adds up the processor time spent in it [s]."""

    spent = 0.0

    def send(self, orders: Sequence[Order]) -> None:
        begin = time.process_time()
        super().send(orders)
        self.spent += time.process_time() - begin

    def receive(self, timeout: float) -> tuple[PortReport, ...]:
        begin = time.process_time()
        found = super().receive(timeout)
        self.spent += time.process_time() - begin
        return found


def least(number: int = 100_000) -> float:
    """Time [s] of an order, a report and a digest: the parts that no plant can leave out."""
    digest, begin = bytes(32), time.process_time()
    for index in range(number):
        digest = chained(digest, Done(Tie(0, 0, index, index, 0), index))
    return (time.process_time() - begin) / number


def run() -> None:
    base = least()
    print(f"{ROWS * COLUMNS:,} knots a carpet, {YARNS} yarns, the carpet in a file; limit 15 us a knot")
    print(f"{'order, report and digest alone':44s}{1e6 * base:8.1f} us")
    with tempfile.TemporaryDirectory() as folder:
        for heads in (1, 5, 20):
            programme = small_programme(ROWS, COLUMNS, heads, YARNS, weft_rows=20)
            with open_woven(Path(folder) / f"woven{heads}", programme) as woven:
                port = TimedPort(programme.setup, woven)
                for _ in weave(port, programme):
                    pass
                assert compare(woven, programme).complete
            knot = port.spent / programme.setup.knots
            print(f"{f'a knot, {heads} heads':44s}{1e6 * knot:8.1f} us{knot / base:8.1f} times")
        programme = small_programme(ROWS, COLUMNS, 5, YARNS)
        path = Path(folder) / "run.txt"
        with open_woven(Path(folder) / "recorded", programme) as woven:
            recorder = Recorder(programme, NO_FAULTS, woven.restored(plant_model(programme.setup)))
            recorded = TwinPort(programme.setup, woven, record=recorder)
            for _ in weave(recorded, programme):
                pass
            path.write_text(recording_text(recorder.recording(recorded.state)))
        begin = time.process_time()
        recording = read_recording(path)
        read = time.process_time() - begin
        begin = time.process_time()
        for _ in replay(recording, programme):
            pass
        spent = time.process_time() - begin
        print(f"a recording of {path.stat().st_size:,} bytes: read in {read:.2f} s, replayed in {spent:.2f} s")
