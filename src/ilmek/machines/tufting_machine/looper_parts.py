"""Parts of a looper drive: eccentric, coupler, rocker with its shaft, arms, bar and hooks; one for each needle drive.

The rocker's frame has its origin on the looper shaft and x towards the coupler's pin. What stands on the shaft lies in
axes of its own, y along the arm in the middle of the swing, towards the hook's point, which is at y = arm.
"""

import numpy as np

from ilmek.elements.materials import MATERIALS
from ilmek.linkage.model import Mechanism
from ilmek.machines.link_tree import Levels, LinkageParts, LinkSize, body_id, linkage_parts
from ilmek.machines.tufting.links import WALL, eccentric, eyed, ring
from ilmek.machines.tufting_machine.looper import LooperDrive, rocker_angle
from ilmek.machines.tufting_machine.needle_parts import needle_heights
from ilmek.machines.tufting_machine.params import TuftingMachineParams
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, bar, rectangle
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle, polygon, rounded_hull
from ilmek.records import record
from ilmek.units import mm

NAME = "tufting-machine"
BODIES = CRANK, COUPLER, ROCKER = "looper crank", "looper coupler", "looper rocker"
LOOPER, LOOPER_BAR, ARM, LOOPER_SHAFT = (
    f"{NAME}/{name}" for name in ("looper", "looper-bar", "looper-arm", "looper-shaft")
)
STEEL = MATERIALS["heat-treatable steel"]

BETWEEN = 1 * mm
"""Gap of the looper shafts of neighbouring drives along the width; assumed by this project."""

STEM, BEAK = 8 * mm, 20 * mm
"""Width of a looper's stem, and length of its beak from there; assumed by this project."""

ARM_THICKNESS, ARMS = 12 * mm, 0.3
"""Thickness of an arm, and its distance from the middle of its drive over that of the drives; assumed."""


@record
class LooperParts:
    """The parts of a looper drive.

    upright  axes of the arm in the rocker's frame      level  middle of the plates along z [m]
    """

    params: TuftingMachineParams
    drive: LooperDrive
    needles: int
    linkage: LinkageParts
    upright: Placement
    level: float
    shaft: Part
    arm: Part
    bar: Part
    hook: Part

    def carried(self, number: int) -> tuple[Occurrence, ...]:
        """What the rocker of a drive, counted from 0, carries in its frame beside its plate."""
        looper, pitch = self.params.looper, self.params.width / self.params.drives
        half, raised = (pitch - BETWEEN) / 2, self.upright.after(placement(z=self.level))
        first, ahead = -pitch * (number + 0.5), looper.needle / 2 + looper.gap
        between = (0.0,) if self.params.looper_gauge == self.params.gauge else (0.0, self.params.looper_gauge)
        beside = [first + float(place.origin[2]) + ahead for place in needle_heights(self.params, self.needles)]
        heights = [z + step for z in beside for step in between]
        hooks = [placement(y=looper.arm, z=z) for z in heights if -pitch / 2 <= z + looper.thickness / 2 < pitch / 2]
        arms = [placement(z=side * ARMS * pitch - ARM_THICKNESS / 2) for side in (-1, 1)]
        square = complex(_bar_beside(self.drive), looper.arm - looper.stem - looper.bar / 2)
        placed = (
            (self.shaft, [placement(z=-half)]),
            (self.arm, arms),
            (self.bar, [placement(square.real, square.imag, -half)]),
            (self.hook, hooks),
        )
        return tuple(
            Occurrence(part, tuple(raised.after(place) for place in places)) for part, places in placed if places
        )


def _bar_beside(drive: LooperDrive) -> float:
    """Middle of the bar from the hook's point along the hook [m]: under the stems."""
    return -drive.sense * (BEAK - STEM / 2)


def looper_parts(params: TuftingMachineParams, drive: LooperDrive, mechanism: Mechanism, needles: int) -> LooperParts:
    """The parts of a looper drive; needles: of the whole machine."""
    looper, long = params.looper, params.width / params.drives - BETWEEN
    shaft, pin = looper.shaft, looper.pin_diameter
    section, material = (looper.link_width, looper.link_thickness), looper.strength.of_links
    lengths = drive.lengths
    crank, hole = lengths["crank"], circle(0j, shaft / 2)
    names = {body: (body_id(NAME, body), body) for body in BODIES}
    around = ring(crank, shaft)
    formed = {
        CRANK: eccentric(names[CRANK][0], crank, shaft, section[1], material),
        COUPLER: eyed(names[COUPLER], "AB", lengths["coupler"], section, around, pin, material),
        ROCKER: eyed(names[ROCKER], "PB", lengths["rocker"], section, hole, pin, material),
    }
    size = {body: LinkSize(*section, pin, material) for body in BODIES}
    levels = Levels(((CRANK, COUPLER), (ROCKER,)), size)
    side = looper.bar
    square = Prism(Profile(rectangle(side, side)), long)
    middle = -rocker_angle(drive.linkage, drive.swing)
    return LooperParts(
        params,
        drive,
        needles,
        linkage_parts(NAME, mechanism, levels, formed, ("Q", "A", "P"), of="looper"),
        placement(about=(0.0, 0.0, 1.0), angle=-middle),
        sum(levels.across(list(BODIES))) / 2,
        Part(LOOPER_SHAFT, "looper shaft", "steel bar", bar(shaft, long), STEEL, machined=True),
        _arm(shaft, complex(_bar_beside(drive), looper.arm - looper.stem - side), side),
        Part(LOOPER_BAR, "looper bar", "steel bar", square, STEEL),
        _hook(params, drive.sense),
    )


def _arm(shaft: float, under: complex, side: float) -> Part:
    """An arm on the shaft, flat under the bar: the hull of a wall about the shaft and of the bar's underside."""
    radius = shaft / 2 * (1 + 2 * WALL)
    ends = under - 1j * radius + np.array([-side / 2, side / 2])
    outline = rounded_hull(np.array([0, *ends]), radius)
    shape = Prism(Profile(outline, (circle(0j, shaft / 2),)), ARM_THICKNESS)
    steel = MATERIALS["structural steel"]
    return Part(ARM, "arm of the loopers", "laser-cut part", shape, steel, machined=True)


def _hook(params: TuftingMachineParams, sense: int) -> Part:
    """A looper: its stem on the bar, its beak forward to the point at the origin; along z its thickness."""
    looper = params.looper
    slope = min(2 * looper.height, BEAK / 2)
    corners = np.array(
        [
            0,
            -BEAK,
            -BEAK - 1j * looper.stem,
            -BEAK + STEM - 1j * looper.stem,
            -BEAK + STEM - 1j * looper.height,
            -slope - 1j * looper.height,
        ]
    )
    outline = polygon(corners if sense > 0 else -np.conj(corners))
    title = "looper with its knife's edge" if params.pile == "cut" else "looper"
    shape = Prism(Profile(outline), looper.thickness)
    return Part(LOOPER, title, "laser-cut part", shape, STEEL, joins=(LOOPER_BAR,))
