"""The hand loom of the thesis: weavers tie, open the shed, beat and wind; nothing is driven.

A vertical frame with two columns, the cylinders between them wound by hand wheels through reducers that lock, rod and
string heddles for the shed, comb, knife and scissors on a shelf, a bench. In place of the lever and the ratchet of the
thesis' Figure 3.5 each cylinder has a reducer that holds it at any angle: a tooth of a ratchet is too coarse for an
even tension of short warps.

Source: thesis, 1.3.1 and 3.1 to 3.2, Figures 3.3 to 3.6 and 3.13 to 3.15; it prints no sizes of a hand loom.
"""

from ilmek.machines.automated_loom.carpet_cost import CarpetCost
from ilmek.machines.automated_loom.energy import Energy
from ilmek.machines.automated_loom.equipment.station import WeaversStation
from ilmek.machines.automated_loom.off_loom import OffLoom
from ilmek.machines.automated_loom.report import LoomVerdict
from ilmek.machines.beat import BeatDrive
from ilmek.machines.component import Component
from ilmek.machines.hand_loom.design import HandLoom, design
from ilmek.machines.hand_loom.figures import figures
from ilmek.machines.hand_loom.frame import own_tree, tree
from ilmek.machines.hand_loom.params import HandLoomParams
from ilmek.machines.hand_loom.report import (
    HandAssembly,
    HandLoomAnalysis,
    analyse,
    assembly,
    checks,
    results,
    tables,
)
from ilmek.report import BUILDABLE
from ilmek.weaving.warping import Warping

__all__ = ["MACHINE", "HandLoom", "HandLoomParams", "analyse", "design"]

MACHINE: Component[HandLoomParams, HandLoom, HandLoomAnalysis] = Component(
    name="hand-loom",
    title="Hand loom",
    params=HandLoomParams,
    design=design,
    analysis=analyse,
    results=results,
    reported=(
        LoomVerdict,
        HandLoomAnalysis,
        Energy,
        BeatDrive,
        WeaversStation,
        CarpetCost,
        OffLoom,
        Warping,
        HandAssembly,
    ),
    checks=checks,
    tables=tables,
    figures=figures,
    tree=tree,
    own_tree=own_tree,
    children=lambda loom: loom.children,
    cyclograms=lambda loom: loom.cyclograms,
    assembly=assembly,
    verdict=LoomVerdict,
    headline=("weaves", BUILDABLE),
)
