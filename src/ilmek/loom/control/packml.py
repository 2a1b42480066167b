"""The state model of a machine by ISA-TR88.00.02 (PackML): states, commands, modes, transitions, tags.

A command moves the machine from a state where it waits or produces to a state where it acts; when the action is over,
"state complete" moves it on. Everything is a table:

    TRANSITIONS[state, command] -> state          COMPLETED[acting state] -> state

Numbers of states, commands and modes are those of PackTags. Sources: ISA-TR88.00.02-2022; OPC 30050 "PackML", whose
transitions StartingToHolding, SuspendedToHolding, ... this table has too.
"""

from collections.abc import Mapping
from enum import IntEnum
from types import MappingProxyType

from ilmek.errors import joined_message
from ilmek.records import value_record


class PackState(IntEnum):
    """A state of the machine: `Status.StateCurrent`."""

    CLEARING = 1
    STOPPED = 2
    STARTING = 3
    IDLE = 4
    SUSPENDED = 5
    EXECUTE = 6
    STOPPING = 7
    ABORTING = 8
    ABORTED = 9
    HOLDING = 10
    HELD = 11
    UNHOLDING = 12
    SUSPENDING = 13
    UNSUSPENDING = 14
    RESETTING = 15
    COMPLETING = 16
    COMPLETE = 17


class PackCommand(IntEnum):
    """A command to the machine: `Command.CntrlCmd`."""

    RESET = 1
    START = 2
    STOP = 3
    HOLD = 4
    UNHOLD = 5
    SUSPEND = 6
    UNSUSPEND = 7
    ABORT = 8
    CLEAR = 9
    COMPLETE = 10


class PackMode(IntEnum):
    """A mode of the machine, `Status.UnitModeCurrent`: weave the carpet, one row or knot, move one axis."""

    PRODUCTION = 1
    MAINTENANCE = 2
    MANUAL = 3


_S, _C = PackState, PackCommand

COMPLETED: Mapping[PackState, PackState] = MappingProxyType(
    {
        _S.CLEARING: _S.STOPPED,
        _S.STARTING: _S.EXECUTE,
        _S.EXECUTE: _S.COMPLETING,
        _S.STOPPING: _S.STOPPED,
        _S.ABORTING: _S.ABORTED,
        _S.HOLDING: _S.HELD,
        _S.UNHOLDING: _S.EXECUTE,
        _S.SUSPENDING: _S.SUSPENDED,
        _S.UNSUSPENDING: _S.EXECUTE,
        _S.RESETTING: _S.IDLE,
        _S.COMPLETING: _S.COMPLETE,
    }
)
"""The state that follows an acting state, and Execute, when its action is complete."""

ABORTED_STATES = frozenset((_S.ABORTING, _S.ABORTED, _S.CLEARING))
STOPPED_STATES = frozenset((_S.STOPPING, _S.STOPPED))
HOLD_FROM = (_S.STARTING, _S.EXECUTE, _S.UNHOLDING, _S.SUSPENDING, _S.SUSPENDED, _S.UNSUSPENDING)

TRANSITIONS: Mapping[tuple[PackState, PackCommand], PackState] = MappingProxyType(
    {
        (_S.STOPPED, _C.RESET): _S.RESETTING,
        (_S.COMPLETE, _C.RESET): _S.RESETTING,
        (_S.IDLE, _C.START): _S.STARTING,
        (_S.HELD, _C.UNHOLD): _S.UNHOLDING,
        (_S.EXECUTE, _C.SUSPEND): _S.SUSPENDING,
        (_S.SUSPENDED, _C.UNSUSPEND): _S.UNSUSPENDING,
        (_S.EXECUTE, _C.COMPLETE): _S.COMPLETING,
        (_S.ABORTED, _C.CLEAR): _S.CLEARING,
        **{(state, _C.HOLD): _S.HOLDING for state in HOLD_FROM},
        **{(state, _C.STOP): _S.STOPPING for state in _S if state not in ABORTED_STATES | STOPPED_STATES},
        **{(state, _C.ABORT): _S.ABORTING for state in _S if state not in (_S.ABORTING, _S.ABORTED)},
    }
)
"""The state that a command leads to. What is not in the table is refused."""

_SUSPENSION = frozenset((_S.SUSPENDING, _S.SUSPENDED, _S.UNSUSPENDING))
_BY_HAND = frozenset(
    (_S.CLEARING, _S.STOPPED, _S.STARTING, _S.IDLE, _S.EXECUTE, _S.STOPPING, _S.ABORTING, _S.ABORTED, _S.RESETTING)
)

