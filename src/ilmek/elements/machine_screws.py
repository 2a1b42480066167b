"""Screws of the property class 8.8, with a hexagon head and full thread, or a socket in a head that is sunk: sizes,
preload, what a group of them holds, and the holes and threads for them.

    F_p = 0.7 f_ub A_s,    F_s = mu (n F_p - 0.8 sum F_t) / gamma                [EN 1993-1-8, 3.9; ISO 898-1, ISO 4017]

    s_red = F / A_s sqrt(1 + 3 (3 d_2 / (2 d_s) tan)²) = 0.9 R_p0.2,    tan = P / (pi d_2) + 1.155 mu_t
    M = F (0.16 P + 0.58 d_2 mu_t + D_k mu_t / 2)                                    [VDI 2230-1, 5.4.3 and 5.5.2]

A screw that is tightened by a torque M is twisted too, so that its preload F is lower than F_p; mu_t is the friction of
thread and head, 0.12 oiled, d_s the diameter of A_s, D_k the mean one of the head's ring, 0.92 of its width, on a hole
of 1.1 d.           [ISO 4762 heads; ISO 273 medium holes; DIN 974-1 counterbores, series 1; ISO 7089 washers]

A screw that is preloaded presses the joined faces; their friction mu, 0.2 of faces as rolled [table 3.7, class D],
holds the force across it, n screws with the pulls F_t along them, gamma 1.25.
"""

import math
from dataclasses import dataclass

from ilmek.units import MPa, mm

TENSILE = 800 * MPa
"""f_ub of the class 8.8 [Pa]."""

YIELD, USED = 640 * MPa, 0.9
"""R_p0.2 of the class 8.8 [Pa], and the share of it to which a screw is tightened."""

FRICTION, PARTIAL = 0.2, 1.25

OILED = 0.12
"""Friction of thread and head of an oiled screw [VDI 2230-1, table A5, class B]."""

EDGE = 1.2
"""Least distance of a screw's axis from an edge over its diameter [EN 1993-1-8, table 3.3]."""

LENGTHS = tuple(length * mm for length in (16, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 80, 90, 100))
"""Lengths of screws [m]."""


@dataclass(frozen=True, slots=True)
class MachineScrew:
    """A screw: diameter of its thread [m], stress area [m²], width across flats or diameter and height of its head [m].

    hole, sink  diameters of the hole for it and of the counterbore for its head [m]; 0: it is not sunk
    washer  diameter and thickness of the washer under its head [m]; 0: none, it is sunk
    """

    name: str
    diameter: float
    area: float
    across: float
    head: float
    hole: float = 0.0
    sink: float = 0.0
    washer: tuple[float, float] = (0.0, 0.0)

    @property
    def preload(self) -> float:
        """F_p [N].

        >>> round(SCREWS["M12"].preload)
        47208
        """
        return 0.7 * TENSILE * self.area

    @property
    def key(self) -> float:
        """Width across flats of the key that turns it [m]: of its head, or of the socket in it [ISO 4762].

        >>> SOCKET_SCREWS["M6"].key, SCREWS["M10"].key
        (0.005, 0.016)
        """
        return SOCKETS[self.name] * mm if self.sink else self.across

    @property
    def pitch(self) -> float:
        """Pitch of its thread [m], from its stress area: d_s = d - 0.9382 P [ISO 898-1].

        >>> round(SCREWS["M12"].pitch, 5)
        0.00175
        """
        return (self.diameter - math.sqrt(4 * self.area / math.pi)) / 0.9382

    @property
    def tightened(self) -> float:
        """Preload F by the tightening torque [N]; VDI 2230-1, table A1: 29.6 kN of M10.

        >>> round(SCREWS["M10"].tightened, -2)
        29600.0
        """
        stressed, flank = math.sqrt(4 * self.area / math.pi), self._flank
        slope = self.pitch / (math.pi * flank) + 1.155 * OILED
        return USED * YIELD * self.area / math.sqrt(1 + 3 * (1.5 * flank / stressed * slope) ** 2)

    @property
    def torque(self) -> float:
        """Tightening torque M [N m]; VDI 2230-1, table A1: 48 N m of M10, by the head's ring of that size.

        >>> round(SCREWS["M10"].torque, 1)
        48.6
        """
        ring = (0.92 * self.across + 1.1 * self.diameter) / 2
        return self.tightened * (0.16 * self.pitch + (0.58 * self._flank + ring / 2) * OILED)

    @property
    def _flank(self) -> float:
        """d_2 [m]."""
        return self.diameter - 0.6495 * self.pitch

    def slip(self, number: int, pull: float = 0.0) -> float:
        """Force across that a number of screws hold by friction [N], with the sum of pulls along them [N].

        >>> round(SCREWS["M12"].slip(4))
        30213
        """
        return FRICTION * (number * self.preload - 0.8 * pull) / PARTIAL

    def length_for(self, most: float) -> float:
        """The longest screw up to a length [m]; the shortest of all where none is."""
        return max((length for length in LENGTHS if length <= most + 1e-9), default=LENGTHS[0])

    def engaged(self, material: str) -> float:
        """Usual least length of its thread in a material, by its name [m].

        >>> SOCKET_SCREWS["M4"].engaged("aluminium alloy"), SOCKET_SCREWS["M4"].engaged("structural steel")
        (0.006, 0.004)
        """
        return self.diameter * (_IN_SOFT if material in _SOFT else 1.0)

    def designation(self, length: float) -> str:
        """As ordered, with its washer.

        >>> SCREWS["M12"].designation(0.04)
        'ISO 4017 - M12 x 40 - 8.8 with washer ISO 7089 - 12 - 200 HV'
        """
        washer = f" with washer ISO 7089 - {self.diameter / mm:g} - 200 HV" if self.washer[1] else ""
        return f"{_SUNK if self.sink else _HEXAGON} - {self.name} x {length / mm:g} - 8.8{washer}"


