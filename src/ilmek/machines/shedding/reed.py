"""The reed of a cam shaft: dents between the warps, clamped by their tabs between two baulks across the width.

The baulks are square bars before the outer edge of the dents, where no warp comes, above and below the tabs.
An arm at each end carries both; it stands on the front edge of the bearing's housing and on the bracket. A baulk bends
between the arms, l apart, under the weight of all, and under the warps that rub on the dents, both spread over it:

    5 w l⁴ / (384 E I),   I that of both baulks          [elements.beam; theory of beams]

Axes of the shaft, as in `tree`: x to the front, y up, z along the width.
"""

import math
from collections.abc import Iterator

import numpy as np

from ilmek.elements.beam import uniform
from ilmek.elements.columns import STEEL
from ilmek.elements.materials import GRAVITY
from ilmek.elements.shafts import STOCK_SIDES
from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.machines.shedding.stack import DENT_TAB, dent_room
from ilmek.part import catalogue
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.records import record
from ilmek.report import Check, Contour, at_most

RUBBING = 0.1
"""Force of the warps on the dents across the baulks, over that of the lifted warps on the cams; assumed."""

SAG = 1 / 1000
"""Allowed sag of the baulks over their length; assumed by this project."""


@record
class Reed:
    """The reed of a shaft.

    side     of a baulk [m]       outer    radius of the dents' outer edge [m]      housing  front of the housing [m]
    length   of a baulk [m]       dents    mass of all dents [kg]                   rubbing  force of the warps [N]
    room     between the noses and the dents [m]
    """

    side: float
    outer: float
    housing: float
    length: float
    dents: float
    rubbing: float
    room: float

    @property
    def front(self) -> float:
        """Front of the baulks before the axis of the shaft [m]."""
        return self.outer + self.side

    @property
    def axes(self) -> tuple[complex, complex]:
        """Axes of the upper and the lower baulk [m]."""
        middle, apart = self.outer + self.side / 2, (DENT_TAB[1] + self.side) / 2
        return middle + 1j * apart, middle - 1j * apart

    @property
    def arm(self) -> Prism:
        """The plate from the housing's edge to the front of the baulks, from z = 0."""
        half = 1j * (DENT_TAB[1] / 2 + self.side)
        corners = np.array([self.housing - half, self.front - half, self.front + half, self.housing + half])
        return Prism(Profile(Contour(corners, np.zeros(4))), catalogue.FLANGE)

    @property
    def sags(self) -> tuple[float, float]:
        """Deflection of the baulks to the front under the warps, and down under the weight [m]."""
        weight = GRAVITY * (self.dents / self.length + 2 * STEEL.density * self.side**2)
        stiff = STEEL.modulus, 2 * uniform.square_inertia(self.side)
        across, down = (
            float(uniform.deflection_max(w, self.length, *stiff)) for w in (self.rubbing / self.length, weight)
        )
        return across, down

    def checks(self) -> Iterator[Check]:
        """Deflection of the baulks across the warps and down."""
        across, down = self.sags
        cure = "set a lower tension, or a narrower carpet"
        source = "room of the dents over the noses; 10 % of the warps' force, assumed by this project"
        yield at_most("deflection of the reed across the warps", across, self.room, "mm", source).with_cure(cure)
        length = "length over 1000, assumed by this project"
        yield at_most("sag of the reed", down, SAG * self.length, "mm", length).with_cure(cure)


def reed_of(shaft: CamShaft, warps: int, inner: float) -> Reed | None:
    """The reed with the lightest baulks that keep its checks, else the stiffest; None where guide cams turn.

    warps  of the loom, each between two dents      inner  side of the bearing from the middle of the width [m]
    """
    params, stack, seat = shaft.params, shaft.stack, shaft.seat
    if stack.shares.guides or params.guide_height <= 0:
        return None
    length = 2 * (inner + seat.bearing.width - catalogue.FLANGE)
    dents, rubbing = (warps + 1) * stack.guide_mass, RUBBING * shaft.across_max.value
    reeds = [
        Reed(side, stack.guide_radius, seat.side / 2, length, dents, rubbing, dent_room(params)) for side in STOCK_SIDES
    ]
    return next((own for own in reeds if all(check.ok for check in own.checks())), reeds[-1])


def dent(shaft: CamShaft) -> Prism:
    """A dent: the ring from the warps' line over the tip and back to it, with its tab between the baulks."""
    outer, (long, high) = shaft.stack.guide_radius, DENT_TAB
    inner = outer - shaft.params.guide_height + dent_room(shaft.params)
    half, root, sides = (
        math.acos(min(shaft.base_radius / outer, 1.0)),
        math.asin(high / 2 / outer),
        high / 2 * np.array([-1, 1]),
    )
    rim, hollow = (
        outer * np.exp(1j * np.array([-half, -root, root, half])),
        inner * np.exp(1j * half * np.array([1, -1])),
    )
    bend = math.tan((half - root) / 4)
    outline = Contour(
        np.concatenate([rim[:2], outer + long + 1j * sides, rim[2:], hollow]),
        np.array([bend, 0, 0, 0, bend, 0, -math.tan(half / 2), 0]),
    )
    return Prism(Profile(outline), shaft.stack.guide_thickness)
