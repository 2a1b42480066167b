"""A carpet woven through power cuts, in one process, on a disc that loses writes."""

import random
from dataclasses import dataclass, field

from losing_disc import LosingDisc, PowerCut

from ilmek.drivers.twin_port import TwinPort
from ilmek.io.journal_file import JournalFile
from ilmek.jobs.run.operator import Operator
from ilmek.jobs.run.session import ControlSession
from ilmek.loom.control.packml import PackState
from ilmek.loom.control.ports import Order, PortReport
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.comparison import WovenResult, compare
from ilmek.loom.twin.model import NO_FAULTS, FaultRates, plant_model
from ilmek.loom.twin.state import SensorFault, first_state
from ilmek.loom.twin.woven import Woven, woven_size

FAULTY = FaultRates(3, pile_break=0.004, missed_grip=0.01, warp_break=0.002, weft_break=0.01)
LATER = 0.5
"""Share of the cuts in which the loom ends what it has begun: the controller has lost power, the loom has not."""

BLIND = 0.2
"""Share of the restarts in which the sensor cannot tell, and the operator is asked."""


@dataclass(eq=False)
class Cutter:
    """Counts the calls of a run and cuts the power at a random one."""

    chance: random.Random
    mean: float
    left: int = 0
    cuts: int = 0

    def begin(self) -> None:
        self.left = 1 + int(self.chance.expovariate(1 / self.mean))

    def __call__(self) -> bool:
        self.left -= 1
        return self.left == 0


class CutPort(TwinPort):
    """A twin at whose calls the power may fail."""

    cutter: Cutter

    def send(self, orders: "list[Order] | tuple[Order, ...]") -> None:  # type: ignore[override]
        self._cut()
        super().send(orders)
        self._cut()

    def receive(self, timeout: float) -> tuple[PortReport, ...]:
        self._cut()
        found = super().receive(timeout)
        self._cut()
        return found

    def _cut(self) -> None:
        if self.cutter():
            raise PowerCut


@dataclass
class Outcome:
    """What came of a carpet: cuts, the comparison with its chart, what was wrong."""

    cuts: int
    woven: WovenResult
    time: int
    findings: list[str] = field(default_factory=list)


def woven_through_cuts(
    programme: LoomProgramme,
    seed: int,
    *,
    group: int = 1,
    mean: float = 40.0,
    rates: FaultRates = NO_FAULTS,
    most: int | None = None,
) -> Outcome:
    """Weave a carpet whose power fails every `mean` calls, at most `most` times; seed: of everything random."""
    chance = random.Random(seed)
    cutter = Cutter(chance, mean)
    woven = Woven(programme.setup, bytearray(woven_size(programme.setup)))
    woven.keep(first_state(plant_model(programme.setup)))
    content, certain, findings = b"", 0, []
    while True:
        cutter.begin()
        if most is not None and cutter.cuts >= most:
            cutter.left = -1
        disc = LosingDisc(content, cut_at=cutter)
        port = CutPort(programme.setup, woven, rates=rates)
        port.cutter = cutter
        if chance.random() < BLIND:
            port.act(SensorFault("knotted", None), SensorFault("ended", None))
        durable = [certain]
        try:
            session = _woven(programme, port, disc, group, durable)
        except PowerCut:
            cutter.cuts += 1
            cutter.left = -1
            if chance.random() < LATER:
                for _ in range(chance.randrange(1, 4)):
                    port.receive(0.0)
            content, certain = disc.after_power_cut(chance), durable[0]
            continue
        now = session.status()
        found = compare(woven, programme)
        if not found.complete or now.knots != programme.setup.knots:
            findings.append(f"{now.knots} knots, {found}")
        return Outcome(cutter.cuts, found, now.time, findings)


def _woven(programme: LoomProgramme, port: CutPort, disc: LosingDisc, group: int, durable: list[int]) -> ControlSession:
    """Weave to the end. `durable` gets the knots that were certain at the last sync: no cut may take them back."""
    session = ControlSession(programme, port, JournalFile(disc), group)
    assert session.status().knots >= durable[0], f"{durable[0]} durable knots, {session.status().knots} after the cut"
    operator = Operator(programme, port, port._woven, automatic=True, weaving=True)
    syncs = disc.syncs
    while session.state is not PackState.COMPLETE:
        if session.state is not PackState.EXECUTE:
            assert operator.see_to(session), [one.text for one in session.status().alarms]
        session.receive(0.0)
        if group == 1 and disc.syncs != syncs:
            syncs, durable[0] = disc.syncs, session.status().knots
    return session
