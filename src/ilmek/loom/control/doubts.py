"""Uncertain operations: the sensor, else the operator, is asked whether they are in the carpet.

After a restart every operation that may have begun is in doubt, and each that is found brings the next one into doubt,
until the answer is no. So nothing is tied twice, whatever the journal has lost.
"""

from dataclasses import replace

from ilmek.loom.control.exchange import Operation, OperatorRequest
from ilmek.loom.control.ports import ChangePackages, EndRow, Tie
from ilmek.loom.control.sequence import key_of
from ilmek.loom.control.state import ControllerState, Doubt, Draft


def add_frontier(state: ControllerState, *, trusted: bool) -> None:
    """Put every operation that may begin now into doubt, if it is not yet."""
    for operation in state.sequence.frontier():
        state.doubts.setdefault(key_of(operation), Doubt(operation, onward=True, trusted=trusted))


def withdraw(state: ControllerState) -> None:
    """Forget what was asked; the doubts stay."""
    state.requests.clear()
    state.doubts = {key: replace(one, sensor=False, request=None) for key, one in state.doubts.items()}


def ask_all(state: ControllerState, draft: Draft) -> None:
    """Ask for every uncertain operation for which neither sensor nor operator is asked yet."""
    for key, doubt in tuple(state.doubts.items()):
        if doubt.sensor or doubt.request is not None:
            continue
        if not isinstance(doubt.operation, ChangePackages):
            state.doubts[key] = replace(doubt, sensor=True)
            draft.questions.append(doubt.operation)
        elif doubt.trusted:
            del state.doubts[key]
        else:
            ask_operator(state, key, draft)


def ask_operator(state: ControllerState, key: int, draft: Draft) -> None:
    """Ask the operator for an uncertain operation."""
    state.questions += 1
    doubt = state.doubts[key]
    request = OperatorRequest(state.questions, doubt.operation, question(doubt.operation))
    state.requests[state.questions] = request
    state.doubts[key] = replace(doubt, sensor=False, request=state.questions)
    draft.requests.append(request)


def question(operation: Operation) -> str:
    """The question to an operator about an operation, answered by yes or no. Rows and warp pairs count from 1.

    >>> question(Tie(0, 4, 7, 31, 2))
    'is the knot of row 5 on warp pair 32 tied (head 1, tube 3)?'
    """
    if isinstance(operation, Tie):
        where = f"row {operation.row + 1} on warp pair {operation.column + 1}"
        return f"is the knot of {where} tied (head {operation.head + 1}, tube {operation.tube + 1})?"
    if isinstance(operation, EndRow):
        name = operation.operation.name.replace("_", " ").lower()
        return f"is the {name} of row {operation.row + 1} done?"
    stop = operation.stop
    return f"are all packages of the stop before row {stop.row + 1}, phase {stop.phase + 1}, changed?"
