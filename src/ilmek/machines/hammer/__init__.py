"""The hammer: the comb that beats knots and wefts to the fell, all across the carpet at once.       [thesis 3.3]

Either leaves on the guide cams, which a vertical axis pulls down with the whole cam system, or a comb on crank-rockers
(`beat_up`). The fabric's resistance states where the row ends up, the comb as a beam on the fell how evenly.
"""

from ilmek.machines.component import Component, itself
from ilmek.machines.hammer.axis import CombDrive
from ilmek.machines.hammer.comb import Comb
from ilmek.machines.hammer.design import Hammer, design
from ilmek.machines.hammer.figures import figures
from ilmek.machines.hammer.in_loom import fit, planned_beat, work
from ilmek.machines.hammer.linkage import CombLinkage
from ilmek.machines.hammer.params import HammerParams
from ilmek.machines.hammer.report import cam_tables, checks, self_tests, tables, warnings
from ilmek.machines.hammer.tree import tree

__all__ = ["MACHINE", "Hammer", "HammerParams", "design"]

MACHINE = Component(
    name="hammer",
    title="Hammer",
    params=HammerParams,
    design=design,
    analysis=itself,
    results=lambda hammer: (hammer, hammer.comb, hammer.axis, hammer.linkage),
    reported=(Hammer, Comb, CombDrive, CombLinkage),
    checks=checks,
    self_tests=self_tests,
    tables=tables,
    figures=figures,
    warnings=warnings,
    cam_tables=cam_tables,
    tree=tree,
    work=work,
    choices=lambda hammer: hammer.choices,
    fit=fit,
    beat=planned_beat,
)
