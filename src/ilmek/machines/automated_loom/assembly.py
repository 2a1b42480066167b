"""Whether the parts of a loom make one machine: what is through each other, what is too near, what nothing holds."""

from collections.abc import Mapping
from functools import lru_cache
from itertools import chain

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.drives import drive_checks
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.automated_loom.nearest_parts import (
    MIDDLE,
    NearParts,
    machines_of_bodies,
    nearest_of,
    nearest_parts,
    passes,
    range_of_a_head,
)
from ilmek.machines.automated_loom.tolerance_chains import chain_checks, chain_table
from ilmek.part.clearances import Approach
from ilmek.part.colliders import DEVIATION
from ilmek.part.contacts import TOUCHING, Contacts, contacts, open_parts
from ilmek.part.drive_balance import drive_balance
from ilmek.part.tree import JointKind, RigidBody, Tree
from ilmek.records import computed, record
from ilmek.report import Check, Json, Table, at_least, at_most, columns
from ilmek.units import deg, format_quantity

NEAREST = 10
"""Pairs of parts that are reported."""

_STANDING = "at all angles"

_ROUNDING = 1e-9
"""Distance of parts that slide on each other [m]."""


@record
class LoomAssembly:
    """The parts of a loom against each other.

    nearest   least distances of parts that move against each other, the nearest first
    contacts  what touches, and what is through each other at all angles
    """

    loom: LoomDesign
    nearest: tuple[NearParts, ...]
    contacts: Contacts

    buildable = computed(
        "", "no part through or too near to another, all in one group, each held by a joint", lambda it: it.holds
    )

    @computed("1", "pairs of parts that are through each other at an angle of a row or a knot", name="assembly_clashes")
    def clashes(self) -> int:
        return len(self.through)

    @computed("1", "groups of parts that touch: 1 where each is held", name="assembly_groups")
    def number_of_groups(self) -> int:
        return len(self.contacts.groups)

    degrees_of_freedom = computed(
        "1",
        "coordinates of all bodies, less the rank of joints and transmissions, and those that nothing has to drive",
        lambda it: drive_balance(loom_tree(it.loom)).number,
    )
    passive_bodies = computed(
        "1", "bodies that move and that nothing has to drive", lambda it: len(drive_balance(loom_tree(it.loom)).passive)
    )

    @computed(
        "", "the pairs of parts that come nearest: those through each other, then those that do not touch", shown=False
    )
    def nearest_pairs(self) -> list[Json]:
        return [near.as_json(range_of_a_head(self.loom)) for near in self.apart[:NEAREST]]

    @property
    def apart(self) -> tuple[NearParts, ...]:
        """What is through each other, then what moves against each other and does not touch, the nearest first."""
        return (*self.through, *(near for near in self.nearest if near.approach.distance > TOUCHING))

    @property
    def holds(self) -> bool:
        """Whether every check of it holds."""
        return all(check.ok for check in _checks(self))

    @property
    def through(self) -> tuple[NearParts, ...]:
        """Pairs of parts that are through each other: of each two parts the worst."""
        worst: dict[frozenset[str], NearParts] = {}
        standing = (NearParts(pair, _STANDING) for pair in self.contacts.through)
        moving = (near for near in self.nearest if near.approach.distance < 0)
        for near in sorted((*moving, *standing), key=lambda near: near.approach.distance):
            worst.setdefault(frozenset(near.approach.parts), near)
        return tuple(worst.values())

    @property
    def checks(self) -> tuple[Check, ...]:
        """Parts through each other, in the air, or without a joint; parts of two machines that come too near."""
        return (*_checks(self), *chain_checks(self.loom))

    @property
    def tables(self) -> tuple[Table, ...]:
        """The pairs that come nearest; below 0 they are through each other, by the mean depth of what they share."""
        titles = _titles(self.loom)
        rows = tuple(
            (titles[pair.parts[0]], titles[pair.parts[1]], pair.distance, pair.drive, pair.angle, near.heads)
            for near in self.apart[: 3 * NEAREST]
            for pair in [near.approach]
        )
        heads = columns("part", "and", "least [mm]", "cyclogram", "at [deg]", "heads")
        return Table("loom-nearest-parts", "Nearest parts", heads, rows), chain_table(self.loom)


@lru_cache(maxsize=4)
def assembly(loom: LoomDesign) -> LoomAssembly:
    """The parts of a loom against each other; takes some seconds."""
    return LoomAssembly(loom, nearest_parts(loom), contacts(loom_tree(loom)))


