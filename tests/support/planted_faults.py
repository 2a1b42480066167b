"""Faults planted in a loom, to be found by the project's own measure and by the judge of GLB files alike.

    python -m planted_faults --seed 7 --number 30

A part is pushed 1 mm into one that it touches, a part is taken away, a triangle of a mesh is left out. Pushed are only
parts that then have more in common with another than counts.
"""

import argparse
import itertools
import random
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from glb_judge import GlbJudge
from manifold3d import Manifold, Mesh

from ilmek.arrays import FloatArray
from ilmek.io.glb import glb_bytes
from ilmek.machines.automated_loom import MACHINE
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.part.clearances import approaches
from ilmek.part.contacts import contacts, open_parts
from ilmek.part.part import Part
from ilmek.part.placement import Placement, placement
from ilmek.part.poses import chains, poses
from ilmek.part.shapes import CHORD, Shape
from ilmek.part.space import frames_of, parts_of
from ilmek.part.tree import RigidBody, Tree
from ilmek.report.scene import Assembly, Solid
from ilmek.units import mm

PUSH, CLEAR = 1 * mm, 100 * mm**3
"""How far a part is pushed, and volume in common from which the fault must be found."""

DRIVE = "row"


@dataclass(frozen=True)
class Verdict:
    """What a measure says of a tree: number of groups, pairs of parts through each other, parts with an open mesh."""

    groups: int
    through: frozenset[frozenset[str]]
    is_open: frozenset[str]


def own_verdict(tree: Tree) -> Verdict:
    """By the project, at the start of a row: of parts that move against each other, and of those that do not."""
    standing = contacts(tree)
    pairs = (*approaches(tree, DRIVE, 0.1 * mm, ((0.0, 1e-3),)), *standing.through)
    return Verdict(
        len(standing.groups),
        frozenset(frozenset(pair.parts) for pair in pairs if pair.distance < 0),
        frozenset(open_parts(tree)),
    )


def judged(tree: Tree) -> Verdict:
    """By the judge of the GLB file of the tree, in its pose at the beginning."""
    judge = GlbJudge(glb_bytes(Assembly("", frames_of(tree, ""), parts_of(tree, "machine"), {DRIVE: 1.0})))
    return Verdict(
        len(judge.groups()),
        frozenset(frozenset(_id(name) for name in pair) for pair in judge.overlaps()),
        frozenset(map(_id, judge.open_meshes())),
    )


def _id(name: str) -> str:
    return name.partition(" of ")[0]


def changed(tree: Tree, part: str, change: Callable[[RigidBody], RigidBody]) -> Tree:
    """The tree with the bodies changed that have a part."""
    having = (any(own.part.id == part for own in body.occurrences) for body in tree.bodies)
    return replace(
        tree, bodies=tuple(change(body) if has else body for body, has in zip(tree.bodies, having, strict=True))
    )


def pushed(tree: Tree, part: str, shift: FloatArray) -> Tree:
    """A part shifted along its own axes [m]."""
    moved = placement(*shift.tolist())

    def change(body: RigidBody) -> RigidBody:
        own = (
            replace(one, positions=tuple(place.after(moved) for place in one.positions)) if one.part.id == part else one
            for one in body.occurrences
        )
        return replace(body, occurrences=tuple(own))

    return changed(tree, part, change)


def without(tree: Tree, part: str) -> Tree:
    """The tree without a part."""
    return changed(
        tree,
        part,
        lambda body: replace(body, occurrences=tuple(own for own in body.occurrences if own.part.id != part)),
    )


@dataclass(frozen=True)
class Opened:
    """A shape whose meshes lack a triangle."""

    shape: Shape
    number: int

    def mesh(self, deviation: float = CHORD) -> Solid:
        """The mesh, open."""
        whole = self.shape.mesh(deviation)
        return Solid(whole.points, np.delete(whole.triangles, self.number % len(whole.triangles), axis=0))

    def __getattr__(self, name: str) -> object:
        return getattr(self.shape, name)


def opened(tree: Tree, name: str, number: int) -> Tree:
    """The tree with a part whose meshes lack a triangle."""
    whole = next(part for part, _ in tree.occurrences() if part.id == name)
    part = replace(whole, shape=Opened(whole.shape, number))  # type: ignore[arg-type]

    def change(body: RigidBody) -> RigidBody:
        own = tuple(replace(own, part=part) if own.part.id == name else own for own in body.occurrences)
        return replace(body, occurrences=own)

    return changed(tree, name, change)


