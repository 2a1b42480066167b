"""The knotting dyad: arms of two links, both driven, whose needles lead the ends of the pile yarn behind the warps.

A head of two mirrored arms and a centre gripper ties the knot on warps of a given pitch, proved, with its clearances,
cycle and drives. Its links follow from four points of the way and the angles that the first link has there, as in the
thesis, 2.1.3, by all real roots at once: none to three arms. Four points of one's own are solved alike.
"""

from ilmek.machines import SUMMARIES
from ilmek.machines.component import Component
from ilmek.machines.knotting_dyad.design import KnottingDyad, design
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.report import report

__all__ = ["MACHINE", "KnottingDyad", "KnottingDyadParams", "design", "report"]

MACHINE = Component(
    name="knotting-dyad",
    title="Knotting dyad",
    summary=SUMMARIES["knotting-dyad"],
    params=KnottingDyadParams,
    design=design,
    reporter=report,
)
