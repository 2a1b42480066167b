"""Exact derivatives of what a mechanism does by its dimensions, by implicit differentiation of the loop equations.

    c(x, p) = 0                    J x_p = -c_p                                  x_p: poses by the dimension p
    c_x x' = input's speed         J x'_p = -(c_xx x' x_p + c_xp x')              x'_p: velocities by p
    y(x, p)                        dy/dp = y_x x_p + y_p                          and y' likewise

The mixed second derivative is had from the equations' bias q(v) = c_xx v v, a quadratic form, without a formula of its
own: c_xx v w = (q(v + w) - q(v - w)) / 4, exactly. What is true at a fixed input is true of an extreme too: the value
of an extreme of y changes as y does (envelope theorem); the input at which it stands by -(dy'/dp) / y''.
[Haug, Komkov, Choi: Design Sensitivity Analysis of Structural Systems, chapter 1: direct differentiation.]
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Float, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.dimensions import NONE, BodyShift, Dimension, Nudges
from ilmek.linkage.displacements import Moves, added, at_origins, contracted, largest, moving, times
from ilmek.linkage.equations import Equation
from ilmek.linkage.loops import Loops, loops
from ilmek.linkage.motion import Motion
from ilmek.linkage.outputs import Output
from ilmek.num.linear import solve_many


@dataclass(frozen=True, slots=True)
class Derivatives:
    """Derivatives of an output's value and rate by each dimension, at each sample, the inputs held as they are."""

    dimensions: tuple[Dimension, ...]
    value: Float[np.ndarray, "dimensions samples"]
    rate: Float[np.ndarray, "dimensions samples"]


@dataclass(frozen=True, slots=True)
class OutputTolerance:
    """By how much an output may miss, for given tolerances: all against it, and as independent errors add up."""

    worst_case: Float[np.ndarray, " samples"]
    root_sum_square: Float[np.ndarray, " samples"]


def derivatives(motion: Motion, output: Output, dimensions: Sequence[Dimension]) -> Derivatives:
    """Exact derivatives of an output by dimensions over a motion; NaN where it does not close or is dead.

    output      in rad or m      dimensions  Place [m], LineDirection or FixedAngle [rad]; see `dimensions`
    The rate's derivative is at the inputs' speeds of the motion: per second, or per radian where they are 1.
    Raises MechanismError for an unknown body, point or slide.

    >>> from ilmek.linkage.dimensions import BodyPoint
    >>> from ilmek.linkage.fourbar import slider_crank
    >>> from ilmek.linkage.outputs import Travel
    >>> from ilmek.linkage.solve import solve
    >>> from ilmek.linkage.structure import plan
    >>> motion = solve(plan(slider_crank(0.1, 0.3, branch=+1)), np.array([0.0, np.pi]), 1.0)
    >>> derivatives(motion, Travel("line"), [BodyPoint("crank", "A"), BodyPoint("rod", "B")]).value.round(12)
    array([[ 1., -1.],
           [ 1.,  1.]])
    """
    mechanism = motion.plan.mechanism
    bodies = at_origins({body.name: motion.body(body.name) for body in mechanism.bodies})
    at = _Poses(motion, loops(mechanism), bodies)
    if not dimensions:
        return Derivatives((), np.empty((0, len(motion))), np.empty((0, len(motion))))
    value, rate = _differentiated(at, output, _together([one.nudges(mechanism) for one in dimensions]))
    shape = len(dimensions), len(motion)
    return Derivatives(tuple(dimensions), np.broadcast_to(value, shape) + 0.0, np.broadcast_to(rate, shape) + 0.0)


def spread(by_dimension: Float[np.ndarray, "dimensions samples"], tolerances: Sequence[float]) -> OutputTolerance:
    """Worst case sum |d| t and root of sum (d t)^2 over the dimensions, for tolerances +-t of each [m, rad].

    Raises MechanismError where there are not as many tolerances as dimensions, or one is negative or not finite.
    >>> found = spread(np.array([[1.0], [-2.0]]), [0.03, 0.02])
    >>> found.worst_case.round(12), found.root_sum_square.round(12)
    (array([0.07]), array([0.05]))
    """
    if len(tolerances) != len(by_dimension):
        raise MechanismError(f"{len(tolerances)} tolerances for {len(by_dimension)} dimensions", do="give one for each")
    for tolerance in tolerances:
        if not (np.isfinite(tolerance) and tolerance >= 0):
            raise MechanismError(f"a tolerance is {tolerance}", allowed="0 or above, in metres or radians")
    shares = np.abs(by_dimension) * np.asarray(tolerances, dtype=float)[:, None]
    return OutputTolerance(shares.sum(axis=0), np.sqrt((shares**2).sum(axis=0)))


