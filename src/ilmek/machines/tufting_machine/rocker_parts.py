"""Parts that the drives of loopers and knives have alike: eccentric, coupler, rocker, shaft, arms and bar.

The rocker's frame has its origin on its shaft and x towards the coupler's pin. What stands on the shaft lies in axes of
its own, those of the machine in the middle of the swing.
"""

import cmath
from dataclasses import replace

import numpy as np

from ilmek.elements.bearing_table import DEEP_GROOVE, ROLLING_BEARINGS, RollingBearing
from ilmek.elements.materials import MATERIALS
from ilmek.linkage.model import Mechanism
from ilmek.machines.link_tree import Levels, LinkageParts, LinkSize, body_id, linkage_parts
from ilmek.machines.tufting.links import WALL, eccentric, eyed, ring
from ilmek.machines.tufting_machine.params import LooperParams
from ilmek.machines.tufting_machine.rocker_drive import RockerDrive
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, bar, rectangle
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle, rounded_hull
from ilmek.records import record
from ilmek.units import mm

NAME = "tufting-machine"
STEEL = MATERIALS["heat-treatable steel"]

BETWEEN = 1 * mm
"""Gap of the shafts of neighbouring drives along the width; assumed by this project."""

ARM_THICKNESS, ARMS = 12 * mm, {"looper": 0.3, "knife": 0.4}
"""Thickness of an arm, and by drive its distance from the middle of it over that of the drives; assumed."""


CLEAR = 10 * mm
"""Clearance of what moves from the frame; assumed by this project."""


PLURAL = {"looper": "loopers", "knife": "knives"}


def looper_bearing(params: LooperParams) -> RollingBearing:
    """The lightest deep-groove ball bearing on the shafts of loopers and knives."""
    rows = [row for row in ROLLING_BEARINGS.values() if row.kind == DEEP_GROOVE]
    return min(rows, key=lambda row: (row.bore < params.shaft * (1 - 1e-9), row.bore, row.mass))


@record
class RockerParts:
    """The linkage of a drive and what stands on its shaft along a pitch.

    upright  axes of the machine in the rocker's frame, in the middle of the swing
    level    middle of the plates over the lowest [m]      half  from there to a bearing plate beside them [m]
    aside    their middle from that of the drive along z [m]      square  middle of the bar from the shaft, upright [m]
    spread   distance of an arm from the middle of the drive, over the pitch
    along    direction of the bar's underside, upright
    """

    linkage: LinkageParts
    upright: Placement
    level: float
    half: float
    aside: float
    pitch: float
    spread: float
    shaft: Part
    arm: Part
    bar: Part
    square: complex
    along: complex

    def carried(self, *others: Occurrence) -> tuple[Occurrence, ...]:
        """Shaft, arms, bar and others in the rocker's frame; those lie in the axes that are upright."""
        half, raised = (self.pitch - BETWEEN) / 2, self.upright.after(placement(z=self.level - self.aside))
        arms = tuple(placement(z=side * self.spread * self.pitch - ARM_THICKNESS / 2) for side in (-1, 1))
        turned = cmath.phase(self.along)
        square = placement(self.square.real, self.square.imag, -half, about=(0.0, 0.0, 1.0), angle=turned)
        own = (
            Occurrence(self.shaft, (placement(z=-half),)),
            Occurrence(self.arm, arms),
            Occurrence(self.bar, (square,)),
        )
        return tuple(
            Occurrence(one.part, tuple(raised.after(place) for place in one.positions))
            for one in (*own, *others)
            if one.positions
        )


def rocker_parts(
    drive: RockerDrive,
    mechanism: Mechanism,
    params: LooperParams,
    pitch: float,
    square: tuple[complex, float, complex],
    *,
    like: RockerParts | None = None,
) -> RockerParts:
    """The parts of a drive; like: of the one whose pins it shares, and beyond whose bearing plates its linkage is.

    pitch  of the drives along the width [m]      square  middle of the bar from the shaft, its side [m], its direction
    """
    name, (crank, coupler, rocker) = drive.name, drive.bodies
    section, material, pin = (params.link_width, params.link_thickness), params.strength.of_links, params.pin_diameter
    lengths, hole = drive.lengths, circle(0j, params.shaft / 2)
    around = ring(lengths["crank"], params.shaft)
    names = {body: (body_id(NAME, body), body) for body in drive.bodies}
    formed = {
        crank: eccentric(names[crank][0], lengths["crank"], params.shaft, section[1], material),
        coupler: eyed(names[coupler], "AB", lengths["coupler"], section, around, pin, material),
        rocker: eyed(names[rocker], "PB", lengths["rocker"], section, hole, pin, material),
    }
    levels = Levels(((crank, coupler), (rocker,)), {body: LinkSize(*section, pin, material) for body in drive.bodies})
    (middle, side, along), long = square, pitch - BETWEEN
    low, high = levels.across(list(drive.bodies))
    half = (high - low + CLEAR) / 2
    linkage = linkage_parts(NAME, mechanism, levels, formed, ("Q", "A", "P"), of="looper")
    return RockerParts(
        replace(linkage, pins=like.linkage.pins) if like else linkage,
        placement(about=(0.0, 0.0, 1.0), angle=-drive.middle),
        (low + high) / 2,
        half,
        2 * half + looper_bearing(params).width if like else 0.0,
        pitch,
        ARMS[name],
        Part(f"{NAME}/{name}-shaft", f"{name} shaft", "steel bar", bar(params.shaft, long), STEEL, machined=True),
        _arm(name, params.shaft, middle - 0.5j * side * along, side * along),
        Part(f"{NAME}/{name}-bar", f"{name} bar", "steel bar", Prism(Profile(rectangle(side, side)), long), STEEL),
        middle,
        along,
    )


def arm_radius(shaft: float) -> float:
    """Radius of an arm about its shaft of a diameter [m]."""
    return shaft / 2 * (1 + 2 * WALL)


def _arm(name: str, shaft: float, under: complex, side: complex) -> Part:
    """An arm on the shaft, flat under the bar: the hull of a wall about the shaft and of the bar's underside."""
    radius = arm_radius(shaft)
    ends = under - 1j * radius * side / abs(side) + side * np.array([-0.5, 0.5])
    outline = rounded_hull(np.array([0, *ends]), radius)
    shape = Prism(Profile(outline, (circle(0j, shaft / 2),)), ARM_THICKNESS)
    steel = MATERIALS["structural steel"]
    return Part(f"{NAME}/{name}-arm", f"arm of the {PLURAL[name]}", "laser-cut part", shape, steel, machined=True)
