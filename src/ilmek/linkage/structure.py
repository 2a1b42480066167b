"""The order in which a mechanism can be solved: known bodies grow outward from the ground and the inputs.

Assur's principle: a mechanism with its inputs held falls apart into groups of bodies that have no freedom of their own
once what they hang on is known. `plan` always takes the smallest such group next; a group that one of the closed forms
recognises is solved by it, any other by Newton's method on the same loop equations.

>>> from ilmek.linkage.fourbar import four_bar
>>> for step in plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1)).steps:
...     print(step.words)
crank turned by the input on ground
coupler and rocker joined at B (branch +1), hung on crank and ground: RRR
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import combinations

from ilmek.errors import MechanismError
from ilmek.linkage.groups import block, prp, rpp, rpr, rrp, rrr, shift, turn
from ilmek.linkage.groups.group import Group, Step
from ilmek.linkage.model import GROUND, Mechanism

CLOSED_FORMS: tuple[Callable[[Group], Step | None], ...] = (
    turn.recognise,
    shift.recognise,
    rrr.recognise,
    rrp.recognise,
    rpr.recognise,
    prp.recognise,
    rpp.recognise,
)
"""The groups solved in closed form; a further one is one more row."""


@dataclass(frozen=True, slots=True)
class Plan:
    """A mechanism and the steps that solve it, in order."""

    mechanism: Mechanism
    steps: tuple[Step, ...]

    def step_of(self, body: str) -> Step:
        """The step that solves a body."""
        return next(step for step in self.steps if body in step.bodies)


def plan(mechanism: Mechanism, *, closed_forms: bool = True) -> Plan:
    """The steps that solve `mechanism`; with `closed_forms=False` all groups are left to Newton's method.

    Raises MechanismError where a part is over-constrained while another is loose, naming its bodies and joints, and
    where a group lacks its branch.
    """
    known, steps = {GROUND}, []
    while len(known) <= len(mechanism.moving):
        group = _next_group(mechanism, known)
        recognised = (recognise(group) for recognise in (CLOSED_FORMS if closed_forms else CLOSED_FORMS[:2]))
        steps.append(next((step for step in recognised if step is not None), None) or block.of(group))
        known.update(group.bodies)
    return Plan(mechanism, tuple(steps))


def _next_group(mechanism: Mechanism, known: set[str]) -> Group:
    """The smallest group without freedom that hangs on known bodies only."""
    left = [body for body in mechanism.moving if body not in known]
    for size in range(1, len(left) + 1):
        for bodies in combinations(left, size):
            group = _group(mechanism, bodies, known)
            free = 3 * len(bodies) - 2 * len(group.joints) - len(group.inputs)
            if free < 0:
                raise _over_constrained(group)
            if free == 0:
                return group
    raise AssertionError("a mechanism whose freedoms are all driven has a group left")


def _group(mechanism: Mechanism, bodies: Iterable[str], known: set[str]) -> Group:
    chosen = set(bodies)
    joints = tuple(
        joint for joint in mechanism.joints if chosen & set(joint.bodies) and set(joint.bodies) <= chosen | known
    )
    driven = {joint.name for joint in joints}
    inputs = tuple(entry for entry in mechanism.inputs if entry.joint in driven)
    return Group(mechanism, tuple(bodies), joints, inputs)


def _over_constrained(group: Group) -> MechanismError:
    bodies, joints = ", ".join(group.bodies), ", ".join(joint.name for joint in group.joints)
    return MechanismError(
        f"{group.mechanism.name} is over-constrained at {bodies}",
        allowed=f"joints {joints}"
        + (f" and {len(group.inputs)} inputs" if group.inputs else "")
        + " hold it too often",
        do="take one away; another part has a freedom too many",
    )
