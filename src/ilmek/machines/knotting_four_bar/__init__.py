"""The planar knotting four-bar: a crank swings a coupler whose end, the hand, carries holder and gripper.

After the student report "Planar knotting mechanisms for Turkish hand woven carpet" (ME 332), whose model has a degree
of freedom too many: it chooses both crank and coupler angle. Here the coupler follows from the crank, and the ground
link has the direction that closure at the stated pose requires, 74.34 deg; with the report's -95 deg the loop misses by
155.5 mm. That pose is 0.0107 deg from a dead point, and the report's r3 is a difference of two separate links, which
means nothing: `instead` is the four-bar of both arms of its own synthesis. With `poses` given, that synthesis is the
machine; with `sides=2` the mirrored four-bar stands beside it, and gears couple both cranks.

With `task.knot` the machine is another one: hands that are searched for to tie this knot [`hands`].
"""

from ilmek.machines.component import AnyComponent, Component
from ilmek.machines.knotting_four_bar.design import KnottingFourBar, design, parameters
from ilmek.machines.knotting_four_bar.figures import figures
from ilmek.machines.knotting_four_bar.hands import HANDS, TyingHands
from ilmek.machines.knotting_four_bar.hands.task import NO_KNOT
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.machines.knotting_four_bar.report import (
    KnottingFourBarAnalysis,
    analyse,
    checks,
    self_tests,
    tables,
    warnings,
)
from ilmek.machines.knotting_four_bar.tree import tree
from ilmek.params import Params

__all__ = ["MACHINE", "KnottingFourBar", "KnottingFourBarParams", "design"]


def tying(params: KnottingFourBarParams) -> tuple[AnyComponent, Params] | None:
    """Hands for the knot of the task; None without one."""
    return None if params.task.knot == NO_KNOT else (HANDS, params.task)


MACHINE = Component(
    name="knotting-four-bar",
    title="Knotting four-bar",
    params=KnottingFourBarParams,
    design=design,
    analysis=analyse,
    reported=(KnottingFourBarAnalysis, TyingHands),
    checks=checks,
    self_tests=self_tests,
    tables=tables,
    figures=lambda found: figures(found.design),
    warnings=warnings,
    tree=tree,
    parameters=parameters,
    variant=tying,
)
