"""The cam turning under its follower: the cam's outline turns, the follower goes up and down its guide."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.programme import TURN
from ilmek.machines.animation import frames
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.parts import zero_mark
from ilmek.plane import contours
from ilmek.report import Animation, Axis, Dot, Drawing, MovingDot, MovingStroke, Reading, Stroke
from ilmek.units import mm

UP = 1j
"""The follower's way, which the formulas have along +x, is drawn upwards."""

OUTLINE = 361
CHORD = 0.05 * mm


def moving(design: CamDesign) -> Animation:
    """A turn of the cam, from the start of the rise on."""
    at = frames()
    turned = UP * np.exp(1j * at)[:, None]
    state = design.state(at)
    centre = UP * state.trace.pitch * np.exp(1j * at)
    surface = design.cam.trace(np.linspace(0.0, TURN, OUTLINE)).surface[:-1]
    bore = contours.along(design.hub.contour, CHORD)
    strokes = (
        MovingStroke(turned * surface, "outline", "cam", closed=True),
        MovingStroke(turned * bore, "outline", closed=True),
        MovingStroke(turned * zero_mark(design), "outline"),
        *_follower(design, centre),
    )
    readings = (
        Reading("lift", state.trace.course.s, "mm"),
        Reading("pressure angle", state.trace.pressure_angle, "deg"),
        Reading("contact force", state.normal, "N"),
        Reading("torque", state.torque, "N*m"),
    )
    period = TURN / design.params.speed if design.params.speed > 0 else None
    touched = MovingDot(UP * state.trace.surface * np.exp(1j * at), "", "point")
    drawing = Drawing("cam-moving", "Cam in motion", _guide(design, centre), (Dot(0j, "", "pivot"),))
    return Animation(drawing, Axis("cam angle", "deg"), at, strokes, (touched,), True, 0, period, readings)


def _reach(design: CamDesign) -> float:
    """Length of the drawn stem [m]."""
    return 2.2 * design.params.lift + 0.6 * design.cam.prime_radius


def _follower(design: CamDesign, centre: ComplexArray) -> tuple[MovingStroke, ...]:
    """What touches the cam, and the stem above it."""
    stem = centre[:, None] + UP * _reach(design) * np.array([0.0, 1.0])
    radius = design.cam.roller_radius
    if design.cam.flat:
        on_stem = UP * np.imag(centre)[:, None] + design.params.offset
        span = _face(design)
        face = on_stem + span * np.array([-1.0, 1.0])
        return (
            MovingStroke(face, "link", "flat follower"),
            MovingStroke(on_stem + UP * _reach(design) * np.array([0.0, 1.0]), "link"),
        )
    if radius == 0:
        edge = 0.12 * design.cam.prime_radius
        head = centre[:, None] + edge * np.array([-0.3 + 1j, 0.0, 0.3 + 1j])
        return MovingStroke(head, "link", closed=True), MovingStroke(stem, "link", "knife")
    circle = radius * np.exp(1j * np.linspace(0.0, TURN, 49)[:-1])
    return MovingStroke(centre[:, None] + circle, "outline", closed=True), MovingStroke(
        stem, "link", design.params.follower
    )


def _face(design: CamDesign) -> float:
    """Half length of a flat face, a tenth longer than the way of the contact on it [m]."""
    angle: FloatArray = np.linspace(0.0, TURN, OUTLINE)
    return 1.1 * float(np.max(np.abs(design.programme.at(angle).ds - design.params.offset)))


def _guide(design: CamDesign, centre: ComplexArray) -> tuple[Stroke, ...]:
    """Both walls of the guide, above the highest place of what touches the cam."""
    low = float(np.max(centre.imag)) + 1.2 * design.cam.roller_radius
    high = float(np.min(centre.imag)) + _reach(design)
    half = 0.05 * design.cam.prime_radius
    line = design.params.offset
    low = min(low, high - half)
    return tuple(Stroke(np.array([line + side + 1j * low, line + side + 1j * high]), "guide") for side in (-half, half))
