"""How many freedoms a mechanism has: by count, and by the rank of its loop equations in a pose.

    by count  3 n - 2 j - c    n moving bodies, j joints, c couplings    [Gruebler, Chebyshev]
    by rank   3 n - rank J     J the derivatives of all loop equations by the poses

The two differ where a constraint repeats what others hold already: a third link across a parallelogram, a guide and a
bearing in one line. Which joints are in it is read off the rows that depend on one another, J^T v = 0. In a single pose
(a dead centre, a flattened parallelogram) rows may be dependent that are not beside it; so the rank is taken there too.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.solve import solve
    >>> from ilmek.linkage.structure import plan
    >>> motion = solve(plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1)), 1.0)
    >>> print(mobility(motion.plan.mechanism, motion.pose()).words)
    1 freedom by count, and by rank
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
from ilmek.linkage.initial_pose import drawn
from ilmek.linkage.loops import Loops, loops
from ilmek.linkage.model import Mechanism, degrees_of_freedom

FLAT = 1e-8
"""A singular value this small against the largest is zero: poses are assembled to rounding, far below."""

PART = 1e-6
"""A joint with a share this large in dependent rows is in the dependence."""

CLOSED = 1e-11
"""Gap of an assembled pose, of the mechanism's size."""

ASIDE = 0.01
"""How far beside the pose the rank is taken again, of the mechanism's size."""

STEPS = 60
"""Steps of the assembly at most."""


@dataclass(frozen=True, slots=True)
class Mobility:
    """Freedoms of a mechanism in a pose, its inputs left free.

    counted    by count        ranked  by rank in the pose        beside  by rank in poses beside it
    redundant  joints and couplings whose constraints depend on one another in the pose
    surplus    how many constraints repeat what the others hold there
    """

    counted: int
    ranked: int
    beside: int
    redundant: tuple[str, ...]
    surplus: int

    @property
    def singular(self) -> bool:
        """Whether it has more freedoms in this pose than beside it: a dead centre or a change point."""
        return self.ranked > self.beside

    @property
    def words(self) -> str:
        """All of it for people."""
        if self.counted == self.ranked:
            return f"{_freedoms(self.counted)} by count, and by rank"
        constraints = "1 constraint repeats" if self.surplus == 1 else f"{self.surplus} constraints repeat"
        said = f"{_freedoms(self.counted)} by count, {self.ranked} by rank: {constraints} what the others hold"
        where = f", {self.beside} beside this pose" if self.singular else ""
        return f"{said}{where}; among {', '.join(self.redundant)}"


def mobility(mechanism: Mechanism, pose: Mapping[str, tuple[complex, float]] | None = None) -> Mobility:
    """Freedoms in a pose: body -> (origin [m], angle [rad]), roughly; the mechanism's own pose where none is given.

    Raises MechanismError, naming the joints that stay apart, where the mechanism cannot be assembled near the pose.
    """
    free = dataclasses.replace(mechanism, inputs=(), pose=mechanism.pose if pose is None else pose)
    held = loops(free)
    bodies = _assembled(held, drawn(free))
    left, values, right = np.linalg.svd(_matrix(held, bodies))
    rank = _rank(values)
    shares = np.linalg.norm(left[:, rank:], axis=1)
    redundant = dict.fromkeys(name for name, share in zip(held.joints, shares, strict=True) if share > PART)
    size, equations = right.shape[0], left.shape[0]
    return Mobility(
        degrees_of_freedom(free), size - rank, _beside(held, bodies, right[rank:]), tuple(redundant), equations - rank
    )


def _beside(held: Loops, bodies: Known, ways: FloatArray) -> int:
    """Least number of freedoms in poses beside one, a step away along each way that is free in it."""
    size = 3 * len(held.mechanism.moving)
    found = [len(ways)]
    for way in ways:
        for side in (ASIDE, -ASIDE):
            try:
                near = _assembled(held, _moved(held, bodies, side * held.scale * way))
            except MechanismError:  # that way leads nowhere
                continue
            found.append(size - _rank(np.linalg.svd(_matrix(held, near), compute_uv=False)))
    return min(found)


def _rank(values: FloatArray) -> int:
    return int(np.sum(values > FLAT * values[0])) if len(values) else 0


def _matrix(held: Loops, bodies: Known) -> FloatArray:
    return held.matrix(_equations(held, bodies), ())


def _equations(held: Loops, bodies: Known) -> list[Equation]:
    return held.equations(lambda _: bodies, {})


def _assembled(held: Loops, bodies: Known) -> Known:
    """The bodies moved the shortest way to where all joints close [Gauss and Newton, least norm]."""
    gap = np.empty(0)
    for _ in range(STEPS):
        equations = _equations(held, bodies)
        gap = held.column(equations, [one.value for one in equations], ())
        if np.abs(gap).max(initial=0.0) <= CLOSED * held.scale:
            return bodies
        step = np.linalg.lstsq(held.matrix(equations, ()), gap, rcond=FLAT)[0]
        bodies = _moved(held, bodies, -step)
    open_ones = dict.fromkeys(
        name for name, by in zip(held.joints, np.abs(gap), strict=True) if not by <= CLOSED * held.scale
    )
    raise MechanismError(
        f"{held.mechanism.name} cannot be assembled near its pose: {', '.join(open_ones)} stay apart",
        do="give a pose nearer to an assembled one, or other lengths",
    )


def _moved(held: Loops, bodies: Known, step: FloatArray) -> Known:
    moved = dict(bodies)
    for body, (shift, turn) in held.moves(step).items():
        at, direction = bodies[body].anchor.position + complex(shift), bodies[body].direction
        turned = direction * cmath.exp(1j * float(turn))
        moved[body] = BodyMotion(PointMotion(at, 0j, 0j), 0j, turned / np.abs(turned), 0.0, 0.0)
    return moved


def _freedoms(count: int) -> str:
    return f"{count} freedom{'' if count == 1 else 's'}"
