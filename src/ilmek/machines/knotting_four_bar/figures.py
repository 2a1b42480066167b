"""The knotting four-bar's figures: to scale at its pose, the one to use instead, both sides, and curves."""

from collections.abc import Callable, Mapping
from functools import partial
from types import MappingProxyType

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.animation import animated, frames
from ilmek.dynamics.crank_figures import crank_plot
from ilmek.dynamics.inertia import Inertia
from ilmek.linkage.mirror import other
from ilmek.linkage.model import GROUND
from ilmek.linkage.motion import Motion
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import Plan
from ilmek.machines.four_bar_figures import numbered
from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.model import evaluate
from ilmek.machines.knotting_four_bar.params import KnottingFourBarParams
from ilmek.machines.knotting_four_bar.posed import PosedFourBar
from ilmek.machines.knotting_four_bar.sides import BODIES, KnottingSides, hands, outlines
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, Mark, Plot, Reading, Stroke
from ilmek.units import format_quantity, turn

POINTS = {"O1": "crank", "O1'": "rocker", "O2": "crank", "O2'": "coupler", "H": "coupler"}
"""Points, and the bodies that they are fixed to."""

CIRCLE = np.exp(1j * turn * np.arange(97) / 96)


def figures(design: KnottingFourBar) -> tuple[Figure, ...]:
    """The mechanism to scale and in motion, the one to use instead likewise, both sides, and four plots."""
    sides: tuple[Figure, ...] = ()
    if design.sides is not None:
        sides = (sides_drawing(design, design.sides), _sides_moving(design, design.sides), *_sides_plots(design.sides))
    return (*_drawings(design), *sides, *_plots(design))


def _drawings(design: KnottingFourBar) -> tuple[Figure, ...]:
    if design.instead is not None:
        return _at_crank_angle(design), _moving(design), _instead(design.instead), _instead_moving(design.instead)
    if design.posed is None:
        return _at_crank_angle(design), _moving(design)
    title, note = "Four-bar through the three poses, to scale", "At the first pose, the others dashed."
    path = Stroke(_path(design), "path", "path of the hand")
    return _at_poses(design.posed, Drawing("knotting-four-bar", title, (path,), note=note)), _moving(design)


def _at_crank_angle(design: KnottingFourBar) -> Drawing:
    """The mechanism to scale at the crank angle to report, and the path of its hand."""
    (pose,) = _poses(design.at.motion)
    strokes = (Stroke(_path(design), "path", "path of the hand"), *_links(pose, _names(design.params)))
    note = f"At {format_quantity(design.crank_angle, 'deg')} of the crank"
    if np.isfinite(design.dead_point_distance):
        note += f", {format_quantity(design.dead_point_distance, 'deg')} from a dead point"
    return Drawing("knotting-four-bar", "Knotting four-bar to scale", strokes, _dots(pose), note=f"{note}.")


def _path(design: KnottingFourBar) -> ComplexArray:
    """Path of the hand over the whole range, to the dead points; with poses, over the working range."""
    start, end = design.working or design.range or (0.0, turn)
    path = _positions(solve(design.plan, np.linspace(start, end, 721)))["H"]
    closed: ComplexArray = path[np.isfinite(path)]
    return closed


def _instead(bar: PosedFourBar) -> Drawing:
    """The four-bar of both arms at its first pose, the others dashed."""
    title = "Four-bar through the report's three poses, to scale"
    note = "Both arms of the three poses side by side; at the first pose, the others dashed."
    return _at_poses(bar, Drawing("knotting-four-bar-instead", title, (), note=note))


def _at_poses(bar: PosedFourBar, still: Drawing) -> Drawing:
    """A four-bar at its first pose, the two others dashed."""
    first, *others = _poses(bar.state.motion)
    dashed = (
        Stroke(np.array([pose[name] for name in ("O1", "O2", "H", "O2'", "O1'")]), "construction") for pose in others
    )
    points = enumerate(bar.synthesis.poses.points[1:], 2)
    dots = (*_dots(first), *(Dot(complex(point), f"pose {at}", "point") for at, point in points))
    strokes = (*still.strokes, *dashed, *_links(first, _names(bar.params)))
    return Drawing(still.name, still.title, strokes, dots, note=still.note)


