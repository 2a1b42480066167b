"""The assemblies of a tree, each with a drawing: a machine, what it is put together of, and what those are.

An assembly of more than `MOST_PARTS` kinds of parts is divided: by the machines of its bodies; those of one machine by
the bodies that carry the others; what one body carries by the bodies on it. What has `FEWEST_PARTS` kinds of parts or
more becomes an assembly of its own, the rest is put in piece by piece. Items have the numbers of the parts list.
"""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import lru_cache

import numpy as np

from ilmek.arrays import Float
from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.part.poses import chains, poses
from ilmek.part.tree import RigidBody, Tree
from ilmek.records import record

MOST_PARTS, FEWEST_PARTS = 40, 3


@record
class AssemblyUnit:
    """What is put together as one.

    number  its own among those of the tree, from 1: `A1` is the whole       machine, title  of its drawing
    bodies  put in piece by piece      assemblies  put in whole      count  of it in the whole
    """

    number: int
    machine: str
    title: str
    bodies: tuple[RigidBody, ...]
    assemblies: "tuple[AssemblyUnit, ...]"
    count: int

    @property
    def name(self) -> str:
        """As an item of another assembly."""
        return f"A{self.number}"

    @property
    def drawing(self) -> str:
        """Number of its drawing."""
        return f"{self.machine}/{self.name}"

    @property
    def every(self) -> "Iterator[AssemblyUnit]":
        """It and all in it."""
        yield self
        for inner in self.assemblies:
            yield from inner.every

    @property
    def all_bodies(self) -> tuple[RigidBody, ...]:
        """All its bodies, those of the assemblies in it too."""
        return tuple(body for own in self.every for body in own.bodies)


@record
class AssemblyItem:
    """A line of an assembly's list: a part or an assembly, how many of it are in one, its mass [kg]; nan: not known."""

    name: str
    quantity: int
    made_of: Part | AssemblyUnit
    mass: float


@record
class AssembledPiece:
    """A piece of a part in an assembly, with every drive at angle 0: the number of its item, and where it stands.

    axis  of its body's joint, in the axes of the tree      row  number of the piece among those of the part in its body
    """

    item: int
    part: Part
    body: RigidBody
    position: Placement
    axis: Float[np.ndarray, " 3"]
    row: int


@lru_cache(maxsize=8)
def assembly_of(tree: Tree, title: str) -> AssemblyUnit:
    """The whole of a tree that has parts."""
    counts = tree.counts()
    numbers = iter(range(1, len(tree.bodies) + 2))

    def assembled(bodies: Sequence[RigidBody], title: str) -> AssemblyUnit:
        number, loose, inner = next(numbers), list[RigidBody](), list[AssemblyUnit]()
        divided = len(_parts(bodies)) > MOST_PARTS
        for name, block in _blocks(bodies) if divided else [(title, bodies)]:
            if divided and len(block) < len(bodies) and len(_parts(block)) >= FEWEST_PARTS and name:
                inner.append(assembled(block, name))
            else:
                loose += block
        count = math.gcd(*(counts[body.id] for body in bodies))
        return AssemblyUnit(number, machine_of(bodies[0]), title, tuple(loose), tuple(inner), count)

    return assembled([body for body in tree.bodies if body.occurrences], title)


def _parts(bodies: Sequence[RigidBody]) -> set[str]:
    return {occurrence.part.id for body in bodies for occurrence in body.occurrences}


def machine_of(body: RigidBody) -> str:
    """The machine of a body: that of most of its parts, by their ids."""
    return Counter(own.part.id.partition("/")[0] for own in body.occurrences).most_common(1)[0][0]


