"""Synchronous belts: pulleys, length, teeth in mesh, forces; belts of stock pitches.

    L = 2 a cos φ + π (r1 + r2) + 2 φ (r2 - r1),   sin φ = (r2 - r1) / a,   r = p z / 2 π
    zm = z1 (π - 2 φ) / 2 π,   Fu = T / r1,   Fv >= Fu / 2

p pitch, z teeth, a distance of the axes, r1 <= r2 pitch radii, zm teeth of the small pulley in mesh, Fu pull, Fv
pretension of each side: at the least pretension the slack side has no force, the tight side Fv + Fu / 2.
                                                                                  [ISO 5295; exact, uncrossed belt]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.errors import ParameterError
from ilmek.report import Contour
from ilmek.units import format_quantity, mm


@dataclass(frozen=True, slots=True)
class PulleyGroove:
    """A groove between the teeth of a pulley [m].

    offset  u, from the tips of the teeth to the pitch line        width  at the tips        depth
    flank   half of the angle between its sides [rad]              round  its floor is half a circle
    """

    offset: float
    width: float
    depth: float
    flank: float
    round: bool


@dataclass(frozen=True, slots=True)
class BeltType:
    """A profile of belts.

    pitch  [m]      widths  available [m]      least_teeth  of a pulley
    groove      of its pulleys
    pull   allowed pull of a tooth in mesh per width [N/m], at rest (a third less at 1000 rpm); None: not known
    mass   over length and width [kg/m²]; nan: not known
    """

    name: str
    pitch: float
    widths: tuple[float, ...]
    least_teeth: int
    groove: PulleyGroove
    pull: float | None
    mass: float

    def pitch_radius(self, teeth: int) -> float:
        """Pitch radius of a pulley [m]: p z / 2 pi."""
        return self.pitch * teeth / (2 * math.pi)

    def tip_radius(self, teeth: int) -> float:
        """Radius of a pulley over its teeth [m]: the pitch line runs u outside of it.

        >>> round(2e3 * BELTS["HTD 5M"].tip_radius(20), 2), round(2e3 * BELTS["T5"].tip_radius(20), 2)
        (30.69, 31.0)
        """
        return self.pitch_radius(teeth) - self.groove.offset

    def pulley_outline(self, teeth: int) -> Contour:
        """Outline of a pulley about the origin, a groove in +x, counter-clockwise [m].

        Raises ParameterError for less teeth than the profile allows.
        """
        if teeth < self.least_teeth:
            raise ParameterError(f"a pulley of {teeth} teeth for {self.name}", allowed=f"{self.least_teeth} or more")
        tip, own = self.tip_radius(teeth), self.groove
        half, foot = own.width / 2, own.width / 2 - own.depth * math.tan(own.flank)
        floor = tip - own.depth + (foot if own.round else 0.0)
        side = math.sqrt(tip**2 - half**2)
        corners = np.array([side - 1j * half, floor - 1j * foot, floor + 1j * foot, side + 1j * half])
        land = 2 * math.pi / teeth - 2 * math.asin(half / tip)
        turned = np.exp(2j * math.pi / teeth * np.arange(teeth))
        bulges = np.array([0.0, -1.0 if own.round else 0.0, 0.0, math.tan(land / 4)])
        return Contour(np.outer(turned, corners).ravel(), np.tile(bulges, teeth))


def _belt(  # noqa: PLR0917
    name: str,
    pitch: float,
    widths: tuple[float, ...],
    least: int,
    groove: tuple[float, float, float],
    pull: float | None = None,
    *,
    mass: float = math.nan,
    curved: bool = False,
) -> BeltType:
    """Pitch, widths and groove (u, width, depth) in mm, pull of a tooth in N/cm, mass in kg/m²; curved: HTD."""
    offset, width, depth = (size * mm for size in groove)
    own = PulleyGroove(offset, width, depth, 0.0 if curved else _FLANK, round=curved)
    per_tooth = None if pull is None else pull * 100
    return BeltType(name, pitch * mm, tuple(w * mm for w in widths), least, own, per_tooth, mass)


_FLANK = math.radians(25)
"""Of the trapezoidal grooves of T and AT: DIN 7721-2."""


BELTS: dict[str, BeltType] = {
    belt.name: belt
    for belt in (
        _belt("T2.5", 2.5, (6, 10), 15, (0.26, 1.75, 0.75), 9.0, mass=1.5),
        _belt("T5", 5, (6, 10, 16, 25), 10, (0.415, 2.96, 1.25), 24.0, mass=2.1),
        _belt("T10", 10, (16, 25, 32, 50), 12, (0.93, 6.02, 2.6), 50.0),
        _belt("AT5", 5, (10, 16, 25, 32), 15, (0.615, 2.6, 1.25), 35.0, mass=3.4),
        _belt("AT10", 10, (16, 25, 32, 50), 15, (0.93, 5.2, 2.6), 73.0, mass=5.8),
        _belt("HTD 3M", 3, (6, 9, 15), 10, (0.381, 1.9, 1.28), mass=2.0, curved=True),
        _belt("HTD 5M", 5, (9, 15, 25), 14, (0.5715, 3.1, 2.16), mass=4.2, curved=True),
        _belt("HTD 8M", 8, (20, 30, 50, 85), 22, (0.686, 5.2, 3.54), mass=6.3, curved=True),
        _belt("HTD 14M", 14, (40, 55, 85, 115), 28, (1.397, 9.3, 6.2), mass=11.0, curved=True),
    )
}
"""By name: pitches and widths of DIN 7721 (T), makers' AT and ISO 13050 (H profiles, HTD); pulls of polyurethane belts
with steel cords from makers' data, rounded down; masses of such belts from makers' tables (AT5: 0.34 kg/m for 100 mm),
AT10 by its section: mean thickness 3.25 mm against 2.1 mm of AT5, and cords to match. Grooves: T by DIN 7721-2 with the
tip diameters of makers' tables (T5, 20 teeth: 31.00 mm), HTD by the pitch line offset of ISO 13050; widths of AT and
HTD for the belt's tooth with usual play, assumed."""


