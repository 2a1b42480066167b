"""The beat by hand: a comb that the weaver strikes on the fell, and the other tools of a hand loom on their shelf.

Source: thesis, 1.3 and 3.2: knots and wefts are pulled down and squeezed by hammering; it prints no sizes.
"""

from ilmek.machines.component import Component, itself
from ilmek.machines.hand_beat.design import HandBeat, design
from ilmek.machines.hand_beat.params import HandBeatParams
from ilmek.machines.hand_beat.report import checks, figures, tree

__all__ = ["MACHINE", "HandBeat", "HandBeatParams", "design"]

MACHINE: Component[HandBeatParams, HandBeat, HandBeat] = Component(
    name="hand-beat",
    title="Beat by hand",
    params=HandBeatParams,
    design=design,
    analysis=itself,
    reported=(HandBeat,),
    checks=checks,
    figures=figures,
    tree=tree,
)
