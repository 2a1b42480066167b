"""Interlocks: what must be true of the sensors before, and while, an axis moves. Each is a row of a table.

A rule blocks axes unless `sensor relation value` holds. It is tested for the axes of an operation before it begins, and
if `guards` also while it moves. The same rules are exported to other controls.
"""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

from ilmek.loom.control.ports import ChangePackages, EndRow, Order, Sensors, StandAside, Tie
from ilmek.loom.operations import RowEnd
from ilmek.records import value_record
from ilmek.weaving.tension import TENSION_LEAST, TENSION_MOST, usual_tension


class LoomAxis(StrEnum):
    """What moves in a loom; in manual mode each may be moved alone."""

    CARRIAGE = "carriage"
    HEADS = "heads"
    GRIPPERS = "grippers"
    SHED = "shed"
    SHUTTLE = "shuttle"
    BEATER = "beater"
    TAKE_UP = "take-up"


@value_record
class JogLimit:
    """The longest jog of an axis [m or rad]."""

    distance: float
    unit: str


JOG_LIMITS: Mapping[LoomAxis, JogLimit] = MappingProxyType(
    {
        LoomAxis.CARRIAGE: JogLimit(0.05, "m"),
        LoomAxis.HEADS: JogLimit(0.02, "m"),
        LoomAxis.GRIPPERS: JogLimit(0.02, "m"),
        LoomAxis.SHED: JogLimit(0.2, "rad"),
        LoomAxis.SHUTTLE: JogLimit(0.2, "m"),
        LoomAxis.BEATER: JogLimit(0.1, "rad"),
        LoomAxis.TAKE_UP: JogLimit(0.01, "m"),
    }
)
"""The longest jog of each axis: a movement that an operator follows by eye (assumed by this project)."""

_WEFT = frozenset((LoomAxis.SHED, LoomAxis.SHUTTLE))
_KNOT = frozenset((LoomAxis.CARRIAGE, LoomAxis.HEADS, LoomAxis.GRIPPERS))
ROW_END_AXES: Mapping[RowEnd, frozenset[LoomAxis]] = MappingProxyType(
    {
        RowEnd.STRAIGHT_WEFT: _WEFT,
        RowEnd.FIRST_BEAT: frozenset((LoomAxis.BEATER,)),
        RowEnd.SINUOUS_WEFT: _WEFT,
        RowEnd.SECOND_BEAT: frozenset((LoomAxis.BEATER,)),
        RowEnd.TAKE_UP: frozenset((LoomAxis.TAKE_UP,)),
    }
)
"""The axes that move in each operation after the knots."""


def jog_axis(name: str) -> LoomAxis | None:
    """The axis that a jog names; None: there is none. Of the grippers one may be named by its head: `gripper 3`."""
    if name in set(LoomAxis):
        return LoomAxis(name)
    kind, _, head = name.partition(" ")
    return LoomAxis.GRIPPERS if kind == "gripper" and head.isascii() and head.isdigit() else None


def axes_of(order: Order) -> frozenset[LoomAxis]:
    """The axes that an order moves."""
    if isinstance(order, Tie):
        return _KNOT
    if isinstance(order, StandAside):
        return frozenset((LoomAxis.CARRIAGE,))
    if isinstance(order, EndRow):
        return ROW_END_AXES[order.operation]
    if isinstance(order, ChangePackages):
        return frozenset()
    axis = jog_axis(order.axis)
    return frozenset() if axis is None else frozenset((axis,))


class SensorRelation(StrEnum):
    """How an interlock compares a sensor with its value."""

    IS = "is"
    KNOWN = "is known"
    AT_LEAST = "is at least"
    AT_MOST = "is at most"


class Reaction(StrEnum):
    """What the machine does because of an alarm."""

    NONE = "none"
    SUSPEND = "suspend"
    HOLD = "hold"
    STOP = "stop"
    ABORT = "abort"


@value_record
class TensionLimits:
    """Least and greatest mean tension of a warp at which the loom may weave [N]."""

    least: float
    most: float


def usual_limits(pitch: float) -> TensionLimits:
    """Limits of the tension of a usual warp: the shares of the tension at rest that the back rest keeps.

    pitch  of the warps [m]
    """
    rest = usual_tension(pitch)
    return TensionLimits(TENSION_LEAST * rest, TENSION_MOST * rest)


@value_record
class Interlock:
    """An interlock: while `sensor relation value` does not hold, the axes in `blocks` do not begin to move.

    sensor    field of `Sensors`; of `grippers_open` that of the head that begins, or all for other operations
    value     compared with; "least", "most": of `TensionLimits`
    guards    it also ends a motion in progress       reaction   of the machine where it stops weaving
    """

    name: str
    sensor: str
    relation: SensorRelation
    value: bool | str
    blocks: frozenset[LoomAxis]
    why: str
    reaction: Reaction
    guards: bool = False


_A = LoomAxis
_ALL = frozenset(LoomAxis)
_WEAVING = _ALL - {_A.GRIPPERS}

