"""Which part each signal of the control comes from or goes to: the wiring list of a loom.

The signals are those of the control's program that have an address; a signal of each head has one part on each head. A
fault is reported as a number by the motion controller, which knows it from the sensor named beside it; its drives and
their sensors are named beside the signal that they carry out.
"""

from collections.abc import Mapping
from types import MappingProxyType

from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.own_parts import RETREAT_MOTOR
from ilmek.machines.beat_up.crank_start import CLUTCH
from ilmek.machines.beat_up.crank_start import MOTOR as CRANK_MOTOR
from ilmek.machines.beat_up.travel import MOTOR as SLIDE_MOTOR
from ilmek.machines.hammer.tree import MOTOR as HAMMER_MOTOR
from ilmek.machines.knotting_dyad.arms import SERVOS
from ilmek.machines.knotting_dyad.jaw_parts import SOLENOID
from ilmek.machines.knotting_dyad.tree import CENTRE_MOTOR
from ilmek.machines.shedding.stack import part_id as shedding_part
from ilmek.machines.warp_tension.cylinders import part_id as cylinder_part
from ilmek.machines.weaver.carriage_drive import CARRIAGE_MOTOR
from ilmek.machines.weaver.drive_parts import COLOUR_MOTOR, TIER_MOTOR
from ilmek.machines.weaver.knife import CUTTER_MOTOR
from ilmek.machines.weaver.magazine_parts import INDEX_SENSOR
from ilmek.machines.weaver.parts import MOTOR as HEAD_MOTOR
from ilmek.machines.weft.carriers import BOX_MOTOR
from ilmek.machines.weft.carriers import MOTOR as WEFT_MOTOR
from ilmek.machines.weft.rapier_tree import EDGE_MOTOR

STOP, RESET = part_id("emergency-stop"), part_id("reset-button")
HANDS, GRID = part_id("hand-button"), part_id("light-grid")
INTERLOCK, ACTUATOR = part_id("door-interlock"), part_id("interlock-actuator")
RELAY, CONTROLLER, SUPPLY = part_id("safety-relay"), part_id("motion-controller"), part_id("power-supply")
TERMINAL, STEPPER_SUPPLY, BRAKING = part_id("terminal"), part_id("stepper-supply"), part_id("braking-module")
SWITCH, PROTECTOR, FAN = part_id("main-switch"), part_id("circuit-protector"), part_id("cabinet-fan")
DOOR = part_id("cabinet-door")
STRAIN_AMPLIFIER, YARN_INPUTS = part_id("strain-amplifier"), part_id("yarn-inputs")
INPUTS, OUTPUTS = part_id("inputs"), part_id("outputs")
BENCH_STOP, ENABLING = part_id("bench-stop"), part_id("enabling-switch")
TENSION, RETREATED = part_id("tension-sensor"), part_id("retreat-sensor")
HEAD_ANGLE, BEAT_ANGLE, SHED_ANGLE = part_id("head-encoder"), part_id("beat-encoder"), part_id("shed-encoder")
WARP_STOP, WEFT_STOP, YARN_STOP = part_id("warp-stop-barrier"), part_id("weft-sensor"), part_id("yarn-sensor")
"""Ids of the parts."""

SHEDDING_MOTOR, CYLINDER_MOTOR = shedding_part("motor"), cylinder_part("motor")
"""Ids of motors."""

ENCODED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {HEAD_ANGLE: (HEAD_MOTOR,), BEAT_ANGLE: (CRANK_MOTOR, HAMMER_MOTOR), SHED_ANGLE: (SHEDDING_MOTOR,)}
)
"""Encoders, and the motors of which each is on the one that a loom has: its amplifier reads it."""

READ: Mapping[str, int] = MappingProxyType({INDEX_SENSOR: 1, WEFT_STOP: 1, WARP_STOP: 2})
"""Sensors that inputs in the cabinet read, and the pieces that give one signal: sender and receiver of a barrier."""

SWITCHED = (CLUTCH,)
"""Coils that outputs in the cabinet switch, one each; brakes and solenoids are switched by amplifiers."""


