"""A machine seen from any side: the lines of its parts that nothing hides, and what is seen where.

The surfaces are drawn into a depth picture [`num.depth`]. A line of a part is an edge of its mesh whose faces meet at
more than `CREASE`, or of which only one is turned to the eye. Lines are exact to the mesh and end to a pixel where they
are hidden; a part of which no pixel is seen has none.
"""

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from ilmek.arrays import BoolArray, Complex, ComplexArray, Float, Float32, Int, Int32, IntArray
from ilmek.num.depth import draw_triangles, seen_samples
from ilmek.part.placement import Placement
from ilmek.part.shapes import CHORD, Corner, Shape, shape_box
from ilmek.records import record
from ilmek.units import deg, mm

CREASE = 40 * deg
"""Angle between faces from which their edge is drawn: the chords of small bores meet at less [rad]."""

SLACK = 1.5
"""Depth that lines may lie behind what is drawn, and be seen: rounding of slopes as steep as an isometric view has
them [pixels]."""

_MARGIN, _STEP, _SHORT = 3, 0.7, 3
"""Margin of a picture, distance of the samples of a line [pixels], and number of them from which one alone is noise."""

_COARSEST, _SMALLEST = 1 * mm, 2.5
"""Greatest deviation of meshes, below the walls of tubes [m]; extent from which a line is no spot [pixels]."""

_FACING = 1e-6
"""Share of a face's normal towards the eye from which it is seen."""

Rotation = Float[np.ndarray, "3 3"]


@record
class PlacedShape:
    """A shape where it stands.

    item   number of what it belongs to      outlined  its lines are drawn; else it only hides others
    """

    item: int
    shape: Shape
    position: Placement
    outlined: bool = True


@record
class DepthPicture:
    """What is seen of shapes from a side.

    rotation  from the axes in which they stand to those of the view: right, up, towards the eye
    pixel     size of a pixel [m]           corner  x, y and z = 0 of the first one [pixels]
    items     seen at each pixel, -1: nothing
    """

    rotation: Rotation
    pixel: float
    corner: Float[np.ndarray, " 3"]
    depth: Float32[np.ndarray, "rows columns"]
    items: Int32[np.ndarray, "rows columns"]
    edges: Float[np.ndarray, "edges 2 3"]

    def point(self, row: float, column: float) -> complex:
        """Where a pixel's centre is in the view [m]."""
        return complex(column + self.corner[0], row + self.corner[1]) * self.pixel

    def lines(self) -> list[ComplexArray]:
        """The lines that are seen, through points x + i y of the view [m]."""
        return self._seen(self.edges)

    def unhidden(self, lines: Float[np.ndarray, "lines 2 3"]) -> list[ComplexArray]:
        """What is seen of other straight lines between points [m]."""
        return self._seen(lines @ self.rotation.T / self.pixel - self.corner)

    def _seen(self, lines: Float[np.ndarray, "lines 2 3"]) -> list[ComplexArray]:
        corner = complex(self.corner[0], self.corner[1])
        seen = polylines(_unhidden(lines, self.depth))
        return [(line + corner) * self.pixel for line in seen if abs(line - line[0]).max() > _SMALLEST]


@record
class _Surface:
    """A mesh, and its edges: their points, the faces at both sides, whether these meet at an angle."""

    corners: Float[np.ndarray, "points 3"]
    triangles: IntArray
    normals: Float[np.ndarray, "triangles 3"]
    edges: Int[np.ndarray, "edges 2"]
    faces: Int[np.ndarray, "edges 2"]
    sharp: BoolArray


def depth_picture(pieces: Sequence[PlacedShape], rotation: Rotation, pixel: float) -> DepthPicture:
    """The picture of shapes, one at least, in pixels of a size [m]; meshes are as close to the shapes."""
    turned = [piece.position.points(_surface_of(piece, pixel).corners) @ rotation.T / pixel for piece in pieces]
    low = np.floor(np.min([points.min(0) for points in turned], axis=0))[:2] - _MARGIN
    high = np.ceil(np.max([points.max(0) for points in turned], axis=0))[:2] + _MARGIN
    columns, rows = (high - low).astype(int) + 1
    depth = np.full((rows, columns), -np.inf, dtype=np.float32)
    numbers = np.full((rows, columns), -1, dtype=np.int32)
    corner = np.array([*low, 0.0])
    for number, (piece, points) in enumerate(zip(pieces, turned, strict=True)):
        points -= corner
        draw_triangles(points[_surface_of(piece, pixel).triangles], number, depth, numbers)
    shown = np.unique(numbers[numbers >= 0]).tolist()
    edges = [_edges_seen(pieces[k], turned[k], rotation, pixel) for k in shown if pieces[k].outlined]
    items = np.append([piece.item for piece in pieces], -1).astype(np.int32)[numbers]
    return DepthPicture(rotation, pixel, corner, depth, items, np.concatenate([*edges, np.zeros((0, 2, 3))]))


def _surface_of(piece: PlacedShape, pixel: float) -> _Surface:
    low, high = _box(piece.shape)
    return _surface(piece.shape, max(CHORD, min(pixel, 0.01 * math.dist(low, high), _COARSEST)))


@lru_cache(maxsize=1024)
def _box(shape: Shape) -> tuple[tuple[float, ...], tuple[float, ...]]:
    low, high = shape_box(shape)
    return tuple(low.tolist()), tuple(high.tolist())


