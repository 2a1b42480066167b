"""Proof that a four-bar takes its poses: beside the computed pivot and pin of each link there is an exact one.

A link takes poses 2 to n where |d_k + T_k x - A|² = |x - A|²: n - 1 equations in the four real numbers of its pivot A
and its pin x. Completed by the directions in which it is free, the null space of their Jacobian, they are four, and
Krawczyk's operator proves a solution of them (`num.krawczyk`).
"""

import numpy as np

from ilmek.arrays import Complex, FloatArray
from ilmek.num.intervals import Intervals, stacked
from ilmek.num.krawczyk import certified_roots
from ilmek.params.text_lists import BodyPoses
from ilmek.synthesis.alt_burmester.certificate import known_turn, link_equation

RADIUS = 1e-9
"""Greatest distance of the exact link from the computed one, in sizes of the task."""


def certified(pins: Complex[np.ndarray, "4"], poses: BodyPoses) -> bool:
    """Whether both links are proven to be within 1e-9 of the task's size of links that take all poses exactly.

    pins  pivots A0, B0 and pins A, B at the first pose [m]      poses  [m, rad]

    >>> poses = BodyPoses(np.array([1j, 0.6 + 0.8j, 0.8 + 0.6j]), np.zeros(3))  # on a unit circle, without rotation
    >>> certified(np.array([0j, 2 + 0j, 1j, 2 + 1j]), poses), certified(np.array([0j, 2 + 0j, 1.1j, 2 + 1j]), poses)
    (True, False)
    """
    points, _ = poses
    size = float(np.max(np.abs(points - points[0]))) or float(np.max(np.abs(pins - pins[0])))
    unit = float(2.0 ** np.round(np.log2(size)))  # division by it is exact
    ends = (pins - points[0]).reshape(2, 2).T / unit
    near = np.stack([ends.real, ends.imag], axis=-1).reshape(2, 4)
    roots = certified_roots(_Links(poses, unit, near), near)
    away = np.abs(roots.roots - near) + roots.radius
    return bool(roots.certified.all() and np.max(away) * unit <= RADIUS * size)


class _Links:
    """The equations of both links in intervals, completed by their free directions at `near`."""

    def __init__(self, poses: BodyPoses, unit: float, near: FloatArray) -> None:
        points = (poses.points / unit).astype(np.clongdouble)
        self.x = Intervals.of(points.real[1:]) - points.real[0]
        self.y = Intervals.of(points.imag[1:]) - points.imag[0]
        self.turns = Intervals.of(poses.angles[1:].astype(np.longdouble)) - poses.angles[0]
        self.near = near
        _, slopes = self._constraints(Intervals.of(near))
        self.free = np.linalg.svd(slopes.middle)[2][:, len(points) - 1 :]

    def __call__(self, X: Intervals) -> tuple[Intervals, Intervals]:
        values, slopes = self._constraints(X)
        moved = X - self.near
        rows = [Intervals.of(self.free[:, k].astype(X.low.dtype)) for k in range(self.free.shape[1])]
        products = [moved * row for row in rows]
        along = [sum((each[:, k] for k in range(1, 4)), each[:, 0]) for each in products]
        return stacked([*(values[:, k] for k in range(values.low.shape[1])), *along], -1), stacked(
            [*(slopes[:, k] for k in range(values.low.shape[1])), *rows], -2
        )

    def _constraints(self, X: Intervals) -> tuple[Intervals, Intervals]:
        turns = (known_turn(self.turns[k], X.low.dtype) for k in range(len(self.x.low)))
        parts = [link_equation(X, 0, (self.x[k], self.y[k]), turn) for k, turn in enumerate(turns)]
        return stacked([value for value, _ in parts], -1), stacked([row for _, row in parts], -2)
