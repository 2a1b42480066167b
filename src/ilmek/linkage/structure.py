"""The order of solution of a mechanism, outward from the ground and the inputs.

Assur's principle: with locked inputs a mechanism consists of groups without a degree of freedom of their own. Each
group is solved once the bodies to which it is attached are known. `plan` takes the smallest such group next. A group
with a closed form is solved by it, any other group by Newton's method on its loop equations. Over-constrained and
under-constrained bodies are reported with their joints.

>>> from ilmek.linkage.fourbar import four_bar
>>> for step in plan(four_bar(0.300, 0.060, 0.200, 0.230, branch=+1)).steps:
...     print(step.description)
crank turned by the input on ground
coupler and rocker joined at B (branch +1), attached to crank and ground: RRR
"""

from collections.abc import Iterable, Iterator
from itertools import combinations, islice

from ilmek.errors import MechanismError
from ilmek.linkage.constraint_assignment import Constraints, assigned_constraints
from ilmek.linkage.groups.follower import CoupledFollower
from ilmek.linkage.groups.geared import Geared
from ilmek.linkage.groups.general import GeneralGroup
from ilmek.linkage.groups.group import Group, Step
from ilmek.linkage.groups.prp import CrossedSliders
from ilmek.linkage.groups.rpp import CrossSlide
from ilmek.linkage.groups.rpr import SlidingDyad
from ilmek.linkage.groups.rrp import SliderDyad
from ilmek.linkage.groups.rrr import RRRDyad
from ilmek.linkage.groups.shift import DrivenSlider
from ilmek.linkage.groups.turn import DrivenCrank
from ilmek.linkage.model import GROUND, Mechanism, degrees_of_freedom
from ilmek.records import value_record

GROUPS: tuple[type[Step], ...] = (
    DrivenCrank,
    DrivenSlider,
    RRRDyad,
    SliderDyad,
    SlidingDyad,
    CrossedSliders,
    CrossSlide,
    Geared,
    CoupledFollower,
)
"""The groups with a closed form, in order of precedence; the driven bodies first."""


@value_record
class Plan:
    """A mechanism and the steps that solve it, in order."""

    mechanism: Mechanism
    steps: tuple[Step, ...]

    def step_of(self, body: str) -> Step:
        """The step that solves a body."""
        return next(step for step in self.steps if body in step.bodies)


SUBSETS = 5000
"""Sets of bodies that are searched for the smallest over-constrained one."""


def plan(mechanism: Mechanism, *, closed_forms: bool = True) -> Plan:
    """The steps that solve `mechanism`; with `closed_forms=False` all undriven groups are solved by Newton's method.

    Raises MechanismError where a part is over-constrained or under-constrained, naming its bodies, joints and inputs,
    and where a group lacks its branch.
    """
    return Plan(mechanism, tuple(_steps(mechanism, closed_forms)))


def solvable_steps(mechanism: Mechanism) -> tuple[tuple[Step, ...], MechanismError | None]:
    """The steps that can be solved of a mechanism that may be unfinished, and why there are no more; None: all can.

    >>> from ilmek.linkage.model import Body, Pin, Rotation
    >>> bodies = Body("ground", {"A": 0}), Body("crank", {"A": 0, "B": 1}), Body("rod", {"B": 0})
    >>> pins = Pin("A", "ground", "crank"), Pin("B", "crank", "rod")
    >>> open_chain = Mechanism(bodies, pins, (Rotation("crank", "A"),))
    >>> steps, reason = solvable_steps(open_chain)
    >>> [step.bodies for step in steps], reason.given
    ([('crank',)], 'mechanism is under-constrained at rod')
    """
    steps: list[Step] = []
    try:
        for step in _steps(mechanism, closed_forms=True):
            steps.append(step)  # noqa: PERF402 - those before the error are kept
    except MechanismError as error:
        return tuple(steps), error
    return tuple(steps), None


def _steps(mechanism: Mechanism, closed_forms: bool) -> Iterator[Step]:
    """The steps in order. Raises as `plan`, after those that can be solved."""
    known = {GROUND}
    assigned = assigned_constraints(mechanism)
    while len(known) <= len(mechanism.moving):
        if assigned.excess:
            group = _first_group(mechanism, known, assigned.excess)
        else:
            group = _group(mechanism, _next_bodies(mechanism, known, assigned.constraints), known)
        kinds: list[type[Step]] = [*(GROUPS if closed_forms else GROUPS[:2]), GeneralGroup]
        recognised = (kind.recognise(group) for kind in kinds)
        yield next(step for step in recognised if step is not None)
        known.update(group.bodies)


