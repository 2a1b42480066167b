"""Task of the Alt-Burmester problem: poses of a body, and points of a path at which its angle is free."""

import math

import numpy as np

from ilmek.arrays import Bool, Complex, ComplexArray, FloatArray
from ilmek.errors import ParameterError
from ilmek.records import record
from ilmek.synthesis.task import require_angles

FOUR_BARS = {(5, 0): 6, (4, 2): 30, (3, 4): 201, (2, 6): 1112, (1, 8): 4326}
"""Four-bars of general complex tasks, by the numbers of poses and of points."""

SAME_POINT = 1e-9
"""Distance of two points, in sizes of the task, below which they are the same."""

IN_LINE = 1e-9
"""Least extent of the points across their line, in sizes of the task."""


@record
class PosesAndPoints:
    """Positions of a coupler in the order in which they are required, that determine the four-bar.

    points  positions of the tracer [m], complex
    angles  of the coupler there [rad]; NaN where the angle is free; of the others only the differences count

    With M poses and N points 2 M + N = 10: 5 poses; 4 and 2 points; 3 and 4; 2 and 6; 1 and 8, which is nine points.
    Raises ParameterError for another number, equal points, points in line, and values that are not finite.

    >>> task = PosesAndPoints(np.arange(9) ** 2 + 1j * np.arange(9), np.full(9, np.nan))
    >>> task.poses, task.four_bars
    (1, 4326)
    """

    points: ComplexArray
    angles: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", np.asarray(self.points, dtype=complex))
        object.__setattr__(self, "angles", np.asarray(self.angles, dtype=float))
        if self.points.shape != self.angles.shape or self.points.ndim != 1:
            raise ParameterError(
                f"{self.points.size} points and {self.angles.size} angles of the coupler",
                allowed="one angle, or NaN, for each point",
            )
        if not np.isfinite(self.points).all() or np.isinf(self.angles).any():
            raise ParameterError("a position of the task is not finite", do="give finite positions [m] and angles")
        given = self.angles[~np.isnan(self.angles)]
        require_angles("coupler angle", given)
        self._check_count(len(given))
        self._check_points()

    def _check_count(self, poses: int) -> None:
        if (self.poses, len(self.points) - self.poses) in FOUR_BARS:
            return
        count = len(self.points)
        raise ParameterError(
            f"{poses} pose{'' if poses == 1 else 's'} and {count - poses} points",
            allowed="5 poses; 4 and 2 points; 3 and 4; 2 and 6; 1 and 8; or nine points: these determine four-bars",
            do="more leave none: use the search for the nearest; fewer leave a family: add points, or give pivots"
            if 2 * self.poses + count - self.poses > 10
            else "fewer leave a family of four-bars: add poses or points, or use the search for the nearest",
        )

    def _check_points(self) -> None:
        distance = np.abs(self.points[:, None] - self.points) / self.size
        turned = np.isfinite(self.angles[:, None] - self.angles)
        same = np.argwhere(np.triu((distance < SAME_POINT) & ~turned, 1))
        if len(same):
            first, second = same[0] + 1
            raise ParameterError(
                f"points {first} and {second} are the same",
                allowed="different points: a repeated one determines nothing",
                do="move one along the path",
            )
        if self.poses <= 1:
            middle = self.points - self.points.mean()
            across = float(np.linalg.svd(np.stack([middle.real, middle.imag]))[1][1])
            if across < IN_LINE * self.size:
                raise ParameterError(
                    f"the {len(self.points)} points lie on a straight line",
                    allowed="no four-bar draws more than six points of a line: its curve is of order six",
                    do="use the search for the nearest four-bar",
                )

    @property
    def reference(self) -> int:
        """Index of the position that the others are relative to: the first pose, else the first point."""
        given = np.flatnonzero(~np.isnan(self.angles))
        return int(given[0]) if len(given) else 0

    @property
    def others(self) -> np.ndarray:
        """Indices of the other positions: poses, then points."""
        rest = np.delete(np.arange(len(self.points)), self.reference)
        return np.asarray(rest[np.argsort(np.isnan(self.angles[rest]), kind="stable")])

    @property
    def poses(self) -> int:
        """Number of poses; the reference counts as one."""
        return max(1, int(np.sum(~np.isnan(self.angles))))

    @property
    def four_bars(self) -> int:
        """Number of four-bars of a general complex task of this kind."""
        return FOUR_BARS[self.poses, len(self.points) - self.poses]

    @property
    def size(self) -> float:
        """Root mean square distance of the points from the reference [m]."""
        away = np.abs(self.points - self.points[self.reference])
        return math.sqrt(float(np.sum(away**2)) / (len(away) - 1)) or 1.0

    @property
    def pose(self) -> Bool[np.ndarray, " others"]:
        """Whether each of the other positions is a pose."""
        return np.asarray(~np.isnan(self.angles[self.others]))

    @property
    def scaled(self) -> Complex[np.ndarray, "3 others"]:
        """Displacements d and d' of the other positions in sizes of the task, and rotations T (of points 1)."""
        d = (self.points[self.others] - self.points[self.reference]) / self.size
        turns = self.angles[self.others] - self.angles[self.reference]
        return np.array([d, d.conj(), np.exp(1j * np.where(self.pose, turns, 0.0))])
