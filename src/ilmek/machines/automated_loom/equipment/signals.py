"""Which part each signal of the control comes from or goes to: the wiring list of a loom.

The signals are those of the control's program that have an address; a signal of each head has one part on each head. A
fault is reported as a number by the motion controller, which knows it from the sensor named beside it.
"""

from collections.abc import Mapping
from types import MappingProxyType

from ilmek.machines.automated_loom.frame import part_id

STOP, RESET = part_id("emergency-stop"), part_id("reset-button")
INTERLOCK, ACTUATOR = part_id("door-interlock"), part_id("interlock-actuator")
RELAY, CONTROLLER, SUPPLY = part_id("safety-relay"), part_id("motion-controller"), part_id("power-supply")
TERMINAL = part_id("terminal")
TENSION, RETREATED = part_id("tension-sensor"), part_id("retreat-sensor")
HEAD_ANGLE, BEAT_ANGLE, SHED_ANGLE = part_id("head-encoder"), part_id("beat-encoder"), part_id("shed-encoder")
WARP_STOP, WEFT_STOP, YARN_STOP = part_id("warp-stop-barrier"), part_id("weft-sensor"), part_id("yarn-sensor")
"""Ids of the parts."""

_BY_SIGNAL: dict[str, tuple[str, ...]] = {
    "EmergencyStop": (STOP, RELAY),
    "DoorClosed": (INTERLOCK, RELAY),
    "WarpTensionKnown": (TENSION,),
    "WarpTension": (TENSION,),
    "GrippersOpen": (HEAD_ANGLE,),
    "HeadsClear": (RETREATED,),
    "BeaterBack": (BEAT_ANGLE,),
    "ShedClosed": (SHED_ANGLE,),
    "TieDone": (CONTROLLER,),
    "TieFault": (CONTROLLER, YARN_STOP),
    "EndDone": (CONTROLLER,),
    "EndFault": (CONTROLLER, WEFT_STOP, WARP_STOP),
    "Halt": (RELAY,),
    "TieStart": (CONTROLLER,),
    "TieColumn": (CONTROLLER,),
    "TieTube": (CONTROLLER,),
    "EndStart": (CONTROLLER,),
    "EndCode": (CONTROLLER,),
    "JogStart": (CONTROLLER,),
}

SIGNALS: Mapping[str, tuple[str, ...]] = MappingProxyType(_BY_SIGNAL)
"""Ids of the parts of each signal, the one that is wired to the control first."""

PER_HEAD = frozenset(("GrippersOpen", "TieDone", "TieFault", "TieStart", "TieColumn", "TieTube"))
"""Signals of which each head has its own."""


def signal_count(heads: int) -> int:
    """Number of signals of a loom with a number of heads.

    >>> signal_count(1), signal_count(3)
    (19, 31)
    """
    return len(SIGNALS) + (heads - 1) * len(PER_HEAD)
