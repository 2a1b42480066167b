"""The shedding cams: a cam for each warp, opposed for odd and even ones, on one to four square shafts.

Sized by the lift and the motion law, with the smallest prime circle that keeps the pressure angle, after the thesis on
carpet robots, chapter 3.2; the cams stand on `ilmek.cams`, the shaft and its drive on `ilmek.elements`.

Where the thesis' numbers are misprinted: Table 3.2 has its columns swapped (the larger side is the deflection's) and
the limit behind it is 1 mm, not 0.1 mm; 550 kg weigh 5395 N, not 5489 N; only the warps of one parity are lifted at a
time, so that 600 x 10 N never act together.
"""

from ilmek.elements.square_shaft import SquareShaft
from ilmek.machines.component import Component
from ilmek.machines.shedding.analysis import SheddingAnalysis, analyse, results
from ilmek.machines.shedding.cam_shaft import SheddingDrive
from ilmek.machines.shedding.checks import checks
from ilmek.machines.shedding.choices import choices
from ilmek.machines.shedding.design import SheddingDesign, design, shed_lengthenings
from ilmek.machines.shedding.figures import figures
from ilmek.machines.shedding.guideway import Guideway
from ilmek.machines.shedding.in_loom import fit, work
from ilmek.machines.shedding.params import SheddingParams
from ilmek.machines.shedding.report import tables, warnings
from ilmek.machines.shedding.stack import CamStack
from ilmek.machines.shedding.tree import stand, tree
from ilmek.machines.shedding.workshop import cam_tables

__all__ = ["MACHINE", "SheddingDesign", "SheddingParams", "design", "shed_lengthenings"]

MACHINE = Component(
    name="shedding",
    title="Shedding cams",
    params=SheddingParams,
    design=design,
    analysis=analyse,
    results=results,
    reported=(SheddingDesign, Guideway, CamStack, SquareShaft, SheddingDrive, SheddingAnalysis),
    checks=checks,
    choices=choices,
    tables=tables,
    figures=figures,
    warnings=warnings,
    tree=tree,
    stand=stand,
    cam_tables=cam_tables,
    work=work,
    fit=fit,
    own_figures=("shedding-stagger", "shedding-velocity", "shedding-curvature"),
)
