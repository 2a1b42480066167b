"""Motions of the bodies of a planar linkage in space, each against the body that carries it.

    r = (z - z_p) / e^(i t_p),   a = t - t_p,   shift = (r - r_0) / e^(i a_0),   rotation = a - a_0

z and t are the origin of a body's frame and its angle, z_p and t_p those of its parent, the index 0 is at rest.
                                                                        [relative motion of frames in the plane]
"""

from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.linkage.model import GROUND, Mechanism, Slide
from ilmek.linkage.motion import Motion
from ilmek.part.placement import Placement, placement
from ilmek.part.tree import Closure, JointKind
from ilmek.report.scene import SceneMotion

_ROUNDING = 1e-9
"""Greatest shift of a body that a pin carries, over its distance from the parent's origin: it is rounding."""


def carriers(mechanism: Mechanism) -> dict[str, tuple[str, int]]:
    """Of each moving body, nearest to the ground first, the body that carries it, and the number of their joint.

    Joints that close a loop carry nothing; of two that could carry a body, a slide does, so that pins close the loops.
    Bodies that no chain of joints carries are left out.

    >>> from ilmek import four_bar
    >>> carriers(four_bar(0.300, 0.060, 0.200, 0.230))
    {'crank': ('ground', 0), 'rocker': ('ground', 3), 'coupler': ('crank', 1)}
    """
    carried: dict[str, tuple[str, int]] = {}
    joints = sorted(enumerate(mechanism.joints), key=lambda one: not isinstance(one[1], Slide))
    level = {GROUND}
    while level:
        reached: dict[str, tuple[str, int]] = {}
        for number, joint in joints:
            for body, parent in (joint.bodies, joint.bodies[::-1]):
                if parent in level and body != GROUND and body not in carried:
                    reached.setdefault(body, (parent, number))
        carried |= reached
        level = set(reached)
    return carried


def closures(mechanism: Mechanism, ids: Mapping[str, str]) -> tuple[Closure, ...]:
    """The pins that close the loops of a mechanism, and its couplings, between bodies of a tree by their ids."""
    carrying = {number for _, number in carriers(mechanism).values()}
    pins = (
        Closure(JointKind.PIN, (ids[joint.bodies[0]], ids[joint.bodies[1]]), placement(point.real, point.imag))
        for number, joint in enumerate(mechanism.joints)
        if number not in carrying
        for point in [mechanism.body(joint.bodies[0]).points[joint.name]]
    )
    coupled = (
        Closure(JointKind.ROLLING, (ids[coupling.first[0]], ids[coupling.second[0]]), ratio=coupling.ratio)
        for coupling in mechanism.couplings
        if coupling.law is None
    )
    return (*pins, *coupled)


def resting(motion: Motion, body: str, parent: str) -> Placement:
    """Where a body's frame lies in its parent's at the first sample."""
    origin, angle = _relative(motion, body, parent)
    return placement(float(origin[0].real), float(origin[0].imag), about=(0.0, 0.0, 1.0), angle=float(angle[0]))


def link_motions(
    motion: Motion, rest: Motion, parents: Mapping[str, str], drive: str, angle: FloatArray
) -> dict[str, SceneMotion]:
    """Motions of bodies in the frames of their parents, about z.

    rest     the pose at which the bodies lie in the tree: its first sample
    parents  of each body      drive, angle  of the scene, an angle for each sample of the motion [rad]
    """
    motions = {}
    for body, parent in parents.items():
        origin, turned = _relative(motion, body, parent)
        origin_at_rest, turned_at_rest = (values[0] for values in _relative(rest, body, parent))
        moved = (origin - origin_at_rest) * np.exp(-1j * turned_at_rest)
        if np.max(np.abs(moved)) <= _ROUNDING * np.max(np.abs(origin)):
            moved = np.zeros_like(moved)
        rotation = turned - turned_at_rest
        rotation -= 2 * np.pi * np.round(rotation[0] / (2 * np.pi))
        shift = np.stack([moved.real, moved.imag, np.zeros(len(moved))], axis=1)
        motions[body] = SceneMotion(drive, angle, shift, rotation)
    return motions


def _relative(motion: Motion, body: str, parent: str) -> tuple[ComplexArray, FloatArray]:
    """Origin [m] and angle [rad] of a body's frame in its parent's, one a sample."""
    if parent == GROUND:
        return motion.origin(body), motion.angle(body)
    away = (motion.origin(body) - motion.origin(parent)) * np.conj(motion.direction(parent))
    return away, motion.angle(body) - motion.angle(parent)
