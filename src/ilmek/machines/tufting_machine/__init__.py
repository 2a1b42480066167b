"""The tufting machine, whole: needle drives along a main shaft, loopers on theirs, needle bar, feed, the carpet.

The needle drives are those of `machines.tufting`, after Xu, Sun, Huang, Sheng and Chi; the machine around them is this
project's, in the arrangement of that paper's Figure 1: a main shaft, a driven shaft of the needle linkages and one of
the hooks', several sets of both along the width.
"""

from ilmek.machines.component import Component, itself
from ilmek.machines.tufting_machine.cyclogram import cyclogram
from ilmek.machines.tufting_machine.design import TuftingMachine, design
from ilmek.machines.tufting_machine.figures import figures
from ilmek.machines.tufting_machine.params import TuftingMachineParams
from ilmek.machines.tufting_machine.report import TuftingVerdict, checks, self_tests, tables
from ilmek.machines.tufting_machine.tree import tree

__all__ = ["MACHINE", "TuftingMachine", "TuftingMachineParams", "design"]

MACHINE: Component[TuftingMachineParams, TuftingMachine, TuftingMachine] = Component(
    name="tufting-machine",
    title="Tufting machine",
    params=TuftingMachineParams,
    design=design,
    analysis=itself,
    reported=(TuftingVerdict, TuftingMachine),
    checks=checks,
    self_tests=self_tests,
    tables=tables,
    figures=figures,
    tree=tree,
    cyclograms=lambda machine: (cyclogram(machine),),
    verdict=TuftingVerdict,
    headline=("tufts", "loop_formed"),
)
