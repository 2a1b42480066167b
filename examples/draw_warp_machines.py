"""Draws hammer-*, shedding-*, tension-compensator-* and hand-*.svg of docs/_static: what beats, sheds, holds the warps.

Run it as `python examples/draw_warp_machines.py`; it ends with the least force of a warp over the largest.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import ilmek
from ilmek.machines.hammer import Hammer, HammerParams, design
from ilmek.report import Axis, Figure, Plot, Series
from ilmek.viz.svg import svg

CLAMPED = {
    "cloth.tension": "10N",
    "cloth.yarns.warp_stiffness": "1.8kN",
    "front_span": "170mm",
    "back_span": "170mm",
    "warp_length": "340mm",
}
"""A warp that is clamped in front of the cams and behind them."""

STATIC = Path(__file__).parents[1] / "docs" / "_static"


def report_figure(machine: str, name: str, **settings: Any) -> Figure:
    """A figure of the report of a machine."""
    return next(figure for figure in ilmek.design(machine, **settings).figures if figure.name == name)


def across(hammer: Hammer) -> Plot:
    """The force of a warp across the width: the comb bends, so that its ends press more than its middle."""
    forces = (Series("force of a warp", hammer.comb.line.x, hammer.force_across()),)
    axes = Axis("place across the width", "mm"), Axis("force of a warp", "N")
    return Plot("hammer-across", "Force of a warp across the width", *axes, forces)


def figures(hammer: Hammer) -> Iterator[tuple[str, Figure]]:
    """All figures, by the names of their files."""
    yield "hammer-fell", report_figure("hammer", "hammer-fell")
    yield "hammer-across", across(hammer)
    yield "shedding-stagger", report_figure("shedding", "shedding-stagger", phase="flattest")
    yield "shedding-draped", report_figure("shedding", "shedding-draped", **CLAMPED)
    yield "tension-compensator-side", report_figure("tension-compensator", "tension-compensator-side")
    yield "tension-compensator-tension", report_figure("tension-compensator", "tension-compensator-tension")
    yield "hand-shed-high", report_figure("hand-shed", "hand-shed-high")
    yield "hand-loom-side", report_figure("hand-loom", "hand-loom-side")


if __name__ == "__main__":
    hammer = design(HammerParams())
    for name, figure in figures(hammer):
        (STATIC / f"{name}.svg").write_text(svg(figure), encoding="utf-8")
    print(f"{hammer.comb.uniformity:.3f}")
