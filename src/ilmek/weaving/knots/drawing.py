"""Drawing of a knot in section: warps as circles, the yarn's axis, and the cuts of its word."""

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.report import Dot, Drawing, Stroke
from ilmek.weaving.knots.path import KnotPath, warp_positions

_SHARE = 1 / 40
"""Step between drawn points over the radius about a warp."""


def knot_drawing(path: KnotPath, *, cuts: bool = False) -> Drawing:
    """The knot on its warps and one neighbour on each side, the pile upwards.

    cuts  also show the cut behind each warp; crossing it is a letter of the word
    """
    size = path.dimensions
    warps = range(path.knot.warps[0] - 1, path.knot.warps[-1] + 2)
    positions = warp_positions(tuple(warps), size.pitch)
    ring = size.warp_diameter / 2 * np.exp(2j * np.pi * np.arange(72) / 72)
    strokes = [Stroke(position + ring, "outline", closed=True, filled=True) for position in positions]
    if cuts:
        lines = [_cut(position, size.radius, size.warp_diameter) for position in positions]
        strokes += [Stroke(line, "construction", str(warp)) for warp, line in zip(warps, lines, strict=True)]
    low = complex(0.0, -2.4 * size.radius if cuts else -1.7 * size.radius)
    strokes.append(Stroke(positions[1:3] + low, "dimension", "p"))
    line = path.point(path.distances(size.radius * _SHARE))
    strokes.append(Stroke(line, "yarn"))
    names = [""] * len(warps) if cuts else [str(warp) for warp in warps]
    dots = [Dot(complex(position), name, "point") for name, position in zip(names, positions, strict=True)]
    dots += [Dot(complex(line[0]), "begins", "point"), Dot(complex(line[-1]), "ends", "point")]
    letters = ", ".join(f"{letter:+d}" for letter in path.knot.word)
    note = f"word {letters}" if cuts else ""
    return Drawing("knot", path.knot.name, tuple(strokes), tuple(dots), "mm", note)


def _cut(position: complex, radius: float, diameter: float) -> ComplexArray:
    """The cut of a warp, from its back away from the pile."""
    return position - 1j * np.array([diameter / 2, 2.1 * radius])
