"""Draws weft-shed.svg and weft-plan.svg of docs/_static: the weft side, by default.

Run it as `python examples/draw_weft.py`; it ends with the rows of knots that a bobbin of the straight weft lasts.
"""

from pathlib import Path

from ilmek.machines import weft
from ilmek.machines.weft.figures import plan_drawing, shed_drawing
from ilmek.report import Drawing
from ilmek.viz.svg import svg

STATIC = Path(__file__).parents[1] / "docs" / "_static"

MADE = weft.design(weft.WeftParams())


def drawings() -> tuple[Drawing, Drawing]:
    """The carrier in the shed, and the plan of shuttles and boxes."""
    return shed_drawing(MADE), plan_drawing(MADE)


if __name__ == "__main__":
    for drawing in drawings():
        (STATIC / f"{drawing.name}.svg").write_text(svg(drawing), encoding="utf-8")
    print(min(bobbin.rows for bobbin in MADE.bobbins))
