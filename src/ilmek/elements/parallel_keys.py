"""Parallel keys between a shaft and its hub: length by surface pressure.

    p = 2 T / (n f d (h - t1) l) <= Re / 1.5                   [DIN 6892, method C; Roloff/Matek, 12.2: one-sided load]

d is the shaft's diameter, h the key's height, t1 the depth of its groove in the shaft, l its bearing length (form B,
with plane ends, in a groove that is open to the end), Re the least yield strength of shaft, key and hub, of C45 by its
size. No more than 1.3 d of it bears, over which the method holds. Where one key is not enough two lie opposite (n = 2),
of which f = 0.75 bears; f = 1 of one. Sections, grooves and shortest lengths: `keyways`. One key lies through all hubs
of a stack: of the length that they need together, beyond the longest of DIN 6885 cut from key steel.
"""

import math
from functools import lru_cache

from ilmek.elements.keyways import Keyway, keyway_for
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.units import MPa, format_quantity, mm

LENGTHS = tuple(
    length * mm
    for length in (
        *(6, 8, 10, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40, 45, 50, 56, 63, 70, 80, 90, 100, 110, 125, 140),
        *(160, 180, 200, 220, 250, 280, 320, 360),
    )
)
"""Lengths of keys [m]: DIN 6885-1; of a section those from its shortest to its longest."""

_STRENGTHS = ((16 * mm, 490 * MPa), (40 * mm, 430 * MPa), (math.inf, 370 * MPa))
"""Largest size, and yield strength of C45 +QT [Pa]: EN 10083-2; also of a reducer's hollow shaft, assumed."""

BEARING = {1: 1.0, 2: 0.75}
"""Share f of a number of keys that bears."""

SAFETY, LONGEST = 1.5, 1.3
"""Yield strength over the allowed pressure, and length over the diameter."""


@record
class KeyedEnd:
    """The end of a shaft with a hub.

    diameter, length   of the shaft, of the key [m]      torque  [N m]      strength  of the shaft [Pa]
    number             of keys, 1 or 2                   hub     length in the hub [m]; 0: that of the key
    """

    diameter: float
    length: float
    torque: float
    strength: float
    number: int = 1
    hub: float = 0.0

    @property
    def keyway(self) -> Keyway:
        """Section of the key and its grooves."""
        return keyway_for(self.diameter)

    @property
    def pressure(self) -> float:
        """Surface pressure of the key [Pa]."""
        bearing = (self.keyway.height - self.keyway.in_shaft) * (self.hub or self.length)
        return 2 * self.torque / (self.number * BEARING[self.number] * self.diameter * bearing)

    @property
    def allowed(self) -> float:
        """Allowed surface pressure [Pa]."""
        hub = next(strength for size, strength in _STRENGTHS if self.diameter <= size + 1e-9)
        return min(self.strength, hub) / SAFETY

    @property
    def designation(self) -> str:
        """As ordered: a key, or key steel where no key of the section is as long as its hubs together."""
        row, kept = self.keyway, self.length in lengths_of(self.keyway)
        size = " x ".join(format_quantity(size, "mm")[:-3] for size in (row.width, row.height, self.length))
        return f"DIN 6885-1 B {size}" if kept else f"DIN 6880 C45+C {size}"

    def check(self, title: str, cure: str, parts: tuple[str, ...]) -> Check:
        """Surface pressure of the key."""
        source = f"{self.number} key{'s' * (self.number > 1)} {self.designation}; DIN 6892, method C"
        return at_most(f"key of the {title}", self.pressure, self.allowed, "MPa", source).with_cure(cure, *parts)


def lengths_of(row: Keyway) -> tuple[float, ...]:
    """Lengths of the keys of a section [m].

    >>> [round(length * 1e3) for length in lengths_of(keyway_for(0.008))]
    [6, 8, 10, 12, 14, 16, 18, 20]
    """
    return tuple(length for length in LENGTHS if row.shortest - mm / 2 < length < row.longest + mm / 2)


@lru_cache(maxsize=256)
def keyed_end(diameter: float, torque: float, strength: float) -> KeyedEnd:
    """The end with the shortest key that bears a torque [N m], else with two; with the two longest where none does.

    Raises ParameterError for a diameter without a key.

    >>> keyed_end(0.030, 120.0, 235e6).designation
    'DIN 6885-1 B 8 x 7 x 18'
    """
    lengths = [length for length in lengths_of(keyway_for(diameter)) if length <= LONGEST * diameter]
    ends = (KeyedEnd(diameter, length, torque, strength, number) for number in BEARING for length in lengths)
    return next(
        (end for end in ends if end.pressure <= end.allowed),
        KeyedEnd(diameter, lengths[-1], torque, strength, max(BEARING)),
    )
