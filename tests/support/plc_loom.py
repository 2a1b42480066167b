"""A loom behind a generated control program: its scans, a host that gives carpet and rows, stations that work or lie.

Nothing here knows the program's inner variables: the plant sees orders, the host requests, the operator state, alarm
and questions. The plant's row is the number of its take-ups.
"""

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from fake_loom import MemoryStore
from structured_text import Instance, Machine, PowerCut

from ilmek.io.plc.homing_logic import HOME_CODES
from ilmek.io.plc.host_data import HostRow, host_row
from ilmek.io.plc.project import plc_project, size_of
from ilmek.jobs.plc.feeder import ARRAYS, READ, Feeder, PlcValues
from ilmek.jobs.plc.host_journal import HostJournal
from ilmek.jobs.plc.plant import HONEST
from ilmek.jobs.plc.plant import DriveAct as Act
from ilmek.loom.control.interlocks import LoomAxis
from ilmek.loom.control.packml import PackCommand, PackState
from ilmek.loom.operations import EMPTY, LoomProgramme, RowEnd
from ilmek.weaving.tension import usual_tension

SENSORS: dict[str, Any] = {
    "EmergencyStop": False, "DoorClosed": True, "WarpTensionKnown": True, "BeaterBack": True, "ShedClosed": True,
}  # fmt: skip
AWAY = {
    RowEnd.STRAIGHT_WEFT: "ShedClosed",
    RowEnd.FIRST_BEAT: "BeaterBack",
    RowEnd.SINUOUS_WEFT: "ShedClosed",
    RowEnd.SECOND_BEAT: "BeaterBack",
}
"""The sensor that changes, and returns, in an operation after the knots."""

HOMES = {code: axis for axis, code in HOME_CODES.items()}
"""The axes by the numbers of the operations that home them."""

CYCLE = 0.5
"""Cycle of the program in tests [s]: a knot takes 4 scans and more."""

COMMANDS = {
    PackState.STOPPED: PackCommand.RESET,
    PackState.IDLE: PackCommand.START,
    PackState.HELD: PackCommand.UNHOLD,
    PackState.SUSPENDED: PackCommand.UNSUSPEND,
    PackState.ABORTED: PackCommand.CLEAR,
}
"""What leads the loom on from where it stands."""


class Station:
    """A head, or the loom behind the heads: done and status follow from its orders."""

    def __init__(self, scans: Callable[[], int], act: Callable[[], Act], tied: Callable[[], None]) -> None:
        self.scans, self.act_of, self.tied = scans, act, tied
        self.done, self.status, self.unasked = False, 0, 0
        self.elapsed = self.left = self.stuck = 0
        self.act = HONEST

    def step(self, order: bool) -> None:
        if order and not self.elapsed:
            self.act, self.left = self.act_of(), self.scans()
        if order:
            self.elapsed += 1
            self._work()
        else:
            if self.elapsed:
                self.elapsed, self.stuck = 0, self.act.stuck
            self.stuck = max(self.stuck - 1, -1)
            if self.stuck < 0:
                self.done, self.status = False, 0
            if self.unasked:
                self.unasked, self.done = self.unasked - 1, True

    def _work(self) -> None:
        act = self.act
        if not act.hasty and self.status == 0:
            self.status = 1
        if self.elapsed != (1 if act.early else self.left):
            return
        if act.tied:
            self.tied()
        if act.fault:
            self.status = act.fault
        elif not act.silent:
            self.done = True

    def cut_off(self, *, ended: bool) -> None:
        """Power fails while it works: the operation has got into the carpet, or not."""
        if 0 < self.elapsed < self.left and ended and not self.act.early and self.act.tied:
            self.tied()
        self.done, self.status, self.elapsed, self.stuck = False, 0, 0, -1


