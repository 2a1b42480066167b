"""Random runs of the controller: modes, jogs, speeds, faults, sensors, commands, crashes, torn and missing writes.

Beside the exhaustive model of small carpets: a larger carpet, and everything at once.
"""

import random
from collections.abc import Sequence
from dataclasses import replace

import pytest
from fake_loom import READY, FakeLoom, MemoryStore, all_operations
from small_programme import small_programme

from ilmek.loom.control.alarms import JournalFault
from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import (
    Acknowledged,
    Answered,
    Commanded,
    ControlInput,
    JogRequested,
    ModeChosen,
    Sensed,
    SpeedChosen,
    StoreFailed,
    WeavingStep,
)
from ilmek.loom.control.opening import open_journal
from ilmek.loom.control.packml import MODE_CHANGES, PackCommand, PackMode, PackState
from ilmek.loom.control.ports import EndRow, Failed, Fault, Home, Jog, Order, SensorsChanged, Tie

PROGRAMME = small_programme(rows=5, columns=18, heads=3, yarns=3)
EVERYTHING = all_operations(PROGRAMME)
DISTURBED = (
    replace(READY, door_closed=False),
    replace(READY, emergency_stop=True),
    replace(READY, warp_tension=1.0),
    replace(READY, warp_tension=None),
    replace(READY, heads_clear=False),
    replace(READY, beater_back=False),
    replace(READY, grippers_open=(False,) * 16, heads_clear=False),
)
GOING_ON = {
    PackState.STOPPED: PackCommand.RESET,
    PackState.COMPLETE: PackCommand.RESET,
    PackState.IDLE: PackCommand.START,
    PackState.HELD: PackCommand.UNHOLD,
    PackState.SUSPENDED: PackCommand.UNSUSPEND,
    PackState.ABORTED: PackCommand.CLEAR,
}


class Crash(Exception):
    """The power fails between two effects of the controller."""


