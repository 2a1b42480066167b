"""The core of a controller: its states, what is in the carpet, and the reactions to alarms."""

from typing import Any

from ilmek.loom.control import doubts, watching
from ilmek.loom.control.alarms import ControlFault
from ilmek.loom.control.exchange import Operation, StateChanged, WeavingStep
from ilmek.loom.control.homing import HOMED, at_home, next_axis
from ilmek.loom.control.interlocks import Interlock, LoomAxis, Reaction, usual_limits
from ilmek.loom.control.journal import Origin, RecordKind
from ilmek.loom.control.opening import OpenedJournal
from ilmek.loom.control.packml import COMPLETED, MODE_STATES, PackCommand, PackMode, PackState, commanded
from ilmek.loom.control.ports import EndRow, Home, Jog, StandAside, Tie
from ilmek.loom.control.state import AXIS, ControllerSettings, Doubt, Draft, state_of
from ilmek.loom.operations import LoomProgramme

ASKING = frozenset((PackState.RESETTING, PackState.UNHOLDING, PackState.UNSUSPENDING))
"""States in which sensor and operator are queried about uncertain operations; they end when none is left."""

ENDING = frozenset((PackState.HOLDING, PackState.SUSPENDING, PackState.STOPPING, PackState.COMPLETING))
"""States that end with the operations in progress."""

REACTION_COMMANDS = {
    Reaction.SUSPEND: PackCommand.SUSPEND,
    Reaction.HOLD: PackCommand.HOLD,
    Reaction.STOP: PackCommand.STOP,
    Reaction.ABORT: PackCommand.ABORT,
}
"""The command of a reaction. Where a state refuses it, nothing is to be ended; manual mode serves to free the loom."""


