"""Parts that the needle drives carry: push rods, the needle bar, the needles."""

import math

import numpy as np

from ilmek.elements.materials import MATERIALS
from ilmek.errors import ParameterError
from ilmek.machines.tufting.links import STEEL
from ilmek.machines.tufting_machine.latches import latch_part
from ilmek.machines.tufting_machine.params import BY_NEEDLE, TuftingMachineParams
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Placed, Prism, Sum, bar, rectangle
from ilmek.plane.contours import polygon
from ilmek.records import record
from ilmek.units import format_quantity, mm

NEEDLE_BAR, NEEDLE, ROD = (f"tufting-machine/{name}" for name in ("needle-bar", "needle", "push-rod"))

BLADE = 2.5 * mm
"""Width of a needle's blade along the backing; assumed by this project."""

DOWN = placement(about=(1.0, 0.0, 0.0), angle=math.pi / 2)
"""A part along z, turned so that it points down."""


@record
class NeedleParts:
    """A push rod from E to the bar, downwards from its origin; a piece of the bar along z, its upper side at y = 0; a
    needle from the underside of the bar, downwards; the latch of a needle that is selected.

    pieces  of the needle bar, and the drives on each
    """

    rod: Part
    bar: Part
    needle: Part
    latch: Part | None
    pieces: int

    def mass(self, needles: int, drives: int) -> float:
        """Mass of all of them [kg]."""
        each = self.needle.mass + (self.latch.mass if self.latch else 0.0)
        return self.pieces * self.bar.mass + needles * each + drives * self.rod.mass


def needle_parts(params: TuftingMachineParams) -> NeedleParts:
    """The parts for a machine. Raises ParameterError for a needle of the drive that leaves no length for a rod."""
    given = params.needle_bar
    rod = params.needle.needle - given.needle_length - given.height
    if rod < 2 * given.rod:
        least = given.needle_length + given.height + 2 * given.rod
        raise ParameterError(
            f"needle.needle={format_quantity(params.needle.needle, 'mm')} from the rod's pin to the needle's point",
            allowed=f"at least {format_quantity(least, 'mm')}: push rod, needle bar and needles",
            do="set a longer one, or shorter needle_bar.needle_length",
        )
    pieces = params.drives if params.needle.phase else 1
    length = params.width / pieces - (given.joint if pieces > 1 else 0.0)
    material = MATERIALS[given.material]
    shape = Placed(Prism(Profile(rectangle(given.thickness, given.height)), length), (placement(y=-given.height / 2),))
    return NeedleParts(
        Part(
            ROD,
            "push rod",
            "steel bar",
            _down(given.rod, rod),
            STEEL,
            machined=True,
        ),
        Part(NEEDLE_BAR, "needle bar", "machined link", Sum((shape,)), material),
        _needle(params),
        latch_part(params),
        pieces,
    )


def _down(diameter: float, length: float) -> Sum:
    return Sum((Placed(bar(diameter, length), (DOWN,)),))


def _needle(params: TuftingMachineParams) -> Part:
    """A blade in the plane of the linkage, as thick as the needle along z, the middle of its thickness at z = 0."""
    long, taper, half = params.needle_bar.needle_length, params.needle.penetration.taper, BLADE / 2
    taper = min(taper, 0.9 * long)
    corners = np.array([-half, half, half - 1j * (long - taper), -1j * long, -half - 1j * (long - taper)])
    thick = params.looper.needle
    blade = Placed(Prism(Profile(polygon(corners)), thick), (placement(z=-thick / 2),))
    slides = params.pattern.selection == BY_NEEDLE
    held = "its shank in the needle bar, with " + ("its latch" if slides else "a set screw")
    return Part(NEEDLE, "tufting needle", "machined link", Sum((blade,)), STEEL, envelope=True, fixing=held)


def needle_heights(params: TuftingMachineParams, number: int) -> tuple[Placement, ...]:
    """Positions of needles along z from the bar's first end [m], each in the middle of its gauge."""
    first = (params.width - number * params.gauge) / 2
    return tuple(placement(z=first + (place + 0.5) * params.gauge) for place in range(number))
