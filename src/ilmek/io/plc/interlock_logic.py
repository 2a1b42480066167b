"""The interlocks in structured text, from the controller's table: a permission for every operation, and its alarm.

Satisfied[i]   the sensors satisfy rule i
Permit...      all rules about the operation are satisfied; of a knot for each head
Guard...       all rules that end the operation in progress are satisfied
Blocked...     number of the alarm of the gravest rule that is not, 0: none
"""

from ilmek.io.plc.units import PlcArray, PlcSection, PlcUnit, PlcVariable, loop
from ilmek.loom.control.alarms import ALARMS
from ilmek.loom.control.interlocks import (
    CONTRADICTIONS,
    INTERLOCKS,
    Contradiction,
    Interlock,
    LoomAxis,
    Reaction,
    SensorRelation,
    TensionLimits,
    applies,
    axes_of,
)
from ilmek.loom.control.ports import EndRow, Tie
from ilmek.loom.operations import RowEnd

SENSOR_NAMES = {
    "emergency_stop": "EmergencyStop",
    "door_closed": "DoorClosed",
    "warp_tension": "WarpTension",
    "grippers_open": "GrippersOpen",
    "heads_clear": "HeadsClear",
    "beater_back": "BeaterBack",
    "shed_closed": "ShedClosed",
}
TENSION_KNOWN = "WarpTensionKnown"
KNOT = "Knot"
_PER_HEAD = "grippers_open"


def capitalised(text: str) -> str:
    """A name of the tables as part of a variable's name.

    >>> capitalised("take-up"), capitalised("STRAIGHT_WEFT")
    ('TakeUp', 'StraightWeft')
    """
    return "".join(part.capitalize() for part in text.replace("-", "_").split("_"))


OPERATIONS: dict[str, frozenset[LoomAxis]] = {
    KNOT: axes_of(Tie(0, 0, 0, 0, 0)),
    **{capitalised(one.name): axes_of(EndRow(0, one)) for one in RowEnd},
    **{f"Jog{capitalised(axis.value)}": frozenset((axis,)) for axis in LoomAxis},
}
"""The axes that move in each operation, by its name in the program."""


def interlock_unit(heads: int, limits: TensionLimits) -> PlcUnit:
    """The function block of the interlocks for a number of heads."""
    lines = ["AllOpen := TRUE;", loop("Head", heads, "AllOpen := AllOpen AND GrippersOpen[Head];")]
    lines += [
        f"Satisfied[{number}] := {_condition(rule, limits)}; (* {rule.name} *)"
        for number, rule in enumerate(INTERLOCKS)
    ]
    suspending = (number for number, rule in enumerate(INTERLOCKS) if rule.reaction is Reaction.SUSPEND)
    lines.append(f"Slack := {' OR '.join(f'NOT Satisfied[{number}]' for number in suspending)};")
    lines.append(f"Contradiction := {' OR '.join(_contradictory(pair) for pair in CONTRADICTIONS)};")
    for name, axes in OPERATIONS.items():
        lines += _operation_lines(name, axes, heads)
    inner = (
        PlcVariable("Satisfied", PlcArray(len(INTERLOCKS), "BOOL")),
        PlcVariable("Head", "INT"),
    )
    sections = (
        PlcSection("VAR_INPUT", sensor_variables(heads)),
        PlcSection("VAR_OUTPUT", tuple(_outputs(heads))),
        PlcSection("VAR", inner),
    )
    meaning = "what must be true before and while an operation moves"
    return PlcUnit("FUNCTION_BLOCK", "Interlocks", meaning, sections, "\n".join(lines))


def sensor_variables(heads: int) -> tuple[PlcVariable, ...]:
    """The sensors as variables."""
    return (
        PlcVariable("EmergencyStop", "BOOL", "the emergency stop is pressed"),
        PlcVariable("DoorClosed", "BOOL", "the door is closed"),
        PlcVariable(TENSION_KNOWN, "BOOL", "the tension sensor answers"),
        PlcVariable("WarpTension", "REAL", "mean tension of a warp [N]"),
        PlcVariable("GrippersOpen", PlcArray(heads, "BOOL"), "no gripper of the head is closed on warps"),
        PlcVariable("HeadsClear", "BOOL", "the heads have retreated from the comb"),
        PlcVariable("BeaterBack", "BOOL", "the beater is at its rest"),
        PlcVariable("ShedClosed", "BOOL", "the warps are level"),
    )


def _outputs(heads: int) -> list[PlcVariable]:
    outputs = [
        PlcVariable("Slack", "BOOL", "a rule that suspends the machine is not satisfied"),
        PlcVariable("Contradiction", "BOOL", "two sensors contradict each other"),
        PlcVariable("AllOpen", "BOOL", "no gripper is closed on warps"),
    ]
    for name in OPERATIONS:
        kind = PlcArray(heads, "BOOL") if name == KNOT else "BOOL"
        outputs += [
            PlcVariable(f"Permit{name}", kind, "the operation may begin"),
            PlcVariable(f"Guard{name}", "BOOL", "the operation may go on"),
            PlcVariable(f"Blocked{name}", "INT", "number of the alarm that forbids it, 0: none"),
        ]
    return outputs


def _condition(rule: Interlock, limits: TensionLimits) -> str:
    name = SENSOR_NAMES[rule.sensor]
    if rule.sensor == _PER_HEAD:
        return "AllOpen"
    if rule.relation is SensorRelation.KNOWN:
        return TENSION_KNOWN
    if rule.relation in (SensorRelation.AT_LEAST, SensorRelation.AT_MOST):
        sign = ">=" if rule.relation is SensorRelation.AT_LEAST else "<="
        return f"(NOT {TENSION_KNOWN}) OR (WarpTension {sign} {getattr(limits, str(rule.value))!r})"
    return name if rule.value else f"NOT {name}"


def _contradictory(pair: Contradiction) -> str:
    levels = ((pair.sensor, pair.value), (pair.other, pair.other_value))
    names = (("AllOpen" if sensor == _PER_HEAD else SENSOR_NAMES[sensor], value) for sensor, value in levels)
    return f"({' AND '.join(name if value else f'NOT {name}' for name, value in names)})"


def _operation_lines(name: str, axes: frozenset[LoomAxis], heads: int) -> list[str]:
    rules = [(number, rule) for number, rule in enumerate(INTERLOCKS) if applies(rule, axes)]
    guards = " AND ".join(f"Satisfied[{number}]" for number, rule in rules if rule.guards) or "TRUE"
    lines = [f"Guard{name} := {guards};", f"Blocked{name} := 0;"]
    lines += [
        f"IF NOT Satisfied[{number}] THEN Blocked{name} := {ALARMS[rule.name].number}; END_IF; (* {rule.name} *)"
        for number, rule in reversed(rules)
    ]
    if name != KNOT:
        return [*lines, f"Permit{name} := Blocked{name} = 0;"]
    others = " AND ".join(f"Satisfied[{number}]" for number, rule in rules if rule.sensor != _PER_HEAD) or "TRUE"
    return [*lines, loop("Head", heads, f"Permit{name}[Head] := {others} AND GrippersOpen[Head];")]
