"""Hands that tie: a pair of four-bars with bent fingers, searched for a knot, in a plane inclined to the warps."""

from ilmek.machines.component import Component, itself
from ilmek.machines.knotting_four_bar.hands.design import TyingHands, design
from ilmek.machines.knotting_four_bar.hands.figures import figures
from ilmek.machines.knotting_four_bar.hands.parts import NAME, hands_tree
from ilmek.machines.knotting_four_bar.hands.report import checks, self_tests, tables
from ilmek.machines.knotting_four_bar.hands.task import HandsTask
from ilmek.part.tree import Tree

__all__ = ["HANDS", "HandsTask", "TyingHands", "design"]


def tree(hands: TyingHands) -> Tree:
    """Both hands; none where none keeps the limits."""
    return Tree() if hands.made is None else hands_tree(hands.made, hands.servo)


HANDS: Component[HandsTask, TyingHands, TyingHands] = Component(
    name=NAME,
    title="Hands that tie",
    params=HandsTask,
    design=design,
    long_design=design,
    analysis=itself,
    reported=(TyingHands,),
    checks=checks,
    self_tests=self_tests,
    tables=tables,
    figures=figures,
    tree=tree,
    headline=("ties", "knot", "candidates", "searched"),
)
"""The machine that `task.knot` names in place of the four-bar with a gripper."""
