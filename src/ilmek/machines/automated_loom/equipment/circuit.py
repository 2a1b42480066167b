"""What stands in the cabinet on mounting rails at its side walls: supply, fuses, safety circuit, control, terminals.

Fuses; supplies of 24 V and of 48 V, with what burns the energy of braking steppers [`power_plan`]; motion controller,
safety relay, input modules, and the terminals of all that is outside [`terminals`]. The amplifiers of the axes stand on
the rear wall [`standing_frame`], over the bar of the protective conductors; the rails stand before them. The door has
the main switch, whose handle is outside, and a fan with its outlet where the walls do not pass the heat.
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
    OUTPUTS,
    RELAY,
    STRAIN_AMPLIFIER,
    TERMINAL,
    FieldDevice,
)
from ilmek.elements.wiring import section_for
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.devices import TO_THE_LEFT, TO_THE_RIGHT, device, placed
from ilmek.machines.automated_loom.equipment.power_plan import PowerPlan, power_plan
from ilmek.machines.automated_loom.equipment.site import LoomSite
from ilmek.machines.automated_loom.equipment.surroundings import CONTROL
from ilmek.machines.automated_loom.equipment.terminals import module_inputs, terminal_levels, terminals
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.standing_frame import RAIL_ENDS, WALL
from ilmek.part.extents import Extent
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import Placed, Sum, box
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.units import format_quantity, mm, turn

RAIL, RAIL_MASS = (35 * mm, 7.5 * mm), 0.32
"""Width and height of a mounting rail [m], and its mass per length [kg/m]: EN 60715, TH 35-7.5."""

CIRCUIT = part_id("circuit")
"""Id of the body."""

GROWING = frozenset(("terminal", "fuse", "power supply"))
"""Processes of what there is more of, or larger, for more motors and signals."""

_DEPTH = 125 * mm
"""Of the cabinet before its amplifiers [m]."""

_QUARTER = placement(about=(0.0, 0.0, 1.0), angle=turn / 4)


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

    @property
    def length(self) -> float:
        """Of the rails that all devices take [m]."""
        return math.fsum(own.number * own.row.size[0] for own in self.devices)


def _on_rail(name: str, title: str, row: FieldDevice, number: int, power: float = 0.0) -> RailDevice:
    return RailDevice(replace(device(name, title, row, power), fixing="snaps onto its rail, EN 60715"), row, number)


@lru_cache(maxsize=8)
def circuit_of(site: LoomSite, tree: Tree) -> CabinetCircuit:
    """The circuit of a loom; tree: all its bodies but those of the circuit."""
    numbers = {part.id: number for part, number in tree.occurrences()}
    control = [
        _on_rail(signals.CONTROLLER, "motion controller", CONTROLLER, 1),
        _on_rail(signals.RELAY, "safety relay", RELAY, 1),
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
    """The devices on both side walls of the cabinet; those of the right one only where the left one is full."""
    (control,) = site.near.of(CONTROL)
    made, long, base = circuit_of(site, tree), rail_length(control), float(control.low[1]) + RAIL_ENDS
    stands, height, left = list[Occurrence](), base, True
    for own in made.devices:
        wide, positions = own.row.size[0], []
        for _ in range(own.number):
            if left and height + wide > base + long:
                height, left = base, False
            positions.append(_on_wall(control, height + wide / 2, left=left))
            height += wide
        stands.append(Occurrence(own.part, tuple(positions)))
    stands.append(Occurrence(_rail(long), tuple(_rails(control, both=not left))))
    return Tree(
        (RigidBody(CIRCUIT, (*stands, *_in_the_door(control, made), _protection(control, made), _door(control))),)
    )


HANDLE = 0.7
"""Height of the main switch's handle over the floor, over the cabinet's: 0.6 to 1.9 m by IEC 60204-1, 5.3.4."""

_ASIDE, _FROM_END, _GRIP = (-90 * mm, 130 * mm), 200 * mm, 40 * mm
"""Axes of fan and main switch from the middle of the door, of fan and outlet from its ends; depth of a handle [m]."""


def _in_the_door(control: Extent, made: CabinetCircuit) -> Iterator[Occurrence]:
    """The main switch, its handle before the door, and the fan with its outlet above it."""
    middle, rear = float(control.low[0] + control.high[0]) / 2, float(control.low[2])
    low, high = float(control.low[1]), float(control.high[1])
    if made.fan is not None:
        x = middle + _ASIDE[0]
        fan = device(signals.FAN, "fan in the door of the cabinet", made.fan)
        outlet = device(signals.OUTLET, "outlet of the air in the door", outlet_of(made.fan))
        yield Occurrence(fan, (placement(x, low + _FROM_END, rear),))
        yield Occurrence(outlet, (placement(x, high - _FROM_END, rear),))
    switch = device(signals.SWITCH, "main switch", main_switch(made.plan.main_fuse))
    assert switch.shape is not None
    grip = Placed(box(_GRIP, _GRIP, _GRIP), (placement(z=-WALL - _GRIP),))
    shaped = replace(switch, shape=Sum((Placed(switch.shape), grip)))
    yield Occurrence(shaped, (placement(middle + _ASIDE[1], low + HANDLE * (high - low), rear),))


def _protection(control: Extent, made: CabinetCircuit) -> Occurrence:
    """The bar of the protective conductors at the foot of the rear wall: of the mains, of each amplifier and supply, of
    the cabinet, its door and the frame.
    """
    plan = made.plan
    fed = *(motor.number for motor in plan.motors), *(source.number for source in plan.sources)
    clamps = sum(fed) + _BONDED
    bar = device(signals.PROTECTIVE_BAR, "bar of the protective conductors", protective_bar(clamps))
    x, y = float(control.low[0] + control.high[0]) / 2, float(control.low[1]) + _BAR_HEIGHT
    deep = protective_bar(clamps).size[2]
    return Occurrence(bar, (placement(x, y, float(control.high[2]) - WALL - deep),))


_BONDED, _BAR_HEIGHT = 4, 30 * mm
"""Protective conductors of mains, cabinet, door and frame; height of their bar over the cabinet's foot [m]."""


