"""The beater: teeth between the warps of a stroke, and in front of the warps a bar that makes it as heavy as it is.

    m_E = n m_t + m_p + rho w d h,   J_A = m_E AE²     n teeth of m_t, plate of m_p, bar of the stroke's width w, d deep

The forces have the mass of the beater in its striking edge, E [`links`]. Depth and height of the bar are such that it
is as hard to turn about the rocker's pivot A as that; the force in A, which its mass centre decides, is not the same.
The bar's end is bolted to a plate, the plate to the side of the rocker, which ends where the bar begins. The plate
bends by the bar's inertia at the beat, m_b a at the height of its centre: stress 6 M / (t b²).
Axes of both parts: those of the side view, x from the fell to the front, y up, z across the carpet.
"""

import math
from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from ilmek.arrays import ComplexArray
from ilmek.elements.materials import MATERIALS, Material
from ilmek.machines.beat_up.params import BeatUpParams
from ilmek.machines.link_tree import GAP
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import polygon
from ilmek.records import record
from ilmek.report import Check, at_least, at_most
from ilmek.units import mm

STEEL = MATERIALS["structural steel"]

INERTIA_TOLERANCE = 0.01
"""Share by which the inertia of the beater may be off."""

_SLENDER = 1e-2
"""Least depth of the bar over that of a square one."""

TOOTH = 10 * mm
"""Height of the beater's teeth [m]: assumed by this project."""

PLATE_WIDTH, PLATE_HEIGHT = 1.2, 4.0
"""Width of the beater's plate, and its height above the middle of the rocker, over the rocker's width; assumed here."""

PLATE_SAFETY = 3.0
"""Of the plate against yielding: it is loaded at every beat; assumed by this project."""

BAR_ABOVE = 5 * mm
"""The bar above the edge that strikes, clear of the pile [m]: assumed by this project."""


@record
class Beater:
    """The parts of a beater; bar and plate: None where the teeth alone weigh as much as it should.

    teeth  their number      pitch, width  of the warps, and of the stroke [m]      mass  that it should have [kg]
    arm    of the striking edge from the rocker's pivot, level with it in front [m]
    """

    tooth: Part
    bar: Part | None
    plate: Part | None
    teeth: int
    pitch: float
    width: float
    mass: float
    arm: float

    @property
    def ids(self) -> tuple[str, ...]:
        """Ids of its parts."""
        return tuple(part.id for part in (self.tooth, self.bar, self.plate) if part is not None)

    @property
    def inertia_share(self) -> float:
        """Moment of inertia of its parts about the pivot, over that of its mass at the striking edge."""
        pivot, parts = complex(self.arm), [(self.tooth, self.teeth), (self.bar, 1), (self.plate, 1)]
        about = sum(number * _about(part, pivot) for part, number in parts if part is not None)
        return about / (self.mass * self.arm**2) if self.mass else math.inf

    @property
    def outline(self) -> tuple[ComplexArray, ...]:
        """Its parts in the side view, convex, the striking edge at 0 [m]."""
        return tuple(_section(part) for part in (self.tooth, self.bar) if part is not None)

    @property
    def occurrences(self) -> tuple[Occurrence, ...]:
        """Its parts, the middle of its width at z = 0."""
        thick = _length(self.tooth)
        across = (np.arange(self.teeth) - (self.teeth - 1) / 2) * self.pitch - thick / 2
        teeth = Occurrence(self.tooth, tuple(placement(z=float(z)) for z in across))
        if self.bar is None or self.plate is None:
            return (teeth,)
        beside = placement(z=-self.width / 2 - _length(self.plate))
        return teeth, Occurrence(self.bar, (placement(z=-self.width / 2),)), Occurrence(self.plate, (beside,))

    @property
    def plate_stress(self) -> float:
        """Bending stress of the plate for an acceleration of 1 m/s² of the striking edge [Pa]; 0 without a bar."""
        if self.bar is None or self.plate is None:
            return 0.0
        moments = self.bar.moments
        assert moments is not None
        wide = float(np.ptp(_section(self.plate).real))
        return 6 * self.bar.mass * float(moments.centre[1]) / (_length(self.plate) * wide**2)


