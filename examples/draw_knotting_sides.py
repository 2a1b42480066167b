"""Draws docs/_static/knotting-sides.svg: both sides of the knotting four-bar and the yarn that they lead.

Run it as `python examples/draw_knotting_sides.py`; it prints the knot, and ends with the motor's torque in N·m.
"""

import dataclasses
from pathlib import Path

import numpy as np

from ilmek.machines.knotting_four_bar import KnottingFourBar, KnottingFourBarParams, design
from ilmek.machines.knotting_four_bar.figures import sides_drawing
from ilmek.machines.knotting_four_bar.sides import KnottingSides, hands
from ilmek.report import Drawing, Stroke
from ilmek.units import deg, mm, turn
from ilmek.viz.svg import svg
from ilmek.weaving.knots.two_hands import TwoHandKnot, knot_of_hands

OUT = Path(__file__).parents[1] / "docs" / "_static" / "knotting-sides.svg"

POSES = "(0mm,0mm,10deg) (25mm,15mm,3deg) (30mm,1mm,-25deg)"
OPENED, THICK = 30 * mm, 3 * mm
"""Distance and diameter of the two warps as drawn."""


def machine() -> tuple[KnottingFourBar, KnottingSides]:
    """The published poses, with both sides."""
    made = design(KnottingFourBarParams(poses=POSES, ground_angle=275 * deg, sides=2))
    if made.sides is None:
        raise AssertionError("two sides were asked for")
    return made, made.sides


def tied(made: KnottingFourBar, sides: KnottingSides) -> TwoHandKnot:
    """What the hands tie on the opened warps."""
    first, second = (way[made.onward] for way in hands(sides.moving.motion))
    return knot_of_hands(first, second, OPENED)


def figure(made: KnottingFourBar, sides: KnottingSides, knot: TwoHandKnot) -> Drawing:
    """The machine where the hands are nearest, the yarn and the two warps half way up it."""
    middle = knot.warps.real + 1j * float(np.mean([knot.yarn.imag.min(), knot.yarn.imag.max()]))
    ring = THICK / 2 * np.exp(1j * turn * np.arange(48) / 48)
    warps = (Stroke(warp + ring, "outline", closed=True, filled=True) for warp in middle)
    shown = sides_drawing(made, sides)
    strokes = tuple(one for one in shown.strokes if one.role != "path")
    yarn = Stroke(knot.yarn, "yarn", "yarn")
    return dataclasses.replace(shown, title=f"Both sides: {knot.name}", strokes=(*strokes, yarn, *warps))


if __name__ == "__main__":
    made, sides = machine()
    knot = tied(made, sides)
    OUT.write_text(svg(figure(made, sides, knot)), encoding="utf-8")
    print(f"{knot.name}: {knot.why}")
    print(f"{sides.torque:.4f}")
