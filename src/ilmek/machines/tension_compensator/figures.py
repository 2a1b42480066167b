"""The compensator's figures: from the side, tensions over the turn, forces over the turn."""

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.tension_compensator.analysis import CompensatorAnalysis
from ilmek.machines.tension_compensator.design import TensionCompensator
from ilmek.machines.tension_compensator.geometry import Lever
from ilmek.report import Axis, Dot, Drawing, Figure, Plot, Series, Stroke
from ilmek.units import turn

RING = np.exp(1j * np.linspace(0, turn, 73))


def figures(found: CompensatorAnalysis) -> tuple[Figure, ...]:
    """All figures, in the order of the report."""
    return side_view(found.design), tension_plot(found), travel_plot(found), force_plot(found)


def tension_plot(found: CompensatorAnalysis) -> Plot:
    """Tension of both parities over the turn, and that on fixed rods."""
    design, x = found.design, found.angle
    ends = np.array([0.0, turn])
    fixed = Series("open shed, fixed rods", ends, np.full(2, design.fixed_tension), dashed=True)
    allowed = Series("allowed", ends, np.full(2, design.params.tension_most * design.params.tension), dashed=True)
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
    """Both parities from the side, to scale: even warps in the open shed on the right, odd ones at rest on the left."""
    half = design.half_depth
    right = _parity(design, design.one.angle, dashed=True)
    left = _parity(design, 0.0, dashed=False)
    strokes = [_moved(stroke, half) for stroke in right]
    strokes += [_mirrored(stroke, half) for stroke in left] if design.bars > 1 else []
    lever = design.one.lever
    dots = [Dot(lever.pivot + half, "pivot", "pivot"), Dot(complex(lever.anchor) + half, "anchor", "pivot")]
    note = "right: a bar in the open shed, dashed at rest; left: the other parity at rest"
    return Drawing("tension-compensator-side", "Compensator from the side", tuple(strokes), tuple(dots), note=note)


def _parity(design: TensionCompensator, angle: float, *, dashed: bool) -> list[Stroke]:
    """Rods, bar, warps, lever and springs of a parity, its sheet on x = 0."""
    lever, radius = design.one.lever, design.radius
    path, bar = lever.path, complex(lever.bar(angle))
    strokes = [Stroke(_warp(lever, bar), "yarn", "warps" if dashed else "")]
    rods = (complex(-radius, path.half), complex(-radius, -path.half))
    strokes += [Stroke(rod + radius * RING, "outline", closed=True, filled=True) for rod in rods]
    strokes.append(Stroke(bar + radius * RING, "outline", "bar" if dashed else "", closed=True, filled=True))
    end = lever.pivot + lever.reach * np.exp(-1j * angle)
    strokes.append(Stroke(np.array([bar, lever.pivot, end]), "link", "lever" if dashed else ""))
    strokes.append(Stroke(_coil(complex(lever.anchor), complex(end)), "path"))
    if dashed:
        strokes.append(Stroke(lever.rest + radius * RING, "construction", closed=True))
    return strokes


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


def _coil(start: complex, end: complex) -> ComplexArray:
    """A spring from end to end, as a zigzag."""
    along, across = end - start, 1j * (end - start) / abs(end - start) * 0.012
    shares = np.linspace(0.15, 0.85, 15)
    zigzag = start + along * shares + across * (-1.0) ** np.arange(15)
    return np.concatenate([[start, start + 0.12 * along], zigzag, [start + 0.88 * along, end]])


def _moved(stroke: Stroke, by: float) -> Stroke:
    return Stroke(stroke.points + by, stroke.role, stroke.label, stroke.closed, stroke.filled)


def _mirrored(stroke: Stroke, by: float) -> Stroke:
    return Stroke(-np.conj(stroke.points + by), stroke.role, stroke.label, stroke.closed, stroke.filled)
