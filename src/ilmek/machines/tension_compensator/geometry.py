"""The warps' path over the sprung bar, and the lever that carries it.

Side view of one parity, x to the outside, y up, the sheet of its warps on the line x = 0. The warps run over the outer
sides of two rods at heights +g and -g; between them the bar presses them inwards. Bar and rods are rollers of radius r.
With the angle alpha of a strand to the sheet, D the distance of the centres of bar and rod,

    L = sum of sqrt(D^2 - 4 r^2) + 2 r alpha      force of the bar's warps = T (sin alpha + i cos alpha), both strands

The lever turns about a fixed pivot by phi, clockwise, as the warps drive the bar outwards. Its springs stand on an arm
that is level at rest, and lean by delta towards the pivot: as they are compressed their arm about the pivot becomes
shorter, and the torque rises less than their force.                                [virtual work: arms are -dL/dphi]
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, RealField
from ilmek.records import record


@dataclass(frozen=True, slots=True)
class WarpPath:
    """Two rods at the heights `half` and `-half` [m], and their radius and the bar's [m]."""

    half: float
    radius: float

    def at_rest(self, strand: float) -> complex:
        """Centre of a bar midway that deflects the warps by an angle [rad]."""
        return complex(-self.radius - (self.half * math.sin(strand) - 2 * self.radius) / math.cos(strand))

    def strands(self, bar: ComplexArray) -> tuple[FloatArray, FloatArray]:
        """Angles of the upper and of the lower strand [rad] for centres of the bar [m]; NaN where bar and rod meet."""
        upper, lower = (self._strand(bar, side) for side in (1, -1))
        return upper, lower

    def length(self, bar: ComplexArray) -> FloatArray:
        """Length of the warp from rod to rod [m], but for a constant."""
        total = np.zeros(np.shape(bar))
        for side, angle in zip((1, -1), self.strands(bar), strict=True):
            distance = np.abs(bar - self._rod(side))
            with np.errstate(invalid="ignore"):
                tangent = np.sqrt(distance**2 - 4 * self.radius**2)
            total = total + tangent + 2 * self.radius * angle
        return np.asarray(total)

    def pull(self, bar: ComplexArray) -> ComplexArray:
        """Force of a warp on the bar over its tension."""
        upper, lower = self.strands(bar)
        return np.asarray(np.sin(upper) + np.sin(lower) + 1j * (np.cos(upper) - np.cos(lower)))

    def _rod(self, side: int) -> complex:
        return complex(-self.radius, side * self.half)

    def _strand(self, bar: ComplexArray, side: int) -> FloatArray:
        apart = bar - self._rod(side)
        with np.errstate(invalid="ignore"):
            crossing = np.arcsin(2 * self.radius / np.abs(apart))
        return np.asarray(np.arctan2(-apart.real, -side * apart.imag) + crossing)


@record
class Lever:
    """The lever of a bar.

    path        of the warps                               rest   centre of the bar at rest [m]
    arm, slant  pivot to bar [m], its angle from the warps [rad]
    reach       pivot to the springs [m]                   strut  springs at rest, from pin to pin [m]
    lean        delta, of the springs at rest [rad]
    """

    path: WarpPath
    rest: complex
    arm: float
    slant: float
    reach: float
    strut: float
    lean: RealField

    @property
    def pivot(self) -> complex:
        """Fixed pivot [m]."""
        return self.rest - self.bar_point

    @property
    def bar_point(self) -> complex:
        """Bar in the lever's frame [m]: from the pivot, x along the springs' arm."""
        return complex(self.arm * 1j * np.exp(1j * self.slant))

    @property
    def anchor(self) -> ComplexArray:
        """Fixed pin of the springs [m]."""
        return np.asarray(self.pivot + self.reach - self.strut * 1j * np.exp(1j * np.asarray(self.lean)))

    def bar(self, phi: RealField) -> ComplexArray:
        """Centre of the bar [m]."""
        return np.asarray(self.pivot + self.bar_point * np.exp(-1j * np.asarray(phi)))

    def slack(self, phi: RealField) -> FloatArray:
        """Length of warp that the lever has given since rest [m]."""
        return np.asarray(self.path.length(self.bar(0.0)) - self.path.length(self.bar(phi)))

    def warp_arm(self, phi: RealField) -> FloatArray:
        """Torque of a warp on the lever over its tension [m]: -dL/dphi."""
        bar = self.bar(phi)
        return np.asarray((np.conj(self.path.pull(bar)) * -1j * (bar - self.pivot)).real)

    def spring_length(self, phi: RealField) -> FloatArray:
        """Length of the springs from pin to pin [m]."""
        return np.asarray(np.abs(self.pivot + self.reach * np.exp(-1j * np.asarray(phi)) - self.anchor))

    def spring_moment_arm(self, phi: RealField) -> FloatArray:
        """Arm of the springs' force about the pivot [m]: minus the derivative of their length."""
        end = self.reach * np.exp(-1j * np.asarray(phi))
        along = self.pivot + end - self.anchor
        return np.asarray((np.conj(along / np.abs(along)) * 1j * end).real)
