"""A controller at work on a loom: what it puts out is carried out, in its order, on the loom and in the journal.

    halt, append, sync, speed, orders, questions

An order is sent only after the records before it are durable. When the journal cannot be written nothing more is sent:
the loom halts, and the session has failed; another one on the same journal and loom goes on.
"""

import errno
import secrets
from collections.abc import Iterable

from ilmek.loom.control.alarms import JournalFault
from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import (
    ControlInput,
    ControllerStatus,
    ControlOutputs,
    Sensed,
    StateChanged,
    StoreFailed,
)
from ilmek.loom.control.journal import JournalStore
from ilmek.loom.control.opening import open_journal
from ilmek.loom.control.packml import PackState
from ilmek.loom.control.ports import LoomPort, SensorsChanged, Tie
from ilmek.loom.operations import LoomProgramme


class ControlSession:
    """A controller that begins or goes on with the carpet of a journal.

    group   knots of a group commit; only for a new journal
    Raises JournalError for a journal that is damaged or of another programme; OSError where it cannot be written.
    """

    def __init__(self, programme: LoomProgramme, port: LoomPort, store: JournalStore, group: int = 1) -> None:
        content = store.read()
        opened = open_journal(content, programme, group=group, nonce=secrets.randbits(64))
        if opened.cut:
            store.truncate(opened.size)
        self.controller = Controller(programme, opened)
        self.port, self.store = port, store
        self.state = PackState.STOPPED
        self.failure: OSError | None = None
        self.react((SensorsChanged(port.sensors(), opened.time),))

    def react(self, inputs: Iterable[ControlInput]) -> ControlOutputs:
        """Give inputs to the controller and carry out what it puts out; its first outputs, for their refusals."""
        first = outputs = self.controller.react(inputs)
        while True:
            following = self._carried_out(outputs)
            if following is None:
                return first
            outputs = self.controller.react(following)

    def receive(self, timeout: float) -> None:
        """Wait for reports of the loom for at most so long [s], and react to them, even to none."""
        self.react(self.port.receive(timeout))

    def tied(self) -> list[int]:
        """Knots of the row in work that are in the carpet, of each head."""
        return self.controller.state.sequence.upcoming

    def status(self) -> ControllerStatus:
        """The state of the controller."""
        return self.controller.status()

    def _carried_out(self, outputs: ControlOutputs) -> tuple[ControlInput, ...] | None:
        """Carry out outputs; the inputs that follow from them, None: none."""
        following: list[ControlInput] = []
        for event in outputs.events:
            if isinstance(event, StateChanged):
                self.state = event.state
        if outputs.halt:
            self.port.halt()
            following += self.port.receive(0.0)
        if (outputs.append or outputs.sync) and not self._stored(outputs):
            return (*following, _store_failed(self.failure))
        if outputs.speed is not None:
            self.port.set_speed(outputs.speed)
        if outputs.orders and self.failure is None:
            self.port.send(outputs.orders)
        following += [Sensed(question, self._sensed(question)) for question in outputs.questions]
        return tuple(following) if following or outputs.halt else None

    def _stored(self, outputs: ControlOutputs) -> bool:
        """Write to the journal; False at the first failure. After it nothing is written by this session."""
        if self.failure is not None:
            return True
        try:
            if outputs.append:
                self.store.append(outputs.append)
            if outputs.sync:
                self.store.sync()
        except OSError as error:
            self.failure = error
            return False
        return True

    def _sensed(self, operation: object) -> bool | None:
        if isinstance(operation, Tie):
            return self.port.knotted(operation.row, operation.column)
        return self.port.ended(operation.row, operation.operation)  # type: ignore[attr-defined]


_FAULTS = {
    errno.ENOSPC: JournalFault.DISC_FULL,
    errno.EDQUOT: JournalFault.DISC_FULL,
    errno.EROFS: JournalFault.READ_ONLY,
}


def _store_failed(error: OSError | None) -> StoreFailed:
    number = error.errno if error is not None else None
    return StoreFailed(_FAULTS.get(number or 0, JournalFault.WRITE_FAILED), error.strerror or "" if error else "")
