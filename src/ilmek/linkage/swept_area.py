"""Swept area: the region covered by a body over a path of configurations.

    f(z) = least distance of z from the body over the poses of the path, below 0 inside

The minimum is bracketed by samples of the path and refined for every z near the outline. f is a signed distance
outside and an upper bound of it inside, as `plane.regions` requires for the error bound of the area.   [derived here]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.errors import MechanismError
from ilmek.linkage.clearance import OutlinedBody
from ilmek.linkage.configuration_path import ConfigurationPath, spaced
from ilmek.num.brackets import bracketed_minima
from ilmek.plane.outlines import to_outline
from ilmek.plane.regions import Region, region

BETWEEN = 2
"""Samples between neighbouring breaks of the path."""

CHUNK = 1_000_000
"""Pairs of a point and a pose per batch."""

CANDIDATES = 3
"""Number of local minima refined for each point: the least at the samples."""

STEPS = 22
"""Steps of the golden section: they reduce an interval by 4e4."""


def swept_region(path: ConfigurationPath, placed: OutlinedBody, *, cells: int = 256) -> Region:
    """The region covered by a body over a path: area [m^2], error bound, outline; see `plane.regions.Region`.

    cells  squares across the bounding square of the region, a power of 2; twice the number halves the bound and doubles
           the time (about a second for 256); the error itself is about a hundred times smaller than the bound
    Raises MechanismError for an unknown body, an outline without area, or cells not a power of 2.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.clearance import outlined
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.structure import plan
    >>> from ilmek.linkage.configuration_path import InputPath
    >>> turn = InputPath(one_input(plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1))))
    >>> disc = swept_region(turn, outlined(turn.mechanism, "crank", 0.010), cells=64)
    >>> bool(abs(disc.area - np.pi * 0.070**2) < 1e-5), bool(disc.bound < 2e-3)
    (True, True)
    """
    path.mechanism.body(placed.body)
    if cells < 4 or cells & (cells - 1):
        raise MechanismError(f"{cells} cells across", allowed="a power of 2, 4 or more")
    if any(outline.area <= 0 for outline in placed.outlines):
        raise MechanismError(f"an outline of body {placed.body!r} has no area", do="give it a radius")
    parameters = spaced(path.breaks, BETWEEN)
    covered = _Covered(path, placed, parameters, *_poses(path, placed, parameters))
    low, side = covered.box()
    return region(covered.distance, low, side, cells=cells)


def _poses(
    path: ConfigurationPath, placed: OutlinedBody, parameters: FloatArray
) -> tuple[Complex[np.ndarray, " parameters"], Complex[np.ndarray, " parameters"]]:
    """Origin [m] and direction of the body at parameters of the path."""
    body = path.bodies(parameters)[placed.body]
    count = (len(parameters),)
    return np.broadcast_to(body.carry(0j).position, count) + 0j, np.broadcast_to(body.direction, count) + 0j


@dataclass(frozen=True, slots=True)
class _Covered:
    """A body in all its poses, sampled."""

    path: ConfigurationPath
    placed: OutlinedBody
    parameters: Float[np.ndarray, " parameters"]
    origins: Complex[np.ndarray, " parameters"]
    directions: Complex[np.ndarray, " parameters"]

    def box(self) -> tuple[complex, float]:
        """A square around all poses: its lower left corner and side [m]."""
        z, margin = self._corners(), self._slack() + max(outline.radius for outline in self.placed.outlines)
        low = complex(z.real.min(), z.imag.min()) - margin * (1 + 1j)
        side = max(np.ptp(z.real), np.ptp(z.imag)) + 2 * margin
        return low - (0.01 + 0.0113j) * side, 1.0261 * side

    def distance(self, points: Complex[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
        """Signed distance [m] of points from the covered region."""
        chunks = max(1, len(points) * len(self.parameters) // CHUNK)
        return np.concatenate([self._distance(part) for part in np.array_split(points, chunks)])

    def _distance(self, points: Complex[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
        sampled = self._body_distance(points[:, None], self.origins, self.directions)
        padded = np.pad(sampled, ((0, 0), (1, 1)), constant_values=np.inf)
        lowest = (sampled <= padded[:, :-2]) & (sampled <= padded[:, 2:])
        ranked = np.argsort(np.where(lowest, sampled, np.inf), axis=1)[:, :CANDIDATES]
        found: Float[np.ndarray, " points"] = sampled.min(axis=1)
        near = (
            np.take_along_axis(np.where(lowest, sampled, np.inf), ranked, axis=1) - 2 * self._slack() < found[:, None]
        )
        rows, ranks = np.nonzero(near)
        if len(rows):
            np.minimum.at(found, rows, self._polished(points[rows], ranked[rows, ranks]))
        return found

    def _polished(self, points: Complex[np.ndarray, " points"], at: np.ndarray) -> Float[np.ndarray, " points"]:
        """The least distance near given samples, by golden sections."""
        low, high = (
            self.parameters[np.maximum(at - 1, 0)],
            self.parameters[np.minimum(at + 1, len(self.parameters) - 1)],
        )

        def apart(parameters: FloatArray) -> FloatArray:
            return self._body_distance(points, *_poses(self.path, self.placed, parameters))

        least: Float[np.ndarray, " points"] = bracketed_minima(apart, low, high, steps=STEPS)[1]
        return least

    def _body_distance(self, points: np.ndarray, origins: np.ndarray, directions: np.ndarray) -> FloatArray:
        """Distance of points from the body in given poses."""
        local = (points - origins) * np.conj(directions)
        return np.asarray(np.min(np.stack([to_outline(local, outline) for outline in self.placed.outlines]), axis=0))

    def _corners(self) -> Complex[np.ndarray, "parameters corners"]:
        corners = np.concatenate([outline.corners for outline in self.placed.outlines])
        return np.asarray(self.origins[:, None] + self.directions[:, None] * corners)

    def _slack(self) -> float:
        """Upper bound [m] of the motion of any point of the body over half an interval."""
        return 0.55 * float(np.max(np.abs(np.diff(self._corners(), axis=0))))
