"""What drives the arms of a head: servos behind, belts to the pivots, a shaft in a sleeve, a belt on each arm.

Axes are those of the section and, z along the warps, to the fell. A plate over the arms bears at each pivot a sleeve,
and in it a shaft. The sleeve is fixed in the first link. The shaft passes through this, and a belt on the first link
takes it to the elbow, where a pulley is fixed on the second link, which so turns as far as the shaft.

    over the plate     pulleys of sleeve and shaft, and the belts from the servos to them
    under the links    pulleys of shaft and second link, and their belt

The servos hang at the level of the plate, their shafts upright. All pulleys are alike, r their pitch radius:

    F = M / r          pull of a belt by the torque M of its joint
"""

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from ilmek.elements.belts import BELTS
from ilmek.elements.materials import MATERIALS
from ilmek.machines.knotting_dyad.head import Head
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.part.catalogue import SPECIAL_FACE
from ilmek.part.part import Bought, Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile, drilled
from ilmek.part.shapes import Placed, Prism, Shape, Sum, bar, rectangle, tube
from ilmek.part.tree import Occurrence
from ilmek.plane.contours import circle, polygon, rounded_hull
from ilmek.records import record
from ilmek.report import Hole
from ilmek.units import in_mm, mm, turn

if TYPE_CHECKING:
    from ilmek.machines.knotting_dyad.drives import HeadMotion

PROFILE, TEETH, BELT = BELTS["T2.5"], 15, 4 * mm
"""Belts of the arms, teeth of their pulleys, their width [m]."""

RADIUS = PROFILE.pitch_radius(TEETH)
"""Pitch radius of the pulleys [m]."""

BACK, ON_PULLEY = 0.6 * mm, 0.05 * mm
"""A belt outside of its pitch line, and its room on the teeth of a pulley [m]: it is drawn without its own."""

WALL, SERVO_SHAFT, PLATE, ROOM = 1.5 * mm, 5 * mm, 8 * mm, 0.5 * mm
"""Wall of a sleeve, diameter of the servos' shafts, thickness of the plate, room between what turns [m]; assumed
by this project."""

HUB = 1.7 * mm
"""Height under the second link of its hub, in which the tail of its finger moves [m]; assumed by this project."""

BONDED = "bonded with epoxy resin"
"""How parts of a few grams are held that have no room for screws."""

ELBOW_SCREWS = "its maker's screws, through the link"
"""How a servo stands in an elbow."""

EDGE = 3 * mm
"""Of the plate about a sleeve [m]; assumed by this project."""

STEEL, ALUMINIUM = MATERIALS["heat-treatable steel"], MATERIALS["aluminium alloy"]

NAME = "knotting-dyad"
SLEEVE, SHAFT, SHAFT_PULLEY, ELBOW_HUB, ELBOW_PULLEY, ARM_PLATE = (
    f"{NAME}/sleeve",
    f"{NAME}/elbow-shaft",
    f"{NAME}/shaft-pulley",
    f"{NAME}/elbow-hub",
    f"{NAME}/elbow-pulley",
    f"{NAME}/frame",
)
ELBOW_BELT, SERVO_BELTS = f"{NAME}/elbow-belt", (f"{NAME}/first-belt", f"{NAME}/second-belt")
"""Ids of the parts."""

OUTSIDE = RADIUS + BACK
"""From the axis of a pulley to the back of its belt [m]."""

BELTS_OVER = 2 * (ROOM + BELT)
"""From the plate of the arms up to the top of the belts over it [m]."""


def behind(head: Head) -> float:
    """From the warps' axes to the face behind the arms: clear of elbows with their belts at rest, and of pivots [m]."""
    elbows = head.arm.elbow(np.linspace(0.0, 1.0, 33)).imag
    return max(float(np.max(elbows)), head.arm.pivot.imag) + OUTSIDE + ROOM


def beside(head: Head) -> float:
    """From the middle of the pair to the outer side of the pivots' belts [m]."""
    return head.section.middle - head.arm.pivot.real + OUTSIDE


