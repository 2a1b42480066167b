"""A mechanism as other programs draw it in the plane: points, the bodies that carry them, and what joins them."""

from dataclasses import dataclass, field
from itertools import combinations
from typing import NamedTuple

from ilmek.errors import MechanismError, shortened
from ilmek.io.imports.foreign import Foreign
from ilmek.linkage.model import GROUND
from ilmek.records import JsonObject
from ilmek.units import turn

LARGEST = 200
"""Greatest number of bodies."""

SAME = 1e-9
"""Points nearer than this part of the drawing's size are in one place."""


class Drive(NamedTuple):
    """What moves an input: the body that it turns, by default the first on the pin, and its motion, if known."""

    body: str = ""
    motion: JsonObject | None = None


@dataclass(slots=True, eq=False)
class Sketch:
    """Positions [m], bodies, and joints; the ground is a body. A point of several bodies is a pin.

    slots      point -> the body with the slot in which it slides, and the slot's direction as drawn [rad]
    slides     point -> the sliding body, its guide, and the direction as drawn [rad]
    cylinders  name -> the points at its ends
    gears      name -> two wheels, each the body and the point of its centre, and their ratio, below 0 outside
    inputs     point, or cylinder -> its drive
    left_out   what has no equivalent
    """

    name: str
    points: dict[str, complex] = field(default_factory=dict)
    bodies: dict[str, list[str]] = field(default_factory=lambda: {GROUND: []})
    slots: dict[str, tuple[str, float]] = field(default_factory=dict)
    slides: dict[str, tuple[str, str, float]] = field(default_factory=dict)
    cylinders: dict[str, tuple[str, str]] = field(default_factory=dict)
    gears: dict[str, tuple[tuple[str, str], tuple[str, str], float]] = field(default_factory=dict)
    inputs: dict[str, Drive] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)
    welded: dict[str, str] = field(default_factory=dict)

    def body(self, name: str, points: list[str]) -> str:
        """A new body, by its name or, if that is taken, a like one. Raises MechanismError for an unknown point."""
        for point in points:
            if point not in self.points:
                raise MechanismError(f"{shortened(name)} has the unknown point {shortened(point)!r}")
        free = next(
            given for k in range(1, LARGEST + 2) if (given := name if k == 1 else f"{name} {k}") not in self.names
        )
        self.bodies[free] = list(dict.fromkeys(points))
        if len(self.bodies) > LARGEST:
            raise MechanismError(f"has more than {LARGEST} bodies", allowed="one mechanism of a file")
        return free

    @property
    def names(self) -> set[str]:
        """Names of all bodies, welded ones too."""
        return {*self.bodies, *self.welded}

    def own(self, body: str) -> str:
        """The body of which a welded one is a part."""
        while body in self.welded:
            body = self.welded[body]
        return body

    def carriers(self, *points: str) -> list[str]:
        """The bodies that carry all of these points."""
        return [body for body, own in self.bodies.items() if set(points) <= set(own)]

    def weld(self, *bodies: str) -> str:
        """Several bodies as one, the first of them; the ground stays the ground."""
        own = sorted(dict.fromkeys(map(self.own, bodies)), key=lambda body: body != GROUND)
        for body in own[1:]:
            self.bodies[own[0]] = list(dict.fromkeys((*self.bodies[own[0]], *self.bodies.pop(body))))
            self.welded[body] = own[0]
        return own[0]

    def foreign(self) -> Foreign:
        """The data of a mechanism file: bodies as drawn, so that the drawing shows the branches.

        Bodies that share two points, and three of which each two share one, are one body; one that hangs on a single
        point and does nothing is left away. Raises MechanismError for a drawing without a joint on the ground.
        """
        self.stiffen()
        self._lighten()
        joints: JsonObject = {}
        cylinders = self._cylinders()  # before points are given to guides
        for point in list(self.points):
            self._join(point, joints)
        if not any(GROUND in joint.get("pin", joint.get("slide", joint.get("slot"))) for joint in joints.values()):
            raise MechanismError("has no joint on the ground", do="fix at least one point")
        data: JsonObject = {"name": self.name or "mechanism", "units": "SI", "confirm": ["lengths"]}
        data["bodies"] = {
            body: {"points": {point: [self.points[point].real, self.points[point].imag] for point in points}}
            for body, points in self.bodies.items()
        }
        data["joints"] = joints
        for key, entries in (("cylinders", cylinders), ("couplings", self._couplings())):
            data |= {key: entries} if entries else {}
        data |= self._driven(joints)
        return Foreign(data, tuple(dict.fromkeys(self.left_out)))

    def stiffen(self) -> None:
        """Weld bodies that cannot move against each other."""
        while pair := self._stiff():
            self.weld(*pair)

    def _stiff(self) -> tuple[str, ...]:
        shared: dict[str, dict[str, set[complex]]] = {body: {} for body in self.bodies}
        for point in set(self.points) - set(self.slides):
            for first, second in combinations(self.carriers(point), 2):
                shared[first].setdefault(second, set()).add(self._place(point))
                shared[second].setdefault(first, set()).add(self._place(point))
        for first, others in shared.items():
            for second, places in others.items():
                if len(places) > 1:
                    return first, second
                for third in others.keys() & shared[second].keys():
                    a, b, c = (next(iter(group)) for group in (places, others[third], shared[second][third]))
                    if abs(((b - a).conjugate() * (c - a)).imag) > SAME * self._size() ** 2:
                        return first, second, third
        return ()

    def _size(self) -> float:
        middle = sum(self.points.values()) / max(len(self.points), 1)
        return max((abs(position - middle) for position in self.points.values()), default=0.0) or 1.0

    def _place(self, point: str) -> complex:
        """The position, the same for all points in one place."""
        near = (other for other in self.points.values() if abs(other - self.points[point]) <= SAME * self._size())
        return next(near)

    def _lighten(self) -> None:
        """Drop bodies that hang on one point alone, and points of no body."""
        needed = {GROUND, *(self.own(body) for body, _ in self.slots.values())}
        needed |= {self.own(body) for *pair, _ in self.slides.values() for body in pair}
        needed |= {self.own(body) for *wheels, _ in self.gears.values() for body, _ in wheels}
        for body in self.bodies.keys() - needed:
            if len({self._place(point) for point in self.bodies[body]}) < 2:
                del self.bodies[body]

    def _join(self, point: str, joints: JsonObject) -> None:
        """The pin, slide or slot in a point, if there is one."""
        carriers = self.carriers(point)
        if point in self.slides:
            slider, guide, angle = self.slides[point]
            pair = [self.own(slider), self.own(guide)]
            if pair[0] == pair[1]:
                raise MechanismError(f"the slide {shortened(point)!r} joins a body to itself")
            self._carry(point, *pair)
            joints[point] = {"slide": pair, "along": angle % turn}
            return
        if point not in self.slots:
            if len(carriers) > 1:
                joints[point] = {"pin": carriers}
            return
        guide, angle = self.own(self.slots[point][0]), self.slots[point][1]
        pinned = [body for body in carriers if body != guide]
        if not pinned:
            raise MechanismError(f"the slider {shortened(point)!r} is on no body but its guide")
        if len(pinned) > 1:
            pin = f"{point} pin"
            self.points[pin] = self.points[point]
            self._carry(pin, *pinned)
            joints[pin] = {"pin": pinned}
            for body in pinned[1:]:
                self.bodies[body].remove(point)
        self._carry(point, guide)
        joints[point] = {"slot": [pinned[0], guide], "along": angle % turn}

    def _carry(self, point: str, *bodies: str) -> None:
        for body in bodies:
            if point not in self.bodies[body]:
                self.bodies[body].append(point)

    def _end(self, point: str) -> str:
        body = next(iter(self.carriers(point)), None)
        if body is None:
            raise MechanismError(f"the cylinder's end {shortened(point)!r} is on no body")
        return f"{body}.{point}"

    def _cylinders(self) -> JsonObject:
        return {name: {"between": [self._end(point) for point in ends]} for name, ends in self.cylinders.items()}

    def _couplings(self) -> JsonObject:
        couplings: JsonObject = {}
        for name, (first, second, ratio) in self.gears.items():
            wheels = [(self.own(body), centre) for body, centre in (first, second)]
            arms = [
                body
                for body in self.bodies
                if body not in (wheels[0][0], wheels[1][0]) and {wheels[0][1], wheels[1][1]} <= set(self.bodies[body])
            ]
            if not arms:
                raise MechanismError(f"the wheels of {name} are on no common body", do="join their centres by a link")
            gears = [f"{body}.{centre}" for body, centre in wheels]
            couplings[name] = {"gears": gears, "ratio": ratio, "carrier": arms[0], "first_at": 0, "second_at": 0}
        return couplings

    def _driven(self, joints: JsonObject) -> JsonObject:
        """Inputs and their motions."""
        inputs: dict[str, str] = {}
        motions: JsonObject = {}
        for point, drive in self.inputs.items():
            joint, given, body = point, joints.get(point, {}), self.own(drive.body)
            if point in self.cylinders:
                inputs[joint] = f"{joint}.rod"
            elif "slide" in given:
                inputs[joint] = given["slide"][0]
            elif "pin" in given and body in ("", *given["pin"][1:]):
                joint = point if body in ("", given["pin"][1]) else f"{point}.{body}"
                inputs[joint] = body or given["pin"][1]
            else:
                self.left_out.append(f"the input at {point}, which moves no body")
                continue
            motions |= {joint: drive.motion} if drive.motion else {}
        return {**({"inputs": inputs} if inputs else {}), **({"motions": motions} if motions else {})}
