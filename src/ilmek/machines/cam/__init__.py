"""A cam with its follower: profile from a motion law, size from a limit, forces, spring, roller, hub.

The geometry stands on `ilmek.cams`, materials and life on `ilmek.elements`. Every motion law, with knife-edge, roller,
flat-faced and spherical followers.
"""

from ilmek.cams.loaded_cam import CamExtremes
from ilmek.machines.cam.analysis import CamAnalysis, analyse, results
from ilmek.machines.cam.compliant_follower import CompliantFollower
from ilmek.machines.cam.design import CamDesign, design
from ilmek.machines.cam.figures import figures
from ilmek.machines.cam.params import CamParams
from ilmek.machines.cam.parts import cam_tables
from ilmek.machines.cam.report import checks, tables, warnings
from ilmek.machines.cam.tree import tree
from ilmek.machines.component import Component

__all__ = ["MACHINE", "CamDesign", "CamParams", "design"]

MACHINE = Component(
    name="cam",
    title="Cam",
    params=CamParams,
    design=design,
    analysis=analyse,
    results=results,
    reported=(CamDesign, CamAnalysis, CamExtremes, CompliantFollower),
    checks=checks,
    tables=tables,
    figures=figures,
    warnings=warnings,
    tree=tree,
    cam_tables=cam_tables,
)
