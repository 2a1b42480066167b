"""Draws docs/_static/knotting-head.svg and knotting-needle.svg: a head with two arms, and its needle between the warps.

Run it as `python examples/draw_knotting_head.py`; it ends with the clearance in mm.
"""

from pathlib import Path

from ilmek.machines.knotting_dyad import KnottingDyadParams, design
from ilmek.machines.knotting_dyad.figures import head_drawing, passing
from ilmek.machines.knotting_dyad.head import Head
from ilmek.report import Drawing
from ilmek.units import mm
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static"


def head() -> Head:
    """The head for the usual warps, 2 mm apart."""
    made = design(KnottingDyadParams()).head
    if made is None:
        raise SystemExit("no head was made")
    return made


def figures(made: Head) -> dict[str, Drawing]:
    """Both drawings by the names of their files."""
    return {"knotting-head": head_drawing(made), "knotting-needle": passing(made)}


if __name__ == "__main__":
    made = head()
    for name, drawing in figures(made).items():
        (OUT / f"{name}.svg").write_text(svg(drawing) + "\n", encoding="utf-8")
    print(f"{made.clearance_min / mm:.4f}")
