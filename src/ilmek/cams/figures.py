"""Figures of a cam: motion diagrams, profile to scale, pressure angle and curvature over the turn."""

from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import Literal

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.cams.programme import TURN, CamProgramme, jumps
from ilmek.cams.trace import CamRole
from ilmek.num.piecewise import Curve
from ilmek.report import Axis, Dot, Drawing, Mark, Plot, Series, Stroke
from ilmek.units import format_quantity

_ANGLE = Axis("cam angle", "deg")
_BESIDE = 1e-9


def sample_angles(*programmes: CamProgramme, count: int = 361) -> FloatArray:
    """Cam angles [rad] of one turn for a diagram: `count` even ones, and both sides of every knot to show jumps."""
    knots = np.mod(np.concatenate([programme.knots for programme in programmes]), TURN)
    sides = np.clip(np.concatenate([knots - _BESIDE, knots + _BESIDE]), 0.0, TURN)
    return np.unique(np.concatenate([np.linspace(0.0, TURN, count), sides]))


def turn_plot(
    title: str,
    axis: Axis,
    curves: Mapping[str, Curve],
    *programmes: CamProgramme,
    name: str,
    levels: Mapping[str, float] = MappingProxyType({}),
    dashed: Collection[str] = (),
    mark: Mark | None = None,
    note: str = "",
) -> Plot:
    """Curves over the cam angle by their labels, some of them dashed, and levels as dashed lines.

    programmes  whose knots are shown, besides even steps over the turn
    """
    angle, ends = sample_angles(*programmes), np.array([0.0, TURN])
    drawn = [Series(label, angle, curve(angle), dashed=label in dashed) for label, curve in curves.items()]
    drawn += [Series(label, ends, np.full(2, level), dashed=True) for label, level in levels.items()]
    return Plot(name, title, _ANGLE, axis, tuple(drawn), (mark,) if mark else (), note)


def jump_note(programme: CamProgramme, of: str = "") -> str:
    """The jumps of the acceleration as a note; `of`: words before it, `even warps: `."""
    found = ", ".join(f"{jump.where} at {format_quantity(jump.angle, 'deg')}" for jump in jumps(programme))
    return f"{of}the acceleration jumps {found}" if found else "the acceleration has no jump"


def motion_plots(
    programmes: Mapping[str, CamProgramme],
    speed: float,
    marks: tuple[Mark, ...] = (),
    note: str = "",
    unit: Literal["mm", "deg"] = "mm",
) -> tuple[Plot, ...]:
    """Plots of displacement, velocity and acceleration of followers by name.

    speed  of the cam [rad/s]      marks  on the displacement      note  under the acceleration
    unit   of the displacement: deg where it is an angle
    """
    angle = sample_angles(*programmes.values())
    motions = {name: programme.at(angle) for name, programme in programmes.items()}
    kinds = (("displacement", unit, 0), ("velocity", f"{unit}/s", 1), ("acceleration", f"{unit}/s^2", 2))
    return tuple(
        Plot(
            name=kind,
            title=f"{kind.capitalize()} over the cam angle",
            x=_ANGLE,
            y=Axis(kind, unit),
            series=tuple(
                Series(name, angle, speed**order * motion[order], dashed=number > 0)
                for number, (name, motion) in enumerate(motions.items())
            ),
            marks=marks if order == 0 else (),
            note=note if order == 2 else "",
        )
        for kind, unit, order in kinds
    )


def pressure_plot(cam: CamRole, limit: float, at: float) -> Plot:
    """Pressure angle over the turn between +-limit [rad]; `at` [rad] marks the largest."""
    levels, axis = {"limit": limit, "limit on the return": -limit}, Axis("pressure angle", "deg")
    curve, mark = {"pressure angle": lambda angle: cam.trace(angle).pressure_angle}, Mark(at, "largest")
    return turn_plot("Pressure angle", axis, curve, cam.programme, name="pressure-angle", levels=levels, mark=mark)


def curvature_plot(cam: CamRole, at: float) -> Plot:
    """Curvature of the pitch curve over the turn; `at` [rad] marks its largest convex value."""
    curve, mark = {"pitch curve": lambda angle: cam.trace(angle).curvature}, Mark(at, "sharpest")
    note, axis = "positive: convex; the radius of curvature is the reciprocal", Axis("curvature", "1/m")
    title = "Curvature of the pitch curve"
    return turn_plot(title, axis, curve, cam.programme, name="curvature", mark=mark, note=note)


def cam_drawing(cam: CamRole, bore_side: float, guide_radius: float) -> Drawing:
    """The cam to scale, cam angle 0 to the right: surface, prime circle, pitch curve, bore and guide circle.

    bore_side  of the square bore [m]      guide_radius  of the guide cam [m]
    """
    tip = _to_the_tip(cam, sample_angles(cam.programme, count=721))
    corners = bore_side / 2 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j])
    guide = f"guide cam {format_quantity(guide_radius, 'mm')}"
    strokes = (
        Stroke(guide_radius * _CIRCLE, "construction", guide, closed=True),
        *cam_strokes(cam),
        Stroke(corners, "outline", f"bore {format_quantity(bore_side, 'mm')}", closed=True),
        Stroke(tip, "dimension", format_quantity(float(np.abs(tip[1])), "mm")),
    )
    note = "turns counter-clockwise; the warp lies on the right when the cam angle is 0"
    return Drawing("cam", "Cam, to scale", strokes, (Dot(0j, "", "point"),), note=note)


def cam_strokes(cam: CamRole) -> tuple[Stroke, ...]:
    """Surface, prime circle and, of a roller, pitch curve of a cam to scale, cam angle 0 to the right."""
    trace = cam.trace(sample_angles(cam.programme, count=721))
    prime = f"Rp {format_quantity(cam.prime_radius, 'mm')}"
    pitch = (Stroke(trace.pitch, "path", "pitch curve", closed=True),) if cam.roller_radius > 0 else ()
    return (
        Stroke(trace.surface, "outline", "cam", closed=True, filled=True),
        Stroke(cam.prime_radius * _CIRCLE, "construction", prime, closed=True),
        *pitch,
    )


_CIRCLE = np.exp(1j * np.linspace(0.0, TURN, 361))


def _to_the_tip(cam: CamRole, angle: FloatArray) -> ComplexArray:
    surface = cam.trace(angle).surface
    return np.array([0j, surface[np.argmax(np.abs(surface))]])