@record
class DriveLevels:
    """Heights along z of the drives [m].

    top    of the first links            elbow  where the belts on the arms begin
    plate  under the plate of the arms
    """

    top: float
    elbow: float
    plate: float

    @property
    def covered(self) -> float:
        """Over the plate."""
        return self.plate - PLATE

    @property
    def first(self) -> float:
        """Over the belts of the first links."""
        return self.covered - ROOM - BELT

    @property
    def second(self) -> float:
        """Over the belts of the second links."""
        return self.first - ROOM - BELT


def drive_levels(params: KnottingDyadParams, bottoms: Mapping[str, float]) -> DriveLevels:
    """The heights of the drives; bottoms: of the links by name, as `link_tree.Levels` has them [m]."""
    thick = params.link_thickness
    needle = bottoms["link 2"] + thick / 2
    return DriveLevels(bottoms["link 1"], bottoms["link 2"] + thick + HUB + ROOM, needle - params.room.level)


def sleeve(levels: DriveLevels, hole: float) -> Occurrence:
    """The sleeve of a first link with its pulley, about the pivot; hole: diameter of the shaft in it [m]."""
    outer = hole + 2 * WALL
    pipe = Placed(tube(outer, WALL, levels.top - levels.first), (placement(z=levels.first),))
    ring = Placed(_pulley(outer), (placement(z=levels.first),))
    return _made(SLEEVE, "sleeve of a first link, with its pulley", Sum((pipe, ring)), BONDED)


def shaft(levels: DriveLevels, hole: float) -> tuple[Occurrence, Occurrence]:
    """The shaft of a second link with the pulley at the elbow's belt, about the pivot, and the other pulley, which is
    pressed on when the shaft is in its sleeve.
    """
    rod = Placed(bar(hole, levels.elbow + BELT - levels.second), (placement(z=levels.second),))
    ring = Placed(_pulley(hole), (placement(z=levels.elbow),))
    made = _made(SHAFT, "shaft of a second link, with its pulley", Sum((rod, ring)))
    pulley = _made(SHAFT_PULLEY, "pulley on the shaft of a second link", _pulley(hole))
    return made, Occurrence(pulley.part, (placement(z=levels.second),))


def elbow_hub(levels: DriveLevels, hole: float, around: float, belted: bool) -> Iterator[Occurrence]:
    """The hub of a second link, open to the front for its finger's tail; the pulley on what goes on behind, of a
    diameter around [m].
    """
    outer, inner = hole / 2 + WALL, hole / 2
    open_ = math.asin(inner / outer)
    arc = outer * np.exp(1j * np.linspace(open_, turn - open_, 33))
    bore = inner * np.exp(1j * np.linspace(3, 1, 17) * turn / 4)
    hub = Prism(Profile(polygon(np.concatenate([arc, bore]))), HUB)
    made = _made(ELBOW_HUB, "hub of an elbow", hub, BONDED)
    yield Occurrence(made.part, (placement(z=levels.elbow - ROOM - HUB),))
    if belted:
        ring = _made(ELBOW_PULLEY, "pulley of an elbow", _pulley(around))
        yield Occurrence(ring.part, (placement(z=levels.elbow),))


def elbow_belt(levels: DriveLevels, length: float) -> Occurrence:
    """The belt on a first link of a length [m], from its pivot along x."""
    return Occurrence(_belt(ELBOW_BELT, "belt of an elbow", length), (placement(z=levels.elbow),))


