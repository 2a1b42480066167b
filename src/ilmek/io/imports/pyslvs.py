"""Expressions of Pyslvs: `M[J[R, P[x, y], L[link, ...]], ...]`, joints in mm with the links that each joins."""

import math
import re
from typing import NamedTuple

from ilmek.errors import MechanismError, shortened
from ilmek.io.imports.foreign import Foreign, number
from ilmek.io.imports.sketch import Sketch
from ilmek.linkage.model import GROUND
from ilmek.units import mm

JOINT = re.compile(
    r"J\[(?P<kind>R|P|RP)(,A\[(?P<angle>[^\[\]]*)\])?(,color\[[^\[\]]*\])?,P\[(?P<x>[^,\[\]]*),(?P<y>[^,\[\]]*)\]"
    r",L\[(?P<links>[^\[\]]*)\]\],?"
)
"""One joint, without blanks."""


def pyslvs_data(expression: str) -> Foreign:
    """The data of a mechanism file. Raises MechanismError for another grammar.

    R is a pin; the first link of P and RP is the guide, A its direction as drawn [deg]: the other links of P slide in
    it together, those of RP turn on a pin in its slot.
    """
    joints = _joints(re.sub(r"\s", "", re.sub(r"#[^\n]*", "", expression)))
    sketch = Sketch("mechanism")
    links: dict[str, list[str]] = {GROUND: []}
    for point, joint in joints.items():
        sketch.points[point] = joint.at
        for name in joint.links:
            links.setdefault(name, [])
        for name in joint.links if joint.kind == "R" else joint.links[1:]:
            links[name].append(point)
    sketch.bodies[GROUND] = links.pop(GROUND)
    for name, points in links.items():
        sketch.body(name, points)
    for point, joint in joints.items():
        if joint.kind == "P":
            sketch.slides[point] = sketch.weld(*joint.links[1:]), joint.links[0], joint.angle
        elif joint.kind == "RP":
            sketch.slots[point] = joint.links[0], joint.angle
    return sketch.foreign()


class _Joint(NamedTuple):
    """A joint's kind, position [m], direction [rad] and links."""

    kind: str
    at: complex
    angle: float
    links: tuple[str, ...]


def _joints(text: str) -> dict[str, _Joint]:
    """The joints of an expression without blanks, by their names."""
    joints: dict[str, _Joint] = {}
    end = len("M[")
    while match := JOINT.match(text, end):
        point, end = f"P{len(joints)}", match.end()
        x, y, angle = (number(match[key] or "0", f"{key} of {point}") for key in ("x", "y", "angle"))
        links = tuple(dict.fromkeys(name for name in match["links"].split(",") if name))
        if match["kind"] != "R" and len(links) < 2:
            raise MechanismError(f"{point} of kind {match['kind']} has {len(links)} links", allowed="2 or more")
        joints[point] = _Joint(match["kind"], complex(x, y) * mm, math.radians(angle), links)
    if not text.startswith("M[") or text[end:] != "]":
        raise MechanismError(f"is no expression of Pyslvs from {shortened(text[end:])!r} on", do="correct that joint")
    return joints
