"""Commands by their names, as terminal, channel and field buses give them."""

from collections.abc import Mapping
from types import MappingProxyType

from ilmek.errors import UnitError
from ilmek.jobs.run.session import ControlSession
from ilmek.loom.control.exchange import (
    Acknowledged,
    Answered,
    Commanded,
    ControlInput,
    JogRequested,
    ModeChosen,
    RowsTakenOut,
)
from ilmek.loom.control.interlocks import JOG_LIMITS, jog_axis
from ilmek.loom.control.packml import PackCommand, PackMode, PackState
from ilmek.loom.control.view import Answer
from ilmek.units import parse_quantity

COMMANDS: Mapping[str, PackCommand] = MappingProxyType({one.name.lower(): one for one in PackCommand})
MODES: Mapping[str, PackMode] = MappingProxyType({one.name.lower(): one for one in PackMode})

RESUME = "resume"
"""The command that leads on to Execute from whatever state the machine waits in."""

ACKNOWLEDGE = "acknowledge"
"""The command that states that all alarms were seen and their causes removed."""

ROWS_BACK = "rows-back"
"""The command that states how many whole rows an operator has taken out before the row in work, and that row."""

JOG = "jog"
"""The command that moves an axis in manual mode, with its name and a distance."""

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
    """Give a command by its name, with its values behind it; the controller's answer."""
    given = _input(session, name)
    return given if isinstance(given, Answer) else _answer(session, given)


def _input(session: ControlSession, name: str) -> ControlInput | Answer:
    """What a command gives to the controller, or why it is refused."""
    simple: dict[str, ControlInput] = {
        ACKNOWLEDGE: Acknowledged(),
        **{mode: ModeChosen(chosen) for mode, chosen in MODES.items()},
        **{command: Commanded(given) for command, given in COMMANDS.items()},
    }
    verb, *values = name.split() or [""]
    if name in ANSWERS:
        requests = session.status().requests
        return Answered(requests[0].number, ANSWERS[name]) if requests else Answer(False, "the controller asks nothing")
    if verb == ROWS_BACK and len(values) == 1 and values[0].isdecimal():
        return RowsTakenOut(int(values[0]))
    if verb == JOG and len(values) > 1:
        return _jog(" ".join(values[:-1]), values[-1])
    every = f"{', '.join((RESUME, *simple, *ANSWERS))}, {ROWS_BACK} N, {JOG} AXIS DISTANCE"
    return simple.get(name, Answer(False, f"no command {name!r}; commands: {every}"))


def _jog(name: str, distance: str) -> JogRequested | Answer:
    axis = jog_axis(name)
    try:
        return JogRequested(name, parse_quantity(distance, JOG_LIMITS[axis].unit if axis else "m"))
    except UnitError as error:
        return Answer(False, str(error))


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
