"""The compensator's figures: its parts from the side and in motion, tensions and forces over the turn."""

import math

import numpy as np

from ilmek.arrays import Complex, ComplexArray, FloatArray
from ilmek.machines.part_views import drawn, named_strokes
from ilmek.machines.tension_compensator.analysis import SAMPLES, CompensatorAnalysis
from ilmek.machines.tension_compensator.design import TensionCompensator
from ilmek.machines.tension_compensator.geometry import Lever
from ilmek.machines.tension_compensator.members import part_id
from ilmek.machines.tension_compensator.tree import EVEN, ODD, lever_motion, tree
from ilmek.part.projection import View, moving_outlines, outlines
from ilmek.report import Animation, Axis, Dot, Drawing, Figure, MovingStroke, Plot, Reading, Series, Stroke
from ilmek.units import turn

_TURN = "cams"
"""Drive of the figures' motions."""

_EVERY = 3
"""Samples of the analysis from frame to frame."""


def figures(found: CompensatorAnalysis) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    return side_view(found.design), moving(found), tension_plot(found), travel_plot(found), force_plot(found)


def tension_plot(found: CompensatorAnalysis) -> Plot:
    """Tension of both parities over the turn, and that on fixed rods."""
    design, x = found.design, found.angle
    ends = np.array([0.0, turn])
    fixed = Series("open shed, fixed rods", ends, np.full(2, design.fixed_tension), dashed=True)
    allowed = Series(
        "allowed", ends, np.full(2, design.params.tension_most * design.params.cloth.warp_tension), dashed=True
    )
    series = (Series("even warps", x, found.even), Series("odd warps", x, found.odd), allowed, fixed)
    axes = Axis("cam angle", "deg"), Axis("tension", "N")
    return Plot("tension-compensator-tension", "Tension of a warp over the turn", *axes, series)


def travel_plot(found: CompensatorAnalysis) -> Plot:
    """Travel of the even warps' bar, or of the only one, and the warp that it gives, over the turn."""
    lever = found.design.one.lever
    travel = np.abs(lever.bar(found.rotation) - lever.rest)
    series = (
        Series("travel of the bar", found.angle, np.asarray(travel)),
        Series("warp that it gives", found.angle, lever.slack(found.rotation)),
    )
    axes = Axis("cam angle", "deg"), Axis("length", "mm")
    return Plot("tension-compensator-travel", "Travel of a bar over the turn", *axes, series)


def force_plot(found: CompensatorAnalysis) -> Plot:
    """Force of a spring and of a lever's pivot over the turn."""
    series = (Series("one spring", found.angle, found.spring), Series("pivot of a lever", found.angle, found.pivot))
    axes = Axis("cam angle", "deg"), Axis("force", "N")
    return Plot("tension-compensator-forces", "Forces of a lever over the turn", *axes, series)


def side_view(design: TensionCompensator) -> Drawing:
    """The parts from the side, to scale: even warps in the open shed on the right, odd ones at rest on the left."""
    opened = lever_motion(_TURN, np.array([0.0, math.pi, turn]), np.array([0.0, design.one.angle, 0.0]))
    seen = outlines(tree(design, {EVEN: opened}), View.FRONT, _TURN, math.pi)
    lifted, resting = (_warps(design, np.array([angle]))[0] for angle in (design.one.angle, 0.0))
    warps = (Stroke(lifted, "yarn", "warps"), *((Stroke(_mirrored(resting), "yarn"),) if design.bars > 1 else ()))
    note = "right: a bar in the open shed; left: the other parity at rest; dashed: what is bought"
    title = "Compensator from the side"
    return Drawing("tension-compensator-side", title, (*drawn(seen), *warps), _pivots(design)[:2], note=note)


