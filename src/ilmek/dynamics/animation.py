"""A mechanism of the engine in motion, as a figure: bodies as bars, joints as their symbols, points as paths.

A machine solves its plan at `frames()` and hands the motion over; its drawing holds what is at rest beside the
mechanism (cloth, fell).
"""

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.dynamics.crank_figures import CRANK
from ilmek.linkage.model import GROUND, Pin, Slide
from ilmek.linkage.motion import Motion
from ilmek.plane.vectors import cross, dot, unit
from ilmek.report import Animation, Axis, Dot, Drawing, MovingDot, MovingStroke, Reading, Stroke
from ilmek.units import turn

FRAMES = 60
SAME = 1e-9
"""Points nearer than this coincide [m]; angles too [rad]."""

BEYOND = 0.15
"""Length of a guide beyond the range of its slider, over that range."""

RIM = 48
"""Corners of a pitch circle."""

Naming = Callable[[str], str]


def frames(start: float = 0.0, end: float | None = None) -> FloatArray:
    """Values of the drive to solve at: a whole turn from `start` [rad], or from `start` to `end`, both included.

    >>> frames().size, round(float(np.degrees(frames()[1])), 9), float(frames(1.0, 3.0)[-1])
    (60, 6.0, 3.0)
    """
    if end is None:
        return np.asarray(start + np.arange(FRAMES) * (turn / FRAMES))
    return np.linspace(start, end, FRAMES)


def animated(
    motion: Motion,
    at: FloatArray,
    drawing: Drawing,
    *,
    traces: Sequence[tuple[str, str]] = (),
    names: Mapping[str, str] | None = None,
    start: float | None = None,
    period: float | None = None,
    readings: tuple[Reading, ...] = (),
    drive: Axis = CRANK,
    closes: bool | None = None,
) -> Animation:
    """The mechanism over its frames; it runs to and fro where they do not close. Gears are their pitch circles.

    motion   solved at the values `at` of the drive [SI], ascending and evenly apart
    drawing  name, title and note, and the strokes and dots that do not move
    traces   bodies and their points whose paths are drawn
    names    labels of bodies, joints or points that differ from their names; "" for none
    start    value of the drive that is shown first            period  of a run of the real machine [s]
    closes   the first frame follows the last; default: where the frames are a whole turn
    """
    labels = {**_hidden(motion), **(names or {})}
    named: Naming = lambda name: labels.get(name, name)  # noqa: E731
    if closes is None:
        closes = bool(abs(at[-1] + at[1] - 2 * at[0] - turn) < SAME)
    pivots = _pivots(motion, named)
    paths = tuple(Stroke(_track(motion, *trace), "path", named(trace[0]), closed=closes) for trace in traces)
    still = dataclasses.replace(
        drawing, strokes=(*_guides(motion), *paths, *drawing.strokes), dots=(*pivots, *drawing.dots)
    )
    pins = {joint.name for joint in motion.plan.mechanism.joints if isinstance(joint, Pin)}  # drawn and named as pins
    points = (MovingDot(_track(motion, *trace), named(trace[1]), "point") for trace in traces if trace[1] not in pins)
    first = 0 if start is None else int(np.argmin(np.abs(unit(at) - unit(start)) if closes else np.abs(at - start)))
    bars = (*_wheels(motion, named), *_bars(motion, named, traces))
    dots = (*_blocks(motion, named), *_pins(motion, named, pivots), *points)
    return Animation(still, drive, at, bars, dots, closes, first, period, readings)


def _hidden(motion: Motion) -> dict[str, str]:
    """No label for the further pins `NAME.BODY` of several bodies at the point `NAME`."""
    joints = {joint.name for joint in motion.plan.mechanism.joints}
    return {name: "" for name in joints if name.rpartition(".")[0] in joints}


def _track(motion: Motion, body: str, point: str) -> ComplexArray:
    return motion.carried(body, motion.plan.mechanism.point(body, point)).position


def _pivots(motion: Motion, named: Naming) -> tuple[Dot, ...]:
    """The pins on the ground."""
    mechanism = motion.plan.mechanism
    pins = (joint for joint in mechanism.joints if isinstance(joint, Pin) and GROUND in joint.bodies)
    return tuple(Dot(mechanism.point(GROUND, pin.name), named(pin.name), "pivot") for pin in pins)


def _pins(motion: Motion, named: Naming, pivots: tuple[Dot, ...]) -> Iterator[MovingDot]:
    """The pins that move; one that stays on a pivot is not drawn again."""
    for joint in motion.plan.mechanism.joints:
        if isinstance(joint, Pin) and GROUND not in joint.bodies:
            at = _track(motion, joint.first, joint.name)
            if all(np.max(np.abs(at - pivot.at)) > SAME for pivot in pivots):
                yield MovingDot(at, named(joint.name))


