"""Barrel, end and wedge cams laid flat: the drawing, the strip passing under its roller, the wedge's outline.

In the development the follower moves along +x and the cam along -y (`ilmek.cams.strip`); it is drawn rotated by a
quarter turn, the follower upwards and the cam moving to the left.
"""

import math

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.programme import TURN
from ilmek.dynamics.animation import FRAMES
from ilmek.machines.cam.design import CamDesign
from ilmek.num.piecewise import integral
from ilmek.report import Animation, Axis, Dot, Drawing, MovingDot, MovingStroke, Reading, Stroke
from ilmek.units import format_quantity

POINTS = 721
_CIRCLE = np.exp(1j * np.linspace(0.0, TURN, 61))


def drawing(design: CamDesign) -> Drawing:
    """The cam laid flat, to scale: flanks, pitch curve, roller where the rise begins."""
    end = float(design.cam.knots[-1])
    angle = np.linspace(0.0, end, POINTS)
    trace, radius = design.cam.trace(angle), design.cam.roller_radius
    low, high = axial_ends(design)
    corners = np.array([1j * low, design.cam.prime_radius * end + 1j * low])
    tops = corners + 1j * (high - low)
    surface = 1j * trace.surface
    block = np.concatenate([corners, tops[::-1] if design.params.led else surface[::-1]])
    flanks = [Stroke(surface, "outline", "lower flank")] if design.params.led else []
    if design.params.led:
        flanks.append(Stroke(1j * trace.parallel(radius), "outline", "upper flank"))
    roller = (Stroke(1j * complex(trace.pitch[0]) + radius * _CIRCLE, "link", _roller_name(design), closed=True),)
    strokes = (
        Stroke(block, "outline", _NAMES[design.params.kind], closed=True, filled=True),
        *flanks,
        *((Stroke(1j * trace.pitch, "path", "pitch curve"), *roller) if radius > 0 else ()),
        Stroke(corners, "dimension", format_quantity(design.cam.prime_radius * end, "mm")),
    )
    mean = format_quantity(design.cam.prime_radius, "mm")
    laid = "the plate" if design.params.kind == "wedge" else f"laid flat at the mean radius {mean}"
    return Drawing("cam", "Cam, to scale", strokes, note=f"{laid}; it moves to the left, the follower upwards")


def moving(design: CamDesign) -> Animation:
    """The strip under its roller: a barrel rotates on, a wedge moves to and fro."""
    cam, wedge = design.cam, design.params.kind == "wedge"
    end = float(cam.knots[-1])
    at = np.linspace(0.0, end, FRAMES) if wedge else np.arange(FRAMES) * (TURN / FRAMES)
    along = np.linspace(0.0, end, POINTS // 3) if wedge else np.linspace(-0.75 * TURN, 1.75 * TURN, POINTS)
    trace = cam.trace(along)
    shift = -cam.prime_radius * at[:, None]
    low, _ = axial_ends(design)
    curves = [trace.surface, *([trace.parallel(cam.roller_radius)] if design.params.led else [])]
    if wedge:
        ends = np.array([cam.prime_radius * end + 1j * low, 1j * low])
        curves = [np.concatenate([trace.surface, -1j * ends])]
    centre = 1j * design.programme.at(at).s
    stem = centre[:, None] + 1j * np.array([0.0, 2.5 * design.params.lift + 2 * cam.roller_radius])
    strokes = (
        *(MovingStroke(shift + 1j * curve, "outline", closed=wedge) for curve in curves),
        MovingStroke(centre[:, None] + cam.roller_radius * _CIRCLE[:-1], "outline", closed=True),
        MovingStroke(stem, "link", design.params.follower),
    )
    return animated(design, at, strokes, _guide(design), turns=not wedge)


def animated(  # noqa: PLR0917
    design: CamDesign,
    at: FloatArray,
    strokes: tuple[MovingStroke, ...],
    guide: tuple[Stroke, ...],
    dots: tuple[Dot, ...] = (),
    touched: tuple[MovingDot, ...] = (),
    *,
    turns: bool = True,
) -> Animation:
    """Strokes at cam angles, with the readings of a cam; `guide`, `dots`: at rest, `touched`: the point of contact."""
    state = design.state(at)
    readings = (
        Reading("lift", state.trace.motion.s * design.params.per_unit, "mm"),
        Reading("pressure angle", state.trace.pressure_angle, "deg"),
        Reading("contact force", state.normal, "N"),
        Reading("torque", state.torque, "N*m"),
    )
    period = TURN / design.params.speed if design.params.speed > 0 else None
    still = Drawing("cam-moving", "Cam in motion", guide, dots)
    return Animation(still, Axis("cam angle", "deg"), at, strokes, touched, turns, 0, period, readings)


def wedge_outline(design: CamDesign) -> ComplexArray:
    """Points of a wedge's outline, its foot below [m]."""
    end = float(design.cam.knots[-1])
    inner = np.asarray(design.cam.knots[1:-1])
    trace = design.cam.trace(np.unique(np.concatenate([np.linspace(0.0, end, 2881), inner])))
    low, _ = axial_ends(design)
    foot = np.array([1j * low, design.cam.prime_radius * end + 1j * low])
    return np.concatenate([foot, (1j * trace.surface)[::-1]])


def area(design: CamDesign) -> float:
    """Area [m^2] of a wedge's face over its foot; NaN of a barrel or end cam, which has no such face."""
    if design.params.kind != "wedge":
        return math.nan
    return _face(design) + _beyond_ends(design, axial_ends(design)[0])


def _face(design: CamDesign) -> float:
    """Area under the surface laid flat [m^2]: the contact moves by the flow less the roller's turning."""
    low, cam = axial_ends(design)[0], design.cam

    def strip(angle: FloatArray) -> FloatArray:
        trace = cam.trace(angle)
        flow = trace.flow - cam.roller_radius * trace.turning
        return np.asarray((trace.surface.real - low) * trace.normal.real * flow)

    return integral(strip, cam.knots)


def _beyond_ends(design: CamDesign, low: float) -> float:
    """Area of the foot beyond the ends of the surface [m^2], where the surface slopes there."""
    cam = design.cam
    end = float(cam.knots[-1])
    first, last = 1j * cam.trace(np.array([0.0, end])).surface
    left, right = first.real, cam.prime_radius * end - last.real
    return float(0.5 * left * (first.imag - low) + 0.5 * right * (last.imag - low))


def axial_ends(design: CamDesign) -> tuple[float, float]:
    """Foot and top of the cam along the follower's path [m]: a rim beyond the reach of the roller."""
    reach = design.cam.roller_radius + design.params.rim
    low, high = design.programme.bounds
    return low - reach, high + reach


def _guide(design: CamDesign) -> tuple[Stroke, ...]:
    """Both walls of the follower's guide."""
    low = design.programme.bounds[1] + 1.3 * design.cam.roller_radius
    line = 1j * np.array([low, low + 1.4 * design.params.lift])
    return (Stroke(line, "guide"), Stroke(line[::-1], "guide"))


def _roller_name(design: CamDesign) -> str:
    name = design.roller.name if design.roller else format_quantity(design.cam.roller_radius, "mm")
    return f"{design.params.follower} {name}"


_NAMES = {"barrel": "barrel, laid flat", "face": "end cam, laid flat", "wedge": "wedge"}
