"""What feeds a machine in its cabinet: supplies of direct current, fuses, the main switch; its heat, and its fans.

    supply     1.25 of the load is what one, or several side by side, are rated for       [makers: 80 % of the rating]
    heat       P <= k A dT + P fan,   P fan = V dT / 3.1     k 5.5 W/m²K of painted sheet steel, A free surface [m²],
                                                             V flow of air [m³/h]              [IEC TR 60890; makers]

Sizes, masses and efficiencies are those that makers have in common; a part of another make differs by some millimetres.
"""

import math
from dataclasses import dataclass, replace
from functools import cache

from ilmek.elements.field_devices import FieldDevice
from ilmek.units import g, mm

CLASS = "class of catalogue parts; makers differ by some millimetres"


@dataclass(frozen=True, slots=True)
class PowerSupply(FieldDevice):
    """A supply of direct current: voltage [V], rated current [A], phases of its mains, efficiency, inrush [A²s]."""

    volts: float = 24.0
    amperes: float = 0.0
    phases: int = 1
    efficiency: float = 0.94
    inrush: float = 4.0

    @property
    def rated(self) -> float:
        """Power that it gives [W]."""
        return self.volts * self.amperes


_SIZES = (
    (240.0, (60, 120, 115), 900 * g, 1),
    (480.0, (85, 125, 130), 1.5, 1),
    (960.0, (110, 125, 150), 2.4, 3),
)
"""Rated power [W], size [mm], mass [kg], phases of the mains of supplies."""

SUPPLIES = tuple(
    PowerSupply(
        f"power supply {volts:g} V, {power / volts:g} A" + (", 3 phases, for parallel mode" if phases == 3 else ""),
        "power supply",
        (size[0] * mm, size[1] * mm, size[2] * mm),
        mass,
        CLASS,
        volts=volts,
        amperes=power / volts,
        phases=phases,
    )
    for volts in (24.0, 48.0)
    for power, size, mass, phases in _SIZES
)

LOADED = 1.25
"""Rated power of supplies over their load."""


def supply_for(volts: float, load: float) -> tuple[PowerSupply, int]:
    """The least supply of a voltage for a load [W], or so many of the largest side by side.

    >>> [(row.name, number) for row, number in (supply_for(24.0, 100.0), supply_for(48.0, 2800.0))]
    [('power supply 24 V, 10 A', 1), ('power supply 48 V, 20 A, 3 phases, for parallel mode', 4)]
    """
    rows = [row for row in SUPPLIES if row.volts == volts]
    row = next((row for row in rows if row.rated >= LOADED * load), rows[-1])
    return row, max(1, math.ceil(LOADED * load / row.rated - 1e-9))


def _device(name: str, kind: str, size: tuple[float, float, float], mass: float, source: str = CLASS) -> FieldDevice:
    wide, high, deep = size
    return FieldDevice(name, kind, (wide * mm, high * mm, deep * mm), mass, source)


BRAKING = _device("braking module 48 V, with resistor", "braking module", (40, 120, 115), 600 * g)
"""It burns what steppers give back while they brake: one on the bars of 48 V."""

PROTECTOR = _device("circuit protector 24 V, 4 x 6 A", "circuit protector", (45, 90, 115), 250 * g, "UL 2367")
"""It parts the wires of 24 V in groups: control, sensors, safety circuit, brakes."""

_FUSES = (
    (4.0, 60.0, "5x20", "T H", _device("fuse terminal 5 x 20 mm", "fuse", (8.2, 80, 60), 25 * g, "IEC 60127-2")),
    (25.0, 500.0, "10x38", "gG", _device("fuse holder 10 x 38 mm", "fuse", (17.5, 85, 62), 70 * g, "IEC 60269-2")),
    (50.0, 500.0, "14x51", "gG", _device("fuse holder 14 x 51 mm", "fuse", (26, 110, 75), 130 * g, "IEC 60269-2")),
    (100.0, 690.0, "22x58", "gG", _device("fuse holder 22 x 58 mm", "fuse", (35, 125, 77), 300 * g, "IEC 60269-2")),
    (math.inf, 690.0, "nh00", "gG", _device("fuse base NH 00", "fuse", (36, 125, 85), 350 * g, "IEC 60269-2")),
)
"""Largest rating [A] and voltage [V], form, characteristic and holder of fuses. Those of 5 x 20 mm break 1.5 kA: they
stand behind supplies of direct current alone, those on the mains break 100 kA (IEC 60127-2, sheet 5; IEC 60269-2).
"""

_SWITCHES = (25.0, 40.0, 63.0, 100.0, 160.0, 250.0)
"""Rated currents of main switches [A]."""


