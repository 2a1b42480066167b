"""Status of a sample, and its evaluation from the margin of a step."""

from enum import IntEnum

import numpy as np

from ilmek.arrays import Int8
from ilmek.linkage.groups.group import GroupSolution, Known, Step

DEAD = 2e-6
"""Least margin (sine of the transmission angle) with usable rates: the error of the pose is the rounding error divided
by the margin, and rates divide by it once more. Just above it the worst of 10^5 random mechanisms keep two digits."""

TOUCHING = 1e-12
"""Greatest gap, relative to the links, that is attributed to rounding: the links are in line and just reach."""


class Status(IntEnum):
    """Status of a sample.

    OK             solved
    CANNOT_CLOSE   the links do not reach: no position, NaN
    DEAD_CENTRE    links in line: a position (NaN if in line to rounding), no reliable velocity or acceleration
    NOT_CONVERGED  Newton's method found no position: NaN
    """

    OK = 0
    CANNOT_CLOSE = 1
    DEAD_CENTRE = 2
    NOT_CONVERGED = 3


def judge(step: Step, known: Known, solved: GroupSolution, status: Int8[np.ndarray, " samples"]) -> None:
    """Set `status` of the samples that are still OK from the margin of a step."""
    margin, least = solved.margin, DEAD * solved.best
    if margin is None or np.min(margin) > least or np.max(margin) < -least:  # never true with a NaN among them
        return
    lost = np.isnan(margin)
    touching = lost & (np.abs(step.gap(known)) <= TOUCHING * step.size)
    dead = touching | (np.abs(margin) <= least)
    found = np.where(dead, Status.DEAD_CENTRE, np.where(lost, Status[step.failure], Status.OK))
    np.copyto(status, found.astype(np.int8), where=status == Status.OK)
