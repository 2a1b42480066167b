"""A simulated loom behind the signals of a control program: its drives, its sensors, the operator beside it.

    order rises -> status 1: accepted -> done, or a fault's alarm as status -> order falls -> done and status fall

The loom is that of `ilmek run`, behind the same port. Between program and port are the drives of its stations, the
heads and behind them the loom as a whole; a drive may lie (`DriveAct`). An operation goes on when its order falls too
early: the answer whether it is in the carpet waits for its end.
"""

from collections.abc import Callable

import numpy as np

from ilmek.drivers.twin_port import TwinPort
from ilmek.errors import LoomError
from ilmek.io.plc.homing_logic import HOME_CODES
from ilmek.io.plc.interlock_logic import SENSOR_NAMES, TENSION_KNOWN
from ilmek.io.plc.order_logic import IN_CARPET, NOT_IN_CARPET
from ilmek.io.plc.sequence_variables import ACCEPTED
from ilmek.jobs.plc.feeder import PlcValue, PlcValues
from ilmek.loom.control.alarms import ALARMS
from ilmek.loom.control.interlocks import JOG_LIMITS, LoomAxis
from ilmek.loom.control.packml import PackState
from ilmek.loom.control.ports import ChangePackages, Done, EndRow, Failed, Fault, Home, Jog, Order, StandAside, Tie
from ilmek.loom.operations import LoomProgramme, RowEnd, Stop
from ilmek.loom.standing import asides
from ilmek.loom.twin.state import Door, EmergencyStop, Repaired
from ilmek.loom.twin.woven import Woven
from ilmek.records import JsonObject, value_record

ORDERS = ("TieStart", "TieColumn", "TieTube", "TieAside", "EndStart", "EndCode", "ChangeStart", "JogStart", "JogAxis",
          "Halt", "AskTie", "AskEnd", "StateCurrent", "Alarm", "RowRequest", "RowsBackRequest")  # fmt: skip
"""What the loom reads in each cycle."""

_AXES = {code: axis for axis, code in HOME_CODES.items()}
_FAULTS = [ALARMS[fault].number for fault in Fault if fault is not Fault.MISSED_GRIP]
_STANDS = (PackState.HELD, PackState.SUSPENDED, PackState.STOPPED, PackState.ABORTED)


@value_record
class DriveAct:
    """What a drive does with an order.

    tied    the operation gets into the carpet         fault    reported instead of the end, 0: none
    silent  it reports nothing                         early    it reports at once
    hasty   it never reports that it has accepted      stuck    cycles for which its report stays behind the order
    """

    tied: bool = True
    fault: int = 0
    silent: bool = False
    early: bool = False
    hasty: bool = False
    stuck: int = 0


HONEST = DriveAct()

HOSTILE = 0.12
"""Share of the orders with which a hostile drive does something else."""


def hostile_drives(seed: int | None) -> Callable[[int], DriveAct]:
    """What drives do that are honest, or with a seed now and then silent, early, hasty, stuck, or report a fault.

    What a drive reports of a knot in its time it has done: a lie about that no program can find.
    """
    if seed is None:
        return lambda _: HONEST
    random = np.random.default_rng(seed)

    def act_of(_: int) -> DriveAct:
        if random.random() >= HOSTILE:
            return HONEST
        tied = bool(random.integers(2))
        choices = (
            DriveAct(tied=tied, fault=int(random.choice(_FAULTS))),
            DriveAct(tied=tied, fault=int(random.choice((-5, 102, 999)))),
            DriveAct(tied=False, fault=ALARMS[Fault.MISSED_GRIP].number),
            DriveAct(tied=tied, silent=True),
            DriveAct(tied=tied, early=True),
            DriveAct(tied=tied, hasty=True),
            DriveAct(stuck=int(random.choice((5, 250)))),
        )
        return choices[random.integers(len(choices))]

    return act_of


