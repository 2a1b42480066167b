"""The fabric at the fell of a loom: one for every kind of beat, with the packing properties set for the hammer."""

from ilmek.machines.catalogue import MACHINES
from ilmek.machines.loom_task import LoomTask
from ilmek.weaving.fell import Fabric

USUAL_WARP_LENGTH = 1.5
"""Warp from fell to beam [m] where there is no side view."""


def loom_fabric(task: LoomTask) -> Fabric:
    """The fabric for one warp of the task. Raises ParameterError where values set for it contradict each other."""
    carpet = MACHINES["hammer"].params.read(
        {
            "warps": task.warps,
            "warp_pitch": task.params.pitch,
            "row_pitch": task.row_pitch,
            "tension": task.tension,
            "warp_stiffness": task.yarns.warp.stiffness,
            "warp_length": task.side.warp_length if task.side else USUAL_WARP_LENGTH,
        }
    )
    fabric: Fabric = task.parameters("hammer", carpet).fabric
    return fabric
