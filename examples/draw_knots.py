"""Draws docs/_static/knot-*.svg: every knot in section, with the cuts that its word is read from.

Run it as `python examples/draw_knots.py`; it prints each knot's word and the length of its yarn, and ends with the
number of knots whose curve ties that very knot.
"""

from pathlib import Path

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.report import Dot, Drawing, Stroke
from ilmek.units import mm
from ilmek.viz.svg import svg
from ilmek.weaving.knots.crossings import row_of_warps
from ilmek.weaving.knots.path import KnotDimensions, KnotPath, knot_path, warp_positions
from ilmek.weaving.knots.proof import knot_of_curve
from ilmek.weaving.knots.word import SINGLE, knot

OUT = Path(__file__).parents[1] / "docs" / "_static"
DIMENSIONS = KnotDimensions(4 * mm, 1.2 * mm, 0.8 * mm, clearance=0.2 * mm, leg=5 * mm)
KNOTS = {
    "symmetric": knot("symmetric", 2),
    "open-left": knot("asymmetric", 2, opens="left"),
    "open-right": knot("asymmetric", 2, opens="right"),
    "jufti-symmetric": knot("symmetric", 2, each=2),
    "jufti-open-left": knot("asymmetric", 2, opens="left", each=2),
    "jufti-open-right": knot("asymmetric", 2, opens="right", each=2),
    "single-warp": knot(SINGLE, 2),
}
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


def ties_itself(path: KnotPath) -> bool:
    """Whether leading the end along the curve ties the knot it was made for."""
    warps = row_of_warps(7, path.dimensions.pitch)
    room = 0.99 * path.dimensions.radius
    found = knot_of_curve(lambda u: path.point(u * path.length), path.length, warps, keep_out=room)
    print(f"{found.words}: word {found.word}, yarn {path.length / mm:.2f} mm")
    return found.knot == path.knot


if __name__ == "__main__":
    paths = {name: knot_path(known, DIMENSIONS) for name, known in KNOTS.items()}
    for name, path in paths.items():
        (OUT / f"knot-{name}.svg").write_text(svg(knot_drawing(path, cuts=True)), encoding="utf-8")
    print(sum(ties_itself(path) for path in paths.values()), "of", len(paths))
