"""A four-bar for a motion: the links that guide the body, and the four-bars of two of them, judged and filtered."""

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.motion_four_bar.params import MotionFourBarParams
from ilmek.params.text_lists import BodyPoses, Bounds
from ilmek.progress import SILENT, Progress
from ilmek.records import JsonObject, computed, record, result
from ilmek.report import Json
from ilmek.synthesis.burmester.curve import BurmesterCurve, CurveBranch, burmester_curve
from ilmek.synthesis.burmester.links import Guide, arms_of_pins, arms_of_pivots, arms_through_five_poses, pair
from ilmek.synthesis.candidate import Candidate, judge
from ilmek.synthesis.distinct import pins_of
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.merit import extent_of_points
from ilmek.synthesis.motion.certificate import certified
from ilmek.synthesis.motion.limits import MotionLimits, breaches
from ilmek.synthesis.motion.loosen import cures
from ilmek.synthesis.motion.search import MotionSpace, search_pairs
from ilmek.synthesis.selection import (
    FourBarDesign,
    FourBarOption,
    SearchedFamily,
    choose,
    of_best,
    single_cures,
    solutions,
)
from ilmek.synthesis.task import PrecisionTask

ONE_ANGLE = 1e-9
"""Difference of angles [rad] up to which the poses have one angle."""

TRANSLATION = "the poses have one angle: only parallelograms take them; turn a pose to have other four-bars"


@record
class MotionFourBar(FourBarDesign):
    """Four-bars for a motion.

    poses   of the body            curve   pivots and pins of four poses
    guides  the links that guide the body where they are few: of five poses, or those given
    """

    params: MotionFourBarParams
    poses: BodyPoses
    curve: BurmesterCurve | None
    guides: tuple[Guide, ...]
    judged: int = result("", "pairs of links that were judged, or searched where the links are a family")
    judged_links: int = result("", "links of these pairs")

    point_error = of_best(
        "mm", "greatest distance from a pose's point, from the solution's motion", lambda one: one.point_error
    )
    angle_error = of_best("deg", "greatest difference from a pose's angle", lambda one: one.angle_error)
    solutions = solutions()
    links = computed(
        "",
        "links that guide the body: kind; pivot and pin at the first pose (of sliders and blocks a direction), length",
        lambda it: [_link(guide) for guide in it.guides] or None,
        shown=False,
        optional=True,
    )

    @computed(
        "",
        "centre-point and circle-point curve, in segments of points in order; closed: the last joins the first",
        shown=False,
        optional=True,
    )
    def curves(self) -> Json:
        if self.curve is None:
            return None
        return {"pivots": _branches(self.curve.centre_branches), "pins": _branches(self.curve.circle_branches)}

    @property
    def extent(self) -> float:
        """Greatest distance of two poses' points [m]; of a body that only turns, the size of the four-bar."""
        return extent_of_points(self.poses.points) or (self.best.candidate.size if self.best else 0.0) or 1.0


def _link(guide: Guide) -> Json:
    """A link; None for a pivot, pin or length that is infinite or free."""
    sizes: JsonObject = {"pivot": guide.pivot, "pin": guide.pin, "length": guide.length}
    return {"kind": str(guide.kind), **{name: size if cmath.isfinite(size) else None for name, size in sizes.items()}}


def _branches(branches: Sequence[CurveBranch]) -> Json:
    places: list[Any] = [{"closed": branch.closed, "places": branch.points} for branch in branches]
    return places


def design(params: MotionFourBarParams, progress: Progress = SILENT) -> MotionFourBar:
    """All four-bars of the poses, or the best that differ where they are a family.

    Raises ParameterError where a whole family of links takes five poses, or a family of curves four; Cancelled.
    """
    poses, limits = params.task(), params.limits()
    guides = _guides(params, poses)
    if guides is None:
        return _searched(params, poses, limits, progress)
    inside = [guide for guide in guides if _inside(guide.pivot, limits.boxes[0])]
    options, other = [], []
    for crank, rocker in _pairs(params, inside):
        joined = pair(crank, rocker, complex(poses.points[0]))
        if joined.four_bar is None:
            other.append(joined.description)
        else:
            options.append(_option(joined.four_bar, poses, _numbers(guides, crank, rocker)))
    outside = len(guides) - len(inside)
    other += [f"links with a pivot outside pivot_x and pivot_y: {outside}"] if outside else []
    choice = choose(
        options,
        tuple(dict.fromkeys(other)),
        params,
        breaches=partial(breaches, limits=limits),
        task_only=params.task_only,
    )
    cures = () if choice.kept else single_cures(choice.removed)
    return MotionFourBar(
        choice=replace(choice, cures=cures),
        params=params,
        poses=poses,
        curve=None,
        guides=guides,
        judged=len(options) + len(other),
        judged_links=len(inside),
    )


