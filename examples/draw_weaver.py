"""Draws weaver-plan, -cams, -opener.svg and warp-tension-side.svg of docs/_static: head and cylinders by default.

Run it as `python examples/draw_weaver.py`; it ends with the pile yarn drawn for a knot in mm.
"""

from pathlib import Path

from ilmek.machines import warp_tension, weaver
from ilmek.machines.warp_tension.analysis import analyse
from ilmek.machines.warp_tension.figures import side_view
from ilmek.machines.weaver.opener_figures import opener_plan
from ilmek.machines.weaver.plan_view import plan_view
from ilmek.machines.weaver.report import cams_drawing
from ilmek.report import Drawing
from ilmek.units import mm
from ilmek.viz.svg import svg

STATIC = Path(__file__).parents[1] / "docs" / "_static"


HEAD = weaver.design(weaver.WeaverParams())


def drawings() -> tuple[Drawing, ...]:
    """The grippers in plan view, the cams, the opener, the three cylinders."""
    cylinders = warp_tension.design(warp_tension.WarpTensionParams())
    return plan_view(HEAD), cams_drawing(HEAD), opener_plan(HEAD.opener), side_view(analyse(cylinders))


if __name__ == "__main__":
    for drawing in drawings():
        (STATIC / f"{drawing.name}.svg").write_text(svg(drawing), encoding="utf-8")
    print(f"{HEAD.drawn / mm:.3f}")
