"""The tension compensator: a sprung back rest that relieves the lifted warps.

The open shed lengthens the warps of one parity. Two bars, one for each parity, give way against springs on levers, so
that the tension of the lifted warps rises little and that of the others not at all; one bar for all warps gives way by
half as much and slackens those that are not lifted.

Source: derived here (`synthesis`); a back rest on springs is usual on weaving machines.
"""

from ilmek.machines.component import Component
from ilmek.machines.tension_compensator.analysis import CompensatorAnalysis, analyse
from ilmek.machines.tension_compensator.design import TensionCompensator, design
from ilmek.machines.tension_compensator.figures import figures
from ilmek.machines.tension_compensator.in_loom import fit
from ilmek.machines.tension_compensator.params import TensionCompensatorParams
from ilmek.machines.tension_compensator.report import checks, choices, tables, warnings
from ilmek.machines.tension_compensator.tree import stand, tree

__all__ = ["MACHINE", "TensionCompensator", "TensionCompensatorParams", "design"]

MACHINE = Component(
    name="tension-compensator",
    title="Tension compensator",
    params=TensionCompensatorParams,
    design=design,
    analysis=analyse,
    reported=(CompensatorAnalysis,),
    checks=checks,
    tables=tables,
    figures=figures,
    warnings=warnings,
    tree=tree,
    stand=stand,
    choices=choices,
    fit=fit,
)