def _door(control: Extent) -> Occurrence:
    """The door of the cabinet, before its open side."""
    wide, high, _ = (control.high - control.low).tolist()
    shape = box(wide, high, WALL)
    bought = Bought(f"door {wide / mm:.0f} x {high / mm:.0f} mm, with lock", shape.volume * STEEL.density)
    door = bought_part(signals.DOOR, "door of the cabinet", "cabinet door", shape, bought)
    x, y, _ = ((control.low + control.high) / 2).tolist()
    return Occurrence(door, (placement(x, y, float(control.low[2]) - WALL),))


def rail_length(control: Extent) -> float:
    """Length of a mounting rail in the cabinet [m]."""
    return float(control.high[1] - control.low[1]) - 2 * RAIL_ENDS


def _rail(long: float) -> Part:
    """A mounting rail, from z = 0."""
    bought = Bought("TH 35-7.5", RAIL_MASS * long, length=long)
    size = format_quantity(long, "mm")
    shape = box(*RAIL, long)
    fixing = "screws M6 through its slots into the nuts of the cabinet's wall, EN 60715"
    return bought_part(
        part_id("mounting-rail"), "mounting rail", "mounting rail", shape, bought, size=size, fixing=fixing
    )


def _rails(control: Extent, *, both: bool) -> Iterator[Placement]:
    """Upright, on the side walls."""
    turned = placement(about=(1.0, 0.0, 0.0), angle=-turn / 4).after(_QUARTER)
    base, middle = float(control.low[1]) + RAIL_ENDS, _depth(control)
    for x in (_wall(control, left=True), _wall(control, left=False))[: 1 + both]:
        towards = RAIL[1] / 2 if x < (control.low[0] + control.high[0]) / 2 else -RAIL[1] / 2
        yield placed(x + towards, base, middle, turned)


def _wall(control: Extent, *, left: bool) -> float:
    """Inner face of a side wall [m]."""
    return float(control.low[0]) + WALL if left else float(control.high[0]) - WALL


def _depth(control: Extent) -> float:
    """Middle of the devices' heights in the cabinet's depth [m]."""
    return float(control.low[2]) + _DEPTH / 2


def _on_wall(control: Extent, y: float, *, left: bool) -> Placement:
    """A device on a rail: its depth into the cabinet, its width upwards."""
    x = _wall(control, left=left) + (RAIL[1] if left else -RAIL[1])
    return placed(x, y, _depth(control), (TO_THE_RIGHT if left else TO_THE_LEFT).after(_QUARTER))


def circuit_checks(site: LoomSite, tree: Tree) -> tuple[Check, ...]:
    """Room for all devices on two rails, load of the supplies, heat of the cabinet; tree as in `circuit`."""
    (control,) = site.near.of(CONTROL)
    made = circuit_of(site, tree)
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
            made.length,
            2 * rail_length(control),
            "mm",
            f"two side walls of the cabinet; {len(site.signals)} signals",
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
