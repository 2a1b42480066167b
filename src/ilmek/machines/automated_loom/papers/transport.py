"""How a loom is lifted: by four vertical slings on a lifting frame, in eye bolts on its columns and its front feet.

    load of the front pair        W (z - z rear) / (z front - z rear)
    share of the right one of it  (x - x left) / (x right - x left)

W weight, x and z of the mass centre.
"""

from collections.abc import Iterator

import numpy as np

from ilmek.elements.eye_bolts import EyeBolt
from ilmek.elements.materials import GRAVITY
from ilmek.machines.automated_loom.design import LoomDesign
from ilmek.machines.automated_loom.equipment.creel_parts import CREEL, YARN_DUCT
from ilmek.machines.automated_loom.equipment.guards import GUARDS
from ilmek.machines.automated_loom.equipment.lifting_eyes import eye_bolt_of, eye_height, seats_of_eyes
from ilmek.machines.automated_loom.in_space.scene import loom_tree
from ilmek.part.moments import Moments
from ilmek.part.poses import moments_at_rest
from ilmek.part.projection import View, outlines
from ilmek.part.shapes import Corner
from ilmek.records import record
from ilmek.report import Dot, Drawing, Stroke
from ilmek.sentences import Sentence
from ilmek.units import format_quantity

_MOST_CURVES = 400


@record
class Lifting:
    """What is lifted, and the lifting points: its moments, the ids of the bodies that stay, points [m], loads [N]."""

    moments: Moments
    left: frozenset[str]
    points: tuple[Corner, ...]
    loads: tuple[float, ...]


def lifting_of(loom: LoomDesign) -> Lifting:
    """The lifting points of a loom without guards and creel: the rear pair, then the front one, the left one first."""
    tree, up = loom_tree(loom), np.array([0.0, eye_height(eye_bolt_of(loom)), 0.0])
    there = {body.id for body in tree.bodies}
    left = frozenset(name for own in (*GUARDS, CREEL, YARN_DUCT) if own in there for name in tree.carried_by(own))
    moved = moments_at_rest(tree, left)
    points = tuple(seat + up for _, seat in seats_of_eyes(loom))
    rear, front = points[:2], points[2:]
    forward = share(float(moved.centre[2]), float(rear[0][2]), float(front[0][2]))
    weight = moved.zeroth * GRAVITY
    loads = (
        weight * part * side
        for part, pair in ((1 - forward, rear), (forward, front))
        for right in [share(float(moved.centre[0]), float(pair[0][0]), float(pair[1][0]))]
        for side in (1 - right, right)
    )
    return Lifting(moved, left, points, tuple(loads))


def share(middle: float, first: float, second: float) -> float:
    """Of a load between two supports the share of the second.

    >>> share(0.25, 0.0, 1.0)
    0.25
    """
    return (middle - first) / (second - first)


def lifting_rows(lifting: Lifting, floor: float, row: EyeBolt) -> Iterator[tuple[float | str, ...]]:
    """Of each lifting point its title, x, height over the floor, z [m], its load [N], and the mass [kg] that its sling
    must bear where two of the four hang slack; its eye bolt, and the mass that this bears [kg].
    """
    titles = (
        Sentence("lift.rear-left"),
        Sentence("lift.rear-right"),
        Sentence("lift.front-left"),
        Sentence("lift.front-right"),
    )
    for title, point, load in zip(titles, lifting.points, lifting.loads, strict=True):
        x, y, z = point.tolist()
        yield title, x, y - floor, z, load, max(load / GRAVITY, lifting.moments.zeroth / 2), row.name, row.upright


def lifting_picture(loom: LoomDesign, lifting: Lifting) -> Drawing:
    """The loom from the weaver's right, its mass centre, the slings and their loads."""
    seen = [own for own in outlines(loom_tree(loom), View.SIDE) if own.body not in lifting.left]
    curves = sorted((curve for own in seen for curve in own.curves), key=lambda curve: -float(np.ptp(curve.real)))
    strokes = [Stroke(curve, "construction", closed=True) for curve in curves[:_MOST_CURVES]]
    top = max(float(curve.imag.max()) for curve in curves) + 0.3
    dots = []
    for pair in (slice(0, 2), slice(2, 4)):
        _, y, z = lifting.points[pair][0].tolist()
        load = format_quantity(sum(lifting.loads[pair]) / 2, "kN", 3)
        strokes.append(Stroke(np.array([complex(z, y), complex(z, top)]), "outline", f"2 × {load}"))
        dots.append(Dot(complex(z, y), "", "point"))
    centre = lifting.moments.centre
    dots.append(Dot(complex(centre[2], centre[1]), f"m = {format_quantity(lifting.moments.zeroth, 'kg')}", "point"))
    return Drawing("lifting", Sentence("lift.picture"), tuple(strokes), tuple(dots), unit="mm")
