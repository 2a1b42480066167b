"""A loom without a controller, for tests of the OPC UA server: PackML's states, knots at each look."""

import threading

from ilmek.loom.control.packml import (
    COMPLETED,
    PackCommand,
    PackMode,
    PackState,
    Refusal,
    allowed_commands,
    commanded,
    state_name,
)
from ilmek.loom.control.view import AlarmView, Answer, HeadView, Snapshot, WeftView, YarnView

PROGRAMME = "ab" * 32


class SteppingLoom:
    """A loom that moves on by one state or some knots whenever it is looked at."""

    def __init__(self, total: int = 144, step: int = 12) -> None:
        self.total, self.step = total, step
        self._lock = threading.Lock()
        self.given: list[str] = []
        self.reset()

    def reset(self) -> None:
        """Begin the carpet again, stopped."""
        self.state, self.knots, self.time = PackState.STOPPED, 0, 0
        self.alarms: tuple[AlarmView, ...] = ()
        self.given.clear()

    def snapshot(self) -> Snapshot:
        """Its state, after one step."""
        with self._lock:
            self._step()
            commands = [one.name.lower() for one in allowed_commands(PackMode.PRODUCTION, self.state)]
            return Snapshot(
                programme=PROGRAMME,
                state=state_name(self.state),
                mode="Production",
                commands=tuple(commands),
                row=min(self.knots // 24, 5),
                rows=6,
                knots=self.knots,
                total=self.total,
                uncertain=0,
                time=self.time,
                left=(self.total - self.knots) * 10**9,
                speed=2.5,
                faults=0,
                stop="",
                heads=(HeadView(3, 1, 1, 4, 12, 2), HeadView(None, None, None, 0, 12, None)),
                alarms=self.alarms,
                yarns=(YarnView(0, 0, 0, 999.5), YarnView(1, 2, 2, 12.0)),
                wefts=(WeftView("straight weft", 3),),
            )

    def command(self, name: str) -> Answer:
        """Move to the state that a command leads to."""
        with self._lock:
            self.given.append(name)
            if name == "acknowledge":
                self.alarms = ()
                return Answer(True)
            found = commanded(PackMode.PRODUCTION, self.state, PackCommand[name.upper()])
            if isinstance(found, Refusal):
                return Answer(False, found.text)
            self.state = found
            return Answer(True)

    def _step(self) -> None:
        if self.state is PackState.EXECUTE and self.knots < self.total:
            self.knots = min(self.total, self.knots + self.step)
            self.time += self.step * 10**9
        elif self.state in COMPLETED:
            self.state = COMPLETED[self.state]