def pushes(tree: Tree, names: list[str]) -> Iterator[tuple[str, FloatArray]]:
    """Parts of one position, and a way by which each comes into others that stand, by volumes of meshes."""
    placed = [(part, place) for part, place in _placed(tree)]
    axes = [PUSH * sign * axis for axis in np.eye(3) for sign in (1.0, -1.0)]
    for name in names:
        own = [place for part, place in placed if part.id == name]
        if len(own) != 1:
            continue
        part = next(part for part, _ in placed if part.id == name)
        others = [
            (other, place) for other, place in placed if other.id != name and _near((part, own[0]), (other, place))
        ]
        common = [
            max((_common((part, own[0]), other, own[0].rotation @ axis) for other in others), default=0.0)
            for axis in axes
        ]
        if max(common) > CLEAR:
            yield name, axes[int(np.argmax(common))]


def _placed(tree: Tree) -> Iterator[tuple[Part, Placement]]:
    for chain in chains(tree):
        here = poses(chain, DRIVE, np.zeros(1))
        body = Placement(here.origin[0], here.rotation[0])
        for own in chain[-1].body.occurrences:
            yield from ((own.part, body.after(place)) for place in own.positions)


def _points(placed: tuple[Part, Placement]) -> FloatArray:
    part, place = placed
    assert part.shape is not None
    return place.points(part.shape.mesh(mm).points)


def _near(first: tuple[Part, Placement], other: tuple[Part, Placement]) -> bool:
    one, its = _points(first), _points(other)
    return bool(np.all(one.min(0) <= its.max(0) + PUSH) and np.all(its.min(0) <= one.max(0) + PUSH))


def _common(first: tuple[Part, Placement], other: tuple[Part, Placement], shift: FloatArray) -> float:
    solids = [
        Manifold(Mesh(np.float32(_points(placed) + move), np.uint32(placed[0].shape.mesh(mm).triangles)))  # type: ignore[union-attr]
        for placed, move in ((first, shift), (other, np.zeros(3)))
    ]
    return float((solids[0] ^ solids[1]).volume())


def faults(tree: Tree, seed: int) -> Iterator[tuple[str, Tree, Callable[[Verdict], bool]]]:
    """Endless faults: in words, the tree with it, and whether a verdict has found it."""
    chance = random.Random(seed)
    names = [part.id for part, _ in tree.occurrences() if part.shape is not None]
    for turn in itertools.count():
        name = chance.choice(names)
        if turn % 3 == 0:
            for moved, shift in pushes(tree, chance.sample(names, len(names))):
                yield (
                    f"{moved} pushed by {np.round(shift / mm, 2).tolist()} mm",
                    pushed(tree, moved, shift),
                    lambda verdict, moved=moved: any(moved in pair for pair in verdict.through),  # type: ignore[misc]
                )
                break
        elif turn % 3 == 1:
            yield f"{name} taken away", without(tree, name), lambda _: True
        else:
            yield (
                f"{name} opened",
                opened(tree, name, chance.randrange(10**6)),
                lambda verdict, name=name: verdict.is_open == {name},  # type: ignore[misc]
            )


def main() -> int:
    """Plant faults in the default loom; end with 1 where one is missed, or both do not agree."""
    parser = argparse.ArgumentParser(prog="python -m planted_faults", description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--number", type=int, default=30)
    given = parser.parse_args()
    tree, missed = loom_tree(MACHINE.designed(MACHINE.params())), 0
    for text, faulty, is_found in itertools.islice(faults(tree, given.seed), given.number):
        own, other = own_verdict(faulty), judged(faulty)
        agreed = own.groups == other.groups and is_found(own) and is_found(other)
        missed += not agreed
        sys.stdout.write(f"{'found ' if agreed else 'MISSED'} {text}: {_said(own)}; the judge: {_said(other)}\n")
        sys.stdout.flush()
    return int(missed > 0)


def _said(verdict: Verdict) -> str:
    through = ", ".join(" x ".join(sorted(pair)) for pair in verdict.through)
    return f"{verdict.groups} groups, through: {through or 'none'}, open: {', '.join(verdict.is_open) or 'none'}"


if __name__ == "__main__":
    sys.exit(main())
