"""A solution with disturbed numbers: known points and directions are changed by a few units of their last digit.

The spread of several such solutions is the error of the solution [Vignes, A stochastic arithmetic for reliable
scientific computation, Mathematics and Computers in Simulation 35 (1993)]. It contains what a bound by formulas would
have to derive for each group: amplification near a dead centre, and all errors that a group inherits.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from ilmek.arrays import ComplexArray, ComplexField, FloatArray
from ilmek.linkage.anchors import local_ground
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.groups.general import GeneralGroup
from ilmek.linkage.groups.group import GroupSolution, InputMotion
from ilmek.linkage.model import GROUND
from ilmek.linkage.structure import Plan
from ilmek.records import record

RUNS = 24
"""Number of disturbed solutions, two by two with opposite disturbances; all are computed at once."""

UNITS = 2.0
"""Disturbance of a number in units of 2^-52, the spacing of doubles at 1: about what a formula of a group loses."""

ROUNDING = float(np.finfo(float).eps)


@record
class Noise:
    """Disturbances in the order in which they are required, the same for all samples of a run.

    Fields have RUNS times `samples` values, run by run.
    """

    draw: np.random.Generator
    samples: int

    def factor(self) -> FloatArray:
        """1 and a disturbance."""
        return np.asarray(1.0 + self._spread(self.draw.choice((-1.0, 1.0), RUNS // 2)))

    def vector(self) -> ComplexArray:
        """A disturbance of a vector of length 1."""
        return np.asarray(self._spread(np.exp(1j * self.draw.uniform(-np.pi, np.pi, RUNS // 2))))

    def _spread(self, drawn: ComplexField) -> ComplexField:
        """One number for two runs, which have it with opposite signs."""
        return np.repeat(UNITS * ROUNDING * np.concatenate((drawn, -drawn)), self.samples)


@record
class DisturbedBody(BodyMotion):
    """A body whose points are disturbed one by one, by their distances and by `floor` [m]."""

    noise: Noise
    floor: float

    def carry(self, local: complex, further: complex = 0j) -> PointMotion:
        """Motion of the point `further` from `local` [m] in the body's frame, disturbed."""
        arm, anchor = self.direction * ((local - self.at) + further), self.anchor
        exact = BodyMotion.reach(self, arm)
        reach, turn = np.abs(arm), np.abs(self.omega)
        sizes = (
            np.maximum(np.abs(anchor.position) + reach, self.floor),
            np.abs(anchor.velocity) + turn * reach,
            np.abs(anchor.acceleration) + (np.abs(self.alpha) + turn * turn) * reach,
        )
        values = (exact.position, exact.velocity, exact.acceleration)
        disturbed: Sequence[ComplexField] = [
            value + size * self.noise.vector() for value, size in zip(values, sizes, strict=True)
        ]
        return PointMotion(*disturbed)


def disturbed_solutions(
    plan: Plan, drives: Mapping[str, InputMotion], start: Mapping[str, BodyMotion], samples: int
) -> list[GroupSolution]:
    """The solutions of the plan's steps in all disturbed runs.

    drives, start  as for `solve`, RUNS times the same samples, one run after the other
    """
    noise = Noise(np.random.default_rng(0), samples)
    known: dict[str, BodyMotion] = {GROUND: local_ground(plan.mechanism), **start}
    disturbed_solutions = []
    for step in plan.steps:
        shaken = known | {body: _disturbed(known[body], noise, step.size) for body in step.parents}
        if isinstance(step, GeneralGroup):
            solved = step.disturbed(known, drives, _residuals(step, known, noise))
        else:
            solved = step.solve(shaken, drives)
        known.update(step.locate(shaken, solved.columns))
        disturbed_solutions.append(solved)
    return disturbed_solutions


def _disturbed(body: BodyMotion, noise: Noise, floor: float) -> DisturbedBody:
    """The body with a disturbed direction and rotation."""
    direction = body.direction * (1 + 1j * (noise.factor() - 1))
    omega, alpha = body.omega * noise.factor(), body.alpha * noise.factor()
    return DisturbedBody(body.anchor, body.at, direction, omega, alpha, noise, floor)


def _residuals(step: GeneralGroup, known: Mapping[str, BodyMotion], noise: Noise) -> FloatArray:
    """A disturbance of each loop equation [m], by the distances of the bodies."""
    away = sum(np.abs(known[body].carry(step.anchors[body]).position) for body in step.parents)
    signs = [noise.factor() - 1 for _ in range(3 * len(step.bodies))]
    return np.stack([(step.scale + away) * sign for sign in signs], axis=-1)
