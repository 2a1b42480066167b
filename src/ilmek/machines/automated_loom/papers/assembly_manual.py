"""The assembly manual of a loom, seen from the weaver's right."""

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.tree_manual import UP, assembly_check, tree_manual
from ilmek.part.bolting import bolted
from ilmek.part.insertion import insertions
from ilmek.part.projection import View
from ilmek.report import Check, Paper


def assembly_manual(loom: LoomDesign) -> tuple[Paper, Check]:
    """Its manual, and whether every part can reach its seat past what stands: all other bodies come to the frame."""
    tree = loom_tree(loom)
    steps = insertions(tree, UP, frozenset((part_id("frame"),)))
    return tree_manual(tree, steps, View.SIDE, bolted(tree)), assembly_check(steps)
