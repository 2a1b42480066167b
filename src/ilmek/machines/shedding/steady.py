"""The steady of a cam shaft of several spans: two rollers behind the guide cams, whose rims run on them.

The rollers lie at the angles ±b from the line to the back, a block behind the rims carries their studs and is bolted to
the frame. A span's load F is borne by both, N = F / (2 cos b) each, where it points to the back; a downward share only
moves it from the upper to the lower roller, which bears at most F / cos b [equilibrium of the shaft].

Axes of the shaft, as in `tree`: x to the front, y up, z along the width.
"""

import cmath
import math

from ilmek.elements.cam_rollers import ROLLERS, Roller
from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import placement
from ilmek.part.shapes import Placed, Sum, bar, box
from ilmek.part.tree import Occurrence
from ilmek.records import record
from ilmek.report import Check, at_most
from ilmek.units import deg, mm

ASIDE = 25 * deg
"""Angle b of the rollers from the line to the back; assumed by this project."""

ROOM = 3 * mm
"""Between the rims and the block [m]; assumed by this project."""

BLOCK = 20 * mm
"""Thickness of the block along the shaft, and behind the rollers [m]; assumed by this project."""


@record
class Steady:
    """The rollers of a steady; radius: of the rims, force: on a roller at most [N]."""

    roller: Roller
    radius: float
    force: float

    @property
    def rear(self) -> float:
        """From the shaft's axis to the back of the block [m]."""
        return self.radius + self.roller.diameter + BLOCK

    @property
    def half_height(self) -> float:
        """Half of the block's height [m]."""
        return (self.radius + self.roller.radius) * math.sin(ASIDE) + self.roller.radius

    def check(self, part: str) -> Check:
        """The force on a roller."""
        cure, limit = "set more spans, or a lower tension", self.roller.force_limit
        source = f"largest force of {self.roller.name}"
        return at_most("force on a roller of a steady", self.force, limit, "N", source).with_cure(cure, part)

    def part(self, name: str, title: str) -> Part:
        """Rollers and block; z along the shaft, 0 in the middle of the rollers' width."""
        wide, centre = self.roller.width, (self.radius + self.roller.radius) * cmath.exp(1j * ASIDE)
        ring = Placed(
            bar(self.roller.diameter, wide),
            tuple(placement(-centre.real, y, -wide / 2) for y in (centre.imag, -centre.imag)),
        )
        front, rear = self.radius + ROOM, self.rear
        shape = Sum(
            (
                ring,
                Placed(
                    box(rear - front, 2 * self.half_height, BLOCK), (placement(-(rear + front) / 2, 0.0, wide / 2),)
                ),
            )
        )
        bought = Bought(f"2 {self.roller.name} in a block")
        return bought_part(name, title, "bearing", shape, bought)


def steady_of(shaft: CamShaft) -> Steady | None:
    """The steady of a shaft; None where it has one span, or no guide cams whose rims could run on it."""
    stack = shaft.stack
    if shaft.params.spans == 1 or not stack.shares.guides:
        return None
    force = shaft.shaft.seat.reaction / math.cos(ASIDE)
    rollers = sorted(ROLLERS.values(), key=lambda one: (one.diameter, one.force_limit))
    chosen = next((roller for roller in rollers if roller.force_limit >= force), rollers[-1])
    return Steady(chosen, stack.guide_radius, force)


def steadies(shaft: CamShaft, name: str, title: str) -> tuple[Occurrence, ...]:
    """The steadies between the spans of a shaft."""
    own, spans, long = steady_of(shaft), shaft.params.spans, shaft.shaft.length
    if own is None:
        return ()
    return (Occurrence(own.part(name, title), tuple(placement(z=z) for z in steady_stations(spans, long))),)


def steady_stations(spans: int, length: float) -> tuple[float, ...]:
    """Supports between equal spans along a shaft, 0 in its middle [m]."""
    return tuple(length * (k / spans - 0.5) for k in range(1, spans))
