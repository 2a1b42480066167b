"""Devices of a machine's control and safety: sensors, switches, buttons, relays, terminals; and the price of each kind.

Sizes and masses are those that makers have in common, rounded to what is ordered by the designation; a part of another
make differs by some millimetres. `response` is the longest time from the event to the switched output [s].
"""

from dataclasses import dataclass
from typing import NamedTuple

from ilmek.units import g, mm


class MountingHoles(NamedTuple):
    """Holes for screws about the middle of a face, in one or two rows: distances [m], thread, whether of its ends."""

    across: float
    along: float
    thread: str
    end: bool = True


@dataclass(frozen=True, slots=True)
class FieldDevice:
    """A row of the catalogue.

    kind   by which it is priced       size  width, height, length of its room [m]       mass  [kg]
    source of its sizes, its mass and its response
    failures  dangerous ones in an hour of a device with electronics [1/h]; classes of catalogue parts
    b10d      operations after which a tenth of its contacts failed dangerously: of an emergency stop ISO 13849-1,
              table C.1; of a button with positive opening that of makers
    power     that it draws at 24 V [W]
    fixing    by what it holds itself, as its maker delivers it; "": screws of the machine hold it
    holes     for these screws; (): where its seat is      drilled  other faces have threads where what they carry is
    tabled    its B10d is that of ISO 13849-1, table C.1; else an assumed class of makers' values
    """

    name: str
    kind: str
    size: tuple[float, float, float]
    mass: float
    source: str
    response: float = 0.0
    failures: float = 0.0
    b10d: float = 0.0
    power: float = 0.0
    tabled: bool = False
    fixing: str = ""
    holes: tuple[MountingHoles, ...] = ()
    drilled: bool = False


def _size(width: float, height: float, length: float) -> tuple[float, float, float]:
    return width * mm, height * mm, length * mm


def _holes(across: float, along: float, thread: str, *, end: bool = True) -> tuple[MountingHoles, ...]:
    return (MountingHoles(across * mm, along * mm, thread, end),)


_CLASS = "class of catalogue parts; makers differ by some millimetres"

_SAFE, _GRID, _LOCK, _STOP = "ISO 13849-1", "IEC 61496-2", "ISO 14119, type 4", "ISO 13850"

