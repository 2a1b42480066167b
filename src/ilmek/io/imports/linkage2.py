"""`.linkage2` files of Linkage: connectors, links, sliders, actuators, gears and chains. Coordinates are 1/96 inch."""

import cmath
import math
from xml.etree.ElementTree import Element

from ilmek.errors import MechanismError, shortened
from ilmek.io.imports.foreign import Foreign, name_of, number
from ilmek.io.imports.sketch import Drive, Sketch
from ilmek.linkage.model import GROUND
from ilmek.records import JsonObject
from ilmek.units import inch, minute, turn

UNIT = inch / 96
"""Length of one unit of the coordinates [m]."""

MECHANISM = 16
"""Bit of the layer with the mechanism; other layers are drawings."""

ON_ARC = 1e-3
"""Greatest distance of a slider from its arc, as part of the radius."""


def linkage2_data(root: Element) -> Foreign:
    """The data of a mechanism file. Raises MechanismError for connectors or sliders that do not fit together.

    A slider moves on the straight line through its two limits, or on the arc through them; both limits are points of
    one link, or anchors. Its ends are not stops. An actuator of length l as drawn goes to l + throw and back.
    """
    reader = _Reader(root)
    reader.links()
    reader.sliders()
    reader.ratios()
    return reader.sketch.foreign()


