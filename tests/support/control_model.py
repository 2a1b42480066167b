"""Every run of a controller over a small carpet: completions in any order, crashes, commands, faults, answers.

A world is a controller, a loom and a journal on a disc. From each world all that can happen next is tried; worlds that
cannot be distinguished are one. What must be true: no operation is ordered that is in the carpet or in progress; with a
group commit of n knots, at most n - 1 operations and one for each head are in the carpet, or in progress, and not
durable; and from every world the carpet can be finished, with every operation once.

A crash may come between any two effects of the controller. Every operation in progress is then in the carpet or not,
and of what was not synchronised any number of records is in the journal. (That a torn record, and all behind a missing
one, are cut off is tested on the bytes in test_journal.py.)
"""

from collections.abc import Iterable, Iterator
from dataclasses import astuple, dataclass, replace

import numpy as np
from fake_loom import READY, all_operations
from small_programme import small_programme

from ilmek.loom.control.controller import Controller
from ilmek.loom.control.exchange import Acknowledged, Answered, Commanded, ControlInput, Sensed
from ilmek.loom.control.journal import HEADER_BYTES, RECORD_BYTES, RecordKind
from ilmek.loom.control.opening import open_journal
from ilmek.loom.control.packml import PackCommand, PackState, allowed_commands
from ilmek.loom.control.ports import (
    ChangePackages,
    Done,
    EndRow,
    Failed,
    Fault,
    Home,
    Order,
    Sensors,
    SensorsChanged,
    StandAside,
    Tie,
)
from ilmek.loom.control.state import ControllerSettings
from ilmek.loom.operations import LoomSetup, RowEnd, RowOperations, Stop, TubeChange

SETTINGS = ControllerSettings(watched=())
GOING_ON = {
    PackState.STOPPED: PackCommand.RESET,
    PackState.IDLE: PackCommand.START,
    PackState.HELD: PackCommand.UNHOLD,
    PackState.SUSPENDED: PackCommand.UNSUSPEND,
    PackState.ABORTED: PackCommand.CLEAR,
}
"""What an operator commands so that the loom weaves on."""


class TinyProgramme:
    """Two heads: a row of two knots and one, then a stop, a knot each, another stop, and a phase of one head.

    ends  operations after the knots: two are enough for every case of their order
    """

    digest = "5a" * 32

    def __init__(self, rows: int = 2, ends: tuple[RowEnd, ...] = (RowEnd.STRAIGHT_WEFT, RowEnd.TAKE_UP)) -> None:
        self.setup: LoomSetup = replace(small_programme(6, 24, 2, 2).setup, rows=rows, columns=3)
        self.ends = ends

    def operations(self, number: int) -> RowOperations:
        columns, tubes = np.array([0, 1, 2], np.int32), np.array([0, 1, 0], np.uint8)
        if number % 2 == 0:
            return RowOperations(number, columns, tubes, np.array([[2], [1]]), self.ends)
        stops = (Stop(number, 0, wefts=(0,)), Stop(number, 1, tubes=(TubeChange(0, 1, 0, 5.0),)))
        return RowOperations(number, columns, tubes, np.array([[1, 0], [1, 1]]), self.ends, stops)

    def chart_row(self, number: int) -> np.ndarray:  # noqa: ARG002
        return np.zeros(3, np.uint8)


FAULTS: dict[type, tuple[Fault, ...]] = {
    Tie: (Fault.MISSED_GRIP, Fault.PILE_BREAK, Fault.TIMEOUT),
    EndRow: (Fault.WEFT_BREAK, Fault.TIMEOUT),
    ChangePackages: (),
}
DISTURBED = (replace(READY, door_closed=False), replace(READY, warp_tension=0.5), replace(READY, heads_clear=False))


def repr_of(order: Order) -> tuple[object, ...]:
    """A fixed order of operations."""
    return (type(order).__name__, *(str(value) for value in astuple(order)))


@dataclass(frozen=True, slots=True)
class Budget:
    """How often something may still happen that is not needed to finish the carpet."""

    crashes: int = 1
    commands: int = 0
    faults: int = 0
    sensors: int = 0
    unknown: int = 1


@dataclass(frozen=True, slots=True)
class Disc:
    """A journal on a disc: its bytes, how many are durable, what these mean to the next controller.

    operations  that are durable
    """

    content: bytes = b""
    durable: int = 0
    meaning: tuple[object, ...] = ()
    operations: int = 0

    def tail(self) -> tuple[bytes, ...]:
        """What each record states that is not durable: all but its number, lag, time and CRC."""
        begin = max(self.durable, HEADER_BYTES)
        return tuple(self.content[at + 6 : at + 20] for at in range(begin, len(self.content), RECORD_BYTES))

    def cuts(self) -> list[int]:
        """Lengths that the journal may have after a crash."""
        begin = max(self.durable, HEADER_BYTES)
        records = range(begin, len(self.content) + 1, RECORD_BYTES)
        return list(records) if self.durable else [0, *records]


