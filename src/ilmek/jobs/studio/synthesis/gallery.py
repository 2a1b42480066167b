"""The four-bars of a synthesis as records for the gallery: dimensions, merit, motion, curve, errors."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.jobs.studio.synthesis.answers import (
    GeneratedFunction,
    LeftOutFourBar,
    LeftOutReason,
    LoosenedLimit,
    PivotCurves,
    ShownFourBar,
    ShownMerit,
    ShownMotion,
    ShownPosition,
)
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.machines.function_four_bar import FunctionFourBar
from ilmek.machines.motion_four_bar import MotionFourBar
from ilmek.records import alike
from ilmek.report import Json
from ilmek.synthesis.approximation.function_generator import FunctionApproximation
from ilmek.synthesis.burmester.curve import CurveBranch
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.circuit_loops import LoopConfigurations, circuit_loops
from ilmek.synthesis.filters import REASONS
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.merit import Merit, merit_value
from ilmek.synthesis.selection import PINS, FourBarDesign, FourBarOption, FourBarSelection, finite
from ilmek.units import turn

POSITIONS = 120
"""Positions of a motion, and points of a curve."""

LISTED = 24
"""Greatest number of four-bars that are listed as left out."""

DIGITS = 8
"""Decimals of a position in motion [m]: 10 nm."""

LONGEST = 300
"""Greatest number of points of a part of the curves of pivots and pins."""

NO_POINTS = np.zeros(0, dtype=complex)

_SETTING = re.compile(r"(\w+)=(.+?) (?:instead of|gives) ")


def gallery(design: FourBarDesign) -> tuple[ShownFourBar, ...]:
    """The four-bars within all limits, the best first."""
    task_only = isinstance(design, MotionFourBar) and design.params.task_only
    shown = tuple(_shown(number, option, task_only=task_only) for number, option in enumerate(design.choice.kept, 1))
    if not isinstance(design, FunctionFourBar):
        return shown
    return tuple(
        replace(
            one,
            motion=_motion_over_range(
                approximation.four_bar, finite(option.details["crank_start"]), design.function.crank_swing
            ),
            function=_generated(approximation),
        )
        for one, option, approximation in zip(shown, design.choice.kept, design.approximations, strict=True)
    )


def _shown(number: int, option: FourBarOption, *, task_only: bool) -> ShownFourBar:
    candidate, details = option.candidate, option.details
    active = details.get("active")
    return alike(
        ShownFourBar,
        candidate,
        number=number,
        pins=pins(candidate.four_bar),
        links=candidate.four_bar.lengths._asdict(),
        class_name=candidate.grashof.kind,
        branch=candidate.four_bar.branch,
        positions=tuple(alike(ShownPosition, met) for met in candidate.positions),
        transmission=candidate.transmission_over(task_only=task_only),
        merit=None if option.merit is None else _merit(option.merit),
        error_max=_error_max(candidate, details),
        error_rms=finite(details.get("error_rms")),
        apart=option.apart,
        certified=option.certified or details.get("proven") is True,
        made=option.made,
        active=tuple(str(limit) for limit in active) if isinstance(active, list) else (),
        motion=_motion(candidate),
        curve=_whole_curve(candidate),
    )


def _error_max(candidate: Candidate, details: Mapping[str, Json]) -> float:
    """Greatest error that the method reports; else that of the check, of points before that of angles."""
    reported = finite(details.get("error_max"))
    if math.isfinite(reported):
        return reported
    return candidate.point_error if math.isfinite(candidate.point_error) else candidate.angle_error


def pins(four_bar: FourBar) -> dict[str, list[float]]:
    """Pivots, pins and tracer of a four-bar as drawn [m], unrounded: the same four-bar can be made from them."""
    known = {name: getattr(four_bar, name) for name in PINS}
    return {name: [at.real, at.imag] for name, at in known.items() if at is not None}


def _merit(merit: Merit) -> ShownMerit:
    terms = {
        "transmission": merit.transmission,
        "size": merit.size,
        "ratio": merit.ratio,
        "sensitivity": merit.sensitivity,
    }
    best = (1.0, 0.0, 1.0, 0.0)
    own = (math.sin(merit.transmission), merit.size, merit.ratio, merit.sensitivity)
    factors = {name: float(merit_value(*(*best[:at], own[at], *best[at + 1 :]))) ** 4 for at, name in enumerate(terms)}
    return ShownMerit(merit.value, terms, factors, merit.point_shift, merit.angle_shift)


def _motion(candidate: Candidate) -> ShownMotion:
    """The turn of a crank that turns fully, or the motion from the first to the last position."""
    closed = candidate.crank_turns or not candidate.one_branch
    angles = turn * np.arange(POSITIONS) / POSITIONS
    moved = candidate.motion(POSITIONS) if candidate.one_branch else _loop(candidate, angles)
    tracer = moved.tracer if candidate.four_bar.tracer is not None else NO_POINTS
    return ShownMotion(flat(moved.a), flat(moved.b), flat(tracer), closed)


def _motion_over_range(four_bar: FourBar, start: float, swing: float) -> ShownMotion:
    """The motion over the range of a function: the crank from its start by its swing [rad], on the branch as drawn."""
    motion = solve(plan(four_bar.mechanism()), np.linspace(start, start + swing, POSITIONS))
    a, b = (np.asarray(motion.point("coupler", name).position) for name in ("A", "B"))
    closes = np.isfinite(b)
    return ShownMotion(flat(a[closes]), flat(b[closes]), [], closed=False)


def _whole_curve(candidate: Candidate) -> list[float]:
    """The whole circuit of the first position as the tracer draws it."""
    if candidate.four_bar.tracer is None:
        return []
    return flat(_loop(candidate, np.linspace(0.0, turn, POSITIONS + 1)).tracer)


def _loop(candidate: Candidate, u: FloatArray) -> LoopConfigurations:
    """Positions on the circuit of the first position."""
    return circuit_loops(candidate.four_bar)[max(candidate.positions[0].circuit - 1, 0)].at(u)


def flat(points: ComplexArray) -> list[float]:
    """Points as x, y, x, y, … [m], rounded to `DIGITS` decimals."""
    rows = np.stack([points.real, points.imag], axis=-1).round(DIGITS)
    interleaved: list[float] = rows.ravel().tolist()
    return interleaved


def _generated(approximation: FunctionApproximation) -> GeneratedFunction:
    curve = approximation.curve
    rows = (curve.x, curve.required, curve.generated, curve.error)
    x, required, generated, error = (np.asarray(row).round(9).tolist() for row in rows)
    extremes = np.asarray(approximation.at).tolist()
    return GeneratedFunction(x, required, generated, error, extremes, float(approximation.drawn_at))


def reasons(choice: FourBarSelection) -> tuple[LeftOutReason, ...]:
    """The limits that four-bars miss, the most frequent first."""
    counts: Mapping[str, int] = choice.left_out
    ordered = sorted(counts.items(), key=lambda reason: -reason[1])
    return tuple(LeftOutReason(name, REASONS.get(name, name), count) for name, count in ordered)


def left_out(choice: FourBarSelection) -> tuple[LeftOutFourBar, ...]:
    """The first four-bars that were left out, each with its reasons; those with the fewest reasons first."""
    ordered = sorted(choice.removed, key=lambda removed: len(removed[1]))[:LISTED]
    return tuple(LeftOutFourBar(pins(removed.candidate.four_bar), removed.made, dict(why)) for removed, why in ordered)


def loosened(cures: Sequence[str]) -> tuple[LoosenedLimit, ...]:
    """Single limits that give a four-bar if they are loosened, with the setting that does it.

    >>> loosened(["size_max=210mm instead of 200 mm gives 3"])[0].value
    '210mm'
    """
    cures_read = [(words, _SETTING.match(words)) for words in cures]
    return tuple(LoosenedLimit(words, *(known.groups() if known else ())) for words, known in cures_read)


def pivot_curves(design: FourBarDesign) -> PivotCurves | None:
    """The curves of pivots and pins of four poses; None of other tasks."""
    curve = getattr(design, "curve", None)
    if curve is None:
        return None
    return PivotCurves(_parts(curve.centre_branches), _parts(curve.circle_branches))


def _parts(branches: Sequence[CurveBranch]) -> tuple[list[float], ...]:
    """Parts of a curve, thinned to `LONGEST` points."""
    return tuple(
        flat(_thinned(np.append(branch.points, branch.points[:1] if branch.closed else []))) for branch in branches
    )


def _thinned(points: ComplexArray) -> ComplexArray:
    step = max(1, math.ceil(len(points) / LONGEST))
    return np.append(points[:-1:step], points[-1:])


def function_required(design: FourBarDesign) -> list[list[float]] | None:
    """X and the required rotation of the rocker of a function [rad]; None of other tasks."""
    if not isinstance(design, FunctionFourBar):
        return None
    function = design.function
    x = np.linspace(function.start, function.stop, POSITIONS + 1)
    return [x.tolist(), np.asarray(function.rocker(x)).tolist()]


def task_points(design: object) -> tuple[list[list[float]], list[float]]:
    """The points [m] of the task, and the angles of its poses [rad]; empty where it has none."""
    if isinstance(design, MotionFourBar):
        points, angles = design.poses
        return _pairs(points), angles.tolist()
    return _pairs(getattr(design, "points", NO_POINTS)), []


def _pairs(points: ComplexArray) -> list[list[float]]:
    return [[float(at.real), float(at.imag)] for at in points]
