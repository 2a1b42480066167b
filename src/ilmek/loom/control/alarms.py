"""Alarms: number, name, severity, cause, remedy and reaction of each, in one table.

Numbers: 100 interlocks, 200 faults that the loom reports, 300 the journal, 400 sensors and reports. A latched alarm
stays until an operator acknowledges it after its cause has ended; the machine does not weave on before. Severities are
those of OPC UA, 1 to 1000.
"""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

from ilmek.loom.control.interlocks import INTERLOCKS, Reaction
from ilmek.loom.control.ports import Fault
from ilmek.records import value_record


class JournalFault(StrEnum):
    """What can be wrong with the journal while the loom weaves, or when it is opened."""

    DISC_FULL = "disc full"
    WRITE_FAILED = "journal not written"
    READ_ONLY = "journal read-only"
    DAMAGED = "journal damaged"
    OTHER_PROGRAMME = "journal of another programme"
    IN_USE = "journal in use"
    BEHIND = "journal behind the carpet"
    ROW_DAMAGED = "row of the programme damaged"


class ControlFault(StrEnum):
    """What the controller finds in reports and sensors."""

    CONTRADICTION = "sensors contradict each other"
    STUCK = "sensor stuck"
    UNEXPECTED = "unexpected report"
    CLOCK_BACKWARDS = "clock going backwards"
    NO_SENSORS = "no sensors"
    NO_HOST = "host silent"
    NOT_HOME = "axis not at home"


@value_record
class AlarmKind:
    """A kind of alarm: what caused it, what an operator does about it, and what the machine does.

    latched  it is active until it is acknowledged
    """

    number: int
    name: str
    severity: int
    cause: str
    remedy: str
    reaction: Reaction
    latched: bool = True


_INTERLOCK_REMEDIES: Mapping[str, str] = MappingProxyType(
    {
        "emergency stop": "remove the danger, release the emergency stop, clear, reset and start",
        "door open": "close the door, clear, reset and start",
        "warp tension unknown": "check the cable of the tension sensor; then unhold",
        "warp tension low": "wait for the let-off, or tighten the warps; weaving goes on by itself",
        "warp tension high": "wait for the let-off, or slacken the warps; weaving goes on by itself",
        "gripper closed on warps": "stop, open the gripper of the head in manual mode, reset and start",
        "gripper in the shed": "stop, open the grippers in manual mode, reset and start",
        "head in the comb's path": "stop, retreat the heads in manual mode, reset and start",
        "head between the warps": "stop, retreat the heads in manual mode, reset and start",
        "beater not back": "stop, move the beater back in manual mode, reset and start",
        "shed open": "stop, close the shed in manual mode, reset and start",
    }
)
_SEVERITIES = {Reaction.ABORT: 1000, Reaction.STOP: 900, Reaction.HOLD: 700, Reaction.SUSPEND: 500, Reaction.NONE: 300}


def _interlock_alarms() -> dict[str, AlarmKind]:
    return {
        rule.name: AlarmKind(
            101 + index,
            rule.name,
            _SEVERITIES[rule.reaction],
            f"an operation was to begin{' or moved' if rule.guards else ''}, but {rule.why}",
            _INTERLOCK_REMEDIES[rule.name],
            rule.reaction,
            latched=rule.reaction is not Reaction.SUSPEND,
        )
        for index, rule in enumerate(INTERLOCKS)
    }


def _held(number: int, name: str, cause: str, remedy: str) -> AlarmKind:
    return AlarmKind(number, name, 600, cause, remedy, Reaction.HOLD)


