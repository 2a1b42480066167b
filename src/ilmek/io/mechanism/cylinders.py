"""Cylinders of a mechanism file: a barrel and a rod between points of two bodies, and the slide between them.

The displacement of the slide is the distance of the two points. The group that a cylinder drives has no closed form;
its pose is that of the drawing.
"""

import cmath
from collections.abc import Mapping

from ilmek.errors import MechanismError
from ilmek.io.declared import keys
from ilmek.io.mechanism.names import two_spots
from ilmek.io.schema import SourceText, Table
from ilmek.linkage.model import Body, Joint, Pin, Slide

CYLINDER = keys({"between": two_spots("its ends, of barrel and rod: each a body and its point")}, name="cylinder")

Pose = tuple[complex, float]
"""Origin [m] and angle [rad]."""


def add_cylinders(
    tables: Table, points: dict[str, dict[str, complex]], pose: dict[str, Pose], source: SourceText
) -> tuple[tuple[Body, ...], tuple[Joint, ...]]:
    """The bodies and joints of all cylinders; their ends are added to the points, and their poses where they have none.

    points  body -> name -> position in its frame [m]      pose  body -> pose; default: its frame is the world's
    Raises MechanismError with the line for an unknown body or point, and for ends that coincide as drawn.
    """
    bodies: list[Body] = []
    joints: list[Joint] = []
    for name, table in tables.items():
        barrel, rod, base, head = (f"{name}.{part}" for part in ("barrel", "rod", "base", "head"))
        with source.located("cylinders", name):
            ends = [_point(points, *end) for end in table["between"]]
            start, end = (
                origin + local * cmath.rect(1, angle)
                for (body, _), local in zip(table["between"], ends, strict=True)
                for origin, angle in [pose.get(body, (0j, 0.0))]
            )
            if start == end:
                raise MechanismError("both ends are at one place", do="draw it with a length")
        (first, _), (second, _) = table["between"]
        points[first][base], points[second][head] = ends
        bodies += [Body(barrel, {base: 0j, name: 0j}), Body(rod, {head: 0j, name: 0j})]
        joints += [Pin(base, first, barrel), Pin(head, rod, second), Slide(name, rod, barrel)]
        along = cmath.phase(end - start)
        pose.setdefault(barrel, (start, along))
        pose.setdefault(rod, (end, along))
    return tuple(bodies), tuple(joints)


def _point(points: Mapping[str, Mapping[str, complex]], body: str, point: str) -> complex:
    if body not in points or point not in points[body]:
        known = ", ".join(points.get(body, points)) or "none"
        raise MechanismError(f"there is no point {point!r} of {body!r}", allowed=f"known: {known}")
    return points[body][point]
