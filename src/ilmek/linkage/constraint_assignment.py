"""Assignment of a mechanism's constraints to the degrees of freedom of its bodies.

A joint removes two degrees of freedom, an input or a coupling one, each of some moving body that it concerns; a body
has three. If every constraint can be assigned, no set of bodies is over-constrained [Hall's theorem; Jacobs, Thorpe:
Generic rigidity percolation: the pebble game, Physical Review Letters 75 (1995)].
"""

from collections import deque
from typing import NamedTuple, TypeAlias

from ilmek.linkage.model import GROUND, Mechanism

Constraint: TypeAlias = frozenset[str]
"""The moving bodies that a constraint concerns."""

Constraints: TypeAlias = dict[str, list[Constraint]]
"""Body -> at most three constraints that are assigned to it."""


class Assignment(NamedTuple):
    """Constraints by body, and bodies that are over-constrained together; empty if every constraint is assigned."""

    constraints: Constraints
    excess: frozenset[str] = frozenset()


def assigned_constraints(mechanism: Mechanism) -> Assignment:
    """The assignment of all constraints, or of those before the first that cannot be assigned."""
    assigned: Constraints = {body: [] for body in mechanism.moving}
    for constraint in _constraints(mechanism):
        full = _assign(constraint, assigned)
        if full:
            return Assignment(assigned, full)
    return Assignment(assigned)


def _constraints(mechanism: Mechanism) -> list[Constraint]:
    joints = {joint.name: joint for joint in mechanism.joints}
    held: list[tuple[str, ...]] = [joint.bodies for joint in mechanism.joints for _ in range(2)]
    held += [joints[entry.joint].bodies for entry in mechanism.inputs]
    held += [coupling.bodies for coupling in mechanism.couplings]
    return [found for found in (frozenset(bodies) - {GROUND} for bodies in held) if found]


def _assign(new: Constraint, assigned: Constraints) -> frozenset[str]:
    """Assign a constraint, moving others on to a body that has room; the bodies searched if none of them has any."""
    came: dict[str, tuple[str, Constraint] | None] = dict.fromkeys(new)
    queue = deque(new)
    while queue:
        body = queue.popleft()
        if len(assigned[body]) < 3:
            while (step := came[body]) is not None:
                before, constraint = step
                assigned[before].remove(constraint)
                assigned[body].append(constraint)
                body = before
            assigned[body].append(new)
            return frozenset()
        for constraint in assigned[body]:
            for other in constraint:
                if other not in came:
                    came[other] = (body, constraint)
                    queue.append(other)
    return frozenset(came)
