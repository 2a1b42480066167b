"""The warp opener: where it holds the warps, how far it crowds them, and what it takes to push it in.

Two plates, one below the tools and one above them, hold the warps parallel where the tools work. Their points enter on
both sides of the pair and between the next warps, their slots widen the pair from the pitch p to the distance g, and
their teeth push the nearest neighbours from 1.5 p to the distance w from the middle, evenly over the travel q. So the
wall of a tooth has the slope e/q with e = w - 1.5 p, a slot (g - p)/2q. With the force F of the warps on a wall
[`ilmek.weaving.warp_opening`] and the friction mu, each wall of the slope h takes along the travel

    in  F (h + mu) / (1 - mu h)       out  F (h - mu) / (1 + mu h)       without friction F h, the energy's derivative

                                                [thesis 2.2.3, Figure 2.14: the opener; wedge with friction, derived]
"""

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.elements.materials import MATERIALS
from ilmek.records import computed, record, result
from ilmek.units import mm
from ilmek.weaving.warp_opening import WarpSpans, force_of, shifts, tension_of, wall_force

POSITIONS = 41
"""Positions of the travel at which the force is computed; between them it is interpolated."""

TEETH = (0.8 * mm, 1 * mm, 1.5 * mm, 2 * mm, 2.5 * mm, 3 * mm, 4 * mm, 5 * mm)
"""Widths of its teeth from which the least is chosen."""

LEAST_ROOM = 0.02
"""Least 1 - mu h that counts: below it the wedge is locked, and a check fails."""

STEEL = MATERIALS["heat-treatable steel"]


@record
class Opener:
    """A warp opener.

    pair      distance g in the slots     aside    distance w of the nearest neighbour from the middle [m]
    travel    q that opens the warps      pitch, diameter  of the warps [m]      friction  of yarn on steel
    wall, breadth, reach  of a tooth: width, breadth along the warps of both plates, length that the warps bear on [m]
    sides, slots  force of the warps on a wall, and of a warp of the pair on its slot [N], evenly over the travel
    """

    pair: float
    aside: float
    travel: float
    pitch: float
    diameter: float
    warp: WarpSpans
    friction: float
    wall: float = result("mm", "width of the opener's teeth", name="opener_tooth")
    breadth: float
    reach: float

    sides: FloatArray
    slots: FloatArray

    opener_shift = computed("mm", "displacement of the warp next to the opener", lambda it: it.shift)
    opener_warps = computed("1", "warps that the opener pushes aside, both sides", lambda it: 2 * len(it.shifts))
    opener_side_force = computed("N", "force of the warps on a wall of the opener", lambda it: float(it.sides[-1]))
    opener_warp_tension = computed("N", "tension of the warp that it displaces most", lambda it: it.tension)

    @computed("mm", "width of all warps that the opener displaces, as they stand without it", name="opener_crowd")
    def crowd(self) -> float:
        return (3 + 2 * len(self.shifts)) * self.pitch

    @computed("N", "greatest force that pushes the opener in", name="opener_force_max")
    def force_max(self) -> float:
        return float(np.max(self.force(self.positions, np.ones(POSITIONS))))

    @computed("mm", "deflection of a tooth's end under the force of the warps", name="opener_bend")
    def bend(self) -> float:
        # A cantilever under an even load.                                         [y = w L^4 / 8 E I, w = F / L]
        inertia = self.breadth * self.wall**3 / 12
        return float(self.sides[-1]) * self.reach**3 / (8 * STEEL.modulus * inertia)

    @property
    def shift(self) -> float:
        """Displacement e of the nearest neighbour [m]."""
        return max(self.aside - 1.5 * self.pitch, 0.0)

    @property
    def slot_shift(self) -> float:
        """Displacement of each warp of the pair [m]."""
        return abs(self.pair - self.pitch) / 2

    @property
    def shifts(self) -> Float[np.ndarray, " warps"]:
        """Displacements of the warps on one side, the nearest first [m]."""
        return shifts(self.shift, self.pitch, self.diameter)

    @property
    def tension(self) -> float:
        """Tension of the warp that is displaced most [N]."""
        return float(tension_of(np.array(max(self.shift, self.slot_shift)), self.warp))

    @property
    def positions(self) -> FloatArray:
        """Travels at which the forces are computed [m]."""
        return np.linspace(0.0, self.travel, POSITIONS)

    @property
    def wedge(self) -> float:
        """Slope of its steeper wall times the friction; at 1 it locks."""
        return self.friction * max(self.shift, self.slot_shift) / self.travel

    def force(self, travel: FloatArray, sense: FloatArray) -> FloatArray:
        """Force along the travel against the motion in [N], at travels [m]; beyond the opener's travel friction alone.

        sense  +1 on the way in, -1 on the way out, 0 at rest, where friction is not counted; as many as travels
        """
        total, rub, within = np.zeros(travel.shape), self.friction * sense, travel <= self.travel * (1 + 1e-9)
        for load, shift in ((self.sides, self.shift), (self.slots, self.slot_shift)):
            slope = np.where(within, shift / self.travel, 0.0)
            along = (slope + rub) / np.maximum(1 - rub * slope, LEAST_ROOM)
            total += 2 * np.interp(travel, self.positions, load) * along
        return total


def opener_for(  # noqa: PLR0917
    pair: float,
    aside: float,
    travel: float,
    pitch: float,
    diameter: float,
    warp: WarpSpans,
    friction: float,
    wall: tuple[float, float, float],
) -> Opener:
    """The opener for a pair and its nearest neighbours: see `Opener`.

    wall  width of a tooth, its breadth along the warps in both plates, length that the warps bear on [m]
    """
    share = np.linspace(0.0, 1.0, POSITIONS)
    shift, slot = max(aside - 1.5 * pitch, 0.0), abs(pair - pitch) / 2
    sides = np.array([wall_force(shift * at, pitch, diameter, warp) for at in share])
    return Opener(
        pair, aside, travel, pitch, diameter, warp, friction, *wall, sides=sides, slots=force_of(slot * share, warp)
    )
