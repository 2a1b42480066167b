"""Dead centres by an independent calculation: the pins of a mechanism by their distances, in extended precision.

Unknown are the positions p of all moving pins; the crank pin A(q) moves on its circle. Pins of one body keep their
distance, a slider's pin keeps to its line. All equations F(p, q) = 0 are quadratic in p. At a dead centre the matrix
F_p is singular:

    F(p, q) = 0,    F_p v = 0,    |v|^2 = 1        [Moore, Spence: The calculation of turning points, 1980]

Written without the engine's equations. Where a long double is no longer than a double (not on x86), the truth is no
better than what it measures.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ilmek.linkage.model import GROUND, Mechanism, Slide

Reals = NDArray[Any]
LONG = np.longdouble


@dataclass(frozen=True)
class Distances:
    """A mechanism with one crank on the ground, drawn in place, as pins and distances.

    free  names of the unknown pins                 fixed  pins of the ground
    crank  its pin on the ground, its moving pins' complex arms from it at the input 0
    pairs  pins with their squared distance         lines  pin, normal and offset of its line
    """

    free: tuple[str, ...]
    fixed: Mapping[str, complex]
    pivot: complex
    arms: Mapping[str, complex]
    pairs: tuple[tuple[str, str, Any], ...]
    lines: tuple[tuple[str, complex, float], ...]

    def equations(self, p: Reals, q: Any) -> tuple[Reals, Reals, Reals]:
        """F, F_p and F_q at pins p (2 per pin) and the input q [rad]."""
        rows = len(self.pairs) + len(self.lines)
        value, slope, by_input = np.zeros(rows, LONG), np.zeros((rows, len(p)), LONG), np.zeros(rows, LONG)
        for k, (one, other, squared) in enumerate(self.pairs):
            (a, rate), (b, other_rate) = self.pin(one, p, q), self.pin(other, p, q)
            apart, speed = a - b, rate - other_rate
            value[k] = apart @ apart - squared
            by_input[k] = 2 * apart @ speed
            for name, sign in ((one, 1), (other, -1)):
                if name in self.free:
                    at = 2 * self.free.index(name)
                    slope[k, at : at + 2] += 2 * sign * apart
        for k, (name, normal, offset) in enumerate(self.lines, start=len(self.pairs)):
            at = 2 * self.free.index(name)
            across = np.array([normal.real, normal.imag], LONG)
            value[k], slope[k, at : at + 2] = p[at : at + 2] @ across - LONG(offset), across
        return value, slope, by_input

    def pin(self, name: str, p: Reals, q: Any) -> tuple[Reals, Reals]:
        """A pin's position, and its derivative by the input where it belongs to the crank."""
        if name in self.free:
            at = 2 * self.free.index(name)
            return p[at : at + 2], np.zeros(2, LONG)
        if name in self.arms:
            x, y, c, s = LONG(self.arms[name].real), LONG(self.arms[name].imag), np.cos(LONG(q)), np.sin(LONG(q))
            arm = np.array([c * x - s * y, s * x + c * y], LONG)
            return arm + np.array([self.pivot.real, self.pivot.imag], LONG), np.array([-arm[1], arm[0]], LONG)
        return np.array([self.fixed[name].real, self.fixed[name].imag], LONG), np.zeros(2, LONG)

    def dead_centre(self, p: Reals, q: float) -> float:
        """The input [rad] at the dead centre next to pins p at the input q."""
        p, q_now = np.array(p, LONG), LONG(q)
        v = np.array(np.linalg.svd(self.equations(p, q_now)[1].astype(float))[2][-1], LONG)
        size = len(p)
        for _ in range(30):
            value, slope, by_input = self.equations(p, q_now)
            right = np.concatenate([value, slope @ v, [v @ v - 1]])
            matrix = np.zeros((2 * size + 1, 2 * size + 1), LONG)
            matrix[:size, :size], matrix[:size, -1] = slope, by_input
            matrix[size:-1, :size], matrix[size:-1, -1] = self._second(v, q_now)
            matrix[size:-1, size:-1], matrix[-1, size:-1] = slope, 2 * v
            step = _solved(matrix, right)
            p, v, q_now = p - step[:size], v - step[size:-1], q_now - step[-1]
            if np.max(np.abs(step)) < 1e-16:
                break
        return float(q_now)

    def _second(self, v: Reals, q: Any) -> tuple[Reals, Reals]:
        """Derivatives of F_p v by p and by the input: F_p is linear in all pins."""
        zero, size = LONG(0), len(v)
        still = self.equations(np.zeros(size, LONG), zero)[1]
        columns = [(self.equations(unit, zero)[1] - still) @ v for unit in np.eye(size, dtype=LONG)]
        by_input = np.zeros(size, LONG)
        for k, (one, other, _) in enumerate(self.pairs):
            speed = self.pin(one, v, q)[1] - self.pin(other, v, q)[1]
            for name, sign in ((one, 1), (other, -1)):
                if name in self.free:
                    at = 2 * self.free.index(name)
                    by_input[k] += 2 * sign * speed @ v[at : at + 2]
        return np.stack(columns, axis=1), by_input

    def followed(self, p: Reals, q: float, step: float, most: float) -> float:
        """The last input before the first dead centre from pins p on, by steps of the input; `most` if there is none.

        A step that fails, or over which det F_p changes its sign, is divided by 8.
        """
        p, least = np.array(p, float), abs(step) * 8.0**-6
        side = self._side(p, q)
        while abs(q + step) <= abs(most):
            new = self._next(p, q, step)
            if self._side(new, q + step) == side:
                p, q = new, q + step
            elif abs(step) < least:
                return q
            else:
                step /= 8
        return most

    def _side(self, p: Reals, q: float) -> float:
        """Sign of det F_p; NaN for NaN."""
        return float(np.sign(np.linalg.det(self.equations(p, q)[1].astype(float)))) if np.isfinite(p).all() else np.nan

    def _next(self, p: Reals, q: float, step: float) -> Reals:
        """The pins after a step of the input; NaN where Newton's method does not converge."""
        _, slope, by_input = (part.astype(float) for part in self.equations(p, q))
        new = p - np.linalg.solve(slope, by_input) * step
        for _ in range(6):
            value, slope, _ = (part.astype(float) for part in self.equations(new, q + step))
            move = np.linalg.solve(slope, value)
            new = new - move
            if np.max(np.abs(move)) < 1e-10:
                return new
        return np.full_like(new, np.nan)


