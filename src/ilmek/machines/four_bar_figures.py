"""A four-bar that does a task: drawn, in motion, and as an own mechanism."""

from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.dynamics.animation import animated, frames
from ilmek.dynamics.own_machine import OwnMachine
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.linkage.transmission import transmission_angles
from ilmek.report import Animation, Dot, Drawing, Figure, Reading, Stroke
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.circuit_loops import circuit_loops
from ilmek.synthesis.four_bar import TRACER, FourBar
from ilmek.synthesis.selection import FourBarDesign
from ilmek.units import format_quantity, turn

FINE = 361
"""Points of a curve as drawn."""

STILL = 1e-6
"""Turn of a crank between its positions [rad] below which it shows nothing."""


def own_machine(design: FourBarDesign) -> OwnMachine | None:
    """The four-bar that is drawn as an own mechanism, at its first position; None where there is none."""
    return None if design.best is None else own_four_bar(design.best.candidate.four_bar)


def own_four_bar(four_bar: FourBar) -> OwnMachine:
    """A four-bar as an own mechanism, at its drawn position, with the path of its tracer."""
    traced = () if four_bar.tracer is None else (("coupler", TRACER),)
    return OwnMachine(four_bar.mechanism(), paths=traced)


def links(four_bar: FourBar) -> tuple[Stroke, ...]:
    """Crank, coupler with its tracer, and rocker, with their lengths."""
    lengths = {name: f"{name} {format_quantity(length, 'mm')}" for name, length in four_bar.lengths._asdict().items()}
    corners = [four_bar.a, four_bar.b] if four_bar.tracer is None else [four_bar.a, four_bar.b, four_bar.tracer]
    return (
        Stroke(np.array(corners), "link", lengths["coupler"], closed=len(corners) > 2),
        Stroke(np.array([four_bar.a0, four_bar.a]), "link", lengths["crank"]),
        Stroke(np.array([four_bar.b0, four_bar.b]), "link", lengths["rocker"]),
    )


def pins(four_bar: FourBar) -> tuple[Dot, ...]:
    """Pivots, pins and tracer with their names."""
    tracer = () if four_bar.tracer is None else (Dot(four_bar.tracer, TRACER, "point"),)
    pivots = Dot(four_bar.a0, "A0", "pivot"), Dot(four_bar.b0, "B0", "pivot")
    return (*pivots, Dot(four_bar.a, "A"), Dot(four_bar.b, "B"), *tracer)


def curve(candidate: Candidate) -> tuple[Stroke, ...]:
    """The coupler curve: the whole circuit of the first position."""
    if candidate.four_bar.tracer is None:
        return ()
    loop = circuit_loops(candidate.four_bar)[max(candidate.positions[0].circuit - 1, 0)]
    return (Stroke(loop.at(np.linspace(0, turn, FINE)).tracer, "path", f"path of {TRACER}", closed=True),)


def numbered(points: ComplexArray) -> tuple[Dot, ...]:
    """Points with their numbers from 1."""
    return tuple(Dot(complex(point), str(at), "point") for at, point in enumerate(points, 1))


def drawn_and_moving(candidate: Candidate, still: Drawing, moving: str) -> tuple[Figure, ...]:
    """The four-bar at its first position with its coupler curve, and in motion.

    still   name, title and note, and what the task shows        moving  title of the animation
    """
    background = Drawing(f"{still.name}-moving", moving, still.strokes, still.dots)
    animation = _moving(candidate, background)
    return (drawn(candidate, still), *((animation,) if animation else ()))


def drawn(candidate: Candidate, still: Drawing) -> Drawing:
    """The four-bar at its first position with its coupler curve, on what the drawing shows already."""
    strokes = (*still.strokes, *curve(candidate), *links(candidate.four_bar))
    return replace(still, strokes=strokes, dots=(*still.dots, *pins(candidate.four_bar)))


def crank_range(candidate: Candidate) -> tuple[float, float] | None:
    """Least and greatest crank angle of the positions on the drawn branch [rad]; None where it does not move."""
    home = _at_home(candidate)
    return (min(home), max(home)) if home and max(home) - min(home) >= STILL else None


def _at_home(one: Candidate) -> list[float]:
    """Crank angles of the positions on the drawn branch [rad]."""
    return [met.crank_angle for met in one.positions if met.reached and met.branch in (one.four_bar.branch, 0)]


def _moving(one: Candidate, drawing: Drawing) -> Animation | None:
    """The four-bar over a turn, or from position to position where its crank rocks; None where it does not move."""
    four_bar = one.four_bar
    first: float | None = None
    if one.crank_turns:
        at = frames(four_bar.crank_angle)
    else:
        ends = crank_range(one)
        if ends is None:
            return None
        first, at = _at_home(one)[0], frames(*ends)
    motion = solve(plan(four_bar.mechanism()), at).require()
    traces = () if four_bar.tracer is None else (("coupler", TRACER),)
    readings = tuple(Reading("transmission angle", angle, "deg") for angle in transmission_angles(motion).values())
    return animated(motion, at, drawing, traces=traces, start=first, readings=readings)