class _Reader:
    """The elements of a file, added to a sketch one kind after the other."""

    def __init__(self, root: Element) -> None:
        self.root = root
        self.sketch = Sketch("linkage")
        self.connectors = {name_of(entry, "id"): entry for entry in root.findall("connector") if _in_mechanism(entry)}
        self.elements = [entry for tag in ("Link", "element") for entry in root.findall(tag) if _in_mechanism(entry)]
        self.bodies: dict[str, str] = {}
        if len(self.connectors) < len(root.findall("connector")):
            self.sketch.left_out.append("drawing and measuring elements")
        for key, entry in self.connectors.items():
            at = complex(_attribute(entry, "x"), _attribute(entry, "y"))
            self.sketch.points[_point(key)] = at * UNIT
            if _is(entry, "anchor"):
                self.sketch.bodies[GROUND].append(_point(key))

    def links(self) -> None:
        """Bodies and actuators; fastened ones are one body, and those on one motor turn together."""
        for element in self.elements:
            keys = [name_of(entry, "id") for entry in element.findall("connector")]
            points = [_point(key) for key in keys if key in self.connectors]
            if _is(element, "actuator"):
                self._actuator(element, points)
            elif points:
                key = name_of(element, "id")
                fastened = [_point(name_of(entry, "id")) for entry in element.findall("fastenconnector")]
                given = element.get("name") or f"L{key}"
                self.bodies[key] = self.sketch.body(given, [*points, *fastened])
        for element in self.elements:
            pair = [self.bodies.get(element.get(key, "")) for key in ("id", "fastenlink")]
            if pair[0] and pair[1]:
                self.sketch.weld(pair[0], pair[1])
        for key, entry in self.connectors.items():
            carrier = self.bodies.get(entry.get("fastenlink", ""))
            if carrier:
                self.sketch.bodies[self.sketch.own(carrier)].append(_point(key))
        self.sketch.stiffen()  # a link on two anchors does not turn with a motor on one of them
        for key, entry in self.connectors.items():
            if _is(entry, "input"):
                self._motor(_point(key), entry)

    def sliders(self) -> None:
        """Points in slots, on straight lines and arcs."""
        for key, entry in self.connectors.items():
            if not _is(entry, "slider"):
                continue
            limits = [_point(name_of(limit, "id")) for limit in entry.findall("slidelimit")]
            if len(limits) != 2 or not set(limits) <= set(self.sketch.points):
                raise MechanismError(f"slider {key} has {len(limits)} limits", allowed="2 connectors")
            guides = self.sketch.carriers(*limits)
            if not guides:
                raise MechanismError(f"slider {key} has limits on no common link")
            start, end = (self.sketch.points[limit] for limit in limits)
            if start == end:
                raise MechanismError(f"the limits of slider {key} are in one place")
            radius = _attribute(entry, "slideradius", "0") * UNIT
            if radius:
                self._arc(_point(key), guides[0], start, end, abs(radius))
            else:
                self.sketch.slots[_point(key)] = guides[0], cmath.phase(end - start)

    def ratios(self) -> None:
        """Pairs of gears, or of sprockets with a chain."""
        for ratio in self.root.iterfind("ratios/ratio"):
            ends = ratio.findall("link")
            keys = [name_of(end, "id") for end in ends]
            if len(ends) != 2 or not set(keys) <= self.bodies.keys():
                raise MechanismError(f"a ratio has the links {shortened(', '.join(keys))}", allowed="2 gears")
            sizes = [_attribute(end, "size") for end in ends]
            if not min(sizes) > 0:
                raise MechanismError(f"a gear has size {min(sizes):g}", allowed="above 0")
            sense = 1 if ratio.get("type") == "chain" else -1
            first, second = ((self.bodies[key], self._centre(key)) for key in keys)
            self.sketch.gears[f"ratio {keys[0]}-{keys[1]}"] = first, second, sense * sizes[0] / sizes[1]

    def _centre(self, key: str) -> str:
        gear = next(element for element in self.elements if element.get("id") == key)
        return _point(name_of(gear.findall("connector")[0], "id"))

    def _motor(self, point: str, entry: Element) -> None:
        """A motor on an anchor; a positive speed is taken as clockwise."""
        turned = [body for body in self.sketch.carriers(point) if body != GROUND]
        speed = -_attribute(entry, "rpm", "15") * turn / minute
        body = self.sketch.weld(*turned) if turned else ""
        self.sketch.inputs[point] = Drive(body, {"speed": speed} if speed else None)
        self.sketch.left_out.append(f"the sense of {point}: a positive rpm is taken as clockwise")

    def _actuator(self, element: Element, points: list[str]) -> None:
        key = f"C{name_of(element, 'id')}"
        name = next(name for k in range(len(self.elements) + 1) if (name := key + "'" * k) not in self.sketch.cylinders)
        if len(points) != 2:
            raise MechanismError(f"actuator {name} has {len(points)} connectors", allowed="2")
        start, end = (self.sketch.points[point] for point in points)
        throw, rate = _attribute(element, "throw", "0") * UNIT, _attribute(element, "cpm", "15") / minute
        length, half = abs(end - start), 1 / (2 * abs(rate)) if rate else 1.0
        steps: list[JsonObject] = [{"to": length + throw, "time": half}, {"to": length, "time": half}]
        self.sketch.cylinders[name] = points[0], points[1]
        self.sketch.inputs[name] = Drive("", {"start": length, **({"steps": steps} if throw else {})})
        self.sketch.left_out.append(f"the law of motion of {name}: 3-4-5 steps by its throw and rate")

    def _arc(self, point: str, guide: str, start: complex, end: complex, radius: float) -> None:
        """A massless link from the middle of the arc to the slider."""
        half, middle = abs(end - start) / 2, (start + end) / 2
        if radius < half:
            raise MechanismError(f"the arc of slider {point} has a radius below half the distance of its limits")
        rise = 1j * (end - start) / (2 * half) * math.sqrt(radius**2 - half**2)
        position = self.sketch.points[point]
        centre = min((middle + rise, middle - rise), key=lambda at: abs(abs(position - at) - radius))
        if abs(abs(position - centre) - radius) > ON_ARC * radius:
            raise MechanismError(f"slider {point} is not on its arc")
        self.sketch.points[f"{point} arc"] = centre
        self.sketch.body(f"{point} arc", [f"{point} arc", point])
        self.sketch.bodies[self.sketch.own(guide)].append(f"{point} arc")


def _point(key: str) -> str:
    return f"P{key}"


def _is(element: Element, key: str) -> bool:
    return element.get(key) == "true"


def _in_mechanism(element: Element) -> bool:
    layer = element.get("layer", "0")
    drawn = layer.isdecimal() and int(layer) and not int(layer) & MECHANISM
    return not drawn and not _is(element, "measurementelement")


def _attribute(element: Element, key: str, default: str = "") -> float:
    return number(element.get(key, default), f"{key} of <{shortened(element.tag)}> {element.get('id', '')}".rstrip())
