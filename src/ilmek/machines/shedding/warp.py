"""The warp that the shedding cams lift, from their parameters."""

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.shedding.params import WarpParams
from ilmek.weaving.shed import ShedWarp

LIFTED = 1e-12
"""Share of the lift up to which a warp lies on its line; below it the cam's rounding."""


def shed_warp(params: WarpParams) -> ShedWarp | None:
    """The warp with its tension; None where only its force across the cam is given."""
    spans = params.spans_of_warp
    if params.tension is None or spans is None:
        return None
    length = params.warp_length or sum(spans)
    rate = (1 - params.compensation) * (params.warp_stiffness or 0.0) / length
    return ShedWarp(params.tension, spans[0], spans[1], rate)


def warp_force(params: WarpParams, s: FloatArray) -> FloatArray:
    """Force [N] of a warp across the cam at lifts [m]: as given, or from its tension."""
    warp = shed_warp(params)
    return np.full_like(s, params.warp_force) if warp is None else warp.force(s)


def lifting_work(params: WarpParams) -> float:
    """Work [J] of lifting one warp: F L where its force is given, else what stretches it."""
    warp = shed_warp(params)
    return params.warp_force * params.lift if warp is None else warp.work(params.lift)
