"""Figures of both sides: to scale where the hands are nearest, in motion, torque and distance over the motion."""

from collections.abc import Callable

import numpy as np

from ilmek.linkage.model import GROUND
from ilmek.linkage.motion import Motion
from ilmek.linkage.solve import solve
from ilmek.machines.animation import animated, frames
from ilmek.machines.knotting_four_bar.design import KnottingFourBar
from ilmek.machines.knotting_four_bar.sides import BODIES, KnottingSides, hands, other, outlines
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, Mark, Plot, Reading, Series, Stroke
from ilmek.units import format_quantity, turn

ROUND = np.exp(1j * turn * np.arange(97) / 96)
LINKS = (("O1", "O2"), ("O2", "O2'"), ("O2'", "O1'"))


def figures(design: KnottingFourBar, sides: KnottingSides) -> tuple[Figure, ...]:
    """Drawing, motion and two plots."""
    return drawing(design, sides), _moving(design, sides), _torque(sides), _distance(sides)


def drawing(design: KnottingFourBar, sides: KnottingSides) -> Drawing:
    """Both sides to scale where the hands are nearest to one another, their gears and paths."""
    motion = solve(sides.plan, np.array([sides.knot])).require()
    first_path, second_path = hands(sides.moving.motion)
    paths = Stroke(first_path, "path", "path of the hand"), Stroke(second_path, "path")
    first, second = _points(motion, str), _points(motion, other)
    links = [Stroke(np.array([pose[a], pose[b]]), "link") for pose in (first, second) for a, b in LINKS]
    grounds = [Stroke(np.array([pose["O1"], pose["O1'"]]), "ground") for pose in (first, second)]
    dots = (
        *(Dot(pose[pin], pin + mark, "pivot") for pose, mark in ((first, ""), (second, "*")) for pin in ("O1", "O1'")),
        *(Dot(pose[pin], "") for pose in (first, second) for pin in ("O2", "O2'")),
        *(Dot(pose["H"], label, "point") for pose, label in ((first, "H"), (second, "H*"))),
    )
    note = (
        f"At {format_quantity(sides.knot, 'deg')} of the first crank; dashed: pitch circles of the gears, "
        f"{sides.gears.teeth} teeth each, module {format_quantity(sides.gears.module, 'mm')}, and the mirror."
    )
    arms = [Stroke(np.array([pose["O2"], pose["H"]]), "outline") for pose in (first, second)]
    strokes = (*_gears(sides), *paths, *grounds, *links, *arms, *_grippers(design, sides, motion))
    return Drawing("knotting-sides", "Both sides to scale, the hands nearest to one another", strokes, dots, note=note)


def _moving(design: KnottingFourBar, sides: KnottingSides) -> Animation:
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
    names = {other(pin): f"{pin}*" for pin in ("O1", "O1'", "O2", "O2'", "H")} | {other(body): "" for body in BODIES}
    traces = (("coupler", "H"), (other("coupler"), other("H")))
    start = float(design.crank_angle)
    return animated(motion, at, still, traces=traces, names=names, start=start, readings=readings)


def _points(motion: Motion, named: Callable[[str], str]) -> dict[str, complex]:
    """Positions of a side's points at the first sample, by their names on the first side."""
    bodies = {"O1": "crank", "O2": "crank", "O2'": "coupler", "O1'": "rocker", "H": "coupler"}
    points = {name: motion.point(named(body), named(name)) for name, body in bodies.items()}
    return {name: complex(np.ravel(point.position)[0]) for name, point in points.items()}


def _grippers(design: KnottingFourBar, sides: KnottingSides, motion: Motion) -> tuple[Stroke, ...]:
    """Outlines of holders and grippers."""
    shapes = outlines(design.params, sides.plan.mechanism, "coupler").outlines[1:]
    found: list[Stroke] = []
    for body in ("coupler", other("coupler")):
        origin, along = complex(motion.origin(body)[0]), complex(motion.direction(body)[0])
        found += [Stroke(origin + along * np.asarray(shape.corners), "outline", closed=True) for shape in shapes]
    return tuple(found)


def _torque(sides: KnottingSides) -> Plot:
    """Torque of the motor for both sides, and of each alone."""
    state = sides.moving
    series = (
        Series("motor, both sides", state.angle, state.torque),
        Series("one side alone", state.angle, state.alone[0], dashed=True),
    )
    axes = Axis("crank angle", "deg"), Axis("torque", "N*m")
    return Plot("knotting-sides-torque", "Torque on the first crank", *axes, series)


def _distance(sides: KnottingSides) -> Plot:
    """Distance of the two hands."""
    series = (Series("from hand to hand", sides.moving.angle, sides.gap),)
    axes = Axis("crank angle", "deg"), Axis("distance", "mm")
    return Plot("knotting-sides-distance", "Distance of the hands", *axes, series, (Mark(sides.knot, "nearest"),))


def _gears(sides: KnottingSides) -> tuple[Stroke, ...]:
    """Pitch circles and the mirror's line."""
    mechanism, radius = sides.plan.mechanism, sides.gears.pitch_radius
    centres = [mechanism.point(GROUND, name) for name in ("O1", other("O1"))]
    middle = sides.mirror + 1j * centres[0].imag
    line = middle + np.array([-1j, 1j]) * radius
    return (*(Stroke(centre + radius * ROUND, "construction") for centre in centres), Stroke(line, "construction"))