def holds_in_space(loom: LoomDesign) -> bool:
    """Whether the checks of `assembly` hold; ended at the first comparison in which one fails, so quicker than all."""
    touching = contacts(loom_tree(loom))
    each = chain([()], passes(loom, loom.params.clearance))
    return all(LoomAssembly(loom, nearest_of(near), touching).holds for near in each)


@lru_cache(maxsize=4)
def _checks(whole: LoomAssembly) -> tuple[Check, ...]:
    titles, groups = _titles(whole.loom), whole.contacts.groups
    through = (part for near in whole.through for part in near.approach.parts)
    loose = (part for group in groups[1:] for part in group.parts)
    return (
        at_most(
            "parts through each other",
            len(whole.through),
            0,
            "1",
            _worst(whole.through, titles) or "meshes of all parts over both cyclograms",
        ).with_cure("change the arrangement so that the parts named have room", *dict.fromkeys(through)),
        at_most(
            "groups of parts that touch",
            len(groups),
            1,
            "1",
            "meshes of all parts at the start of a row, within 0.1 mm; more than one: parts that nothing holds",
        ).with_cure("give the parts named supports", *dict.fromkeys(loose)),
        joint_check(loom_tree(whole.loom)),
        *drive_checks(loom_tree(whole.loom)),
        mesh_check(loom_tree(whole.loom)),
        *_too_near(whole, titles),
    )


def joint_check(tree: Tree) -> Check:
    """Every body is held by a joint, and what moves by one that lets it move."""
    without = [body for body in tree.bodies if _is_without_joint(body)]
    parts = (occurrence.part.id for body in without for occurrence in body.occurrences)
    source = ", ".join(body.id for body in without) or "joints of all bodies to what carries them"
    return at_most("bodies without a joint", len(without), 0, "1", source).with_cure(
        "give the bodies named bearings, guides or fasteners", *dict.fromkeys(parts)
    )


def _is_without_joint(body: RigidBody) -> bool:
    joint = body.joint
    return joint.kind == JointKind.MISSING or (joint.kind == JointKind.FIXED and joint.motion is not None)


def mesh_check(tree: Tree) -> Check:
    """That every mesh encloses a volume: what an open one is through could not be seen."""
    parts = open_parts(tree)
    return at_most("parts with an open mesh", len(parts), 0, "1", "edges of one triangle only").with_cure("", *parts)


def _too_near(whole: LoomAssembly, titles: Mapping[str, str]) -> tuple[Check, ...]:
    """The least clearance of the parts of each two machines that move against each other, and do not touch.

    What a body carries in its bore has that body's wall between it and the guide of this one: it is left out there.
    """
    machines, limit = machines_of_bodies(whole.loom), whole.loom.params.clearance
    parents = {body.id: body.parent for body in loom_tree(whole.loom).bodies}
    least: dict[frozenset[str], NearParts] = {}
    guided: set[tuple[str, str]] = set()
    for near in whole.nearest:
        (first, other), bodies = near.approach.parts, near.approach.bodies
        both = frozenset(machines[body] for body in bodies)
        if near.approach.distance <= _ROUNDING:
            guided |= {(first, bodies[1]), (other, bodies[0])}
        elif len(both) == 2 and guided.isdisjoint({(first, parents[bodies[1]]), (other, parents[bodies[0]])}):
            least.setdefault(both, near)
    return tuple(
        at_least(
            f"clearance in space: {titles[near.approach.parts[0]]} and {titles[near.approach.parts[1]]}",
            near.approach.distance,
            limit - DEVIATION,
            "mm",
            f"parameter clearance, assumed by this project, less the meshes' deviation; {_where(near)}",
        ).with_cure("set a larger clearance", *near.approach.parts)
        for near in least.values()
    )


def _titles(loom: LoomDesign) -> dict[str, str]:
    return {part.id: part.title for part, _ in loom_tree(loom).occurrences()}


def _worst(through: tuple[NearParts, ...], titles: Mapping[str, str]) -> str:
    """The deepest three in words."""

    def named(near: NearParts) -> str:
        first, other = (titles[part] for part in near.approach.parts)
        return f"{first} in {other} by {format_quantity(-near.approach.distance, 'mm', 2)}, {_where(near)}"

    return "; ".join(named(near) for near in through[:3])


def _where(near: NearParts) -> str:
    pair: Approach = near.approach
    if near.heads == _STANDING:
        return _STANDING
    heads = "" if near.heads == MIDDLE else f", the heads {near.heads} of their shares"
    return f"at {pair.angle / deg:.1f} deg of a {pair.drive}{heads}"
