"""Reading a sweep of a random family: places, poses, and the points that a body carries."""

from collections.abc import Mapping

import numpy as np

from benchmarks.campaign.exact import Body, Points, Reals
from benchmarks.campaign.random_linkages import Family
from ilmek.arrays import IntArray
from ilmek.linkage.batch import Sweep

NEW = {"one": "A", "two": "B"}
"""Bodies of the group, and what they hang on."""


def field(swept: Sweep, body: str, point: str, order: int) -> Points:
    """Place (order 0), velocity or acceleration of a body's point, (variants, samples)."""
    moved = swept.points[body, point]
    return np.asarray((moved.position, moved.velocity, moved.acceleration)[order])


def poses(family: Family, swept: Sweep, at: IntArray) -> dict[str, tuple[Points, Reals]]:
    """Origins and angles of the group's bodies, each variant in its own sample."""
    each = np.arange(len(family))
    found = {}
    for body, point in NEW.items():
        direction = swept.bodies[body].direction[each, at]
        place = field(swept, body, point, 0)[each, at]
        found[body] = place - direction * family.places[body, point], np.angle(direction)
    return found


def carried(family: Family, body: Body, name: str) -> Mapping[str, tuple[Points, ...]]:
    """Motions of a body's points."""
    found = {}
    for (one, point), place in family.places.items():
        if one == name:
            arm = body.direction * place
            found[point] = (
                body.origin + arm,
                body.velocity + 1j * body.omega * arm,
                body.acceleration + (1j * body.alpha - body.omega * body.omega) * arm,
            )
    return found
