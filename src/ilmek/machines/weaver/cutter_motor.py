"""The motor of a head's cutter with the eccentric on its shaft, by the parameters of the head."""

from functools import lru_cache

from ilmek.elements.duty import ServoDrive, size_motor
from ilmek.elements.motors import Motor
from ilmek.elements.reducers import DIRECT
from ilmek.machines.weaver.cutter import cut, eccentricity
from ilmek.machines.weaver.head_shape import SHEET
from ilmek.machines.weaver.opener import STEEL
from ilmek.machines.weaver.params import WeaverParams
from ilmek.part import catalogue
from ilmek.part.placement import placement
from ilmek.part.shapes import Placed, Sum, bar
from ilmek.units import mm

HUB = 12 * mm
"""Diameter of the eccentric's hub on a shaft of 8 mm [m]; assumed by this project."""

BLADE = 3 * mm
"""Thickness of the blade and of the disc in its slot [m]; assumed by this project."""


def eccentric_diameter(params: WeaverParams) -> float:
    """Diameter of the disc in the blade's slot [m]."""
    return HUB + 2 * eccentricity(params.yarn)


def eccentric(params: WeaverParams, wall: float) -> Sum:
    """The disc, and its hub through a wall of a thickness [m]; about the motor's axis from the blade's front."""
    disc = Placed(bar(eccentric_diameter(params), BLADE), (placement(y=-eccentricity(params.yarn)),))
    return Sum((disc, Placed(bar(HUB, wall), (placement(z=BLADE),))))


@lru_cache(maxsize=32)
def cutter_drive(params: WeaverParams) -> ServoDrive | None:
    """The motor of least power that makes the cut; None where none does. The hub counts as long as it may be."""
    second = eccentric(params, SHEET).moments.second * STEEL.density
    inertia = float(second[0, 0] + second[1, 1])
    return size_motor(cut(params.yarn, params.strength, params.cutter_turn, inertia), (DIRECT,))


def cutter_motor(params: WeaverParams) -> Motor | None:
    """That motor."""
    drive = cutter_drive(params)
    return drive.motor if drive else None


def motor_length(params: WeaverParams) -> float:
    """Length of the motor behind the face [m]."""
    row = cutter_motor(params)
    return row.length if row else 2 * catalogue.SPECIAL_FACE
