"""A state of PackML in the state machines of the companion specifications.

Sources: OPC 30050 "PackML" (three nested state machines), OPC 40001-1 "Machinery" (item state, operation mode).
"""

from collections.abc import Mapping
from types import MappingProxyType

from ilmek.loom.control.packml import PackState, state_name

CLEARED = frozenset(("Clearing", "Stopping", "Stopped"))
"""States of the machine's state machine; all others but Aborting and Aborted are of the innermost one."""

BASE = frozenset(("Aborting", "Aborted"))
"""States of the outermost state machine, in which the loom is not cleared."""

STATE_NUMBERS: Mapping[str, int] = MappingProxyType({state_name(state): int(state) for state in PackState})
"""PackTags' number of each state."""

MODE_NUMBERS: Mapping[str, int] = MappingProxyType({"Production": 1, "Maintenance": 2, "Manual": 3})
"""Value of `ProductionMaintenanceModeEnum` of OPC 30050 for each mode; 0: invalid."""

OPERATION_MODES: Mapping[str, str] = MappingProxyType(
    {"Production": "Processing", "Maintenance": "Maintenance", "Manual": "Setup"}
)
"""State of MachineryOperationMode for each mode of PackML; any other is None."""

OUT_OF_SERVICE = frozenset(("Aborting", "Aborted", "Clearing"))
"""States of PackML in which the loom is aborted."""

_NOT_EXECUTING = frozenset(("Stopped", "Idle", "Resetting", "Held", "Suspended", "Complete"))


def nested_states(state: str) -> tuple[str, str | None, str | None]:
    """The current states of BaseStateMachine, MachineState and ExecuteState; None: that machine is not active.

    >>> nested_states("Held")
    ('Cleared', 'Running', 'Held')
    >>> nested_states("Stopped")
    ('Cleared', 'Stopped', None)
    >>> nested_states("Aborted")
    ('Aborted', None, None)
    """
    if state in BASE:
        return state, None, None
    return ("Cleared", state, None) if state in CLEARED else ("Cleared", "Running", state)


def item_state(state: str) -> str:
    """The state of MachineryItemState.

    >>> item_state("Execute"), item_state("Held"), item_state("Aborted")
    ('Executing', 'NotExecuting', 'OutOfService')
    """
    if state in OUT_OF_SERVICE:
        return "OutOfService"
    return "NotExecuting" if state in _NOT_EXECUTING else "Executing"


def operation_mode(mode: str) -> str:
    """The state of MachineryOperationMode."""
    return OPERATION_MODES.get(mode, "None")
