"""The loom's controller: commands, reports and sensors in; orders, journal records, alarms and requests out.

    controller = Controller(programme, open_journal(content, programme))
    outputs = controller.react((SensorsChanged(...), Commanded(PackCommand.RESET)))

No file, socket, clock or thread: the same inputs give the same outputs. A knot's record is durable before the next knot
of its head begins; with a group commit of n knots, at most n - 1 ended knots and those in progress are not.
"""

from collections.abc import Callable, Iterable
from typing import Any

from ilmek.loom.control import doubts, watching
from ilmek.loom.control.alarms import ALARM_NUMBERS, ControlFault, JournalFault
from ilmek.loom.control.core import ASKING, ControlCore
from ilmek.loom.control.exchange import (
    Acknowledged,
    Answered,
    Commanded,
    ControlInput,
    ControllerStatus,
    ControlOutputs,
    HeadStatus,
    JogRequested,
    ModeChosen,
    Operation,
    RowsTakenOut,
    Sensed,
    SpeedChosen,
    StateChanged,
    StoreFailed,
)
from ilmek.loom.control.interlocks import WATCHED, axes_of, violated
from ilmek.loom.control.jogs import jog_refused
from ilmek.loom.control.journal import Origin, RecordKind
from ilmek.loom.control.opening import OpenedJournal
from ilmek.loom.control.packml import PackMode, PackState, Refusal, commanded, mode_refused, state_name
from ilmek.loom.control.ports import (
    ChangePackages,
    Done,
    EndRow,
    Failed,
    Fault,
    Home,
    Jog,
    Order,
    SensorsChanged,
    StandAside,
    Tie,
)
from ilmek.loom.control.sequence import LOOM, Sequence, key_of
from ilmek.loom.control.state import AXIS, MOST_UNSYNCED, USUAL_SETTINGS, ControllerSettings, Doubt, Draft
from ilmek.loom.operations import LoomProgramme

SHOWN_KNOTS = 8
"""Next knots of a head in a status."""