def distances(mechanism: Mechanism) -> Distances:
    """The pins of a mechanism drawn in place (each frame coincides with the world) with one crank on the ground."""
    (entry,) = mechanism.inputs
    crank = mechanism.body(entry.name).points
    slides = {joint.body: joint for joint in mechanism.joints if isinstance(joint, Slide)}
    pins = {joint.name for joint in mechanism.joints if not isinstance(joint, Slide)}
    fixed = {name: at for name, at in mechanism.body(GROUND).points.items() if name in pins}
    pivot = fixed[entry.joint]
    arms = {name: at - pivot for name, at in crank.items() if name in pins and name != entry.joint}
    free: list[str] = []
    pairs, lines = [], []
    for body in mechanism.bodies:
        points = {name: at for name, at in body.points.items() if name in pins}
        free += [name for name in points if name not in {*fixed, *arms, *free}]
        if body.name in slides:
            slide = slides[body.name]
            normal = 1j * np.exp(1j * slide.along)
            (name,) = points
            lines.append((name, normal, float((np.conj(normal) * points[name]).real)))
        elif body.name not in {GROUND, entry.name}:
            first = list(points)[:2]
            for one, other in combinations(points, 2):
                if one not in first:
                    continue
                apart = points[one] - points[other]
                pairs.append((one, other, LONG(apart.real) ** 2 + LONG(apart.imag) ** 2))
    return Distances(tuple(free), fixed, pivot, arms, tuple(pairs), tuple(lines))


def _solved(matrix: Reals, right: Reals) -> Reals:
    """Gauss's elimination with column pivots, in the precision of its arguments."""
    rows = np.concatenate([matrix, right[:, None]], axis=1)
    size = len(right)
    for k in range(size):
        pivot = k + int(np.argmax(np.abs(rows[k:, k])))
        rows[[k, pivot]] = rows[[pivot, k]]
        rows[k + 1 :] -= np.outer(rows[k + 1 :, k] / rows[k, k], rows[k])
    found = np.zeros(size, rows.dtype)
    for k in reversed(range(size)):
        found[k] = (rows[k, -1] - rows[k, k + 1 : size] @ found[k + 1 :]) / rows[k, k]
    return found
