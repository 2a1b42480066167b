"""The circuits of a four-bar as smooth closed curves of one parameter u, in closed form.

    crank turns fully:    crank angle = u, one circuit for each branch
    else, for each interval (from, to) of the crank:    crank angle = middle + half cos u,    branch = sign(sin u)

The second passes the dead centres of the crank at u = 0 and pi without a corner, because the lean of coupler against
rocker vanishes there like the square root of the way left: B and all that follows from it are smooth in u.
[`linkage.circuits` follows any mechanism; of a four-bar this says the same without following.]
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, Float, FloatArray, RealField
from ilmek.linkage.quality import input_range
from ilmek.records import record
from ilmek.synthesis.four_bar import FourBar


@record
class LoopConfigurations:
    """Configurations: moving pins and tracer [m], unit vectors along the coupler and the rocker; tracer 0 if none."""

    a: ComplexArray
    b: ComplexArray
    tracer: ComplexArray
    coupler: ComplexArray
    rocker: ComplexArray


@dataclass(frozen=True, slots=True)
class CircuitLoop:
    """A circuit: crank angles from `low` to `high` [rad, world]; `branch` of a crank that turns fully, else 0."""

    four_bar: FourBar
    low: float
    high: float
    branch: int

    def crank(self, u: FloatArray) -> FloatArray:
        """Crank angle at u [rad]."""
        if self.branch:
            return u
        return np.asarray(0.5 * (self.low + self.high) + 0.5 * (self.high - self.low) * np.cos(u))

    def branches(self, u: FloatArray) -> FloatArray:
        """Branch at u, +1 or -1."""
        return np.where(np.sin(u) >= 0, 1.0, -1.0) if not self.branch else np.full(np.shape(u), float(self.branch))

    def places(self, crank: RealField, slack: float = 1e-9) -> Float[np.ndarray, " places"]:
        """All u at a crank angle [rad]; none where the circuit does not get there (by more than `slack`)."""
        if self.branch:
            return np.atleast_1d(np.asarray(crank, dtype=float))
        middle, half = 0.5 * (self.low + self.high), 0.5 * (self.high - self.low)
        off = float(np.angle(np.exp(1j * (float(crank) - middle))))
        if abs(off) > half + slack:
            return np.empty(0)
        u = float(np.arccos(np.clip(off / half, -1.0, 1.0)))
        return np.array([u, -u])

    def at(self, u: FloatArray) -> LoopConfigurations:
        """The configurations at u."""
        drawn = self.four_bar
        _, crank, coupler, rocker = drawn.lengths
        a: ComplexArray = drawn.a0 + crank * np.exp(1j * self.crank(u))
        d = drawn.b0 - a
        dd = np.maximum(d.real**2 + d.imag**2, 1e-200)
        along = 0.5 + 0.5 * (coupler**2 - rocker**2) / dd
        across = self.branches(u) * np.sqrt(np.maximum(coupler**2 / dd - along**2, 0.0))
        b = a + (along + 1j * across) * d
        tilt = (b - a) / coupler
        tracer = drawn.tracer_on_coupler
        return LoopConfigurations(a, b, 0 * a if tracer is None else a + tracer * tilt, tilt, (b - drawn.b0) / rocker)


def circuit_loops(four_bar: FourBar) -> tuple[CircuitLoop, ...]:
    """All circuits of a four-bar: one or two.

    >>> [loop.branch for loop in circuit_loops(FourBar(0j, 4 + 0j, 1j, 3 + 3j))]
    [1, -1]
    """
    ground = float(np.angle(four_bar.b0 - four_bar.a0))
    ranges = input_range(*four_bar.lengths)
    if ranges and ranges[0][1] - ranges[0][0] >= 2 * np.pi:
        return tuple(CircuitLoop(four_bar, -np.pi, np.pi, branch) for branch in (+1, -1))
    return tuple(CircuitLoop(four_bar, low + ground, high + ground, 0) for low, high in ranges)
