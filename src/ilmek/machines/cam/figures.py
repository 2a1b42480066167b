"""The cam's figures: to scale and in motion, its diagrams over the turn, its forces."""

from dataclasses import replace
from typing import Literal

import numpy as np

from ilmek.cams import figures as cam_figures
from ilmek.cams.limits import convex_radius_min
from ilmek.cams.programme import TURN, jumps
from ilmek.cams.trace import CamTrace
from ilmek.machines.cam import developed_cams
from ilmek.machines.cam.analysis import CamAnalysis
from ilmek.machines.cam.animation import moving
from ilmek.machines.cam.compliant_follower import vibration_figures
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.parts import cutouts, rim_radius, zero_mark
from ilmek.num.piecewise import supremum
from ilmek.plane import contours
from ilmek.report import Axis, Dot, Drawing, Figure, Mark, Plot, Series, Stroke
from ilmek.units import format_quantity, mm

ANGLE = Axis("cam angle", "deg")
_CIRCLE = np.exp(1j * np.linspace(0.0, TURN, 361))

CHORD = 0.02 * mm
"""Largest distance of the drawn edge of a bore from its arc [m]."""


def figures(found: CamAnalysis) -> tuple[Figure, ...]:
    """The cam to scale, in motion, and the plots in the order of the report."""
    design = found.design
    cam, params = design.cam, design.params
    widest = supremum(lambda angle: np.abs(cam.trace(angle).pressure_angle), design.cam.knots)
    plots = (
        *cam_figures.motion_plots(
            {"follower": design.programme}, params.speed, _marks(design), _jump_note(design), _unit(design)
        ),
        _jerk_plot(design),
        *(() if cam.flat and widest.value == 0 else (_pressure_angle_plot(design, widest.at),)),
        cam_figures.curvature_plot(cam, convex_radius_min(cam).at),
        _force_plot(design),
        _torque_plot(design),
        *(() if design.extremes.pressure is None else (_hertz_plot(design, design.extremes.pressure.at),)),
    )
    named = (replace(plot, name=f"cam-{plot.name}") for plot in plots)
    vibration = vibration_figures(found.compliant) if found.compliant else ()
    return (drawing(design), moving(design), *named, *vibration)


def drawing(design: CamDesign) -> Drawing:
    """The cam to scale, zero of the cam angle to the right, with the curves that make it."""
    if design.params.laid_flat:
        return developed_cams.drawing(design)
    cam, bore = design.cam, f"bore {format_quantity(design.hub.bore, 'mm')}"
    trace = cam.trace(cam_figures.sample_angles(design.programme, count=721))
    tip = trace.surface[np.argmax(np.abs(trace.surface))]
    prime = f"{'base circle' if cam.flat else 'prime circle'} {format_quantity(cam.prime_radius, 'mm')}"
    strokes = (
        *_bodies(design, trace),
        Stroke(cam.prime_radius * _CIRCLE, "construction", prime, closed=True),
        *_paths(design, trace),
        *(Stroke(contours.along(hole, CHORD), "outline", bore, closed=True) for hole in cutouts(design, cam)),
        Stroke(zero_mark(design), "outline", "0"),
        Stroke(np.array([0j, tip]), "dimension", format_quantity(float(np.abs(tip)), "mm")),
    )
    turned = "turns counter-clockwise; the follower stands on the right when the cam angle is 0"
    note = f"{turned}; no surface guides the follower where the outline turns back" if design.undercut else turned
    return Drawing("cam", "Cam, to scale", strokes, (Dot(0j, "", "point"),), note=note)


def _bodies(design: CamDesign, trace: CamTrace) -> tuple[Stroke, ...]:
    """Edges of what is solid: the cam, the disc with its groove, or both conjugate cams."""
    if design.params.kind == "grooved":
        outer = trace.parallel(design.cam.roller_radius)
        return (
            Stroke(rim_radius(design) * _CIRCLE, "outline", "disc", closed=True, filled=True),
            Stroke(trace.surface, "outline", "inner flank", closed=True),
            Stroke(outer, "outline", "outer flank", closed=True),
        )
    first = Stroke(trace.surface, "outline", "cam", closed=True, filled=True)
    if design.cams.pair is None:
        return (first,)
    second = design.cams.pair.second
    surface = second.trace(cam_figures.sample_angles(second.programme, count=721)).surface
    return first, Stroke(surface, "outline", "second cam", closed=True)


