"""A square bar that is twisted about its axis, straight before and behind: the screw of a rotation along a travel."""

import itertools

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.part.convex import Points
from ilmek.part.moments import Moments
from ilmek.part.shapes import CHORD, box
from ilmek.records import record
from ilmek.report.scene import Solid

STEP, COARSE = np.deg2rad(2.0), np.deg2rad(6.0)
"""Twist between two sections of a mesh, and of its convex pieces, at most."""


@record
class TwistedBar:
    """A square bar along z from z = 0 [m], each section turned about z.

    side  of the square [m]      stations  of z where the twist changes, from 0 to its length [m]
    angles  at them [rad], straight between them
    """

    side: float
    stations: tuple[float, ...]
    angles: tuple[float, ...]

    @property
    def length(self) -> float:
        """Length [m]."""
        return self.stations[-1]

    @property
    def volume(self) -> float:
        """Volume [m³]: sections keep their area."""
        return self.side**2 * self.length

    @property
    def moments(self) -> Moments:
        """Moments of its volume: those of the straight bar, since a square's second moment is that of any direction."""
        return box(self.side, self.side, self.length).moments

    def mesh(self, deviation: float = CHORD) -> Solid:
        """A closed surface of triangles between turned sections, whose edges are so near to those of the bar [m]."""
        radius = self.side / np.sqrt(2)
        rings = self._rings(min(STEP, 2 * np.arccos(1 - min(deviation / radius, 1.0))))
        number, corner = len(rings), np.arange(4)
        following = np.roll(corner, -1)
        # The diagonals alternate: on one side all of them would cut off, or add, a volume that grows with the twist.
        cut = np.concatenate([[corner, following, following + 4], [corner, following + 4, corner + 4]], axis=1).T
        added = np.concatenate([[corner, following, corner + 4], [following, following + 4, corner + 4]], axis=1).T
        sides = [(added if k % 2 else cut) + 4 * k for k in range(number - 1)]
        low, high = np.array([[0, 2, 1], [0, 3, 2]]), np.array([[0, 1, 2], [0, 2, 3]]) + 4 * (number - 1)
        return Solid(rings.reshape(-1, 3), np.concatenate([low, *sides, high]))

    def pieces(self, deviation: float = CHORD) -> tuple[Points, ...]:
        """The convex hulls of neighbouring sections."""
        del deviation
        rings = self._rings(COARSE)
        return tuple(np.concatenate(pair) for pair in itertools.pairwise(rings))

    def stretches(self, step: float) -> tuple[FloatArray, ...]:
        """The corners of the sections of each stretch between two stations, as `_rings` has them [m]."""
        ends, angles = itertools.pairwise(self.stations), itertools.pairwise(self.angles)
        return tuple(
            TwistedBar(self.side, between, twist)._rings(step) for between, twist in zip(ends, angles, strict=True)
        )

    def _rings(self, step: float) -> FloatArray:
        """Corners of sections with a twist between them of a step at most [rad], (sections, 4, 3) [m]."""
        steps = np.maximum(np.ceil(np.abs(np.diff(self.angles)) / step), 1).astype(int)
        shares = np.concatenate([[0.0], *(k + np.arange(1, n + 1) / n for k, n in enumerate(steps))])
        z = np.interp(shares, np.arange(len(self.stations)), self.stations)
        angle = np.interp(shares, np.arange(len(self.stations)), self.angles)
        corners = np.exp(1j * (angle[:, None] + np.pi / 4 + np.pi / 2 * np.arange(4))) * self.side / np.sqrt(2)
        return np.stack([corners.real, corners.imag, np.broadcast_to(z[:, None], corners.shape)], axis=2)