def _blocks(bodies: Sequence[RigidBody]) -> Iterator[tuple[str, list[RigidBody]]]:
    """What an assembly is divided into, with titles; "" of bodies that are put in piece by piece."""
    machines = _grouped(bodies, {body.id: machine_of(body) for body in bodies})
    first, *others = machines.items()
    carriers: dict[str, str] = {}
    for body in first[1]:
        carriers[body.id] = carriers.get(body.parent, body.id)
    roots = _grouped(first[1], carriers)
    if not others and len(roots) == 1:
        root, *carried = first[1]
        yield "", [root]
        for body in carried:
            carriers[body.id] = carriers[body.parent] if body.parent != root.id else body.id
        roots = _grouped(carried, carriers)
    yield from ((name.rpartition("/")[2], block) for name, block in roots.items())
    yield from ((name.replace("-", " "), block) for name, block in others)


def _grouped(bodies: Sequence[RigidBody], names: dict[str, str]) -> dict[str, list[RigidBody]]:
    groups: dict[str, list[RigidBody]] = {}
    for body in bodies:
        groups.setdefault(names[body.id], []).append(body)
    return groups


def items_of(tree: Tree, assembly: AssemblyUnit) -> tuple[AssemblyItem, ...]:
    """The lines of an assembly's list: its parts by their numbers in the parts list, then the assemblies in it."""
    counts, numbers, parts = tree.counts(), dict[str, int](), dict[str, Part]()
    for body in assembly.bodies:
        for own in body.occurrences:
            parts[own.part.id] = own.part
            numbers[own.part.id] = numbers.get(own.part.id, 0) + counts[body.id] * len(own.positions)
    listed = {part.id: position for position, (part, _) in enumerate(tree.occurrences(), 1)}
    lines = [
        AssemblyItem(str(listed[name]), numbers[name] // assembly.count, parts[name], parts[name].mass)
        for name in sorted(parts, key=listed.__getitem__)
    ]
    inner = (
        AssemblyItem(own.name, own.count // assembly.count, own, assembly_mass(tree, own))
        for own in assembly.assemblies
    )
    return (*lines, *inner)


def assembly_mass(tree: Tree, assembly: AssemblyUnit) -> float:
    """Mass of one of an assembly, of its parts that are weighed [kg]."""
    counts = tree.counts()
    return math.fsum(counts[body.id] * body.moments.zeroth for body in assembly.all_bodies) / assembly.count


def drawings_of_parts(tree: Tree) -> dict[str, tuple[str, ...]]:
    """By the id of each part the numbers of the drawings of the assemblies that it is put into."""
    drawings: dict[str, list[str]] = {}
    for assembly in assembly_of(tree, "").every:
        for name in _parts(assembly.bodies):
            drawings.setdefault(name, []).append(assembly.drawing)
    return {name: tuple(numbers) for name, numbers in drawings.items()}


def pieces_of_assembly(tree: Tree, assembly: AssemblyUnit) -> tuple[AssembledPiece, ...]:
    """The pieces of one of an assembly that have a shape, in the axes of the tree."""
    items = {item.name: number for number, item in enumerate(items_of(tree, assembly))}
    listed = {part.id: str(position) for position, (part, _) in enumerate(tree.occurrences(), 1)}
    inside = {body.id: items[own.name] for own in assembly.assemblies for body in own.all_bodies}
    bodies = {body.id for body in assembly.all_bodies}
    counts, seen, pieces = tree.counts(), Counter[str](), list[AssembledPiece]()
    for chain in chains(tree):
        body = chain[-1].body
        seen[body.id] += 1
        if body.id not in bodies or seen[body.id] > counts[body.id] // assembly.count:
            continue
        here = poses(chain, "", np.zeros(1))
        stands, axis = Placement(here.origin[0], here.rotation[0]), here.rotation[0] @ np.array(body.joint.axis)
        for own in body.occurrences:
            item = inside.get(body.id, items.get(listed[own.part.id], 0))
            placed = enumerate(own.positions) if own.part.shape is not None else ()
            pieces += (AssembledPiece(item, own.part, body, stands.after(at), axis, row) for row, at in placed)
    return tuple(pieces)
