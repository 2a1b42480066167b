"""Draws docs/_static/loom-side.svg and loom-side-room.svg: the default loom from the side, beating with a comb.

Run it as `python examples/draw_arrangement.py`; it ends with the least distance of what moves from warps and carpet.
"""

from pathlib import Path

from ilmek.machines.automated_loom import AutomatedLoomParams, design
from ilmek.machines.automated_loom.cloth_clearances import cloth_clearances
from ilmek.machines.automated_loom.views import room, side
from ilmek.units import format_quantity
from ilmek.viz.svg import svg

OUT = Path(__file__).parents[1] / "docs" / "_static"


def drawn() -> dict[str, str]:
    """The figures of the default loom, by name."""
    loom = design(AutomatedLoomParams(beat="comb"))
    return {figure.name: svg(figure) + "\n" for figure in (side(loom), room(loom))}


def least() -> float:
    """The least distance of what moves from warps and carpet [m]."""
    return cloth_clearances(design(AutomatedLoomParams(beat="comb")))[0].value


if __name__ == "__main__":
    for name, text in drawn().items():
        (OUT / f"{name}.svg").write_text(text, encoding="utf-8")
    print(format_quantity(least(), "mm", 3))
