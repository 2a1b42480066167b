"""A tree of bodies for MuJoCo, as one file of MJCF.

    body        each body at each of its places, in its parent, with its inertia; the tree's y is up, as z is there
    geom        the convex pieces of its parts, which contact only what no joint holds to them
    joint       a hinge or a slide for each coordinate [`part.mobility`]; its range is not limited
    equality    connect, weld or joint for each closure of the tree; a transmission, its tangent at rest, is not active
    actuator    a position servo for each coordinate that no active one determines: set to the value of its motion
    numeric     `DRIVE: joint`: angle of the drive [rad] and value, in turns, straight between; `period of DRIVE` [s]
    keyframe    `start`: where every drive is at 0

What a transmission moves has a servo of its own: the law of a cam is no polynomial of its angle. Parts that are not
weighed have no mass.
[MuJoCo XML reference: https://mujoco.readthedocs.io/en/stable/XMLreference.html]
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np
from scipy.spatial import ConvexHull, HalfspaceIntersection
from scipy.spatial.transform import Rotation

from ilmek.arrays import FloatArray
from ilmek.io.colours import colour_of
from ilmek.part.mobility import BodyCoordinate, TreeMobility, rate
from ilmek.part.moments import Moments
from ilmek.part.placement import IDENTITY, Placement, placement
from ilmek.part.poses import Chain, chains
from ilmek.part.tree import Closure, JointKind, RigidBody, Tree
from ilmek.units import mm, turn

DEVIATION = 0.2 * mm
"""Deviation of the convex pieces from the parts [m]."""

COARSE, MANY = 1 * mm, 40
"""Deviation of a part that is in a body so often [m]."""

PLAY = 0.25 * mm
"""How far the faces of the pieces are moved inwards [m]: what slides on a rail does not contact it."""

_SAME_AXIS = 1e-9
"""Distance of two axes [m], and difference of their directions, that count as rounding."""

TIME_STEP = 0.5e-3
"""Time step of a simulation [s]."""

STIFF = 2 * math.pi * 60
"""Natural frequency of a servo with what it moves, alone [rad/s]; assumed by this project."""

_UP = placement(about=(1.0, 0.0, 0.0), angle=turn / 4)


def mjcf_text(tree: Tree, title: str, periods: Mapping[str, float]) -> str:
    """The text of an MJCF file.

    title    name of the model      periods  time of a turn of each drive [s], where they are known
    """
    return _Model(tree, title, periods).text


@dataclass(frozen=True)
class _Model:
    tree: Tree
    title: str
    periods: Mapping[str, float]

    @property
    def text(self) -> str:
        model = Element("mujoco", model=self.title)
        SubElement(
            model,
            "compiler",
            angle="radian",
            inertiafromgeom="false",
            balanceinertia="true",
            boundmass="1e-6",
            boundinertia="1e-12",
        )
        SubElement(model, "option", timestep=_text(TIME_STEP), integrator="implicitfast")
        defaults = SubElement(model, "default")
        SubElement(defaults, "geom", type="mesh", mass="0")
        SubElement(defaults, "equality", solref=f"{_text(2 * TIME_STEP)} 1", solimp="0.99 0.9999 1e-5")
        assets = SubElement(model, "asset")
        sky = {"builtin": "gradient", "rgb1": "0.95 0.95 0.95", "rgb2": "0.75 0.8 0.85", "width": "64", "height": "384"}
        SubElement(assets, "texture", sky, type="skybox")
        self._assets(assets)
        world = SubElement(model, "worldbody")
        SubElement(world, "light", pos="0 -3 4", dir="0 0.6 -0.8", directional="true")
        self._bodies(SubElement(world, "body", _placed(_UP), name=self.title))
        self._contacts(SubElement(model, "contact"))
        self._closures(SubElement(model, "equality"))
        self._servos(SubElement(model, "actuator"))
        self._motions(SubElement(model, "custom"))
        starts = {name: one.at("", 0.0) for name, (_, one) in zip(self.joints, self.mobility.coordinates, strict=True)}
        start = [starts[joint.attrib["name"]] for joint in world.iter("joint")]
        SubElement(SubElement(model, "keyframe"), "key", name="start", qpos=_text(*start))
        indent(model)
        return tostring(model, encoding="unicode") + "\n"

    @cached_property
    def mobility(self) -> TreeMobility:
        return TreeMobility(self.tree)

    @cached_property
    def places(self) -> Mapping[Chain, str]:
        """Name of each body at each of its places."""
        counts, numbers, names = self.tree.counts(), dict[str, int](), dict[Chain, str]()
        for chain in chains(self.tree):
            body = chain[-1].name
            numbers[body] = numbers.get(body, 0) + 1
            names[chain] = body if counts[body] == 1 else f"{body} {numbers[body]}"
        return names

    @cached_property
    def joints(self) -> tuple[str, ...]:
        """Name of the joint of each coordinate: that of its body; of several of a body each with what it does."""
        chains_of_them = [chain for chain, _ in self.mobility.coordinates]
        names = []
        for chain, one in self.mobility.coordinates:
            body = self.places[chain]
            does = "turn" if one.turns else f"slide along {'xyz'[int(np.argmax(np.abs(one.axis)))]}"
            names.append(body if chains_of_them.count(chain) == 1 else f"{body}: {does}")
        return tuple(names)

    @cached_property
    def pieces(self) -> Mapping[str, tuple[FloatArray, ...]]:
        """Corners of the convex pieces of each part, by its id."""
        return {
            part.id: tuple(map(_smaller, part.shape.pieces(COARSE if number >= MANY else DEVIATION)))
            for part, number in self.tree.occurrences()
            if part.shape is not None
        }

    def _assets(self, assets: Element) -> None:
        for name, pieces in self.pieces.items():
            for number, corners in enumerate(pieces):
                # The inertia of a mesh is not used; that of a shell is defined for every thickness.
                SubElement(assets, "mesh", name=f"{name}:{number}", vertex=_text(*corners.ravel()), inertia="shell")

    def _bodies(self, root: Element) -> None:
        elements: dict[Chain, Element] = {(): root}
        numbers: dict[Chain, list[int]] = {}
        for number, (chain, _) in enumerate(self.mobility.coordinates):
            numbers.setdefault(chain, []).append(number)
        for chain in chains(self.tree):
            link = chain[-1]
            element = SubElement(elements[chain[:-1]], "body", _placed(link.position), name=self.places[chain])
            elements[chain] = element
            for number in numbers.get(chain, ()):
                _joint(element, self.joints[number], self.mobility.coordinates[number][1])
            _inertial(element, link.body.moments)
            for occurrence in link.body.occurrences:
                colour, pieces = _text(*colour_of(occurrence.part)), self.pieces.get(occurrence.part.id, ())
                for placed in map(_placed, occurrence.positions):
                    for number in range(len(pieces)):
                        SubElement(element, "geom", placed, mesh=f"{occurrence.part.id}:{number}", rgba=colour)

    def _contacts(self, contact: Element) -> None:
        """Bodies that a joint holds together do not contact each other."""
        closed = (places for closure, *places in self.mobility.closed if not _transmits(closure))
        pairs = dict.fromkeys(
            frozenset((self.places[first], self.places[other])) for first, other in (*self._held(), *closed)
        )
        for pair in pairs:
            first, other = sorted(pair)
            SubElement(contact, "exclude", body1=first, body2=other)

    def _held(self) -> Iterator[tuple[Chain, Chain]]:
        """Each moving body and its parent, and what is fixed with its parent, or turns on it about the same axis, and
        has a seat of its joint.
        """
        for chain in dict.fromkeys(chain for chain, _ in self.mobility.coordinates):
            if chain[:-1]:
                yield chain, chain[:-1]
            seats = {seat.rpartition(":")[0] for seat in chain[-1].body.joint.seats}
            for other in self.places:
                on_it = _fixed_with(other) == _fixed_with(chain[:-1]) or _coaxial(chain, other)
                if on_it and seats & _parts(other[-1].body):
                    yield chain, other

    def _closures(self, equality: Element) -> None:
        for closure, first, other in self.mobility.closed:
            if _transmits(closure):
                self._transmission(equality, closure, first, other)
                continue
            if closure.kind == JointKind.ROLLING:
                names = (self._turning(place) for place in (other, first))
                joints = dict(zip(("joint1", "joint2"), names, strict=True))
                SubElement(equality, "joint", joints, polycoef=_text(0, closure.ratio, 0, 0, 0))
                continue
            bodies = {"body1": self.places[first], "body2": self.places[other]}
            if closure.kind == JointKind.FIXED:
                SubElement(equality, "weld", bodies)
            else:
                SubElement(equality, "connect", bodies, anchor=_text(*closure.position.origin))

    def _transmission(self, equality: Element, closure: Closure, first: Chain, other: Chain) -> None:
        numbers = self.mobility.transmission(closure, first, other)
        if numbers is None:
            return
        leading, following = (self.mobility.coordinates[number][1] for number in numbers)
        drive = leading.motion.drive if leading.motion is not None else ""
        slope, (start, own) = rate(leading, following, drive, 0.0), (one.at(drive, 0.0) for one in (leading, following))
        names = dict(zip(("joint2", "joint1"), (self.joints[number] for number in numbers), strict=True))
        curve = _text(own - slope * start, slope, 0, 0, 0)
        SubElement(equality, "joint", names, polycoef=curve, active="false")

    def _turning(self, chain: Chain) -> str:
        coordinates = zip(self.joints, self.mobility.coordinates, strict=True)
        return next(name for name, (own, one) in coordinates if own == chain and one.turns)

    def _servos(self, actuator: Element) -> None:
        active = (closure for closure in self.tree.closures if not _transmits(closure))
        for number in TreeMobility(Tree(self.tree.bodies, tuple(active))).driven:
            chain, one = self.mobility.coordinates[number]
            stiffness = max(self._inertia(chain, one), 1e-6) * STIFF**2
            name = self.joints[number]
            SubElement(actuator, "position", name=name, joint=name, kp=_text(stiffness), dampratio="1")

    def _inertia(self, chain: Chain, one: BodyCoordinate) -> float:
        """Mass of all that a coordinate moves [kg], or its inertia about the coordinate's axis [kg m²], at rest."""
        moved = self._moments[chain]
        if not one.turns:
            return moved.zeroth
        about = moved.placed(Placement(-np.array(one.point), np.eye(3))).second
        axis = np.array(one.axis)
        return float(np.trace(about) - axis @ about @ axis)

    @cached_property
    def _moments(self) -> Mapping[Chain, Moments]:
        """Moments of the mass of each body with all that it carries, in its own frame."""
        moments = {chain: chain[-1].body.moments for chain in self.places}
        for chain in reversed(tuple(self.places)):
            if chain[:-1]:
                moments[chain[:-1]] += moments[chain].placed(chain[-1].position)
        return moments

    def _motions(self, custom: Element) -> None:
        for drive, period in self.periods.items():
            SubElement(custom, "numeric", name=f"period of {drive}", data=_text(period))
        for name, (_, one) in zip(self.joints, self.mobility.coordinates, strict=True):
            if one.motion is not None and one.value is not None:
                data = np.stack([one.motion.angle, one.value], axis=1)
                SubElement(custom, "numeric", name=f"{one.motion.drive}: {name}", data=_text(*data.ravel()))