class _Drive:
    """A station: its order and what it reports.

    ordered  its order has not fallen      begun  the loom carries it out      age  cycles since it rose
    """

    def __init__(self) -> None:
        self.order: Order | None = None
        self.act = HONEST
        self.ordered = self.begun = self.done = False
        self.status, self.stuck, self.age, self.usual = 0, 0, 0, 0

    def begin(self, order: Order, act: DriveAct) -> None:
        self.order, self.act, self.age = order, act, 0
        self.ordered, self.begun, self.done, self.status = True, False, act.early, 0 if act.hasty else ACCEPTED

    def end(self, fault: int) -> None:
        """The order is carried out, or has failed with a fault's alarm."""
        self.order, self.begun, self.usual = None, False, self.age
        if self.ordered and not self.act.silent:
            self.status = fault or self.act.fault or self.status
            self.done = self.status <= ACCEPTED

    def withdraw(self) -> None:
        """There is no order: done and status fall, some cycles later where they are stuck."""
        if self.ordered:
            self.ordered, self.stuck = False, self.act.stuck
        if self.stuck > 0:
            self.stuck -= 1
        else:
            self.done, self.status = False, 0


class PlcPlant:
    """A loom at work on a programme, for a program on a PLC.

    port    the loom      woven  its carpet      act_of  what the drive of a station does with its next order
    """

    def __init__(
        self,
        programme: LoomProgramme,
        port: TwinPort,
        woven: Woven,
        act_of: Callable[[int], DriveAct] = lambda _: HONEST,
    ) -> None:
        self._programme, self._port, self._woven, self._act_of = programme, port, woven, act_of
        self._heads = programme.setup.heads
        self._drives = [_Drive() for _ in range(self._heads + 1)]
        self._stop: Stop | None = None
        self._alone: ChangePackages | Jog | None = None
        self._halted = self._jogging = self._changed = self._back = False
        self._alarm = 0
        rows = range(programme.setup.rows)
        self.row = next((row for row in rows if not woven.times_ended(row, RowEnd.TAKE_UP)), len(rows))

    def step(self, plc: PlcValues, timeout: float = 0.0) -> dict[str, PlcValue]:
        """What the program reads from the loom. plc: the values of ORDERS; timeout: longest wait for the loom [s].

        Raises LoomError for an order that no loom can carry out, and for one that would damage it.
        """
        values: JsonObject = dict(plc)
        self._attend(values)
        if values["Halt"] and not self._halted:
            self.halt()
        self._halted = values["Halt"]
        for station, start in enumerate((*values["TieStart"], values["EndStart"])):
            self._step_drive(station, start, values)
        self._change(values["ChangeStart"])
        if values["JogStart"] and not self._jogging and self._idle():
            axis = tuple(LoomAxis)[values["JogAxis"] - 1]
            self._begin_alone(Jog(axis.value, JOG_LIMITS[axis].distance))
        self._jogging = values["JogStart"]
        reports = self._port.receive(timeout)
        while reports:
            for report in reports:
                if isinstance(report, Done | Failed):
                    self._end(report)
            reports = self._port.receive(0.0)
        return self._signals(values)

    def halt(self) -> None:
        """All drives stop where they are: the program orders so, or its power has failed."""
        self._port.halt()
        self._alone = None
        self._drives = [_Drive() for _ in self._drives]

    def _idle(self) -> bool:
        return self._alone is None and not any(drive.begun for drive in self._drives)

    def _attend(self, plc: JsonObject) -> None:
        """The operator repairs what an alarm has stopped, and takes out rows that are to be woven again."""
        if not plc["Alarm"]:
            self._alarm = 0
        elif plc["Alarm"] != self._alarm and plc["StateCurrent"] in _STANDS and self._idle():
            self._alarm = plc["Alarm"]
            self._port.act(Door(True), EmergencyStop(False), Repaired())
        self._back = plc["StateCurrent"] == PackState.STOPPED and (self._back or plc["RowsBackRequest"])
        if self._back and 0 <= plc["RowRequest"] <= self.row < self._programme.setup.rows:
            self._woven.take_out(plc["RowRequest"], self.row)
            self.row = plc["RowRequest"]

    def _step_drive(self, station: int, start: bool, plc: JsonObject) -> None:
        drive, loom = self._drives[station], self._drives[-1]
        if not start:
            drive.withdraw()
        elif not drive.ordered and drive.order is None:
            drive.begin(self._order(station, plc), self._act_of(station))
        if drive.order is None:
            return
        drive.age += 1
        if not drive.act.tied:
            if drive.age >= drive.usual:
                drive.end(0)
        elif not drive.begun and (self._idle() if drive is loom else self._alone is None and not loom.begun):
            drive.begun = True
            self._port.send((drive.order,))

    def _order(self, station: int, plc: JsonObject) -> Order:
        if station == self._heads:
            code = plc["EndCode"]
            return Home(_AXES[code].value) if code in _AXES else EndRow(self.row, RowEnd(code))
        row, column = self._programme.operations(self.row), plc["TieColumn"][station]
        if plc["TieAside"][station]:
            moves = asides(row, self._programme.setup.columns)
            phases = [phase for phase, move in enumerate(moves) if move.get(station) == column]
            if not phases:
                raise LoomError(f"head {station} aside at column {column} in row {self.row}", allowed=f"{moves}")
            return StandAside(station, self.row, phases[0], column)
        columns = row.columns[row.starts[station] : row.starts[station + 1]].tolist()
        if column not in columns:
            raise LoomError(f"a knot of head {station} at column {column} in row {self.row}", allowed=f"{columns}")
        return Tie(station, self.row, columns.index(column), column, plc["TieTube"][station])

    def _change(self, start: bool) -> None:
        """The operator changes the packages of the stop before the phase in work."""
        if not start:
            self._changed = False
        elif self._alone is None and not self._changed and self._idle():
            row = self._programme.operations(self.row)
            tied = int(self._woven.counts(self.row).sum())
            stops = [stop for stop in row.stops if int(row.counts[:, : stop.phase].sum()) == tied]
            if not stops:
                raise LoomError(f"a change of packages in row {self.row} after {tied} knots")
            following = stops.index(self._stop) + 1 if self._stop in stops else 0
            self._stop = stops[following % len(stops)]
            self._begin_alone(ChangePackages(self._stop))

    def _begin_alone(self, order: ChangePackages | Jog) -> None:
        self._alone = order
        self._port.send((order,))

    def _end(self, report: Done | Failed) -> None:
        order = report.order
        if order == self._alone:
            self._alone, self._changed = None, isinstance(order, ChangePackages)
            return
        drive = self._drives[order.head if isinstance(order, Tie | StandAside) else -1]
        drive.end(ALARMS[report.fault].number if isinstance(report, Failed) else 0)
        if isinstance(report, Done) and isinstance(order, EndRow) and order.operation is RowEnd.TAKE_UP:
            self.row += 1

    def _signals(self, plc: JsonObject) -> dict[str, PlcValue]:
        *heads, loom = self._drives
        sensors, row = self._port.sensors(), plc["RowRequest"]
        values: JsonObject = {name: getattr(sensors, sensor) for sensor, name in SENSOR_NAMES.items()}
        tension = values["WarpTension"]
        ties = [
            _answer(drive, self._port.knotted(row, column) if asked else None)
            for drive, asked, column in zip(heads, plc["AskTie"], plc["TieColumn"], strict=True)
        ]
        end = self._port.ended(row, RowEnd(plc["EndCode"])) if plc["AskEnd"] else None
        return {
            **values, TENSION_KNOWN: tension is not None, "WarpTension": tension or 0.0,
            "GrippersOpen": list(values["GrippersOpen"]), "TieDone": [drive.done for drive in heads],
            "TieStatus": [drive.status for drive in heads], "EndDone": loom.done, "EndStatus": loom.status,
            "ChangeDone": self._changed, "TieAnswer": ties, "EndAnswer": _answer(loom, end),
        }  # fmt: skip


def _answer(drive: _Drive, in_carpet: bool | None) -> int:
    """0: nothing is asked, the sensor cannot tell, or the operation has not ended."""
    if in_carpet is None or drive.order is not None:
        return 0
    return IN_CARPET if in_carpet else NOT_IN_CARPET
