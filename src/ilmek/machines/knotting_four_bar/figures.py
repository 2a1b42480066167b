"""The knotting four-bar's figures: to scale at its pose, the one to use instead, and curves over the crank's range."""

import dataclasses
from collections.abc import Mapping

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.attached import attached
from ilmek.linkage.motion import Motion
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.solve import solve
from ilmek.machines.animation import animated, frames
from ilmek.machines.knotting_four_bar import sides_figures
from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.model import KnottingState, evaluate
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.machines.knotting_four_bar.replacement import POINTS, Replacement
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, Mark, Plot, Reading, Series, Stroke
from ilmek.units import format_quantity, turn

PLACES = (("ground", "O1'"), ("crank", "O2"), ("coupler", "O2'"), ("coupler", "H"))


def figures(design: KnottingFourBar) -> tuple[Figure, ...]:
    """The mechanism to scale and in motion, the one to use instead likewise, and four plots."""
    plots = (angles, transmission, torque, pins)
    return (*_drawings(design), *sides_figures.figures(design), *(plot(design) for plot in plots))


def _drawings(design: KnottingFourBar) -> tuple[Figure, ...]:
    made, found, state = design.instead, design.synthesis, design.at_poses
    if made is not None:
        return drawing(design), moving(design), replacement(made), moving_replacement(made)
    if found is None or state is None:
        return drawing(design), moving(design)
    title, note = "Four-bar through the three poses, to scale", "At the first pose, the others dashed."
    path = Stroke(_path(design), "path", "path of the hand")
    shown = Drawing("knotting-four-bar", title, (path,), note=note)
    poses = _posed(design.origin, _places(state.motion))
    return _at_three(shown, _said(design.params), poses, found.poses.points), moving(design)


def drawing(design: KnottingFourBar) -> Drawing:
    """The mechanism to scale at the crank angle asked for, and the path of its hand."""
    pose = {point: complex(places[0]) for point, places in _places(design.at.motion).items()}
    path = _path(design)
    strokes = (Stroke(path, "path", "path of the hand"), *_links(pose, _said(design.params)))
    note = f"At {format_quantity(design.crank_angle, 'deg')} of the crank"
    if np.isfinite(design.dead_point_distance):
        note += f", {format_quantity(design.dead_point_distance, 'deg')} from a dead point"
    return Drawing("knotting-four-bar", "Knotting four-bar to scale", strokes, _dots(pose), note=f"{note}.")


def _path(design: KnottingFourBar) -> ComplexArray:
    """Path of the hand over the whole range, to the dead points; with poses, on the way through them."""
    start, end = design.working or design.range or (0.0, turn)
    path = _places(solve(design.plan, np.linspace(start, end, 721)))["H"]
    closed: ComplexArray = path[np.isfinite(path)]
    return closed


def replacement(made: Replacement) -> Drawing:
    """The four-bar of both arms at its first pose, the others dashed, in the frame of the poses."""
    title = "Four-bar through the report's three poses, to scale"
    note = "Both arms of the three poses side by side; at the first pose, the others dashed."
    shown = Drawing("knotting-four-bar-instead", title, (), note=note)
    poses = _posed(made.origin, _places(made.state.motion, made.origin))
    return _at_three(shown, _said(made.params), poses, POINTS)


def _posed(origin: complex, moved: Mapping[str, ComplexArray]) -> list[dict[str, complex]]:
    """All points at each of three poses, O1 too."""
    return [{"O1": origin, **{point: complex(places[at]) for point, places in moved.items()}} for at in range(3)]


def _at_three(
    shown: Drawing, said: Mapping[str, str], poses: list[dict[str, complex]], points: ComplexArray
) -> Drawing:
    """A four-bar at its first pose, the two others dashed."""
    others = [
        Stroke(np.array([pose[name] for name in ("O1", "O2", "H", "O2'", "O1'")]), "construction") for pose in poses[1:]
    ]
    dots = (*_dots(poses[0]), *(Dot(complex(points[at]), f"pose {at + 1}", "point") for at in (1, 2)))
    return dataclasses.replace(shown, strokes=(*shown.strokes, *others, *_links(poses[0], said)), dots=dots)


def moving(design: KnottingFourBar) -> Animation:
    """The mechanism over its crank's range, to the edges that the curves leave out."""
    course, asked = design.course.angle, design.crank_angle
    at = frames(course[0], course[-1]) if design.range or design.working else frames(asked)
    state = evaluate(design.params, design.plan, at, design.params.speed, design.params.acceleration)
    title, note = "Knotting four-bar in motion", "The hand H is on the coupler's line."
    dots: tuple[Dot, ...] = ()
    if design.synthesis:
        note = f"From the first pose to the last and back. {note}"
        dots = _numbered(design.synthesis.poses.points)
    elif design.range:
        note = f"From one dead point nearly to the other. {note}"
    return _moving(state, Drawing("knotting-four-bar-moving", title, (), dots, note=note), _said(design.params), asked)


