"""Mobility of a mechanism: by count, and by the rank of its loop equations in a pose.

    by count  3 n - 2 j - c    n moving bodies, j joints, c couplings    [Gruebler's criterion; Norton, chapter 2]
    by rank   3 n - rank J     J the derivatives of all loop equations by the poses

The two differ where a constraint is redundant: a third link across a parallelogram, a guide and a bearing in one line.
The joints concerned follow from the dependent rows, J^T v = 0. In a singular pose (a dead centre, a flattened
parallelogram) rows may be dependent that are independent in neighbouring poses, so the rank is computed there too.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.solve import solve
    >>> from ilmek.linkage.structure import plan
    >>> motion = solve(plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1)), 1.0)
    >>> print(mobility(motion.plan.mechanism, motion.pose()).description)
    1 degree of freedom by count and by rank
"""

import cmath
import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.equations import Equation
from ilmek.linkage.groups.group import Known
from ilmek.linkage.initial_pose import bodies_in_pose
from ilmek.linkage.loops import Loops, loops
from ilmek.linkage.model import Mechanism, degrees_of_freedom

FLAT = 1e-8
"""Largest ratio of a singular value to the greatest one at which it counts as zero; poses are closed far below it."""

PART = 1e-6
"""Least share of a joint in the dependent rows with which it is reported."""

CLOSED = 1e-11
"""Greatest gap of an assembled pose, relative to the mechanism's size."""

ASIDE = 0.01
"""Distance of the neighbouring poses, relative to the mechanism's size."""

STEPS = 60
"""Maximum number of steps of the assembly."""


@dataclass(frozen=True, slots=True)
class Mobility:
    """Degrees of freedom of a mechanism in a pose, with free inputs.

    counted    by count        ranked  by rank in the pose        beside  by rank in neighbouring poses, the least
    redundant  joints and couplings with linearly dependent constraints in the pose
    surplus    number of redundant constraints in the pose
    """

    counted: int
    ranked: int
    beside: int
    redundant: tuple[str, ...]
    surplus: int

    @property
    def singular(self) -> bool:
        """Whether the pose has more degrees of freedom than its neighbours: a dead centre or a change point."""
        return self.ranked > self.beside

    @property
    def description(self) -> str:
        """Summary in words."""
        if self.counted == self.ranked:
            return f"{_degrees(self.counted)} by count and by rank"
        constraints = "1 constraint is" if self.surplus == 1 else f"{self.surplus} constraints are"
        counts = f"{_degrees(self.counted)} by count, {self.ranked} by rank: {constraints} redundant"
        where = f", {self.beside} in neighbouring poses" if self.singular else ""
        return f"{counts}{where}; among {', '.join(self.redundant)}"


def mobility(mechanism: Mechanism, pose: Mapping[str, tuple[complex, float]] | None = None) -> Mobility:
    """Degrees of freedom [1] of a mechanism in a pose, by count and by rank.

    pose  body -> (origin [m], angle [rad]), approximate; default: the mechanism's own pose
    Raises MechanismError with the open joints where the mechanism cannot be assembled near the pose.
    """
    free = dataclasses.replace(mechanism, inputs=(), pose=mechanism.pose if pose is None else pose)
    system = loops(free)
    bodies = _assembled(system, bodies_in_pose(free))
    left, values, right = np.linalg.svd(_matrix(system, bodies))
    rank = _rank(values)
    shares = np.linalg.norm(left[:, rank:], axis=1)
    redundant = dict.fromkeys(name for name, share in zip(system.joints, shares, strict=True) if share > PART)
    size, equations = right.shape[0], left.shape[0]
    return Mobility(
        degrees_of_freedom(free), size - rank, _beside(system, bodies, right[rank:]), tuple(redundant), equations - rank
    )


def _beside(system: Loops, bodies: Known, directions: FloatArray) -> int:
    """Least number of degrees of freedom in the neighbouring poses, one step away along each null vector."""
    size = 3 * len(system.mechanism.moving)
    found = [len(directions)]
    for step in directions:
        for side in (ASIDE, -ASIDE):
            try:
                near = _assembled(system, _moved(system, bodies, side * system.scale * step))
            except MechanismError:  # no assembled pose in that direction
                continue
            found.append(size - _rank(np.linalg.svd(_matrix(system, near), compute_uv=False)))
    return min(found)


def _rank(values: FloatArray) -> int:
    return int(np.sum(values > FLAT * values[0])) if len(values) else 0


def _matrix(system: Loops, bodies: Known) -> FloatArray:
    return system.matrix(_equations(system, bodies), ())


def _equations(system: Loops, bodies: Known) -> list[Equation]:
    return system.equations(lambda _: bodies, {})


def _assembled(system: Loops, bodies: Known) -> Known:
    """The bodies in the nearest pose with closed joints [Gauss-Newton method, steps of least norm]."""
    gap = np.empty(0)
    for _ in range(STEPS):
        equations = _equations(system, bodies)
        gap = system.column(equations, [equation.value for equation in equations], ())
        if np.abs(gap).max(initial=0.0) <= CLOSED * system.scale:
            return bodies
        step = np.linalg.lstsq(system.matrix(equations, ()), gap, rcond=FLAT)[0]
        bodies = _moved(system, bodies, -step)
    open_ones = dict.fromkeys(
        name for name, by in zip(system.joints, np.abs(gap), strict=True) if not by <= CLOSED * system.scale
    )
    raise MechanismError(
        f"{system.mechanism.name} cannot be assembled near its pose: {', '.join(open_ones)} do not close",
        do="give a pose nearer to an assembled one, or other lengths",
    )


def _moved(system: Loops, bodies: Known, step: FloatArray) -> Known:
    moved = dict(bodies)
    for body, (shift, turn) in system.moves(step).items():
        at, direction = bodies[body].anchor.position + complex(shift), bodies[body].direction
        turned = direction * cmath.exp(1j * float(turn))
        moved[body] = BodyMotion(PointMotion(at, 0j, 0j), 0j, turned / np.abs(turned), 0.0, 0.0)
    return moved


def _degrees(count: int) -> str:
    return f"{count} degree{'' if count == 1 else 's'} of freedom"