def _guides(params: MotionFourBarParams, poses: BodyPoses) -> tuple[Guide, ...] | None:
    """The links where they are few: then each has a number. None where they are a family."""
    if len(poses.points) == 5:
        return arms_through_five_poses(*poses)
    pivots, pins = params.both("pivots"), params.both("pins")
    if pivots is not None:
        return arms_of_pivots(*poses, pivots)
    return None if pins is None else arms_of_pins(*poses, pins)


def _pairs(params: MotionFourBarParams, inside: Sequence[Guide]) -> list[tuple[Guide, Guide]]:
    """Pairs of links, the driven one first."""
    pairs = [(guide, other) for guide in inside for other in inside if guide is not other]
    if params.driven == "either":
        return pairs
    return pairs[:1] if params.driven == "first" else pairs[1:]


def _option(four_bar: FourBar, poses: BodyPoses, made: str, apart: float = math.nan) -> FourBarOption:
    candidate = judge(four_bar, PrecisionTask(points=poses.points, coupler=poses.angles))
    return FourBarOption(candidate, made, certified=certified(pins_of(four_bar), poses), apart=apart)


def _drawn(pins: ComplexArray, tracer: complex) -> FourBar:
    """The four-bar of its pivots A0, B0 and pins A, B [m]."""
    a0, b0, a, b = (complex(pin) for pin in pins)
    return FourBar(a0, b0, a, b, tracer)


def _searched(params: MotionFourBarParams, poses: BodyPoses, limits: MotionLimits, progress: Progress) -> MotionFourBar:
    """The best four-bars of three or four poses; where there is none, the nearest ones and what cures it."""
    drawn = burmester_curve(*poses) if len(poses.points) == 4 else None
    curve = None if drawn is None else burmester_curve(*poses, params.samples)
    space = MotionSpace(poses, curve, limits, params.links)
    found = search_pairs(space, params.count, progress.part(0.0, 0.5, "search"))
    tracer = complex(poses.points[0])
    options = [
        _option(_drawn(one.pins, tracer), poses, "search", one.apart)
        for one in (*found.pairs, *found.nearest)
        if np.isfinite(one.pins).all()
    ]
    other = (TRANSLATION,) if np.ptp(poses.angles) < ONE_ANGLE else ()
    choice = choose(options, other, params, breaches=partial(breaches, limits=limits), task_only=params.task_only)
    family = SearchedFamily(found.searched, found.found if choice.kept else 0, found.left_out)
    cured: tuple[str, ...] = ()
    if not choice.kept and params.loosen:

        def judged(pins: ComplexArray) -> Candidate:
            task = PrecisionTask(points=poses.points, coupler=poses.angles)
            return judge(_drawn(pins, tracer), task)

        cured = tuple(cure.words for cure in cures(space, judged, progress.part(0.5, 1.0, "loosen")))
    return MotionFourBar(
        choice=replace(choice, family=family, cures=cured),
        params=params,
        poses=poses,
        curve=drawn,
        guides=(),
        judged=found.searched,
        judged_links=space.link_count,
    )


def _inside(pivot: complex, ranges: tuple[Bounds, Bounds]) -> bool:
    (left, right), (low, high) = ranges
    return left <= pivot.real <= right and low <= pivot.imag <= high


def _numbers(guides: Sequence[Guide], crank: Guide, rocker: Guide) -> str:
    """The links of a four-bar by their numbers."""
    numbers = [next(at for at, guide in enumerate(guides, 1) if guide is link) for link in (crank, rocker)]
    return "links {} (crank) and {}".format(*numbers)
