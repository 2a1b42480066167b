"""The slot of an attachment bar along a cylinder, and the tube with it."""

import cmath
from typing import Protocol

from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Shape, Sum
from ilmek.plane.contours import circle, keyed_bore
from ilmek.report import Contour
from ilmek.units import mm, turn

DIAMETER, PLAY = 6 * mm, 0.03
"""Of a bar [m], and play in the slot over it; the thesis gives no size, assumed by this project."""


SLOT_AT = cmath.rect(1.0, -turn / 8)
"""Where the slot is on the cylinder while the first row is woven, as a direction."""


class Ring(Protocol):
    """Radii of a tube [m]."""

    @property
    def outer(self) -> float:
        """Outer radius [m]."""

    @property
    def inner(self) -> float:
        """Inner radius [m]."""


def diameter(cylinder: Ring) -> float:
    """Diameter of the bar [m]: no more than half the radius of the cylinder."""
    return min(DIAMETER, cylinder.outer / 2)


def depth(cylinder: Ring) -> float:
    """Depth of the slot [m]: half the bar, or half the wall where that is less."""
    return min(diameter(cylinder), cylinder.outer - cylinder.inner) / 2


def over(cylinder: Ring) -> float:
    """How far the bar stands out of the cylinder [m]."""
    return diameter(cylinder) - depth(cylinder)


def width(cylinder: Ring) -> float:
    """Width of the slot [m]."""
    return (1 + PLAY) * diameter(cylinder)


def turned_slot(cylinder: Ring, deep: float, more: float = 0.0) -> Contour:
    """The surface with the slot, deep [m] outwards, and wider by more [m]."""
    outline = keyed_bore(cylinder.outer, width(cylinder) + more, deep)
    return Contour(outline.points * SLOT_AT, outline.bulges)


def slotted(cylinder: Ring, length: float) -> Prism:
    """The tube of a length with its slot, about z from z = 0 [m]."""
    return _tube(cylinder, cylinder.inner, length)


def bored_tube(cylinder: Ring, length: float, bore: float, deep: float) -> Shape:
    """The tube of a length with its slot, about z from z = 0, bored at both ends to a radius, so deep [m]."""
    if cylinder.inner <= 0:
        return slotted(cylinder, length)
    middle, end = slotted(cylinder, length - 2 * deep), _tube(cylinder, bore, deep)
    return Sum((Placed(middle, (placement(z=deep),)), Placed(end, (placement(), placement(z=length - deep)))))


def _tube(cylinder: Ring, inner: float, length: float) -> Prism:
    bore, slot = (circle(0j, inner),) if inner > 0 else (), turned_slot(cylinder, -depth(cylinder))
    return Prism(Profile(slot, bore), length)
