"""The scene of a hand loom: its parts, warps over the change of the shed, carpet."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.machines.automated_loom.equipment.guards import GUARDS
from ilmek.machines.automated_loom.in_space.maker import STANDS
from ilmek.machines.automated_loom.in_space.scene import carpet, phases_of, scene_of, upright
from ilmek.machines.automated_loom.in_space.standing import carpet_roll
from ilmek.machines.hand_loom.design import ACTS, HandLoom
from ilmek.machines.hand_loom.frame import branches, tree
from ilmek.machines.hand_shed.figures import strokes
from ilmek.machines.hand_shed.tree import SHED, phases, warps_across
from ilmek.report import Report
from ilmek.report.scene import Scene, SceneYarn
from ilmek.units import turn

_SAMPLES, _ARC = 73, 9
"""Angles of the change, and points of a warp on the upper cylinder."""


@lru_cache(maxsize=2)
def scene(loom: HandLoom, report: Report) -> Scene:
    """The scene of a loom, with the checks of its report at the parts that they concern."""
    layout, params = loom.layout, loom.params
    whole = scene_of(
        report,
        branches(loom),
        tree(loom),
        warps=_warps(loom),
        carpet=carpet(params.cloth, (loom.rows, loom.columns), params.pile.pile_height, layout.lower),
        roll=carpet_roll(loom.winding, layout.lower, layout.roll),
        periods=periods_of(loom),
        phases=(*phases(), *(phase for beats in loom.cyclograms[1:] for phase in phases_of(beats))),
        floor=layout.floor,
    )
    return replace(whole, guards=GUARDS if loom.drive else ())


def periods_of(loom: HandLoom) -> dict[str, float]:
    """Time of a change of the shed and back, and of two driven beats [s]."""
    return {SHED: 2 * ACTS * loom.params.hands.act_time, **{beats.name: beats.period for beats in loom.cyclograms[1:]}}


def _warps(loom: HandLoom) -> tuple[SceneYarn, ...]:
    """Rear and front warps from the fell over the rod round the upper cylinder."""
    cloth, upper, angle = loom.params.cloth, loom.layout.upper, np.linspace(0.0, turn, _SAMPLES)
    lines = {line.label: line.points for line in strokes(loom.shed, angle)}
    over = np.tile(upper.at + upper.radius * np.exp(1j * np.linspace(0.0, turn / 2, _ARC)), (_SAMPLES, 1))
    x = warps_across(loom.shed)
    rear, front, warp = x[::2], x[1::2], cloth.carpet_yarns.warp.diameter
    return (
        _yarn("rear warps", angle, np.hstack([lines["rear warps"], over]), warp, rear),
        _yarn("front warps", angle, np.hstack([lines["front warps"], over]), warp, front),
    )


def _yarn(name: str, angle: FloatArray, points: ComplexArray, diameter: float, across: FloatArray) -> SceneYarn:
    return SceneYarn(name, name, STANDS, SHED, angle, upright(points), diameter, across)
