"""Draws docs/_static/knot-*.svg: every knot in section, with the cuts that its word is read from.

Run it as `python examples/draw_knots.py`; it prints each knot's word and the length of its yarn, and ends with the
number of knots whose curve ties that very knot.
"""

from pathlib import Path

from ilmek.units import mm
from ilmek.viz.svg import svg
from ilmek.weaving.knots.crossings import row_of_warps
from ilmek.weaving.knots.drawing import knot_drawing
from ilmek.weaving.knots.path import KnotDimensions, KnotPath, knot_path
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