def moving(found: CompensatorAnalysis) -> Animation:
    """A turn of the cams from the side: even warps on the right, odd ones on the left; one bar carries both."""
    design, shown = found.design, slice(0, SAMPLES - 1, _EVERY)
    at, rotation = found.angle[shown], found.rotation[shown]
    later = np.roll(rotation, at.size // 2)
    bodies = tree(design, {EVEN: lever_motion(_TURN, at, rotation), ODD: lever_motion(_TURN, at, later)})
    swung = tuple(body.id for body in bodies.bodies if body.joint.motion is not None)
    seen = outlines(bodies, View.FRONT)
    standing = [outline for outline in seen if outline.body not in swung and outline.part.id != part_id("spring")]
    strokes = [
        *named_strokes(moving_outlines(bodies, View.FRONT, _TURN, at, swung)),
        MovingStroke(_warps(design, rotation), "yarn", "even warps" if design.bars > 1 else "warps"),
        MovingStroke(_springs(design, rotation), "path", "springs"),
    ]
    if design.bars > 1:
        strokes.append(MovingStroke(_mirrored(_warps(design, later)), "yarn", "odd warps"))
        strokes.append(MovingStroke(_mirrored(_springs(design, later)), "path", "springs"))
    readings = (
        Reading("tension of an even warp", found.even[shown], "N"),
        Reading("tension of an odd warp", found.odd[shown], "N"),
        Reading("travel of the bar", np.abs(design.one.lever.bar(rotation) - design.one.lever.rest), "mm"),
        Reading("force of a spring", found.spring[shown], "N"),
    )
    still = Drawing("tension-compensator-moving", "Compensator in motion", drawn(standing), _pivots(design))
    period = turn / design.params.speed if design.params.speed > 0 else None
    return Animation(still, Axis("cam angle", "deg"), at, tuple(strokes), (), period=period, readings=readings)


def _pivots(design: TensionCompensator) -> tuple[Dot, ...]:
    """Pivots of the levers and anchors of the springs, those of the even warps first and named."""
    lever = design.one.lever
    points = [(point + design.half_depth, name) for point, name in ((lever.pivot, "pivot"), (lever.anchor, "anchor"))]
    other = [(-complex(point).conjugate(), "") for point, _ in points] if design.bars > 1 else []
    return tuple(Dot(complex(point), name, "pivot") for point, name in (*points, *other))


def _mirrored(points: ComplexArray) -> ComplexArray:
    return np.asarray(-np.conj(points))


def _warps(design: TensionCompensator, rotation: FloatArray) -> Complex[np.ndarray, "frames points"]:
    """A warp over both rods and the bar, at rotations of its lever [m]."""
    lever = design.one.lever
    bars = [complex(bar) for bar in np.atleast_1d(lever.bar(rotation))]
    return np.asarray(np.stack([_warp(lever, bar) for bar in bars]) + design.half_depth)


def _warp(lever: Lever, bar: complex) -> ComplexArray:
    """The warp from above the upper rod to below the lower one."""
    path, r = lever.path, lever.path.radius
    upper, lower = (float(angle) for angle in path.strands(np.asarray(bar)))
    top, low = complex(-r, path.half), complex(-r, -path.half)
    around = [
        np.array([top + r + 1.5j * path.half * 0.5]),
        top + r * np.exp(-1j * np.linspace(0, upper, 9)),
        bar - r * np.exp(1j * np.linspace(-upper, lower, 17)),
        low + r * np.exp(1j * np.linspace(lower, 0, 9)),
        np.array([low + r - 1.5j * path.half * 0.5]),
    ]
    return np.concatenate(around)


def _springs(design: TensionCompensator, rotation: FloatArray) -> Complex[np.ndarray, "frames points"]:
    """The springs between anchor and lever, as a zigzag, at rotations of the lever [m]."""
    lever = design.one.lever
    start, end = complex(lever.anchor), (lever.pivot + lever.reach * np.exp(-1j * rotation))[:, None]
    along = end - start
    shares, aside = np.array([0.0, 0.12, *np.linspace(0.15, 0.85, 15), 0.88, 1.0]), np.zeros(19)
    aside[2:17] = 0.012 * (-1.0) ** np.arange(15)
    return np.asarray(start + along * (shares + 1j * aside / np.abs(along)) + design.half_depth)