ROWS = (
    FieldDevice(
        "absolute encoder 36 mm, 12 bit, hollow shaft", "sensor", _size(36, 36, 40), 100 * g, _CLASS, 1e-3, power=1.5,
        fixing="clamps on the rear shaft end of its motor; its spring plate with screws takes the torque",
    ),
    FieldDevice(
        "magnetic sensor for axis slots, PNP", "sensor", _size(6, 5, 25), 15 * g, _CLASS, 1e-3, power=0.2,
        fixing="its set screw clamps it in a slot of the axis",
    ),
    FieldDevice("inductive sensor M8, 1.5 mm, PNP", "sensor", _size(8, 8, 45), 0.03, "IEC 60947-5-2", 1e-3, power=0.3),
    FieldDevice(
        "strain transducer, 500 um/m, 2 mV/V", "load cell", _size(36, 16, 94), 120 * g, _CLASS, 5e-3,
        holes=_holes(22, 78, "M4", end=False),
    ),
    FieldDevice(
        "photoelectric yarn sensor, PNP", "yarn sensor", _size(12, 20, 30), 20 * g, _CLASS, 10e-3, power=0.7,
        holes=(*_holes(0, 12, "M3"), *_holes(0, 16, "M3", end=False)),
    ),
    FieldDevice(
        "disc brake of a yarn", "yarn brake", _size(40, 40, 40), 80 * g, _CLASS, holes=_holes(26, 0, "M3"), drilled=True
    ),
    FieldDevice(
        "laser light barrier, receiver or sender", "light barrier", _size(15, 50, 40), 60 * g, _CLASS, 10e-3, power=1.0,
        holes=_holes(0, 36, "M4"),
    ),
    FieldDevice(
        "RFID interlock, coded high, PL e", "interlock", _size(25, 18, 88), 110 * g, _LOCK, 0.1, 5e-9, power=1.2,
        holes=_holes(0, 78, "M4", end=False),
    ),
    FieldDevice(
        "actuator of an interlock", "actuator", _size(25, 18, 40), 30 * g, _LOCK,
        fixing="two screws M4 through the mesh into its counter plate",
    ),
    FieldDevice(
        "emergency stop, mushroom 40 mm, in a box", "emergency stop", _size(72, 72, 95), 0.25, _STOP,
        b10d=1e5, tabled=True, holes=_holes(54, 54, "M4"),
    ),
    FieldDevice(
        "button in a box", "button", _size(72, 72, 60), 180 * g, _CLASS, b10d=2e6, holes=_holes(54, 54, "M4")
    ),
    FieldDevice(
        "safety relay, 2 channels, PL e", "safety relay", _size(22.5, 100, 115), 250 * g, _SAFE, 0.02, 3e-9, power=3.0
    ),
    FieldDevice(
        "light grid, 4 beams, sender or receiver", "light grid", _size(40, 1000, 50), 1.4, _GRID, 0.02, 1e-8, power=3.0
    ),
    FieldDevice("motion controller with PLC", "motion controller", _size(100, 120, 100), 0.9, _CLASS, 0.01, power=25.0),
    FieldDevice("terminal, two levels", "terminal", _size(5.2, 100, 48), 15 * g, "IEC 60947-7-1"),
    FieldDevice(
        "measuring amplifier 2 mV/V, 0 ... 10 V", "measuring amplifier", _size(22.5, 100, 115), 0.15, _CLASS, power=2.0
    ),
    FieldDevice(
        "input module, 4 inputs 0 ... 10 V", "input module", _size(22.5, 100, 75), 0.15, _CLASS, 5e-3, power=2.0
    ),
    FieldDevice("input module, 16 inputs, PNP", "input module", _size(22.5, 100, 75), 0.15, _CLASS, 1e-3, power=3.0),
    FieldDevice("output module, 16 outputs, 2 A", "output module", _size(22.5, 100, 75), 0.15, _CLASS, 1e-3, power=3.0),
    FieldDevice(
        "input module, 16 inputs, PNP, IP67", "input module", _size(60, 220, 35), 0.45, _CLASS, 1e-3, power=4.0,
        holes=_holes(0, 208, "M3"),
    ),
    FieldDevice(
        "enabling switch, 3 positions, 2 channels, with cable", "enabling device", _size(60, 200, 60), 0.4,
        "IEC 60947-5-8", b10d=1e5, tabled=True, fixing="hangs in its holder, which comes with two screws",
    ),
    FieldDevice(
        "mode selector with key, 2 positions, 4 contacts", "mode selector", _size(45, 45, 70), 150 * g, _CLASS,
        b10d=2e6, fixing="its ring nut clamps it in its hole in the door",
    ),
)  # fmt: skip

ENCODER, AXIS_SENSOR, INDUCTIVE, STRAIN, YARN_SENSOR, BRAKE, BARRIER, INTERLOCK, ACTUATOR, STOP, BUTTON, RELAY, GRID, \
    CONTROLLER, TERMINAL, STRAIN_AMPLIFIER, ANALOG_INPUTS, INPUTS, OUTPUTS, FIELD_INPUTS, ENABLING, \
    MODE = ROWS  # fmt: skip

CHANNELS = 16
"""Inputs of an input module, outputs of an output module."""

AMPLIFIER_FAILURES = 1e-9
"""Dangerous failures in an hour of an amplifier that takes the torque from its motor (STO of IEC 61800-5-2) [1/h]."""

AMPLIFIERS = (1.0, 1.6, 2.5, 4.0, 6.3, 10.0, 16.0, 25.0, 40.0)
"""Rated currents of amplifiers [A]: ISO 3, R5."""

REPEATED = 0.1 * 1.5 * mm
"""Repeat accuracy of the inductive sensor [m]: a tenth of its operating distance, IEC 60947-5-2."""

BRAKE_FORCES = (0.02, 0.5)
"""Range of a yarn's disc brake [N]; makers differ, assumed by this project."""
