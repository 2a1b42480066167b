"""Machines in motion as figures that stand still: a drawing to scale of a frame, on a sheet that holds all frames."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.records import alike
from ilmek.report import Animation, Dot, Drawing, Stroke
from ilmek.viz.drawing import draw_still, extent, names, obstacles, pen_for
from ilmek.viz.sheet import Sheet
from ilmek.viz.strokes import Pen

Between = Callable[[ComplexArray], ComplexArray]
"""Values over the frames (frames, ...) -> those at a frame, or between two."""


def draw_animation(animation: Animation) -> Sheet:
    """The figure at the frame that is shown first."""
    pen = pen_of(animation)
    moving = moving_at(animation, between(animation, animation.start))
    shown = replace(
        animation.still,
        strokes=(*animation.still.strokes, *moving.strokes),
        dots=(*animation.still.dots, *moving.dots),
    )
    draw_still(pen, shown)
    names(pen, replace(shown, strokes=tuple(map(unnamed, shown.strokes))), obstacles(pen, shown))
    return pen.sheet


def unnamed(stroke: Stroke) -> Stroke:
    """The stroke; a path, which its point names, without its label."""
    return replace(stroke, label="") if stroke.role == "path" else stroke


def pen_of(animation: Animation) -> Pen:
    """The pen of a sheet that holds all frames."""
    everywhere = [*(stroke.points.ravel() for stroke in animation.strokes), *(dot.at for dot in animation.dots)]
    points = np.concatenate([extent(animation.still), *everywhere])
    return pen_for(points, animation.still.unit)


def moving_at(animation: Animation, at: Between) -> Drawing:
    """What moves, at a frame; areas are filled."""
    strokes = tuple(
        alike(Stroke, stroke, points=at(stroke.points), filled=stroke.closed and stroke.role == "link")
        for stroke in animation.strokes
    )
    dots = tuple(
        Dot(complex(at(dot.at)), dot.label, dot.role, 1.0 if dot.along is None else complex(at(dot.along)))
        for dot in animation.dots
    )
    return Drawing(animation.name, animation.title, strokes, dots, animation.still.unit)


def between(animation: Animation, value: float) -> Between:
    """Values at a frame with a fraction, on straight lines between two frames."""
    frames, frame = len(animation.at), int(value)
    share = value - frame

    def at(values: ComplexArray) -> ComplexArray:
        before = values[frame]
        return np.asarray(before + share * (values[(frame + 1) % frames] - before) if share else before)

    return at


def middle(points: ComplexArray) -> ComplexArray:
    """The middle of the first part of a line over the frames; points (frames, points)."""
    return np.asarray(points[:, :2].mean(axis=1))


def first_of_each(labels: Sequence[str]) -> list[int]:
    """The numbers of the labels that no earlier one is equal to; empty ones left out."""
    return [number for number, label in enumerate(labels) if label and label not in labels[:number]]
