"""Closed surfaces of triangles of extruded and turned shapes, in the part's own axes."""

from collections.abc import Iterable, Sequence
from importlib import import_module
from typing import Any

import numpy as np

from ilmek.arrays import ComplexArray, IntArray
from ilmek.part.convex import prism_corners, ring_corners
from ilmek.plane.triangulation import triangles
from ilmek.plane.vectors import following
from ilmek.report.scene import Solid


def extruded(loops: Sequence[ComplexArray], length: float) -> Solid:
    """The prism from z = 0 to its length [m].

    loops  the outline counter-clockwise, then its holes clockwise: corners [m]
    """
    faces = triangles(loops[0], loops[1:])
    section = np.concatenate(loops)
    number = len(section)
    sides, begin = [], 0
    for loop in loops:
        corner = np.arange(begin, begin + len(loop))
        sides.append(_quads(corner, following(corner), number))
        begin += len(loop)
    return Solid(prism_corners(section, length), np.concatenate([faces[:, ::-1], faces + number, *sides]))


def _quads(corner: IntArray, after: IntArray, above: int) -> IntArray:
    """The sides between corners, those that follow, and both `above` further: two triangles each, seen from outside."""
    first = np.stack([corner, after, after + above], axis=1)
    return np.concatenate([first, np.stack([corner, after + above, corner + above], axis=1)])


def revolved(loops: Sequence[ComplexArray], deviation: float) -> Solid:
    """A profile turned about z, with as many corners round as its largest radius needs.

    loops  the outline of the profile counter-clockwise, then its holes clockwise: z + i r [m], r >= 0
    """
    number = ring_corners(max(float(loop.imag.max()) for loop in loops), deviation)
    return joined(*(_surface(loop, number) for loop in loops))


def _surface(loop: ComplexArray, number: int) -> Solid:
    """The surface that a closed line makes: a ring for each point, one point for each on the axis."""
    turned = np.exp(2j * np.pi * np.arange(number) / number)
    on_axis = loop.imag <= 0
    sizes = np.where(on_axis, 1, number)
    begins = np.cumsum(sizes) - sizes
    radii, heights = np.repeat(np.maximum(loop.imag, 0.0), sizes), np.repeat(loop.real, sizes)
    direction = np.concatenate([turned[:size] for size in sizes])
    points = np.stack([radii * direction.real, radii * direction.imag, heights], axis=1)
    around = np.arange(number)
    rings = [
        begin + (around if size > 1 else np.zeros(number, dtype=int)) for begin, size in zip(begins, sizes, strict=True)
    ]
    faces, after = [], [following(ring) for ring in rings]
    for k, ring in enumerate(rings):
        other = (k + 1) % len(rings)
        if sizes[k] > 1:
            faces.append(np.stack([ring, rings[other], after[k]], axis=1))
        if sizes[other] > 1:
            faces.append(np.stack([rings[other], after[other], after[k]], axis=1))
    return Solid(points, np.concatenate(faces))


def joined(*solids: Solid) -> Solid:
    """Several closed surfaces as one."""
    begins = np.cumsum([0, *(len(solid.points) for solid in solids[:-1])])
    return Solid(
        np.concatenate([solid.points for solid in solids]),
        np.concatenate([solid.triangles + begin for solid, begin in zip(solids, begins, strict=True)]),
    )


def without(solid: Solid, cutters: Iterable[Solid]) -> Solid:
    """A closed surface less what others enclose."""
    left = _manifold(solid)
    for cutter in cutters:
        left -= _manifold(cutter)
    mesh = left.to_mesh64()
    return Solid(np.array(mesh.vert_properties[:, :3]), np.array(mesh.tri_verts, dtype=int))


def _manifold(solid: Solid) -> Any:
    library = import_module("manifold3d")  # a linkage needs no solids
    points = np.ascontiguousarray(solid.points, float)
    return library.Manifold(library.Mesh64(points, solid.triangles.astype(np.uint64)))
