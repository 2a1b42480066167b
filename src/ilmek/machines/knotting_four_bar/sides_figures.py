"""Figures of both sides: to scale where the hands are nearest, in motion, torque and distance over the way."""

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


def figures(design: KnottingFourBar) -> tuple[Figure, ...]:
    """Drawing, motion and two plots."""
    sides = design.sides
    if sides is None:
        return ()
    return drawing(design, sides), moving(design, sides), torque(sides), distance(sides)


def drawing(design: KnottingFourBar, sides: KnottingSides) -> Drawing:
    """Both sides to scale where the hands are nearest to one another, their gears and ways."""
    motion = solve(sides.plan, np.array([sides.knot])).require()
    first_way, second_way = hands(sides.course.motion)
    ways = Stroke(first_way, "path", "way of the hand"), Stroke(second_way, "path")
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
    strokes = (*_gears(sides), *ways, *grounds, *links, *arms, *_grippers(design, sides, motion))
    return Drawing("knotting-sides", "Both sides to scale, the hands nearest to one another", strokes, dots, note=note)


def moving(design: KnottingFourBar, sides: KnottingSides) -> Animation:
    """Both sides over the crank's way."""
    course = sides.course.angle
    at = frames(course[0], course[-1])
    motion = solve(sides.plan, at).require()
    readings = (
        Reading("motor torque", np.interp(at, course, sides.course.torque), "N*m"),
        Reading("distance of the hands", np.interp(at, course, sides.gap), "mm"),
    )
    note = "The second crank is driven by the first through equal gears, whose pitch circles are dashed."
    still = Drawing("knotting-sides-moving", "Both sides in motion", _gears(sides), note=note)
    names = {other(pin): f"{pin}*" for pin in ("O1", "O1'", "O2", "O2'", "H")} | {other(body): "" for body in BODIES}
    traces = (("coupler", "H"), (other("coupler"), other("H")))
    start = float(design.crank_angle)
    return animated(motion, at, still, traces=traces, names=names, start=start, readings=readings)


def _points(motion: Motion, named: Callable[[str], str]) -> dict[str, complex]:
    """Places of a side's points at the first sample, by their names on the first side."""
    held = {"O1": "crank", "O2": "crank", "O2'": "coupler", "O1'": "rocker", "H": "coupler"}
    return {name: complex(np.ravel(motion.point(named(body), named(name)).position)[0]) for name, body in held.items()}


def _grippers(design: KnottingFourBar, sides: KnottingSides, motion: Motion) -> tuple[Stroke, ...]:
    """Outlines of holders and grippers."""
    shapes = outlines(design.params, sides.plan.mechanism, "coupler").outlines[1:]
    found: list[Stroke] = []
    for body in ("coupler", other("coupler")):
        origin, along = complex(motion.origin(body)[0]), complex(motion.direction(body)[0])
        found += [Stroke(origin + along * np.asarray(shape.corners), "outline", closed=True) for shape in shapes]
    return tuple(found)


def torque(sides: KnottingSides) -> Plot:
    """Torque of the motor for both sides, and of each alone."""
    course = sides.course
    series = (
        Series("motor, both sides", course.angle, course.torque),
        Series("one side alone", course.angle, course.alone[0], dashed=True),
    )
    return Plot(
        "knotting-sides-torque", "Torque on the first crank", Axis("crank angle", "deg"), Axis("torque", "N*m"), series
    )


def distance(sides: KnottingSides) -> Plot:
    """Distance of the two hands."""
    series = (Series("from hand to hand", sides.course.angle, sides.gap),)
    axes = Axis("crank angle", "deg"), Axis("distance", "mm")
    return Plot("knotting-sides-distance", "Distance of the hands", *axes, series, (Mark(sides.knot, "nearest"),))


def _gears(sides: KnottingSides) -> tuple[Stroke, ...]:
    """Pitch circles and the mirror's line."""
    mechanism, radius = sides.plan.mechanism, sides.gears.pitch_radius
    centres = [mechanism.point(GROUND, name) for name in ("O1", other("O1"))]
    middle = sides.mirror + 1j * centres[0].imag
    line = middle + np.array([-1j, 1j]) * radius
    return (*(Stroke(centre + radius * ROUND, "construction") for centre in centres), Stroke(line, "construction"))
