"""Circuits of a four-bar as smooth closed curves of one parameter u, in closed form.

    crank rotates fully:                             crank angle = u, one circuit per branch
    otherwise, for each interval of the crank:       crank angle = middle + half cos u,    branch = sign(sin u)

The second form is smooth at the dead centres of the crank, u = 0 and pi: the angle between coupler and rocker depends
there on the square root of the crank angle's distance from the dead centre, so B and all derived quantities are smooth
in u. `linkage.circuits` follows the circuits of any mechanism; for a four-bar both give the same.
"""

from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, Float, FloatArray, RealField
from ilmek.linkage.quality import input_range
from ilmek.records import record
from ilmek.synthesis.four_bar import FourBar


@record
class LoopConfigurations:
    """Configurations: moving pins and tracer [m] (0 without tracer), unit vectors along coupler and rocker."""

    a: ComplexArray
    b: ComplexArray
    tracer: ComplexArray
    coupler: ComplexArray
    rocker: ComplexArray


@dataclass(frozen=True, slots=True)
class CircuitLoop:
    """A circuit: crank angles from `low` to `high` [rad], ground frame; `branch` of a fully rotating crank, else 0."""

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
        """Branch at u [rad], +1 or -1."""
        return np.where(np.sin(u) >= 0, 1.0, -1.0) if not self.branch else np.full(np.shape(u), float(self.branch))

    def parameters_at(self, crank: RealField, slack: float = 1e-9) -> Float[np.ndarray, " parameters"]:
        """All u [rad] at a crank angle [rad]; empty where it is outside the circuit by more than `slack` [rad]."""
        if self.branch:
            return np.atleast_1d(np.asarray(crank, dtype=float))
        middle, half = 0.5 * (self.low + self.high), 0.5 * (self.high - self.low)
        off = float(np.angle(np.exp(1j * (float(crank) - middle))))
        if abs(off) > half + slack:
            return np.empty(0)
        u = float(np.arccos(np.clip(off / half, -1.0, 1.0)))
        return np.array([u, -u])

    def at(self, u: FloatArray) -> LoopConfigurations:
        """Configurations at u [rad], of any shape."""
        linkage = self.four_bar
        _, crank, coupler, rocker = linkage.lengths
        a: ComplexArray = linkage.a0 + crank * np.exp(1j * self.crank(u))
        d = linkage.b0 - a
        dd = np.maximum(d.real**2 + d.imag**2, 1e-200)
        along = 0.5 + 0.5 * (coupler**2 - rocker**2) / dd
        across = self.branches(u) * np.sqrt(np.maximum(coupler**2 / dd - along**2, 0.0))
        b = a + (along + 1j * across) * d
        tilt = (b - a) / coupler
        tracer = linkage.tracer_on_coupler
        return LoopConfigurations(a, b, 0 * a if tracer is None else a + tracer * tilt, tilt, (b - linkage.b0) / rocker)


def circuit_loops(four_bar: FourBar) -> tuple[CircuitLoop, ...]:
    """All circuits of a four-bar: one or two, none where it does not close.

    >>> [loop.branch for loop in circuit_loops(FourBar(0j, 4 + 0j, 1j, 3 + 3j))]
    [1, -1]
    """
    ground = float(np.angle(four_bar.b0 - four_bar.a0))
    ranges = input_range(*four_bar.lengths)
    if ranges and ranges[0][1] - ranges[0][0] >= 2 * np.pi:
        return tuple(CircuitLoop(four_bar, -np.pi, np.pi, branch) for branch in (+1, -1))
    return tuple(CircuitLoop(four_bar, low + ground, high + ground, 0) for low, high in ranges)
