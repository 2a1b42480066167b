"""The knotting arms in a loom: their parameters for the carpet's warps, pile and knot, their parts and work.

An opener gives the needles their room at every pitch. So a needle keeps its usual thickness; a fine pitch limits the
opener, which enters between two warps and crowds their neighbours.
"""

import numpy as np

from ilmek.elements.drive_parts import motor_part, reducer_part
from ilmek.machines.knotting_dyad.design import KnottingDyad
from ilmek.machines.knotting_dyad.drives import head_motion, links_of
from ilmek.machines.knotting_dyad.motion import drive_angles
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.loom_task import LoomTask
from ilmek.report import BillLine, Work
from ilmek.units import format_quantity


def params_for(task: LoomTask) -> KnottingDyadParams:
    """The parameters of the arms of a loom."""
    return KnottingDyadParams(knot=task.params.knot, cloth=task.cloth)


def parts(dyad: KnottingDyad) -> tuple[BillLine, ...]:
    """Links, servos and gears of the two arms of one head, and the axis of its centre gripper."""
    if dyad.head is None:
        return ()
    arm, motion = dyad.head.arm, head_motion(dyad.params, dyad.head)
    links = zip(("first", "second"), (arm.first, arm.second), links_of(dyad.params, arm.first, arm.second), strict=True)
    material = f"of density {format_quantity(dyad.params.density, 'kg/m^3')}"
    return (
        *(
            BillLine(f"{name} link of an arm", 2, format_quantity(length, "mm"), material, "machined link", link.mass)
            for name, length, link in links
        ),
        *(
            motor_part(f"servo of the {one.joint}", one.motor, one.servo_torque_max, one.servo_speed, 2)
            for one in motion.joints
        ),
        *(
            reducer_part(f"reducer of the {one.joint}", one.gear_ratio, one.motor, 2)
            for one in motion.joints
            if one.gear_ratio != 1
        ),
        BillLine("axis of the centre gripper", 1, "straight", "", "linear axis", length=dyad.head.centre_stroke),
    )


def work(dyad: KnottingDyad) -> tuple[Work, ...]:
    """Work of the joints' torques over the cycle of a knot, without recovery: the integral of max(M w, 0)."""
    if dyad.head is None:
        return ()
    motion, turned = head_motion(dyad.params, dyad.head), drive_angles(dyad.params).T
    power = [
        np.maximum(motion.arms[name].torque * (arm.speed @ turned), 0.0).sum(axis=1)
        for name, arm in motion.cycle.arms.items()
    ]
    return (Work("knotting", float(np.trapezoid(np.sum(power, axis=0), motion.cycle.time)), "knot"),)