class RandomRun:
    """A carpet woven while everything happens that can."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.group = self.random.choice([1, 1, 2, 7, 40])
        self.fault_rate = self.random.choice([0, 0.02, 0.1])
        self.chaos = self.random.choice([0.02, 0.1])
        self.crashes_left = self.random.choice([0, 3, 10, 30])
        self.loom, self.store = FakeLoom(self.fails), MemoryStore()
        self.controller = self.opened()

    def fails(self, order: Order) -> Fault | None:
        if self.random.random() >= self.fault_rate or not isinstance(order, Tie | EndRow | Home):
            return None
        if isinstance(order, Home):
            return Fault.TIMEOUT
        return self.random.choice(list(Fault) if isinstance(order, Tie) else [Fault.WEFT_BREAK, Fault.TIMEOUT])

    def opened(self) -> Controller:
        journal = open_journal(self.store.read(), PROGRAMME, group=self.group, nonce=self.random.getrandbits(64))
        self.store.truncate(journal.size)
        return Controller(PROGRAMME, journal)

    def react(self, *inputs: ControlInput) -> None:
        following: Sequence[ControlInput] = inputs
        while True:
            outputs = self.controller.react(following)
            if outputs.halt:
                self.cut_off(0.3)
            self.store.append(outputs.append)
            self.perhaps_crash()
            if outputs.sync:
                self.store.sync()
            self.perhaps_crash()
            assert not set(outputs.orders) & set(self.loom.woven)
            self.loom.send(outputs.orders)
            if not outputs.questions and not outputs.halt:
                return
            truth = [(one, self.loom.truth(one)) for one in outputs.questions]
            following = [Sensed(one, None if self.random.random() < 0.3 else found) for one, found in truth]

    def cut_off(self, share: float) -> None:
        """Every motion ends; of the operations in progress some are in the carpet."""
        moving = [one for one in self.loom.moving if not isinstance(one, Jog | Home)]
        self.loom.woven += [one for one in moving if self.random.random() < share]
        self.loom.moving.clear()

    def perhaps_crash(self) -> None:
        if self.crashes_left and self.random.random() < 0.01:
            self.crashes_left -= 1
            raise Crash

    def restart(self) -> None:
        """After a crash: of what was not durable, a part is on the disc, with a hole of zeros."""
        self.cut_off(0.5)
        content, durable = self.store.read(), self.store.durable
        tail = bytearray(content[durable : self.random.randint(durable, len(content))])
        hole = self.random.randrange(len(tail) + 1)
        tail[hole : hole + 40] = bytes(len(tail[hole : hole + 40]))
        self.store = MemoryStore(content[:durable] + bytes(tail))
        self.begin()

    def begin(self) -> None:
        self.controller = self.opened()
        self.react(SensorsChanged(self.loom.now, self.loom.time))

    def disturb(self) -> None:
        pick = self.random.choice
        one = self.random.randrange(6)
        if one == 0:
            self.react(Commanded(pick(list(PackCommand))))
        elif one == 1:
            self.loom.now = pick(DISTURBED)
            self.react(SensorsChanged(self.loom.now, self.loom.time))
        elif one == 2:
            self.react(ModeChosen(pick(list(PackMode)), pick(list(WeavingStep))))
        elif one == 3:
            self.react(SpeedChosen(pick([0.3, 1.0, 2.0])))
        elif one == 4:
            self.react(JogRequested(pick(["beater", "shed", "heads", "sley"]), 0.01))
        else:
            self.react(StoreFailed(JournalFault.DISC_FULL))
            self.begin()

    def end_one(self) -> None:
        """One of the operations in progress ends, or fails."""
        moving = self.loom.moving
        moving.insert(0, moving.pop(self.random.randrange(len(moving))))
        order = moving[0]
        reports = self.loom.receive()
        last = reports[-1]
        timeout = isinstance(last, Failed) and last.fault is Fault.TIMEOUT and not isinstance(order, Home)
        if timeout and self.random.random() < 0.5:
            self.loom.woven.append(order)
        if isinstance(order, Jog):
            self.loom.woven = [one for one in self.loom.woven if not isinstance(one, Jog)]
        ready = self.loom.now is READY
        self.react(*(one for one in reports if ready or not isinstance(one, SensorsChanged)))

    def help_on(self) -> None:
        """What an operator does so that the carpet is finished."""
        status = self.controller.status()
        if self.loom.now is not READY:
            self.loom.now = READY
            self.react(SensorsChanged(READY, self.loom.time))
        elif status.requests:
            one = self.random.choice(status.requests)
            self.react(Answered(one.number, self.loom.truth(one.operation)))
        elif status.alarms:
            self.react(Acknowledged())
        elif status.mode is PackMode.MANUAL and status.state is PackState.EXECUTE:
            self.react(Commanded(PackCommand.STOP))
        elif status.mode is not PackMode.PRODUCTION and status.state in MODE_CHANGES and self.random.random() < 0.5:
            self.react(ModeChosen(PackMode.PRODUCTION))
        elif status.state in GOING_ON:
            self.react(Commanded(GOING_ON[status.state]))
        else:
            self.react()

    def weave(self) -> None:
        try:
            self.begin()
        except Crash:
            self.crash()
        for _ in range(20_000):
            status = self.controller.status()
            if status.complete and status.state is PackState.COMPLETE:
                return
            try:
                if self.random.random() < self.chaos:
                    self.disturb()
                elif self.loom.moving:
                    self.end_one()
                else:
                    self.help_on()
            except Crash:
                self.crash()
        raise AssertionError(f"the carpet is not finished: {self.controller.status()}")

    def crash(self) -> None:
        while True:
            try:
                self.restart()
                return
            except Crash:
                continue


@pytest.mark.parametrize("seed", range(40))
def test_whatever_happens_every_operation_is_in_the_carpet_once(seed: int) -> None:
    run = RandomRun(seed)
    run.weave()
    assert len(run.loom.woven) == len(EVERYTHING)
    assert set(run.loom.woven) == EVERYTHING
    assert open_journal(run.store.read(), PROGRAMME).sequence.finished
