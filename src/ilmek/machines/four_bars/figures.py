"""A four-bar that answers a task, drawn and in motion."""

import cmath
from collections.abc import Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.animation import animated, frames
from ilmek.report import Animation, Dot, Drawing, Stroke
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.circuit_loops import circuit_loops
from ilmek.synthesis.four_bar import TRACER, FourBar
from ilmek.units import format_quantity, turn

FINE = 361
"""Places of a curve as drawn."""

STILL = 1e-6
"""Turn of a crank between its positions [rad] below which it shows nothing."""


def links(four_bar: FourBar) -> tuple[Stroke, ...]:
    """Crank, coupler with its tracer, and rocker, with their lengths."""
    pins, lengths = four_bar, four_bar.lengths
    corners = [pins.a, pins.b] if pins.tracer is None else [pins.a, pins.b, pins.tracer]
    return (
        Stroke(np.array([pins.a, *corners[1:]]), "link", _said("coupler", lengths.coupler), closed=len(corners) > 2),
        Stroke(np.array([pins.a0, pins.a]), "link", _said("crank", lengths.crank)),
        Stroke(np.array([pins.b0, pins.b]), "link", _said("rocker", lengths.rocker)),
    )


def pins(four_bar: FourBar) -> tuple[Dot, ...]:
    """Pivots, pins and tracer by their names."""
    tracer = () if four_bar.tracer is None else (Dot(four_bar.tracer, TRACER, "point"),)
    pivots = Dot(four_bar.a0, "A0", "pivot"), Dot(four_bar.b0, "B0", "pivot")
    return (*pivots, Dot(four_bar.a, "A"), Dot(four_bar.b, "B"), *tracer)


def curve(one: Candidate) -> tuple[Stroke, ...]:
    """The coupler curve: all of the circuit that the first position is on."""
    if one.four_bar.tracer is None:
        return ()
    loop = circuit_loops(one.four_bar)[max(one.positions[0].circuit - 1, 0)]
    places = loop.at(np.linspace(0, turn, FINE)).tracer
    return (Stroke(places, "path", f"path of {TRACER}", closed=True),)


def drawn(one: Candidate, title: Drawing, strokes: Sequence[Stroke], dots: Sequence[Dot]) -> Drawing:
    """The four-bar as drawn at its first position, its coupler curve, and what its task shows.

    title  name, title and note
    """
    every = (*strokes, *curve(one), *links(one.four_bar))
    return Drawing(title.name, title.title, every, (*dots, *pins(one.four_bar)), note=title.note)


def moving(one: Candidate, drawing: Drawing) -> Animation | None:
    """The four-bar over a turn, or from position to position where its crank rocks; None where that is no way.

    drawing  name, title and note, and what stands beside
    """
    four_bar = one.four_bar
    first: float | None = None
    if one.crank_turns:
        at = frames(four_bar.crank_angle)
    else:
        home = [met.crank_angle for met in one.positions if met.reached and met.branch in (four_bar.branch, 0)]
        if not home or max(home) - min(home) < STILL:
            return None
        first, at = home[0], frames(min(home), max(home))
    motion = solve(plan(four_bar.mechanism()), at).require()
    traces = () if four_bar.tracer is None else (("coupler", TRACER),)
    return animated(motion, at, drawing, traces=traces, start=first)


def body(point: complex, angle: float, size: float) -> ComplexArray:
    """A flag that shows a body's pose: its point, and an arm along its line with a short one across [m]."""
    along = size * cmath.exp(1j * angle)
    return np.array([point + 0.35j * along, point, point + along])


def _said(name: str, length: float) -> str:
    return f"{name} {format_quantity(length, 'mm')}"