@dataclass(frozen=True, slots=True)
class Fuse:
    """A fuse of one pole with its holder: rating [A], form, row as ordered."""

    rating: float
    form: str
    row: FieldDevice


@cache
def fuse_of(rating: float, volts: float) -> Fuse:
    """The fuse of a rating [A] at a voltage [V].

    >>> fuse_of(16.0, 230.0).row.name, fuse_of(2.0, 48.0).row.name, fuse_of(2.0, 400.0).form
    ('fuse holder 10 x 38 mm, 16 A gG', 'fuse terminal 5 x 20 mm, 2 A T H', '10x38')
    """
    offered = (own for own in _FUSES if volts <= own[1] and not rating > own[0])
    _, _, form, kind, row = next(offered)
    return Fuse(rating, form, replace(row, name=f"{row.name}, {rating:g} A {kind}"))


def main_switch(fuse: float) -> FieldDevice:
    """The lockable main switch behind main fuses of a rating [A], its handle before the door that holds it.

    >>> main_switch(20.0).name
    'main switch 4 poles, 25 A, lockable, for a door'
    """
    rated = next((rated for rated in _SWITCHES if rated >= fuse), _SWITCHES[-1])
    wide = 70 if rated <= 63 else 105
    row = _device(f"main switch 4 poles, {rated:g} A, lockable, for a door", "main switch", (wide, 90, 80), 400 * g)
    return replace(row, source="IEC 60947-3", fixing="four screws M4 through the door into its handle")


def mains_terminal(section: float) -> FieldDevice:
    """The terminal of a wire from the mains by its section [mm²].

    >>> mains_terminal(6.0).name
    'terminal 6 mm²'
    """
    widths = {4.0: 6.2, 6.0: 8.2, 10.0: 10.2, 16.0: 12.2, 35.0: 16.2, 70.0: 20.5, 120.0: 31.0}
    taken, wide = next(((own, wide) for own, wide in widths.items() if own >= section), (120.0, 31.0))
    return _device(f"terminal {taken:g} mm²", "terminal", (wide, 60, 48), 30 * g, "IEC 60947-7-1")


def protective_bar(clamps: int) -> FieldDevice:
    """The bar of the protective conductors, with so many clamps.

    >>> protective_bar(20).size[0]
    0.2
    """
    bar = _device(f"PE bar, {clamps} clamps 6 mm²", "protective bar", (clamps * 8.0 + 40.0, 12, 20), 15 * g * clamps)
    return replace(bar, fixing="two screws M6 into the threads of the plate")


WARMER, THROUGH = 20.0, 5.5
"""Temperature in a cabinet over that of its room [K], at most: 55 °C at 35 °C; and what its walls pass [W/m²K]."""

_AIR = 3.1
"""Flow of air [m³/h] that carries 1 W at 1 K."""

_SNAPPED = "its clips snap into its cut-out in the door"

FANS = tuple(
    (flow, replace(_device(f"filter fan, {flow:g} m³/h", "fan", size, mass), power=power, fixing=_SNAPPED))
    for flow, size, mass, power in (
        (60.0, (150, 150, 60), 900 * g, 8.0),
        (180.0, (250, 250, 70), 1.8, 20.0),
        (400.0, (290, 290, 90), 3.0, 45.0),
        (900.0, (290, 290, 130), 5.0, 95.0),
    )
)
"""Flow of air [m³/h] and fans that blow it, on 24 V."""


def passed(area: float) -> float:
    """Heat that walls of an area pass [W].

    >>> round(passed(2.0), 9)
    220.0
    """
    return THROUGH * area * WARMER


def outlet_of(fan: FieldDevice) -> FieldDevice:
    """The filter through which the air of a fan leaves, with its frame.

    >>> outlet_of(FANS[0][1]).name
    'outlet filter, 60 m³/h'
    """
    wide, high, _ = fan.size
    name = fan.name.replace("filter fan", "outlet filter")
    return replace(fan, name=name, kind="outlet filter", size=(wide, high, _OUTLET), mass=0.5, power=0.0)


_OUTLET = 25 * mm
"""Depth of an outlet filter [m]."""


def fan_for(heat: float, area: float) -> tuple[float, FieldDevice] | None:
    """Heat that a fan carries [W], and the fan, for the heat that walls of an area do not pass; None: they do.

    Where none is enough it is the largest.
    """
    left = heat - passed(area)
    if left <= 0:
        return None
    return next(
        ((flow * WARMER / _AIR, row) for flow, row in FANS if flow * WARMER / _AIR >= left),
        (FANS[-1][0] * WARMER / _AIR, FANS[-1][1]),
    )