def _numbered(points: ComplexArray) -> tuple[Dot, ...]:
    return tuple(Dot(complex(at), f"{place}", "point") for place, at in enumerate(points, 1))


def moving_replacement(made: Replacement) -> Animation:
    """The four-bar of both arms from its first pose to its last, and the three places its hand goes through."""
    first, last = sorted(made.crank_angles[[0, -1]])
    state = evaluate(made.params, made.state.motion.plan, frames(first, last), made.params.speed)
    poses = _numbered(POINTS - made.origin)
    title, note = (
        "Four-bar through the report's three poses, in motion",
        "1, 2, 3: the places that the hand H goes through.",
    )
    drawing = Drawing("knotting-four-bar-instead-moving", title, (), poses, note=note)
    return _moving(state, drawing, _said(made.params), float(made.crank_angles[0]))


def _moving(state: KnottingState, drawing: Drawing, said: Mapping[str, str], start: float) -> Animation:
    readings = (
        Reading("drive torque", state.torque, "N*m"),
        Reading("coupler", np.mod(state.motion.angle("coupler") + np.pi, turn) - np.pi, "deg"),
    )
    traces = (("coupler", "H"),)
    return animated(state.motion, state.angle, drawing, traces=traces, names=said, start=start, readings=readings)


def _places(motion: Motion, origin: complex = 0j) -> dict[str, ComplexArray]:
    """All points over the samples [m], the pivot O1 at `origin`."""
    local = motion.plan.mechanism.point
    return {point: np.asarray(origin + attached(motion, body, local(body, point)).position) for body, point in PLACES}


def _said(params: KnottingFourBarParams) -> dict[str, str]:
    names = ("ground", "crank", "coupler", "rocker")
    return {name: f"{name} {format_quantity(getattr(params, name), 'mm')}" for name in names}


def _links(pose: Mapping[str, complex], said: Mapping[str, str]) -> tuple[Stroke, ...]:
    O1 = pose.get("O1", 0j)
    return (
        Stroke(np.array([O1, pose["O1'"]]), "ground", said["ground"]),
        Stroke(np.array([pose["O1'"], pose["O2'"]]), "link", said["rocker"]),
        Stroke(np.array([pose["O2"], pose["O2'"]]), "link", said["coupler"]),
        Stroke(np.array([O1, pose["O2"]]), "link", said["crank"]),
        Stroke(np.array([pose["O2"], pose["H"]]), "outline"),
    )


def _dots(pose: Mapping[str, complex]) -> tuple[Dot, ...]:
    return (
        Dot(pose.get("O1", 0j), "O1", "pivot"),
        Dot(pose["O1'"], "O1'", "pivot"),
        Dot(pose["O2"], "O2"),
        Dot(pose["O2'"], "O2'"),
        Dot(pose["H"], "H, hand", "point"),
    )


def angles(design: KnottingFourBar) -> Plot:
    """Angles of coupler and rocker."""
    motion = design.course.motion
    curves = {"coupler": motion.angle("coupler"), "rocker": motion.angle("rocker")}
    return _plot(design, "knotting-angles", "Angles of coupler and rocker", Axis("angle", "deg"), curves)


def transmission(design: KnottingFourBar) -> Plot:
    """Acute angle between coupler and rocker."""
    angle = transmission_angle(design.course.motion, "O2'")
    curves = {"acute angle between coupler and rocker": np.minimum(angle, np.pi - angle)}
    return _plot(design, "knotting-transmission", "Transmission angle", Axis("angle", "deg"), curves)


def torque(design: KnottingFourBar) -> Plot:
    """Torque of the drive on the crank."""
    curves = {"drive": design.course.torque}
    return _plot(design, "knotting-drive-torque", "Torque of the drive on the crank", Axis("torque", "N*m"), curves)


def pins(design: KnottingFourBar) -> Plot:
    """Sizes of the forces in the pins."""
    curves = {pin: np.abs(force) for pin, force in design.course.pins.items()}
    return _plot(design, "knotting-pin-forces", "Forces in the pins", Axis("force", "N"), curves)


def _plot(design: KnottingFourBar, name: str, title: str, y: Axis, curves: Mapping[str, FloatArray]) -> Plot:
    series = tuple(
        Series(said, design.course.angle, values, dashed=place > 0 and len(curves) == 2)
        for place, (said, values) in enumerate(curves.items())
    )
    note = "Without the edges at the dead points." if design.range and not design.working else ""
    return Plot(name, title, Axis("crank angle", "deg"), y, series, _marks(design), note=note)


def _marks(design: KnottingFourBar) -> tuple[Mark, ...]:
    if design.synthesis:
        return tuple(Mark(float(at), f"pose {k}") for k, at in enumerate(design.synthesis.crank_angles, 1))
    asked = design.crank_angle
    return (Mark(asked, "asked for"),) if design.course.angle[0] <= asked <= design.course.angle[-1] else ()
