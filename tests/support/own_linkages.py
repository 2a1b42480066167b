"""Own mechanisms for tests of their parts, and a judge of other make of what their solids run through."""

from collections.abc import Mapping, Sequence
from itertools import combinations

import manifold3d
import numpy as np

from ilmek.part.part import Part
from ilmek.part.poses import chains, poses
from ilmek.part.tree import Tree

VOLUME, DEPTH = 0.05e-6, 0.1e-3
"""Common volume [m³] and mean depth [m] of two parts that are through one another: not the slivers of facets."""


def meeting_parts(tree: Tree, number: int) -> set[tuple[str, str]]:
    """The ids of parts that are through one another in some of a number of poses, by solids of manifold3d."""
    angles = np.arange(number) * 2 * np.pi / number
    met: set[tuple[str, str]] = set()
    solids: dict[str, manifold3d.Manifold] = {}
    placed = []
    for chain in chains(tree):
        here = poses(chain, "turn", angles)
        for occurrence in chain[-1].body.occurrences:
            for position in occurrence.positions:
                placed.append((occurrence.part, here, position))
                solids.setdefault(occurrence.part.id, _solid(occurrence.part))
    for k in range(number):
        stands = []
        for part, here, position in placed:
            matrix = np.hstack(
                [here.rotation[k] @ position.rotation, (here.origin[k] + here.rotation[k] @ position.origin)[:, None]]
            )
            stands.append((part.id, solids[part.id].transform(matrix)))
        for (first, one), (other, two) in combinations(stands, 2):
            if first != other and _through(one, two):
                met.add((first, other))
    return met


def _solid(part: Part) -> manifold3d.Manifold:
    assert part.shape is not None
    mesh = part.shape.mesh()
    return manifold3d.Manifold(
        manifold3d.Mesh(np.asarray(mesh.points, np.float32), np.asarray(mesh.triangles, np.uint32))
    )


def _through(one: manifold3d.Manifold, other: manifold3d.Manifold) -> bool:
    a, b = np.array(one.bounding_box()).reshape(2, 3), np.array(other.bounding_box()).reshape(2, 3)
    if np.any(a[0] > b[1]) or np.any(b[0] > a[1]):
        return False
    common = one ^ other
    volume = abs(common.volume())
    return bool(volume > VOLUME and 2 * volume / max(common.surface_area(), 1e-12) > DEPTH)


def toml_text(
    ground: Mapping[str, tuple[float, float]], lengths: Mapping[str, float], pins: Sequence[tuple[str, str, str]]
) -> str:
    """A mechanism file of links of lengths [mm] with pins; the first pin is driven."""
    points = ", ".join(f'{name} = ["{x!r}mm", "{y!r}mm"]' for name, (x, y) in ground.items())
    links = "\n".join(f'{name}.length = "{length!r}mm"' for name, length in lengths.items())
    joints = "\n".join(f'{name}.pin = ["{first}", "{other}"]' for name, first, other in pins)
    name, _, driven = pins[0]
    return f'[bodies]\nground.points = {{ {points} }}\n{links}\n[joints]\n{joints}\n[inputs]\n{name} = "{driven}"\n'