def _transmits(closure: Closure) -> bool:
    return closure.kind == JointKind.TRANSMISSION


def _smaller(corners: FloatArray) -> FloatArray:
    """Corners of the convex body within another, `PLAY` from its faces; at most half as far as its middle is."""
    return np.asarray((corners[0] + _inset((corners - corners[0]).round(9).tobytes())).round(9))


@lru_cache(maxsize=256)
def _inset(content: bytes) -> FloatArray:
    corners = np.frombuffer(content).reshape(-1, 3)
    faces = np.unique(ConvexHull(corners).equations.round(9), axis=0)
    middle = corners.mean(axis=0)
    inwards = min(PLAY, float(np.min(-faces[:, :3] @ middle - faces[:, 3])) / 2)
    within = HalfspaceIntersection(faces + inwards * np.eye(4)[3], middle).intersections
    return np.unique(within.round(9), axis=0)


def _joint(element: Element, name: str, one: BodyCoordinate) -> None:
    kind = "hinge" if one.turns else "slide"
    SubElement(element, "joint", name=name, type=kind, axis=_text(*one.axis), pos=_text(*one.point))


def _inertial(element: Element, moments: Moments) -> None:
    if moments.zeroth > 0:
        inertia = moments.inertia
        tensor = _text(*np.diag(inertia), inertia[0, 1], inertia[0, 2], inertia[1, 2])
        SubElement(element, "inertial", mass=_text(moments.zeroth), pos=_text(*moments.centre), fullinertia=tensor)