@dataclass(frozen=True, slots=True)
class OpenBelt:
    """A belt by the metre, clamped at both ends, with steel cords.

    widths   available by the metre [m]
    tension  allowed of its cords, and stiffness: force at an elongation of 1, both over its width [N/m]
    height, teeth, back   of the belt, of its teeth, and from the pitch line to its back [m]
    least_teeth, idler    of a pulley, and least diameter of a roller on its back, where it is bent to both sides
    """

    belt: BeltType
    widths: tuple[float, ...]
    tension: float
    stiffness: float
    height: float
    tooth: float
    back: float
    least_teeth: int
    idler: float


T5_BY_THE_METRE = OpenBelt(
    BELTS["T5"],
    (10 * mm, 16 * mm, 25 * mm, 32 * mm, 50 * mm),
    36e3,
    9e6,
    2.2 * mm,
    1.2 * mm,
    0.5 * mm,
    15,
    30 * mm,
)
"""Of polyurethane, DIN 7721: tension and stiffness of makers' tables (360 N and 90 kN for 10 mm)."""

MESHING = 12
"""Maximum number of teeth that share the pull [makers' rule]."""


@dataclass(frozen=True, slots=True)
class BeltDrive:
    """A belt on two pulleys: profile, teeth of the small and the large pulley, teeth of the belt.

    >>> drive = BeltDrive(BELTS["AT5"], 20, 40, 120)
    >>> round(drive.distance * 1e3, 3), round(drive.meshing, 2)
    (224.435, 9.55)
    """

    belt: BeltType
    small: int
    large: int
    teeth: int

    def __post_init__(self) -> None:
        if not self.belt.least_teeth <= self.small <= self.large:
            raise ParameterError(
                f"pulleys of {self.small} and {self.large} teeth for {self.belt.name}",
                allowed=f"{self.belt.least_teeth} or more, the small one first",
            )
        if belt_length(self.belt, self.small, self.large, self._least) > self.length:
            least = math.ceil(belt_length(self.belt, self.small, self.large, self._least) / self.belt.pitch)
            raise ParameterError(
                f"a belt of {self.teeth} teeth about pulleys of {self.small} and {self.large}",
                allowed=f"{least} or more, so that the pulleys do not touch",
                do="use a longer belt or smaller pulleys",
            )

    @property
    def length(self) -> float:
        """Length of the belt [m]."""
        return self.teeth * self.belt.pitch

    @property
    def radii(self) -> tuple[float, float]:
        """Pitch radii [m]."""
        return self.belt.pitch_radius(self.small), self.belt.pitch_radius(self.large)

    @property
    def distance(self) -> float:
        """Distance of the axes [m] for the length of the belt, by Newton's method."""
        first, second = self.radii
        a = max(self._least, (self.length - math.pi * (first + second)) / 2)
        for _ in range(30):
            # dL/da = 2 cos φ
            slope = 2 * math.sqrt(1 - ((second - first) / a) ** 2)
            a = max(a + (self.length - belt_length(self.belt, self.small, self.large, a)) / slope, self._least)
        return a

    @property
    def meshing(self) -> float:
        """Teeth of the small pulley in mesh."""
        first, second = self.radii
        return self.small * (math.pi - 2 * math.asin((second - first) / self.distance)) / (2 * math.pi)

    def pull(self, torque: float) -> float:
        """Force Fu = T / r1 [N] of a torque on the small pulley [N m]."""
        return abs(torque) / self.radii[0]

    def pretension(self, torque: float) -> float:
        """Least pretension Fv = Fu / 2 of each side at rest [N], for a torque [N m]."""
        return self.pull(torque) / 2

    def shaft_load(self, torque: float) -> float:
        """Load of the shafts at rest [N]: 2 Fv cos φ, for a torque [N m]."""
        first, second = self.radii
        return 2 * self.pretension(torque) * math.sqrt(1 - ((second - first) / self.distance) ** 2)

    def width_for(self, torque: float, service: float = 1.4) -> float | None:
        """The narrowest sufficient width [m] for a torque [N m] and a service factor; None if none, or not known."""
        if self.belt.pull is None:
            return None
        least = service * self.pull(torque) / (self.belt.pull * min(int(self.meshing), MESHING))
        return next((width for width in self.belt.widths if width >= least), None)

    @property
    def _least(self) -> float:
        """Distance of the axes at which the pulleys touch [m]."""
        return sum(self.radii)


def belt_length(belt: BeltType, small: int, large: int, distance: float) -> float:
    """Length [m] of a belt on two pulleys, by their teeth, at a distance of axes [m].

    Raises ParameterError for overlapping pulleys.
    """
    first, second = belt.pitch_radius(small), belt.pitch_radius(large)
    if distance < (first + second) * (1 - 1e-12):
        raise ParameterError(
            f"pulley axes {format_quantity(distance, 'mm')} apart",
            allowed=f"{format_quantity(first + second, 'mm')} or more",
            do="move them apart or use smaller pulleys",
        )
    angle = math.asin((second - first) / distance)
    return 2 * distance * math.cos(angle) + math.pi * (first + second) + 2 * angle * (second - first)
