"""The cam's figures: to scale and in motion, its diagrams over the turn, its forces."""

from dataclasses import replace
from typing import Literal

import numpy as np

from ilmek.cams import figures as cam_figures
from ilmek.cams.programme import TURN, jumps
from ilmek.cams.trace import CamTrace
from ilmek.machines.cam import developed_cams
from ilmek.machines.cam.analysis import CamAnalysis
from ilmek.machines.cam.animation import moving
from ilmek.machines.cam.compliant_follower import vibration_figures
from ilmek.machines.cam.design import CamDesign
from ilmek.machines.cam.parts import cutouts, rim_radius, zero_mark
from ilmek.num.piecewise import Curve, supremum
from ilmek.plane import contours
from ilmek.report import Axis, Dot, Drawing, Figure, Mark, Plot, Stroke
from ilmek.units import format_quantity, mm

_CIRCLE = np.exp(1j * np.linspace(0.0, TURN, 361))

CHORD = 0.02 * mm
"""Largest distance of the drawn edge of a bore from its arc [m]."""


def figures(analysis: CamAnalysis) -> tuple[Figure, ...]:
    """The cam to scale, in motion, and the plots in the order of the report."""
    design = analysis.design
    cam, params, unit = design.cam, design.params, _unit(design)
    widest = supremum(lambda angle: np.abs(cam.trace(angle).pressure_angle), cam.knots)
    motion = {"follower": design.programme}
    plots = (
        *cam_figures.motion_plots(motion, params.speed, _marks(design), cam_figures.jump_note(design.programme), unit),
        _jerk_plot(design),
        *(() if cam.flat and widest.value == 0 else (_pressure_angle_plot(design, widest.at),)),
        cam_figures.curvature_plot(cam, design.curvature_at),
        *_force_plots(design),
    )
    named = (replace(plot, name=f"cam-{plot.name}") for plot in plots)
    vibration = vibration_figures(analysis.compliant) if analysis.compliant else ()
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


def _jerk_plot(design: CamDesign) -> Plot:
    jerk = {"follower": lambda angle: design.params.speed**3 * design.programme.at(angle).ddds}
    note = "between jumps of the acceleration, where it is infinite" if jumps(design.programme) else ""
    axis, title = Axis("jerk", f"{_unit(design)}/s^3"), "Jerk over the cam angle"
    return cam_figures.turn_plot(title, axis, jerk, design.programme, name="jerk", note=note)


def _pressure_angle_plot(design: CamDesign, at: float) -> Plot:
    """Pressure angle, and the limit on the rise; of a cam that leads both ways on the fall too."""
    limit, axis = design.params.limit, Axis("pressure angle", "deg")
    levels = {} if limit is None else {"limit": limit}
    if limit is not None and design.params.led:
        levels["limit on the fall"] = -limit
    curve = {"pressure angle": lambda angle: design.cam.trace(angle).pressure_angle}
    mark = Mark(at, "largest")
    return cam_figures.turn_plot(
        "Pressure angle", axis, curve, design.programme, name="pressure-angle", levels=levels, mark=mark
    )


def _force_plots(design: CamDesign) -> tuple[Plot, ...]:
    """Contact force, torque and, but for a knife edge, Hertz pressure."""
    extremes, follower_load, arc, led = design.extremes, design.follower_load, design.params.per_unit, design.params.led
    forces: dict[str, Curve] = {
        "on the normal": lambda angle: design.state(angle).normal,
        "along the motion": lambda angle: design.state(angle).force / arc,
    }
    note = "below 0 the other flank or cam holds the follower"
    if not led:
        forces["spring"] = lambda angle: (
            (follower_load.preload + follower_load.rate * design.state(angle).trace.motion.s) / arc
        )
        note = "the follower stays on the cam as long as the force is above 0"
    mark = None if extremes.jammed else Mark(extremes.normal.at, format_quantity(extremes.normal.value, "N"))
    title, newton = "Force between cam and follower", Axis("force", "N")
    over = design.programme
    force = cam_figures.turn_plot(
        title, newton, forces, over, name="contact-force", dashed=("spring",), mark=mark, note=note
    )
    mark = None if extremes.jammed else Mark(extremes.torque.at, format_quantity(extremes.torque.value, "N*m"))
    note = "positive: the shaft drives the cam; negative: the follower drives it"
    curve = {"torque": lambda angle: design.state(angle).torque}
    level = {} if extremes.jammed else {"root mean square": extremes.rms}
    axis = Axis("torque", "N*m")
    title = "Torque of the shaft"
    torque = cam_figures.turn_plot(title, axis, curve, over, name="torque", levels=level, mark=mark, note=note)
    if extremes.pressure is None:
        return force, torque
    title, axis = "Pressure between cam and follower", Axis("pressure", "MPa")
    mark = Mark(extremes.pressure.at, "largest")
    curve, level = {"Hertz pressure": design.hertz}, {"limit": design.pressure_limit}
    return (
        force,
        torque,
        cam_figures.turn_plot(title, axis, curve, over, name="hertz-pressure", levels=level, mark=mark),
    )
