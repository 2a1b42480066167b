"""Host and simulated loom at work on a PLC's program: they reach it, look at it again and again, and reach it anew.

A PLC that does not answer is tried again; its program and the host's journal are compared after each connection.
"""

import threading
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from ilmek.drivers.twin_port import TwinPort
from ilmek.errors import LoomError, ParameterError
from ilmek.io.any_programme import open_any_programme
from ilmek.io.journal_folder import JournalFolder
from ilmek.io.plc.main_program import signal_values
from ilmek.io.plc.targets import TARGETS
from ilmek.io.woven_file import open_woven
from ilmek.jobs.plc.connection import PlcAddress, Variables, checked_address, connection
from ilmek.jobs.plc.feeder import ARRAYS, READ, Feeder, PlcValues, whole
from ilmek.jobs.plc.host_journal import HostJournal
from ilmek.jobs.plc.plant import HONEST, ORDERS, DriveAct, PlcPlant
from ilmek.jobs.run.order import RunOrder
from ilmek.loom.control.alarms import ALARM_NUMBERS
from ilmek.loom.control.packml import PackCommand, PackState, state_name
from ilmek.loom.twin.comparison import WovenResult, compare

FEED, PLANT = 0.1, 0.02
"""Cycles of host and simulated loom [s]."""

_RETRY = 1.0
_LEADS = {
    PackState.COMPLETE: PackCommand.RESET,
    PackState.STOPPED: PackCommand.RESET,
    PackState.IDLE: PackCommand.START,
}


def feed(order: RunOrder, address: PlcAddress, stop: threading.Event, log: Callable[[str], None]) -> bool:
    """Give a programme's rows to a PLC until its carpet is done, or the event is set; whether it is done.

    With `order.start` the host resets and starts the PLC once. Raises LoomError: where program and journal differ too.
    """
    checked_address(address)
    with ExitStack() as stack:
        programme = open_any_programme(order.programme)
        stack.callback(programme.close)
        folder = stack.enter_context(JournalFolder(order.folder, new=order.new))
        journal = HostJournal(programme, folder.journal)
        host = _Host(order, journal, log)

        def visit(variables: Variables) -> bool:
            return host.visit(variables, Feeder(programme, journal, _sizes(variables)), stop)

        return _visited(address, stop, log, visit)


def weave_for_plc(
    order: RunOrder,
    carpet: Path,
    address: PlcAddress,
    stop: threading.Event,
    log: Callable[[str], None],
    *,
    act_of: Callable[[int], DriveAct] = lambda _: HONEST,
) -> WovenResult:
    """Be the loom of a PLC until the carpet is complete or the event is set; the carpet beside its chart.

    carpet  its file      act_of  what the drive of a station does with its next order
    """
    if not TARGETS[checked_address(address).target].signals:
        raise ParameterError(
            f"--target {address.target}, whose program reads its inputs from their addresses alone",
            allowed=", ".join(name for name, target in TARGETS.items() if target.node and target.signals),
        )
    with ExitStack() as stack:
        programme = open_any_programme(order.programme)
        stack.callback(programme.close)
        woven = stack.enter_context(open_woven(carpet, programme))
        port = TwinPort(programme.setup, woven, speed=1.0, rates=order.rates(programme.setup))
        plant = PlcPlant(programme, port, woven, act_of)

        def visit(variables: Variables) -> bool:
            while not stop.is_set():
                variables.write(signal_values(plant.step(variables.read(ORDERS))))
                if plant.row == programme.setup.rows:
                    return True
                stop.wait(PLANT)
            return False

        _visited(address, stop, log, visit)
        return compare(woven, programme)


def _visited(
    address: PlcAddress, stop: threading.Event, log: Callable[[str], None], visit: Callable[[Variables], bool]
) -> bool:
    """The value of a visit to the PLC, tried again as long as it is not reached."""
    from ilmek.drivers.opcua.plc_variables import PlcUnreachableError

    reached = True
    while not stop.is_set():
        try:
            with connection(address) as variables:
                log(f"connected to the PLC at {address.url}")
                reached = True
                return visit(variables)
        except PlcUnreachableError as failed:
            if reached:
                log(f"{failed}; it is tried again")
            reached = False
            stop.wait(_RETRY)
    return False


def _sizes(variables: Variables) -> dict[str, int]:
    values = variables.read([f"RowData.{name}" for name in ARRAYS])
    sizes = {}
    for name in ARRAYS:
        array = values[f"RowData.{name}"]
        if not isinstance(array, list):
            raise LoomError(f"RowData.{name} of the PLC's program is no array", do="write the program with `ilmek plc`")
        sizes[name] = len(array)
    return sizes


class _Host:
    """What outlives a connection: rows back and the start that are still to be ordered, the state last logged."""

    def __init__(self, order: RunOrder, journal: HostJournal, log: Callable[[str], None]) -> None:
        self._back, self._start, self._journal, self._log = order.rows_back, order.start, journal, log
        self._logged, self._edge = "", False

    def visit(self, variables: Variables, feeder: Feeder, stop: threading.Event) -> bool:
        while not stop.is_set():
            plc = variables.read(READ)
            self._report(plc)
            if self._back is not None:
                feeder.take_out(self._back, plc)
                self._back = None
            for group in feeder.step(time.monotonic(), plc):
                variables.write(group)
            if plc["CarpetDone"] and self._journal.row >= 0:
                return True
            if self._start and not self._journal.awaited:
                self._lead(variables, plc)
            stop.wait(FEED)
        return False

    def _lead(self, variables: Variables, plc: PlcValues) -> None:
        state = PackState(whole(plc, "StateCurrent"))
        self._start = state is not PackState.EXECUTE
        command = _LEADS.get(state, 0)
        self._edge = not self._edge and command > 0 and not plc["Alarm"]
        variables.write({"CntrlCmd": int(command), "CmdChangeRequest": self._edge})

    def _report(self, plc: PlcValues) -> None:
        alarm = ALARM_NUMBERS.get(whole(plc, "Alarm"))
        text = state_name(PackState(whole(plc, "StateCurrent")))
        if alarm is not None:
            text += f", alarm {alarm.number} {alarm.name}: {alarm.cause}; {alarm.remedy}"
        if text != self._logged:
            self._logged = text
            self._log(f"row {self._journal.row + 1}, {plc['KnotsDone']} knots: {text}")
