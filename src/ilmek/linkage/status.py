"""The closed vocabulary of failure, and how a step's answer is judged."""

from enum import IntEnum

import numpy as np

from ilmek.arrays import Int8
from ilmek.linkage.groups.group import GroupSolution, Known, Step

DEAD = 2e-6
"""A margin (sine of the transmission angle) this small leaves rates too few digits: the pose is known to rounding by
the margin, and rates divide by the margin once more. Just above it the worst of 10^5 random mechanisms keep two."""

TOUCHING = 1e-12
"""A gap this small against the links is rounding: the links are in line and just touch."""


class Status(IntEnum):
    """What became of a sample.

    OK             solved
    CANNOT_CLOSE   the links do not reach: no position, NaN
    DEAD_CENTRE    links in line: a position (NaN if in line to rounding), but no velocity or acceleration to trust
    NOT_CONVERGED  Newton's method found no position: NaN
    """

    OK = 0
    CANNOT_CLOSE = 1
    DEAD_CENTRE = 2
    NOT_CONVERGED = 3


def judge(step: Step, known: Known, solved: GroupSolution, status: Int8[np.ndarray, " samples"]) -> None:
    """Write into `status` what a step's margin says of the samples that were still OK."""
    margin, least = solved.margin, DEAD * solved.best
    if margin is None or np.min(margin) > least or np.max(margin) < -least:  # never true with a NaN among them
        return
    lost = np.isnan(margin)
    touching = lost & (np.abs(step.gap(known)) <= TOUCHING * step.size)
    dead = touching | (np.abs(margin) <= least)
    found = np.where(dead, Status.DEAD_CENTRE, np.where(lost, Status[step.failure], Status.OK))
    np.copyto(status, found.astype(np.int8), where=status == Status.OK)
