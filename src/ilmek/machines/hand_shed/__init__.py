"""The shed of a hand loom: a rod between the warps, a heddle bar with a string about every other warp, two levers.

The weaver pulls the rod down: the warps before it are the front of the shed. Then the weaver pushes it up, draws the
heddle bar to the front by its levers and locks them: the rear warps are the front of the next shed.

Source: thesis, 3.2, Figures 3.13 to 3.15; it prints no sizes. Levers and locks are this project's.
"""

from ilmek.machines.component import Component, itself
from ilmek.machines.hand_shed.design import HandShed, design
from ilmek.machines.hand_shed.figures import figures
from ilmek.machines.hand_shed.params import HandShedParams
from ilmek.machines.hand_shed.report import checks
from ilmek.machines.hand_shed.tree import tree

__all__ = ["MACHINE", "HandShed", "HandShedParams", "design"]

MACHINE: Component[HandShedParams, HandShed, HandShed] = Component(
    name="hand-shed",
    title="Hand shed",
    params=HandShedParams,
    design=design,
    analysis=itself,
    reported=(HandShed,),
    checks=checks,
    figures=figures,
    tree=tree,
)
