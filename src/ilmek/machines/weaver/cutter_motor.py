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
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, disc
from ilmek.plane.contours import circle
from ilmek.units import mm

HUB, BORE = 12 * mm, 8 * mm
"""Diameter of the eccentric's hub, and largest bore in it [m]; assumed by this project."""

BLADE = 3 * mm
"""Thickness of the blade and of the disc in its slot [m]; assumed by this project."""


def eccentric_diameter(params: WeaverParams) -> float:
    """Diameter of the disc in the blade's slot [m]."""
    return HUB + 2 * eccentricity(params.yarn)


def eccentric(params: WeaverParams, wall: float, bore: float) -> Sum:
    """The disc, and its hub through a wall of a thickness [m]; about the motor's axis from the blade's front."""
    hole = circle(0j, bore / 2)
    edge = circle(-1j * eccentricity(params.yarn), eccentric_diameter(params) / 2)
    hub = Placed(Prism(disc(HUB / 2, hole), wall), (placement(z=BLADE),))
    return Sum((Placed(Prism(Profile(edge, (hole,)), BLADE)), hub))


def eccentric_bore(params: WeaverParams) -> float:
    """Diameter of the motor's shaft in the eccentric, turned down to the largest bore [m]."""
    return min(catalogue.motor_shaft(cutter_motor(params)), BORE)


@lru_cache(maxsize=32)
def cutter_drive(params: WeaverParams) -> ServoDrive | None:
    """The motor of least power that makes the cut; None where none does. The hub counts as long as it may be."""
    second = eccentric(params, SHEET, BORE).moments.second * STEEL.density
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