def _paths(design: CamDesign, trace: CamTrace) -> tuple[Stroke, ...]:
    """Pitch curve, the path of a cutter of another radius, and the roller where the rise begins."""
    cam, follower, paths = design.cam, design.params.follower, []
    cutter = design.params.cutter_radius
    if cam.roller_radius > 0:
        paths.append(Stroke(trace.pitch, "path", "pitch curve", closed=True))
    if cutter is not None and cutter != cam.roller_radius:
        paths.append(Stroke(trace.parallel(cutter - cam.roller_radius), "path", "cutter path", closed=True))
    if follower in ("roller", "spherical"):
        name = design.roller.name if design.roller else format_quantity(cam.roller_radius, "mm")
        at = complex(trace.pitch[0]) + cam.roller_radius * _CIRCLE
        paths.append(Stroke(at, "link", f"{follower} {name}", closed=True))
    return tuple(paths)


def _unit(design: CamDesign) -> Literal["mm", "deg"]:
    return "deg" if design.params.motion == "oscillating" else "mm"


def _marks(design: CamDesign) -> tuple[Mark, ...]:
    programme = design.programme
    return tuple(Mark(float(edge), part.name) for edge, part in zip(programme.edges, programme.segments, strict=False))


def _jump_note(design: CamDesign) -> str:
    found = ", ".join(f"{jump.place} at {format_quantity(jump.angle, 'deg')}" for jump in jumps(design.programme))
    return f"the acceleration jumps {found}" if found else "the acceleration has no jump"


def _jerk_plot(design: CamDesign) -> Plot:
    angle = cam_figures.sample_angles(design.programme)
    jerk = design.params.speed**3 * design.programme.at(angle).ddds
    note = "between jumps of the acceleration, where it is infinite" if jumps(design.programme) else ""
    return _plot(
        "jerk",
        "Jerk over the cam angle",
        Axis("jerk", f"{_unit(design)}/s^3"),
        (Series("follower", angle, jerk),),
        note=note,
    )


def _pressure_angle_plot(design: CamDesign, at: float) -> Plot:
    """Pressure angle, and the limit on the rise; of a cam that leads both ways on the fall too."""
    limit, ends = design.params.limit, np.array([0.0, TURN])
    angle = cam_figures.sample_angles(design.programme)
    series = [Series("pressure angle", angle, design.cam.trace(angle).pressure_angle)]
    if limit is not None:
        series.append(Series("limit", ends, np.full(2, limit), dashed=True))
    if limit is not None and design.params.led:
        series.append(Series("limit on the fall", ends, np.full(2, -limit), dashed=True))
    axis, mark = Axis("pressure angle", "deg"), Mark(at, "largest")
    return _plot("pressure-angle", "Pressure angle", axis, tuple(series), marks=(mark,))


def _force_plot(design: CamDesign) -> Plot:
    angle = cam_figures.sample_angles(design.programme)
    state = design.state(angle)
    arc = design.params.per_unit
    spring = (design.held.preload + design.held.rate * state.trace.course.s) / arc
    series = (
        Series("on the normal", angle, state.normal),
        Series("along the motion", angle, state.force / arc),
        *(() if design.params.led else (Series("spring", angle, spring, dashed=True),)),
    )
    note = "the follower stays on the cam as long as the force is above 0"
    if design.params.led:
        note = "below 0 the other flank or cam holds the follower"
    mark = Mark(design.extremes.normal.at, format_quantity(design.extremes.normal.value, "N"))
    return _plot(
        "contact-force", "Force between cam and follower", Axis("force", "N"), series, marks=(mark,), note=note
    )


def _torque_plot(design: CamDesign) -> Plot:
    angle = cam_figures.sample_angles(design.programme)
    rms = design.extremes.torque_rms
    series = (
        Series("torque", angle, design.state(angle).torque),
        Series("root mean square", np.array([0.0, TURN]), np.full(2, rms), dashed=True),
    )
    mark = Mark(design.extremes.torque.at, format_quantity(design.extremes.torque.value, "N*m"))
    note = "positive: the shaft drives the cam; negative: the follower presses it on"
    return _plot("torque", "Torque of the shaft", Axis("torque", "N*m"), series, marks=(mark,), note=note)


def _hertz_plot(design: CamDesign, at: float) -> Plot:
    angle = cam_figures.sample_angles(design.programme)
    series = (
        Series("Hertz pressure", angle, design.hertz(angle)),
        Series("limit", np.array([0.0, TURN]), np.full(2, design.pressure_limit), dashed=True),
    )
    title = "Pressure between cam and follower"
    return _plot("hertz-pressure", title, Axis("pressure", "MPa"), series, marks=(Mark(at, "largest"),))


def _plot(
    name: str, title: str, y: Axis, series: tuple[Series, ...], *, marks: tuple[Mark, ...] = (), note: str = ""
) -> Plot:
    return Plot(name, title, ANGLE, y, series, marks, note)
