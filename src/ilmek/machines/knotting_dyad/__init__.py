"""The knotting dyad: an arm of two links, both driven, whose end leads the pile yarn round the warps.

Its links follow from four points of the yarn's way and the angles that the first link has there, as in the thesis,
2.1.3, by all real roots at once: none to three arms. The points are given, or they are chosen on the way of the knot.
"""

from ilmek.machines.knotting_dyad.design import KnottingDyad, design
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.report import report
from ilmek.machines.machine import Machine

__all__ = ["MACHINE", "KnottingDyad", "KnottingDyadParams", "design", "report"]

MACHINE = Machine(
    name="knotting-dyad",
    summary="two-link arm through four timed points of a knot: every real arm, and the best of them",
    params=KnottingDyadParams,
    design=design,
    report=report,
)
