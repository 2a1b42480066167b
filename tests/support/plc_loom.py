"""A loom behind a generated control program: the program's scans, with a host that gives rows and a twin that works."""

from typing import Any

import numpy as np
from structured_text import Machine

from ilmek.io.plc.project import plc_project, size_of
from ilmek.io.plc.sequence_variables import PlcSize
from ilmek.loom.operations import LoomProgramme, RowOperations

SENSORS: dict[str, Any] = {
    "EmergencyStop": False, "DoorClosed": True, "WarpTensionKnown": True, "WarpTension": 15.0,
    "BeaterBack": True, "ShedClosed": True,
}  # fmt: skip


class PlcLoom:
    """Executes the control program of a programme. Operations take a number of scans that differs from head to head.

    heads_clear  what the sensor states; None: the heads are clear while none ties
    carpet  (row, column) -> how often and from which tube a knot was tied there      ends  row ends in their order
    """

    def __init__(self, programme: LoomProgramme) -> None:
        self.programme, self.heads = programme, programme.setup.heads
        self.project, self.size = plc_project(programme), size_of(programme)
        self.machine = Machine(self.project.text)
        self.loom = self.machine.instance("Loom")
        self.carpet: dict[tuple[int, int], list[int]] = {}
        self.ends: list[tuple[int, int]] = []
        self.changes: list[int] = []
        self.sensors = {**SENSORS, "GrippersOpen": [True] * self.heads}
        self.scans = 0
        self.heads_clear: bool | None = None
        self._left: dict[int, int] = {}
        self._fail: dict[int, int] = {}
        self.command = 0

    def give_row(self) -> None:
        """The host: writes the row that the program requests."""
        number = self.read("RowRequest")
        if number == self.read("RowData.Number") or number >= self.programme.setup.rows:
            return
        for name, values in row_values(self.programme.operations(number), self.size).items():
            self.machine.write(self.loom, f"RowData.{name}", values)
        self.machine.write(self.loom, "RowData.Number", number)

    def read(self, path: str) -> Any:
        return self.machine.read(self.loom, path)

    def fail(self, head: int, alarm: int) -> None:
        """The next knot of a head ends with a fault; head -1: the next operation after the knots."""
        self._fail[head] = alarm

    def scan(self, **inputs: Any) -> None:
        """One scan: the loom's reports since the last one, the sensors, then the program."""
        self.scans += 1
        self.give_row()
        done, fault = [False] * self.heads, [0] * self.heads
        ended, end_fault = False, 0
        for head in range(self.heads):
            if self._over(head, self.read("TieStart")[head], 2 + head):
                fault[head] = self._fail.pop(head, 0)
                done[head] = fault[head] == 0
                if done[head]:
                    self._tie(head)
        if self._over(-1, self.read("EndStart"), 3):
            end_fault = self._fail.pop(-1, 0)
            ended = end_fault == 0
            if ended:
                self._end()
        changed = bool(self._over(-2, self.read("ChangeStart"), 2))
        if changed:
            self.changes.append(self.read("Row"))
        command, self.command = self.command, 0
        clear = self.heads_clear if self.heads_clear is not None else not any(self.read("TieStart"))
        self.machine.run(
            self.loom, **self.sensors, HeadsClear=clear, TieDone=done, TieFault=fault, EndDone=ended,
            EndFault=end_fault, ChangeDone=changed, CntrlCmd=command, CmdChangeRequest=command > 0, **inputs,
        )  # fmt: skip

    def until(self, name: str, value: Any, most: int = 20_000) -> None:
        """Scan until an output has a value. Raises AssertionError after a number of scans."""
        for _ in range(most):
            if self.read(name) == value:
                return
            self.scan()
        raise AssertionError(f"{name} stays {self.read(name)}, alarm {self.read('Alarm')}, row {self.read('Row')}")

    def start(self) -> None:
        """Reset and start."""
        self.command = 1
        self.until("StateCurrent", 4)
        self.command = 2
        self.until("StateCurrent", 6)

    def power_cut(self, *, tied: bool) -> None:
        """All but the retained variables is lost; if `tied`, operations in progress end before, else not at all."""
        kept = {}
        for one in self.machine.units["LOOM"].variables:
            if one.section == "VAR RETAIN":
                kept[one.name] = self.read(one.name)
        if tied:
            for head in range(self.heads):
                if self.read("TieStart")[head]:
                    self._tie(head)
            if self.read("EndStart"):
                self._end()
        self.loom = self.machine.instance("Loom")
        self._left.clear()
        for name, value in kept.items():
            self.machine.write(self.loom, name, value)

    def _over(self, key: int, started: bool, scans: int) -> bool:
        """Whether an operation that is ordered ends in this scan."""
        if not started:
            self._left.pop(key, None)
            return False
        left = self._left.setdefault(key, scans)
        self._left[key] = left - 1
        if left > 1:
            return False
        del self._left[key]
        return True

    def _tie(self, head: int) -> None:
        at = self.read("Row"), self.read("TieColumn")[head]
        self.carpet.setdefault(at, []).append(self.read("TieTube")[head])

    def _end(self) -> None:
        """An operation after the knots is in the carpet."""
        self.ends.append((self.read("Row"), self.read("EndCode")))


def row_values(row: RowOperations, size: PlcSize) -> dict[str, list[int] | list[bool]]:
    """The values of the structure's arrays by name; phases that a row lacks repeat its last one."""
    limits = np.cumsum(row.counts, axis=1)
    missing = size.phases - row.phases
    limits = np.concatenate([limits, np.repeat(limits[:, -1:], missing, axis=1)], axis=1)
    stops = {stop.phase for stop in row.stops}
    return {
        "Columns": row.columns.tolist(),
        "Tubes": row.tubes.tolist(),
        "First": row.starts[:-1].tolist(),
        "Limits": limits.ravel().tolist(),
        "StopBefore": [phase in stops for phase in range(size.phases)],
    }