def standing_drives(
    params: KnottingDyadParams, head: Head, levels: DriveLevels, motion: "HeadMotion", rear: float
) -> Iterator[Occurrence]:
    """The plate of the arms, the belts from the servos, and the servos' shafts with their pulleys.

    Where the second servos are in the elbows, the first alone.

    rear  where the centre gripper's axis ends, from the warps' axes [m]
    """
    yield _plate(params, head, levels, motion, rear)
    pivot, middle = head.arm.pivot, head.section.middle
    rows = list(zip(SERVO_BELTS, (levels.first, levels.second), strict=True))[: standing_servos(params)]
    for number, (name, z) in enumerate(rows):
        servo = servo_axis(params, head, motion, number)
        way = servo - pivot
        belt = _belt(name, f"belt of the {('first', 'second')[number]} links", abs(way))
        turned = [(pivot, way), (complex(2 * middle - pivot.real, pivot.imag), complex(-way.real, way.imag))]
        positions = tuple(
            placement(at.real, at.imag, z, about=(0.0, 0.0, 1.0), angle=float(np.angle(along))) for at, along in turned
        )
        yield Occurrence(belt, positions)
        stub = bar(SERVO_SHAFT, levels.plate - z)
        pulley = Sum((Placed(stub), Placed(_pulley(SERVO_SHAFT))))
        own = _made(f"{NAME}/servo-pulley-{number + 1}", "pulley on the shaft of a servo", pulley)
        yield Occurrence(own.part, tuple(placement(at.real, at.imag, z) for at in both(head, servo)))


def standing_servos(params: KnottingDyadParams) -> int:
    """Servos of an arm that stand in the head."""
    return 2 if params.elbow_drive == "belt" else 1


def servo_face(motion: "HeadMotion") -> float:
    """Side of the greater flange of the servos [m]."""
    return max(joint.motor.face if joint.motor else SPECIAL_FACE for joint in motion.joints)


def servo_axis(params: KnottingDyadParams, head: Head, motion: "HeadMotion", number: int) -> complex:
    """The axis of the left arm's servo of its first link, 0, or its second, 1, behind the other [m]."""
    depth = params.room.depth + number * (servo_face(motion) + 2 * ROOM)
    return complex(head.section.middle - params.room.aside, depth)


def both(head: Head, at: complex) -> tuple[complex, complex]:
    """A point of the left arm, and its mirror image [m]."""
    return at, complex(2 * head.section.middle - at.real, at.imag)


def _plate(
    params: KnottingDyadParams, head: Head, levels: DriveLevels, motion: "HeadMotion", rear: float
) -> Occurrence:
    """The plate in front of the face, with the bores of the sleeves; where there is no face, it carries the servos and
    the centre gripper's axis too.
    """
    outer, pivot, middle = motion.hole + 2 * WALL, head.arm.pivot, head.section.middle
    far = params.room.face
    half = abs(middle - pivot.real) + outer / 2 + EDGE  # where no arm fits, the pivots may lie crosswise
    bores = [Hole(at, outer / 2) for at in both(head, pivot)]
    if far is None:
        servos, room = range(standing_servos(params)), servo_face(motion) / 2 + EDGE
        axes = [at for number in servos for at in both(head, servo_axis(params, head, motion, number))]
        bores += [Hole(at, SERVO_SHAFT / 2 + ROOM) for at in axes]
        far, half = max(rear, room + max(at.imag for at in axes)), max(half, params.room.aside + room)
    near = min(hole.at.imag - hole.radius for hole in bores) - EDGE
    outline = polygon(rectangle(2 * half, far - near).points + complex(middle, (near + far) / 2))
    part = Part(ARM_PLATE, "plate of the arms", "machined link", Prism(drilled(outline, bores), PLATE), ALUMINIUM)
    return Occurrence(part, (placement(z=levels.covered),))


def _belt(name: str, title: str, length: float) -> Part:
    """A belt on two pulleys whose axes are a length [m] apart along x."""
    axes = np.array([0j, complex(length)])
    section = Profile(rounded_hull(axes, OUTSIDE), (rounded_hull(axes, PROFILE.tip_radius(TEETH) + ON_PULLEY),))
    whole = 2 * length + turn * RADIUS
    bought = Bought(PROFILE.name, PROFILE.mass * BELT * whole, length=whole)
    size = f"{PROFILE.name}, {in_mm(BELT)} wide"
    return Part(name, title, "belt and pulleys", Prism(section, BELT), purchase=bought, size=size)


def _pulley(bore: float) -> Shape:
    return Prism(Profile(PROFILE.pulley_outline(TEETH), (circle(0j, bore / 2),)), BELT)


def _made(name: str, title: str, shape: Shape, fixing: str = "") -> Occurrence:
    return Occurrence(Part(name, title, "turned part", shape, STEEL, fixing=fixing))
