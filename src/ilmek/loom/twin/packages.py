"""Pile yarn of each package: what the knots used, what faults lost, and what is left when it is changed."""

import numpy as np

from ilmek.arrays import IntArray
from ilmek.loom.operations import EMPTY, LoomSetup, Stop
from ilmek.loom.twin.walk import Walk, yarn_of_a_knot
from ilmek.records import value_record

_MICRO = 1_000_000


@value_record
class PackageUse:
    """A package of pile yarn [m]: in knots, lost with failed knots and repairs, and left when it is taken off.

    left  below 0: the yarn ends before the planned change
    """

    head: int
    tube: int
    yarn: int
    length: float
    knots: int
    lost: float
    left: float

    @property
    def used(self) -> float:
        """Yarn in the knots and lost [m]."""
        return self.length - self.left


class Packages:
    """Account of the pile yarn of a run; `all` has the packages in the order in which they were taken off."""

    def __init__(self, setup: LoomSetup, waste: float) -> None:
        self.setup, self.waste = setup, round(_MICRO * waste)
        self.lengths = np.array(setup.packages, float)
        self.lost: IntArray = np.zeros(self.lengths.shape, np.int64)
        self.all: list[PackageUse] = []

    def lose(self, walk: Walk, head: int, tube: int, attempts: int, calls: int) -> None:
        """Add the yarn of failed attempts, and of a repair."""
        self.lost[head, tube] += attempts * int(walk.yarns[head, tube]) + calls * self.waste

    def change(self, stop: Stop, walk: Walk) -> None:
        """Take the packages of a stop off, before the walk has the new ones."""
        for tube in stop.tubes:
            self._take_off(walk, tube.head, tube.tube)
            self.lengths[tube.head, tube.tube] = tube.length
            self.lost[tube.head, tube.tube] = 0

    def finish(self, walk: Walk) -> None:
        """Take the last packages off."""
        for head in range(self.lengths.shape[0]):
            for tube in range(self.lengths.shape[1]):
                self._take_off(walk, head, tube)

    def _take_off(self, walk: Walk, head: int, tube: int) -> None:
        yarn = int(walk.loaded[head, tube])
        if yarn != EMPTY:
            knots, lost = int(walk.tied[head, tube]), int(self.lost[head, tube]) / _MICRO
            length = float(self.lengths[head, tube])
            left = length - knots * yarn_of_a_knot(self.setup, yarn) / _MICRO - lost
            self.all.append(PackageUse(head, tube, yarn, length, knots, lost, left))
