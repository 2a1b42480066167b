"""All configurations of a mechanism with one free input: a curve, smooth also where the input reverses.

    F(x, q) = 0        A t = [F_x  F_q] t = 0        t: the unit tangent, in lengths (angles times the size)

The curve has no dead centres along its length: at those of the input the component of t along q is zero. Where A loses
rank two curves cross, and the mechanism may continue on either [Allgower, Georg: Numerical Continuation Methods,
chapters 2 and 8].
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import Complex, Float, FloatArray
from ilmek.linkage.body_motion import STILL, BodyMotion, PointMotion
from ilmek.linkage.displacements import moving
from ilmek.linkage.equations import Equation
from ilmek.linkage.groups.group import InputMotion
from ilmek.linkage.loops import Loops, loops
from ilmek.linkage.model import GROUND, Mechanism, Rotation
from ilmek.num.linear import solve_many
from ilmek.records import record

CORRECTIONS = 12
"""Maximum of Newton steps back to the curve; three suffice for a step of a few hundredths of the size."""

LAST = 1e-9
"""Last correction relative to the mechanism's size; by quadratic convergence the error is at rounding."""


@record
class Configurations:
    """Configurations, one per row: origins [m] and unit directions of the moving bodies, free input [rad or m]."""

    origins: Complex[np.ndarray, "rows bodies"]
    directions: Complex[np.ndarray, "rows bodies"]
    inputs: Float[np.ndarray, " rows"]

    def __len__(self) -> int:
        return len(self.inputs)

    def __getitem__(self, rows: "slice | np.ndarray") -> "Configurations":
        return Configurations(self.origins[rows], self.directions[rows], self.inputs[rows])


