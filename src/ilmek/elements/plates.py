"""Plates of machines for the workshop: discs on a shaft with their bore."""

from typing import NamedTuple

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.keyways import keyway_for
from ilmek.plane.contours import keyed_bore
from ilmek.report import Contour, Hole

ZERO_MARK = 0.1
"""Length of the scribed mark of the angle 0, as a share of the plate's radius."""

PIN_SHARE = 1 / 3
"""Diameter of a link's pin over the link's width, where a design gives none."""


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
