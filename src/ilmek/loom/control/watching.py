"""Alarms as they are raised, end and are acknowledged, and what the sensors mean for them."""

from collections.abc import Iterable
from dataclasses import replace

from ilmek.loom.control.alarms import ALARMS, ActiveAlarm, AlarmKind, ControlFault
from ilmek.loom.control.exchange import AlarmChanged
from ilmek.loom.control.homing import HOMED
from ilmek.loom.control.interlocks import (
    INTERLOCKS,
    LoomAxis,
    Reaction,
    TensionLimits,
    axes_of,
    broken_guards,
    contradictions,
    holds,
    violated,
)
from ilmek.loom.control.journal import AlarmAction, RecordKind
from ilmek.loom.control.packml import PackCommand, PackMode, Refusal
from ilmek.loom.control.ports import Sensors
from ilmek.loom.control.state import ControllerState, Draft

_RULES = {rule.name: rule for rule in INTERLOCKS}
_TIE = frozenset((LoomAxis.HEADS,)) | {LoomAxis.GRIPPERS, LoomAxis.CARRIAGE}
GOING_ON = frozenset((PackCommand.START, PackCommand.UNHOLD, PackCommand.UNSUSPEND))
"""Commands that an active alarm forbids."""
NO_HEAD = 65_535
"""Number of the head in the record of an alarm of the whole loom."""


def restore(state: ControllerState, kinds: Iterable[AlarmKind]) -> None:
    """Latched alarms that were active when the journal was closed wait for their acknowledgement."""
    for kind in kinds:
        if kind.latched:
            state.alarms[kind.name, None] = ActiveAlarm(kind, state.time, note="before the restart", present=False)


def raised(state: ControllerState, draft: Draft, name: str, *, head: int | None = None, note: str = "") -> AlarmKind:
    """Raise an alarm, if it is not active yet; its kind."""
    kind = ALARMS[name]
    before = state.alarms.get((kind.name, head))
    present = name in _RULES or name == ControlFault.CONTRADICTION
    if before is not None and before.present:
        return kind
    alarm = ActiveAlarm(kind, state.time, state.sequence.row, head, note, present)
    state.alarms[kind.name, head] = alarm
    if before is None:
        _changed(state, alarm, AlarmAction.RAISED, draft)
    return kind


def acknowledge(state: ControllerState, number: int | None, draft: Draft) -> None:
    """Acknowledge an alarm, or all; those whose cause has ended are active no more."""
    found = [key for key, one in state.alarms.items() if number is None or one.kind.number == number]
    if not found and number is not None:
        numbers = ", ".join(str(one.kind.number) for one in state.alarms.values()) or "none"
        draft.refusals.append(Refusal(f"acknowledging alarm {number}", f"active alarms are: {numbers}"))
    for key in found:
        if state.alarms[key].acknowledged:
            continue
        alarm = replace(state.alarms[key], acknowledged=True)
        state.alarms[key] = alarm
        _changed(state, alarm, AlarmAction.ACKNOWLEDGED, draft)
        if not alarm.present:
            _end(state, key, draft)


def refused(state: ControllerState, command: PackCommand) -> Refusal | None:
    """Why active alarms forbid a command; None: they do not. In manual mode an operator removes their causes."""
    if command is PackCommand.CLEAR:
        if state.store_failed:
            return Refusal("Clear while the journal cannot be written", "the journal must be opened again")
        grave = [alarm for alarm in state.alarms.values() if alarm.kind.reaction is Reaction.ABORT and alarm.present]
        return Refusal(f"Clear with {grave[0].kind.name}", grave[0].kind.remedy) if grave else None
    if command is PackCommand.START and state.mode is not PackMode.MANUAL and len(state.homed) < len(HOMED):
        return Refusal("Start before the axes are at home", "Reset homes them", "stop, then reset")
    if command in GOING_ON and state.mode is not PackMode.MANUAL:
        stopping = [alarm for alarm in state.alarms.values() if alarm.kind.reaction is not Reaction.NONE]
        if stopping:
            one = stopping[0]
            do = "remove the cause" if one.acknowledged else f"remove the cause and acknowledge alarm {one.kind.number}"
            return Refusal(f"{command.name.capitalize()} with {one.kind.name}", one.kind.remedy, do)
    return None


def suspending(state: ControllerState) -> bool:
    """Whether an alarm is active that suspends the machine."""
    return any(alarm.kind.reaction is Reaction.SUSPEND for alarm in state.alarms.values())


def compared(
    state: ControllerState, sensors: Sensors, limits: TensionLimits, draft: Draft
) -> tuple[tuple[str, str], ...]:
    """Compare new sensors with the interlocks, with each other, and with what moves: alarms to raise, with notes."""
    state.sensors = sensors
    state.tie_allowed = all(rule.sensor == "grippers_open" for rule in violated(_TIE, sensors, limits))
    if state.watch:
        state.watch = {name for name in state.watch if getattr(sensors, name)}
    opposed = contradictions(sensors)
    _end_causes(state, sensors, limits, bool(opposed), draft)
    found = [(str(ControlFault.CONTRADICTION), contradiction.name) for contradiction in opposed]
    if state.progress:
        axes = frozenset[LoomAxis]().union(*(axes_of(order) for order in state.progress.values()))
        found += [(rule.name, "") for rule in broken_guards(axes, sensors, limits)]
    return tuple(found)


def _end_causes(state: ControllerState, sensors: Sensors, limits: TensionLimits, opposed: bool, draft: Draft) -> None:
    """Alarms whose cause has ended are no longer present; those that are not latched, or acknowledged, end."""
    for key, alarm in tuple(state.alarms.items()):
        if not alarm.present:
            continue
        rule = _RULES.get(alarm.kind.name)
        lasts = opposed if rule is None else not holds(rule, sensors, limits, alarm.head)
        if lasts:
            continue
        state.alarms[key] = replace(alarm, present=False)
        if alarm.acknowledged or not alarm.kind.latched:
            _end(state, key, draft)


def _end(state: ControllerState, key: tuple[str, int | None], draft: Draft) -> None:
    _changed(state, state.alarms.pop(key), AlarmAction.ENDED, draft)


def _changed(state: ControllerState, alarm: ActiveAlarm, action: AlarmAction, draft: Draft) -> None:
    head = NO_HEAD if alarm.head is None else alarm.head
    draft.record(state, RecordKind.ALARM, action, state.sequence.row, head, 0, alarm.kind.number)
    draft.events.append(AlarmChanged(alarm, action, state.time))
