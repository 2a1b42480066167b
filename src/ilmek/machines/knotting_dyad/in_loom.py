"""The knotting arms in a loom: their parameters for the carpet's warps, pile and knot, and their work.

An opener gives the needles their room at every pitch. So a needle keeps its usual thickness; a fine pitch limits the
opener, which enters between two warps and crowds their neighbours.
"""

import math
from dataclasses import replace

import numpy as np

from ilmek.machines.arrangement.spans import SPARE
from ilmek.machines.knotting_dyad.design import KnottingDyad
from ilmek.machines.knotting_dyad.drives import head_motion
from ilmek.machines.knotting_dyad.jaws import CUP, IN_BORE, gripper_half
from ilmek.machines.knotting_dyad.motion import drive_angles
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.knotting_dyad.sequence import CENTRE, LEFT, RIGHT
from ilmek.machines.linkage_strength import smallest_pin
from ilmek.machines.loom_task import LoomTask
from ilmek.machines.weaver.params import WeaverParams
from ilmek.report import Work
from ilmek.units import deg

LEAN = 20 * deg
"""Greatest tilt of a needle at rest for which the grippers have room; assumed by this project."""


def params_for(task: LoomTask) -> KnottingDyadParams:
    """The parameters of the arms of a loom: at rest their grippers leave the sley's foot its way before the warps, and
    their elbows pass the opener's plates.
    """
    usual = KnottingDyadParams(knot=task.params.knot, cloth=task.cloth)
    foot = usual.warp / 2 + SPARE * task.params.clearance + WeaverParams().finger
    leg = (foot + task.params.clearance + gripper_half(usual)) / math.cos(LEAN)
    neck = smallest_pin(usual.strength, usual.link_width) / 2 - IN_BORE + CUP
    return replace(usual, leg=max(usual.leg, leg), room=replace(usual.room, plates=neck + task.params.clearance))


def work(dyad: KnottingDyad) -> tuple[Work, ...]:
    """Work of the joints' torques over the cycle of a knot, without recovery, the integral of max(M w, 0), and the
    energy of the solenoids of the jaws.
    """
    if dyad.head is None:
        return ()
    motion, turned = head_motion(dyad.params, dyad.head), drive_angles(dyad.params).T
    power = [
        np.maximum(motion.arms[name].torque * (arm.speed @ turned), 0.0).sum(axis=1)
        for name, arm in motion.cycle.arms.items()
    ]
    held = sum(motion.jaws.energy(motion.cycle, gripper) for gripper in (LEFT, RIGHT, CENTRE))
    return (
        Work("knotting", float(np.trapezoid(np.sum(power, axis=0), motion.cycle.time)), "knot"),
        Work("jaws", held, "knot"),
    )
