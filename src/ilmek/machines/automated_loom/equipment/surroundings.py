"""The room that a loom takes, with all its motions, for what is placed round it and on it."""

from collections.abc import Iterable, Iterator
from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.errors import LoomError
from ilmek.machines.automated_loom.cabinet import CONTROL
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.in_space.machines import joined, machine_branches
from ilmek.machines.automated_loom.in_space.maker import KNOT, ROW, half_width
from ilmek.machines.weaver.tree import head_tree
from ilmek.part.extents import Extent, around, extents
from ilmek.part.part import Part
from ilmek.part.placement import Placement
from ilmek.part.shapes import Corner
from ilmek.part.tree import Occurrence, RigidBody, Tree
from ilmek.records import record
from ilmek.units import mm

GAP = 3 * mm
"""Room that is kept between what is added to a loom and its parts [m]; assumed by this project."""


@record
class Hazard:
    """A body that moves: its name, and least and greatest x, y, z of what it sweeps [m]."""

    body: str
    low: Corner
    high: Corner


@record
class Surroundings:
    """The tree of a loom's machines, and the boxes of all its pieces."""

    tree: Tree
    extents: tuple[Extent, ...]
    hazards: tuple[Hazard, ...]

    def of(self, part: str) -> tuple[Extent, ...]:
        """The boxes of the pieces of a part, from left to right. Raises LoomError where the loom has none."""
        pieces = sorted((extent for extent in self.extents if extent.part == part), key=lambda one: float(one.low[0]))
        if not pieces:
            raise LoomError(f"no part {part!r} in the loom", allowed="a part of its tree")
        return tuple(pieces)

    @property
    def standing(self) -> tuple[Corner, Corner]:
        """Corners of the box about all that stands, but the cabinet of the control [m]."""
        return around(extent for extent in self.extents if not extent.moving and extent.part != CONTROL)

    @property
    def moving(self) -> tuple[Corner, Corner]:
        """Corners of the box about all that moves [m]."""
        return np.min([hazard.low for hazard in self.hazards], axis=0), np.max(
            [hazard.high for hazard in self.hazards], axis=0
        )

    def occurrence(self, parts: Iterable[str]) -> tuple[RigidBody, Part, Placement]:
        """The body that has the first of some parts, the part, and where it lies first in that body.

        Raises LoomError where the loom has none of them.
        """
        wanted = tuple(parts)
        for name in wanted:
            for body, own in self._occurrences():
                if own.part.id == name:
                    return body, own.part, own.positions[0]
        raise LoomError(f"none of the parts {', '.join(wanted)} in the loom", allowed="parts of its tree")

    def _occurrences(self) -> Iterator[tuple[RigidBody, Occurrence]]:
        return ((body, own) for body in self.tree.bodies for own in body.occurrences)

    def free(self, low: Corner, high: Corner, *, but: str = "") -> bool:
        """Whether a box has room in the loom, over all motions; `but`: the part that carries it is not looked at."""
        lows, highs = _corners(self)
        meeting = np.flatnonzero(np.all((lows < high + GAP) & (low - GAP < highs), axis=1))
        return all(self.extents[index].part == but for index in meeting.tolist())


@lru_cache(maxsize=4)
def _corners(near: Surroundings) -> tuple[FloatArray, FloatArray]:
    """Least and greatest corners of all boxes [m], (boxes, 3)."""
    return np.array([own.low for own in near.extents]), np.array([own.high for own in near.extents])


@lru_cache(maxsize=4)
def surroundings(loom: LoomDesign) -> Surroundings:
    """The room of a loom; heads travel along the whole row, which no turn of a drive shows."""
    tree = joined(machine_branches(loom))
    found = extents(tree, (ROW, KNOT))
    row = half_width(loom) + loom.head_width / 2
    riding = {body.id for body in head_tree(loom.weaver).bodies} if loom.heads else set[str]()
    return Surroundings(
        tree, found, tuple(_widened(hazard, row) if hazard.body in riding else hazard for hazard in hazards_of(found))
    )


def hazards_of(found: Iterable[Extent]) -> Iterator[Hazard]:
    """The bodies that move, each with all that its pieces sweep."""
    bodies: dict[str, list[Extent]] = {}
    for extent in found:
        if extent.moving:
            bodies.setdefault(extent.body, []).append(extent)
    return (Hazard(name, *around(pieces)) for name, pieces in bodies.items())


def _widened(hazard: Hazard, half: float) -> Hazard:
    low, high = hazard.low.copy(), hazard.high.copy()
    low[0], high[0] = min(low[0], -half), max(high[0], half)
    return Hazard(hazard.body, low, high)
