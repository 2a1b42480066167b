"""The compensator as a tree of bodies: the parts of each parity, the odd one turned half round about the warps."""

import math
from dataclasses import replace

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.machines.tension_compensator.design import TensionCompensator
from ilmek.machines.tension_compensator.members import part_id
from ilmek.machines.tension_compensator.params import STEEL
from ilmek.machines.tension_compensator.parts import CUT, fitted, sprung_bar, standing
from ilmek.machines.tension_compensator.struts import strut_bodies
from ilmek.part.part import Part
from ilmek.part.placement import placement
from ilmek.part.profile import Profile
from ilmek.part.shapes import Prism
from ilmek.part.tree import Closure, JointKind, Occurrence, RigidBody, Tree
from ilmek.plane.contours import rounded_hull
from ilmek.report.scene import SceneMotion
from ilmek.units import mm

EVEN, ODD = "even", "odd"

SIDE, EDGE, PLAY = 12 * mm, 10 * mm, 5 * mm
"""Thickness of a plate of the stand, from beams and openings to its edge, round a bar that swings [m]; assumed."""


def tree(design: TensionCompensator, motions: dict[str, SceneMotion] | None = None) -> Tree:
    """The bodies of the compensator, in the axes of the even warps' parity but for x, which is from the middle plane.

    motions  of the levers of even and odd warps, by these names; default: all stand at rest
    """
    parts, half = design.parts, placement(design.half_depth)
    turned = {EVEN: half, ODD: placement(about=(0.0, 1.0, 0.0), angle=math.pi).after(half)}
    reach = parts.supports.reach
    bodies, closures = list[RigidBody](), list[Closure]()
    for parity in (EVEN, ODD)[: design.bars]:
        stand, rods = standing(parts, parity, turned[parity]), fitted(parts, parity)
        motion = (motions or {}).get(parity)
        bar = replace(sprung_bar(parts, parity, motion), parent=rods.id)
        struts = strut_bodies(parts.supports, parts.struts, parity, rods.id, motion)
        bodies += (stand, rods, bar, *struts)
        closures += (Closure(JointKind.PIN, (bar.id, end.id), placement(reach.real, reach.imag)) for end in struts[1:])
    return Tree(tuple(bodies), tuple(closures))


def stand(design: TensionCompensator) -> Tree:
    """What carries the beams of the machine alone: a plate welded to their ends on each side, open where bars swing."""
    parts, lever = design.parts, design.one.lever
    swept = np.array([complex(lever.bar(angle)) for angle in (0.0, design.one.angle)]) + design.half_depth
    swings = (swept, -swept.conj())[: design.bars]
    beams = np.array([axis for axis, _ in design.beams])
    room = design.radius + PLAY
    reach = max(design.members.beam.side / math.sqrt(2), room) + EDGE
    outline = rounded_hull(np.concatenate([beams, *swings]), reach)
    section = Profile(outline, tuple(rounded_hull(swing, room) for swing in swings))
    plate = Part(part_id("side-plate"), "side plate of the stand", CUT, Prism(section, SIDE), STEEL)
    half = parts.supports.params.cloth.width / 2
    return Tree((RigidBody(part_id("sides"), (Occurrence(plate, (placement(z=half), placement(z=-half - SIDE))),)),))


def lever_motion(drive: str, angle: FloatArray, rotation: FloatArray) -> SceneMotion:
    """The motion of a lever over the angle of a drive by its rotations [rad], clockwise about the width."""
    return SceneMotion(drive, angle, np.zeros((len(angle), 3)), -rotation)
