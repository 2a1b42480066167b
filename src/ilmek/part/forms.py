"""What the making of a shape depends on: its box, volume and surface, its holes, and whether it is round.

Surfaces are exact for prisms and turned shapes, 2 pi integral of r ds; those of sums count where their members touch.
"""

import math
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ilmek.part.placement import Placement
from ilmek.part.profile import line_moment
from ilmek.part.shapes import Placed, Prism, Shape, Sum, Turned, shape_box
from ilmek.plane.contours import area, length

_ROUND = 0.85
"""Share of a circle about its axis from which a section is round: of a square it is 0.64, of a hexagon 0.83."""


class PartForm(NamedTuple):
    """What the making of a shape depends on: a box about it, volume, surface, holes, and whether it is round about z.

    size  sides of the box [m]      plain  a cylinder, bored or not, as stock has it
    """

    size: tuple[float, float, float]
    volume: float
    surface: float
    holes: int
    round: bool
    plain: bool


@lru_cache(maxsize=4096)
def form_of(shape: Shape) -> PartForm:
    """The form of a shape; of one that is no prism, turned or sum, by its mesh."""
    low, high = shape_box(shape)
    x, y, z = (high - low).tolist()
    size = (x, y, z)
    if isinstance(shape, Prism):
        section = shape.section
        surface = shape.length * perimeter(shape) + 2 * section.area
        return PartForm(size, shape.volume, surface, len(section.holes), _is_round(shape), plain=False)
    if isinstance(shape, Turned):
        surface = 2 * math.pi * sum(line_moment(contour) for contour in shape.profile.contours)
        plain = len(shape.profile.outline.points) == 4
        return PartForm(size, shape.volume, surface, 0, round=True, plain=plain)
    if isinstance(shape, Sum):
        each = [(form_of(member.shape), len(member.positions)) for member in shape.members]
        surface, holes = (sum(count * getattr(form, name) for form, count in each) for name in ("surface", "holes"))
        return PartForm(size, shape.volume, surface, int(holes), all(form.round for form, _ in each), plain=False)
    solid = shape.mesh()
    a, b, c = (solid.points[solid.triangles[:, k]] for k in range(3))
    surface = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    return PartForm(size, shape.volume, surface, 0, round=False, plain=False)


def perimeter(prism: Prism) -> float:
    """Length of all contours of a section [m]."""
    return sum(length(contour) for contour in prism.section.contours)


def _is_round(prism: Prism) -> bool:
    outline = prism.section.outline
    radius = float(np.abs(outline.points).max())
    return abs(area(outline)) > _ROUND * math.pi * radius**2


def members_of(shape: Shape) -> Iterator[tuple[Shape, Placement]]:
    """The members of a sum at each of their positions; of another shape itself."""
    for member in shape.members if isinstance(shape, Sum) else (Placed(shape),):
        for position in member.positions:
            yield member.shape, position