class Controller(ControlCore):
    """The controller of a carpet's programme. Its state is all in `state`."""

    def __init__(
        self, programme: LoomProgramme, journal: OpenedJournal, settings: ControllerSettings = USUAL_SETTINGS
    ) -> None:
        super().__init__(programme, journal, settings)
        if journal.uncertain:
            doubts.add_frontier(self.state, trusted=False)
        watching.restore(self.state, [ALARM_NUMBERS[alarm] for alarm in journal.alarms if alarm in ALARM_NUMBERS])
        self._handlers: dict[type, Callable[[Any, Draft], None]] = {
            Done: self._done,
            Failed: self._failed,
            SensorsChanged: self._sensors_changed,
            Commanded: self._commanded,
            ModeChosen: self._mode_chosen,
            JogRequested: self._jog_requested,
            SpeedChosen: self._speed_chosen,
            Acknowledged: self._acknowledged,
            Answered: self._answered,
            RowsTakenOut: self._rows_taken_out,
            Sensed: self._sensed,
            StoreFailed: self._store_failed,
        }

    def copy(self) -> "Controller":
        """The same controller, to go on by itself: of the state, nothing is shared."""
        made = Controller.__new__(Controller)
        made.__dict__.update(self.__dict__)
        made.state = self.state.copy()
        names = {kind: handler.__name__ for kind, handler in self._handlers.items()}
        made._handlers = {kind: getattr(made, name) for kind, name in names.items()}
        return made

    def react(self, inputs: Iterable[ControlInput]) -> ControlOutputs:
        """What follows from commands, answers and reports, in their order; none: what follows from what was done."""
        state, draft = self.state, Draft()
        if self._opening is not None:
            self.begin(draft)
        halted = state.halted
        for one in inputs:
            self._handlers[type(one)](one, draft)
        if halted and state.state is PackState.ABORTING:
            self.stopped_moving(draft)
        self.advance(draft)
        if self.homing:
            self.home(draft)
            self.advance(draft)
        weaves = state.state is PackState.EXECUTE and state.mode is not PackMode.MANUAL
        if weaves and self._dispatch(draft):
            self.advance(draft)
        if state.store_failed:
            draft.append.clear()
            draft.sync = False
        elif state.pending >= self.group or state.lag >= MOST_UNSYNCED:
            draft.sync = True
        if draft.sync:
            state.pending = state.lag = 0
        return draft.outputs()

    # -- orders ------------------------------------------------------------------------------------------------------

    def _dispatch(self, draft: Draft) -> bool:
        """Begin all operations that may begin. Whether the state has changed instead."""
        state = self.state
        chosen = self._chosen()
        for order in chosen:
            if isinstance(order, Tie) and state.tie_allowed and state.sensors.grippers_open[order.head]:  # type: ignore[union-attr]
                continue
            if not self._may_begin(order, draft):
                return True
        for order in chosen:
            state.progress[key_of(order)] = order
            if isinstance(order, EndRow):
                watched = {WATCHED[axis] for axis in axes_of(order) if axis in WATCHED}
                state.watch = watched & set(self.settings.watched)
        draft.orders += chosen
        return False

    def _chosen(self) -> list[Operation | StandAside]:
        """The moves aside, and the operations of the frontier that are not in progress, as far as the mode allows."""
        state = self.state
        sequence, progress = state.sequence, state.progress
        whole = sequence.of_loom()
        chosen: list[Operation] = []
        moves: list[StandAside] = []
        if whole is not None:
            if not progress:
                chosen.append(whole)
        elif not sequence.finished:
            for head in range(len(sequence.upcoming)):
                if head not in progress:
                    one, move = sequence.of_head(head), sequence.stand_aside(head)
                    if one is not None:
                        chosen.append(one)
                    elif move is not None:
                        moves.append(move)
        if state.allowance is not None and chosen:
            chosen = chosen[: state.allowance]
            state.allowance -= len(chosen)
        return [*moves, *chosen]

    def _may_begin(self, order: Operation | StandAside, draft: Draft) -> bool:
        state = self.state
        head = order.head if isinstance(order, Tie | StandAside) else None
        if state.sensors is None:
            self.raise_alarm(ControlFault.NO_SENSORS, draft)
            return False
        broken = violated(axes_of(order), state.sensors, self.tension, head)
        for rule in broken:
            self.raise_alarm(rule.name, draft, head=head)
        return not broken

    # -- reports -----------------------------------------------------------------------------------------------------

    def _at(self, time: int, draft: Draft) -> None:
        if time < self.state.time:
            self.raise_alarm(ControlFault.CLOCK_BACKWARDS, draft)
        else:
            self.state.time = time

    def _done(self, report: Done, draft: Draft) -> None:
        self._at(report.time, draft)
        state, order = self.state, report.order
        key = AXIS if isinstance(order, Jog | Home) else key_of(order)
        if state.progress.get(key) != order:
            if self._doubted(key, order):
                self._resolve(key, found=True, origin=Origin.REPORT, draft=draft)
            else:
                self.raise_alarm(ControlFault.UNEXPECTED, draft, note=repr(order))
            return
        del state.progress[key]
        if isinstance(order, Home):
            self.homed(order, draft)
        if isinstance(order, StandAside):
            state.sequence.stood(order)
        if isinstance(order, StandAside | Jog | Home):
            return
        self.completed(order, Origin.REPORT, draft)
        if isinstance(order, EndRow) and state.watch:
            self.raise_alarm(ControlFault.STUCK, draft, note=", ".join(sorted(state.watch)))
            state.watch = set()

    def _doubted(self, key: int, order: Order) -> bool:
        """Whether an order is of an uncertain operation; a question to the operator about it is withdrawn."""
        doubt = self.state.doubts.get(key)
        if doubt is None or doubt.operation != order:
            return False
        self.state.requests.pop(doubt.request or 0, None)
        return True

    def _failed(self, report: Failed, draft: Draft) -> None:
        self._at(report.time, draft)
        state, order = self.state, report.order
        key = AXIS if isinstance(order, Jog | Home) else key_of(order)
        if state.progress.get(key) == order:
            del state.progress[key]
        elif self._doubted(key, order):
            del state.doubts[key]
        else:
            self.raise_alarm(ControlFault.UNEXPECTED, draft, note=repr(order))
            return
        state.faults += 1
        if isinstance(order, Home):
            self.raise_alarm(ControlFault.NOT_HOME, draft, note=f"{order.axis}: {report.fault}")
            return
        if state.allowance is not None and not isinstance(order, StandAside):
            state.allowance += 1
        if report.fault is Fault.MISSED_GRIP and key not in state.retried:
            state.retried.add(key)
            state.retries += 1
            return
        if not isinstance(order, StandAside | Jog):
            state.doubts[key] = Doubt(order, onward=False)
        state.retried.discard(key)
        head = order.head if isinstance(order, Tie | StandAside) else None
        self.raise_alarm(report.fault, draft, head=head)

    def _sensors_changed(self, report: SensorsChanged, draft: Draft) -> None:
        self._at(report.time, draft)
        state = self.state
        for name, note in watching.compared(state, report.sensors, self.tension, draft):
            self.raise_alarm(name, draft, note=note)
        if state.state is PackState.SUSPENDED and state.suspended_by_alarm and not watching.suspending(state):
            self.enter(PackState.UNSUSPENDING, draft)

    # -- commands ----------------------------------------------------------------------------------------------------

    def _commanded(self, given: Commanded, draft: Draft) -> None:
        state = self.state
        following = commanded(state.mode, state.state, given.command)
        if not isinstance(following, Refusal):
            refused = watching.refused(state, given.command)
            following = following if refused is None else refused
        if isinstance(following, Refusal):
            draft.refusals.append(following)
        else:
            self.enter(following, draft)
            self.advance(draft)

    def _mode_chosen(self, given: ModeChosen, draft: Draft) -> None:
        refused = mode_refused(given.mode, self.state.state)
        if refused is not None:
            draft.refusals.append(refused)
            return
        if (given.mode, given.step) == (self.state.mode, self.state.step):
            return
        self.state.mode, self.state.step = given.mode, given.step
        self.record_state(draft)
        draft.events.append(StateChanged(self.state.state, given.mode, self.state.time))

    def _jog_requested(self, given: JogRequested, draft: Draft) -> None:
        refused = jog_refused(self.state, given, self.tension)
        if refused is not None:
            draft.refusals.append(refused)
            return
        jog = Jog(given.axis, given.distance)
        self.state.progress[AXIS] = jog
        draft.orders.append(jog)

    def _speed_chosen(self, given: SpeedChosen, draft: Draft) -> None:
        settings = self.settings
        if not settings.least_speed <= given.factor <= settings.most_speed:
            allowed = f"{settings.least_speed:g} to {settings.most_speed:g} times the programme's"
            draft.refusals.append(Refusal(f"a speed of {given.factor:g}", allowed))
            return
        state = self.state
        if given.factor == state.speed:
            return
        state.speed = draft.speed = given.factor
        draft.record(state, RecordKind.SPEED, 0, state.sequence.row, 0, 0, round(1000 * given.factor))

    def _acknowledged(self, given: Acknowledged, draft: Draft) -> None:
        watching.acknowledge(self.state, given.number, draft)

    def _answered(self, given: Answered, draft: Draft) -> None:
        state = self.state
        request = state.requests.pop(given.request, None)
        if request is None:
            open_ones = ", ".join(map(str, state.requests)) or "none"
            draft.refusals.append(Refusal(f"an answer to request {given.request}", f"open requests are: {open_ones}"))
            return
        operation = request.operation
        head, item = (operation.head, operation.number) if isinstance(operation, Tie) else (0, 0)
        draft.record(state, RecordKind.ANSWER, int(given.yes), state.sequence.row, head, 0, item)
        draft.sync = True
        self._resolve(key_of(operation), found=given.yes, origin=Origin.OPERATOR, draft=draft)

    def _rows_taken_out(self, given: RowsTakenOut, draft: Draft) -> None:
        """In state Stopped; what was uncertain is taken out as well. The sensor then looks whether the rows are out."""
        state, sequence = self.state, self.state.sequence
        name = f"{given.rows} rows back in row {sequence.row + 1}"
        if state.state is not PackState.STOPPED:
            draft.refusals.append(Refusal(f"{name}, state {state_name(state.state)}", "allowed in Stopped"))
        elif not 0 <= given.rows <= sequence.most_back:
            draft.refusals.append(Refusal(name, rows_back_range(sequence)))
        else:
            sequence.take_out(given.rows)
            state.doubts.clear()
            state.requests.clear()
            state.retried.clear()
            state.verified = False
            draft.record(state, RecordKind.ROWS_BACK, 0, sequence.row, 0, 0, given.rows)
            self.record_state(draft)

    def _sensed(self, given: Sensed, draft: Draft) -> None:
        key = key_of(given.operation)
        doubt = self.state.doubts.get(key)
        if doubt is None or not doubt.sensor or doubt.operation != given.operation:
            return  # the doubt has been resolved, or withdrawn, meanwhile
        if given.found is None and not doubt.trusted:
            doubts.ask_operator(self.state, key, draft)
        else:
            self._resolve(key, found=bool(given.found), origin=Origin.SENSOR, draft=draft)

    def _resolve(self, key: int, *, found: bool, origin: Origin, draft: Draft) -> None:
        """An uncertain operation is certain: if it is in the carpet, the next one of the head may be as well."""
        state, sequence = self.state, self.state.sequence
        doubt = state.doubts.pop(key)
        if not found:
            return
        if doubt.trusted:
            self.raise_alarm(JournalFault.BEHIND, draft, head=key if key >= 0 else None)
        waited = self.completed(doubt.operation, origin, draft)
        if doubt.onward and waited:
            doubts.add_frontier(state, trusted=False)
        elif doubt.onward:
            following = sequence.of_head(key)
            if following is not None:
                state.doubts[key] = Doubt(following, onward=True)
        if doubt.onward and state.state in ASKING:
            doubts.ask_all(state, draft)

    def _store_failed(self, given: StoreFailed, draft: Draft) -> None:
        self.state.store_failed = True
        draft.append.clear()
        self.raise_alarm(given.fault, draft, note=given.note)

    # -- views -------------------------------------------------------------------------------------------------------

    def status(self) -> ControllerStatus:
        """The controller as views show it."""
        state, sequence = self.state, self.state.sequence
        whole = state.progress.get(LOOM)
        return ControllerStatus(
            state=state.state,
            mode=state.mode,
            step=state.step,
            row=sequence.row,
            phase=sequence.phase,
            knots=sequence.knots,
            uncertain=sum(not doubt.trusted for doubt in state.doubts.values()),
            retries=state.retries,
            faults=state.faults,
            speed=state.speed,
            time=state.time,
            heads=tuple(
                HeadStatus(
                    sequence.upcoming_of(head, SHOWN_KNOTS),
                    sequence.upcoming[head],
                    isinstance(state.progress.get(head), Tie),
                )
                for head in range(len(sequence.upcoming))
            ),
            operation=whole if isinstance(whole, EndRow | ChangePackages) else None,
            alarms=tuple(state.alarms.values()),
            requests=tuple(state.requests.values()),
            complete=sequence.finished,
        )


def rows_back_range(sequence: Sequence) -> str:
    """How many whole rows may be taken out, in words."""
    if sequence.most_back < 0:
        return "none: the packages were changed within the row in work"
    return f"0 (the row in work alone) to {sequence.most_back}"