def new_ones(disc: Disc) -> int:
    """Operations that are recorded and not durable."""
    return sum(one[0] in {RecordKind.KNOT, RecordKind.ROW_END, RecordKind.CHANGE} for one in disc.tail())


@dataclass(slots=True)
class World:
    """A controller, what moves and what is in the carpet (as bits), the journal, open questions to the sensor."""

    controller: Controller
    moving: int
    woven: int
    disc: Disc
    questions: tuple[Tie | EndRow, ...]
    sensors: Sensors
    budget: Budget


class Model:
    """All worlds of a programme within a budget. Raises AssertionError where something is tied twice or gets stuck."""

    def __init__(self, programme: TinyProgramme, budget: Budget, group: int = 1) -> None:
        self.programme, self.group = programme, group
        self.orders = sorted(all_operations(programme), key=repr_of)
        self.bits = {order: 1 << index for index, order in enumerate(self.orders)}
        self.everything = (1 << len(self.orders)) - 1
        self.numbers: dict[object, int] = {}
        self.before: list[list[int]] = []
        self.finished: list[int] = []
        self.pending: list[tuple[int, World]] = []
        self.crashed: dict[object, list[World]] = {}
        self.crashes = self.steps = 0
        self.start = budget

    # -- exploring ---------------------------------------------------------------------------------------------------

    def explore(self) -> int:
        """Try everything; the number of worlds."""
        for world in self.restarted(Disc(), 0, self.start):
            self.enter(world, None)
        while self.pending:
            number, world = self.pending.pop()
            state = world.controller.state
            if state.state is PackState.COMPLETE and state.sequence.finished and not world.budget.crashes:
                continue
            for following in self.following(world):
                self.enter(following, number)
        self.every_world_can_finish()
        return len(self.numbers)

    def enter(self, world: World, origin: int | None) -> None:
        key = self.key(world)
        number = self.numbers.get(key)
        self.steps += 1
        if number is None:
            number = self.numbers[key] = len(self.before)
            self.before.append([])
            self.pending.append((number, world))
            state = world.controller.state
            if state.state is PackState.COMPLETE and state.sequence.finished:
                assert world.woven == self.everything
                self.finished.append(number)
        if origin is not None:
            self.before[number].append(origin)

    def every_world_can_finish(self) -> None:
        """Go back from the finished worlds: all must be met."""
        met, pending = set(self.finished), list(self.finished)
        while pending:
            for number in self.before[pending.pop()]:
                if number not in met:
                    met.add(number)
                    pending.append(number)
        stuck = set(range(len(self.before))) - met
        assert not stuck, next(key for key, number in self.numbers.items() if number in stuck)

    def key(self, world: World) -> tuple[object, ...]:
        """Equal for worlds that cannot be distinguished."""
        state = world.controller.state
        return (
            state.state, state.sequence.position(), self.mask(state.progress.values()),
            tuple((key, one.operation, one.onward, one.trusted, one.sensor, one.request is None)
                  for key, one in sorted(state.doubts.items())) if state.doubts else (),
            tuple(state.retried), tuple((name, one.present, one.acknowledged) for name, one in state.alarms.items()),
            len(state.requests),
            state.halted, state.verified, state.suspended_by_alarm, state.pending,
            world.moving, world.woven, len(world.questions), world.sensors is READY, world.budget,
            world.disc.meaning, world.disc.tail(),
        )  # fmt: skip

    def mask(self, orders: Iterable[Order]) -> int:
        return sum(self.bits[one] for one in orders)

    def members(self, mask: int) -> list[Order]:
        return [one for one in self.orders if self.bits[one] & mask]

    # -- what can happen ---------------------------------------------------------------------------------------------

    def following(self, world: World) -> Iterator[World]:
        state = world.controller.state
        if state.halted:
            yield from self.reacted(world, ())
            return
        yield from self.endings(world)
        yield from self.answers(world)
        yield from self.operator(world)
        if world.budget.crashes:
            yield from self.crashing(world.disc, world.moving, world.woven, world.budget)

    def endings(self, world: World) -> Iterator[World]:
        """Each operation in progress ends, or fails; but after a missed grip it may have got into the carpet."""
        for order in self.members(world.moving):
            bit = self.bits[order]
            ended = replace(world, moving=world.moving & ~bit)
            yield from self.reacted(replace(ended, woven=world.woven | bit), (Done(order, 0),))
            if world.budget.faults:
                left = replace(world.budget, faults=world.budget.faults - 1)
                for fault in FAULTS[type(order)]:
                    yield from self.reacted(replace(ended, budget=left), (Failed(order, fault, 0),))
                    if fault is not Fault.MISSED_GRIP:
                        lying = replace(ended, budget=left, woven=world.woven | bit)
                        yield from self.reacted(lying, (Failed(order, fault, 0),))

    def answers(self, world: World) -> Iterator[World]:
        """The sensor, then the operator, tells the truth; the sensor may not know."""
        if world.questions:
            asked, rest = world.questions[0], world.questions[1:]
            known = replace(world, questions=rest)
            yield from self.reacted(known, (Sensed(asked, bool(world.woven & self.bits[asked])),))
            if world.budget.unknown:
                left = replace(world.budget, unknown=world.budget.unknown - 1)
                yield from self.reacted(replace(known, budget=left), (Sensed(asked, None),))
        for number, request in world.controller.state.requests.items():
            truth = bool(world.woven & self.bits[request.operation])
            yield from self.reacted(world, (Answered(number, truth),))

    def operator(self, world: World) -> Iterator[World]:
        """The operator helps the loom on, or disturbs it."""
        state, budget = world.controller.state, world.budget
        if state.alarms:
            yield from self.reacted(world, (Acknowledged(),))
        helping = GOING_ON.get(state.state)
        if state.state is PackState.COMPLETE and not state.sequence.finished:
            helping = PackCommand.RESET
        if helping is not None:
            yield from self.reacted(world, (Commanded(helping),))
        if world.sensors is not READY:
            yield from self.reacted(replace(world, sensors=READY), (SensorsChanged(READY, 0),))
        elif budget.sensors:
            left = replace(budget, sensors=budget.sensors - 1)
            for sensors in DISTURBED:
                changed = replace(world, sensors=sensors, budget=left)
                yield from self.reacted(changed, (SensorsChanged(sensors, 0),))
        if budget.commands:
            left = replace(budget, commands=budget.commands - 1)
            for command in allowed_commands(state.mode, state.state):
                if command is not helping:
                    yield from self.reacted(replace(world, budget=left), (Commanded(command),))

    # -- the controller and its crashes ------------------------------------------------------------------------------

    def reacted(self, world: World, inputs: tuple[ControlInput, ...]) -> Iterator[World]:
        """The worlds after a reaction: carried out whole, or cut off by a crash before the journal is durable."""
        controller = world.controller.copy()
        outputs = controller.react(inputs)
        moving, halted = world.moving, 0
        if outputs.halt:
            moving, halted = 0, world.moving
        disc = replace(world.disc, content=world.disc.content + outputs.append)
        if outputs.sync:
            if world.budget.crashes:
                yield from self.crashing(disc, world.moving, world.woven, world.budget)
            disc = Disc(
                disc.content, len(disc.content), self.meaning(controller, disc), disc.operations + new_ones(disc)
            )
        moves = tuple(Done(order, 0) for order in outputs.orders if isinstance(order, Home | StandAside))
        for order in (order for order in outputs.orders if not isinstance(order, Home | StandAside)):
            bit = self.bits[order]
            assert not (world.woven | halted) & bit, f"{order!r} is ordered, and may be in the carpet"
            assert not moving & bit, f"{order!r} is in progress"
            assert isinstance(order, Tie) or not moving, f"{order!r} begins while heads tie"
            moving |= bit
        uncertain = (world.woven | moving | halted).bit_count() - disc.operations
        assert uncertain < self.group + self.programme.setup.heads, f"{uncertain} operations are not durable"
        questions = outputs.questions if outputs.halt else (*world.questions, *outputs.questions)
        for cut_off in self.subsets(halted):
            after = World(controller, moving, world.woven | cut_off, disc, questions, world.sensors, world.budget)
            if moves:  # axes at their switches, heads aside: nothing gets into the carpet by these
                yield from self.reacted(after, moves)
            else:
                yield after

    def crashing(self, disc: Disc, moving: int, woven: int, budget: Budget) -> Iterator[World]:
        left = replace(budget, crashes=budget.crashes - 1)
        tail, cuts = disc.tail(), disc.cuts()
        for ended in self.subsets(moving):
            for cut in cuts:
                kept = tail[: (cut - max(disc.durable, HEADER_BYTES)) // RECORD_BYTES] if cut else None
                key = (disc.meaning, kept, woven | ended, left)
                if key not in self.crashed:
                    self.crashes += 1
                    self.crashed[key] = list(self.restarted(Disc(disc.content[:cut]), woven | ended, left))
                yield from self.crashed[key]

    def restarted(self, disc: Disc, woven: int, budget: Budget) -> Iterator[World]:
        journal = open_journal(disc.content, self.programme, group=self.group, nonce=1)
        meaning = (journal.sequence.position(), journal.uncertain)
        whole = Disc(disc.content[: journal.size])
        disc = Disc(whole.content, journal.size, meaning, new_ones(whole))
        controller = Controller(self.programme, journal, SETTINGS)
        world = World(controller, 0, woven, disc, (), READY, budget)
        yield from self.reacted(world, (SensorsChanged(READY, 0),))

    def meaning(self, controller: Controller, disc: Disc) -> tuple[object, ...]:
        states = [record for record in disc.tail() if record[0] == RecordKind.STATE]
        uncertain = bool(states[-1][8]) if states else disc.meaning[1]
        return (controller.state.sequence.position(), uncertain)

    def subsets(self, mask: int) -> Iterator[int]:
        found = mask
        while True:
            yield found
            if not found:
                return
            found = (found - 1) & mask
