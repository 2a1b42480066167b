"""SolveSpace sketches: line segments of one workplane as links, their coincident ends as pins. Lengths are in mm."""

import cmath
from collections.abc import Iterator

import numpy as np

from ilmek.errors import MechanismError
from ilmek.io.imports.foreign import Foreign, number
from ilmek.io.imports.sketch import Sketch
from ilmek.linkage.model import GROUND
from ilmek.units import mm

Block = dict[str, str]

POINT, SEGMENT = "2001", "11000"
"""Types of entities: a point of a workplane, a line segment."""

LENGTHS = {"50": "equal length", "51": "ratio of lengths", "55": "equal lengths of line and arc"}
"""Types of constraints that give a length as drawn."""

ANGLES = {"120": "angle", "121": "parallel", "122": "perpendicular"}
"""Types of constraints that keep the angle of two lines."""

LEVEL = {"80": "horizontal", "81": "vertical"}
"""Types of constraints that keep the angle of a line against the ground."""


def solvespace_data(text: str) -> Foreign:
    """The data of a mechanism file. Raises MechanismError for a sketch without lines, or out of one plane.

    Points at the origin and those locked where they are dragged are the ground. A point on a line slides in it, one at
    its middle is fixed to it. Two lines with a common point and a constrained angle are one link, as is a horizontal or
    vertical line on the ground with the ground. A line has the length as drawn; distances between points are links.
    """
    entities, constraints = {}, []
    for kind, block in _blocks(text):
        if kind == "AddEntity":
            entities[block.get("Entity.h.v", "")] = block
        elif kind == "AddConstraint" and block.get("Constraint.reference", "0") == "0":
            constraints.append(block)
    drawing = _Drawing(entities, constraints)
    drawing.lines()
    for block in constraints:
        drawing.constrain(block)
    return drawing.sketch.foreign()


def _blocks(text: str) -> Iterator[tuple[str, Block]]:
    """Each record: its last line, and its keys with their values."""
    block: Block = {}
    for line in text.splitlines():
        if line.startswith("Add"):
            yield line.strip(), block
            block = {}
        elif "=" in line:
            key, _, value = line.partition("=")
            block[key] = value.strip()


class _Drawing:
    """Lines of the file as bodies of a sketch."""

    def __init__(self, entities: dict[str, Block], constraints: list[Block]) -> None:
        self.sketch = Sketch("sketch")
        self.segments = {key: block for key, block in entities.items() if block.get("Entity.type") == SEGMENT}
        own = {key: block for key, block in entities.items() if block.get("Entity.type") == POINT}
        if not self.segments or not own:
            raise MechanismError("has no line segment in a workplane", allowed="a sketch of lines")
        self.alias = {key: key for key in entities}
        for block in constraints:
            if _type(block) == "20":
                self._merge(block)
        positions = np.array([[_coordinate(block, axis) for axis in "xyz"] for block in own.values()])
        flat = np.ptp(positions, axis=0) <= 1e-9 * max(float(np.ptp(positions, axis=0).max()), 1e-9)
        if not flat.any():
            raise MechanismError("has points out of one coordinate plane", do="draw in the plane xy")
        normal = int(flat.nonzero()[0][-1])
        right, up = (axis for axis in range(3) if axis != normal)
        for key, position in zip(own, positions, strict=True):
            self.sketch.points.setdefault(self.point(key), complex(position[right], position[up]) * mm)
        self._fix(constraints, entities)
        self.bodies: dict[str, str] = {}

    def _merge(self, block: Block) -> None:
        first, second = (self._root(block.get(f"Constraint.pt{end}.v", "")) for end in "AB")
        if first in self.alias and second in self.alias:
            self.alias[max(first, second)] = min(first, second)

    def _root(self, key: str) -> str:
        while self.alias.get(key, key) != key:
            key = self.alias[key]
        return key

    def _fix(self, constraints: list[Block], entities: dict[str, Block]) -> None:
        """The ground's points: at the origin, or locked."""
        locked = {self.point(block.get("Constraint.ptA.v", "")) for block in constraints if _type(block) == "200"}
        origins = {self.point(key) for key in entities if key.startswith("0001")}
        for point in self.sketch.points:
            if point in locked | origins:
                self.sketch.bodies[GROUND].append(point)

    def point(self, key: str) -> str:
        """Name of the point with a handle; coincident ones have one name."""
        return f"P{self._root(key).lstrip('0')}"

    def lines(self) -> None:
        """A link for each line; a construction line if something needs it."""
        for key, block in self.segments.items():
            ends = [self.point(block.get(f"Entity.point[{end}].v", "")) for end in range(2)]
            if set(ends) <= set(self.sketch.points) and ends[0] != ends[1]:
                self.bodies[key] = self.sketch.body(f"L{key.lstrip('0')}", ends)

    def constrain(self, block: Block) -> None:
        """What a constraint fixes; others are listed."""
        kind, key = _type(block), block.get("Constraint.entityA.v", "")
        line, other = self.bodies.get(key), self.bodies.get(block.get("Constraint.entityB.v", ""))
        points = [self.point(block.get(f"Constraint.pt{end}.v", "")) for end in "AB"]
        known = [point for point in points if point in self.sketch.points]
        if kind == "30" and len(set(known)) == 2 and not self.sketch.carriers(*known):
            self.sketch.body(f"{known[0]}-{known[1]}", known)
        elif kind == "42" and line and known:
            self._on_line(known[0], key)
        elif kind == "70" and line and known:
            self.sketch.bodies[self.sketch.own(line)].append(known[0])
        elif kind in ANGLES and line and other and self._meet(line, other):
            self.sketch.weld(line, other)
        elif kind in LEVEL and line and self._meet(line, GROUND):
            self.sketch.weld(GROUND, line)
        elif kind not in {"20", "30", "200", *LENGTHS}:
            name = {**ANGLES, **LEVEL}.get(kind, f"of type {kind}")
            self.sketch.left_out.append(f"constraint {name} {block.get('Constraint.h.v', '').lstrip('0')}")

    def _on_line(self, point: str, key: str) -> None:
        line = self.bodies[key]
        ends = [self.point(self.segments[key].get(f"Entity.point[{end}].v", "")) for end in range(2)]
        if point not in ends:
            start, end = (self.sketch.points[name] for name in ends)
            self.sketch.slots[point] = line, cmath.phase(end - start)

    def _meet(self, first: str, second: str) -> bool:
        points = (set(self.sketch.bodies[self.sketch.own(body)]) for body in (first, second))
        return bool(set.intersection(*points)) and self.sketch.own(first) != self.sketch.own(second)


def _type(block: Block) -> str:
    return block.get("Constraint.type", "")


def _coordinate(block: Block, axis: str) -> float:
    return number(block.get(f"Entity.actPoint.{axis}", "0"), f"{axis} of point {block.get('Entity.h.v', '')}")
