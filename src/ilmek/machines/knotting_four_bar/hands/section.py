"""The inclined plane of the hands: where it cuts the warps, the fingers' arc, and the clearance of a finger.

The section across the warps has x along the row and y towards the pile. The plane of the hands holds y, and is inclined
to the section by b: with u along it and n across it

    x = u cos b - n sin b

A warp, along the third axis, has from a point the distance that its axis has in the section. So the plane may be
inclined as one likes: a hand of the size h ties on warps of the pitch p like one of the size h on warps p / cos b
apart. In the plane the fingers are arcs about C: through the gap beside its warps, behind them by the depth d, and up
between both groups, half a chord g apart

    R = (g² + d²) / 2 d,   g = m p / (2 cos b)                  m warps in each group

The finger's foot is beyond the standoff H over the warps. The circle ends 2 R - d = g²/d over them, and d has to leave
the warps their clearance, d >= d0. So no arc does in a plane of g² < d0 H, that is of

    cos b > m p / (2 sqrt(d0 H))

A finger that turns about C moves along itself, and clears what it has once passed. A pivot in C would do; a four-bar
turns its coupler about C as nearly as the gaps allow, with its pivots elsewhere.               [derived here]
"""

import math

import numpy as np

from ilmek.arrays import Complex, ComplexArray, FloatArray
from ilmek.elements.materials import MATERIALS
from ilmek.machines.knotting_four_bar.hands.task import HandsTask
from ilmek.records import record
from ilmek.units import mm

NEIGHBOURS = 4
"""Warps on each side of the knot in the proof of the yarn's path."""

FINGER = MATERIALS["heat-treatable steel"]
"""Of the fingers."""

FOOT = 3 * mm
"""Room about the pillar that joins a finger to its coupler: half the width of the links [m]."""


def least_inclination(task: HandsTask) -> float:
    """Inclination [rad] below which no arc both clears the warps and reaches over the standoff."""
    flat = InclinedSection(task, 0.0)
    chord = math.sqrt(flat.least_depth * (task.standoff + FOOT))
    return math.acos(min(flat.half_chord / chord, 1.0))


@record
class InclinedSection:
    """The task in a plane of an inclination [rad]."""

    task: HandsTask
    inclination: float

    @property
    def cosine(self) -> float:
        """Cos b."""
        return math.cos(self.inclination)

    @property
    def half_chord(self) -> float:
        """From the middle of a group to that of the gap beside it, in the plane [m]: g."""
        return self.task.each * self.task.cloth.warp_pitch / (2 * self.cosine)

    @property
    def warps(self) -> Complex[np.ndarray, " warps"]:
        """Axes of all warps in the section from left to right, 0 in the middle of the knot [m]."""
        count = 2 * (self.task.each + NEIGHBOURS)
        return (np.arange(count) - (count - 1) / 2) * self.task.cloth.warp_pitch + 0j

    @property
    def least_depth(self) -> float:
        """Of an arc that leaves the warps their clearance [m]."""
        return self.task.warp / 2 + self.task.finger_width / 2 + self.task.clearance

    @property
    def highest(self) -> float:
        """Top of the highest circle of such arcs over the warps' axes [m]: g²/d."""
        return self.half_chord**2 / self.least_depth

    @property
    def apart(self) -> float:
        """Distance of the middle planes of both fingers [m]: e."""
        return self.task.finger_thickness + 2 * self.task.clearance

    @property
    def shift(self) -> float:
        """By which each hand lies off the middle of the knot along u [m]: e tan b / 2."""
        return self.apart / 2 * math.tan(self.inclination)

    def bent(self, length: FloatArray) -> FloatArray:
        """Bending of the tip of a finger in its plane by the yarn [m]: a straight cantilever as long as its arc [m]."""
        task = self.task
        stiffness = FINGER.modulus * task.finger_thickness * task.finger_width**3 / 12
        return np.asarray(task.yarn_pull * length**3 / (3 * stiffness))

    @property
    def reach(self) -> float:
        """Half of what a finger takes along x because of its thickness [m]."""
        return self.task.finger_thickness / 2 * math.sin(self.inclination)

    def radius(self, depth: FloatArray) -> FloatArray:
        """R [m] for a depth d [m] behind the warps' axes."""
        return np.asarray((self.half_chord**2 + depth**2) / (2 * depth))

    def projected(self, points: ComplexArray) -> ComplexArray:
        """Points of the plane in the section [m]."""
        return np.asarray(points.real * self.cosine + 1j * points.imag)

    def clearance(self, points: ComplexArray) -> FloatArray:
        """Least distance of a finger's points in the plane from the warps of an endless row [m], over the last axes.

        points  (..., samples, points) [m]
        """
        pitch = self.task.cloth.warp_pitch
        x = points.real * (self.cosine / pitch) - 0.5
        beside = np.maximum(np.abs(x - np.round(x)) * pitch - self.reach, 0.0)
        return np.asarray(np.sqrt(np.min(beside**2 + points.imag**2, axis=(-1, -2))) - self.task.warp / 2)


def finger_points(centre: ComplexArray, radius: FloatArray, span: FloatArray, width: float, count: int) -> ComplexArray:
    """Points of both edges and of the middle line of fingers whose tips are lowest, (fingers, 3 count) [m].

    centre, radius  of their arcs [m]      span  from tip to foot [rad]      width  [m]; the tip reaches half of it on
    """
    angle = np.linspace(-width / 2 / radius, span, count, axis=-1)
    edges = radius[:, None] + np.array([-0.5, 0.0, 0.5]) * width
    points = centre[:, None, None] - 1j * edges[:, :, None] * np.exp(-1j * angle[:, None, :])
    return np.asarray(points.reshape(len(centre), -1))
