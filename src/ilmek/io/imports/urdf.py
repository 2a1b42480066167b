"""URDF: open chains of links, joint by joint from the root; the root is the ground. [ROS, URDF specification]"""

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError
from ilmek.io.imports.foreign import Foreign, name_of, number, numbers
from ilmek.io.imports.spatial import SpatialJoint, SpatialMass, SpatialTree, planar
from ilmek.linkage.model import GROUND

MOVING = {"revolute": False, "continuous": False, "prismatic": True}
"""Type of a joint -> whether it slides."""


def urdf_data(robot: Element) -> Foreign:
    """A mechanism file's data of a <robot>. Raises MechanismError for a chain that is not open or not planar."""
    links = {name_of(link): link for link in robot.findall("link")}
    joints = robot.findall("joint")
    children = {_end(joint, "child") for joint in joints}
    roots = [name for name in links if name not in children]
    if len(roots) != 1 or len(children) != len(joints):
        raise MechanismError(f"the links have {len(roots)} roots", allowed="one root, and one joint to each other link")
    left_out = list(_left_out(robot))
    names, moving = {roots[0]: GROUND}, []
    frames: dict[str, tuple[FloatArray, FloatArray]] = {roots[0]: (np.zeros(3), np.eye(3))}
    waiting = list(joints)
    while waiting:
        ready = [joint for joint in waiting if _end(joint, "parent") in frames]
        if not ready:
            raise MechanismError(f"joint {name_of(waiting[0])!r} hangs on no link of the tree")
        for joint in ready:
            parent, child, kind = _end(joint, "parent"), _end(joint, "child"), joint.get("type", "")
            if child not in links:
                raise MechanismError(f"joint {name_of(joint)!r} has an unknown link {child!r}")
            at, turned = _origin(joint, *frames[parent])
            frames[child] = at, turned
            names[child] = names[parent] if kind == "fixed" else child
            if kind == "fixed":
                continue
            if kind not in MOVING:
                given = f"joint {name_of(joint)!r} is of type {kind!r}"
                raise MechanismError(given, allowed=f"fixed, {', '.join(MOVING)}")
            element = joint.find("axis")
            axis = np.array([1.0, 0, 0]) if element is None else numbers(element, "xyz", "1 0 0")
            size = float(np.linalg.norm(axis))
            if not size > 0:
                raise MechanismError(f"the axis of joint {name_of(joint)!r} is 0")
            moving.append(SpatialJoint(name_of(joint), MOVING[kind], names[parent], child, at, turned @ axis / size))
        waiting = [joint for joint in waiting if joint not in ready]
    masses: dict[str, list[SpatialMass]] = {}
    for name, link in links.items():
        masses.setdefault(names[name], []).extend(_masses(link, *frames[name]))
    gravity = np.array([0.0, 0.0, -9.81])
    driven = [joint.name for joint in moving]
    return planar(SpatialTree(robot.get("name", "robot"), moving, (), masses, driven, gravity, left_out))


def _end(joint: Element, end: str) -> str:
    element = joint.find(end)
    if element is None:
        raise MechanismError(f"joint {name_of(joint)!r} has no {end}")
    return name_of(element, "link")


def _origin(element: Element, at: FloatArray, turned: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Frame of an element in the world, by its <origin> in a frame."""
    origin = element.find("origin")
    if origin is None:
        return at, turned
    roll, pitch, yaw = numbers(origin, "rpy", "0 0 0")
    return at + turned @ numbers(origin, "xyz", "0 0 0"), turned @ _about(2, yaw) @ _about(1, pitch) @ _about(0, roll)


def _about(axis: int, angle: float) -> FloatArray:
    """The rotation about a coordinate axis."""
    matrix = np.eye(3)
    first, second = (axis + 1) % 3, (axis + 2) % 3
    c, s = np.cos(angle), np.sin(angle)
    matrix[[first, first, second, second], [first, second, first, second]] = c, -s, s, c
    return matrix


def _masses(link: Element, at: FloatArray, turned: FloatArray) -> Iterator[SpatialMass]:
    inertial = link.find("inertial")
    mass = None if inertial is None else inertial.find("mass")
    if inertial is None or mass is None:
        return
    centre, axes = _origin(inertial, at, turned)
    element, own = inertial.find("inertia"), np.zeros((3, 3))
    if element is not None:
        for row, column in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)):
            key = f"i{'xyz'[row]}{'xyz'[column]}"
            own[row, column] = own[column, row] = number(element.get(key, "0"), key)
    yield SpatialMass(number(mass.get("value", ""), "mass"), centre, axes @ own @ axes.T)


def _left_out(robot: Element) -> Iterator[str]:
    for joint in robot.findall("joint"):
        for tag in ("limit", "mimic", "dynamics", "safety_controller"):
            if joint.find(tag) is not None:
                yield f"{tag} of joint {name_of(joint)}"
    for tag in ("transmission", "gazebo", "sensor"):
        if robot.find(tag) is not None:
            yield f"<{tag}>"
    if any(link.find(tag) is not None for link in robot.findall("link") for tag in ("visual", "collision")):
        yield "shapes of links"