def beater_of(params: BeatUpParams, warps: int, arm: float) -> Beater:
    """The beater for the warps of a stroke; arm: of its striking edge from the rocker's pivot [m]."""
    travel, pitch = params.travel, params.cloth.warp_pitch
    number, wide, thickness = max(warps - 1, 1), warps * pitch, travel.tooth_thickness or 0.4 * pitch
    front = travel.bar_distance
    corners = rectangle(-travel.reach / 2, front, 0.0, TOOTH)
    tooth = across("beat-up/tooth", "tooth of the beater", "laser-cut part", corners, thickness)
    tooth = replace(tooth, joins=("beat-up/beater-bar",))
    mass = params.beater_mass
    side = rectangle(front, front + PLATE_WIDTH * params.width, -params.width / 2, PLATE_HEIGHT * params.width)
    plate = across("beat-up/beater-plate", "plate of the beater", "laser-cut part", side, GAP * params.thickness)
    section = (mass - number * tooth.mass - plate.mass) / (STEEL.density * wide)
    bar = None
    if section > 0:
        pivot = complex(arm)
        inertia = mass * arm**2 - number * _about(tooth, pivot) - _about(plate, pivot)
        deep = _depth(section, arm - front, inertia, STEEL.density * wide)
        corners = rectangle(front, front + deep, BAR_ABOVE, BAR_ABOVE + section / deep)
        bar = across("beat-up/beater-bar", "bar of the beater", "steel bar", corners, wide)
    return Beater(tooth, bar, plate if bar else None, number, pitch, wide, mass, arm)


def _depth(section: float, reach: float, inertia: float, line_density: float) -> float:
    """Depth of a bar of a section [m²] with a moment of inertia about the pivot [kg m²]; square where it has more.

    reach  of its side towards the warps from the pivot [m]
    line_density  of its material times its length [kg/m²]
    """

    def excess(depth: float) -> float:
        high = section / depth
        centre = complex(reach - depth / 2, BAR_ABOVE + high / 2)
        return line_density * section * (abs(centre) ** 2 + (depth**2 + high**2) / 12) - inertia

    square = math.sqrt(section)
    slender = _SLENDER * square
    if excess(square) >= 0:
        return square
    return slender if excess(slender) <= 0 else float(brentq(excess, slender, square, xtol=1e-12))


def plate_check(beater: Beater, acceleration: float) -> tuple[Check, ...]:
    """Whether the plate bears the bar at an acceleration of the striking edge [m/s²]; none without a bar."""
    if beater.plate is None:
        return ()
    title, value = "stress of the beater's plate", beater.plate_stress * acceleration
    return (
        at_most(
            title, value, STEEL.strength / PLATE_SAFETY, "MPa", "yield of S235 over 3, assumed by this project"
        ).with_cure("set wider or thicker links, or a lighter beater_mass", beater.plate.id),
    )


def beater_checks(beater: Beater) -> tuple[Check, ...]:
    """Whether there is a beater as light as its mass states, and as hard to turn as its mass at the striking edge."""
    lighter = "set a heavier beater_mass, shorter or thinner teeth, or fewer travel.stroke_warps"
    point = "the forces have its mass at the striking edge; assumed by this project"
    return (
        at_least(
            "mass of the beater, that of its teeth at least",
            beater.mass,
            beater.teeth * beater.tooth.mass,
            "kg",
            "teeth of the parts list",
        ).with_cure(lighter, *beater.ids),
        at_most(
            "inertia of the beater about its pivot, off that of its mass at the striking edge",
            abs(beater.inertia_share - 1) if beater.mass else 0.0,
            INERTIA_TOLERANCE,
            "1",
            point,
        ).with_cure("set another beater_mass, or more travel.stroke_warps", *beater.ids),
    )


def rectangle(left: float, right: float, low: float, high: float) -> ComplexArray:
    """Corners of a rectangle in the side view, counter-clockwise [m]."""
    return np.array([complex(left, low), complex(right, low), complex(right, high), complex(left, high)])


def across(  # noqa: PLR0917
    name: str, title: str, process: str, corners: ComplexArray, length: float, material: Material = STEEL
) -> Part:
    """A part of one section in the side view, with these corners, along the width from z = 0 [m]."""
    return Part(name, title, process, Prism(Profile(polygon(corners)), length), material)


def _about(part: Part, pivot: complex) -> float:
    """Moment of inertia of a prism about an axis along it [kg m²]."""
    moments = part.moments
    assert moments is not None
    centre = complex(moments.centre[0], moments.centre[1])
    return float(moments.inertia[2, 2] + moments.zeroth * abs(centre - pivot) ** 2)


def _section(part: Part) -> ComplexArray:
    assert isinstance(part.shape, Prism)
    return part.shape.section.outline.points


def _length(part: Part) -> float:
    assert isinstance(part.shape, Prism)
    return part.shape.length
