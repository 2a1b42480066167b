"""Bodies and joints in space whose axes allow motion in one plane, as the data of a mechanism file.

The plane's normal is that of the first hinge. z of the world is up in it, or x to the right where the normal is z. All
bodies are drawn in the configuration of the file, so that their frames are that of the world.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError
from ilmek.io.imports.foreign import Foreign
from ilmek.linkage.model import GROUND
from ilmek.records import JsonObject
from ilmek.units import turn

PARALLEL = 1e-6
"""Greatest sine or cosine of an axis against the plane."""


class SpatialMass(NamedTuple):
    """Mass [kg], its centre [m] and the inertia about it [kg m²], in the world's axes."""

    mass: float
    centre: FloatArray
    inertia: FloatArray


class SpatialJoint(NamedTuple):
    """A hinge or slide of a child on its parent, at a point [m] with an axis, in the world."""

    name: str
    slides: bool
    parent: str
    child: str
    at: FloatArray
    axis: FloatArray


class SpatialLoop(NamedTuple):
    """Two bodies that share a point [m] of the world."""

    name: str
    bodies: tuple[str, str]
    at: FloatArray


class SpatialTree(NamedTuple):
    """A mechanism in space: joints of a tree, points that close loops, masses by body, joints with motors."""

    name: str
    joints: Sequence[SpatialJoint]
    loops: Sequence[SpatialLoop]
    masses: Mapping[str, Sequence[SpatialMass]]
    driven: Sequence[str]
    gravity: FloatArray
    left_out: Sequence[str]


def planar(tree: SpatialTree) -> Foreign:
    """The data of a mechanism file. Raises MechanismError for a mechanism that does not move in one plane."""
    right, up, normal = _plane(tree.joints)
    points: dict[str, JsonObject] = {GROUND: {}}
    joints: dict[str, JsonObject] = {}
    left_out = list(tree.left_out)

    def flat(at: FloatArray) -> list[float]:
        return [float(at @ right), float(at @ up)]

    for joint in tree.joints:
        across = float(abs(joint.axis @ normal))
        if (across if joint.slides else 1 - across) > PARALLEL:
            given = f"joint {joint.name!r} moves out of the plane of the first hinge"
            raise MechanismError(given, allowed="hinges with parallel axes, and slides across them")
        for body in (joint.parent, joint.child):
            points.setdefault(body, {})[joint.name] = flat(joint.at)
        if joint.slides:
            along = float(np.arctan2(joint.axis @ up, joint.axis @ right) % turn)
            joints[joint.name] = {"slide": [joint.child, joint.parent], "along": along}
            continue
        joints[joint.name] = {"pin": [joint.parent, joint.child]}
        if joint.axis @ normal < 0:
            left_out.append(f"the sense of {joint.name}: its angle counts against it")
    for loop in tree.loops:
        for body in loop.bodies:
            points.setdefault(body, {})[loop.name] = flat(loop.at)
        joints[loop.name] = {"pin": list(loop.bodies)}
    bodies = {
        name: {"points": own, **_mass(tree.masses.get(name, ()), flat, normal, fixed=name == GROUND)}
        for name, own in points.items()
    }
    data: JsonObject = {"name": tree.name, "units": "SI", "confirm": ["lengths"], "bodies": bodies}
    gravity = flat(tree.gravity)
    if any(gravity) and any("mass" in body for body in bodies.values()):
        data["gravity"] = gravity
    data |= {"joints": joints, "inputs": _inputs(tree)}
    return Foreign(data, tuple(left_out))


def _plane(joints: Sequence[SpatialJoint]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Unit vectors to the right and up in the plane of motion, and its normal."""
    normal = next((joint.axis for joint in joints if not joint.slides), None)
    if normal is None:
        raise MechanismError("there is no hinge, which would show the plane of motion", do="add one")
    x, z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    if abs(normal @ z) > 1 - PARALLEL:
        return x, np.cross(z, x), z
    up = z - (z @ normal) * normal
    up /= np.linalg.norm(up)
    right = np.cross(up, normal)
    side = np.sign(right[np.argmax(np.abs(right))])
    return side * right, up, side * normal


def _mass(parts: Sequence[SpatialMass], flat: Any, normal: FloatArray, *, fixed: bool) -> JsonObject:
    """Mass, centre and moment about the normal of all parts of a body together."""
    mass = sum(part.mass for part in parts)
    if fixed or not mass > 0:
        return {}
    centre = sum((part.mass * part.centre for part in parts), np.zeros(3)) / mass
    moment = 0.0
    for part in parts:
        arm = part.centre - centre
        moment += float(normal @ part.inertia @ normal + part.mass * (arm @ arm - (arm @ normal) ** 2))
    return {"mass": float(mass), "centre": flat(centre), "moment": moment}


def _inputs(tree: SpatialTree) -> dict[str, str]:
    """As many driven joints as degrees of freedom: those with motors first."""
    free = len(tree.joints) - 2 * len(tree.loops)
    order = sorted(tree.joints, key=lambda joint: joint.name not in tree.driven)
    return {joint.name: joint.child for joint in order[: max(free, 0)]}
