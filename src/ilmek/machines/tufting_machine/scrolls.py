"""The pattern attachment with a scroll for each needle: plates over the bed, a stepper with its scroll in each hole.

As a motor is wider than a gauge, the needles' scrolls stand in tiers, a plate for each, needle by needle in turn.
"""

import math
from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from ilmek.elements.materials import MATERIALS
from ilmek.machines.tufting_machine.feed import SCROLL_DIAMETER, YARN_ROLLER, scroll_motor
from ilmek.machines.tufting_machine.layout import BED, TuftingLayout
from ilmek.machines.tufting_machine.needle_parts import needle_heights
from ilmek.machines.tufting_machine.rocker_parts import NAME
from ilmek.part import catalogue
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism, disc
from ilmek.part.tree import Joint, JointKind, Occurrence, RigidBody
from ilmek.plane.contours import circle, polygon
from ilmek.records import record
from ilmek.units import mm

PLATE, BESIDE, FREE, WIDE = 8 * mm, 2 * mm, 2 * mm, 10 * mm
"""Thickness of the plate, gap between motors, of a shaft in its hole and of a scroll to the plate, width of a scroll;
assumed by this project."""

TOWARDS = placement(about=(0.0, 1.0, 0.0), angle=-math.pi / 2)
"""A part along z, turned towards the needles, against x."""

MOTOR = f"{NAME}/yarn-motor"


@record
class Scrolls:
    """Where the scrolls are: x of the plates' face with the motors [m], lower end and height of the plates along y [m],
    their number, axes as (z, y) of the needles in turn [m].
    """

    face: float
    low: float
    pitch: float
    tiers: int
    axes: tuple[complex, ...]

    @property
    def top(self) -> float:
        """Upper end of the plates [m]."""
        return self.low + self.tiers * self.pitch


@lru_cache(maxsize=4)
def scrolls(laid: TuftingLayout, low: float) -> Scrolls:
    """The scrolls over a height [m]."""
    params, needles = laid.machine.params, laid.machine.carpet.needles
    row = scroll_motor(laid.machine.feed)
    pitch = (row.face if row else catalogue.SPECIAL_FACE) + BESIDE
    tiers = min(needles, math.ceil(pitch / params.gauge))
    heights = (laid.left + float(at.origin[2]) for at in needle_heights(params, needles))
    axes = tuple(complex(z, low + (number % tiers + 0.5) * pitch) for number, z in enumerate(heights))
    return Scrolls(laid.line + BED + PLATE, low, pitch, tiers, axes)


def scroll_parts(laid: TuftingLayout, low: float) -> Iterator[Occurrence]:
    """The plates between the end plates, and the motors on them."""
    at, (first, last) = scrolls(laid, low), laid.ends
    motor, shaft = _motor(laid)
    joins = (f"{NAME}/end-plate",)
    outline = polygon(np.array([first, last, last + 1j * at.pitch, first + 1j * at.pitch]))
    for tier in range(at.tiers):
        low = at.low + tier * at.pitch
        holes = tuple(circle(axis - 1j * low, shaft / 2 + FREE) for axis in at.axes[tier :: at.tiers])
        shape = Prism(Profile(outline, holes), PLATE)
        name = f"{NAME}/scroll-plate-{tier + 1}"
        plate = Part(name, f"plate of scrolls {tier + 1}", "laser-cut part", shape, _STEEL, joins=joins)
        # The profile's x runs along z of the machine, its normal against x.
        yield Occurrence(plate, (placement(at.face, low).after(TOWARDS),))
    yield Occurrence(motor, tuple(_on(at, axis, 0.0) for axis in at.axes))


def scroll_bodies(laid: TuftingLayout, low: float, frame: str) -> Iterator[RigidBody]:
    """A scroll on the shaft of each motor."""
    at, (_, shaft) = scrolls(laid, low), _motor(laid)
    shape = Prism(disc(SCROLL_DIAMETER / 2, circle(0j, shaft / 2)), WIDE)
    part = Part(YARN_ROLLER, "scroll of a needle's yarn", "machined link", shape, MATERIALS["aluminium alloy"])
    joint = Joint(JointKind.PIN, motor=MOTOR)
    for number, axis in enumerate(at.axes, 1):
        yield RigidBody(f"{YARN_ROLLER} {number}", (Occurrence(part),), frame, joint, (_on(at, axis, PLATE + FREE),))


_STEEL = MATERIALS["structural steel"]


def _on(at: Scrolls, axis: complex, out: float) -> Placement:
    """On the axis (z, y) of a scroll, so far from the motor's flange towards the needles [m]."""
    return placement(at.face - out, axis.imag, axis.real).after(TOWARDS)


def _motor(laid: TuftingLayout) -> tuple[Part, float]:
    """The motor of a scroll with its shaft through the plate, and that shaft's diameter [m]."""
    feed = laid.machine.feed
    row = scroll_motor(feed)
    shaft = catalogue.motor_shaft(row)
    through = shaft, PLATE + FREE + WIDE
    title = "stepper of a scroll"
    return catalogue.motor(MOTOR, title, row, feed.torques["yarn"], feed.speeds["yarn"], shaft=through), shaft
