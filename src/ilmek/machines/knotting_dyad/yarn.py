"""The yarn's two ends over a cycle: where they are led, by whom, and which knot that ties.

The yarn lies straight in front of the warps between its two ends when the cycle begins. Each end then goes where its
carrier goes, phase by phase. A hand-over from one carrier to the next must be at one place; an end that nobody carries
stays where it was left. The first end's way backwards, then the second end's, is the yarn: `tied_knot` proves the knot.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Complex, Float

from ilmek.arrays import FloatArray
from ilmek.errors import CarpetError
from ilmek.machines.knotting_dyad.arm_path import Arm
from ilmek.machines.knotting_dyad.section import Section
from ilmek.machines.knotting_dyad.sequence import CENTRE, LEFT, Phase
from ilmek.units import format_quantity, um
from ilmek.weaving.knots.proof import TiedKnot, tied_knot

MISSED = 1 * um
"""How far apart two grippers may be at a hand-over."""

SAMPLES = (201, 1601, 12801)
"""Places along a phase: more where the path comes so near a warp that fewer do not tell its side."""


def carried(
    section: Section, arm: Arm, carrier: str, phase: Phase, shares: Float[np.ndarray, " n"]
) -> Complex[np.ndarray, " n"]:
    """Places of a carrier's tip at shares of a phase [m]."""
    if carrier == CENTRE:
        begin, end = phase.centre
        return np.asarray(section.middle + 1j * (begin + (end - begin) * shares))
    begin, end = phase.left if carrier == LEFT else phase.right
    tip = arm.tip(begin + (end - begin) * shares)
    return tip if carrier == LEFT else np.asarray(2 * section.middle - np.conj(tip))


def _length(arm: Arm, carrier: str, phase: Phase) -> float:
    """Bound of a carrier's way during a phase [m]."""
    begin, end = phase.centre if carrier == CENTRE else (phase.left if carrier == LEFT else phase.right)
    return abs(end - begin) * (1.0 if carrier == CENTRE else arm.speed_bound)


def tied_by(section: Section, arm: Arm, phases: Sequence[Phase]) -> TiedKnot:
    """The knot that the phases tie with this arm and its mirror image; none where an end is led through a warp."""
    said = ""
    for samples in SAMPLES:
        try:
            return _tied_by(section, arm, phases, samples)
        except CarpetError as error:
            said = error.given
    return TiedKnot(None, (), False, f"no knot: {said}")


def _tied_by(section: Section, arm: Arm, phases: Sequence[Phase], samples: int) -> TiedKnot:
    shares = np.linspace(0.0, 1.0, samples)
    ways: list[Complex[np.ndarray, " n"]] = []
    bounds: list[FloatArray] = []
    for end in (0, 1):
        places, lengths = np.empty(0, complex), np.empty(0)
        for phase in phases:
            carrier = phase.carries[end]
            if not carrier:
                continue
            way = carried(section, arm, carrier, phase, shares)
            if len(places) and abs(way[0] - places[-1]) > MISSED:
                return _missed(end, carrier, phase, abs(way[0] - places[-1]))
            step = np.full(samples - 1, _length(arm, carrier, phase) / (samples - 1) * (1 + 1e-9))
            gap = np.abs(way[:1] - places[-1:])
            places, lengths = np.concatenate([places, way]), np.concatenate([lengths, gap, step])
        ways.append(places)
        bounds.append(lengths)
    between = np.abs(ways[1][:1] - ways[0][:1])  # the yarn at the beginning, straight
    lengths = np.concatenate([bounds[0][::-1], between, bounds[1]])
    points = np.concatenate([ways[0][::-1], ways[1]])
    return tied_knot(
        points, section.warps, keep_out=section.warp / 2, lengths=np.maximum(lengths, np.abs(np.diff(points)))
    )


def _missed(end: int, carrier: str, phase: Phase, gap: float) -> TiedKnot:
    name = ("first", "second")[end]
    words = f"no knot: at '{phase.name}' the {name} end is {format_quantity(gap, 'mm')} from the {carrier} gripper"
    return TiedKnot(None, (), False, words)
