"""Yarn in the tubes and on the bobbins while a carpet is woven, by the programme: what is loaded, and what is left."""

from collections.abc import Sequence

import numpy as np

from ilmek.arrays import FloatArray, IntArray
from ilmek.loom.control.view import WeftView, YarnView
from ilmek.loom.operations import EMPTY, LoomProgramme, RowOperations


class YarnMeter:
    """Loading and yarn left of each tube; knots that are tied again are not counted twice.

    It goes forward with the carpet, phase by phase.
    """

    def __init__(self, programme: LoomProgramme) -> None:
        self._programme = programme
        setup = programme.setup
        self.loading = setup.loading.copy()
        self._left: FloatArray = np.array(setup.packages, np.float64)
        self._knot_yarn = np.array((*setup.knot_yarn, *[0.0] * (EMPTY + 1 - len(setup.knot_yarn))))
        self.row = self._phase = self._stops = 0
        self.operations: RowOperations = programme.operations(0)
        self._passed: IntArray = np.zeros(setup.heads, np.int64)
        self._wefts = [0] * len(setup.wefts)

    def go_to(self, row: int, phase: int) -> RowOperations:
        """Pass all phases before one, and its stops; the operations of its row."""
        while (self.row, self._phase) < (row, phase):
            if self._phase == self.operations.phases:
                self.row, self._phase, self._stops = self.row + 1, 0, 0
                self.operations = self._programme.operations(self.row)
                self._passed[:] = 0
            else:
                self._change()
                self._use(self._left, self._passed, self._passed + self.operations.counts[:, self._phase])
                self._passed += self.operations.counts[:, self._phase]
                self._phase += 1
        self._change()
        return self.operations

    def views(self, tied: Sequence[int]) -> tuple[YarnView, ...]:
        """The tubes that have yarn, with what is left [m] when each head has tied so many knots of the row."""
        left = self._left.copy()
        self._use(left, self._passed, np.maximum(self._passed, tied))
        return tuple(
            YarnView(head, tube, int(self.loading[head, tube]), max(0.0, float(left[head, tube])))
            for head, tube in np.argwhere(self.loading != EMPTY).tolist()
        )

    def wefts(self) -> tuple[WeftView, ...]:
        """The bobbins of weft, with the rows that each still lasts."""
        wefts = zip(self._programme.setup.wefts, self._wefts, strict=True)
        return tuple(WeftView(one.yarn, max(0, one.rows - (self.row - changed))) for one, changed in wefts)

    def _change(self) -> None:
        """Make the stops that are due."""
        stops = self.operations.stops
        while self._stops < len(stops) and stops[self._stops].phase <= self._phase:
            for index in stops[self._stops].wefts:
                self._wefts[index] = self.row
            for tube in stops[self._stops].tubes:
                self.loading[tube.head, tube.tube] = tube.yarn
                self._left[tube.head, tube.tube] = tube.length
            self._stops += 1

    def _use(self, left: FloatArray, begins: IntArray, ends: IntArray) -> None:
        """Take the yarn of the knots `begins` to `ends` of each head."""
        tubes = self.operations.tubes
        for head, start in enumerate(self.operations.starts[:-1].tolist()):
            used = np.bincount(tubes[start + begins[head] : start + ends[head]], minlength=left.shape[1])
            left[head] -= used[: left.shape[1]] * self._knot_yarn[self.loading[head]]