@dataclass(frozen=True, slots=True)
class _Range:
    """The range of a slider on its guide: its end positions in the guide's frame [m]."""

    slide: Slide
    least: complex
    most: complex


def _ranges(motion: Motion) -> Iterator[_Range]:
    mechanism = motion.plan.mechanism
    for slide in mechanism.joints:
        if isinstance(slide, Slide):
            point = mechanism.point(slide.guide, slide.name)
            away = _track(motion, slide.body, slide.name) - motion.carried(slide.guide, point).position
            along = complex(unit(slide.along))
            shift = np.asarray(dot(motion.direction(slide.guide) * along, away))
            more = BEYOND * (shift.max() - shift.min())
            yield _Range(slide, point + along * (shift.min() - more), point + along * (shift.max() + more))


def _guides(motion: Motion) -> tuple[Stroke, ...]:
    """The guides on the ground, over the range of their sliders."""
    grounded = (one for one in _ranges(motion) if one.slide.guide == GROUND)
    return tuple(Stroke(np.array([one.least, one.most]), "guide") for one in grounded)


def _blocks(motion: Motion, named: Naming) -> Iterator[MovingDot]:
    """The sliders, along their guides; only a renamed one has a name."""
    for one in _ranges(motion):
        slide = one.slide
        label = named(slide.name)
        along = np.asarray(motion.direction(slide.guide) * complex(unit(slide.along)))
        at = _track(motion, slide.body, slide.name)
        yield MovingDot(at, "" if label == slide.name else label, "block", along)


def _bars(motion: Motion, named: Naming, traces: Sequence[tuple[str, str]]) -> Iterator[MovingStroke]:
    """Every body through its joints, traced points and the range of its sliders, the driven ones on top; a slider is a
    plain rod.
    """
    mechanism = motion.plan.mechanism
    ranges = list(_ranges(motion))
    sliding = {one.slide.body for one in ranges}
    for body in reversed(mechanism.moving):
        joints = (joint.name for joint in mechanism.joints if body in joint.bodies)
        local = [mechanism.point(body, name) for name in (*joints, *(point for of, point in traces if of == body))]
        local += [end for one in ranges if one.slide.guide == body for end in (one.least, one.most)]
        corners = _corners(np.array(local))
        if len(corners) > 1:
            points = np.column_stack([motion.carried(body, complex(corner)).position for corner in corners])
            role = "outline" if body in sliding else "link"
            yield MovingStroke(points, role, named(body), closed=len(corners) > 2)


def _wheels(motion: Motion, named: Naming) -> Iterator[MovingStroke]:
    """The pitch circles of gears and of a rack's pinion, each with a radius that shows its turning.

    Radii r_1 = |i / (i - 1)| d and r_2 = |1 / (i - 1)| d of gears with the ratio i and the distance d of their centres;
    of a pinion |i| [m/rad]. A belt has no pitch circles: only the ratio of its pulleys is known.
    """
    mechanism, drawn = motion.plan.mechanism, set()
    for coupling in mechanism.couplings:
        middles = [motion.carried(body, mechanism.point(body, point)).position for body, point in coupling.ends]
        if coupling.kind == "rack":
            radii: list[float] = [abs(coupling.ratio)]
        elif coupling.kind == "gears" and coupling.ratio != 1:
            apart = float(np.nanmedian(np.abs(middles[1] - middles[0])))
            radii = [abs(share / (coupling.ratio - 1)) * apart for share in (coupling.ratio, 1.0)]
        else:
            radii = []
        for (body, point), middle, radius in zip(coupling.ends, middles, radii, strict=False):
            key = (body, point, round(radius / SAME))
            if key not in drawn:
                drawn.add(key)
                rim = np.concatenate(([0.0], radius * unit(np.linspace(0.0, turn, RIM + 1)))).astype(complex)
                points = middle[:, None] + motion.direction(body)[:, None] * rim
                yield MovingStroke(points, "wheel", named(body), closed=True)


def _corners(points: ComplexArray) -> ComplexArray:
    """The ends of points in a line; other points in order around their middle, each once."""
    farthest = points[np.argmax(np.abs(points - points[0]))]
    along = farthest - points[0]
    if abs(along) < SAME:
        return points[:1]
    off = np.asarray(cross(along / abs(along), points - points[0]))
    if np.abs(off).max() < SAME:
        share = np.asarray(dot(along, points))
        return np.asarray(points[[np.argmin(share), np.argmax(share)]])
    _, once = np.unique(np.round(points / SAME), return_index=True)
    kept = points[np.sort(once)]
    return np.asarray(kept[np.argsort(np.angle(kept - kept.mean()))])
