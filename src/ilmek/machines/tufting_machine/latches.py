"""Latches of needles that are selected (`pattern.selection=needles`): which needles of a stroke go down.

A needle slides in its bar. A solenoid on the bar's face pushes its plunger into a notch of the needle, which then goes
down with the bar; a spring draws it back, for needles that stay up. Plunger and notch meet where the bar is highest; so
both have the time in which it is off its highest position by less than their play:

    t = share of the turn with S - rise <= play, over the speed          closing, and opening, each <= t
                                                        [`elements.solenoids`: current, then the mass of the plunger]

What keeps a needle up while its bar is down, such as a clip at its head, is not designed.
"""

import math

import numpy as np

from ilmek.elements.solenoids import PEAK, Solenoid, shortest
from ilmek.machines.tufting_machine.loop import NeedlePath
from ilmek.machines.tufting_machine.params import BY_NEEDLE, TuftingMachineParams
from ilmek.part.part import Bought, Part, bought_part
from ilmek.part.placement import Placement, placement
from ilmek.part.shapes import bar
from ilmek.records import computed, record
from ilmek.report import Check, at_most
from ilmek.units import mm, turn

LATCH = "tufting-machine/latch"

SPRING, OVER = 0.5, 2.0
"""Force of the spring that opens a latch [N], and of its solenoid over that of the spring; assumed by this project."""

BETWEEN = 0.5 * mm
"""Between two solenoids; assumed by this project."""


@record
class NeedleLatches:
    """The latches of a machine.

    row  solenoid of each      load  greatest force of the backing on a needle [N]
    """

    params: TuftingMachineParams
    needles: int
    path: NeedlePath
    row: Solenoid
    load: float

    latch_window = computed(
        "ms", "time in which the needle bar is so high that latches meet their needles", lambda it: it.window
    )
    latch_time = computed("ms", "time of a latch, closing or opening, the longer", lambda it: max(it.times))
    latch_power = computed(
        "W",
        "power of all latches, held: of the needles of one colour",
        lambda it: it.row.holds_with(SPRING) * it.lowered,
    )
    latch_tiers = computed("1", "tiers of latches on each side of the needle bar", lambda it: tiers(it.params, it.row))
    latch_shear = computed("MPa", "shear of a latch under the force of the backing", lambda it: it.load / it.row.area)

    @property
    def lowered(self) -> float:
        """Needles that go down at a stroke, in the mean [1]."""
        return self.needles / self.params.pattern.colours

    @property
    def window(self) -> float:
        """Time near the highest position [s]."""
        angle = np.linspace(0.0, turn, 7201)[:-1]
        near = self.path.stroke - self.path.rise(angle) <= self.params.needle_bar.notch
        return float(np.mean(near)) * turn / self.params.needle.speed

    @property
    def times(self) -> tuple[float, float]:
        """Of closing and opening [s]."""
        gap, row = self.params.needle_bar.bolt, self.row
        over = row.force(gap, PEAK * row.power) - SPRING
        return row.closes_in(gap, SPRING, over, row.moving), row.opens_in(gap, SPRING, row.moving)

    @property
    def checks(self) -> tuple[Check, ...]:
        """Time, room, strength."""
        own, height = self.params.needle_bar, tiers(self.params, self.row) * (self.row.diameter + BETWEEN)
        return (
            at_most(
                "latches move while their notches meet them", max(self.times), self.window, "ms", "parameter notch"
            ).with_cure("set a lower needle.speed, or a higher needle_bar.notch", LATCH),
            at_most(
                "latches over each other on the needle bar", height, own.height, "mm", "needle_bar.height"
            ).with_cure("set a higher needle_bar.height, or a wider gauge", LATCH),
            at_most("shear of a latch", self.latch_shear, own.latch_shear, "MPa", "parameter").with_cure(
                "set fewer needles to a drive, or softer penetration", LATCH
            ),
        )


def solenoid_of(params: TuftingMachineParams) -> Solenoid:
    """The shortest solenoid that moves a latch."""
    return shortest(params.needle_bar.bolt, OVER * SPRING, OVER * SPRING)


def tiers(params: TuftingMachineParams, row: Solenoid) -> int:
    """Tiers of latches on each side of the bar: every other needle has its own in front."""
    return math.ceil((row.diameter + BETWEEN) / (2 * params.gauge) - 1e-9)


def latch_part(params: TuftingMachineParams) -> Part | None:
    """The latch of a needle; None where none are selected."""
    if params.pattern.selection != BY_NEEDLE:
        return None
    row = solenoid_of(params)
    bought = Bought(row.designation, row.mass, power=row.power)
    held = "bonded on the needle bar"
    return bought_part(LATCH, "latch of a needle", "solenoid", bar(row.diameter, row.length), bought, fixing=held)


def latch_positions(params: TuftingMachineParams, heights: tuple[Placement, ...]) -> tuple[Placement, ...]:
    """Where the latches of needles are, on the faces of the bar whose upper side is at y = 0.

    heights  of the needles along z
    """
    row, own = solenoid_of(params), params.needle_bar
    pitch, number = row.diameter + BETWEEN, tiers(params, row)
    places = []
    for count, place in enumerate(heights):
        side, tier = 1 if count % 2 else -1, (count // 2) % number
        across = placement(about=(0.0, 1.0, 0.0), angle=side * math.pi / 2)
        at = placement(side * own.thickness / 2, -pitch * (tier + 0.5), float(place.origin[2]))
        places.append(at.after(across))
    return tuple(places)


def needle_latches(params: TuftingMachineParams, needles: int, path: NeedlePath, load: float) -> NeedleLatches | None:
    """The latches of a machine; None where no needles are selected. load: of the backing on a needle [N]."""
    if params.pattern.selection != BY_NEEDLE:
        return None
    return NeedleLatches(params, needles, path, solenoid_of(params), load)
