"""The tension compensator in a loom: its parameters from the task."""

import numpy as np

from ilmek.machines.loom_task import LoomTask
from ilmek.machines.shedding import shed_lengthenings
from ilmek.machines.tension_compensator.params import TensionCompensatorParams
from ilmek.units import turn

SAMPLES = 73
"""Angles of the cam shaft at which the lengthening of the warps is computed, 5 degrees apart."""


def fit(task: LoomTask) -> TensionCompensatorParams:
    """The parameters for a loom: its warps, and the shed of its cams."""
    cams, side = task.shedding, task.side
    assert side is not None
    shed, turns = cams.params, np.linspace(0.0, turn, SAMPLES)
    return task.parameters(
        "tension-compensator",
        TensionCompensatorParams(
            cloth=task.cloth,
            warp_length=side.warp_length,
            lift=side.lift,
            front_span=side.front_span,
            back_span=side.back_span,
            lengthening=float(max(parity.max() for parity in shed_lengthenings(cams, turns))),
            rise=shed.rise,
            dwell=shed.dwell,
            fall=shed.fall_angle,
            law=shed.law,
            speed=shed.speed,
        ),
    )
