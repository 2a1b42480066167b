"""What stands in the cabinet on the mounting rails of its plate: supply, fuses, safety circuit, control, terminals.

Fuses; supplies of 24 V and of 48 V, with what burns the energy of braking steppers [`power_plan`]; motion controller,
safety relay, input modules, and the terminals of all that is outside [`terminals`]. The amplifiers of the axes stand
over the rails [`cabinet`], the bar of the protective conductors is below them. The door has the main switch, whose
handle is outside, and a fan with its outlet where the walls do not pass the heat.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache

from ilmek.elements.cabinet_devices import (
    BRAKING,
    PROTECTOR,
    WARMER,
    fan_for,
    main_switch,
    mains_terminal,
    outlet_of,
    passed,
    protective_bar,
)
from ilmek.elements.columns import STEEL
from ilmek.elements.field_devices import (
    ANALOG_INPUTS,
    CHANNELS,
    CONTROLLER,
    INPUTS,
    MODE,
    OUTPUTS,
    RELAY,
    STRAIN_AMPLIFIER,
    TERMINAL,
    FieldDevice,
)
from ilmek.elements.wiring import section_for
from ilmek.machines.automated_loom.cabinet import (
    AMPLIFIER,
    CONTROL,
    PLATE,
    RAIL_ENDS,
    RAIL_PITCH,
    WALL,
    CabinetSize,
)
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.devices import TO_THE_BACK, device, placed
from ilmek.machines.automated_loom.equipment.power_plan import PowerPlan, power_plan
from ilmek.machines.automated_loom.equipment.site import LoomSite
from ilmek.machines.automated_loom.equipment.terminals import module_inputs, terminal_levels, terminals
from ilmek.machines.automated_loom.frame import part_id
from ilmek.part.extents import Extent
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import ALONG_WIDTH, placement
from ilmek.part.shapes import Placed, Sum, box
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.units import format_quantity, mm

RAIL, RAIL_MASS = (35 * mm, 7.5 * mm), 0.32
"""Width and height of a mounting rail [m], and its mass per length [kg/m]: EN 60715, TH 35-7.5."""

CIRCUIT = part_id("circuit")
"""Id of the body."""

GROWING = frozenset(("terminal", "fuse", "power supply"))
"""Processes of what there is more of, or larger, for more motors and signals."""


@record
class RailDevice:
    """A device on the rails: part, row, pieces."""

    part: Part
    row: FieldDevice
    number: int


@record
class CabinetCircuit:
    """What stands in the cabinet: its power plan, the devices on the rails in their order, the fan if any, its surface.

    carried  heat that walls and fan carry at `WARMER` [W]
    """

    plan: PowerPlan
    devices: tuple[RailDevice, ...]
    fan: FieldDevice | None
    carried: float

    def rows(self, long: float) -> tuple[tuple[RailDevice, tuple[tuple[int, float], ...]], ...]:
        """The row and the middle on it [m] of each piece of the devices, one beside the other on rails of a length."""
        row, end = 0, 0.0
        seated = []
        for own in self.devices:
            wide, seats = own.row.size[0], []
            for _ in range(own.number):
                if end + wide > long:
                    row, end = row + 1, 0.0
                seats.append((row, end + wide / 2))
                end += wide
            seated.append((own, tuple(seats)))
        return tuple(seated)

    def used(self, long: float) -> int:
        """Rails of a length that all devices take."""
        return 1 + max(row for _, seats in self.rows(long) for row, _ in seats)


def _on_rail(name: str, title: str, row: FieldDevice, number: int, power: float = 0.0) -> RailDevice:
    return RailDevice(replace(device(name, title, row, power), fixing="snaps onto its rail, EN 60715"), row, number)


@lru_cache(maxsize=8)
def circuit_of(site: LoomSite, tree: Tree) -> CabinetCircuit:
    """The circuit of a loom; tree: all its bodies but those of the circuit."""
    numbers = {part.id: number for part, number in tree.occurrences()}
    control = [
        _on_rail(signals.CONTROLLER, "motion controller", CONTROLLER, 1),
        _on_rail(signals.RELAY, "relay of the emergency stops", RELAY, 1),
        _on_rail(signals.GUARD_RELAY, "relay of the guards", RELAY, 1),
    ]
    if signals.TENSION in numbers:
        control.append(_on_rail(signals.STRAIN_AMPLIFIER, "amplifier of the strain", STRAIN_AMPLIFIER, 1))
    used = {wire.module: wire.index // wire.channels + 1 for wire in module_inputs(site.signals, numbers)}
    for name, title, row in (
        (signals.INPUTS, "inputs of the motion controller", INPUTS),
        (signals.ANALOG_INPUTS, "analog inputs of the motion controller", ANALOG_INPUTS),
    ):
        if name in used:
            control.append(_on_rail(name, title, row, used[name]))
    switched = sum(numbers.get(name, 0) for name in signals.SWITCHED)
    if switched:
        modules = math.ceil(switched / CHANNELS)
        control.append(_on_rail(signals.OUTPUTS, "outputs of the motion controller", OUTPUTS, modules))
    drawn = {own.part.id: own.number * own.row.power for own in control}
    (cabinet,) = site.near.of(CONTROL)
    surface, heat = _surface(cabinet), power_plan(tree, site.heads, drawn).heat
    carried, fan = fan_for(heat, surface) or (0.0, None)
    plan = power_plan(tree, site.heads, drawn if fan is None else drawn | {signals.FAN: fan.power})
    strip = terminals(terminal_levels(site.signals, tree))
    wired = _on_rail(signals.TERMINAL, "terminal", TERMINAL, strip)
    return CabinetCircuit(plan, (*_of_supply(plan), *control, wired), fan, passed(surface) + carried)


def _of_supply(plan: PowerPlan) -> Iterator[RailDevice]:
    """Terminals of the mains: three phases, N and PE; supplies, fuses."""
    yield _on_rail(signals.MAINS_TERMINAL, "terminal of the mains", mains_terminal(section_for(plan.main_fuse)), 5)
    for source in plan.sources:
        title = "power supply of the control" if source is plan.control else "power supply of the steppers"
        yield _on_rail(source.part, title, source.row, source.number, source.row.rated)
    yield _on_rail(signals.PROTECTOR, "fuses of 24 V", PROTECTOR, math.ceil(len(plan.protected) / _PROTECTED))
    if plan.steppers is not None:
        yield _on_rail(signals.BRAKING, "braking module of the steppers", BRAKING, 1)
    for fuse, number in sorted(plan.fuses.items(), key=lambda own: (own[0].row.size, own[0].rating)):
        yield _on_rail(part_id(f"fuse-{fuse.form}-{fuse.rating:g}"), "fuse", fuse.row, number)


_PROTECTED = 4
"""Channels of a protector."""


def _surface(cabinet: Extent) -> float:
    """Of the walls of a cabinet that stands with its rear at a loom [m²]: sides, front, roof."""
    wide, high, deep = (cabinet.high - cabinet.low).tolist()
    return float(2 * high * deep + wide * (high + deep))


def circuit(site: LoomSite, tree: Tree) -> Tree:
    """The devices on the rails of the mounting plate, row by row; those that have no room, past the lowest rail."""
    (control,) = site.near.of(CONTROL)
    made, size = circuit_of(site, tree), cabinet_size(site)
    left, front = float(control.low[0]) + WALL + RAIL_ENDS, float(control.high[2]) - WALL - PLATE
    heights = [float(control.low[1]) + height for height in size.rails]
    stands, rows = list[Occurrence](), 1
    for own, seats in made.rows(size.rail):
        positions = []
        for row, middle in seats:
            y = heights[row] if row < len(heights) else heights[-1] - (row - len(heights) + 1) * RAIL_PITCH
            positions.append(placed(left + middle, y, front - RAIL[1], TO_THE_BACK))
            rows = max(rows, row + 1)
        stands.append(Occurrence(own.part, tuple(positions)))
    rails = (placement(left, y, front - RAIL[1] / 2).after(ALONG_WIDTH) for y in heights[:rows])
    stands.append(Occurrence(_rail(size.rail), tuple(rails)))
    return Tree(
        (RigidBody(CIRCUIT, (*stands, *_in_the_door(control, made), _protection(control, made), _door(control))),)
    )


HANDLE = 0.7
"""Height of the main switch's handle over the floor, over the cabinet's: 0.6 to 1.9 m by IEC 60204-1, 5.3.4."""

_ASIDE, _FROM_END, _GRIP = (-90 * mm, 130 * mm), 200 * mm, 40 * mm
"""Axes of fan and main switch from the middle of the door, of fan and outlet from its ends; depth of a handle [m]."""


def _in_the_door(control: Extent, made: CabinetCircuit) -> Iterator[Occurrence]:
    """The main switch, its handle before the door, the mode selector over it, and the fan with its outlet."""
    middle, rear = float(control.low[0] + control.high[0]) / 2, float(control.low[2])
    low, high = float(control.low[1]), float(control.high[1])
    if made.fan is not None:
        x = middle + _ASIDE[0]
        fan = device(signals.FAN, "fan in the door of the cabinet", made.fan)
        outlet = device(signals.OUTLET, "outlet of the air in the door", outlet_of(made.fan))
        yield Occurrence(fan, (placement(x, low + _FROM_END, rear),))
        yield Occurrence(outlet, (placement(x, high - _FROM_END, rear),))
    switch_row = main_switch(made.plan.main_fuse)
    switch = device(signals.SWITCH, "main switch", switch_row)
    assert switch.shape is not None
    grip = Placed(box(_GRIP, _GRIP, _GRIP), (placement(z=-WALL - _GRIP),))
    shaped = replace(switch, shape=Sum((Placed(switch.shape), grip)))
    x, y = middle + _ASIDE[1], low + HANDLE * (high - low)
    yield Occurrence(shaped, (placement(x, y, rear),))
    mode = device(signals.MODE, "mode selector", MODE)
    yield Occurrence(mode, (placement(x, y + (switch_row.size[1] + MODE.size[1]) / 2 + _GRIP, rear),))


def _protection(control: Extent, made: CabinetCircuit) -> Occurrence:
    """The bar of the protective conductors at the foot of the plate: of the mains, of each amplifier and supply, of the
    cabinet, its door and the frame.
    """
    plan = made.plan
    fed = *(motor.number for motor in plan.motors), *(source.number for source in plan.sources)
    clamps = sum(fed) + _BONDED
    bar = device(signals.PROTECTIVE_BAR, "bar of the protective conductors", protective_bar(clamps))
    x, y = float(control.low[0] + control.high[0]) / 2, float(control.low[1]) + _BAR_HEIGHT
    deep = protective_bar(clamps).size[2]
    return Occurrence(bar, (placement(x, y, float(control.high[2]) - WALL - PLATE - deep),))


_BONDED, _BAR_HEIGHT = 4, 30 * mm
"""Protective conductors of mains, cabinet, door and frame; height of their bar over the cabinet's foot [m]."""