MODE_STATES: Mapping[PackMode, frozenset[PackState]] = MappingProxyType(
    {PackMode.PRODUCTION: frozenset(_S), PackMode.MAINTENANCE: frozenset(_S) - _SUSPENSION, PackMode.MANUAL: _BY_HAND}
)
"""The states that a mode has: there is nothing to suspend in a single step, nor to hold or complete in manual mode."""

MODE_CHANGES = frozenset((_S.STOPPED, _S.IDLE, _S.ABORTED))
"""The states in which the mode may be changed: those that every mode has and in which nothing moves."""


@value_record
class Refusal:
    """A command or request that is refused: what was given, what is allowed, what to do."""

    given: str
    allowed: str
    do: str = ""

    @property
    def text(self) -> str:
        """The refusal in one line."""
        return joined_message(self.given, self.allowed, self.do)


def state_name(state: PackState) -> str:
    """A state as the standard writes it.

    >>> state_name(PackState.UNHOLDING)
    'Unholding'
    """
    return state.name.capitalize()


def allowed_commands(mode: PackMode, state: PackState) -> tuple[PackCommand, ...]:
    """The commands that a state accepts in a mode, in the order of their numbers."""
    states = MODE_STATES[mode]
    return tuple(one for one in PackCommand if TRANSITIONS.get((state, one)) in states)


def commanded(mode: PackMode, state: PackState, command: PackCommand) -> PackState | Refusal:
    """The state that a command leads to, or why it is refused.

    >>> commanded(PackMode.PRODUCTION, PackState.HELD, PackCommand.START).text
    'Start in state Held; allowed are Stop, Unhold, Abort'
    """
    following = TRANSITIONS.get((state, command))
    if following is not None and following in MODE_STATES[mode]:
        return following
    names = ", ".join(one.name.capitalize() for one in allowed_commands(mode, state))
    within = "" if mode is PackMode.PRODUCTION else f" of {mode.name.lower()} mode"
    given = f"{command.name.capitalize()} in state {state_name(state)}{within}"
    return Refusal(given, f"allowed are {names}" if names else "no command is allowed; wait for the next state")


def mode_refused(mode: PackMode, state: PackState) -> Refusal | None:
    """Why a mode cannot be chosen in a state; None: it can."""
    if state in MODE_CHANGES:
        return None
    allowed = ", ".join(state_name(change) for change in sorted(MODE_CHANGES))
    return Refusal(f"{mode.name.lower()} mode in state {state_name(state)}", f"the mode changes in {allowed}")


@value_record
class PackTag:
    """A tag by which other systems read or command the machine: its name, type and meaning here."""

    name: str
    kind: str
    meaning: str


PACK_TAGS: tuple[PackTag, ...] = (
    PackTag("Command.UnitMode", "int", "mode to change to"),
    PackTag("Command.UnitModeChangeRequest", "bool", "change the mode"),
    PackTag("Command.MachSpeed", "real", "speed to weave at [knots a minute]"),
    PackTag("Command.CntrlCmd", "int", "number of the command"),
    PackTag("Command.CmdChangeRequest", "bool", "carry out the command"),
    PackTag("Status.UnitModeCurrent", "int", "mode"),
    PackTag("Status.StateCurrent", "int", "state"),
    PackTag("Status.MachSpeed", "real", "speed that is set [knots a minute]"),
    PackTag("Status.CurMachSpeed", "real", "speed that is reached [knots a minute]"),
    PackTag("Status.StateRequested", "int", "state that the last command leads to"),
    PackTag("Admin.ProdConsumedCount[0].Count", "int", "knots that were begun"),
    PackTag("Admin.ProdProcessedCount[0].Count", "int", "knots of the carpet that are tied"),
    PackTag("Admin.ProdDefectiveCount[0].Count", "int", "knots that had to be tried again"),
    PackTag("Admin.Alarm[#].Trigger", "bool", "the alarm is active"),
    PackTag("Admin.Alarm[#].ID", "int", "number of the alarm"),
    PackTag("Admin.Alarm[#].Message", "string", "its cause and remedy"),
    PackTag("Admin.StopReason.ID", "int", "number of the alarm that stopped the machine first"),
)
"""The tags that the loom has, by the names of the standard."""
