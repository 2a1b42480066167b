"""The yarn's two ends over a cycle: where they are led, by whom, and which knot that ties [`ilmek.weaving.knots`].

The yarn lies straight in front of the warps between its two ends when the cycle begins. Each end then goes where its
carrier goes, phase by phase. The carriers of a hand-over must meet at one position; an end that nobody carries stays
where it was left.
"""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import Complex, ComplexArray, Float, FloatArray
from ilmek.errors import CarpetError
from ilmek.linkage.swivelled_arm import SwivelledArm
from ilmek.machines.knotting_dyad.section import WarpSection
from ilmek.machines.knotting_dyad.sequence import CENTRE, LEFT, Phase
from ilmek.units import format_quantity, um
from ilmek.weaving.knots.led_yarn import SampledPath, end_path, knot_of_ends
from ilmek.weaving.knots.proof import TiedKnot

MISSED = 1 * um
"""Largest distance of two grippers at a hand-over [m]."""


def carried(
    section: WarpSection, arm: SwivelledArm, carrier: str, phase: Phase, shares: Float[np.ndarray, " n"]
) -> Complex[np.ndarray, " n"]:
    """Positions of a carrier's tip at shares of a phase [m]."""
    if carrier == CENTRE:
        begin, end = phase.centre
        return np.asarray(section.middle + 1j * (begin + (end - begin) * shares))
    begin, end = phase.left if carrier == LEFT else phase.right
    tip = arm.tip(begin + (end - begin) * shares)
    return tip if carrier == LEFT else np.asarray(2 * section.middle - np.conj(tip))


def tied_by(section: WarpSection, arm: SwivelledArm, phases: Sequence[Phase]) -> TiedKnot:
    """The knot that the phases tie with this arm and its mirror image; none where an end is led through a warp."""

    def ends(samples: int) -> tuple[SampledPath, SampledPath]:
        return _end(section, arm, phases, 0, samples), _end(section, arm, phases, 1, samples)

    return knot_of_ends(ends, section.warps, keep_out=section.warp / 2)


def _end(section: WarpSection, arm: SwivelledArm, phases: Sequence[Phase], end: int, samples: int) -> SampledPath:
    """Path of an end over the phases. Raises CarpetError where a hand-over misses it."""
    shares = np.linspace(0.0, 1.0, samples)
    motions: list[tuple[ComplexArray, FloatArray]] = []
    for phase in phases:
        carrier = phase.carries[end]
        if not carrier:
            continue
        points = carried(section, arm, carrier, phase, shares)
        gap = abs(points[0] - motions[-1][0][-1]) if motions else 0.0
        if gap > MISSED:
            name, missed = ("first", "second")[end], format_quantity(gap, "mm")
            raise CarpetError(f"at '{phase.name}' the {name} end is {missed} from the {carrier} gripper")
        motions.append((points, np.full(samples - 1, _length(arm, carrier, phase) / (samples - 1))))
    return end_path(motions)


def _length(arm: SwivelledArm, carrier: str, phase: Phase) -> float:
    """Upper bound of the length of a carrier's path during a phase [m]."""
    begin, end = phase.centre if carrier == CENTRE else (phase.left if carrier == LEFT else phase.right)
    return abs(end - begin) * (1.0 if carrier == CENTRE else arm.speed_bound)
