"""Bearings of shafts on the frame's brackets: each in a housing on the inner face of its bracket.

A shaft reaches through bearing and bracket, and ends there, where its reducer is flanged on. An insert
bearing comes in its flanged housing (UCF), any other sits in a square plate as wide as itself. Four screws hold it on
the bracket, which has their threads, each with a washer; they bear the shaft's force by friction
[`elements.machine_screws`].

Axes of a seat: z along the shaft to the outside, 0 at the side of the bearing that is turned to the inside.
"""

import math

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.bearing_table import INSERT, RollingBearing
from ilmek.elements.bearings import find_bearing
from ilmek.elements.columns import STEEL
from ilmek.elements.machine_screws import SCREWS, FourScrews
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, rectangle
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.units import mm, turn

BRACKET = 20 * mm
"""Thickness of the plates that carry the bearings [m]; assumed by this project: their height follows from the load."""

CLEAR = 2 * mm
"""Bore of a bracket over the shaft that reaches through it, on each side [m]; assumed by this project."""

TURNED = turn / 24
"""Angle of a reducer to its bearing's housing: its screws keep off those of the housing and off the shaft's slot."""

_HOLE = 1.1
"""Hole in the square plate of a bearing over the screw's diameter [ISO 273, medium]."""

_PLAY = 3 * mm
"""Room of a screw that comes out beyond its length [m]; assumed by this project."""

_HOUSING = 1.5
"""Side of a housing over the outer diameter of its bearing; assumed by this project."""


@record
class BearingSeat:
    """The bearing of a shaft's end, as it stands on a bracket.

    bearing  an insert bearing with its flanged housing, any other without one
    force    of the shaft on it [N]
    """

    bearing: RollingBearing
    force: float = 0.0

    @property
    def side(self) -> float:
        """Side of the square that touches the bracket [m]."""
        return self.bearing.flange or _HOUSING * self.bearing.outer

    @property
    def radius(self) -> float:
        """Of the circle about that square [m]."""
        return self.side / math.sqrt(2)

    @property
    def bore(self) -> float:
        """Bore of the bracket [m]."""
        return self.bearing.bore + 2 * CLEAR

    @property
    def through(self) -> float:
        """From the inner side of the bearing to the outer face of the bracket [m]."""
        return self.bearing.width + BRACKET

    @property
    def journal(self) -> float:
        """Length of the shaft through both, and beyond, so that a key in its end keeps off the bracket [m]."""
        return self.through + catalogue.BEFORE_KEY

    @property
    def screw_length(self) -> float:
        """Length of its screws [m]."""
        screw = self.screws.screw
        return screw.length_for(screw.washer[1] + self._thick + BRACKET)

    @property
    def screw_room(self) -> float:
        """Room inside of the bearing that a screw needs to come out of flange and bracket [m]."""
        return max(0.0, self.screw_length + self.screws.screw.head + self._thick - self.bearing.width) + _PLAY

    @property
    def _thick(self) -> float:
        """Thickness of what the screws hold [m]."""
        return catalogue.FLANGE if self.bearing.flange else self.bearing.width

    @property
    def screws(self) -> FourScrews:
        """What the screws bear: the force in the middle of the bearing's width."""
        return FourScrews(
            self.side, self.force, self.bearing.width / 2, self.bearing.pitch, SCREWS.get(self.bearing.bolt)
        )

    def corners(self) -> ComplexArray:
        """Axes of the screws about that of the shaft [m]."""
        screws = self.screws
        return np.asarray(screws.distance(screws.screw) / 2 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j]))

    def turned(self, driven: Part) -> float | None:
        """Angle of a reducer on the bracket's other face, at which its screws keep off those of the seat and off
        the shaft's slot, 0 or `TURNED` [rad]; None: they do not.
        """
        return next((angle for angle in (0.0, TURNED) if self.is_clear(driven, angle)), None)

    def is_clear(self, driven: Part, angle: float) -> bool:
        """Whether the screws of a reducer keep off those of the seat and off the shaft's slot at an angle [rad]."""
        spots, screw = _spots(driven, angle), self.screws.screw.diameter / 2
        gap = float(np.abs(spots[:, None] - self.corners()).min()) - screw
        return min(gap, float(np.abs(spots.real).min()) - self.bore / 2) > catalogue.head_room(driven)

    def half_width(self, driven: Part) -> float:
        """Half of the width of a plate for the seat and the screws of a reducer, turned to it, with their heads [m]."""
        spots = _spots(driven, self.turned(driven) or 0.0)
        return max(self.side / 2, float(spots.real.max()) + catalogue.head_room(driven))

    def check(self, title: str, cure: str, part: str) -> Check:
        """The force of the shaft against what the screws hold."""
        screws, source = self.screws, "friction of four screws, EN 1993-1-8, 3.9"
        label = f"{title}: force on its {screws.screw.name} screws"
        return at_most(label, self.force, screws.holds(screws.screw), "N", source).with_cure(cure, part)

    def occurrences(self, ids: tuple[str, str], title: str, at: tuple[Placement, ...]) -> tuple[Occurrence, ...]:
        """The bearing, its housing if it comes without one, and its screws, at some seats.

        ids  of bearing and housing      title  of the bearing
        """
        row, chosen = self.bearing, self.screws.screw
        hole = row.hole or _HOLE * chosen.diameter
        holes = tuple(circle(complex(corner), hole / 2) for corner in self.corners())
        own = catalogue.bearing(ids[0], title, row, holes)
        flipped = placement(z=row.width, about=(1.0, 0.0, 0.0), angle=math.pi)
        screw = catalogue.screw(f"{ids[0]}-screw", f"screw of the {title}", chosen, self.screw_length)
        under = [placement(float(z.real), float(z.imag), row.width - self._thick) for z in self.corners()]
        screws = Occurrence(screw, tuple(seat.after(one) for seat in at for one in under))
        if row.flange:
            return Occurrence(own, tuple(seat.after(flipped) for seat in at)), screws
        shape = Prism(Profile(rectangle(self.side, self.side), (circle(0j, row.outer / 2), *holes)), row.width)
        housing = Part(ids[1], f"housing of the {title}", "laser-cut part", shape, STEEL, machined=True)
        return Occurrence(own, at), Occurrence(housing, at), screws


def _spots(driven: Part, angle: float) -> ComplexArray:
    """Axes of the screws of a reducer that is turned by an angle [rad] about its shaft [m]."""
    assert driven.purchase is not None
    holes = driven.purchase.holes[0]
    number = holes.ring or 4
    return np.asarray(complex(holes.across, holes.along) / 2 * np.exp(1j * (angle + turn / number * np.arange(number))))


def seat_of(row: RollingBearing, force: float = 0.0) -> BearingSeat:
    """The seat of a bearing under a force [N]: an insert without a housing in the flanged one of its size.

    >>> seat_of(find_bearing("UC 205")).bearing.name
    'UCF 205'
    """
    if row.kind == INSERT and not row.flange:
        return BearingSeat(find_bearing(row.name.replace("UC ", "UCF ")), force)
    return BearingSeat(row, force)


def least_height(moment: tuple[float, float], stress: float) -> float:
    """Least height of a bracket for moments in its plane and out of it [N m] and a stress [Pa].

    >>> h = least_height((1000.0, 100.0), 100e6)
    >>> round(6 * 1000.0 / (BRACKET * h**2) + 6 * 100.0 / (h * BRACKET**2), 3)
    100000000.0
    """
    half = 3 * moment[1] / (stress * BRACKET**2)
    return half + math.sqrt(half**2 + 6 * moment[0] / (stress * BRACKET))
