"""Where the shafts, the frame and the width of a tufting machine are.

Axes are those of the needle drive: x along the backing's travel, y up, z along the shafts, 0 at the lowest plane of the
first drive. The head's beam is behind the needle drives, the loopers' below their linkages, both clear of what moves.
"""

from functools import lru_cache

import numpy as np

from ilmek.machines.tufting.links import WALL, eccentric_radius, mechanism_depth, needle_parts
from ilmek.machines.tufting.strength import needle_sizes
from ilmek.machines.tufting_machine.design import TuftingMachine
from ilmek.machines.tufting_machine.rocker_parts import CLEAR, looper_bearing
from ilmek.records import record
from ilmek.units import mm

BEYOND = 60 * mm
"""From the outermost needle to an end plate; assumed by this project."""

BED = 100 * mm
"""Half of the bed plate's width about the needles' line; assumed by this project."""


@record
class TuftingLayout:
    """Where things are [m].

    planes       least and greatest height of the first needle drive along z      left  first end of the tufted width
    behind       face of the head's beam, along x                               low  top of the loopers' beam
    crank_shaft, shaft  of the loopers             knives  shaft of the knives of cut pile, if any
    rear, front  axes of the spiked rollers along x
    """

    machine: TuftingMachine
    planes: tuple[float, float]
    left: float
    behind: float
    low: float
    crank_shaft: complex
    shaft: complex
    knives: tuple[complex, ...]
    rear: float
    front: float

    @property
    def pitch(self) -> float:
        """Distance of the drives along z [m]."""
        return self.machine.params.width / self.machine.params.drives

    @property
    def ends(self) -> tuple[float, float]:
        """Inner faces of the end plates along z [m]."""
        return self.left - BEYOND, self.left + self.machine.params.width + BEYOND

    @property
    def line(self) -> float:
        """The needles' line along x [m]."""
        needle = self.machine.needle.params
        return needle.shaft_distance + needle.needle_distance

    @property
    def driven_shaft(self) -> complex:
        """Driven shaft of the needle drives [m]."""
        needle = self.machine.needle.params
        return complex(needle.shaft_distance, needle.shaft_height)

    @property
    def under(self) -> float:
        """Under side of the backing [m]."""
        return self.machine.lowest + self.machine.loop.geometry.under

    @property
    def needle_sides(self) -> tuple[float, float]:
        """Both sides of the room of the first push rod along z [m]."""
        needle = self.machine.needle
        return needle_parts(needle.params, needle_sizes(needle)).levels.across(["needle"])

    @property
    def needle_level(self) -> float:
        """Middle of the first push rod along z [m]: of the plane of the needles."""
        return sum(self.needle_sides) / 2

    def middle(self, drive: int) -> float:
        """Middle of a drive, counted from 0, along z [m]."""
        return self.left + (drive + 0.5) * self.pitch


@lru_cache(maxsize=8)
def layout(machine: TuftingMachine) -> TuftingLayout:
    """Where the parts of a machine are."""
    params, needle, sizes = machine.params, machine.needle.params, needle_sizes(machine.needle)
    planes = mechanism_depth(needle, sizes)
    looper = machine.looper_forces.moves
    head = needle.crank + eccentric_radius(needle.crank, sizes.main) * (1 + 2 * WALL)
    around, crank = ring_radius(machine), looper.drive.lengths["crank"]
    line, roller = needle.shaft_distance + needle.needle_distance, params.feed.spiked_roller / 2
    links = min(looper.crank_shaft.real - crank - around, _reached(machine).real)
    return TuftingLayout(
        machine,
        planes,
        sum(planes) / 2 - params.width / params.drives / 2,
        -head - CLEAR,
        _reached(machine).imag - CLEAR,
        looper.crank_shaft,
        looper.shaft,
        (machine.knife.moves.shaft,) if machine.knife else (),
        min(links, line - BED) - roller - CLEAR,
        line + BED + roller + CLEAR,
    )


def ring_radius(machine: TuftingMachine) -> float:
    """Radius of the coupler's ring about the looper's eccentric [m]."""
    return eccentric_radius(machine.looper.rocker.lengths["crank"], machine.params.looper.shaft) * (1 + 2 * WALL)


def _reached(machine: TuftingMachine) -> complex:
    """Least x and least y that looper links and the walls about their shafts' bearings reach [m]."""
    moves, width = machine.looper_forces.moves, machine.params.looper.link_width
    wall, (crank, _, rocker) = looper_bearing(machine.params.looper).outer / 2 * (1 + 2 * WALL), moves.drive.bodies
    reaches = (
        (moves.motion.point(crank, "A").position, ring_radius(machine)),
        (moves.motion.point(rocker, "B").position, width / 2),
        *((np.array([at]), wall) for at in (moves.crank_shaft, moves.shaft)),
    )
    low = (complex(float(np.min(at.real)) - reach, float(np.min(at.imag)) - reach) for at, reach in reaches)
    corners = np.array(list(low))
    return complex(float(np.min(corners.real)), float(np.min(corners.imag)))
