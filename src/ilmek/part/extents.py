"""Boxes along the axes of a tree that contain its parts, those that move over whole turns of their drives.

The box of a shape is exact for prisms and turned shapes; of one that is placed it is that of its own box, so that it
may be larger, never smaller, than the part. Between two samples of a motion a point may leave it by the sagitta of its
arc: `SAMPLES` keep this below 1 / 2,900 of its radius.
"""

from collections.abc import Iterable, Iterator
from itertools import product

import numpy as np

from ilmek.arrays import Float
from ilmek.part.placement import Placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.shapes import Prism, Shape, Sum, Turned
from ilmek.part.tree import Tree
from ilmek.plane.contours import bounds
from ilmek.records import record
from ilmek.report.scene import SceneMotion
from ilmek.units import mm, turn

SAMPLES = 121
"""Angles of a turn at which a motion is looked at."""

_DEVIATION = 1 * mm
"""Of the convex pieces of shapes of other kinds [m]."""

Corner = Float[np.ndarray, " 3"]


@record
class Extent:
    """Least and greatest x, y, z of a piece of a part [m], over all that it does; `moving`: whether it moves."""

    part: str
    body: str
    low: Corner
    high: Corner
    moving: bool

    def meets(self, low: Corner, high: Corner, gap: float = 0.0) -> bool:
        """Whether it comes nearer to a box than a gap [m]; what touches at a gap of 0 does not meet."""
        return bool(np.all(self.low < high + gap) and np.all(low - gap < self.high))


def extents(tree: Tree, drives: Iterable[str]) -> tuple[Extent, ...]:
    """The boxes of all pieces that have a shape, in the tree's axes; one of all pieces of a part in a body that moves.

    drives  over whose turns the bodies move, one at a time
    """
    drives, boxes = tuple(drives), dict[str, Float[np.ndarray, "8 3"]]()
    return tuple(one for chain in chains(tree) for one in _of_chain(chain, drives, boxes))


def around(found: Iterable[Extent]) -> tuple[Corner, Corner]:
    """The least and the greatest corner of boxes [m]. Raises ValueError where there are none."""
    found = tuple(found)
    return np.min([one.low for one in found], axis=0), np.max([one.high for one in found], axis=0)


def shape_box(shape: Shape) -> tuple[Corner, Corner]:
    """Least and greatest corner of a shape in its own axes [m].

    >>> from ilmek.part.shapes import box
    >>> [corner.tolist() for corner in shape_box(box(2.0, 4.0, 3.0))]
    [[-1.0, -2.0, 0.0], [1.0, 2.0, 3.0]]
    """
    if isinstance(shape, Prism):
        low, high = bounds(shape.section.outline)
        return np.array([low.real, low.imag, 0.0]), np.array([high.real, high.imag, shape.length])
    if isinstance(shape, Turned):
        low, high = bounds(shape.profile.outline)
        radius = high.imag
        return np.array([-radius, -radius, low.real]), np.array([radius, radius, high.real])
    if isinstance(shape, Sum):
        placed = [
            position.points(_corners(*shape_box(member.shape)))
            for member in shape.members
            for position in member.positions
        ]
    else:
        placed = list(shape.pieces(_DEVIATION))
    return np.min([points.min(0) for points in placed], axis=0), np.max([points.max(0) for points in placed], axis=0)


def _corners(low: Corner, high: Corner) -> Float[np.ndarray, "8 3"]:
    return np.array(list(product(*zip(low.tolist(), high.tolist(), strict=True))))


def _of_chain(chain: Chain, drives: tuple[str, ...], boxes: dict[str, Float[np.ndarray, "8 3"]]) -> Iterator[Extent]:
    body = chain[-1].body
    driven = [drive for drive in drives if any(_moves(link.body.joint.motion, drive) for link in chain)]
    rest = poses(chain, "", np.zeros(1))
    here = Placement(rest.origin[0], rest.rotation[0])
    angle = np.linspace(0.0, turn, SAMPLES)
    moved = [poses(chain, drive, angle) for drive in driven]
    for occurrence in body.occurrences:
        part = occurrence.part
        if part.shape is None:
            continue
        if part.id not in boxes:
            boxes[part.id] = _corners(*shape_box(part.shape))
        pieces = [position.points(boxes[part.id]) for position in occurrence.positions]
        if not moved:
            for piece in pieces:
                points = here.points(piece)
                yield Extent(part.id, body.id, points.min(0), points.max(0), moving=False)
            continue
        low, high = np.min(pieces, axis=(0, 1)), np.max(pieces, axis=(0, 1))
        swept = np.concatenate([one.points(_corners(low, high)).reshape(-1, 3) for one in moved])
        yield Extent(part.id, body.id, swept.min(0), swept.max(0), moving=True)


def _moves(motion: SceneMotion | None, drive: str) -> bool:
    return motion is not None and motion.drive == drive
