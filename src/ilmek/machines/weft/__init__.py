"""The weft side: two wefts after every row of knots, laid by two shuttles or by a rapier.

The straight, thick weft goes into the even shed, the sinuous, thin one into the odd shed; their counts are those of the
carpet's yarns, so that each has a shuttle and a bobbin of its own (thesis, 3.2), or a package beside a rapier, the weft
robot that the thesis names as future work.
"""

from ilmek.machines.component import Component, itself
from ilmek.machines.weft.axis import BeltAxis
from ilmek.machines.weft.design import Weft, design
from ilmek.machines.weft.figures import figures
from ilmek.machines.weft.in_loom import fit, work
from ilmek.machines.weft.params import WeftParams
from ilmek.machines.weft.passage import WeftPassage
from ilmek.machines.weft.rapier import Rapier
from ilmek.machines.weft.report import results, tables, warnings
from ilmek.machines.weft.shuttle import Shuttle

__all__ = ["MACHINE", "Rapier", "Shuttle", "Weft", "WeftParams", "WeftPassage", "design"]

MACHINE = Component(
    name="weft",
    title="Weft",
    params=WeftParams,
    design=design,
    analysis=itself,
    results=results,
    reported=(Weft, Shuttle, Rapier, WeftPassage, BeltAxis),
    checks=lambda made: made.checks,
    tables=tables,
    figures=figures,
    warnings=warnings,
    tree=lambda made: made.bodies.tree,
    stand=lambda made: made.bodies.stand,
    work=work,
    choices=lambda made: made.choices,
    fit=fit,
    own_figures=("weft-shed",),
)
