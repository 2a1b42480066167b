"""A control program, executed by the interpreter, between the host that feeds it and the simulated loom."""

import threading
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from fake_loom import MemoryStore
from plc_loom import COMMANDS
from structured_text import Machine, PowerCut

from ilmek.drivers.twin_port import TwinPort
from ilmek.io.plc.project import plc_project
from ilmek.jobs.plc.feeder import ARRAYS, READ, Feeder, PlcValues
from ilmek.jobs.plc.host_journal import HostJournal
from ilmek.jobs.plc.plant import HONEST, ORDERS, DriveAct, PlcPlant
from ilmek.loom.control.packml import PackCommand, PackState
from ilmek.loom.operations import LoomProgramme
from ilmek.loom.twin.comparison import compare
from ilmek.loom.twin.model import plant_model
from ilmek.loom.twin.state import first_state
from ilmek.loom.twin.woven import Woven, woven_size

CYCLE = 0.25
"""Cycle of the program in tests [s]."""


class ScanClock:
    """A clock that goes on by a cycle with each scan."""

    def __init__(self) -> None:
        self.scans = 0

    def now(self) -> float:
        return CYCLE * self.scans

    def wait(self, seconds: float, woken: threading.Event) -> None:
        assert seconds <= CYCLE or woken.is_set()


class PlantedProgram:
    """The program of a programme at work; an operator leads it on, and power may fail in any scan."""

    def __init__(self, programme: LoomProgramme, act_of: Callable[[int], DriveAct] = lambda _: HONEST) -> None:
        self.programme, self.clock, self.store = programme, ScanClock(), MemoryStore()
        self.machine = Machine(plc_project(programme, CYCLE).text)
        self.loom = self.machine.instance("Loom")
        self.woven = Woven(programme.setup, bytearray(woven_size(programme.setup)))
        self.woven.keep(first_state(plant_model(programme.setup)))
        self.port = TwinPort(programme.setup, self.woven, speed=1.0, clock=self.clock)
        self.plant = PlcPlant(programme, self.port, self.woven, act_of)
        self.command = 0
        self.alarms: list[int] = []
        self.host_starts()

    def host_starts(self) -> None:
        """The host starts, with the journal that it left."""
        sizes = {name: len(self.read(f"RowData.{name}")) for name in ARRAYS}
        self.feeder = Feeder(self.programme, HostJournal(self.programme, self.store), sizes)

    def read(self, name: str) -> Any:
        return self.machine.read(self.loom, name)

    def write(self, values: PlcValues) -> None:
        for name, value in values.items():
            self.machine.write(self.loom, name, value)

    def scan(self, steps: int = -1) -> None:
        """Host, loom and program, one after the other. steps: of the program before the power fails, -1: all."""
        self.clock.scans += 1
        for group in self.feeder.step(self.clock.now(), {name: self.read(name) for name in READ}):
            self.write(group)
        self.write(self.plant.step({name: self.read(name) for name in ORDERS}))
        state, alarm = PackState(self.read("StateCurrent")), self.read("Alarm")
        command = self.command or int(COMMANDS.get(state, 0) if not alarm or state is PackState.ABORTED else 0)
        acknowledge = alarm > 0 and self.clock.scans % 20 == 0
        if alarm and self.alarms[-1:] != [alarm]:
            self.alarms.append(alarm)
        self.machine.steps = steps
        with suppress(PowerCut):
            self.machine.run(
                self.loom, CntrlCmd=command, CmdChangeRequest=command > 0 and self.clock.scans % 2 == 0,
                Acknowledge=acknowledge,
            )  # fmt: skip
        self.machine.steps = -1

    def until(self, name: str, least: int) -> None:
        """Scan until an output has at least a value."""
        while self.read(name) < least:
            self.scan()

    def stop(self) -> None:
        """The operator stops the loom, and leaves it stopped."""
        self.command = int(PackCommand.STOP)
        while self.read("StateCurrent") != PackState.STOPPED:
            self.scan()

    def weave(self, most: int = 12_000) -> None:
        """Scan until the carpet is complete."""
        self.command = 0
        for _ in range(most):
            if self.read("CarpetDone"):
                return
            self.scan()
        raise AssertionError(f"alarm {self.read('Alarm')}, state {self.read('StateCurrent')}, row {self.plant.row}")

    def power_cut(self, steps: int) -> None:
        """Power of the whole loom fails in a scan, after some steps of the program: what moves stays where it is."""
        self.scan(steps)
        self.plant.halt()
        retained = {one.name for one in self.loom.unit.variables if one.section == "VAR RETAIN"}
        kept = {name: value for name, value in self.loom.values.items() if name in retained}
        self.loom = self.machine.instance("Loom")
        self.loom.values.update(kept)

    def equal_to_the_chart(self) -> bool:
        """Whether every knot is in the carpet once, in its colour, and every operation after the knots once."""
        return compare(self.woven, self.programme).complete