class ControlCore:
    """The states of a controller. What changes is all in `state`."""

    def __init__(self, programme: LoomProgramme, journal: OpenedJournal, settings: ControllerSettings) -> None:
        self.programme, self.settings, self.group = programme, settings, journal.group
        self.tension = settings.tension or usual_limits(programme.setup.warp_pitch)
        self.state = state_of(journal)
        self._opening: bytes | None = journal.begin
        self._openings = journal.openings

    def begin(self, draft: Draft) -> None:
        """Begin to write the journal: the header of a new one, and a START. What moves from before is halted."""
        draft.halt = True
        draft.append.append(self._opening or b"")
        self._opening = None
        draft.record(self.state, RecordKind.START, 0, self.state.sequence.row, 0, 0, self._openings)
        if self.state.speed != 1.0:
            draft.speed = self.state.speed
        self.record_state(draft)

    def record_state(self, draft: Draft) -> None:
        """Record state and mode, durably, and whether operations may be in progress from here on."""
        state = self.state
        weaves = state.state is PackState.EXECUTE and state.mode is not PackMode.MANUAL
        unsure = any(not doubt.trusted for doubt in state.doubts.values())
        moving = weaves or unsure or any(key != AXIS for key in state.progress)
        draft.record(state, RecordKind.STATE, state.state, state.sequence.row, state.mode, int(moving), 0)
        draft.sync = True

    def enter(self, following: PackState, draft: Draft) -> None:
        """Enter a state: begin its action, and record it durably."""
        state = self.state
        if state.state in ASKING:
            doubts.withdraw(state)
        state.state = following
        if following is PackState.ABORTING:
            draft.halt, state.halted = True, True
            draft.orders.clear()
        elif following is PackState.RESETTING and not state.verified:
            state.verified = True
            doubts.add_frontier(state, trusted=True)
        elif following is PackState.STARTING:
            state.goal = state.sequence.row + 1
            single = state.mode is PackMode.MAINTENANCE and state.step is WeavingStep.KNOT
            state.allowance = 1 if single else None
        elif following is PackState.SUSPENDING:
            state.suspended_by_alarm = False
        if following in ASKING and not self.homing:
            doubts.ask_all(state, draft)
        self.record_state(draft)
        draft.events.append(StateChanged(following, state.mode, state.time))

    def advance(self, draft: Draft) -> None:
        """Leave every acting state whose action is complete."""
        while self._complete():
            self.enter(COMPLETED[self.state.state], draft)

    def _complete(self) -> bool:
        state = self.state
        now = state.state
        if now is PackState.EXECUTE:
            return state.mode is not PackMode.MANUAL and not state.progress and self._goal_reached()
        if now in ASKING:
            return not state.doubts and not self.homing
        if now in ENDING:
            return not state.progress
        return now in {PackState.CLEARING, PackState.STARTING}

    @property
    def homing(self) -> bool:
        """Whether axes are to be homed before anything else."""
        state = self.state
        waits = state.state is PackState.RESETTING and state.mode is not PackMode.MANUAL
        return waits and len(state.homed) < len(HOMED)

    def home(self, draft: Draft) -> None:
        """Begin to home the next axis; where none may move, homing ends with an alarm."""
        state = self.state
        if state.progress:
            return
        if state.sensors is None:
            self.raise_alarm(ControlFault.NO_SENSORS, draft)
            return
        following = next_axis(state.homed, state.sensors, self.tension)
        if isinstance(following, Interlock):
            self.raise_alarm(ControlFault.NOT_HOME, draft, note=following.name)
        elif following is not None:
            state.progress[AXIS] = Home(following.value)
            draft.orders.append(Home(following.value))

    def homed(self, order: Home, draft: Draft) -> None:
        """A drive has homed its axis: true if the axis is at its switch. Behind the last one, doubts are resolved."""
        state, axis = self.state, LoomAxis(order.axis)
        if state.sensors is None or not at_home(axis, state.sensors):
            self.raise_alarm(ControlFault.NOT_HOME, draft, note=order.axis)
            return
        state.homed.add(axis)
        draft.record(state, RecordKind.HOMED, list(LoomAxis).index(axis), state.sequence.row, 0, 0, 0)
        if state.state is PackState.RESETTING and not self.homing:
            doubts.ask_all(state, draft)

    def _goal_reached(self) -> bool:
        state = self.state
        if state.sequence.finished:
            return True
        if state.mode is not PackMode.MAINTENANCE:
            return False
        return state.allowance == 0 or state.sequence.row >= state.goal

    def stopped_moving(self, draft: Draft) -> None:
        """What was in progress when the loom was halted, and has not been reported since, is uncertain."""
        state = self.state
        for key, order in state.progress.items():
            if not isinstance(order, StandAside | Jog | Home):
                state.doubts[key] = Doubt(order, onward=False)
        state.progress.clear()
        state.halted = False
        self.enter(PackState.ABORTED, draft)

    def _apply(self, reaction: Reaction, draft: Draft) -> None:
        """The machine's reaction to an alarm; a mode that cannot be suspended holds."""
        state = self.state
        if reaction is Reaction.SUSPEND and PackState.SUSPENDED not in MODE_STATES[state.mode]:
            reaction = Reaction.HOLD
        command = REACTION_COMMANDS.get(reaction)
        following = None if command is None else commanded(state.mode, state.state, command)
        if isinstance(following, PackState):
            self.enter(following, draft)
            state.suspended_by_alarm = command is PackCommand.SUSPEND

    def raise_alarm(self, name: str, draft: Draft, **location: Any) -> None:
        """Raise an alarm, if it is not active yet, and react to its cause."""
        kind = watching.raised(self.state, draft, name, **location)
        self._apply(kind.reaction, draft)

    def completed(self, order: Operation, origin: Origin, draft: Draft) -> bool:
        """An operation is in the carpet: record it, and move on. Whether all heads have waited, or now do, for it."""
        state = self.state
        if isinstance(order, Tie):
            draft.record(state, RecordKind.KNOT, order.tube, order.row, order.head, origin, order.number)
            state.retried.discard(order.head)
        elif isinstance(order, EndRow):
            draft.record(state, RecordKind.ROW_END, order.operation, order.row, 0, origin, 0)
        else:
            draft.record(state, RecordKind.CHANGE, 0, order.stop.row, 0, origin, state.sequence.stops_done)
        state.pending += 1
        if state.allowance and origin is not Origin.REPORT:
            state.allowance -= 1
        waited = state.sequence.done(order)
        if waited:
            draft.sync = True
        return waited
