"""Which part each signal of the control comes from or goes to: the wiring list of a loom.

The signals are those of the control's program that have an address; a signal of each head has one part on each head. A
fault is reported as a number by the motion controller, which knows it from the sensor named beside it; its drives and
their sensors are named beside the signal that they carry out.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import TypeAlias

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
from ilmek.records import record

STOP, RESET = part_id("emergency-stop"), part_id("reset-button")
HANDS, GRID = part_id("hand-button"), part_id("light-grid")
INTERLOCK, ACTUATOR = part_id("door-interlock"), part_id("interlock-actuator")
RELAY, CONTROLLER, SUPPLY = part_id("safety-relay"), part_id("motion-controller"), part_id("power-supply")
TERMINAL, STEPPER_SUPPLY, BRAKING = part_id("terminal"), part_id("stepper-supply"), part_id("braking-module")
SWITCH, PROTECTOR, FAN = part_id("main-switch"), part_id("circuit-protector"), part_id("cabinet-fan")
DOOR = part_id("cabinet-door")
STRAIN_AMPLIFIER, YARN_INPUTS = part_id("strain-amplifier"), part_id("yarn-inputs")
INPUTS, OUTPUTS, ANALOG_INPUTS = part_id("inputs"), part_id("outputs"), part_id("analog-inputs")
OUTLET, PROTECTIVE_BAR, MAINS_TERMINAL = part_id("outlet-filter"), part_id("protective-bar"), part_id("mains-terminal")
BENCH_STOP, ENABLING = part_id("bench-stop"), part_id("enabling-switch")
GUARD_RELAY, MODE = part_id("guard-relay"), part_id("mode-selector")
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


@record
class DeviceSignal:
    """An input that the motion controller reads itself: variable, meaning, id of the device, module, pieces for one."""

    name: str
    meaning: str
    part: str
    module: str = INPUTS
    share: int = 1

    def elements(self, number: int) -> tuple[str, ...]:
        """The variables of so many pieces of the device.

        >>> DeviceSignal("WarpsWhole", "", "", share=2).elements(2), DeviceSignal("TubeIndex", "", "").elements(2)
        (('WarpsWhole',), ('TubeIndex[0]', 'TubeIndex[1]'))
        """
        count = number // self.share
        return (self.name,) if count == 1 else tuple(f"{self.name}[{index}]" for index in range(count))


READ = (
    DeviceSignal("TubeIndex", "the index of the yarn tubes is before its sensor", INDEX_SENSOR),
    DeviceSignal("WeftPresent", "the weft is before its sensor", WEFT_STOP),
    DeviceSignal("WarpsWhole", "no broken warp is in the light barrier", WARP_STOP, share=2),
    DeviceSignal("StopsReady", "the relay of the emergency stops is closed", RELAY),
    DeviceSignal("GuardsReady", "the relay of the guards is closed", GUARD_RELAY),
    DeviceSignal("SettingMode", "the mode selector is at setting: axes may only jog", MODE),
    DeviceSignal("YarnPresent", "the pile yarn is in its sensor", YARN_STOP, YARN_INPUTS),
)
"""What the motion controller reads besides signals of the program, and reports in the status of an order."""

IN_CABINET = frozenset((RELAY, GUARD_RELAY, MODE))
"""What is wired within the cabinet, one of each."""

ANALOG = frozenset(("WarpTension",))
"""Signals of 0 ... 10 V."""

SWITCHED = (CLUTCH,)
"""Coils that outputs in the cabinet switch, one each; brakes and solenoids are switched by amplifiers."""


_KNOT = (HEAD_MOTOR, CUTTER_MOTOR, *SERVOS, CENTRE_MOTOR, SOLENOID)
_TUBE = (COLOUR_MOTOR, TIER_MOTOR)
_ROW = (SHEDDING_MOTOR, RETREAT_MOTOR, WEFT_MOTOR, BOX_MOTOR, EDGE_MOTOR)
_BEAT = (CRANK_MOTOR, OUTPUTS, CLUTCH, SLIDE_MOTOR, HAMMER_MOTOR, CYLINDER_MOTOR)

_BY_SIGNAL: dict[str, tuple[str, ...]] = {
    "EmergencyStop": (STOP, RELAY),
    "DoorClosed": (INTERLOCK, GUARD_RELAY),
    "WarpTensionKnown": (STRAIN_AMPLIFIER, TENSION, INPUTS),
    "WarpTension": (STRAIN_AMPLIFIER, TENSION, ANALOG_INPUTS),
    "GrippersOpen": (CONTROLLER, HEAD_ANGLE),
    "HeadsClear": (RETREATED,),
    "BeaterBack": (CONTROLLER, BEAT_ANGLE),
    "ShedClosed": (CONTROLLER, SHED_ANGLE),
    "TieDone": (CONTROLLER,),
    "TieStatus": (CONTROLLER, INPUTS, INDEX_SENSOR, YARN_INPUTS, YARN_STOP),
    "EndDone": (CONTROLLER,),
    "EndStatus": (CONTROLLER, INPUTS, WEFT_STOP, WARP_STOP),
    "Halt": (CONTROLLER,),
    "TieStart": (CONTROLLER, *_KNOT),
    "TieColumn": (CONTROLLER, CARRIAGE_MOTOR),
    "TieTube": (CONTROLLER, *_TUBE),
    "TieAside": (CONTROLLER, *_KNOT),
    "EndStart": (CONTROLLER, *_ROW),
    "EndCode": (CONTROLLER, *_BEAT),
    "JogStart": (CONTROLLER,),
}

SIGNALS: Mapping[str, tuple[str, ...]] = MappingProxyType(_BY_SIGNAL)
"""Ids of the parts of each signal, the one that is wired to the control first, then what the motion controller reads or
drives for it; of the kinds of beat, weft and knotting a loom has its own. A signal of which the controller is the first
passes between the programs in it, without a wire.
"""

OF_WEAVERS = ("HandsOnButtons", "GridFree")
"""Signals of a loom for weavers in place of those of heads, of their retreat and of doors; the first of each weaver."""

OF_HEADS = ("HeadsClear", "DoorClosed")
"""Signals that only a loom with heads has, beside those of each head."""

PER_HEAD = frozenset(("GrippersOpen", "TieDone", "TieStatus", "TieStart", "TieColumn", "TieTube", "TieAside"))
"""Signals of which each head has its own."""


OF_A_BEAT = frozenset(
    ("EmergencyStop", "BeaterBack", "EndDone", "EndStatus", "Halt", "EndStart", "EndCode", "JogStart", *OF_WEAVERS)
)
"""Signals of a loom of which the beat alone is driven."""


Signal: TypeAlias = tuple[str, tuple[str, ...]]
"""Name of a signal, and the ids of its parts."""


def signals_of(heads: int, weavers: int = 0) -> tuple[Signal, ...]:
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
    return (
        *alike,
        *((f"{hands}[{index}]", (HANDS, GUARD_RELAY)) for index in range(weavers)),
        (grid, (GRID, GUARD_RELAY)),
    )


def beat_signals(weavers: int) -> tuple[Signal, ...]:
    """The signals of a loom of which the beat alone is driven.

    >>> len(beat_signals(2))
    11
    """
    return tuple(own for own in signals_of(0, weavers) if own[0].partition("[")[0] in OF_A_BEAT)
