"""Homing: after power-up each axis finds its reference, one after the other, before anything else moves.

    next axis = the first of HOMED that is not at home and that no interlock forbids

While a gripper is closed on warps, the yarn of a knot is caught in it, and the grippers alone move. The interlocks give
the order for whatever operation was cut off: of a knot the grippers open, then the heads retreat; of a weft the shuttle
leaves the shed, then the shed closes; of a beat the beater goes back. An axis that is not at its
switch afterwards, or that the interlocks forbid for good, ends homing with an alarm. In manual mode nothing is homed:
an operator frees the loom by jogs.
"""

from collections.abc import Mapping, Set
from types import MappingProxyType

from ilmek.loom.control.interlocks import Interlock, LoomAxis, TensionLimits, violated
from ilmek.loom.control.ports import Sensors

HOMED: Mapping[LoomAxis, str] = MappingProxyType(
    {
        LoomAxis.GRIPPERS: "grippers_open",
        LoomAxis.HEADS: "heads_clear",
        LoomAxis.BEATER: "beater_back",
        LoomAxis.SHUTTLE: "",
        LoomAxis.SHED: "shed_closed",
        LoomAxis.CARRIAGE: "",
        LoomAxis.TAKE_UP: "",
    }
)
"""The axes in the order of homing, and the sensor that shows each at home; "": its drive alone reads its switch.

The cylinders of the take-up do not move: their position is taken where they stand.
"""


def at_home(axis: LoomAxis, sensors: Sensors) -> bool:
    """Whether the sensor of an axis shows it at home."""
    switch = HOMED[axis]
    level = getattr(sensors, switch) if switch else True
    return all(level) if isinstance(level, tuple) else bool(level)


def next_axis(homed: Set[LoomAxis], sensors: Sensors, limits: TensionLimits) -> LoomAxis | Interlock | None:
    """The axis that is homed next; the gravest interlock that forbids it; None: all are at home."""
    left = [axis for axis in HOMED if axis not in homed]
    if left and not at_home(LoomAxis.GRIPPERS, sensors):
        left = [LoomAxis.GRIPPERS]
    blocked = [violated(frozenset((axis,)), sensors, limits) for axis in left]
    free = [axis for axis, rules in zip(left, blocked, strict=True) if not rules]
    return free[0] if free else blocked[0][0] if blocked else None
