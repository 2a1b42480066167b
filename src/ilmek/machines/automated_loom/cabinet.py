"""The cabinet of a loom's control: its size by what stands on its mounting plate, the plate, and the amplifiers on it.

The plate is before the rear wall. The amplifiers of the axes stand on it row by row from its upper edge down, the
mounting rails lie below them, the bar of the protective conductors at its foot. A row is as wide as the plate; between
two rows there is room for a duct.
"""

import math
from collections.abc import Iterable, Iterator
from itertools import product

from ilmek.elements.anchor_bolts import ANCHOR
from ilmek.elements.cabinet_devices import fuse_of, supply_for
from ilmek.elements.columns import STEEL
from ilmek.elements.field_devices import TERMINAL
from ilmek.elements.motor_loads import MAINS, STEPPER_VOLTS, MotorLoad
from ilmek.machines.automated_loom.anchors import anchors
from ilmek.machines.automated_loom.frame import part_id
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import UPRIGHT, Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Drilling, Placed, Prism, Sum, box, rectangle
from ilmek.part.tree import Occurrence
from ilmek.records import record
from ilmek.units import mm

_WIDTHS, _HEIGHTS, _DEEP = (0.8, 1.0, 1.2, 1.6, 2.0), (1.0, 1.2, 1.4, 1.6, 1.8, 2.0), 0.3
"""Sizes of cabinets [m]; assumed by this project."""

WALL, PLATE = 2 * mm, 3 * mm
"""Thickness of the walls, and of the mounting plate [m]; assumed by this project."""

RAIL_ENDS, FOOT_ROOM, RAIL_PITCH = 20 * mm, 60 * mm, 190 * mm
"""From the wall to the plate's edge and a rail's end; below the lowest row, for the bar; of two rails [m]; assumed."""

_ANCHORED = 60 * mm
"""Of the cabinet's anchors from its sides [m]; assumed by this project."""

_MODULE, _MODULE_PITCH = (40 * mm, 170 * mm, 160 * mm), (50 * mm, 230 * mm)
"""Width, height and depth of an amplifier [m], and the distances of neighbours; assumed by this project."""

AMPLIFIER, CONTROL, MOUNTING_PLATE = part_id("control-axis"), part_id("control"), part_id("mounting-plate")
"""Ids of the amplifier of a motor, with its cable and switch, of the cabinet and of its plate."""


@record
class ControlNeeds:
    """What the cabinet has room for: amplifiers of axes, and the length of mounting rails [m]."""

    axes: int
    rail: float


def control_needs(motors: Iterable[tuple[str, float, int]], signals: int) -> ControlNeeds:
    """The needs of a control of so many signals; motors: kind, power [W] and number of those of each part."""
    loads = [(MotorLoad(kind, power), number) for kind, power, number in motors]
    fuses = (number * load.poles * load.fused.row.size[0] for load, number in loads)
    steppers = math.fsum(number * load.apparent for load, number in loads if load.volts == STEPPER_VOLTS)
    row, number = supply_for(STEPPER_VOLTS, steppers)
    each = row.size[0] + row.phases * fuse_of(_LEAST_FUSE, MAINS).row.size[0]
    terminals = (signals + _TERMINALS) * TERMINAL.size[0]
    return ControlNeeds(sum(number for _, number in loads), _OTHERS + number * each + terminals + math.fsum(fuses))


_OTHERS, _LEAST_FUSE, _TERMINALS = 0.5, 2.0, 20
"""Length of what is on the rails beside fuses, supplies of steppers, terminals [m], and rating of their fuses [A];
terminals of safety devices and of 24 V beside one for each signal.
"""