class PlcLoom:
    """Executes the control program of a programme. Operations take a number of scans that differs from head to head.

    heads_clear  what the sensor states; None: the heads are clear while none ties
    carpet  (row, column) -> the tubes from which knots were tied there      ends  row ends in their order
    moves   (row, head, column): where heads were led aside
    home_act    what the loom does with its next order to home an axis
    next_act    what a station does with its next order       disturb_row, disturb_recipe  what a bad host gives instead
    """

    def __init__(self, programme: LoomProgramme, capacity: LoomProgramme | None = None) -> None:
        self.programme, self.heads = programme, programme.setup.heads
        self.size = size_of(capacity or programme, CYCLE)
        self.machine = Machine(plc_project(capacity or programme, CYCLE).text)
        self.loom = self.machine.instance("Loom")
        self.carpet: dict[tuple[int, int], list[int]] = {}
        self.ends: list[tuple[int, int]] = []
        self.moves: list[tuple[int, int, int]] = []
        self.changes: list[int] = []
        tension = usual_tension(programme.setup.warp_pitch)
        self.sensors = {**SENSORS, "WarpTension": tension, "GrippersOpen": [True] * self.heads}
        self.scans = self.row = self.command = 0
        self.heads_clear: bool | None = None
        self.alarms: list[int] = []
        self.next_act: Callable[[int], Act] = lambda _: HONEST
        self.home_act: Callable[[], Act] = lambda: HONEST
        self.disturb_row: Callable[[HostRow], HostRow] = lambda row: row
        self.disturb_recipe: Callable[[dict[str, Any]], dict[str, Any]] = lambda recipe: recipe
        self.host_silent = self.between = False
        self.sizes = {name: len(self.read(f"RowData.{name}")) for name in ARRAYS}
        self.feeder = self._host()
        self.homed: list[str] = []
        self.stations = [self._head(head) for head in range(self.heads)]
        self.stations.append(Station(self._end_scans, self._end_act, self._end))
        self._changing = 0
        self._latch()

    def _latch(self) -> None:
        """What the stations see: the outputs at the end of a scan; one that was cut off has none."""
        self.orders = [*self.read("TieStart"), self.read("EndStart")]
        self.columns, self.tubes, self.end_code = self.read("TieColumn"), self.read("TieTube"), self.read("EndCode")
        self.aside = self.read("TieAside")

    def _head(self, head: int) -> Station:
        return Station(lambda: 4 + head, lambda: self.next_act(head), lambda: self._tie(head))

    def _end_act(self) -> Act:
        return self.home_act() if self.end_code in HOMES else self.next_act(self.heads)

    def _end_scans(self) -> int:
        return 3 if self.end_code in HOMES else self.size.row_ends[self.end_code].least + 2

    def next_carpet(self, programme: LoomProgramme) -> None:
        """An operator takes the carpet out; the host has another programme, and begins its journal."""
        self.programme, self.row = programme, 0
        self.feeder = self._host()
        self.carpet.clear()
        self.ends.clear()

    def take_out(self, rows: int) -> None:
        """An operator takes out the row in work and whole rows before it, and sets the host's journal back."""
        self.row -= rows
        self.feeder.journal.give(self.row, awaited=True)
        self.carpet = {place: tubes for place, tubes in self.carpet.items() if place[0] < self.row}
        self.ends = [end for end in self.ends if end[0] < self.row]

    # -- the host ----------------------------------------------------------------------------------------------------

    def _host(self) -> Feeder:
        journal = HostJournal(self.programme, MemoryStore())
        return Feeder(self.programme, journal, self.sizes, lambda number: self.disturb_row(self.host_row(number)))

    def host(self) -> None:
        """The host's cycle, unless it is silent."""
        if not self.host_silent:
            recipe, *row = self.feeder.step(CYCLE * self.scans, {name: self.read(name) for name in READ})
            own = {name.partition("Recipe.")[2] for name in recipe} - {""}
            disturbed = self.disturb_recipe({name: recipe[f"Recipe.{name}"] for name in own})
            for values in (recipe | {f"Recipe.{name}": value for name, value in disturbed.items()}, *row):
                self.write(values)

    def host_row(self, number: int) -> HostRow:
        return host_row(self.programme, number)

    def write(self, values: PlcValues) -> None:
        for name, value in values.items():
            self.machine.write(self.loom, name, value)

    # -- scans -------------------------------------------------------------------------------------------------------

    def read(self, path: str) -> Any:
        return self.machine.read(self.loom, path)

    def scan(self, **inputs: Any) -> None:
        """One scan: what the stations report since the last one, the sensors, then the program."""
        self.scans += 1
        self.host()
        for station, order in zip(self.stations, self.orders, strict=True):
            station.step(order)
        *heads, end = self.stations
        self._changing = self._changing + 1 if self.read("ChangeStart") else 0
        if self._changing == 2:
            self.changes.append(self.row)
        command, self.command = self.command, 0
        clear = self.heads_clear if self.heads_clear is not None else not (self.between or any(self.orders[:-1]))
        given = {
            **self.sensors, "HeadsClear": clear, "TieDone": [one.done for one in heads],
            "TieStatus": [one.status for one in heads], "EndDone": end.done, "EndStatus": end.status,
            "ChangeDone": self._changing >= 2, "CntrlCmd": command, "CmdChangeRequest": command > 0,
        }  # fmt: skip
        if end.elapsed and not end.done and self.end_code in AWAY:
            given[AWAY[RowEnd(self.end_code)]] = False
        self.machine.run(self.loom, **(given | inputs))
        self._latch()
        alarm = self.read("Alarm")
        if alarm and (not self.alarms or alarm != self.alarms[-1]):
            self.alarms.append(alarm)

    def until(self, name: str, value: Any, most: int = 20_000) -> None:
        """Scan until an output has a value. Raises AssertionError after a number of scans."""
        for _ in range(most):
            if self.read(name) == value:
                return
            self.scan()
        raise AssertionError(f"{name} stays {self.read(name)}, alarm {self.read('Alarm')}, row {self.row}")

    def start(self) -> None:
        """Reset and start."""
        self.command = 1
        self.until("StateCurrent", 4)
        self.command = 2
        self.until("StateCurrent", 6)

    def attend(self, scans: int) -> None:
        """An operator for a number of scans: acknowledges, answers as the sensor does, leads the loom on to its end."""
        for _ in range(scans):
            state = PackState(self.read("StateCurrent"))
            if state is PackState.COMPLETE:
                return
            acknowledge = self.read("Alarm") > 0 and self.scans % 2 == 0
            if not self.read("Alarm"):
                self.command = COMMANDS.get(state, 0)
            elif state is PackState.ABORTED:
                self.command = PackCommand.CLEAR
            self.scan(Acknowledge=acknowledge, **self.answers())

    def answers(self) -> dict[str, Any]:
        """What the sensor answers to the questions of the program: whether the knot or operation is in the carpet."""
        row, columns = self.read("RowRequest"), self.read("TieColumn")
        ties = [
            (1 + ((row, columns[head]) in self.carpet) if asked else 0)
            for head, asked in enumerate(self.read("AskTie"))
        ]
        end = 1 + ((row, self.read("EndCode")) in self.ends) if self.read("AskEnd") else 0
        return {"TieAnswer": ties, "EndAnswer": end}

    def power_cut(self, *, tied: bool, steps: int = -1) -> None:
        """All but the retained variables is lost; if `tied`, operations in progress end before, else not at all.

        steps  of a last scan that are executed before the power fails; its orders get nowhere
        """
        if steps >= 0:
            self.machine.steps = steps
            with suppress(PowerCut):
                self.scan()
            self.machine.steps = -1
        self._left_where_it_was()
        for station in self.stations:
            station.cut_off(ended=tied)
        retained = {one.name for one in self.loom.unit.variables if one.section == "VAR RETAIN"}
        kept = {name: value for name, value in self.loom.values.items() if name in retained}
        self.loom: Instance = self.machine.instance("Loom")
        self.loom.values.update(kept)
        self._changing = 0
        self._latch()

    def _tie(self, head: int) -> None:
        if self.aside[head]:
            self.moves.append((self.row, head, self.columns[head]))
        else:
            self.carpet.setdefault((self.row, self.columns[head]), []).append(self.tubes[head])

    def _end(self) -> None:
        """An operation after the knots is in the carpet, or an axis is at home."""
        if self.end_code in HOMES:
            self._home(HOMES[self.end_code])
            return
        self.ends.append((self.row, self.end_code))
        self.row += self.end_code == RowEnd.TAKE_UP

    def _home(self, axis: LoomAxis) -> None:
        """An axis moves to its switch: nothing but the grippers while one of them is closed on warps."""
        self.homed.append(axis.value)
        if axis is LoomAxis.GRIPPERS:
            self.sensors["GrippersOpen"] = [True] * self.heads
        assert all(self.sensors["GrippersOpen"]), f"{axis} moves with yarn in a gripper"
        if axis is LoomAxis.HEADS:
            assert self.sensors["ShedClosed"]
            assert self.sensors["BeaterBack"]
            self.between = False
        elif axis in {LoomAxis.BEATER, LoomAxis.SHED}:
            assert not self.between, f"{axis} strikes a head"
            self.sensors["BeaterBack" if axis is LoomAxis.BEATER else "ShedClosed"] = True

    def _left_where_it_was(self) -> None:
        """Power fails: what moved is not at its switch any more."""
        *heads, end = self.stations
        closed = [0 < head.elapsed < head.left for head in heads]
        self.sensors["GrippersOpen"] = [
            was and not now for was, now in zip(self.sensors["GrippersOpen"], closed, strict=True)
        ]
        self.between = self.between or any(closed)
        if 0 < end.elapsed < end.left and self.end_code in AWAY:
            self.sensors[AWAY[RowEnd(self.end_code)]] = False

    def woven(self) -> bool:
        """Whether every knot of the chart is in the carpet once, from its tube, and every operation after the knots."""
        rows = range(self.programme.setup.rows)
        ends = [(row, int(end)) for row in rows for end in RowEnd]
        lines = [self.programme.chart_row(row).tolist() for row in rows]
        knots = {(row, column) for row, line in enumerate(lines) for column, yarn in enumerate(line) if yarn != EMPTY}
        made = [self.programme.operations(row) for row in rows]
        tubes = {
            (row.number, column): [tube]
            for row in made
            for column, tube in zip(row.columns.tolist(), row.tubes.tolist(), strict=True)
        }
        return self.ends == ends and self.carpet == tubes and set(tubes) == knots
