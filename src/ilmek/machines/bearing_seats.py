"""Bearings of shafts on the frame's brackets: each in a housing on the inner face of its bracket.

A shaft reaches through bearing and bracket, and ends at the outer face, where its reducer is flanged on. An insert
bearing comes in its flanged housing (UCF), any other sits in a square plate as wide as itself, bolted to the bracket.

Axes of a seat: z along the shaft to the outside, 0 at the side of the bearing that is turned to the inside.
"""

import math

from ilmek.elements.bearing_table import INSERT, RollingBearing
from ilmek.elements.bearings import find_bearing
from ilmek.elements.columns import STEEL
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, rectangle
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle
from ilmek.records import record
from ilmek.units import format_quantity, mm

BRACKET = 20 * mm
"""Thickness of the plates that carry the bearings [m]; assumed by this project: their height follows from the load."""

CLEAR = 2 * mm
"""Bore of a bracket over the shaft that reaches through it, on each side [m]; assumed by this project."""

_HOUSING = 1.5
"""Side of a housing over the outer diameter of its bearing; assumed by this project."""


@record
class BearingSeat:
    """The bearing of a shaft's end, as it stands on a bracket.

    bearing  an insert bearing with its flanged housing, any other without one
    """

    bearing: RollingBearing

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
        """Length of the shaft through bearing and bracket [m]."""
        return self.bearing.width + BRACKET

    def occurrences(self, ids: tuple[str, str], title: str, at: tuple[Placement, ...]) -> tuple[Occurrence, ...]:
        """The bearing, and its housing if it comes without one, at some seats.

        ids  of bearing and housing      title  of the bearing
        """
        own, row = catalogue.bearing(ids[0], title, self.bearing), self.bearing
        flipped = placement(z=row.width, about=(1.0, 0.0, 0.0), angle=math.pi)
        if row.flange:
            return (Occurrence(own, tuple(seat.after(flipped) for seat in at)),)
        shape = Prism(Profile(rectangle(self.side, self.side), (circle(0j, row.outer / 2),)), row.width)
        size = f"square {format_quantity(self.side, 'mm')}, {format_quantity(row.width, 'mm')} thick"
        housing = Part(ids[1], f"housing of the {title}", "laser-cut part", size, shape, STEEL)
        return Occurrence(own, at), Occurrence(housing, at)


def seat_of(row: RollingBearing) -> BearingSeat:
    """The seat of a bearing: an insert without a housing in the flanged one of its size.

    >>> seat_of(find_bearing("UC 205")).bearing.name
    'UCF 205'
    """
    if row.kind == INSERT and not row.flange:
        return BearingSeat(find_bearing(row.name.replace("UC ", "UCF ")))
    return BearingSeat(row)
