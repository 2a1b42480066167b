"""The cam in motion: its outline rotates, the follower moves in its guide."""

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.programme import TURN
from ilmek.cams.trace import CamTrace
from ilmek.dynamics.animation import frames
from ilmek.machines.cam import developed_cams
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.parts import cutouts, rim_radius, zero_mark
from ilmek.plane import contours
from ilmek.report import Animation, Dot, MovingDot, MovingStroke, Stroke
from ilmek.units import mm

OUTLINE = 361
CHORD = 0.05 * mm


def moving(design: CamDesign) -> Animation:
    """A turn of the cam, from the start of the rise on; a slide is drawn upright."""
    if design.params.laid_flat:
        return developed_cams.moving(design)
    at = frames()
    up = upright(design)
    turned = up * np.exp(1j * at)[:, None]
    trace = design.cam.trace(at)
    centre = up * trace.pitch * np.exp(1j * at)
    surface = design.cam.trace(np.linspace(0.0, TURN, OUTLINE)).surface[:-1]
    bores = [contours.along(hole, CHORD) for hole in cutouts(design, design.cam)]
    strokes = (
        MovingStroke(turned * surface, "outline", "cam", closed=True),
        *(MovingStroke(turned * edge, "outline", closed=True) for edge in _more_edges(design)),
        *(MovingStroke(turned * bore, "outline", closed=True) for bore in bores),
        MovingStroke(turned * zero_mark(design), "outline"),
        *_follower(design, trace, centre),
        *_second_follower(design, at),
    )
    touched = MovingDot(up * trace.surface * np.exp(1j * at), "", "point")
    dots = (Dot(0j, "", "pivot"), *((Dot(pivot_of(design), "", "pivot"),) if swings(design) else ()))
    guide = () if swings(design) else _guide(design, centre)
    return developed_cams.animated(design, at, strokes, guide, dots, (touched,))


def _more_edges(design: CamDesign) -> tuple[ComplexArray, ...]:
    """A groove's outer flank and rim; the second of two conjugate cams."""
    turn = np.linspace(0.0, TURN, OUTLINE)
    if design.params.kind == "grooved":
        return (
            design.cam.trace(turn).parallel(design.cam.roller_radius)[:-1],
            rim_radius(design) * np.exp(1j * turn)[:-1],
        )
    return (design.cams.pair.second.trace(turn).surface[:-1],) if design.cams.pair else ()


def _second_follower(design: CamDesign, at: FloatArray) -> tuple[MovingStroke, ...]:
    """The roller or face of the second conjugate cam, and its link to the first."""
    pair = design.cams.pair
    if pair is None:
        return ()
    up, (first, second) = upright(design), pair.traces(at)
    ends = [up * trace.pitch * np.exp(1j * at) for trace in (first, second)]
    if design.cam.flat:
        foot = 1j * np.imag(ends[1]) + design.params.offset
        return (MovingStroke(foot[:, None] + _face(design) * np.array([-1.0, 1.0]), "link", "second face"),)
    circle = pair.second.roller_radius * np.exp(1j * np.linspace(0.0, TURN, 49)[:-1])
    joint = np.full_like(ends[1], pivot_of(design)) if swings(design) else ends[0]
    rod = MovingStroke(np.stack([joint, ends[1]], axis=1), "link", "second roller")
    return (MovingStroke(ends[1][:, None] + circle, "outline", closed=True), rod)


def swings(design: CamDesign) -> bool:
    """Whether the follower is an arm."""
    return design.params.motion == "oscillating"


def upright(design: CamDesign) -> complex:
    """Direction in which +x of the formulas is drawn."""
    return 1 + 0j if swings(design) else 1j


def pivot_of(design: CamDesign) -> complex:
    """Pivot of an arm [m]."""
    return complex(design.params.pivot_distance)


def _reach(design: CamDesign) -> float:
    """Length of the drawn stem [m]."""
    return 2.2 * design.params.lift + 0.6 * design.cam.prime_radius


def _follower(design: CamDesign, trace: CamTrace, centre: ComplexArray) -> tuple[MovingStroke, ...]:
    """Roller, edge or face, and its stem or arm."""
    radius, name = design.cam.roller_radius, design.params.follower
    carrier = _carrier(design, trace, centre)
    if design.cam.flat:
        return (MovingStroke(carrier, "link", "flat follower"), *_stem(design, centre))
    if radius == 0:
        return (MovingStroke(carrier, "link", name),)
    circle = radius * np.exp(1j * np.linspace(0.0, TURN, 49)[:-1])
    return (MovingStroke(centre[:, None] + circle, "outline", closed=True), MovingStroke(carrier, "link", name))


def _carrier(design: CamDesign, trace: CamTrace, centre: ComplexArray) -> ComplexArray:
    """Stem, arm or face at every frame."""
    up = upright(design)
    if not design.cam.flat and swings(design):
        return np.stack([np.full_like(centre, pivot_of(design)), centre], axis=1)
    if not design.cam.flat:
        return np.asarray(centre[:, None] + up * _reach(design) * np.array([0.0, 1.0]))
    along = 1j * up * trace.normal * np.exp(1j * trace.angle)
    if not swings(design):
        return np.asarray(
            (up * np.imag(centre) + design.params.offset)[:, None] + _face(design) * np.array([-1.0, 1.0])
        )
    foot = pivot_of(design) + design.params.face_offset * along * -1j
    far = centre + 0.2 * (centre - foot)
    return np.stack([np.full_like(centre, pivot_of(design)), foot, far], axis=1)


def _stem(design: CamDesign, centre: ComplexArray) -> tuple[MovingStroke, ...]:
    """The stem of a flat face on a slide."""
    if swings(design):
        return ()
    foot = 1j * np.imag(centre)[:, None] + design.params.offset
    return (MovingStroke(foot + 1j * _reach(design) * np.array([0.0, 1.0]), "link"),)


def _face(design: CamDesign) -> float:
    """Half length of a flat face, a tenth longer than the path of the contact on it [m]."""
    angle: FloatArray = np.linspace(0.0, TURN, OUTLINE)
    return 1.1 * float(np.max(np.abs(design.programme.at(angle).ds - design.params.offset)))


def _guide(design: CamDesign, centre: ComplexArray) -> tuple[Stroke, ...]:
    """Both walls of the guide, above the highest position of the roller."""
    low = float(np.max(centre.imag)) + 1.2 * design.cam.roller_radius
    high = float(np.min(centre.imag)) + _reach(design)
    low = min(low, high - 0.05 * design.cam.prime_radius)
    line = design.params.offset + 1j * np.array([low, high])
    return (Stroke(line, "guide"), Stroke(line[::-1], "guide"))
