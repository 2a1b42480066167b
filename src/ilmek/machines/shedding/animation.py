"""The shedding cams in motion: an even and an odd cam of each shaft, and the warps on them."""

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.cams.programme import TURN
from ilmek.dynamics.animation import frames
from ilmek.machines.shedding.cam_shaft import CamShaft
from ilmek.machines.shedding.design import SheddingDesign
from ilmek.report import Animation, Axis, Dot, Drawing, MovingStroke, Reading, Stroke

_OUTLINE = np.linspace(0.0, TURN, 181)[:-1]
_BEYOND = 1.3
"""Half the drawn length of warps whose holds are not given, over the radius of the guide cams."""


def moving(design: SheddingDesign) -> Animation:
    """A turn of the shafts from the side, the front of the loom on the right; the fell or the first axis at y = 0."""
    at, params, spans = frames(), design.params, design.params.spans_of_warp
    half = _BEYOND * design.first.stack.guide_radius
    front, back = spans or (0.0, 0.0)
    top = 1j * (front + design.shafts[-1].beyond + back)
    strokes, dots, still = [], [], []
    for shaft in design.shafts:
        axis = complex(-shaft.base_radius, front + shaft.beyond)
        dots.append(Dot(axis, "", "pivot"))
        still.append(Stroke(axis + shaft.stack.guide_radius * np.exp(1j * _OUTLINE), "construction", closed=True))
        for label, programme, lag in (("even", shaft.even, 0.0), ("odd", shaft.odd, TURN / 2)):
            turned = np.exp(1j * (at - lag))[:, None]
            strokes.append(MovingStroke(axis + shaft.cam.surface(_OUTLINE) * turned, "path", label, closed=True))
            tip = programme.at(at).s + 1j * axis.imag
            ends = (0j, top) if spans else (tip - 1j * half, tip + 1j * half)
            strokes.append(MovingStroke(_through(ends[0], tip, ends[1]), "path", label))
        strokes.append(MovingStroke(axis + _bore(shaft) * np.exp(1j * at)[:, None], "outline", closed=True))
    if spans:
        dots += [Dot(0j, "fell", "point"), Dot(top, "back hold", "point")]
    note = "two cams of each shaft; each lifts its warp in line with the axis, as a knife edge; dashed: guides"
    drawing = Drawing("shedding-moving", "Cams and warps in motion", tuple(still), tuple(dots), note=note)
    readings = (
        Reading("even warps", design.even.at(at).s, "mm"),
        Reading("odd warps", design.odd.at(at).s, "mm"),
        Reading("torque of all shafts", design.torque(at), "N*m"),
    )
    period = TURN / params.speed if params.speed > 0 else None
    axis_of = Axis("cam angle", "deg")
    return Animation(drawing, axis_of, at, tuple(strokes), (), period=period, readings=readings)


def _through(first: complex | ComplexArray, tip: ComplexArray, last: complex | ComplexArray) -> ComplexArray:
    """A warp from hold to hold over the tip of its cam at every frame."""
    return np.stack(np.broadcast_arrays(first, tip, last), axis=1)


def _bore(shaft: CamShaft) -> ComplexArray:
    """The square bore."""
    return shaft.shaft.bar / 2 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j])