_KNOT = (HEAD_MOTOR, CUTTER_MOTOR, *SERVOS, CENTRE_MOTOR, SOLENOID)
_TUBE = (COLOUR_MOTOR, TIER_MOTOR, INPUTS, INDEX_SENSOR)
_ROW = (SHEDDING_MOTOR, RETREAT_MOTOR, WEFT_MOTOR, BOX_MOTOR, EDGE_MOTOR)
_BEAT = (CRANK_MOTOR, OUTPUTS, CLUTCH, SLIDE_MOTOR, HAMMER_MOTOR, CYLINDER_MOTOR)

_BY_SIGNAL: dict[str, tuple[str, ...]] = {
    "EmergencyStop": (STOP, RELAY),
    "DoorClosed": (INTERLOCK, RELAY),
    "WarpTensionKnown": (STRAIN_AMPLIFIER, TENSION),
    "WarpTension": (STRAIN_AMPLIFIER, TENSION),
    "GrippersOpen": (CONTROLLER, HEAD_ANGLE),
    "HeadsClear": (RETREATED,),
    "BeaterBack": (CONTROLLER, BEAT_ANGLE),
    "ShedClosed": (CONTROLLER, SHED_ANGLE),
    "TieDone": (CONTROLLER,),
    "TieStatus": (CONTROLLER, YARN_INPUTS, YARN_STOP),
    "EndDone": (CONTROLLER,),
    "EndStatus": (CONTROLLER, INPUTS, WEFT_STOP, WARP_STOP),
    "Halt": (RELAY,),
    "TieStart": (CONTROLLER, *_KNOT),
    "TieColumn": (CONTROLLER, CARRIAGE_MOTOR),
    "TieTube": (CONTROLLER, *_TUBE),
    "EndStart": (CONTROLLER, *_ROW),
    "EndCode": (CONTROLLER, *_BEAT),
    "JogStart": (CONTROLLER,),
}

SIGNALS: Mapping[str, tuple[str, ...]] = MappingProxyType(_BY_SIGNAL)
"""Ids of the parts of each signal, the one that is wired to the control first, then what the motion controller reads or
drives for it; of the kinds of beat, weft and knotting a loom has its own.
"""

OF_WEAVERS = ("HandsOnButtons", "GridFree")
"""Signals of a loom for weavers in place of those of heads, of their retreat and of doors; the first of each weaver."""

OF_HEADS = ("HeadsClear", "DoorClosed")
"""Signals that only a loom with heads has, beside those of each head."""

PER_HEAD = frozenset(("GrippersOpen", "TieDone", "TieStatus", "TieStart", "TieColumn", "TieTube"))
"""Signals of which each head has its own."""


OF_A_BEAT = frozenset(
    ("EmergencyStop", "BeaterBack", "EndDone", "EndStatus", "Halt", "EndStart", "EndCode", "JogStart", *OF_WEAVERS)
)
"""Signals of a loom of which the beat alone is driven."""


def signals_of(heads: int, weavers: int = 0) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """The signals of a loom with a number of heads, or for a number of weavers, each with the ids of its parts."""
    if not weavers:
        return tuple(
            (f"{name}[{index}]" if name in PER_HEAD else name, parts)
            for name, parts in SIGNALS.items()
            for index in range(heads if name in PER_HEAD else 1)
        )
    hands, grid = OF_WEAVERS
    stops = {"EmergencyStop": (STOP, BENCH_STOP, RELAY)}
    every = {**SIGNALS, **stops}.items()
    alike = ((name, parts) for name, parts in every if name not in PER_HEAD and name not in OF_HEADS)
    return (*alike, *((f"{hands}[{index}]", (HANDS, RELAY)) for index in range(weavers)), (grid, (GRID, RELAY)))


def beat_signals(weavers: int) -> int:
    """Number of the signals of a loom of which the beat alone is driven.

    >>> beat_signals(2)
    11
    """
    return len(OF_A_BEAT) + weavers - 1


def signal_count(heads: int, weavers: int = 0) -> int:
    """Number of those signals.

    >>> signal_count(1), signal_count(3), signal_count(0, 2)
    (19, 31, 14)
    """
    return len(signals_of(heads, weavers))