def _moving(design: KnottingFourBar) -> Animation:
    """The mechanism over its crank's range, to the edges that the curves leave out."""
    angles, reported = design.moving.angle, design.crank_angle
    at = frames(angles[0], angles[-1]) if design.range or design.working else frames(reported)
    note = "The hand H is on the coupler's line."
    dots: tuple[Dot, ...] = ()
    if design.posed:
        note = f"From the first pose to the last and back. {note}"
        dots = numbered(design.posed.synthesis.poses.points)
    elif design.range:
        note = f"From one dead point nearly to the other. {note}"
    still = Drawing("knotting-four-bar-moving", "Knotting four-bar in motion", (), dots, note=note)
    return _animated(design.params, design.plan, design.inertias, at, still, reported)


def _instead_moving(bar: PosedFourBar) -> Animation:
    """The four-bar of both arms from its first pose to its last, and the three positions of its hand."""
    first, last = sorted(bar.crank_angles[[0, -1]])
    title = "Four-bar through the report's three poses, in motion"
    note = "1, 2, 3: the positions that the hand H passes."
    dots = numbered(bar.synthesis.poses.points)
    still = Drawing("knotting-four-bar-instead-moving", title, (), dots, note=note)
    return _animated(bar.params, bar.plan, bar.bodies, frames(first, last), still, float(bar.crank_angles[0]))


def _animated(  # noqa: PLR0917
    params: KnottingFourBarParams,
    planned: Plan,
    bodies: Mapping[str, Inertia],
    at: FloatArray,
    still: Drawing,
    start: float,
) -> Animation:
    state = evaluate(params, planned, bodies, at, params.speed, params.acceleration)
    readings = (
        Reading("drive torque", state.torque, "N*m"),
        Reading("coupler", np.mod(state.motion.angle("coupler") + np.pi, turn) - np.pi, "deg"),
    )
    traces = (("coupler", "H"),)
    return animated(state.motion, at, still, traces=traces, names=_names(params), start=start, readings=readings)


def _positions(motion: Motion, named: Callable[[str], str] = str) -> dict[str, ComplexArray]:
    """All points of a side over the samples [m]; named: the names of its bodies and points."""
    local = motion.plan.mechanism.point
    side = {point: (named(body), named(point)) for point, body in POINTS.items()}
    return {point: np.asarray(motion.carried(one[0], local(*one)).position) for point, one in side.items()}


def _poses(motion: Motion, named: Callable[[str], str] = str) -> list[dict[str, complex]]:
    """All points of a side at each sample [m]."""
    points = _positions(motion, named)
    return [dict(zip(points, map(complex, pose), strict=True)) for pose in zip(*points.values(), strict=True)]


def _names(params: KnottingFourBarParams) -> dict[str, str]:
    return {name: f"{name} {format_quantity(getattr(params, name), 'mm')}" for name, _, _ in LINKS}


LINKS = (("ground", "O1", "O1'"), ("rocker", "O1'", "O2'"), ("coupler", "O2", "O2'"), ("crank", "O1", "O2"))


def _links(pose: Mapping[str, complex], names: Mapping[str, str] = MappingProxyType({})) -> tuple[Stroke, ...]:
    """The links with their names, and the arm to the hand."""
    lines = (
        Stroke(np.array([pose[a], pose[b]]), "ground" if link == "ground" else "link", names.get(link, ""))
        for link, a, b in LINKS
    )
    return (*lines, Stroke(np.array([pose["O2"], pose["H"]]), "outline"))


def _dots(pose: Mapping[str, complex]) -> tuple[Dot, ...]:
    pivots = (Dot(pose[name], name, "pivot") for name in ("O1", "O1'"))
    return (*pivots, Dot(pose["O2"], "O2"), Dot(pose["O2'"], "O2'"), Dot(pose["H"], "H, hand", "point"))


def _plots(design: KnottingFourBar) -> tuple[Plot, ...]:
    """Angles of coupler and rocker, transmission angle, torque, and forces in the pins."""
    state, reported = design.moving, design.crank_angle
    marks: tuple[Mark, ...] = ()
    if design.posed:
        marks = tuple(Mark(float(at), f"pose {k}") for k, at in enumerate(design.posed.crank_angles, 1))
    elif state.angle[0] <= reported <= state.angle[-1]:
        marks = (Mark(reported, "crank_angle"),)
    note = "Without the edges at the dead points." if design.range and not design.working else ""
    plot = partial(crank_plot, angle=state.angle, marks=marks, note=note)
    angle = transmission_angle(state.motion, "O2'")
    angles = {"coupler": state.motion.angle("coupler"), "rocker": state.motion.angle("rocker")}
    acute = {"acute angle between coupler and rocker": np.minimum(angle, np.pi - angle)}
    pins = {pin: np.abs(force) for pin, force in state.pins.items()}
    torque = {"drive": state.torque}
    return (
        plot("knotting-angles", "Angles of coupler and rocker", Axis("angle", "deg"), curves=angles),
        plot("knotting-transmission", "Transmission angle", Axis("angle", "deg"), curves=acute),
        plot("knotting-drive-torque", "Torque of the drive on the crank", Axis("torque", "N*m"), curves=torque),
        plot("knotting-pin-forces", "Forces in the pins", Axis("force", "N"), curves=pins),
    )


