"""A link's plate, for tests of what the workshop gets."""

from collections.abc import Sequence

import numpy as np

from ilmek.plane.contours import area, rounded_hull
from ilmek.report import Hole, Plate


def link_plate(
    name: str,
    title: str,
    pins: Sequence[tuple[str, complex]],
    *,
    hole_radius: float,
    width: float,
    thickness: float,
    material: str,
) -> Plate:
    """The hull of a link's ends, half its width about its pins, bored at each [m]."""
    outline = rounded_hull(np.array([centre for _, centre in pins], dtype=complex), width / 2)
    holes = tuple(Hole(centre, hole_radius, pin) for pin, centre in pins)
    return Plate(name, title, outline, thickness, material, holes, area=area(outline))
