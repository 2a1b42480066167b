"""The knotting arms in a loom: their parameters for the carpet's pitch and knot, their parts and work.

The mass per length of a warp is proportional to its pitch, as the thesis' tension is, so its diameter is proportional
to the root of the pitch: 0.8 mm at 2 mm. The needles take a share of the gap that is left, up to their usual thickness.
The finer the pitch, the thinner the needle, until the yarn deflects it into the warps: then arms cannot tie the carpet.
"""

import numpy as np

from ilmek.elements.drive_parts import motor_part, reducer_part
from ilmek.machines.knotting_dyad.design import KnottingDyad
from ilmek.machines.knotting_dyad.drives import head_motion, links_of
from ilmek.machines.knotting_dyad.motion import drive_angles
from ilmek.machines.knotting_dyad.params import KnottingDyadParams
from ilmek.machines.loom_task import LoomTask
from ilmek.report import Part, Work
from ilmek.units import format_quantity, mm

WARP, PITCH = 0.8 * mm, 2 * mm
"""Diameter of a taut warp [m] at a pitch [m]."""

NEEDLE, NEEDLE_SHARE, CLEARANCE, CLEARANCE_SHARE = 0.5 * mm, 0.4, 0.1 * mm, 0.1
"""Usual diameter of a needle [m], and its largest share of the gap between two warps; of the clearance likewise."""

CLOSEST = 0.9
"""Diameter of a warp over its pitch at most."""


def params_for(task: LoomTask) -> KnottingDyadParams:
    """The parameters of the arms of a loom. Raises ParameterError for a pitch out of the bounds of its lengths."""
    pitch = task.params.pitch
    warp = task.yarns.warp.diameter
    gap = pitch - warp
    return KnottingDyadParams(
        knot=task.params.knot,
        warp_pitch=pitch,
        warp_diameter=warp,
        needle_diameter=min(NEEDLE, NEEDLE_SHARE * gap),
        clearance=min(CLEARANCE, CLEARANCE_SHARE * gap),
        yarn_diameter=task.yarns.pile.diameter,
    )


def parts(dyad: KnottingDyad) -> tuple[Part, ...]:
    """Links, servos and gears of the two arms of one head, and the axis of its centre gripper."""
    if dyad.head is None:
        return ()
    arm, motion = dyad.head.arm, head_motion(dyad.params, dyad.head)
    links = zip(("first", "second"), (arm.first, arm.second), links_of(dyad.params, arm.first, arm.second), strict=True)
    material = f"of density {format_quantity(dyad.params.density, 'kg/m^3')}"
    return (
        *(
            Part(f"{name} link of an arm", 2, format_quantity(length, "mm"), material, "machined link", link.mass)
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
        Part("axis of the centre gripper", 1, "straight", "", "linear axis", length=dyad.head.centre_stroke),
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