@record
class CabinetSize:
    """Width and height of a cabinet [m], and the amplifiers in it."""

    wide: float
    high: float
    axes: int

    @property
    def rail(self) -> float:
        """Length of a mounting rail [m].

        >>> round(CabinetSize(0.8, 1.4, 38).rail, 9)
        0.756
        """
        return self.wide - 2 * WALL - 2 * RAIL_ENDS

    @property
    def columns(self) -> int:
        """Amplifiers of a row."""
        return math.floor(self.rail / _MODULE_PITCH[0] + 1e-9)

    @property
    def lowest(self) -> float:
        """Lower end of the room of the amplifiers over the cabinet's foot [m]."""
        return self.high - WALL - -(-self.axes // self.columns) * _MODULE_PITCH[1]

    @property
    def rails(self) -> tuple[float, ...]:
        """Heights of the mounting rails below the amplifiers over the cabinet's foot, from above [m].

        >>> [round(height, 9) for height in CabinetSize(0.8, 1.4, 38).rails]
        [0.613, 0.423, 0.233]
        """
        number = max(math.floor((self.lowest - WALL - FOOT_ROOM) / RAIL_PITCH + 1e-9), 0)
        return tuple(self.lowest - (index + 0.5) * RAIL_PITCH for index in range(number))


def cabinet_for(needs: ControlNeeds) -> CabinetSize:
    """The narrowest cabinet, and of these the lowest, in which all has room; the largest where none has.

    A device that is too wide for the rest of a row stands on the next one: a row more than the length says.
    """
    sizes = (CabinetSize(wide, high, needs.axes) for wide, high in product(_WIDTHS, _HEIGHTS))
    enough = (size for size in sizes if len(size.rails) * size.rail >= needs.rail + _LEFT * len(size.rails))
    return next(enough, CabinetSize(_WIDTHS[-1], _HEIGHTS[-1], needs.axes))


_LEFT = 50 * mm
"""What a row of devices leaves free of its rail, on an average [m]; assumed by this project."""


def control_parts(right: float, floor: float, rear: float, needs: ControlNeeds) -> Iterator[Occurrence]:
    """The cabinet on the floor behind a rear foot, anchored there, its mounting plate, and the amplifiers on that.

    right, rear  outer side of the column, and end of its rear foot [m]      needs  of the control
    """
    size = cabinet_for(needs)
    x, y = right - size.wide / 2, floor + size.high / 2
    stands, feet = placement(x, y, rear - _DEEP), _feet(size)
    yield Occurrence(_cabinet(size, feet), (stands,))
    yield anchors("control", "cabinet", WALL, tuple(stands.after(foot) for foot in feet))
    yield Occurrence(_plate(size), (placement(x, y, rear - WALL - PLATE),))
    if needs.axes:
        module = bought_part(
            AMPLIFIER,
            "axis of the control",
            "axis of the control",
            box(*_MODULE),
            Bought("amplifier, STO and SLS"),
            size="amplifier, cable, switch",
        )
        yield Occurrence(module, tuple(_amplifiers(size, x, floor + size.high - WALL, rear - WALL - PLATE)))


def _amplifiers(size: CabinetSize, x: float, top: float, wall: float) -> Iterator[Placement]:
    """Row by row from the upper edge down, each from the left."""
    across, upwards = _MODULE_PITCH
    for number in range(size.axes):
        row, column = divmod(number, size.columns)
        beside = (column - (size.columns - 1) / 2) * across
        yield placement(x + beside, top - (row + 0.5) * upwards, wall - _MODULE[2])


def _feet(size: CabinetSize) -> tuple[Placement, ...]:
    """The anchors in the cabinet's axes."""
    return tuple(
        placement(x, -size.high / 2, z).after(UPRIGHT)
        for x in (_ANCHORED - size.wide / 2, size.wide / 2 - _ANCHORED)
        for z in (_ANCHORED, _DEEP - _ANCHORED)
    )


def _cabinet(size: CabinetSize, feet: tuple[Placement, ...]) -> Part:
    inside = rectangle(size.wide - 2 * WALL, size.high - 2 * WALL)
    holes = tuple(Drilling(foot, ((ANCHOR.hole, WALL),), through=True) for foot in feet)
    sides = Prism(Profile(rectangle(size.wide, size.high), (inside,)), _DEEP, holes)
    shape = Sum((Placed(sides), Placed(Prism(Profile(inside), WALL), (placement(z=_DEEP - WALL),))))
    named = "cabinet " + " x ".join(f"{own / mm:.0f}" for own in (size.wide, size.high, _DEEP)) + " mm, sheet steel"
    return bought_part(CONTROL, "control", "control", shape, Bought(named, shape.volume * STEEL.density))


def _plate(size: CabinetSize) -> Part:
    wide, high = (own - 2 * WALL - 2 * RAIL_ENDS for own in (size.wide, size.high))
    shape = box(wide, high, PLATE)
    named = f"plate {wide / mm:.0f} x {high / mm:.0f} mm, galvanised"
    return bought_part(
        MOUNTING_PLATE,
        "mounting plate of the cabinet",
        "mounting plate",
        shape,
        Bought(named, shape.volume * STEEL.density),
        fixing="its nuts on the studs of the cabinet's wall",
    )
