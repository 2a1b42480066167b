"""Displacements and rates of the bodies of a mechanism, and their effect on loop equations [source: `equations`]."""

from collections.abc import Mapping
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexField, RealField
from ilmek.linkage.body_motion import BodyMotion, PointMotion
from ilmek.linkage.equations import Row
from ilmek.linkage.groups.group import Known

Moves: TypeAlias = Mapping[str, tuple[ComplexField, RealField]]
"""Body -> shift of its origin [m] and turn [rad], or their rates; default of a body: zero."""


def contracted(row: Row, moves: Moves) -> RealField:
    """Change or rate of an equation, sum of J_x dx + J_y dy + J_theta dtheta over the bodies [m, rad; m/s, rad/s].

    >>> contracted({"crank": (1, 0, 0.5)}, {"crank": (2 + 3j, 4.0)})
    4.0
    """
    total: RealField = 0.0
    for body, (dx, dy, dtheta) in row.items():
        shift, turn = moves.get(body, (0j, 0.0))
        total = total + dx * shift.real + dy * shift.imag + dtheta * turn
    return total


def added(first: Moves, second: Moves) -> Moves:
    """Sum of two displacements: of the shifts [m] and of the turns [rad], body by body."""
    both = dict(first)
    for body, (shift, turn) in second.items():
        other = first.get(body, (0j, 0.0))
        both[body] = other[0] + shift, other[1] + turn
    return both


def times(moves: Moves, factor: RealField) -> Moves:
    """Every shift [m] and turn [rad] multiplied by a factor [1]."""
    return {body: (shift * factor, turn * factor) for body, (shift, turn) in moves.items()}


def largest(moves: Moves, scale: float) -> RealField:
    """The largest shift [m], or turn times `scale` [m], of any body."""
    size: RealField = 0.0
    for shift, turn in moves.values():
        size = np.maximum(size, np.maximum(np.abs(shift), scale * np.abs(turn)))
    return size


def at_origins(bodies: Known) -> dict[str, BodyMotion]:
    """The same motions, each anchored at the origin of its body's frame, as loop equations require."""
    return {
        name: BodyMotion(body.carry(0j), 0j, body.direction, body.omega, body.alpha) for name, body in bodies.items()
    }


def moving(bodies: Known, rates: Moves) -> dict[str, BodyMotion]:
    """The bodies, anchored at their origins, in their poses at given rates, without acceleration."""
    moved = {}
    for name, body in bodies.items():
        velocity, omega = rates.get(name, (0j, 0.0))
        moved[name] = BodyMotion(PointMotion(body.anchor.position, velocity, 0j), 0j, body.direction, omega, 0.0)
    return moved