def _next_bodies(mechanism: Mechanism, known: set[str], assigned: Constraints) -> tuple[str, ...]:
    """The bodies of the smallest group without degrees of freedom that is attached to known bodies only.

    A group is closed under its constraints: where every body has three of them, it contains the other bodies of each.
    Raises MechanismError for an under-constrained mechanism.
    """
    left = [body for body in mechanism.moving if body not in known]
    order = {body: number for number, body in enumerate(left)}
    groups = (_closed(body, assigned, known) for body in left)
    numbers = [sorted(order[body] for body in group) for group in groups if group]
    if not numbers:
        raise _under_constrained(_group(mechanism, left, known))
    return tuple(left[number] for number in min(numbers, key=lambda group: (len(group), group)))


def _closed(body: str, assigned: Constraints, known: set[str]) -> set[str]:
    """The smallest group that contains a body; empty if a body of it keeps a degree of freedom."""
    group, open_bodies = {body}, [body]
    while open_bodies:
        constraints = assigned[open_bodies.pop()]
        if len(constraints) < 3:
            return set()
        more = {other for constraint in constraints for other in constraint} - known - group
        group |= more
        open_bodies += more
    return group


def _first_group(mechanism: Mechanism, known: set[str], excess: frozenset[str]) -> Group:
    """The next group of an over-constrained mechanism, by trial.

    Raises MechanismError for the smallest over-constrained set; for `excess` if it is not found within `SUBSETS`.
    """
    left = [body for body in mechanism.moving if body not in known]
    sets = (bodies for size in range(1, len(left) + 1) for bodies in combinations(left, size))
    for bodies in islice(sets, SUBSETS):
        group = _group(mechanism, bodies, known)
        if group.degrees_of_freedom < 0:
            raise _over_constrained(group)
        if group.degrees_of_freedom == 0:
            return group
    raise _over_constrained(_group(mechanism, [body for body in left if body in excess], known))


def _group(mechanism: Mechanism, bodies: Iterable[str], known: set[str]) -> Group:
    chosen = set(bodies)
    joints = tuple(
        joint for joint in mechanism.joints if chosen & set(joint.bodies) and set(joint.bodies) <= chosen | known
    )
    driven = {joint.name for joint in joints}
    inputs = tuple(entry for entry in mechanism.inputs if entry.joint in driven)
    couplings = tuple(
        coupling
        for coupling in mechanism.couplings
        if chosen & set(coupling.bodies) and set(coupling.bodies) <= chosen | known
    )
    return Group(mechanism, tuple(bodies), joints, inputs, couplings)


def _over_constrained(group: Group) -> MechanismError:
    """The error for too many inputs, or too many constraints of joints and couplings."""
    whole = group.mechanism
    free, driven = degrees_of_freedom(whole), [entry.name for entry in whole.inputs]
    constraints = f"{_constraints(group)} over-constrain it {_times(-group.degrees_of_freedom)}"
    if 1 <= free < len(driven):
        constraints += f": the inputs {', '.join(driven)} drive {_degrees(free)}"
        do = f"remove {len(driven) - free} of the inputs"
    else:
        do = "remove one of them, or remove a body with a redundant constraint"
    given = f"{whole.name} is over-constrained at {', '.join(group.bodies)}"
    about = ("couplings", group.couplings[-1].name) if group.couplings else ("joints", group.joints[-1].name)
    return MechanismError(given, allowed=constraints, do=do, about=about)


def _constraints(group: Group) -> str:
    joints = f"joints {', '.join(joint.name for joint in group.joints)}"
    return joints + (
        f" and couplings {', '.join(coupling.name for coupling in group.couplings)}" if group.couplings else ""
    )


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def _degrees(count: int) -> str:
    return f"{count} degree{'' if count == 1 else 's'} of freedom"


def _under_constrained(group: Group) -> MechanismError:
    """The error for the bodies that remain unsolved, with their constraints."""
    bodies, joints, slack = len(group.bodies), len(group.joints), group.degrees_of_freedom
    free, driven = slack + len(group.inputs), len(group.inputs)
    geared = f" - {len(group.couplings)}" if group.couplings else ""
    return MechanismError(
        f"{group.mechanism.name} is under-constrained at {', '.join(group.bodies)}",
        allowed=f"{bodies} bodies and the {joints} {_constraints(group)} have 3·{bodies} - 2·{joints}{geared} = "
        f"{_degrees(free)}, and {driven} {'is' if driven == 1 else 'are'} driven",
        do=f"drive {slack} more of these joints, or add joints between the bodies",
        about=("bodies", group.bodies[0]),
    )
