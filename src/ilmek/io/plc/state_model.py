"""The state model in structured text, from the controller's tables: transitions, completions, modes."""

from collections import defaultdict

from ilmek.io.plc.units import PlcSection, PlcUnit, PlcVariable, cases, indented
from ilmek.loom.control.core import REACTION_COMMANDS
from ilmek.loom.control.interlocks import Reaction
from ilmek.loom.control.packml import (
    COMPLETED,
    MODE_CHANGES,
    MODE_STATES,
    TRANSITIONS,
    PackCommand,
    PackMode,
    PackState,
    state_name,
)
from ilmek.loom.control.watching import GOING_ON

REACTIONS: dict[Reaction, int] = {reaction: number for number, reaction in enumerate(Reaction)}
"""Numbers of the reactions, the gravest the highest."""


def state_units() -> tuple[PlcUnit, ...]:
    """The functions and the function block of the state model."""
    return _mode_has_state(), _transition(), _completed(), _machine()


def _inputs(*names: str) -> PlcSection:
    return PlcSection("VAR_INPUT", tuple(PlcVariable(name, "INT") for name in names))


def _mode_has_state() -> PlcUnit:
    modes = [
        (int(mode), cases("State", ((int(state), "ModeHasState := TRUE;") for state in sorted(MODE_STATES[mode]))))
        for mode in PackMode
    ]
    body = f"ModeHasState := FALSE;\n{cases('Mode', modes)}"
    return PlcUnit("FUNCTION", "ModeHasState", "whether a mode has a state", (_inputs("Mode", "State"),), body, "BOOL")


def _transition() -> PlcUnit:
    by_state: dict[PackState, list[tuple[int, str]]] = defaultdict(list)
    for (state, command), target in sorted(TRANSITIONS.items()):
        words = f"{state_name(state)}, {command.name.capitalize()}: {state_name(target)}"
        by_state[state].append((int(command), f"Target := {int(target)}; (* {words} *)"))
    states = [(int(state), cases("Command", targets)) for state, targets in sorted(by_state.items())]
    body = f"""\
Target := 0;
{cases("State", states)}
IF NOT ModeHasState(Mode := Mode, State := Target) THEN
    Target := 0;
END_IF;
CommandedState := Target;
"""
    sections = (_inputs("State", "Command", "Mode"), PlcSection("VAR", (PlcVariable("Target", "INT"),)))
    meaning = "the state that a command leads to; 0: the command is refused"
    return PlcUnit("FUNCTION", "CommandedState", meaning, sections, body, "INT")


def _completed() -> PlcUnit:
    targets = [
        (int(state), f"CompletedState := {int(target)}; (* {state_name(target)} *)")
        for state, target in sorted(COMPLETED.items())
    ]
    body = f"CompletedState := State;\n{cases('State', targets)}"
    meaning = "the state that follows when the action of a state is complete"
    return PlcUnit("FUNCTION", "CompletedState", meaning, (_inputs("State"),), body, "INT")


def _machine() -> PlcUnit:
    """The block that keeps state and mode; an alarm's reaction goes before a command, a command before completion."""
    reactions = [
        (REACTIONS[reaction], f"Wanted := {int(command)}; (* {command.name.capitalize()} *)")
        for reaction, command in REACTION_COMMANDS.items()
    ]
    change = f"""\
IF UnitMode >= 1 AND UnitMode <= {len(PackMode)} THEN
    UnitModeCurrent := UnitMode;
ELSE
    Refused := TRUE;
END_IF;"""
    changes = ((int(state), change) for state in sorted(MODE_CHANGES))
    onward = " OR ".join(f"CntrlCmd = {int(command)}" for command in sorted(GOING_ON))
    body = f"""\
Refused := FALSE;
Wanted := 0;
Target := 0;
{cases("AlarmReaction", reactions)}
IF Wanted > 0 THEN
    Target := CommandedState(State := StateCurrent, Command := Wanted, Mode := UnitModeCurrent);
    IF AlarmReaction = {REACTIONS[Reaction.SUSPEND]}
        AND NOT ModeHasState(Mode := UnitModeCurrent, State := {int(PackState.SUSPENDED)}) THEN
        Target := CommandedState(State := StateCurrent, Command := {int(PackCommand.HOLD)}, Mode := UnitModeCurrent);
    END_IF;
END_IF;
IF Target = 0 AND CmdChangeRequest AND NOT CommandSeen THEN
    Refused := Forbidden AND ({onward});
    IF NOT Refused THEN
        Target := CommandedState(State := StateCurrent, Command := CntrlCmd, Mode := UnitModeCurrent);
    END_IF;
    Refused := Target = 0;
END_IF;
CommandSeen := CmdChangeRequest;
IF Target = 0 AND Resume THEN
    Target := CommandedState(State := StateCurrent, Command := {int(PackCommand.UNSUSPEND)}, Mode := UnitModeCurrent);
END_IF;
IF Target = 0 AND StateComplete THEN
    Target := CompletedState(State := StateCurrent);
END_IF;
IF Target > 0 THEN
    StateCurrent := Target;
END_IF;
IF UnitModeChangeRequest AND NOT ModeSeen THEN
{indented(cases("StateCurrent", changes, "Refused := TRUE;"))}
END_IF;
ModeSeen := UnitModeChangeRequest;
"""
    return PlcUnit("FUNCTION_BLOCK", "StateModel", "states and modes by ISA-TR88.00.02", _machine_sections(), body)


def _machine_sections() -> tuple[PlcSection, ...]:
    return (
        PlcSection(
            "VAR_INPUT",
            (
                PlcVariable("CntrlCmd", "INT", "number of the command"),
                PlcVariable("CmdChangeRequest", "BOOL", "carry it out at the rising edge"),
                PlcVariable("UnitMode", "INT", "mode to change to"),
                PlcVariable("UnitModeChangeRequest", "BOOL", "change it at the rising edge"),
                PlcVariable("StateComplete", "BOOL", "the action of the state is complete"),
                PlcVariable("AlarmReaction", "INT", "gravest reaction of the active alarms, 0: none"),
                PlcVariable("Forbidden", "BOOL", "an active alarm forbids Start, Unhold and Unsuspend"),
                PlcVariable("Resume", "BOOL", "what the machine was suspended for has ended"),
            ),
        ),
        PlcSection(
            "VAR_OUTPUT",
            (
                PlcVariable("StateCurrent", "INT", "state", str(int(PackState.STOPPED))),
                PlcVariable("UnitModeCurrent", "INT", "mode", str(int(PackMode.PRODUCTION))),
                PlcVariable("Refused", "BOOL", "the command or mode was refused in this scan"),
            ),
        ),
        PlcSection(
            "VAR",
            (
                PlcVariable("Wanted", "INT"),
                PlcVariable("Target", "INT"),
                PlcVariable("CommandSeen", "BOOL"),
                PlcVariable("ModeSeen", "BOOL"),
            ),
        ),
    )
