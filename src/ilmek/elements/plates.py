"""Plates of machines for the workshop: links between pins, and discs on a shaft with their bore."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.keyways import keyway_for
from ilmek.errors import ParameterError
from ilmek.plane.contours import area, keyed_bore, rounded_hull
from ilmek.report import Contour, Hole, Plate
from ilmek.units import format_quantity

ZERO_MARK = 0.1
"""Length of the scribed mark of the angle 0, as a share of the plate's radius."""

PIN_SHARE = 1 / 3
"""Diameter of a link's pin over the link's width, where a design gives none."""


def link_plate(
    name: str,
    title: str,
    pins: Sequence[tuple[str, complex]],
    *,
    hole_radius: float | Mapping[str, float],
    width: float,
    thickness: float,
    material: str,
    number: int = 1,
) -> Plate:
    """A link's plate: a bored hole at each pin, with material around it according to `width`.

    pins   names and positions of the pins in the link's own frame [m], two or more
    hole_radius  of all holes, or of each by its pin's name [m]
    width  of a straight link [m]: twice the radius of its ends
    Three or more pins give the hull of their ends. Raises ParameterError for coincident pins, or a width without
    material beside the holes.

    >>> plate = link_plate("crank", "Crank", [("A", 0j), ("B", 0.06 + 0j)], hole_radius=0.005, width=0.024,
    ...                    thickness=0.008, material="steel")
    >>> round(plate.area, 9) == round(0.06 * 0.024 + np.pi * 0.012**2, 9)
    True
    """
    radii = hole_radius if isinstance(hole_radius, Mapping) else dict.fromkeys((pin for pin, _ in pins), hole_radius)
    largest = max(radii[pin] for pin, _ in pins)
    if width <= 2 * largest:
        raise ParameterError(
            f"a link {format_quantity(width, 'mm')} wide with holes of {format_quantity(2 * largest, 'mm')}",
            allowed="wider than its holes",
        )
    centres = np.array([centre for _, centre in pins], dtype=complex)
    apart = np.abs(centres[:, None] - centres[None, :])[np.triu_indices(len(centres), 1)]
    if len(centres) < 2 or apart.min() < 2 * largest:
        raise ParameterError(
            f"the holes of {name} run into one another", allowed=f"{format_quantity(2 * largest, 'mm')} apart"
        )
    outline = rounded_hull(centres, width / 2)
    holes = tuple(Hole(centre, radii[pin], pin) for pin, centre in pins)
    return Plate(name, title, outline, thickness, material, holes, area=area(outline), number=number)


class Bore(NamedTuple):
    """The bore of a disc for its shaft; `Plate(..., **bore._asdict())` is a plate with it."""

    holes: tuple[Hole, ...]
    cutouts: tuple[Contour, ...]


def round_bore(diameter: float, *, key: bool = True) -> Bore:
    """A bore about the origin; with the hub's keyway of DIN 6885-1, towards +x.

    Raises ParameterError for a diameter beyond those of parallel keys.

    >>> round_bore(0.025, key=False).cutouts
    ()
    """
    if not key:
        return Bore((Hole(0j, diameter / 2, "bore"),), ())
    keyway = keyway_for(diameter)
    return Bore((), (keyed_bore(diameter / 2, keyway.width, keyway.in_hub),))


def zero_mark(radius: float, angle: float = 0.0) -> dict[str, ComplexArray]:
    """The line to scribe at an angle [rad] of a disc, inwards from the edge at a radius [m]; for a plate's `marks`."""
    return {"zero": radius * np.array([1 - ZERO_MARK, 1.0]) * np.exp(1j * angle)}
