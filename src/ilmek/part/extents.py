"""Boxes along the axes of a tree that contain its parts, those that move over whole turns of their drives.

The box of a shape is exact for prisms and turned shapes; of one that is placed it is that of its own box, so that it
may be larger, never smaller, than the part; of a body that moves it is that of the hull about their boxes. A motion is
looked at where it is stated, and at so many angles between that a point leaves the chord of its arc by 1 / 800 of its
radius at most.
"""

import math
from collections.abc import Iterable, Iterator

import numpy as np
from scipy.spatial import ConvexHull

from ilmek.arrays import Float, FloatArray
from ilmek.part.placement import Placement
from ilmek.part.poses import Chain, chains, poses
from ilmek.part.shapes import Corner, box_corners, shape_box
from ilmek.part.tree import Tree
from ilmek.records import record
from ilmek.units import turn

_EVERY = turn / 60
"""Greatest rotation between two angles at which a motion is looked at [rad]."""

_MOST = 1000
"""Most angles of both kinds: of a beat that strikes a hundred times over a row, every few of its angles, in each stroke
others.
"""


@record
class Extent:
    """Least and greatest x, y, z of a piece of a part that stands, or of a body that moves over all that it does [m].

    part  that stands; empty: of a body that moves
    """

    part: str
    body: str
    low: Corner
    high: Corner

    @property
    def moving(self) -> bool:
        """Whether it is that of a body that moves."""
        return not self.part


def extents(tree: Tree, drives: Iterable[str]) -> tuple[Extent, ...]:
    """The boxes of all pieces that have a shape and stand, and of each body that moves, in the tree's axes.

    drives  over whose turns the bodies move, one at a time
    """
    drives, boxes = tuple(drives), dict[str, Float[np.ndarray, "8 3"]]()
    first, every = dict[tuple[str, ...], tuple[Chain, tuple[Extent, ...]]](), list[Extent]()
    for chain in chains(tree):
        names = tuple(link.name for link in chain)
        copied, boxed = first.get(names, (None, ()))
        shift = None if copied is None else _shift(copied, chain)
        if shift is None:
            first[names] = chain, tuple(_of_chain(chain, drives, boxes))
            every += first[names][1]
        else:
            every += [Extent(one.part, one.body, one.low + shift, one.high + shift) for one in boxed]
    return tuple(every)


def _shift(copied: Chain, chain: Chain) -> Corner | None:
    """By how much a chain of the same bodies lies beside another in all poses [m]; None where it is turned against it,
    or turns about the same axis.
    """
    shift, rotation, turning = np.zeros(3), np.eye(3), False
    for before, link in zip(copied, chain, strict=True):
        if before.index != link.index:
            if turning or (before.position.rotation != link.position.rotation).any():
                return None
            shift = shift + rotation @ (link.position.origin - before.position.origin)
        rotation = rotation @ link.position.rotation
        motion = link.body.joint.motion
        turning = turning or (motion is not None and bool(motion.rotation.any()))
    return shift


def around(found: Iterable[Extent]) -> tuple[Corner, Corner]:
    """The least and the greatest corner of boxes [m]. Raises ValueError where there are none."""
    found = tuple(found)
    return np.min([extent.low for extent in found], axis=0), np.max([extent.high for extent in found], axis=0)


def _of_chain(chain: Chain, drives: tuple[str, ...], boxes: dict[str, Float[np.ndarray, "8 3"]]) -> Iterator[Extent]:
    body, pieces, parts = chain[-1].body, list[Float[np.ndarray, "n 8 3"]](), list[str]()
    for occurrence in body.occurrences:
        part, positions = occurrence.part, occurrence.positions
        if part.shape is not None:
            if part.id not in boxes:
                boxes[part.id] = box_corners(*shape_box(part.shape))
            turned = np.array([position.rotation for position in positions]).transpose(0, 2, 1)
            pieces.append(boxes[part.id] @ turned + np.array([position.origin for position in positions])[:, None])
            parts += [part.id] * len(positions)
    if not pieces:
        return
    every = np.concatenate(pieces)
    moved = [(drive, angle) for drive in drives for angle in [_angles(chain, drive)] if len(angle)]
    if moved:
        points = every.reshape(-1, 3)
        hull = points[ConvexHull(points).vertices]
        lows, highs = zip(*(_swept(hull, chain, *turned) for turned in moved), strict=True)
        yield Extent("", body.id, np.min(lows, axis=0), np.max(highs, axis=0))
        return
    rest = poses(chain, "", np.zeros(1))
    placed = Placement(rest.origin[0], rest.rotation[0]).points(every)
    yield from map(Extent, parts, [body.id] * len(parts), placed.min(1), placed.max(1))


def _swept(points: Float[np.ndarray, "n 3"], chain: Chain, drive: str, angle: FloatArray) -> tuple[Corner, Corner]:
    """Least and greatest corner of points of a body over angles of a drive [m]."""
    moved = poses(chain, drive, angle)
    if any(link.turns(drive) for link in chain):
        every = moved.points(points)
        return every.min((0, 1)), every.max((0, 1))
    shifted = points @ moved.rotation[0].T
    return shifted.min(0) + moved.origin.min(0), shifted.max(0) + moved.origin.max(0)


def _angles(chain: Chain, drive: str) -> FloatArray:
    """Angles at which a chain is looked at [rad]; none where it does not move with the drive."""
    motions = [link.body.joint.motion for link in chain]
    own = [motion for motion in motions if motion is not None and motion.drive == drive]
    if not own:
        return np.empty(0)
    turned = max(float(np.abs(np.diff(motion.rotation)).sum()) for motion in own)
    between = np.linspace(0.0, turn, min(math.ceil(turned / _EVERY), _MOST) + 1)
    stated = np.unique(np.concatenate([motion.angle for motion in own]))
    return np.concatenate([between, stated[:: math.ceil(len(stated) / _MOST)]])
