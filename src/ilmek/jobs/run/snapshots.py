"""What a session shows of its controller: `Snapshot` from the controller's status and the programme."""

from collections import deque
from collections.abc import Sequence

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.jobs.run.session import ControlSession
from ilmek.jobs.run.yarn_meter import YarnMeter
from ilmek.loom.control.exchange import ControllerStatus
from ilmek.loom.control.packml import allowed_commands, state_name
from ilmek.loom.control.ports import ChangePackages
from ilmek.loom.control.view import AlarmView, HeadView, Snapshot
from ilmek.loom.operations import EMPTY, LoomProgramme, LoomSetup, RowOperations
from ilmek.units import BILLION, format_quantity

_LATELY = 40
"""Snapshots over which the speed is taken."""


class SnapshotMaker:
    """Makes the snapshots of a carpet, one after the other; row_times: of each row [s], if known."""

    def __init__(self, programme: LoomProgramme, row_times: FloatArray | None = None) -> None:
        self._row_times = row_times
        self._programme = programme
        self._meter = YarnMeter(programme)
        self._points: deque[tuple[int, int]] = deque(maxlen=_LATELY)

    def make(self, session: ControlSession) -> Snapshot:
        """The snapshot of a session now."""
        status, setup = session.status(), self._programme.setup
        row = min(status.row, setup.rows - 1)
        phase = status.phase if row == status.row else self._meter.operations.phases
        operations = self._meter.go_to(row, phase)
        knots = operations.counts.sum(axis=1).tolist()
        tied = knots if status.complete else session.tied()
        speed = self._speed(status)
        return Snapshot(
            programme=self._programme.digest,
            state=state_name(status.state),
            mode=status.mode.name.capitalize(),
            commands=tuple(command.name.lower() for command in allowed_commands(status.mode, status.state)),
            row=row,
            rows=setup.rows,
            knots=status.knots,
            total=setup.knots,
            uncertain=status.uncertain,
            time=status.time,
            left=self._left(status, tied, knots),
            speed=speed,
            faults=status.faults,
            stop=_stop_words(status, setup),
            requests=tuple(request.text for request in status.requests),
            heads=tuple(self._head(head, tied[head], operations) for head in range(setup.heads)),
            alarms=tuple(
                AlarmView(alarm.kind.name, alarm.text, alarm.kind.remedy, alarm.kind.latched, alarm.time)
                for alarm in status.alarms
            ),
            yarns=self._meter.views(tied),
            wefts=self._meter.wefts(),
        )

    def _head(self, head: int, tied: int, operations: RowOperations) -> HeadView:
        starts = operations.starts
        begin, end = int(starts[head]), int(starts[head + 1])
        now = begin + tied if begin + tied < end else end - 1
        if begin == end:
            return HeadView(None, None, None, 0, 0, None)
        tube = int(operations.tubes[now])
        others = np.flatnonzero(operations.tubes[now:end] != tube)
        following = self._yarn(head, int(operations.tubes[now + others[0]])) if len(others) else None
        return HeadView(int(operations.columns[now]), tube, self._yarn(head, tube), tied, end - begin, following)

    def _yarn(self, head: int, tube: int) -> int | None:
        yarn = int(self._meter.loading[head, tube])
        return None if yarn == EMPTY else yarn

    def _left(self, status: ControllerStatus, tied: Sequence[int], knots: Sequence[int]) -> int:
        """Time until the carpet's end without faults and stops [ns]: of the rows, and of the part of this one."""
        if status.complete:
            return 0
        if self._row_times is None:
            return (self._programme.setup.knots - status.knots) * status.time // max(1, status.knots)
        rest = 1.0 - sum(tied) / max(1, sum(knots))
        return round(
            BILLION * (float(self._row_times[status.row + 1 :].sum()) + rest * float(self._row_times[status.row]))
        )

    def _speed(self, status: ControllerStatus) -> float:
        """Knots a second of the loom's clock, lately."""
        self._points.append((status.time, status.knots))
        (begin, before), (end, after) = self._points[0], self._points[-1]
        return BILLION * (after - before) / (end - begin) if end > begin else 0.0


def _stop_words(status: ControllerStatus, setup: LoomSetup) -> str:
    """What the operator changes in the stop that the loom waits in; "": none."""
    operation = status.operation
    if not isinstance(operation, ChangePackages):
        return ""
    stop = operation.stop
    wefts = [f"bobbin of {setup.wefts[index].yarn}" for index in stop.wefts]
    names = [yarn.name for yarn in setup.yarns]
    tubes = [
        f"{names[tube.yarn]} ({format_quantity(tube.length, 'm', 3)}) on tube {tube.tube + 1} of head {tube.head + 1}"
        for tube in stop.tubes
    ]
    return "; ".join((*wefts, *tubes))
