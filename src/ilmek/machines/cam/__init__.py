"""A cam with its follower: profile from a motion law, size from a limit, forces, spring, roller, hub.

The geometry stands on `ilmek.cams`, materials and life on `ilmek.elements`. Every motion law, with knife-edge, roller,
flat-faced and spherical followers.
"""

from ilmek.machines import SUMMARIES
from ilmek.machines.cam.design import CamDesign, design
from ilmek.machines.cam.params import CamParams
from ilmek.machines.cam.report import report
from ilmek.machines.component import Component

__all__ = ["MACHINE", "CamDesign", "CamParams", "design", "report"]

MACHINE = Component(
    name="cam",
    title="Cam",
    summary=SUMMARIES["cam"],
    params=CamParams,
    design=design,
    reporter=report,
)