_FAULTS = (
    _held(201, Fault.PILE_END, "a package of pile yarn is empty", "put on a package of the same yarn; then unhold"),
    _held(202, Fault.PILE_BREAK, "a pile yarn broke", "thread the yarn through the tube again; then unhold"),
    _held(203, Fault.MISSED_GRIP, "a gripper missed its warps twice",
          "free the warps at this column and check the gripper; then unhold: the knot is tied again"),
    _held(204, Fault.WEFT_BREAK, "a weft broke", "remove the broken pick and join the weft; then unhold"),
    _held(205, Fault.WEFT_END, "a bobbin of weft is empty", "change the bobbin; then unhold"),
    _held(206, Fault.WARP_BREAK, "a warp broke", "tie in a new warp; then unhold"),
    _held(207, Fault.TIMEOUT, "an operation was not finished in time",
          "look for what blocks it; then unhold, and state whether it is in the carpet if the sensor cannot tell"),
)  # fmt: skip
_JOURNAL = (
    AlarmKind(301, JournalFault.DISC_FULL, 900, "the disc of the journal has no room",
              "make room; the controller goes on by itself", Reaction.ABORT),
    AlarmKind(302, JournalFault.WRITE_FAILED, 900, "the journal could not be written or synchronised",
              "check the disc; the controller goes on when it can be written again", Reaction.ABORT),
    AlarmKind(303, JournalFault.READ_ONLY, 900, "the journal may not be written",
              "give the controller the right to write it, or choose another folder", Reaction.ABORT),
    AlarmKind(304, JournalFault.DAMAGED, 900, "a record that was durable is damaged",
              "restore the journal from a copy; the record's number is in the message", Reaction.ABORT),
    AlarmKind(305, JournalFault.OTHER_PROGRAMME, 900, "the journal belongs to another programme",
              "choose the programme it was begun with, or another folder", Reaction.ABORT),
    AlarmKind(306, JournalFault.IN_USE, 900, "another controller writes this journal",
              "end the other controller, or choose another folder", Reaction.ABORT),
    AlarmKind(307, JournalFault.BEHIND, 800, "the sensor finds operations in the carpet that the journal does not have",
              "check that journal and carpet belong together; then acknowledge", Reaction.HOLD),
    AlarmKind(308, JournalFault.ROW_DAMAGED, 900, "a row that the host gave is not a row of the programme",
              "check the connection to the host and its programme; then unhold: the row is read again", Reaction.HOLD),
)  # fmt: skip
_CONTROL = (
    AlarmKind(401, ControlFault.CONTRADICTION, 800, "two sensors cannot be true at once",
              "check both sensors; then unhold", Reaction.HOLD),
    AlarmKind(402, ControlFault.STUCK, 800, "a sensor did not change while its axis moved",
              "check the sensor; then unhold", Reaction.HOLD),
    AlarmKind(403, ControlFault.UNEXPECTED, 800, "the loom reported an operation that was not in progress",
              "check the connection to the loom; then unhold", Reaction.HOLD),
    AlarmKind(404, ControlFault.CLOCK_BACKWARDS, 300, "a report is older than the one before",
              "check the loom's clock; the order of records does not depend on it", Reaction.NONE),
    AlarmKind(405, ControlFault.NO_SENSORS, 800, "the loom has not reported its sensors",
              "check the connection to the loom; then unhold", Reaction.HOLD),
    AlarmKind(406, ControlFault.NO_HOST, 800, "the host was silent, or has not given a requested row or carpet",
              "check the host and the connection to it; then unhold", Reaction.HOLD),
    AlarmKind(407, ControlFault.NOT_HOME, 800, "an axis was not at its switch after homing, or could not be homed",
              "free the axis, in manual mode by jogs, check its switch, then acknowledge and reset", Reaction.STOP),
)  # fmt: skip

ALARMS: Mapping[str, AlarmKind] = MappingProxyType(
    {**_interlock_alarms(), **{str(one.name): one for one in (*_FAULTS, *_JOURNAL, *_CONTROL)}}
)
"""All alarms by name: of interlocks, `Fault`, `JournalFault` and `ControlFault`."""

ALARM_NUMBERS: Mapping[int, AlarmKind] = MappingProxyType({alarm.number: alarm for alarm in ALARMS.values()})
"""All alarms by number."""


@value_record
class ActiveAlarm:
    """An alarm that is active: where it happened, when [ns], and whether its cause lasts and it is acknowledged.

    row, head  None: not at a row or head      note  what is known beyond its kind
    """

    kind: AlarmKind
    time: int
    row: int | None = None
    head: int | None = None
    note: str = ""
    present: bool = True
    acknowledged: bool = False

    @property
    def text(self) -> str:
        """The alarm in one line: name, location counted from 1, cause, remedy."""
        where = "".join(
            f", {name} {value + 1}" for name, value in (("row", self.row), ("head", self.head)) if value is not None
        )
        note = f" ({self.note})" if self.note else ""
        return f"{self.kind.name}{where}: {self.kind.cause}{note}; {self.kind.remedy}"