SCREWS = {
    name: MachineScrew(name, diameter * mm, area * mm**2, across * mm, head * mm, washer=(washer * mm, thickness * mm))
    for name, diameter, area, across, head, washer, thickness in (
        ("M6", 6, 20.1, 10, 4.0, 12, 1.6),
        ("M8", 8, 36.6, 13, 5.3, 16, 1.6),
        ("M10", 10, 58.0, 16, 6.4, 20, 2.0),
        ("M12", 12, 84.3, 18, 7.5, 24, 2.5),
        ("M14", 14, 115.0, 21, 8.8, 28, 2.5),
        ("M16", 16, 157.0, 24, 10.0, 30, 3.0),
        ("M20", 20, 245.0, 30, 12.5, 37, 3.0),
        ("M24", 24, 353.0, 36, 15.0, 44, 4.0),
    )
}
"""By thread, ascending: stress areas of ISO 898-1, table 4, heads of ISO 4017, washers of ISO 7089."""


SOCKET_SCREWS = {
    name: MachineScrew(name, diameter * mm, area * mm**2, across * mm, diameter * mm, hole * mm, sink * mm)
    for name, diameter, area, across, hole, sink in (
        ("M2", 2.0, 2.07, 3.8, 2.4, 4.3),
        ("M2.5", 2.5, 3.39, 4.5, 2.9, 5.0),
        ("M3", 3.0, 5.03, 5.5, 3.4, 6.5),
        ("M4", 4.0, 8.78, 7.0, 4.5, 8.0),
        ("M5", 5.0, 14.2, 8.5, 5.5, 10.0),
        ("M6", 6.0, 20.1, 10.0, 6.6, 11.0),
        ("M8", 8.0, 36.6, 13.0, 9.0, 15.0),
        ("M10", 10.0, 58.0, 16.0, 11.0, 18.0),
        ("M12", 12.0, 84.3, 18.0, 13.5, 20.0),
        ("M16", 16.0, 157.0, 24.0, 17.5, 26.0),
    )
}
"""By thread, ascending: heads of ISO 4762, as high as the thread is wide, holes and counterbores for them."""

