"""Machines as bodies with constraints: a calculation of motions and forces that shares no code with the engine.

Bodies have absolute coordinates (x, y, angle). Their joints are constraints Phi(q, t) = 0, solved by Newton's method;
velocities and accelerations are those of the differentiated constraints, forces the Lagrange multipliers of
M q'' = Q + Phi_q^T lambda [Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, chapters 3 and 6].
"""

import cmath
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

Force = tuple[str, complex, complex]
"""Body, point in its frame, force [N]; with the point TORQUE, the force is a torque [N m]."""

TORQUE = complex("inf")


@dataclass
class Part:
    """A body: mass [kg], centre in its frame [m], moment about the centre [kg m²]."""

    mass: float = 0.0
    centre: complex = 0j
    moment: float = 0.0

    def __add__(self, other: "Part") -> "Part":
        mass = self.mass + other.mass
        centre = (self.mass * self.centre + other.mass * other.centre) / mass
        about = [one.moment + one.mass * abs(one.centre - centre) ** 2 for one in (self, other)]
        return Part(mass, centre, sum(about))


@dataclass
class Case:
    """A machine: pins (name, body, point, body, point), slides (name, body, point, guide, point, direction), loads.

    `guess` is the position of each body [m, rad] at the first sample: the branch of the file, read from a sketch.
    """

    parts: Mapping[str, Part]
    pins: Sequence[tuple[str, str, complex, str, complex]]
    guess: Mapping[str, tuple[complex, float]]
    slides: Sequence[tuple[str, str, complex, str, complex, float]] = ()
    gear: tuple[str, str, float, float, float] | None = None
    """First and second wheel, ratio, angle of the second where the first is at 0, distance of their centres."""
    gravity: complex = -9.81j
    loads: Callable[["Case", np.ndarray, np.ndarray], Sequence[Force]] = lambda *_: ()
    names: list[str] = field(init=False)

    def __post_init__(self) -> None:
        self.names = list(self.parts)

    def spot(self, q: np.ndarray, body: str, point: complex) -> tuple[complex, complex, int]:
        """Position of a point, its arm from the body's origin, index of the body (-1: the ground)."""
        if body == "ground":
            return point, 0j, -1
        k = 3 * self.names.index(body)
        arm = point * cmath.exp(1j * q[k + 2])
        return complex(q[k], q[k + 1]) + arm, arm, k

    def rate(self, q: np.ndarray, v: np.ndarray, body: str, point: complex) -> complex:
        _, arm, k = self.spot(q, body, point)
        return 0j if k < 0 else complex(v[k], v[k + 1]) + 1j * v[k + 2] * arm

    def angle(self, q: np.ndarray, body: str) -> float:
        return 0.0 if body == "ground" else q[3 * self.names.index(body) + 2]

    def constraints(self, q: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Phi of all joints, its Jacobian, and minus the part of its second derivative that has no acceleration."""
        values: list[float] = []
        rows: list[np.ndarray] = []
        rest: list[float] = []
        blank = np.zeros(len(q))
        for _, first, p, second, s in self.pins:
            row, total, bend = np.zeros((2, len(q))), 0j, 0j
            for body, point, sign in ((second, s, 1), (first, p, -1)):
                at, arm, k = self.spot(q, body, point)
                total += sign * at
                if k >= 0:
                    row[0, k], row[1, k + 1] = sign, sign
                    row[:, k + 2] += sign * np.array([-arm.imag, arm.real])
                    bend += sign * arm * v[k + 2] ** 2
            values += [total.real, total.imag]
            rows += list(row)
            rest += [bend.real, bend.imag]
        for _, body, p, guide, g, direction in self.slides:
            at, arm, k = self.spot(q, body, p)
            base, lever, j = self.spot(q, guide, g)
            normal = 1j * cmath.exp(1j * (direction + self.angle(q, guide)))
            turn = 0.0 if j < 0 else v[j + 2]
            away = self.rate(q, v, body, p) - self.rate(q, v, guide, g)
            row, level = blank.copy(), blank.copy()
            row[[k, k + 1, k + 2]] = normal.real, normal.imag, dot(normal, 1j * arm)
            level[k + 2] = 1
            if j >= 0:
                row[[j, j + 1]] -= normal.real, normal.imag
                row[j + 2] += dot(1j * normal, at - base) - dot(normal, 1j * lever)
                level[j + 2] = -1
            bent = arm * v[k + 2] ** 2 - lever * turn**2
            values += [dot(normal, at - base), self.angle(q, body) - self.angle(q, guide)]
            rows += [row, level]
            rest += [dot(normal, bent + (at - base) * turn**2) - 2 * turn * dot(1j * normal, away), 0.0]
        if self.gear:
            first, second, ratio, start, *_ = self.gear
            row = blank.copy()
            row[3 * self.names.index(second) + 2], row[3 * self.names.index(first) + 2] = 1, -ratio
            values.append(self.angle(q, second) - start - ratio * self.angle(q, first))
            rows.append(row)
            rest.append(0.0)
        drive = blank.copy()
        drive[2] = 1
        return np.array([*values, q[2]]), np.array([*rows, drive]), np.array([*rest, 0.0])

    def located(self, q: np.ndarray, input_: float) -> np.ndarray:
        for _ in range(60):
            value, matrix, _ = self.constraints(q, np.zeros_like(q))
            value[-1] -= input_
            step = np.linalg.solve(matrix, value)
            q = q - step * min(1.0, 0.3 / max(np.abs(step).max(), 0.1))
            if np.abs(step).max() < 1e-15:
                break
        return q

    def moved(self, q: np.ndarray, speed: float, acceleration: float) -> tuple[np.ndarray, np.ndarray]:
        _, matrix, _ = self.constraints(q, np.zeros_like(q))
        last = np.eye(len(q))[-1]
        v = np.linalg.solve(matrix, speed * last)
        rest = self.constraints(q, v)[2]
        return v, np.linalg.solve(matrix, rest + acceleration * last)

    def applied(self, q: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Generalised forces of the loads."""
        total = np.zeros(len(q))
        for body, point, force in self.loads(self, q, v):
            if body == "ground":
                continue
            k = 3 * self.names.index(body)
            if point == TORQUE:
                total[k + 2] += force.real
                continue
            arm = self.spot(q, body, point)[1]
            total[k : k + 3] += force.real, force.imag, dot(1j * arm, force)
        return total

    def solved(self, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> np.ndarray:
        """The multipliers: forces of the joints in their order, the torque of the drive last."""
        sought = -self.applied(q, v)
        for k, part in enumerate(self.parts.values()):
            arm = part.centre * cmath.exp(1j * q[3 * k + 2])
            w, alpha = v[3 * k + 2], a[3 * k + 2]
            force = part.mass * (complex(a[3 * k], a[3 * k + 1]) + (1j * alpha - w**2) * arm - self.gravity)
            sought[3 * k : 3 * k + 3] += force.real, force.imag, part.moment * alpha + dot(1j * arm, force)
        return np.linalg.solve(self.constraints(q, v)[1].T, sought)


def dot(a: complex, b: complex) -> float:
    return (a.conjugate() * b).real