def _fixed_with(chain: Chain) -> Chain:
    """The chain of the body that moves, or the ground, with which a body is fixed."""
    while chain and not _moves(chain[-1].body):
        chain = chain[:-1]
    return chain


def _moves(body: RigidBody) -> bool:
    return body.joint.motion is not None or body.joint.kind not in {JointKind.FIXED, JointKind.MISSING}


def _coaxial(chain: Chain, other: Chain) -> bool:
    """Whether two bodies, not one at two positions, turn about the same axis on the same parent."""
    first, its = chain[-1], other[-1]
    kinds = {first.body.joint.kind, its.body.joint.kind}
    if first.body.id == its.body.id or chain[:-1] != other[:-1] or kinds != {JointKind.PIN}:
        return False
    axis = first.position.rotation @ first.body.joint.axis
    along = np.stack([its.position.rotation @ its.body.joint.axis, its.position.origin - first.position.origin])
    return bool(np.abs(np.cross(along, axis)).max() < _SAME_AXIS)


def _parts(body: RigidBody) -> set[str]:
    return {occurrence.part.id for occurrence in body.occurrences}


def _placed(position: Placement) -> dict[str, str]:
    """The attributes of a position; none of the frame itself."""
    if position is IDENTITY:
        return {}
    quaternion = Rotation.from_matrix(position.rotation).as_quat(scalar_first=True)
    return {"pos": _text(*position.origin), "quat": _text(*quaternion)}


def _text(*numbers: float) -> str:
    return " ".join(f"{number:.12g}" for number in numbers)
