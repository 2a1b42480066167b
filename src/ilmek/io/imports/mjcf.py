"""MJCF: a tree of bodies with hinges and slides, and points that close its loops. [MuJoCo, XML reference]"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.etree.ElementTree import Element

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import MechanismError
from ilmek.io.imports.foreign import Foreign, name_of, number, numbers
from ilmek.io.imports.spatial import SpatialJoint, SpatialLoop, SpatialMass, SpatialTree, planar
from ilmek.linkage.model import GROUND

KINDS = {"hinge": False, "slide": True}
"""Type of a joint -> whether it slides."""

TURNED = ("xyaxes", "zaxis")
"""Orientations that are not read."""


def mjcf_data(model: Element) -> Foreign:
    """A mechanism file's data of a <mujoco>. Raises MechanismError for one that does not move in one plane."""
    world = model.find("worldbody")
    if world is None:
        raise MechanismError("has no <worldbody>")
    for tag in ("include", "worldbody//frame", "worldbody//replicate", "worldbody//freejoint"):
        if model.find(tag) is not None:
            raise MechanismError(f"has <{tag.rpartition('/')[2]}>", do="write the whole model as one plain file")
    compiler, option = model.find("compiler"), model.find("option")
    degrees = compiler is None or compiler.get("angle", "degree") == "degree"
    walk = _Walk(model, np.pi / 180 if degrees else 1.0)
    walk.body(world, GROUND, np.zeros(3), np.eye(3))
    loops = tuple(walk.loops())
    gravity = np.array([0.0, 0.0, -9.81]) if option is None else numbers(option, "gravity", "0 0 -9.81")
    actuators = model.find("actuator")
    driven = [] if actuators is None else [element.get("joint", "") for element in actuators]
    name = model.get("model", "model")
    left_out = tuple(dict.fromkeys((*walk.left_out, *_sections(model))))
    return planar(SpatialTree(name, walk.joints, loops, walk.masses, driven, gravity, left_out))


def _sections(model: Element) -> Iterator[str]:
    for tag in ("contact", "tendon", "sensor", "keyframe", "deformable"):
        if model.find(tag) is not None:
            yield f"<{tag}>"
    equality = model.find("equality")
    for element in () if equality is None else equality:
        if element.tag != "connect":
            yield f"equality <{element.tag}> {element.get('name', '')}".rstrip()


@dataclass(slots=True)
class _Walk:
    """The tree of bodies, from the world outward, with what is found in it."""

    model: Element
    angle: float
    joints: list[SpatialJoint] = field(default_factory=list)
    masses: dict[str, list[SpatialMass]] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)
    frames: dict[str, tuple[str, FloatArray, FloatArray]] = field(default_factory=dict)

    def body(self, element: Element, carrier: str, at: FloatArray, turned: FloatArray) -> None:
        """A body, its masses and joints, then its children; carrier: the moving body on which it hangs."""
        name = GROUND if element.tag == "worldbody" else element.get("name") or f"body {len(self.frames)}"
        if name in self.frames:
            raise MechanismError(f"two bodies are named {name!r}")
        own = element.findall("joint")
        for number_of, joint in enumerate(own):
            last = number_of == len(own) - 1
            child = name if last else f"{name} {number_of + 1}"
            self.joints.append(self._joint(joint, carrier, child, at, turned))
            carrier = child
        self.frames[name] = carrier, at, turned
        inertial = element.find("inertial")
        if inertial is not None:
            self.masses.setdefault(carrier, []).append(self._mass(inertial, at, turned))
        elif element.find("geom") is not None and element.tag == "body":
            self.left_out.append(f"mass of {name} by its geoms: give <inertial>")
        for inner in element.findall("body"):
            self.body(inner, carrier, at + turned @ numbers(inner, "pos", "0 0 0"), turned @ self._turned(inner))

    def _joint(self, joint: Element, carrier: str, child: str, at: FloatArray, turned: FloatArray) -> SpatialJoint:
        default = self.model.find("default/joint")
        given = {**({} if default is None else default.attrib), **joint.attrib}
        whole = Element("joint", given)
        name, kind = given.get("name", f"{child} joint"), given.get("type", "hinge")
        if kind not in KINDS:
            raise MechanismError(f"joint {name!r} is of type {kind!r}", allowed=" or ".join(KINDS))
        if "class" in given:
            self.left_out.append(f"class {given['class']!r} of joint {name}")
        self.left_out += [f"{key} of joint {name}" for key in ("range", "ref", "stiffness", "damping") if key in given]
        axis = numbers(whole, "axis", "0 0 1")
        size = float(np.linalg.norm(axis))
        if not size > 0:
            raise MechanismError(f"the axis of joint {name!r} is 0")
        place = at + turned @ numbers(whole, "pos", "0 0 0")
        return SpatialJoint(name, KINDS[kind], carrier, child, place, turned @ axis / size)

    def _turned(self, element: Element) -> FloatArray:
        """Rotation of a frame in its parent's."""
        other = next((key for key in TURNED if key in element.attrib), None)
        if other is not None:
            raise MechanismError(f"<{element.tag}> has {other}", allowed="quat, axisangle or euler")
        if "axisangle" in element.attrib:
            given = numbers(element, "axisangle", "0 0 1 0")
            return _about(given[:3], float(given[3]) * self.angle)
        if "euler" in element.attrib:
            matrix = np.eye(3)
            for axis, angle in zip(np.eye(3), numbers(element, "euler", "0 0 0"), strict=True):
                matrix = matrix @ _about(axis, float(angle) * self.angle)
            return matrix
        quaternion = numbers(element, "quat", "1 0 0 0")
        vector = quaternion[1:]
        return _about(vector, 2 * float(np.arctan2(np.linalg.norm(vector), quaternion[0])))

    def _mass(self, inertial: Element, at: FloatArray, turned: FloatArray) -> SpatialMass:
        axes = turned @ self._turned(inertial)
        own = np.diag(numbers(inertial, "diaginertia", "0 0 0"))
        if "fullinertia" in inertial.attrib:
            xx, yy, zz, xy, xz, yz = numbers(inertial, "fullinertia", "0 0 0 0 0 0")
            own = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        centre = at + turned @ numbers(inertial, "pos", "0 0 0")
        return SpatialMass(number(inertial.get("mass", ""), "mass"), centre, axes @ own @ axes.T)

    def loops(self) -> Iterator[SpatialLoop]:
        """The points that close loops, by their anchor in the first body."""
        for count, element in enumerate(self.model.findall("equality/connect")):
            first, second = name_of(element, "body1"), element.get("body2", GROUND)
            for body in (first, second):
                if body not in self.frames:
                    raise MechanismError(f"<connect> has an unknown body {body!r}")
            carrier, at, turned = self.frames[first]
            place = at + turned @ numbers(element, "anchor", "0 0 0")
            yield SpatialLoop(element.get("name", f"connect {count + 1}"), (carrier, self.frames[second][0]), place)


def _about(axis: FloatArray, angle: float) -> FloatArray:
    """The rotation about an axis [Rodrigues]; the identity for an axis of 0."""
    size = float(np.linalg.norm(axis))
    if size == 0:
        return np.eye(3)
    x, y, z = axis / size
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix: FloatArray = np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * (k @ k)
    return matrix