@lru_cache(maxsize=512)
def _surface(shape: Shape, deviation: float) -> _Surface:
    mesh = shape.mesh(deviation)
    corners = mesh.points[mesh.triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = across / np.maximum(np.linalg.norm(across, axis=1), 1e-300)[:, None]
    sides = np.sort(mesh.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    order = np.lexsort(sides.T)
    sides, face = sides[order], order // 3
    first = np.flatnonzero(np.append(True, (np.diff(sides, axis=0) != 0).any(1)))
    counts = np.diff(np.append(first, len(sides)))
    faces = np.stack([face[first], face[first + counts - 1]], axis=1)
    cosine = np.einsum("ij,ij->i", normals[faces[:, 0]], normals[faces[:, 1]])
    sharp = (cosine < math.cos(CREASE)) | (counts != 2)
    return _Surface(mesh.points, mesh.triangles, normals, sides[first], faces, sharp)


def _edges_seen(
    piece: PlacedShape, points: Float[np.ndarray, "points 3"], rotation: Rotation, pixel: float
) -> Float[np.ndarray, "edges 2 3"]:
    """The edges of a piece that its own surface does not hide altogether [pixels]."""
    surface = _surface_of(piece, pixel)
    facing = surface.normals @ (rotation @ piece.position.rotation)[2]
    both = facing[surface.faces]
    drawn = (both.max(1) > _FACING) & (surface.sharp | (both.min(1) < _FACING))
    return np.asarray(points[surface.edges[drawn]])


def _unhidden(
    lines: Float[np.ndarray, "lines 2 3"], depth: Float32[np.ndarray, "rows columns"]
) -> Complex[np.ndarray, "lines 2"]:
    """Starts and ends of what is seen of lines [pixels]."""
    lines = lines[_different(lines)]
    starts, ends = (np.ascontiguousarray(lines[:, end]) for end in range(2))
    along = ends - starts
    counts = np.ceil(np.linalg.norm(along[:, :2], axis=1) / _STEP).astype(int)
    seen = seen_samples(starts, ends, counts, depth, SLACK)
    owner = np.repeat(np.arange(len(counts)), counts)
    begins = np.cumsum(counts) - counts
    number = np.arange(len(owner)) - begins[owner]
    first = np.flatnonzero(seen & ((number == 0) | ~np.append(False, seen[:-1])))
    last = np.flatnonzero(seen & ((number == counts[owner] - 1) | ~np.append(seen[1:], False)))
    long = (last > first) | (counts[owner[first]] < _SHORT)
    own = owner[first[long]]
    low, high = number[first[long]] / counts[own], (number[last[long]] + 1) / counts[own]
    flat, ahead = starts[:, 0] + 1j * starts[:, 1], along[:, 0] + 1j * along[:, 1]
    return np.stack([flat[own] + low * ahead[own], flat[own] + high * ahead[own]], axis=1)


def _different(lines: Float[np.ndarray, "lines 2 3"]) -> IntArray:
    """Numbers of the lines that are no points; of those between the same pixels' quarters the nearest."""
    ends = np.sort(np.round((lines[:, :, 0] + 1j * lines[:, :, 1]) * 4), axis=1)
    order = np.argsort(-lines[:, :, 2].sum(1), kind="stable")
    order = order[ends[order, 0] != ends[order, 1]]
    _, first = np.unique(ends[order], axis=0, return_index=True)
    return np.asarray(order[np.sort(first)])


def polylines(lines: Complex[np.ndarray, "lines 2"]) -> list[ComplexArray]:
    """Straight lines as few open or closed ones: two that alone meet at a point, to a quarter of 1, are one.

    >>> polylines(np.array([[0j, 1 + 0j], [2 + 2j, 1 + 0j]]))[0].tolist()
    [0j, (1+0j), (2+2j)]
    """
    _, nodes = np.unique(np.round(lines * 4), return_inverse=True)
    nodes = nodes.reshape(-1, 2)
    others = nodes.tolist()
    meeting: list[list[int]] = [[] for _ in range(int(nodes.max(initial=-1)) + 1)]
    for number, node in enumerate(nodes.ravel().tolist()):
        meeting[node].append(number // 2)
    free = np.array([len(own) != 2 for own in meeting], dtype=bool)
    used = [False] * len(lines)
    joined = []
    # From free ends first; what is left then is closed.
    for number in np.argsort(~free[nodes].any(1), kind="stable").tolist():
        if used[number]:
            continue
        side = 0 if free[others[number][0]] or not free[others[number][1]] else 1
        points, current = [lines[number, side]], number
        while not used[current]:
            used[current] = True
            side = 1 - side
            points.append(lines[current, side])
            node = others[current][side]
            following = [own for own in meeting[node] if not used[own]]
            if free[node] or not following:
                break
            current = following[0]
            side = others[current].index(node)
        joined.append(np.array(points))
    return joined


def extents(pieces: Sequence[PlacedShape], rotation: Rotation) -> tuple[Corner, Corner]:
    """Least and greatest coordinates of shapes in the axes of a view [m]."""
    points = [piece.position.points(_corners(piece.shape)) @ rotation.T for piece in pieces]
    return np.min([own.min(0) for own in points], axis=0), np.max([own.max(0) for own in points], axis=0)


@lru_cache(maxsize=1024)
def _corners(shape: Shape) -> Float[np.ndarray, "points 3"]:
    return shape.mesh(CHORD).points