def sides_drawing(design: KnottingFourBar, sides: KnottingSides) -> Drawing:
    """Both sides to scale where the hands are nearest to one another, their gears and paths."""
    motion = solve(sides.plan, np.array([sides.knot])).require()
    first_path, second_path = hands(sides.moving.motion)
    paths = Stroke(first_path, "path", "path of the hand"), Stroke(second_path, "path")
    first, second = _poses(motion)[0], _poses(motion, other)[0]
    links = [stroke for pose in (first, second) for stroke in _links(pose)]
    dots = (
        *(Dot(pose[pin], pin + mark, "pivot") for pose, mark in ((first, ""), (second, "*")) for pin in ("O1", "O1'")),
        *(Dot(pose[pin], "") for pose in (first, second) for pin in ("O2", "O2'")),
        *(Dot(pose["H"], label, "point") for pose, label in ((first, "H"), (second, "H*"))),
    )
    note = (
        f"At {format_quantity(sides.knot, 'deg')} of the first crank; dashed: pitch circles of the gears, "
        f"{sides.gears.teeth} teeth each, module {format_quantity(sides.gears.module, 'mm')}, and the mirror."
    )
    strokes = (*_gears(sides), *paths, *links, *_grippers(design, sides, motion))
    return Drawing("knotting-sides", "Both sides to scale, the hands nearest to one another", strokes, dots, note=note)


def _sides_moving(design: KnottingFourBar, sides: KnottingSides) -> Animation:
    """Both sides over the motion of the crank."""
    angles = sides.moving.angle
    at = frames(angles[0], angles[-1])
    motion = solve(sides.plan, at).require()
    readings = (
        Reading("motor torque", np.interp(at, angles, sides.moving.torque), "N*m"),
        Reading("distance of the hands", np.interp(at, angles, sides.gap), "mm"),
    )
    note = "The second crank is driven by the first through equal gears, whose pitch circles are dashed."
    still = Drawing("knotting-sides-moving", "Both sides in motion", _gears(sides), note=note)
    names = {other(pin): f"{pin}*" for pin in POINTS} | {other(body): "" for body in BODIES}
    traces = (("coupler", "H"), (other("coupler"), other("H")))
    start = float(design.crank_angle)
    return animated(motion, at, still, traces=traces, names=names, start=start, readings=readings)


def _grippers(design: KnottingFourBar, sides: KnottingSides, motion: Motion) -> tuple[Stroke, ...]:
    """Outlines of holders and grippers."""
    shapes = outlines(design.params, sides.plan.mechanism, "coupler").outlines[1:]
    grippers: list[Stroke] = []
    for body in ("coupler", other("coupler")):
        origin, along = complex(motion.origin(body)[0]), complex(motion.direction(body)[0])
        grippers += [Stroke(origin + along * np.asarray(shape.corners), "outline", closed=True) for shape in shapes]
    return tuple(grippers)


def _gears(sides: KnottingSides) -> tuple[Stroke, ...]:
    """Pitch circles and the mirror's line."""
    mechanism, radius = sides.plan.mechanism, sides.gears.pitch_radius
    centres = [mechanism.point(GROUND, name) for name in ("O1", other("O1"))]
    middle = sides.mirror + 1j * centres[0].imag
    line = middle + np.array([-1j, 1j]) * radius
    return (*(Stroke(centre + radius * CIRCLE, "construction") for centre in centres), Stroke(line, "construction"))


def _sides_plots(sides: KnottingSides) -> tuple[Plot, Plot]:
    """Torque of the motor for both sides and for each alone, and distance of the hands."""
    state, nearest = sides.moving, (Mark(sides.knot, "nearest"),)
    torque, gap = Axis("torque", "N*m"), Axis("distance", "mm")
    torques = {"motor, both sides": state.torque, "one side alone": state.alone[0]}
    gaps = {"from hand to hand": sides.gap}
    return (
        crank_plot("knotting-sides-torque", "Torque on the first crank", torque, angle=state.angle, curves=torques),
        crank_plot(
            "knotting-sides-distance", "Distance of the hands", gap, angle=state.angle, curves=gaps, marks=nearest
        ),
    )