SOCKETS = {
    "M2": 1.5, "M2.5": 2.0, "M3": 2.5, "M4": 3.0, "M5": 4.0, "M6": 5.0, "M8": 6.0, "M10": 8.0, "M12": 10.0, "M16": 14.0,
    "M20": 17.0,
}  # fmt: skip
"""Width across flats of the sockets of ISO 4762, by thread [mm]."""

CORES = {
    diameter * mm: (core * mm, pitch * mm)
    for diameter, core, pitch in (
        (2, 1.6, 0.4), (2.5, 2.05, 0.45), (3, 2.5, 0.5), (4, 3.3, 0.7), (5, 4.2, 0.8), (6, 5.0, 1.0), (8, 6.8, 1.25),
        (10, 8.5, 1.5), (12, 10.2, 1.75), (14, 12.0, 2.0), (16, 14.0, 2.0), (20, 17.5, 2.5), (24, 21.0, 3.0),
    )
}  # fmt: skip
"""Diameters of drills for coarse threads, and pitches [m], by the diameter of the thread [ISO 2306, ISO 261]."""

RUN_OUT = 3.0
"""Depth of a drilled core below its thread over the pitch: about the short run-out of DIN 76-1."""


def core_of(diameter: float) -> tuple[float, float] | None:
    """Diameter of the core of a coarse thread, and by how much it is drilled deeper [m]; None: it is of no such thread.

    >>> core_of(0.004)
    (0.0033, 0.0021)
    """
    row = next((row for size, row in CORES.items() if abs(size - diameter) < _SAME_SIZE), None)
    return None if row is None else (row[0], round(RUN_OUT * row[1], 6))


_SAME_SIZE = 1e-6

SOCKET_LENGTHS = tuple(
    length * mm
    for length in (4, 5, 6, 8, 10, 12, 16, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 80, 90, 100, 110, 120, 130, 140)
)
"""Lengths of socket screws [m]."""

_SOFT, _IN_SOFT = frozenset({"aluminium alloy", "tin bronze", "POM", "beech"}), 1.5
"""Materials in which threads are longer, and their length over the diameter, 1 in steel [VDI 2230-1, 5.5.5]."""

_HEXAGON, _SUNK = "ISO 4017", "ISO 4762"


def screw_of(designation: str) -> MachineScrew | None:
    """The screw of a designation as ordered; None for that of anything else.

    >>> screw_of("ISO 4017 - M12 x 40 - 8.8") is SCREWS["M12"], screw_of("DIN 6885-1 B 5 x 5 x 8")
    (True, None)
    """
    standard, _, size = designation.partition(" - ")
    rows = {_HEXAGON: SCREWS, _SUNK: SOCKET_SCREWS}.get(standard, {})
    return rows.get(size.partition(" x ")[0])


@dataclass(frozen=True, slots=True)
class FourScrews:
    """Four screws of a square plate that bears a force across their axes, at a lever over the plate's face.

    side  of the plate [m]      force  across [N]      lever  of the force over the face [m]
    pitch, given  of neighbouring screws [m], and their size, of a plate that is bought; 0, None: by the force
    """

    side: float
    force: float
    lever: float
    pitch: float = 0.0
    given: MachineScrew | None = None

    def distance(self, screw: MachineScrew) -> float:
        """Of neighbouring screws [m]: each stands 1.2 of its diameter off the edges, if the plate is not bought."""
        return self.pitch or self.side - 2 * EDGE * screw.diameter

    def pull(self, screw: MachineScrew) -> float:
        """Sum of the pulls along the two screws that the lever strains [N]."""
        return self.force * self.lever / self.distance(screw)

    def holds(self, screw: MachineScrew) -> float:
        """Force across that they hold [N]."""
        return screw.slip(4, self.pull(screw))

    @property
    def screw(self) -> MachineScrew:
        """That for which the plate is drilled; else the smallest that holds the force, the largest where none does."""
        if self.given is not None:
            return self.given
        offered = [screw for screw in SCREWS.values() if screw.diameter < 0.2 * self.side] or [SCREWS["M6"]]
        return next((one for one in offered if self.holds(one) >= self.force), offered[-1])
