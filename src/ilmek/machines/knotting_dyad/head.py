"""The knotting head: an arm and its mirror image, the centre gripper between them, and what they do together."""

from dataclasses import dataclass

import numpy as np

from ilmek.machines.knotting_dyad.arm_path import Arm, ArmPath
from ilmek.machines.knotting_dyad.clearance import LeastDistance, clearances
from ilmek.machines.knotting_dyad.needle_bending import bent_aside
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.section import WarpSection, knot_of
from ilmek.machines.knotting_dyad.sequence import Phase, sequence
from ilmek.machines.knotting_dyad.yarn import tied_by
from ilmek.weaving.knots.proof import TiedKnot
from ilmek.weaving.knots.word import Knot, knot

SAMPLES = 401
"""Places of the way that are tabulated."""


@dataclass(frozen=True, slots=True, eq=False)
class Head:
    """A head that ties a knot.

    section     the warps that it works among      phases      of a cycle, one after the other
    knot        to be tied                         clearances  of everything that moves, over the whole cycle
    arm         the left one; the right mirrored   tied        the knot that the phases tie, proved
    way         of the left arm, tabulated         bent        the needle aside by the yarn, at the warps [m]
    """

    section: WarpSection
    knot: Knot
    arm: Arm
    way: ArmPath
    phases: tuple[Phase, ...]
    clearances: tuple[LeastDistance, ...]
    tied: TiedKnot
    bent: float

    @property
    def clearance_min(self) -> float:
        """The least of all clearances [m]; below 0 something overlaps."""
        return min(one.value for one in self.clearances)

    @property
    def centre_stroke(self) -> float:
        """Way of the centre gripper, one way [m]."""
        return self.section.front + self.section.depth

    @property
    def knot_tied(self) -> str | None:
        """Kind of the knot that is tied on the pair, None if it is not the one asked for."""
        return self.knot.kind if self.tied.knot == self.knot else None

    @property
    def proof(self) -> str:
        """What the proof says, the pair's warps called 1 and 2; else warps are counted from the left of the section."""
        return knot(self.knot.kind, opens=self.knot.opens or "left").name if self.knot_tied else self.tied.words


def head_of(params: KnottingDyadParams, section: WarpSection, arm: Arm) -> Head:
    """The head of an arm."""
    wanted = knot_of(params)
    phases = sequence(wanted, section.front, -section.depth)
    way = arm.way(np.linspace(0.0, 1.0, SAMPLES))
    return Head(
        section,
        wanted,
        arm,
        way,
        phases,
        clearances(section, arm),
        tied_by(section, arm, phases),
        bent_aside(params, section, arm),
    )
