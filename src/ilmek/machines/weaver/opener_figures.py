"""The opener in plan view: where the warps stand with it and without it; its forces over its travel."""

import numpy as np

from ilmek.machines.weaver.design import Weaver
from ilmek.machines.weaver.opener import Opener
from ilmek.report import Axis, Drawing, Figure, Plot, Series, Stroke
from ilmek.units import format_quantity, turn

POINTS = 121
_RING = np.exp(1j * turn * np.arange(24) / 24)
_BESIDE = 3
"""Warps beside the last displaced one that are drawn."""


def opener_figures(weaver: Weaver) -> tuple[Figure, ...]:
    """The opener's plan view and its forces."""
    return opener_plan(weaver.opener), _forces(weaver.opener)


def opener_plan(opener: Opener) -> Drawing:
    """The warps beside the opened pair, and as they stand without the opener."""
    moved = opener.shifts
    natural = opener.pitch * (1.5 + np.arange(len(moved) + _BESIDE))
    stands = natural + np.concatenate([moved, np.zeros(_BESIDE)])
    radius, shown = opener.diameter / 2, 4 * opener.diameter
    # A tooth stands beside the warp that it holds away.
    outer, half = opener.aside - radius, 2 * opener.diameter
    tooth = np.array([outer, outer, outer - opener.wall, outer - opener.wall]) + 1j * half * np.array([-1, 1, 1, -1])
    strokes: list[Stroke] = []
    for side in (-1, 1):
        pair = side * opener.pair / 2
        strokes += [
            *(Stroke(side * x + radius * _RING, "outline", closed=True, filled=True) for x in (*stands,)),
            *(Stroke(side * x - 1j * shown + radius * _RING, "construction", closed=True) for x in (*natural,)),
            Stroke(pair + radius * _RING, "outline", closed=True, filled=True),
            Stroke(side * opener.pitch / 2 - 1j * shown + radius * _RING, "construction", closed=True),
            Stroke(side * tooth.real + 1j * tooth.imag, "outline", closed=True),
            Stroke(side * tooth.real[:2] + 1j * half, "construction", "tooth of the opener" if side > 0 else ""),
        ]
    number, most = 2 * len(moved), format_quantity(opener.shift, "mm", 3)
    note = f"{number} warps are displaced, by {most} at most; below, dashed: the same warps without the opener"
    return Drawing("weaver-opener", "The warps beside the opened pair", tuple(strokes), note=note)


def _forces(opener: Opener) -> Plot:
    travel = np.linspace(0.0, opener.travel, POINTS)
    one = np.ones(POINTS)
    series = (
        Series("in", travel, opener.force(travel, one)),
        Series("out", travel, opener.force(travel, -one)),
        Series("without friction", travel, opener.force(travel, 0 * one), dashed=True),
        Series("of the warps on a wall", travel, np.interp(travel, opener.positions, opener.sides), dashed=True),
    )
    axes = Axis("travel of the opener", "mm"), Axis("force", "N")
    front, back = (format_quantity(span, "mm", 3) for span in (opener.warp.front, opener.warp.back))
    note = f"fell {front} in front of the opener, next hold of the warps {back} behind it"
    return Plot("opener-force", "Forces of the opener", *axes, series, note=note)
