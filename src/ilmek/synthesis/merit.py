"""Merit of a four-bar that fulfils its task: one number from 0 to 1, the greatest is the best.

    M⁴ = T · 1/(1 + S/4) · 1/(1 + (R - 1)/4) · 1/(1 + G/4),      T = sin μ · min(1, sin μ / sin 40°)²

    μ  least transmission angle over the motion: from the first to the last position, or, where the crank turns fully,
       over its whole turn unless the task alone is required
    S  size of the four-bar over its motion / extent of the task
    R  longest link / shortest link
    G  sensitivity: Σ √(|∂P|² + (E ∂β)² + (E ∂ψ)²) over the four link lengths, greatest of all positions, at a given
       crank angle. P is the tracer [m], β the angle of the coupler, ψ that of the rocker, each where the task requires
       it; E is the extent of the task. G = 3 means: links that are ±0.1 mm off move a position by up to 0.3 mm.

M is the geometric mean of four terms from 0 to 1. The terms of S, R - 1 and G are one half at 4; that of μ falls with
the cube of its sine below 40°, the rule of thumb of the check.                                        [this project]
"""

import math

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, RealField
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.plane.vectors import cross
from ilmek.records import record
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.four_bar import TRACER, FourBar
from ilmek.units import deg

TRANSMISSION = 40 * deg
"""Least transmission angle of a four-bar by the rule of thumb for rockers."""

TOLERANCE = 1e-4
"""Error of each link length [m] for which the errors of the positions are reported: 0.1 mm."""

RULE_SINE = math.sin(TRANSMISSION)
"""Sine of the transmission angle of the rule of thumb."""


@record
class Merit:
    """The terms of the merit of a four-bar, as in the formula above.

    transmission  least transmission angle over the motion, or over the task alone [rad]
    size          over the extent of the task [1]       ratio  longest link / shortest link [1]
    sensitivity   G [1]
    point_shift   greatest sum of the tracer's errors [m] where every link is `TOLERANCE` off; NaN without a tracer
    angle_shift   likewise of the coupler's angle [rad]
    """

    transmission: float
    size: float
    ratio: float
    sensitivity: float
    point_shift: float
    angle_shift: float

    @property
    def value(self) -> float:
        """The merit M, 0 to 1."""
        return float(merit_value(math.sin(self.transmission), self.size, self.ratio, self.sensitivity))

    def as_json(self) -> dict[str, float | dict[str, float] | None]:
        """The merit, its terms and the errors, by the names of the JSON; SI."""
        terms = {"transmission": self.transmission, "size": self.size, "ratio": self.ratio}
        point = None if math.isnan(self.point_shift) else self.point_shift
        return {
            "merit": self.value,
            "merit_terms": {**terms, "sensitivity": self.sensitivity},
            "point_shift": point,
            "angle_shift": self.angle_shift,
        }


def merit_value(sine: RealField, size: RealField, ratio: RealField, sensitivity: RealField) -> RealField:
    """M of the sine of the least transmission angle, S, R and G, all [1].

    >>> float(merit_value(1.0, 0.0, 1.0, 0.0)), float(merit_value(1.0, 0.0, 5.0, 4.0))
    (1.0, 0.7071067811865476)
    """
    good = np.minimum(1.0, sine / RULE_SINE)
    return (sine * good * good / ((1 + size / 4) * (0.75 + ratio / 4) * (1 + sensitivity / 4))) ** 0.25


def coupler_rates(
    a0: ComplexField, b0: ComplexField, a: ComplexField, b: ComplexField
) -> tuple[RealField, RealField, RealField, RealField]:
    """Derivatives of the coupler's angle by the lengths of ground, crank, coupler, rocker [rad/m], crank angle given.

    With γ = B - A and ρ = B - B0 the loop gives ρ · (δB - δB0) = k δk, δB = δA + γ/c δc + iγ δβ. Infinite at a dead
    centre of the crank.                                                                    [derived here]
    """
    gamma, rho, base, arm = b - a, b - b0, b0 - a0, a - a0
    across = gamma.real * rho.imag - gamma.imag * rho.real
    ground = (rho.real * base.real + rho.imag * base.imag) / (np.abs(base) * across)
    crank = -(rho.real * arm.real + rho.imag * arm.imag) / (np.abs(arm) * across)
    coupler = -(rho.real * gamma.real + rho.imag * gamma.imag) / (np.abs(gamma) * across)
    return ground, crank, coupler, np.abs(rho) / across


def merit(one: Candidate, *, task_only: bool = False) -> Merit:
    """The terms of the merit of a candidate that reaches all positions of its task.

    task_only  whether the transmission angle is that from the first to the last position, also of a crank that turns
    """
    drawn, task, lengths = one.four_bar, one.task, one.four_bar.lengths
    extent = extent_of(one)
    branch = next((met.branch for met in one.positions if met.branch), drawn.branch)
    motion = solve(plan(drawn.mechanism(branch)), np.array([met.crank_angle for met in one.positions]))
    a, b = (np.asarray(motion.point("coupler", name).position) for name in ("A", "B"))
    a0, b0 = drawn.a0, drawn.b0
    ends = np.broadcast_to(a0, a.shape), np.broadcast_to(b0, a.shape)
    with np.errstate(divide="ignore", invalid="ignore"):
        turned = np.stack(coupler_rates(*ends, a, b))
        along = np.zeros((4, len(a)), dtype=np.complex128)
        along[1] = (a - a0) / lengths.crank
        shifts = np.zeros((4, len(a)))
        points = np.zeros((4, len(a)))
        if drawn.tracer is not None:
            tracer = motion.point("coupler", TRACER).position
            points = np.abs(along + 1j * (tracer - a) * turned)
        if task.points is not None:
            shifts = shifts + points**2
        if task.coupler is not None:
            shifts = shifts + (extent * turned) ** 2
        if task.rocker is not None:
            shifts = shifts + (extent * _rocker_rates(drawn, a, b, turned, along)) ** 2
    return Merit(
        transmission=one.transmission_over(task_only=task_only),
        size=one.size / extent,
        ratio=one.link_ratio,
        sensitivity=_worst(np.sqrt(shifts)),
        point_shift=TOLERANCE * _worst(points) if drawn.tracer is not None else math.nan,
        angle_shift=TOLERANCE * _worst(np.abs(turned)),
    )


def extent_of(one: Candidate) -> float:
    """Extent of a candidate's task [m]: greatest distance of two points; without points the ground link."""
    points = one.task.points
    most = 0.0 if points is None else extent_of_points(points)
    return most or one.four_bar.lengths.ground


def extent_of_points(points: ComplexArray) -> float:
    """Greatest distance of two points [m]."""
    return float(np.max(np.abs(points[:, None] - points)))


def _rocker_rates(
    drawn: FourBar, a: ComplexArray, b: ComplexArray, turned: RealField, along: ComplexArray
) -> RealField:
    """Derivatives of the rocker's angle by the four lengths [rad/m]."""
    a0, b0 = drawn.a0, drawn.b0
    gamma, rho = b - a, b - b0
    moved = along + 1j * gamma * turned
    moved[2] += gamma / np.abs(gamma)
    moved[0] -= (b0 - a0) / abs(b0 - a0)
    return np.asarray(cross(rho, moved) / np.abs(rho) ** 2)


def _worst(shifts: RealField) -> float:
    """Greatest sum over the four lengths of all positions."""
    return float(np.max(np.sum(shifts, axis=0)))
