"""Commands by their names, as terminal, channel and field buses give them."""

from collections.abc import Mapping
from types import MappingProxyType

from ilmek.jobs.run.session import ControlSession
from ilmek.loom.control.exchange import Acknowledged, Answered, Commanded, ControlInput, ModeChosen
from ilmek.loom.control.packml import PackCommand, PackMode, PackState
from ilmek.loom.control.view import Answer

COMMANDS: Mapping[str, PackCommand] = MappingProxyType({one.name.lower(): one for one in PackCommand})
MODES: Mapping[str, PackMode] = MappingProxyType({one.name.lower(): one for one in PackMode})

RESUME = "resume"
"""The command that leads on to Execute from whatever state the machine waits in."""

ACKNOWLEDGE = "acknowledge"
"""The command that states that all alarms were seen and their causes removed."""

ANSWERS: Mapping[str, bool] = MappingProxyType({"yes": True, "no": False})
"""The answers to the first of the controller's requests."""

_ONWARD: Mapping[PackState, tuple[ControlInput, ...]] = MappingProxyType(
    {
        PackState.ABORTED: (Acknowledged(), Commanded(PackCommand.CLEAR)),
        PackState.STOPPED: (Acknowledged(), Commanded(PackCommand.RESET)),
        PackState.IDLE: (Acknowledged(), Commanded(PackCommand.START)),
        PackState.HELD: (Acknowledged(), Commanded(PackCommand.UNHOLD)),
        PackState.SUSPENDED: (Acknowledged(), Commanded(PackCommand.UNSUSPEND)),
    }
)


def give_command(session: ControlSession, name: str) -> Answer:
    """Give a command of PackML, choose a mode, acknowledge alarms or answer a request; the controller's answer."""
    if name in ANSWERS:
        requests = session.status().requests
        if not requests:
            return Answer(False, "the controller asks nothing")
        return _answer(session, Answered(requests[0].number, ANSWERS[name]))
    if name == ACKNOWLEDGE:
        return _answer(session, Acknowledged())
    if name in MODES:
        return _answer(session, ModeChosen(MODES[name]))
    if name in COMMANDS:
        return _answer(session, Commanded(COMMANDS[name]))
    return Answer(
        False, f"no command {name!r}; commands: {', '.join((RESUME, ACKNOWLEDGE, *COMMANDS, *MODES, *ANSWERS))}"
    )


def lead_on(session: ControlSession) -> Answer:
    """The next command towards Execute, with all alarms acknowledged; refused where the machine does not wait."""
    inputs = _ONWARD.get(session.state)
    if inputs is None:
        return Answer(False, f"resume in state {session.state.name.capitalize()}; allowed while the loom stands")
    return _answer(session, *inputs)


def waits(session: ControlSession) -> bool:
    """Whether the machine is in a state from which a command leads on."""
    return session.state in _ONWARD


def _answer(session: ControlSession, *inputs: ControlInput) -> Answer:
    refusals = session.react(inputs).refusals
    return Answer(not refusals, "; ".join(refusal.text for refusal in refusals))
