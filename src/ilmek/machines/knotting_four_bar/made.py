"""The parameters of the four-bar that a synthesis chose: links, hand and branch, all else as asked."""

import dataclasses

import numpy as np

from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.machines.knotting_four_bar.poses import Synthesis
from ilmek.units import turn


def made_for(params: KnottingFourBarParams, found: Synthesis) -> KnottingFourBarParams:
    """Parameters that need no poses any more: the links and the direction of the ground link from O1 to O1'.

    The crank angle to report is that of the first pose, unless another one is asked for.
    """
    drawn = found.best.candidate.four_bar
    ground, crank, coupler, rocker = drawn.lengths
    asked = params.crank_angle if params.poses is not None else None
    return dataclasses.replace(
        params,
        poses=None,
        ground=ground,
        crank=crank,
        coupler=coupler,
        rocker=rocker,
        ground_angle=float(np.angle(drawn.b0 - drawn.a0)) % turn,
        branch=drawn.branch,
        hand=found.hand,
        crank_angle=float(found.crank_angles[0]) if asked is None else asked,
    )
