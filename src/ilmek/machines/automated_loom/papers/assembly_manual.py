"""The assembly manual of a loom, seen from the weaver's right."""

from dataclasses import replace

from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.lifting_eyes import LIFTING_EYES
from ilmek.machines.automated_loom.frame import part_id
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.machines.tension_compensator.parts import stand_id
from ilmek.machines.tension_compensator.tree import EVEN, ODD
from ilmek.machines.tree_manual import UP, assembly_check, fastening_check, tree_manual, weld_check
from ilmek.part.bolting import bolted
from ilmek.part.insertion import insertions
from ilmek.part.projection import View
from ilmek.report import Check, Paper, PaperSection
from ilmek.sentences import Sentence

FRAME = frozenset((part_id("frame"), LIFTING_EYES, *map(stand_id, (EVEN, ODD))))
"""Ids of the bodies that come before all others: the frame, what of a compensator is welded between its brackets, and
the eyes.
"""


def assembly_manual(loom: LoomDesign) -> tuple[Paper, tuple[Check, ...]]:
    """Its manual, and whether every part can reach its seat past what stands and is fastened there.

    All other bodies come to what is welded, with the eyes in which it hangs.
    """
    tree = loom_tree(loom)
    whole = bolted(tree)
    steps = insertions(tree, UP, FRAME)
    manual, then = (
        tree_manual(tree, steps, View.SIDE, whole),
        PaperSection(Sentence("manual.then"), (Sentence("manual.then-how"),)),
    )
    checks = assembly_check(steps), fastening_check(whole), weld_check(whole)
    return replace(manual, sections=(*manual.sections, then)), checks
