"""The compensator as a tree of bodies: the parts of each parity, the odd one turned half round about the warps."""

import math
from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.tension_compensator.design import TensionCompensator
from ilmek.machines.tension_compensator.parts import sprung_bar, standing
from ilmek.part.placement import placement
from ilmek.part.tree import RigidBody, Tree
from ilmek.report.scene import SceneMotion

EVEN, ODD = "even", "odd"


def tree(design: TensionCompensator, motions: dict[str, SceneMotion] | None = None) -> Tree:
    """The bodies of the compensator, in the axes of the even warps' parity but for x, which is from the middle plane.

    motions  of the levers of even and odd warps, by these names; default: all stand at rest
    """
    parts, half = design.parts, placement(design.half_depth)
    turned = {EVEN: half, ODD: placement(about=(0.0, 1.0, 0.0), angle=math.pi).after(half)}
    bodies: list[RigidBody] = []
    for parity in (EVEN, ODD)[: design.bars]:
        stand = standing(parts, parity, turned[parity])
        bodies += (stand, replace(sprung_bar(parts, parity, (motions or {}).get(parity)), parent=stand.id))
    return Tree(tuple(bodies))


def lever_motion(drive: str, angle: FloatArray, rotation: FloatArray) -> SceneMotion:
    """The motion of a lever over the angle of a drive by its rotations [rad], clockwise about the width."""
    return SceneMotion(drive, angle, np.zeros((len(angle), 3)), -rotation)
