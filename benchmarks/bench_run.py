"""A run: time of the controller a knot, a durable commit beside the disc's own sync, memory over simulated days."""

import os
import sys
import tempfile
import time
from collections.abc import Iterable
from pathlib import Path
from statistics import median

from ilmek.drivers.twin_port import TwinPort
from ilmek.io.journal_file import JournalFile, SystemFile
from ilmek.jobs.run.commands import lead_on
from ilmek.jobs.run.session import ControlSession
from ilmek.jobs.run.snapshots import SnapshotMaker
from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import ControlInput, ControlOutputs
from ilmek.loom.control.packml import PackState
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.model import plant_model
from ilmek.loom.twin.state import first_state
from ilmek.loom.twin.woven import Woven, woven_size

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from small_programme import small_programme  # type: ignore[import-not-found]

DAYS = 30
DAY = 86_400_000_000_000


class NoDisc:
    """A journal's store that keeps nothing."""

    def read(self) -> bytes:
        return b""

    def append(self, data: bytes) -> None:
        pass

    def sync(self) -> None:
        pass

    def truncate(self, size: int) -> None:
        pass


class Timed(Controller):
    """A controller that adds up the time of its reactions."""

    seconds = 0.0

    def react(self, inputs: Iterable[ControlInput]) -> ControlOutputs:
        begin = time.thread_time()
        found = super().react(inputs)
        Timed.seconds += time.thread_time() - begin
        return found


def twin_of(programme: LoomProgramme) -> TwinPort:
    woven = Woven(programme.setup, bytearray(woven_size(programme.setup)))
    woven.keep(first_state(plant_model(programme.setup)))
    return TwinPort(programme.setup, woven)


def begun(programme: LoomProgramme, store: NoDisc | JournalFile, group: int = 1) -> ControlSession:
    session = ControlSession(programme, twin_of(programme), store, group)
    while session.state is not PackState.EXECUTE:
        lead_on(session)
    return session


def controller_alone() -> None:
    programme = small_programme(40, 600, 4, 6, weft_rows=40)
    found = []
    for _ in range(3):
        session = begun(programme, NoDisc())
        session.controller.__class__ = Timed
        Timed.seconds, begin = 0.0, time.thread_time()
        while session.state is PackState.EXECUTE:
            session.receive(0.0)
        found.append((Timed.seconds / programme.setup.knots, (time.thread_time() - begin) / programme.setup.knots))
    controller, whole = (1e6 * min(one) for one in zip(*found, strict=True))
    print(f"controller without the disc  {controller:6.1f} us a knot (bound 30); with twin and loop {whole:.1f} us")


def durable_commit() -> None:
    programme = small_programme(6, 120, 2, 4, weft_rows=40)
    with tempfile.TemporaryDirectory(dir=".") as folder:
        plain, journal = Path(folder) / "plain", Path(folder) / "journal"
        handle = os.open(plain, os.O_RDWR | os.O_CREAT, 0o600)
        own: list[float] = []
        commits: list[float] = []
        with JournalFile(SystemFile(journal, create=True)) as store:
            session = begun(programme, store)
            size = 0
            while session.state is PackState.EXECUTE:
                begin = time.perf_counter()
                session.receive(0.0)
                commits.append(time.perf_counter() - begin)
                begin = time.perf_counter()  # side by side: the same bytes, appended and synced by the system alone
                size += os.pwrite(handle, bytes(32), size)
                os.fdatasync(handle)
                own.append(time.perf_counter() - begin)
        os.close(handle)
    ratio = median(commits) / median(own)
    print(f"durable knot {1e6 * median(commits):.0f} us, the disc's own append and sync {1e6 * median(own):.0f} us: "
          f"{ratio:.2f} times (bound 2)")  # fmt: skip


def memory_over_days() -> None:
    programme = small_programme(12_400, 68, 1, 4, weft_rows=40)
    with tempfile.TemporaryDirectory() as folder, JournalFile(SystemFile(Path(folder) / "j", create=True)) as store:
        session = begun(programme, store, 1000)
        maker, port = SnapshotMaker(programme), session.port
        sizes: list[int] = []
        begin, steps = time.perf_counter(), 0
        while session.state is PackState.EXECUTE and len(sizes) <= DAYS:
            session.receive(0.0)
            steps += 1
            if steps % 100 == 0:
                maker.make(session)
            if port.time >= (len(sizes) + 1) * DAY:  # type: ignore[attr-defined]
                sizes.append(resident())
        knots = session.status().knots
    first, last, took = sizes[1] / 1e6, sizes[-1] / 1e6, time.perf_counter() - begin
    print(f"{len(sizes)} simulated days, {knots:,} knots in {took:.0f} s: "
          f"memory {first:.1f} MB after two days, {last:.1f} MB at the end ({last - first:+.2f} MB)")  # fmt: skip


def resident() -> int:
    """Memory of this process [bytes]."""
    return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")


def run() -> None:
    controller_alone()
    durable_commit()
    memory_over_days()
