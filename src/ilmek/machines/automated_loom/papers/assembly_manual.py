"""The assembly manual of a loom, seen from the weaver's right."""

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.tree_manual import tree_manual
from ilmek.part.projection import View
from ilmek.report import Paper
from ilmek.sentences import Sentence


def assembly_manual(loom: LoomDesign) -> Paper:
    """Its bodies in the order that their joints allow."""
    return tree_manual(loom_tree(loom), View.SIDE, Sentence("manual.order-how"))
