"""The knotting dyad: arms of two links, both driven, whose needles lead the ends of the pile yarn behind the warps.

A head of two mirrored arms and a centre gripper ties the knot on warps of a given pitch, proved, with its clearances,
cycle and drives. Its links follow from four points of the path and the angles that the first link has there, as in the
thesis, 2.1.3, by all real roots at once: none to three arms. Four points that are given are solved alike.
"""

from ilmek.machines.component import Component
from ilmek.machines.knotting_dyad.design import KnottingDyad, design
from ilmek.machines.knotting_dyad.in_loom import params_for, work
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.report import DyadAnalysis, analyse, checks, figures, self_tests, tables, warnings
from ilmek.machines.knotting_dyad.tree import tree

__all__ = ["MACHINE", "KnottingDyad", "KnottingDyadParams", "design"]

MACHINE = Component(
    name="knotting-dyad",
    title="Knotting dyad",
    params=KnottingDyadParams,
    design=design,
    analysis=analyse,
    reported=(DyadAnalysis,),
    checks=checks,
    self_tests=self_tests,
    tables=tables,
    figures=figures,
    warnings=warnings,
    tree=tree,
    work=work,
    fit=params_for,
    own_figures=(
        "knotting-dyad-workspace",
        "knotting-dyad-servos",
        "knotting-dyad-bend",
        "knotting-dyad-clearance",
        "knotting-dyad-solutions",
        "knotting-dyad-poses",
        "knotting-dyad-angles",
        "knotting-dyad-speeds",
        "knotting-dyad-limits",
        "knotting-dyad-torques",
    ),
)
