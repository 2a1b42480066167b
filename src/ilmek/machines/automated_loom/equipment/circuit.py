"""The safety circuit and the control's own devices in the cabinet, on mounting rails at its side walls.

Supply, motion controller, safety relay, and a level of a terminal for each signal that has an address [`signals`]. The
amplifiers of the axes stand on the rear wall [`standing_frame`]; the rails stand before them.
"""

import math
from collections.abc import Iterator

from ilmek.elements.field_devices import CONTROLLER, RELAY, SUPPLY, TERMINAL, FieldDevice
from ilmek.machines.automated_loom.equipment import signals
from ilmek.machines.automated_loom.equipment.devices import TO_THE_LEFT, TO_THE_RIGHT, device, placed
from ilmek.machines.automated_loom.equipment.site import LoomSite
from ilmek.machines.automated_loom.equipment.surroundings import CONTROL
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.standing_frame import WALL
from ilmek.part.extents import Extent
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import box
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.report import Check, at_most
from ilmek.units import format_quantity, mm, turn

RAIL, RAIL_MASS = (35 * mm, 7.5 * mm), 0.32
"""Width and height of a mounting rail [m], and its mass per length [kg/m]: EN 60715, TH 35-7.5."""

_FREE = 50 * mm
"""Of the cabinet's height above and below a rail [m]; assumed by this project."""

CIRCUIT = part_id("circuit")
"""Id of the body."""

_DEPTH = 125 * mm
"""Of the cabinet before its amplifiers [m]."""

_QUARTER = placement(about=(0.0, 0.0, 1.0), angle=turn / 4)

_DEVICES: tuple[tuple[str, str, FieldDevice], ...] = (
    (signals.SUPPLY, "power supply of the control", SUPPLY),
    (signals.CONTROLLER, "motion controller", CONTROLLER),
    (signals.RELAY, "safety relay", RELAY),
)


def terminals(site: LoomSite) -> int:
    """Terminals of two levels, a level for each signal."""
    return math.ceil(site.signals / 2)


def circuit(site: LoomSite) -> Tree:
    """The devices on both side walls of the cabinet; those of the right one only where the left one is full."""
    (control,) = site.near.of(CONTROL)
    long, base = _rail_length(control), float(control.low[1]) + _FREE
    height, stands = base, list[Occurrence]()
    for name, title, row in _DEVICES:
        height += row.size[0]
        position = _on_wall(control, height - row.size[0] / 2, left=True)
        stands.append(Occurrence(device(name, title, row), (position,)))
    number, wide = terminals(site), TERMINAL.size[0]
    left = min(number, int((base + long - height) / wide))
    levels = [(height + (k + 0.5) * wide, True) for k in range(left)]
    levels += [(base + (k + 0.5) * wide, False) for k in range(number - left)]
    terminal = device(signals.TERMINAL, "terminal of two signals", TERMINAL)
    stands.append(Occurrence(terminal, tuple(_on_wall(control, y, left=at) for y, at in levels)))
    stands.append(Occurrence(_rail(long), tuple(_rails(control, both=number > left))))
    return Tree((RigidBody(CIRCUIT, tuple(stands)),))


def _rail_length(control: Extent) -> float:
    return float(control.high[1] - control.low[1]) - 2 * _FREE


def _rail(long: float) -> Part:
    """A mounting rail, from z = 0."""
    bought = Bought("TH 35-7.5", RAIL_MASS * long, length=long)
    size = format_quantity(long, "mm")
    shape = box(*RAIL, long)
    return bought_part(part_id("mounting-rail"), "mounting rail", "mounting rail", shape, bought, size=size)


def _rails(control: Extent, *, both: bool) -> Iterator[Placement]:
    """Upright, on the side walls."""
    turned = placement(about=(1.0, 0.0, 0.0), angle=-turn / 4).after(_QUARTER)
    base, middle = float(control.low[1]) + _FREE, _middle(control)
    for x in (_wall(control, left=True), _wall(control, left=False))[: 1 + both]:
        towards = RAIL[1] / 2 if x < (control.low[0] + control.high[0]) / 2 else -RAIL[1] / 2
        yield placed(x + towards, base, middle, turned)


def _wall(control: Extent, *, left: bool) -> float:
    """Inner face of a side wall [m]."""
    return float(control.low[0]) + WALL if left else float(control.high[0]) - WALL


def _middle(control: Extent) -> float:
    """Middle of the devices' heights in the cabinet's depth [m]."""
    return float(control.low[2]) + _DEPTH / 2


def _on_wall(control: Extent, y: float, *, left: bool) -> Placement:
    """A device on a rail: its depth into the cabinet, its width upwards."""
    x = _wall(control, left=left) + (RAIL[1] if left else -RAIL[1])
    return placed(x, y, _middle(control), (TO_THE_RIGHT if left else TO_THE_LEFT).after(_QUARTER))


def circuit_checks(site: LoomSite) -> tuple[Check, ...]:
    """Whether the terminals of all signals have room on two rails."""
    (control,) = site.near.of(CONTROL)
    needed = math.fsum(row.size[0] for _, _, row in _DEVICES) + terminals(site) * TERMINAL.size[0]
    source = f"two side walls of the cabinet; {site.signals} signals, two on a terminal"
    return (
        at_most("control: length of its mounting rails", needed, 2 * _rail_length(control), "mm", source).with_cure(
            "set fewer heads or weavers", signals.TERMINAL, part_id("mounting-rail")
        ),
    )
