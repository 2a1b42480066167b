"""The warp tension cylinder: a tube between two bearings that all warps pull on, turned by a motor through a reducer.

Sized by slope and deflection after the thesis on carpet robots, chapter 3.1, on `ilmek.elements`.

Where the thesis' numbers are misprinted: the radii of Table 3.1 are headed as diameters, its last column lacks the
factor 5 of eq. 3.4, its row 125 has 125.12 for 125.11; the tube 140 x 5 mm sags 0.199 mm (not 0.0025 mm) with a slope
of 5.3e-4 (not 5.2e-5); and a reducer that locks itself cannot bring 630 N m out of a 7 N m motor at 1:100, because that
takes an efficiency of 0.9 where self-locking allows one half.
"""

from ilmek.machines.component import Component
from ilmek.machines.warp_tension.analysis import WarpTensionAnalysis, analyse
from ilmek.machines.warp_tension.choices import choices
from ilmek.machines.warp_tension.design import WarpTensionDesign, design
from ilmek.machines.warp_tension.figures import figures
from ilmek.machines.warp_tension.in_loom import fit, work
from ilmek.machines.warp_tension.params import WarpTensionParams
from ilmek.machines.warp_tension.report import checks, tables, warnings
from ilmek.machines.warp_tension.tree import stand, tree

__all__ = ["MACHINE", "WarpTensionDesign", "WarpTensionParams", "design"]

MACHINE = Component(
    name="warp-tension",
    title="Warp tension",
    params=WarpTensionParams,
    design=design,
    analysis=analyse,
    reported=(WarpTensionAnalysis,),
    checks=checks,
    tables=tables,
    figures=figures,
    warnings=warnings,
    tree=tree,
    stand=stand,
    work=work,
    choices=choices,
    fit=fit,
)
