"""Alarms in structured text: the reaction to each, and which of two is the graver."""

from ilmek.io.plc.state_model import REACTIONS
from ilmek.io.plc.units import PlcSection, PlcUnit, PlcVariable, cases
from ilmek.loom.control.alarms import ALARM_NUMBERS, ALARMS


def alarm_units() -> tuple[PlcUnit, ...]:
    """The function of the reactions, and that of the graver alarm."""
    reactions = (
        (number, f"ReactionOf := {REACTIONS[kind.reaction]}; (* {kind.name} *)")
        for number, kind in sorted(ALARM_NUMBERS.items())
    )
    meaning = "reaction to an alarm: 0 none, 1 suspend, 2 hold, 3 stop, 4 abort"
    inputs = PlcSection("VAR_INPUT", (PlcVariable("Alarm", "INT"),))
    both = PlcSection("VAR_INPUT", (PlcVariable("Present", "INT"), PlcVariable("Other", "INT")))
    graver = """\
Graver := Present;
IF Other > 0 AND (Present = 0 OR ReactionOf(Alarm := Other) > ReactionOf(Alarm := Present)) THEN
    Graver := Other;
END_IF;
"""
    return (
        PlcUnit("FUNCTION", "ReactionOf", meaning, (inputs,), f"ReactionOf := 0;\n{cases('Alarm', reactions)}", "INT"),
        PlcUnit("FUNCTION", "Graver", "the graver of two alarms, 0: none", (both,), graver, "INT"),
    )


def raised(alarm: str) -> str:
    """The statement that raises an alarm, unless a graver one is active.

    alarm  its name, or an expression of the program that is its number, 0: none
    >>> raised("door open")
    'Now.Alarm := Graver(Present := Now.Alarm, Other := 102);'
    """
    number = ALARMS[alarm].number if alarm in ALARMS else alarm
    return f"Now.Alarm := Graver(Present := Now.Alarm, Other := {number});"
