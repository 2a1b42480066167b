"""The operator of a run: leads the controller on, and beside a simulated loom repairs, answers and unholds."""

from ilmek.drivers.twin_port import TwinPort
from ilmek.jobs.run.commands import lead_on, waits
from ilmek.jobs.run.session import ControlSession
from ilmek.loom.control.alarms import ControlFault
from ilmek.loom.control.exchange import Answered, ControllerStatus, Operation
from ilmek.loom.control.packml import PackState
from ilmek.loom.control.ports import EndRow, Tie
from ilmek.loom.operations import LoomProgramme, Stop
from ilmek.loom.twin.model import nanometres
from ilmek.loom.twin.state import Door, EmergencyStop, Repaired
from ilmek.loom.twin.woven import Woven

MOST_TRIES = 20
"""Attempts to go on after an alarm without a new knot or operation, before the operator gives up."""

_FAULTY = (PackState.HELD, PackState.SUSPENDED, PackState.ABORTED)


class Operator:
    """Beside a loom.

    automatic  repairs what is broken, answers what the controller asks, and goes on; else a person does
    weaving    lead the controller on to Execute       waiting  a command has stopped the loom: nothing is done
    """

    def __init__(
        self, programme: LoomProgramme, port: TwinPort, woven: Woven, *, automatic: bool, weaving: bool
    ) -> None:
        self._programme, self._port, self._woven = programme, port, woven
        self.automatic, self.weaving, self.waiting = automatic, weaving, False
        self._tries, self._knots = 0, (-1, -1)

    def commanded(self, name: str) -> None:
        """A command was carried out that another has given."""
        self.waiting = name in ("hold", "suspend", "stop", "abort")
        if name in ("stop", "abort"):
            self.weaving = False
        elif name in ("start", "unhold", "unsuspend"):
            self.weaving = True

    def see_to(self, session: ControlSession) -> bool:
        """Do what a machine that waits needs. False where nothing helps."""
        status = session.status()
        if self.automatic:
            for request in status.requests:
                session.react((Answered(request.number, self._in_carpet(request.operation)),))
        if self.waiting:
            return True
        lost = session.state is PackState.STOPPED and any(
            alarm.kind.name == ControlFault.NOT_HOME for alarm in status.alarms
        )
        if session.state not in _FAULTY and not (lost and self.weaving):
            asked = session.state is PackState.IDLE and status.alarms and not self.automatic
            if self.weaving and waits(session) and not asked:
                lead_on(session)
            return True
        if not self.automatic:
            return True
        if not self._tries_again(status):
            return False
        self.repair(session)
        lead_on(session)
        return True

    def repair(self, session: ControlSession) -> None:
        """Put the simulated loom in order: guard closed, yarns pieced, axes at rest."""
        self._port.act(Door(True), EmergencyStop(False), Repaired())
        session.receive(0.0)  # what the sensors then show

    def _tries_again(self, status: ControllerStatus) -> bool:
        done = (status.knots, status.row)
        self._tries = self._tries + 1 if done == self._knots else 0
        self._knots = done
        return self._tries < MOST_TRIES

    def _in_carpet(self, operation: Operation) -> bool:
        """What the operator sees on the loom."""
        if isinstance(operation, Tie):
            return self._woven.times_tied(operation.row, operation.column) > 0
        if isinstance(operation, EndRow):
            return self._woven.times_ended(operation.row, operation.operation) > 0
        return self._changed(operation.stop)

    def _changed(self, stop: Stop) -> bool:
        """Whether the packages of a stop are on the loom: something is woven behind it, or they are still full."""
        before = int(self._programme.operations(stop.row).counts[:, : stop.phase].sum())
        later = range(stop.row + 1, min(stop.row + 2, self._woven.rows))
        if int(self._woven.counts(stop.row).sum()) > before or any(self._woven.counts(row).any() for row in later):
            return True
        state, setup = self._port.state, self._programme.setup
        wefts = all(state.condition.wefts[index] == setup.wefts[index].rows for index in stop.wefts)
        tubes = (
            state.heads[tube.head].condition.yarns[tube.tube] == tube.yarn
            and state.heads[tube.head].left[tube.tube] == nanometres(tube.length)
            for tube in stop.tubes
        )
        return wefts and all(tubes)
