"""The table of alarms, and the pages that show it and the interlocks."""

import re
import sys
from pathlib import Path

import pytest

from ilmek.loom.control.alarms import ALARM_NUMBERS, ALARMS, ActiveAlarm, AlarmKind, ControlFault, JournalFault
from ilmek.loom.control.interlocks import CONTRADICTIONS, INTERLOCKS, JOG_LIMITS, Interlock, Reaction, SensorRelation
from ilmek.loom.control.packml import (
    COMPLETED,
    MODE_STATES,
    PACK_TAGS,
    PackMode,
    PackState,
    allowed_commands,
    commanded,
    state_name,
)
from ilmek.loom.control.ports import Fault
from ilmek.viz.style import FONTS

DOCS = Path(__file__).parents[2] / "docs"
ALARM_PAGE = (DOCS / "reference/alarms.md").read_text(encoding="utf-8")
CONTROLLER_PAGE = (DOCS / "explanation/controller.md").read_text(encoding="utf-8")


def test_every_interlock_and_every_fault_has_an_alarm() -> None:
    names = [rule.name for rule in INTERLOCKS] + [*Fault, *JournalFault, *ControlFault]
    assert list(ALARMS) == names
    assert len(ALARM_NUMBERS) == len(ALARMS)


@pytest.mark.parametrize("kind", ALARMS.values(), ids=list(ALARMS))
def test_an_alarm_states_cause_and_remedy(kind: AlarmKind) -> None:
    assert kind.cause
    assert kind.remedy
    assert 1 <= kind.severity <= 1000
    text = ActiveAlarm(kind, 5, 2, 1, "seen twice").text
    assert text == f"{kind.name}, row 3, head 2: {kind.cause} (seen twice); {kind.remedy}"


def test_an_alarm_that_ends_by_itself_is_one_that_suspends() -> None:
    assert {one.reaction for one in ALARMS.values() if not one.latched} == {Reaction.SUSPEND}


def row(kind: AlarmKind) -> str:
    """An alarm as the page has it."""
    latched = "yes" if kind.latched else "no"
    start = f"| {kind.number} | {kind.name} | {kind.severity} | {kind.cause} | {kind.remedy}"
    return f"{start} | {kind.reaction} | {latched} |"


def test_the_page_of_alarms_is_the_table() -> None:
    shown = re.findall(r"^\| \d.*$", ALARM_PAGE, re.MULTILINE)
    assert shown == [row(kind) for kind in ALARMS.values()]


def interlock_row(rule: Interlock) -> str:
    value = "" if rule.relation is SensorRelation.KNOWN else f" {str(rule.value).lower()}"
    blocked = ", ".join(sorted(rule.blocks))
    when = "begins, moves" if rule.guards else "begins"
    return (
        f"| {rule.name} | `{rule.sensor}` {rule.relation}{value} | {blocked} | {when} | {rule.why} | {rule.reaction} |"
    )


def test_the_page_of_the_controller_has_every_interlock() -> None:
    part = CONTROLLER_PAGE.partition("## Interlocks")[2].partition("\n## ")[0]
    shown = [line for line in part.splitlines() if line.startswith("| ") and "`" in line]
    assert shown == [interlock_row(rule) for rule in INTERLOCKS]
    text = " ".join(part.split())
    assert all(f"**{one.name}**" in text for one in CONTRADICTIONS)
    assert all(f"{axis} {limit.distance:g} {limit.unit}" in text for axis, limit in JOG_LIMITS.items())


def state_row(state: PackState) -> str:
    """A state as the page has it: number, what follows, commands, modes."""
    following = f"→ {state_name(COMPLETED[state])}" if state in COMPLETED else "waits"
    commands = ", ".join(
        f"{one.name.capitalize()} → {state_name(after)}"
        for one in allowed_commands(PackMode.PRODUCTION, state)
        if isinstance(after := commanded(PackMode.PRODUCTION, state, one), PackState)
    )
    modes = ", ".join(mode.name.lower() for mode in PackMode if state in MODE_STATES[mode])
    return f"| {state} | {state_name(state)} | {following} | {commands or 'none'} | {modes} |"


def test_the_page_of_the_controller_has_every_state_and_command() -> None:
    part = CONTROLLER_PAGE.partition("## States")[2].partition("\n## ")[0]
    shown = re.findall(r"^\| \d.*$", part, re.MULTILINE)
    assert shown == [state_row(state) for state in PackState]


def test_the_page_of_the_controller_has_every_tag() -> None:
    part = CONTROLLER_PAGE.partition("## Tags")[2].partition("\n## ")[0]
    shown = [line for line in part.splitlines() if line.startswith("| `")]
    assert shown == [f"| `{one.name}` | {one.kind} | {one.meaning} |" for one in PACK_TAGS]


def test_the_diagram_of_states_is_that_of_the_tables() -> None:
    sys.path.insert(0, str(DOCS.parent))
    from examples.draw_controller import OUT, TITLE, draw  # noqa: PLC0415

    assert OUT.read_text(encoding="utf-8") == draw().svg(TITLE, FONTS)
