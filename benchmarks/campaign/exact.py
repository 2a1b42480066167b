"""The truth to measure a linkage's motion by: Newton's method on its loop equations, in extended precision.

Written without the engine: joints give two equations each, linearised about the present poses; unknown are the poses
x, y, theta of the last two bodies, known those of the cranks. Where a long double is no longer than a double (not on
x86), the truth is no better than what it measures.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.campaign.random_linkages import Family
from ilmek.linkage.model import GROUND, Pin

Reals = NDArray[Any]
Points = NDArray[Any]
CRANKS = {"left": "O", "right": "Q"}
STEPS = 4


@dataclass
class Body:
    """A body's pose and rates, one value a variant: origin, angle and their first two rates."""

    origin: Points
    angle: Reals
    velocity: Points
    omega: Reals
    acceleration: Points
    alpha: Reals

    @property
    def direction(self) -> Points:
        direction: Points = np.cos(self.angle) + 1j * np.sin(self.angle)
        return direction


@dataclass
class Equations:
    """Of all joints' equations: values, derivatives by (x, y, theta) of each body, second rates at no acceleration."""

    value: list[Reals]
    slopes: dict[str, list[tuple[Any, Any, Any]]]
    bias: list[Reals]

    def matrix(self, bodies: tuple[str, ...]) -> Reals:
        """Derivatives by those bodies, (variants, equations, 3 a body)."""
        shape = self.value[0].shape
        columns = [
            np.stack([np.broadcast_to(row[j], shape) for row in self.slopes[body]], axis=-1)
            for body in bodies
            for j in range(3)
        ]
        return np.stack(columns, axis=-1)


def truth(
    family: Family, start: Mapping[str, tuple[Points, Reals]], courses: Mapping[str, Sequence[Reals]]
) -> dict[str, Body]:
    """All bodies of all variants, each at one sample of its own.

    start    body -> origin and angle near the answer       courses  crank -> angle, speed, acceleration
    """
    bodies, new = _cranks(family, courses), tuple(start)
    for body, (origin, angle) in start.items():
        at, turned = origin.astype(np.clongdouble), angle.astype(np.longdouble)
        bodies[body] = Body(at, turned, 0 * at, 0 * turned, 0 * at, 0 * turned)
    for _ in range(STEPS):
        held = _equations(family, bodies)
        step = eliminate(held.matrix(new), np.stack(held.value, axis=-1))
        for k, body in enumerate(new):
            shift, turned = _part(step, k)
            bodies[body].origin, bodies[body].angle = bodies[body].origin - shift, bodies[body].angle - turned
    held = _equations(family, bodies)
    rates = eliminate(held.matrix(new), -_known(held, bodies, "velocity", "omega"))
    for k, body in enumerate(new):
        bodies[body].velocity, bodies[body].omega = _part(rates, k)
    held = _equations(family, bodies)
    rates = eliminate(held.matrix(new), -_known(held, bodies, "acceleration", "alpha") - np.stack(held.bias, axis=-1))
    for k, body in enumerate(new):
        bodies[body].acceleration, bodies[body].alpha = _part(rates, k)
    return bodies


def _cranks(family: Family, courses: Mapping[str, Sequence[Reals]]) -> dict[str, Body]:
    """The cranks, whose motion is given."""
    bodies = {}
    for crank, pin in CRANKS.items():
        angle, omega, alpha = (one.astype(np.longdouble) for one in courses[crank])
        arm = -(np.cos(angle) + 1j * np.sin(angle)) * family.places[crank, pin]
        origin = family.places[GROUND, pin] + arm
        bodies[crank] = Body(origin, angle, 1j * omega * arm, omega, (1j * alpha - omega * omega) * arm, alpha)
    return bodies


def _equations(family: Family, bodies: Mapping[str, Body]) -> Equations:
    """Two for each joint of the group: along two directions that its guide (or the ground) carries."""
    held = Equations([], {body: [] for body in bodies}, [])
    for joint in family.plan.mechanism.joints:
        if joint.name in CRANKS.values():
            continue
        p, q = (bodies[body] for body in joint.bodies)
        r, s = (bodies[body].direction * family.places[body, joint.name] for body in joint.bodies)
        apart, pull = p.origin + r - q.origin - s, q.omega * q.omega * s - p.omega * p.omega * r
        if isinstance(joint, Pin):
            across = 1 + 0 * r
            for along in (across, 1j * across):
                _add(held, joint.bodies, along, (apart, pull), (r, s))
            continue
        along = 1j * q.direction * np.exp(1j * np.longdouble(joint.along))
        parting = p.velocity + 1j * p.omega * r - q.velocity - 1j * q.omega * s
        seen = pull - 2j * q.omega * parting - q.omega * q.omega * apart
        _add(held, joint.bodies, along, (apart, seen), (r, s + apart))
        turned = np.angle(p.direction * np.conj(q.direction * np.exp(1j * np.longdouble(joint.turned))))
        _add_row(held, joint.bodies, turned, ((0, 0, 1), (0, 0, -1)), 0 * turned)
    return held


def _add(held: Equations, bodies: tuple[str, str], along: Points, apart: tuple[Points, Points], arms: Any) -> None:
    """The equation that two points are not apart along a direction, and its second rate; their arms on their bodies."""
    slopes = [
        (sign * along.real, sign * along.imag, sign * _dot(along, 1j * arm))
        for sign, arm in zip((1, -1), arms, strict=True)
    ]
    _add_row(held, bodies, _dot(along, apart[0]), (slopes[0], slopes[1]), _dot(along, apart[1]))


def _dot(u: Points, v: Points) -> Reals:
    dot: Reals = (np.conj(u) * v).real
    return dot


def _add_row(held: Equations, bodies: tuple[str, str], value: Any, slopes: tuple[Any, Any], bias: Any) -> None:
    held.value.append(value)
    held.bias.append(bias)
    for body, rows in held.slopes.items():
        rows.append(slopes[bodies.index(body)] if body in bodies else (0, 0, 0))


def _known(held: Equations, bodies: Mapping[str, Body], move: str, spin: str) -> Reals:
    """The cranks' share of the equations' rates."""
    moves = [getattr(bodies[crank], move) for crank in CRANKS]
    spins = [getattr(bodies[crank], spin) for crank in CRANKS]
    rates = [part for v, w in zip(moves, spins, strict=True) for part in (v.real, v.imag, w)]
    share: Reals = (held.matrix(tuple(CRANKS)) * np.stack(rates, axis=-1)[:, None, :]).sum(axis=-1)
    return share


def _part(found: Reals, k: int) -> tuple[Points, Reals]:
    """A body's share of the unknowns: (x + i y, theta)."""
    return found[:, 3 * k] + 1j * found[:, 3 * k + 1], found[:, 3 * k + 2]


def eliminate(matrix: Reals, right: Reals) -> Reals:
    """Solution of many small systems in any precision: Gauss with partial pivoting."""
    work = np.concatenate([matrix, right[..., None]], axis=-1)
    count, size = right.shape
    each = np.arange(count)
    for k in range(size):
        best = k + np.abs(work[:, k:, k]).argmax(axis=1)
        work[each, k], work[each, best] = work[each, best].copy(), work[each, k].copy()
        work[:, k] /= work[:, k, k, None]
        for row in range(size):
            if row != k:
                work[:, row] -= work[:, row, k, None] * work[:, k]
    return work[..., -1]