def _door(control: Extent) -> Occurrence:
    """The door of the cabinet, before its open side."""
    wide, high, _ = (control.high - control.low).tolist()
    shape = box(wide, high, WALL)
    bought = Bought(f"door {wide / mm:.0f} x {high / mm:.0f} mm, with lock", shape.volume * STEEL.density)
    hung = "its hinges on the wall of the cabinet, of its maker"
    door = bought_part(signals.DOOR, "door of the cabinet", "cabinet door", shape, bought, fixing=hung)
    x, y, _ = ((control.low + control.high) / 2).tolist()
    return Occurrence(door, (placement(x, y, float(control.low[2]) - WALL),))


def cabinet_size(site: LoomSite) -> CabinetSize:
    """The size of the cabinet that a loom has."""
    (control,) = site.near.of(CONTROL)
    wide, high, _ = (control.high - control.low).tolist()
    return CabinetSize(wide, high, sum(own.part == AMPLIFIER for own in site.near.extents))


def _rail(long: float) -> Part:
    """A mounting rail, from z = 0."""
    bought = Bought("TH 35-7.5", RAIL_MASS * long, length=long)
    size = format_quantity(long, "mm")
    shape = box(*RAIL, long)
    fixing = "screws M6 through its slots into the threads of the plate, EN 60715"
    return bought_part(
        part_id("mounting-rail"), "mounting rail", "mounting rail", shape, bought, size=size, fixing=fixing
    )


def circuit_checks(site: LoomSite, tree: Tree) -> tuple[Check, ...]:
    """Room for all devices on the rails, load of the supplies, heat of the cabinet; tree as in `circuit`."""
    made, size = circuit_of(site, tree), cabinet_size(site)
    plan, fewer = made.plan, "set fewer heads or weavers"
    loads = (
        at_most(
            f"control: load of its supplies of {own.row.volts:g} V",
            own.load,
            own.number * own.row.rated,
            "W",
            f"{own.number} x {own.row.name}; all consumers at their rated power",
        ).with_cure(fewer, own.part)
        for own in plan.sources
    )
    return (
        at_most(
            "control: length of its mounting rails",
            made.used(size.rail) * size.rail,
            len(size.rails) * size.rail,
            "mm",
            f"whole rails below {size.axes} amplifiers; {len(site.signals)} signals",
        ).with_cure(fewer, signals.TERMINAL, part_id("mounting-rail")),
        *loads,
        at_most(
            "control: heat in its cabinet",
            plan.heat,
            made.carried,
            "W",
            f"walls and fan at {WARMER:g} K over the room; IEC TR 60890",
        ).with_cure(fewer, CONTROL),
    )
