"""Anchors in a concrete floor: a bolt whose wedge spreads in a drilled hole as its nut is tightened.

Source: EN 1992-4; sizes, depth of the hole and torque as makers of zinc-plated M8 anchors state them, who differ by
some per cent.
"""

from ilmek.records import record
from ilmek.units import mm


@record
class WedgeAnchor:
    """An anchor [m].

    thread, length  of it      hole  in what it holds, ISO 273      drill, depth  of its hole in the floor
    key      width across flats of its nut, ISO 4032      torque  of this [N m]      mass  [kg]
    """

    thread: float
    length: float
    hole: float
    drill: float
    depth: float
    key: float
    torque: float
    mass: float

    @property
    def designation(self) -> str:
        """As ordered."""
        return f"wedge anchor M{self.thread / mm:.0f} x {self.length / mm:.0f} EN 1992-4"


ANCHOR = WedgeAnchor(8 * mm, 75 * mm, 9 * mm, 8 * mm, 65 * mm, 13 * mm, 20.0, 0.04)
"""The one that this project uses."""
