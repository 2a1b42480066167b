"""The guideway of the shuttle on the tips of the lifted cams.                                  [thesis 3.2, Fig. 3.18]

The tips stand in a row along the first shaft, at the height of the base circle and the lift above its axis. Over the
window the row is continuous if no tip is much lower than another. Three things part them: the groups of staggered cams
are at different points of their motion, the shaft twists by phi, which lifts the far cams by s' phi less, and it bends:

    step = max over the window of (max s_k - min s_k + |s'| phi) + deflection                                  [derived]

While the shaft turns through the window, the row swings about the axis by 2 (R + L) sin(window / 2) along the warps.
"""

import math

import numpy as np

from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.records import record, result

_ANGLES = 181


@record
class Guideway:
    """The tips of the lifted cams of the first shaft."""

    height: float = result(
        "mm", "height of the lifted cams' tips above the axis of the first shaft", name="guideway_height", least=0.0
    )
    depth: float = result("mm", "depth of the warps at rest below the tips", name="guideway_depth", least=0.0)
    room: float = result(
        "mm",
        "room over the shuttle between lifted and resting warps at the tips",
        name="guideway_room",
        least=-math.inf,
    )
    step: float = result(
        "mm", "largest difference in height of the lifted tips over the window", name="guideway_step", least=0.0
    )
    swing: float = result(
        "mm", "path of the tips along the warps while the shed is open", name="guideway_swing", least=0.0
    )


def guideway_of(shaft: CamShaft, window: tuple[float, float]) -> Guideway:
    """The guideway on the tips of a shaft over the window of shaft angles [rad] in which the even shed is open."""
    angle = np.linspace(*window, _ANGLES)
    motions = shaft.shed.even.motions(angle)
    lifts = np.array([motion.s for motion in motions])
    lag = np.array([np.abs(motion.ds) for motion in motions]).max(axis=0) * shaft.shaft.twist
    apart = float(np.max(lifts.max(axis=0) - lifts.min(axis=0) + lag))
    height, lift = shaft.base_radius + shaft.params.lift, shaft.params.lift
    return Guideway(
        height=height,
        depth=lift,
        room=lift - shaft.params.shuttle_height,
        step=apart + shaft.shaft.deflection,
        swing=2 * height * math.sin(min((window[1] - window[0]) / 2, math.pi / 2)),
    )