@dataclass(frozen=True, slots=True)
class _Poses:
    """A motion's poses and velocities, and the equations that hold them."""

    motion: Motion
    loops: Loops
    bodies: Mapping[str, BodyMotion]

    @property
    def samples(self) -> tuple[int, ...]:
        return self.motion.status.shape

    @property
    def velocities(self) -> Moves:
        return {name: (body.anchor.velocity, body.omega) for name, body in self.bodies.items()}

    def equations(self, output: Output, rates: Moves, nudges: Nudges) -> list[Equation]:
        """The loop equations and then the output's, at given rates, each as its joint sees the bodies."""

        def seen(joint: str) -> dict[str, BodyMotion]:
            return moving(self.bodies, added(rates, self.nudged(joint, nudges)))

        held = self.loops.equations(seen, self.motion.drives)
        return [*held, output.equation(self.motion.plan.mechanism, seen(output.place))]

    def nudged(self, joint: str, nudges: Nudges) -> Moves:
        """World displacements of the bodies that a joint sees displaced."""
        return {
            body: (self.bodies[body].direction * shift, turn)
            for (place, body), (shift, turn) in nudges.items()
            if place == joint
        }

    def turned(self, joint: str, nudges: Nudges) -> Moves:
        """How fast those displacements change as the bodies turn."""
        return {
            body: (1j * self.bodies[body].omega * self.bodies[body].direction * nudge.shift, 0.0)
            for (place, body), nudge in nudges.items()
            if place == joint
        }


def _together(apart: Sequence[Nudges]) -> Nudges:
    """The nudges of all dimensions, one a row; rows on which a dimension does not act are zero."""
    return {
        key: BodyShift(
            np.array([[complex(one.get(key, NONE).shift)] for one in apart]),
            np.array([[float(one.get(key, NONE).turn)] for one in apart]),
        )
        for key in {key for one in apart for key in one}
    }


def _differentiated(at: _Poses, output: Output, nudges: Nudges) -> tuple[RealField, RealField]:
    """Derivatives of the output's value and rate by all dimensions: one a row, a sample a column."""
    joints = [*at.loops.joints, output.place]
    held = at.equations(output, at.velocities, {})
    matrix = at.loops.matrix(held[:-1], at.samples)
    rows = max(np.shape(nudge.shift)[0] for nudge in nudges.values())

    def answer(direct: list[RealField]) -> tuple[Moves, RealField]:
        right = at.loops.column(held[:-1], [-one for one in direct[:-1]], (rows, *at.samples))
        moves = at.loops.moves(solve_many(np.broadcast_to(matrix, (rows, *matrix.shape)), right))
        return moves, contracted(held[-1].row, moves) + direct[-1]

    direct = [contracted(one.row, at.nudged(joint, nudges)) for one, joint in zip(held, joints, strict=True)]
    moved, value = answer(direct)
    mixed = _mixed(at, output, moved, nudges)
    turned = [contracted(one.row, at.turned(joint, nudges)) for one, joint in zip(held, joints, strict=True)]
    return value, answer([one + other for one, other in zip(mixed, turned, strict=True)])[1]


def _mixed(at: _Poses, output: Output, moved: Moves, nudges: Nudges) -> list[RealField]:
    """c_xx v w of every equation, v the velocities and w the displacements by the dimension.

    w is brought to the size of v first, so that neither is lost in their sum; where v is 0, so is the answer.
    """
    v = at.velocities
    share = largest(v, at.loops.scale) / np.maximum(largest(moved, at.loops.scale), 1e-300)
    share = np.where((share > 0) & np.isfinite(share), share, 1.0)

    def biases(sign: RealField) -> list[RealField]:
        """q(v + w) and q(v - w), w with the sign."""
        seen = {key: BodyShift(nudge.shift * sign, nudge.turn * sign) for key, nudge in nudges.items()}
        return [one.bias for one in at.equations(output, added(v, times(moved, sign)), seen)]

    pairs = zip(biases(share), biases(-share), strict=True)
    return [(one - other) / (4 * share) for one, other in pairs]
