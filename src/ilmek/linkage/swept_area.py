"""Swept area: all places that a body covers at any time on a mechanism's way, with its outline.

    f(z) = least over the way of the distance of z from the body in its pose, below 0 inside

The least is found between samples of the way and polished, for every z that it matters for. f is a signed distance
outside and no more than that inside, which is what `plane.regions` needs to bound the error of the area.
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
"""Samples between neighbouring breaks of the way."""

CHUNK = 1_000_000
"""Pairs of a point and a pose looked at together."""

CANDIDATES = 3
"""Local minima over the way that are polished for each point: those least at the samples."""

STEPS = 22
"""Steps of the golden section: a sample's length shrinks by 4e4."""


def swept(way: ConfigurationPath, placed: OutlinedBody, *, cells: int = 256) -> Region:
    """The region that a body covers over a way: area [m^2], bound of its error, outline; see `plane.regions.Region`.

    cells  small squares across the region's bounding square, a power of 2; twice as many halve the bound, and take
           twice the time (for 256 about a second); the error itself is some hundred times less than the bound
    Raises MechanismError for an unknown body, an outline without area, or cells that are no power of 2.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.clearance import outlined
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.structure import plan
    >>> from ilmek.linkage.configuration_path import InputPath
    >>> turn = InputPath(one_input(plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1))))
    >>> disc = swept(turn, outlined(turn.mechanism, "crank", 0.010), cells=64)
    >>> bool(abs(disc.area - np.pi * 0.070**2) < 1e-5), bool(disc.bound < 2e-3)
    (True, True)
    """
    way.mechanism.body(placed.body)
    if cells < 4 or cells & (cells - 1):
        raise MechanismError(f"{cells} cells across", allowed="a power of 2, 4 or more")
    if any(outline.area <= 0 for outline in placed.outlines):
        raise MechanismError(f"an outline of body {placed.body!r} has no area", do="give it a radius")
    places = spaced(way.breaks, BETWEEN)
    covered = _Covered(way, placed, places, *_poses(way, placed, places))
    low, side = covered.box()
    return region(covered.distance, low, side, cells=cells)


def _poses(
    way: ConfigurationPath, placed: OutlinedBody, places: FloatArray
) -> tuple[Complex[np.ndarray, " places"], Complex[np.ndarray, " places"]]:
    """Origin and direction of the body at places of the way."""
    body = way.bodies(places)[placed.body]
    count = (len(places),)
    return np.broadcast_to(body.carry(0j).position, count) + 0j, np.broadcast_to(body.direction, count) + 0j


@dataclass(frozen=True, slots=True)
class _Covered:
    """A body in all its poses, sampled."""

    way: ConfigurationPath
    placed: OutlinedBody
    places: Float[np.ndarray, " places"]
    origins: Complex[np.ndarray, " places"]
    directions: Complex[np.ndarray, " places"]

    def box(self) -> tuple[complex, float]:
        """A square about all poses: its lower left corner and side."""
        z, margin = self._corners(), self._slack() + max(outline.radius for outline in self.placed.outlines)
        low = complex(z.real.min(), z.imag.min()) - margin * (1 + 1j)
        side = max(np.ptp(z.real), np.ptp(z.imag)) + 2 * margin
        return low - (0.01 + 0.0113j) * side, 1.0261 * side

    def distance(self, points: Complex[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
        """Signed distance of points from all that the body covers."""
        chunks = max(1, len(points) * len(self.places) // CHUNK)
        return np.concatenate([self._distance(part) for part in np.array_split(points, chunks)])

    def _distance(self, points: Complex[np.ndarray, " points"]) -> Float[np.ndarray, " points"]:
        sampled = self._apart(points[:, None], self.origins, self.directions)
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
        """The least distance about given samples, by golden sections."""
        low, high = self.places[np.maximum(at - 1, 0)], self.places[np.minimum(at + 1, len(self.places) - 1)]

        def apart(places: FloatArray) -> FloatArray:
            return self._apart(points, *_poses(self.way, self.placed, places))

        least: Float[np.ndarray, " points"] = bracketed_minima(apart, low, high, steps=STEPS)[1]
        return least

    def _apart(self, points: np.ndarray, origins: np.ndarray, directions: np.ndarray) -> FloatArray:
        """Distance of points from the body in given poses."""
        local = (points - origins) * np.conj(directions)
        return np.asarray(np.min(np.stack([to_outline(local, one) for one in self.placed.outlines]), axis=0))

    def _corners(self) -> Complex[np.ndarray, "places corners"]:
        corners = np.concatenate([outline.corners for outline in self.placed.outlines])
        return np.asarray(self.origins[:, None] + self.directions[:, None] * corners)

    def _slack(self) -> float:
        """Most that any of the body moves from a sample to the middle of the way to the next, a little over."""
        return 0.55 * float(np.max(np.abs(np.diff(self._corners(), axis=0))))
