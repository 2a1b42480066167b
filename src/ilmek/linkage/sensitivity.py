"""Exact derivatives of a mechanism's outputs by its dimensions, by implicit differentiation of the loop equations.

    c(x, p) = 0                    J x_p = -c_p                                  x_p: poses by the dimension p
    c_x x' = input's speed         J x'_p = -(c_xx x' x_p + c_xp x')              x'_p: velocities by p
    y(x, p)                        dy/dp = y_x x_p + y_p                          and y' likewise

The mixed second derivative follows from the equations' bias q(v) = c_xx v v, a quadratic form, without a formula of its
own: c_xx v w = (q(v + w) - q(v - w)) / 4, exactly. The value of an extreme of y has the derivative of y at the fixed
input (envelope theorem); the input of the extreme has the derivative -(dy'/dp) / y''.
[Haug, Komkov, Choi: Design Sensitivity Analysis of Structural Systems, chapter 1: direct differentiation.]
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Float, RealField
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import BodyMotion
from ilmek.linkage.dimensions import NONE, BodyShift, BodyShifts, Dimension
from ilmek.linkage.displacements import Moves, added, at_origins, contracted, largest, moving, times
from ilmek.linkage.equations import Equation
from ilmek.linkage.loops import Loops, loops
from ilmek.linkage.motion import Motion
from ilmek.linkage.outputs import Output
from ilmek.num.linear import solve_many
from ilmek.records import record


@record
class Derivatives:
    """Derivatives of an output's value and rate by each dimension, at each sample, at fixed inputs."""

    dimensions: tuple[Dimension, ...]
    value: Float[np.ndarray, "dimensions samples"]
    rate: Float[np.ndarray, "dimensions samples"]


@record
class OutputTolerance:
    """Error of an output for given tolerances: worst case, and root sum square of independent errors."""

    worst_case: Float[np.ndarray, " samples"]
    root_sum_square: Float[np.ndarray, " samples"]


def derivatives(motion: Motion, output: Output, dimensions: Sequence[Dimension]) -> Derivatives:
    """Exact derivatives of an output by dimensions over a motion; NaN where it does not close or is at a dead centre.

    output      in rad or m      dimensions  BodyPoint [m], LineDirection or FixedAngle [rad]; see `dimensions`
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
    value, rate = _differentiated(at, output, _together([dimension.shifts(mechanism) for dimension in dimensions]))
    shape = len(dimensions), len(motion)
    return Derivatives(tuple(dimensions), np.broadcast_to(value, shape) + 0.0, np.broadcast_to(rate, shape) + 0.0)


def spread(by_dimension: Float[np.ndarray, "dimensions samples"], tolerances: Sequence[float]) -> OutputTolerance:
    """Worst case sum |d| t, and sqrt(sum (d t)^2), over the dimensions, for tolerances +-t of each [m, rad].

    Raises MechanismError for a wrong number of tolerances, or one that is negative or not finite.
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
    """A motion's poses and velocities, and the loop equations."""

    motion: Motion
    loops: Loops
    bodies: Mapping[str, BodyMotion]

    @property
    def samples(self) -> tuple[int, ...]:
        return self.motion.status.shape

    @property
    def velocities(self) -> Moves:
        return {name: (body.anchor.velocity, body.omega) for name, body in self.bodies.items()}

    def equations(self, output: Output, rates: Moves, shifts: BodyShifts) -> list[Equation]:
        """The loop equations and then the output's, at given rates, with the displacements of each joint."""

        def seen(joint: str) -> dict[str, BodyMotion]:
            return moving(self.bodies, added(rates, self.shifted(joint, shifts)))

        equations = self.loops.equations(seen, self.motion.drives)
        return [*equations, output.equation(self.motion.plan.mechanism, seen(output.location))]

    def shifted(self, joint: str, shifts: BodyShifts) -> Moves:
        """Displacements of the bodies in the equations of a joint, in the world."""
        return {
            body: (self.bodies[body].direction * shift, turn)
            for (location, body), (shift, turn) in shifts.items()
            if location == joint
        }

    def turned(self, joint: str, shifts: BodyShifts) -> Moves:
        """Rates of the displacements `shifted` by the rotation of the bodies."""
        return {
            body: (1j * self.bodies[body].omega * self.bodies[body].direction * shift.shift, 0.0)
            for (location, body), shift in shifts.items()
            if location == joint
        }


def _together(apart: Sequence[BodyShifts]) -> BodyShifts:
    """The displacements of all dimensions, one per row; zero where a dimension does not act."""
    return {
        key: BodyShift(
            np.array([[complex(one.get(key, NONE).shift)] for one in apart]),
            np.array([[float(one.get(key, NONE).turn)] for one in apart]),
        )
        for key in {key for one in apart for key in one}
    }


def _differentiated(at: _Poses, output: Output, shifts: BodyShifts) -> tuple[RealField, RealField]:
    """Derivatives of the output's value and rate by the dimensions, (dimensions, samples)."""
    joints = [*at.loops.joints, output.location]
    equations = at.equations(output, at.velocities, {})
    matrix = at.loops.matrix(equations[:-1], at.samples)
    rows = max(np.shape(shift.shift)[0] for shift in shifts.values())

    def answer(direct: list[RealField]) -> tuple[Moves, RealField]:
        right = at.loops.column(equations[:-1], [-one for one in direct[:-1]], (rows, *at.samples))
        moves = at.loops.moves(solve_many(np.broadcast_to(matrix, (rows, *matrix.shape)), right))
        return moves, contracted(equations[-1].row, moves) + direct[-1]

    direct = [contracted(one.row, at.shifted(joint, shifts)) for one, joint in zip(equations, joints, strict=True)]
    moved, value = answer(direct)
    mixed = _mixed(at, output, moved, shifts)
    turned = [contracted(one.row, at.turned(joint, shifts)) for one, joint in zip(equations, joints, strict=True)]
    return value, answer([one + other for one, other in zip(mixed, turned, strict=True)])[1]


def _mixed(at: _Poses, output: Output, moved: Moves, shifts: BodyShifts) -> list[RealField]:
    """c_xx v w of every equation, v the velocities and w the displacements by the dimension.

    w is scaled to the size of v first, so that neither is lost in their sum; where v is 0, the result is 0.
    """
    v = at.velocities
    share = largest(v, at.loops.scale) / np.maximum(largest(moved, at.loops.scale), 1e-300)
    share = np.where((share > 0) & np.isfinite(share), share, 1.0)

    def biases(sign: RealField) -> list[RealField]:
        """q(v + sign w)."""
        seen = {key: BodyShift(shift.shift * sign, shift.turn * sign) for key, shift in shifts.items()}
        return [equation.bias for equation in at.equations(output, added(v, times(moved, sign)), seen)]

    pairs = zip(biases(share), biases(-share), strict=True)
    return [(one - other) / (4 * share) for one, other in pairs]
