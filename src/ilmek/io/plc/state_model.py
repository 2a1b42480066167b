"""The state model in structured text, from the controller's tables: transitions, completions, modes."""

from collections import defaultdict

from ilmek.io.plc.units import INDENT, PlcSection, PlcUnit, PlcVariable, indented
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

REACTIONS: dict[Reaction, int] = {reaction: number for number, reaction in enumerate(Reaction)}
"""Numbers of the reactions, the gravest the highest."""


def state_units() -> tuple[PlcUnit, ...]:
    """The functions and the function block of the state model."""
    return _mode_has_state(), _transition(), _completed(), _machine()


def _inputs(*names: str) -> PlcSection:
    return PlcSection("VAR_INPUT", tuple(PlcVariable(name, "INT") for name in names))


def _mode_has_state() -> PlcUnit:
    lines = ["ModeHasState := FALSE;", "CASE Mode OF"]
    for mode in PackMode:
        numbers = ", ".join(str(int(state)) for state in sorted(MODE_STATES[mode]))
        lines += [
            f"{INDENT}{int(mode)}: (* {mode.name.capitalize()} *)",
            f"{2 * INDENT}CASE State OF",
            f"{3 * INDENT}{numbers}: ModeHasState := TRUE;",
            f"{2 * INDENT}END_CASE;",
        ]
    lines.append("END_CASE;")
    return PlcUnit(
        "FUNCTION", "ModeHasState", "whether a mode has a state", (_inputs("Mode", "State"),), "\n".join(lines), "BOOL"
    )


def _transition() -> PlcUnit:
    by_state: dict[PackState, list[tuple[PackCommand, PackState]]] = defaultdict(list)
    for (state, command), target in TRANSITIONS.items():
        by_state[state].append((command, target))
    lines = ["Target := 0;", "CASE State OF"]
    for state in sorted(by_state):
        lines += [f"{INDENT}{int(state)}: (* {state_name(state)} *)", f"{2 * INDENT}CASE Command OF"]
        for command, target in sorted(by_state[state]):
            words = f"{command.name.capitalize()}: {state_name(target)}"
            lines.append(f"{3 * INDENT}{int(command)}: Target := {int(target)}; (* {words} *)")
        lines.append(f"{2 * INDENT}END_CASE;")
    lines += ["END_CASE;", "IF NOT ModeHasState(Mode, Target) THEN", f"{INDENT}Target := 0;", "END_IF;",
              "CommandedState := Target;"]  # fmt: skip
    sections = (_inputs("State", "Command", "Mode"), PlcSection("VAR", (PlcVariable("Target", "INT"),)))
    meaning = "the state that a command leads to; 0: the command is refused"
    return PlcUnit("FUNCTION", "CommandedState", meaning, sections, "\n".join(lines), "INT")


def _completed() -> PlcUnit:
    lines = ["CompletedState := State;", "CASE State OF"]
    for state, target in sorted(COMPLETED.items()):
        lines.append(f"{INDENT}{int(state)}: CompletedState := {int(target)}; (* {state_name(target)} *)")
    lines.append("END_CASE;")
    meaning = "the state that follows when the action of a state is complete"
    return PlcUnit("FUNCTION", "CompletedState", meaning, (_inputs("State"),), "\n".join(lines), "INT")


def _machine() -> PlcUnit:
    """The block that keeps state and mode; an alarm's reaction goes before a command, a command before completion."""
    reactions = [
        f"{int(REACTIONS[reaction])}: Wanted := {int(command)}; (* {command.name.capitalize()} *)"
        for reaction, command in REACTION_COMMANDS.items()
    ]
    changes = ", ".join(str(int(state)) for state in sorted(MODE_CHANGES))
    body = f"""\
Refused := FALSE;
Wanted := 0;
CASE AlarmReaction OF
{indented(chr(10).join(reactions))}
END_CASE;
Target := 0;
IF Wanted > 0 THEN
    Target := CommandedState(StateCurrent, Wanted, UnitModeCurrent);
END_IF;
IF Target = 0 AND CmdChangeRequest AND NOT CommandSeen THEN
    Target := CommandedState(StateCurrent, CntrlCmd, UnitModeCurrent);
    Refused := Target = 0;
END_IF;
CommandSeen := CmdChangeRequest;
IF Target = 0 AND StateComplete THEN
    Target := CompletedState(StateCurrent);
END_IF;
IF Target > 0 THEN
    StateCurrent := Target;
END_IF;
IF UnitModeChangeRequest AND NOT ModeSeen THEN
    CASE StateCurrent OF
        {changes}:
            IF UnitMode >= 1 AND UnitMode <= {len(PackMode)} THEN
                UnitModeCurrent := UnitMode;
            ELSE
                Refused := TRUE;
            END_IF;
    ELSE
        Refused := TRUE;
    END_CASE;
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
