"""Where the bars and rods of a compensator are supported: levers along the width, saddles of rollers, beams.

Axes of a parity as in `geometry`: x to the outside, y up along the warps; z along the width, 0 in its middle.
"""

import cmath
import math

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.elements.retaining_rings import RetainingRing, retaining_ring
from ilmek.machines.tension_compensator.members import CORNER, SADDLE, STRIP, Members
from ilmek.machines.tension_compensator.params import TensionCompensatorParams
from ilmek.machines.tension_compensator.synthesis import PLAY, SprungLever
from ilmek.records import record
from ilmek.units import mm

BEHIND = 5 * mm
"""The rods' beam before the axis of the rear rod [m]: it leaves room for that of the back rest; assumed."""


@record
class BarSupports:
    """Where the bars and rods of a compensator are supported: at the levers along the width, by saddles of rollers."""

    params: TensionCompensatorParams
    sprung: SprungLever
    members: Members

    @property
    def stations(self) -> tuple[float, ...]:
        """Middles of equal parts of the width [m]."""
        number = self.params.levers
        step = self.params.cloth.width / number
        return tuple(step * (k + 0.5 - number / 2) for k in range(number))

    @property
    def springs_wide(self) -> float:
        """Of the pin that carries the springs of a lever, between its rings, as far beside it on both sides [m]."""
        beside = math.ceil(self.sprung.springs / 2) * self.sprung.pitch
        return self.params.lever_thickness + 2 * max(beside, 5 * PLAY)

    @property
    def spring_ring(self) -> RetainingRing:
        """The ring that holds the eyes on their pin, at both ends."""
        return retaining_ring(self.members.spring_pin)

    @property
    def spring_stations(self) -> tuple[float, ...]:
        """Positions of the springs along the width [m]: beside their lever, on both sides in turn."""
        pitch, thick = self.sprung.pitch, self.params.lever_thickness
        offsets = [(-1) ** k * (thick / 2 + pitch * (k // 2 + 0.5)) for k in range(self.sprung.springs)]
        return tuple(z + offset for z in self.stations for offset in offsets)

    @property
    def bar(self) -> complex:
        """Axis of the bar from the pivot at rest [m]."""
        return self.sprung.lever.bar_point

    @property
    def reach(self) -> complex:
        """Pin of the springs from the pivot at rest [m]."""
        return complex(self.sprung.lever.reach)

    @property
    def clear(self) -> float:
        """From a pivot to the face of its beam, of which the lever keeps clear as it turns [m]."""
        return self.members.lever / 2 + PLAY + self.members.beam.side / 2 * math.sin(abs(self.sprung.angle))

    @property
    def apart(self) -> float:
        """From the springs' anchor to the face of its beam [m]."""
        return 2 * self.members.spring_pin

    @property
    def along(self) -> complex:
        """Direction of the springs at rest, from their anchor to the lever."""
        lever = self.sprung.lever
        strut = lever.pivot + lever.reach - complex(lever.anchor)
        return strut / abs(strut)

    @property
    def cross(self) -> ComplexArray:
        """Corners of the piece that carries the saddles of both rods [m]: inside of the bar at rest, flat on its beam.

        Its front is half as high as its rear: (1 + u) / 2 is nowhere below sqrt(u), the height of equal stress.
        """
        path, lever, strip, members = self.sprung.lever.path, self.sprung.lever, self.strip, self.members
        high, half = members.cross, path.half
        top = float(self.saddle(complex(-path.radius), -1)[1].real) + strip
        inside = min(top, lever.rest.real - path.radius - PLAY)
        flat = max(half - BEHIND - members.beam.side / 2, -half)
        corners = [top - 1j * (half + strip), top - 1j * (half - strip), inside - 1j * (half - strip)]
        corners += [inside + 1j * (half - strip), top + 1j * (half - strip), top + 1j * (half + strip)]
        corners += [inside - high + 1j * (half + strip), inside - high + 1j * flat]
        corners += [inside - max(high / 2, 2 * strip) - 1j * (half + strip)]
        return np.array([one for k, one in enumerate(corners) if abs(one - corners[k - 1]) > 1e-9])

    @property
    def low(self) -> float:
        """The most that the cross-pieces reach inside of the sheet, x [m]."""
        return float(self.cross.real.min())

    @property
    def strip(self) -> float:
        """Half of the width of a saddle [m]."""
        return STRIP * self.members.roller.bore

    @property
    def beams(self) -> tuple[tuple[complex, complex], ...]:
        """Axes of the beams of levers, rods and springs [m], and the directions of their sides."""
        lever, half = self.sprung.lever, self.members.beam.side / 2
        rods = complex(self.low - half, lever.path.half - BEHIND)
        springs = complex(lever.anchor) - (self.apart + half) * self.along
        beside = max(lever.pivot.real, half + 3 * PLAY)  # a wide beam reaches to the sheet of the warps
        levers = complex(beside, lever.pivot.imag - self.clear - half)
        return (levers, 1 + 0j), (rods, 1 + 0j), (springs, self.along)

    def saddle(self, axis: complex, towards: complex) -> ComplexArray:
        """Centres of a roller, of the saddle's corner and of the other roller, behind a bar in a direction [m]."""
        out, radius, roller = towards / abs(towards), self.sprung.lever.path.radius, self.members.roller
        apart = radius + roller.outer / 2
        corner = radius + CORNER * roller.outer
        turned = cmath.exp(1j * SADDLE)
        return axis + out * np.array([apart * turned, corner, apart / turned])
