"""The trees of a loom's machines and of the frame that carries them, without what stands round the loom."""

from functools import lru_cache

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.beating import beating
from ilmek.machines.automated_loom.in_space.cams import cams
from ilmek.machines.automated_loom.in_space.heads import arms, heads
from ilmek.machines.automated_loom.in_space.maker import MachineTree
from ilmek.machines.automated_loom.in_space.standing import standing
from ilmek.machines.automated_loom.in_space.weft import weft
from ilmek.part.tree import Tree


@lru_cache(maxsize=2)
def machine_branches(loom: LoomDesign) -> tuple[MachineTree, ...]:
    """The trees, each after what carries it."""
    return (*standing(loom), cams(loom), beating(loom), weft(loom), *heads(loom), *arms(loom))


def joined(branches: tuple[MachineTree, ...]) -> Tree:
    """All bodies of trees in the axes of the scene."""
    return Tree(
        tuple(body for branch in branches for body in branch.tree.bodies_on(branch.parent, branch.position)),
        tuple(closure for branch in branches for closure in branch.tree.closures),
    )