@record
class FreeInput:
    """A mechanism with one free input; a step is a row of 3 numbers per body, then the input.

    name  the free input      locked  the values [rad, m] of the others
    """

    mechanism: Mechanism
    name: str
    locked: Mapping[str, float]
    loops: Loops

    @property
    def turns(self) -> bool:
        """Whether the free input is an angle."""
        return any(isinstance(entry, Rotation) and entry.name == self.name for entry in self.mechanism.inputs)

    @property
    def size(self) -> float:
        """The mechanism's size [m]."""
        return self.loops.scale

    @property
    def per_input(self) -> float:
        """Factor from the input to a length."""
        return self.size if self.turns else 1.0

    def bodies(self, at: Configurations) -> dict[str, BodyMotion]:
        """Every body at rest, anchored at its origin."""
        bodies = {
            name: BodyMotion(PointMotion(at.origins[:, k], 0j, 0j), 0j, at.directions[:, k], 0.0, 0.0)
            for k, name in enumerate(self.mechanism.moving)
        }
        return {GROUND: STILL, **bodies}

    def stepped(self, at: Configurations, step: FloatArray) -> Configurations:
        """The configurations one step away, off the curve until corrected."""
        shift, turn = step[:, 0:-1:3] + 1j * step[:, 1:-1:3], step[:, 2:-1:3] / self.size
        inputs = at.inputs + step[:, -1] / self.per_input
        return Configurations(at.origins + shift, at.directions * np.exp(1j * turn), inputs)

    def between(self, first: Configurations, second: Configurations) -> FloatArray:
        """The step from the first to the second, with 0 for the input."""
        shift = second.origins - first.origins
        turn = np.angle(second.directions * np.conj(first.directions)) * self.size
        step = np.stack([shift.real, shift.imag, turn], axis=-1).reshape(len(first), 3 * first.origins.shape[1])
        return np.concatenate([step, np.zeros((len(first), 1))], axis=1)

    def chords(self, at: Configurations) -> FloatArray:
        """The steps from each configuration to the next, with that of the input."""
        steps = self.between(at[:-1], at[1:])
        steps[:, -1] = np.diff(at.inputs) * self.per_input
        return steps

    def slope(self, at: Configurations) -> tuple[FloatArray, FloatArray]:
        """A = [F_x F_q] and F, row by row."""
        equations = self.equations(at)
        rows = (len(at),)
        by_input = np.zeros((*rows, len(equations), 1))
        by_input[:, self._driven, 0] = -self.loops.unit(equations[self._driven]) / self.per_input
        matrix = np.concatenate([self.loops.matrix(equations, rows), by_input], axis=-1)
        return matrix, self.loops.column(equations, [equation.value for equation in equations], rows)

    def tangents(self, at: Configurations, along: FloatArray) -> FloatArray:
        """Unit tangents with a positive component along `along`; NaN for NaN configurations."""
        return self.oriented(at, along)[0]

    def oriented(self, at: Configurations, along: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Unit tangents t, and the sign of det [A; t]: it changes at crossings of curves only."""
        matrix = self.slope(at)[0]
        usable = np.isfinite(matrix).all(axis=(1, 2)) & np.isfinite(at.inputs)
        matrix = np.where(usable[:, None, None], matrix, 0.0)
        t: FloatArray = np.linalg.svd(matrix)[2][:, -1, :]
        t = t * np.where(usable, np.where(np.sum(t * along, axis=1) < 0, -1.0, 1.0), np.nan)[:, None]
        return t, np.linalg.slogdet(np.concatenate([matrix, np.nan_to_num(t)[:, None, :]], axis=1))[0]

    def corrected(self, at: Configurations, across: FloatArray) -> Configurations:
        """Corrected to the curve, normal to the directions `across`; NaN where Newton's method does not converge."""
        last = np.full(len(at), np.inf)
        for _ in range(CORRECTIONS):
            matrix, value = self.slope(at)
            square = np.concatenate([matrix, across[:, None, :]], axis=1)
            step = solve_many(square, np.concatenate([-value, np.zeros((len(at), 1))], axis=1))
            at, last = self.stepped(at, step), np.max(np.abs(step), axis=1)
            if not (last > LAST * self.size).any():
                break
        at.inputs[~(last <= LAST * self.size)] = np.nan
        return at

    def moving(self, at: Configurations, tangents: FloatArray, across: FloatArray) -> dict[str, BodyMotion]:
        """Every body with first and second rates by the coordinate along the directions `across`."""
        still = self.bodies(at)
        first = tangents / np.sum(tangents * across, axis=1)[:, None]
        rates = self.loops.moves(first[:, :-1])
        bias = self.loops.column(
            equations := self.equations(at, first), [equation.bias for equation in equations], (len(at),)
        )
        square = np.concatenate([self.slope(at)[0], across[:, None, :]], axis=1)
        seconds = self.loops.moves(solve_many(square, np.concatenate([-bias, np.zeros((len(at), 1))], axis=1))[:, :-1])
        moved = {}
        for name, body in moving(still, rates).items():
            gain, alpha = seconds.get(name, (0j, 0.0))
            anchor = PointMotion(body.anchor.position, body.anchor.velocity, gain)
            moved[name] = BodyMotion(anchor, 0j, body.direction, body.omega, alpha)
        return moved

    @property
    def _driven(self) -> int:
        """Index of the free input's equation."""
        names = [entry.name for entry in self.mechanism.inputs]
        return names.index(self.name) - len(names) + len(self.loops.joints)

    def equations(self, at: Configurations, tangents: FloatArray | None = None) -> list[Equation]:
        """All loop equations of the configurations, at rest or moving along the tangents."""
        drives = {name: InputMotion(value, 0.0, 0.0) for name, value in self.locked.items()}
        drives[self.name] = InputMotion(at.inputs, 0.0, 0.0)
        bodies = self.bodies(at)
        if tangents is not None:
            bodies = moving(bodies, self.loops.moves(tangents[:, :-1]))
        return self.loops.equations(lambda _: bodies, drives)


def free_input(mechanism: Mechanism, name: str, locked: Mapping[str, float]) -> FreeInput:
    """The mechanism with one free input of that name, the others locked at values [rad, m]."""
    return FreeInput(mechanism, name, locked, loops(mechanism))