INTERLOCKS: tuple[Interlock, ...] = (
    Interlock("emergency stop", "emergency_stop", SensorRelation.IS, False, _ALL,
              "nothing moves after an emergency stop", Reaction.ABORT, guards=True),
    Interlock("door open", "door_closed", SensorRelation.IS, True, _ALL,
              "nothing moves while a hand can reach it", Reaction.ABORT, guards=True),
    Interlock("warp tension unknown", "warp_tension", SensorRelation.KNOWN, True, _WEAVING - {_A.TAKE_UP},
              "slack warps would be caught by the heads or the shuttle", Reaction.HOLD, guards=True),
    Interlock("warp tension low", "warp_tension", SensorRelation.AT_LEAST, "least", _WEAVING - {_A.TAKE_UP},
              "slack warps would be caught by the heads or the shuttle", Reaction.SUSPEND, guards=True),
    Interlock("warp tension high", "warp_tension", SensorRelation.AT_MOST, "most", _ALL - {_A.CARRIAGE, _A.GRIPPERS},
              "warps would break under a beat or in the shed", Reaction.SUSPEND, guards=True),
    Interlock("gripper closed on warps", "grippers_open", SensorRelation.IS, True, frozenset((_A.CARRIAGE,)),
              "a carriage that moves would tear the warps in its gripper", Reaction.HOLD),
    Interlock("gripper in the shed", "grippers_open", SensorRelation.IS, True,
              frozenset((_A.SHED, _A.BEATER, _A.TAKE_UP)),
              "warps in a gripper cannot follow the shed, the comb or the take-up", Reaction.HOLD),
    Interlock("head in the comb's path", "heads_clear", SensorRelation.IS, True, frozenset((_A.BEATER,)),
              "the comb would strike the head", Reaction.HOLD),
    Interlock("head between the warps", "heads_clear", SensorRelation.IS, True,
              frozenset((_A.SHED, _A.SHUTTLE, _A.TAKE_UP)),
              "warps and shuttle would strike the head", Reaction.HOLD),
    Interlock("beater not back", "beater_back", SensorRelation.IS, True, _KNOT | _WEFT | {_A.TAKE_UP},
              "the comb between the warps is in the path of heads, shed and shuttle", Reaction.HOLD),
    Interlock("shed open", "shed_closed", SensorRelation.IS, True, _KNOT | {_A.BEATER, _A.TAKE_UP},
              "heads find their warps, and the comb its dents, only in level warps", Reaction.HOLD),
)  # fmt: skip
"""All interlocks, the gravest first."""


def holds(rule: Interlock, sensors: Sensors, limits: TensionLimits, head: int | None = None) -> bool:
    """Whether the sensors satisfy an interlock, for a head or for all."""
    value = getattr(sensors, rule.sensor)
    if rule.sensor == "grippers_open":
        return all(value) if head is None else bool(value[head])
    if rule.relation is SensorRelation.KNOWN:
        return value is not None
    if rule.relation is SensorRelation.AT_LEAST:
        return value is None or value >= limits.least
    if rule.relation is SensorRelation.AT_MOST:
        return value is None or value <= limits.most
    return bool(value is rule.value)


def applies(rule: Interlock, axes: frozenset[LoomAxis]) -> bool:
    """Whether an interlock is about an operation that moves these axes."""
    return not rule.blocks.isdisjoint(axes)


def violated(
    axes: frozenset[LoomAxis], sensors: Sensors, limits: TensionLimits, head: int | None = None
) -> tuple[Interlock, ...]:
    """The interlocks that forbid these axes to begin, in the table's order."""
    return tuple(rule for rule in INTERLOCKS if applies(rule, axes) and not holds(rule, sensors, limits, head))


def broken_guards(axes: frozenset[LoomAxis], sensors: Sensors, limits: TensionLimits) -> tuple[Interlock, ...]:
    """The interlocks that end a motion of these axes that is in progress, in the table's order."""
    return tuple(
        rule for rule in INTERLOCKS if rule.guards and applies(rule, axes) and not holds(rule, sensors, limits)
    )


@value_record
class Contradiction:
    """Two sensors that cannot be true at once: `sensor` is `value` while `other` is `other_value`."""

    name: str
    sensor: str
    value: bool
    other: str
    other_value: bool
    why: str


CONTRADICTIONS: tuple[Contradiction, ...] = (
    Contradiction("heads clear with a gripper closed", "heads_clear", True, "grippers_open", False,
                  "a gripper that is closed on warps is in the comb's path"),
    Contradiction("beater forward among the heads", "beater_back", False, "heads_clear", False,
                  "the comb and a head would be at the same point"),
    Contradiction("shed open among the heads", "shed_closed", False, "heads_clear", False,
                  "the shed opens only when the heads have retreated"),
)  # fmt: skip
"""States of two sensors of which one must be wrong."""

WATCHED: Mapping[LoomAxis, str] = MappingProxyType({LoomAxis.BEATER: "beater_back", LoomAxis.SHED: "shed_closed"})
"""The sensor that must change, and return, while an axis moves in an operation after the knots; else it is stuck."""


def contradictions(sensors: Sensors) -> tuple[Contradiction, ...]:
    """The rows of `CONTRADICTIONS` that the sensors show."""
    return tuple(
        contradiction
        for contradiction in CONTRADICTIONS
        if _level(sensors, contradiction.sensor) is contradiction.value
        and _level(sensors, contradiction.other) is contradiction.other_value
    )


def _level(sensors: Sensors, name: str) -> bool:
    return all(sensors.grippers_open) if name == "grippers_open" else bool(getattr(sensors, name))
