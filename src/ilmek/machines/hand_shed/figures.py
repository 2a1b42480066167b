"""Figures of the hand shed from the side: both sheds, and the change from one to the other and back."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.animation import frames
from ilmek.machines.hand_shed.design import HandShed
from ilmek.machines.hand_shed.tree import ANGLES, RISE, SWING, layout
from ilmek.report import Animation, Axis, Drawing, Figure, MovingStroke, Reading, Stroke
from ilmek.units import turn

_RING = np.exp(1j * np.linspace(0, turn, 49))
_NOTE = "the weaver sits on the right; the shed is open from the fell at 0 up to the heddles"


def figures(shed: HandShed) -> tuple[Figure, ...]:
    """Both sheds and their change, from the side."""
    return (moving(shed), still(shed, high=False), still(shed, high=True))


def strokes(shed: HandShed, angle: FloatArray) -> tuple[MovingStroke, ...]:
    """Warps, rod, heddle bar, string and lever over angles of the change [rad].

    A rear warp goes behind the rod; where its string is taut it is nearer to the front at the heddles.
    """
    params, made, half = shed.params, layout(shed), shed.rod.outer / 2
    rod = 1j * (params.rod_low + np.interp(angle, ANGLES, RISE) * (params.rod_high - params.rod_low))
    swing = shed.lift_angle * (np.interp(angle, ANGLES, SWING) - 0.5)
    bar = made.pivot - 1j * shed.arm * np.exp(1j * swing)
    end = np.array([made.end(float(one)) for one in swing])
    slack = -half * params.heddle_height / rod.imag
    warp = np.maximum(bar.real - shed.bar.outer_radius - shed.string, slack) + 1j * params.heddle_height
    fell, top, pivot = np.zeros_like(rod), np.full_like(rod, 1j * params.free_length), np.full_like(rod, made.pivot)
    return (
        MovingStroke(np.stack([fell, warp, rod - half, top], 1), "yarn", "rear warps"),
        MovingStroke(np.stack([fell, rod + half, top], 1), "yarn", "front warps"),
        MovingStroke(rod[:, None] + half * _RING, "outline", "shed rod", closed=True),
        MovingStroke(bar[:, None] + shed.bar.outer_radius * _RING, "outline", "heddle bar", closed=True),
        MovingStroke(np.stack([bar, warp], 1), "path", "string heddle"),
        MovingStroke(np.stack([bar, pivot, end], 1), "link", "lever"),
    )


def moving(shed: HandShed) -> Animation:
    """The change of the shed: rod up, strings pulled and locked, and back."""
    angle = frames()
    lines = strokes(shed, angle)
    opening = Reading("opening at the weft", _opening(shed, lines[0].points, lines[1].points), "mm")
    drawing = Drawing("hand-shed-moving", "The shed is changed by hand", (), unit="mm", note=_NOTE)
    return Animation(drawing, Axis("change of the shed and back", "deg"), angle, lines, (), readings=(opening,))


def _opening(shed: HandShed, rear: ComplexArray, front: ComplexArray) -> FloatArray:
    """Distance of both sheets at the height of the weft [m]."""
    share = shed.params.weft_height
    first, other = (points[:, 1].real * share / points[:, 1].imag for points in (rear, front))
    return np.asarray(np.abs(first - other))


def still(shed: HandShed, *, high: bool) -> Drawing:
    """A shed from the side."""
    name, title = ("high", "The rod up, the strings pulled") if high else ("low", "The rod pulled down")
    lines = strokes(shed, np.array([turn / 2 if high else 0.0]))
    drawn = tuple(
        Stroke(line.points[0], line.role, line.label, closed=line.closed, filled=line.closed) for line in lines
    )
    return Drawing(f"hand-shed-{name}", title, drawn, unit="mm", note=_NOTE)
