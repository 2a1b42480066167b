"""The tufting machine's needle drive: a crank-rocker and a rocker-slider on one driven shaft.

After Xu, Sun, Huang, Sheng and Chi, "Dynamic characteristic analysis of the needle multi-linkage mechanism in a carpet
tufting machine's driving system", Fibres and Textiles in Eastern Europe; moved by `ilmek.linkage`, loaded by
`ilmek.dynamics`. Misprints there: M4 in Eqs 35 and 43 needs a plus, omega4 in Eq 33 its square, the least theta4 is
-7.68 deg where -7.89 deg is printed, and the needle reverses at 106.98 and 288.23 deg of the crank, not at 108 and
287 deg.
"""

from ilmek.machines.component import Component
from ilmek.machines.tufting.design import Tufting
from ilmek.machines.tufting.figures import figures
from ilmek.machines.tufting.params import TuftingParams
from ilmek.machines.tufting.report import TuftingAnalysis, analyse, checks, self_tests, tables
from ilmek.machines.tufting.strength import design
from ilmek.machines.tufting.tree import tree

__all__ = ["MACHINE", "Tufting", "TuftingParams", "design"]

MACHINE = Component(
    name="tufting",
    title="Tufting needle mechanism",
    params=TuftingParams,
    design=design,
    analysis=analyse,
    reported=(TuftingAnalysis,),
    checks=checks,
    self_tests=self_tests,
    tables=tables,
    figures=lambda found: figures(found.design),
    tree=tree,
)
