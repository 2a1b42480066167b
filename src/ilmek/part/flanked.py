"""A round body with the flanks of a cam: a barrel with a groove round it, or a ring that ends at a flank.

    barrel  the cylinder from z = low to high, bored, less what lies between both flanks outside of the inner radius
    ring    between the radii, from z = low up to the lower flank

Moments by Gauss's quadrature over the radius and even steps round the axis, for which the flanks are smooth:

    integral = sum w_k R_k dphi sum (f(z) between the ends)
"""

import math

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.part.convex import Points, frustums, ring_corners
from ilmek.part.moments import Moments
from ilmek.part.placement import placement
from ilmek.part.shapes import CHORD, Prism, disc
from ilmek.plane.contours import along
from ilmek.records import record
from ilmek.report import Contour
from ilmek.report.scene import Solid

_LEAST_CORNERS = 180
"""Steps round the axis of the coarsest mesh: the flanks swing."""


@record
class Flanked:
    """A round body about z [m].

    low, high  ends of a barrel; of a ring its foot, and a height above all of it
    radii      from the inner to the outer one, both included; weights of a quadrature over them [m]
    lower      heights of the lower flank at the radii, at even angles once round; upper: of the upper flank
    upper      None: a ring            bore  of a barrel; None: none
    """

    low: float
    high: float
    radii: Float[np.ndarray, " radii"]
    weights: Float[np.ndarray, " radii"]
    lower: Float[np.ndarray, "radii angles"]
    upper: Float[np.ndarray, "radii angles"] | None
    bore: Contour | None = None

    @property
    def volume(self) -> float:
        """Volume [m³]."""
        return self.moments.zeroth

    @property
    def moments(self) -> Moments:
        """Moments of its volume, as near as the quadrature is."""
        if self.upper is None:
            return self._between(np.full_like(self.lower, self.low), self.lower)
        holes = () if self.bore is None else (self.bore,)
        blank = Prism(disc(float(self.radii[-1]), *holes), self.high - self.low).moments.placed(placement(z=self.low))
        return blank + self._between(self.lower, self.upper) * -1.0

    def _between(self, bottom: FloatArray, top: FloatArray) -> Moments:
        """Moments of what lies between two heights at the radii and angles."""
        angle = self._angles
        area = (self.weights * self.radii)[:, None] * (2 * math.pi / len(angle))
        x, y = self.radii[:, None] * np.cos(angle), self.radii[:, None] * np.sin(angle)
        column, first, second = (area * (top**n - bottom**n) / n for n in (1, 2, 3))
        xz, yz = float(np.sum(x * first)), float(np.sum(y * first))
        xx, xy, yy = (float(np.sum(one * column)) for one in (x * x, x * y, y * y))
        return Moments(
            float(np.sum(column)),
            np.array([np.sum(x * column), np.sum(y * column), np.sum(first)]),
            np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, float(np.sum(second))]]),
        )

    @property
    def _angles(self) -> FloatArray:
        return np.asarray(np.arange(self.lower.shape[1]) * (2 * math.pi / self.lower.shape[1]))

    def mesh(self, deviation: float = CHORD) -> Solid:
        """A closed surface of triangles: the same points of the section at even angles."""
        wanted = max(ring_corners(float(self.radii[-1]), deviation), _LEAST_CORNERS)
        every = max(1, self.lower.shape[1] // wanted)
        r, z = self._section(every)
        angle = self._angles[::every]
        points = np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=-1)  # (section, angles, 3)
        number = np.arange(r.size).reshape(r.shape)
        number = np.where(r <= 0, number[:, :1], number)  # one point on the axis
        here, onward = number, np.roll(number, -1, axis=1)
        over, beyond = np.roll(here, -1, axis=0), np.roll(onward, -1, axis=0)
        faces = np.concatenate(
            [np.stack(corners, axis=-1).reshape(-1, 3) for corners in ((here, onward, beyond), (here, beyond, over))]
        )
        real = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
        used, triangles = np.unique(faces[real], return_inverse=True)
        return Solid(points.reshape(-1, 3)[used], triangles.reshape(-1, 3))

    def _section(self, every: int) -> tuple[FloatArray, FloatArray]:
        """Radii and heights of the section's corners, counter-clockwise, at every n-th angle: (corners, angles)."""
        lower = self.lower[:, ::every]
        around = np.ones(lower.shape[1])
        radii, outer = self.radii[:, None] * around, self.radii[-1] * around
        foot, top = self.low * around, self.high * around
        if self.upper is None:
            inner = self.radii[0] * around
            return np.stack([inner, outer, *radii[::-1]]), np.stack([foot, foot, *lower[::-1]])
        upper, bore = self.upper[:, ::every], self._bore_radii()[::every]
        r = np.stack([bore, outer, *radii[::-1], *radii, outer, bore])
        return r, np.stack([foot, foot, *lower[::-1], *upper, top, top])

    def _bore_radii(self) -> FloatArray:
        """Distance of the bore's edge from the axis at the angles; 0 without one."""
        if self.bore is None:
            return np.zeros(self.lower.shape[1])
        edge = along(self.bore, CHORD / 5)
        order = np.argsort(np.angle(edge))
        return np.asarray(np.interp(self._angles, np.angle(edge)[order], np.abs(edge)[order], period=2 * math.pi))

    def pieces(self, deviation: float = CHORD) -> tuple[Points, ...]:
        """The cylinder about it."""
        top = self.high if self.upper is not None else float(self.lower.max())
        outer = float(self.radii[-1])
        corners = np.array([complex(self.low), complex(top), complex(top, outer), complex(self.low, outer)])
        return frustums(corners, deviation)
