"""A four-bar for a motion: the links that guide the body, and the four-bars of two of them, judged and filtered."""

import cmath
from collections import Counter
from collections.abc import Iterator, Sequence

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.motion_four_bar.params import MotionFourBarParams
from ilmek.params.text_lists import BodyPoses, Bounds
from ilmek.records import computed, record, result
from ilmek.report import Json
from ilmek.synthesis.burmester.curve import BurmesterCurve, CurveBranch, burmester_curve
from ilmek.synthesis.burmester.links import (
    Guide,
    GuideKind,
    arms_of_pins,
    arms_of_pivots,
    arms_through_five_poses,
    pair,
)
from ilmek.synthesis.candidate import judge
from ilmek.synthesis.guide_pairs import promising
from ilmek.synthesis.selection import FourBarDesign, FourBarOption, choose, of_best, solutions
from ilmek.synthesis.task import PrecisionTask

JUDGED = 24
"""Pairs of links that are judged where there are curves or a plane of them."""

GRID, WIDE = 15, 1.5
"""Pivots of a grid along x and along y, and how far it reaches beyond the poses, in their greatest extent."""


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
    judged: int = result("", "pairs of links that were judged; where the links are a family the most promising")
    judged_links: int = result("", "links that these pairs were chosen from")

    point_error = of_best(
        "mm", "greatest distance from a pose's point, from the solution's motion", lambda one: one.point_error
    )
    angle_error = of_best("deg", "greatest difference from a pose's angle", lambda one: one.angle_error)
    solutions = solutions()
    links = computed(
        "",
        "links that guide the body: kind; pivot and pin at the first pose (of sliders and blocks a direction), length",
        lambda it: [_link(one) for one in it.guides] or None,
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
        points = self.poses.points
        most = float(np.max(np.abs(points[:, None] - points)))
        return most or (self.best.candidate.size if self.best else 0.0) or 1.0


def _link(one: Guide) -> Json:
    """A link; None for a pivot, pin or length that is infinite or free."""
    sizes = {"pivot": one.pivot, "pin": one.pin, "length": one.length}
    return {"kind": str(one.kind), **{name: size if cmath.isfinite(size) else None for name, size in sizes.items()}}


def _branches(branches: Sequence[CurveBranch]) -> Json:
    return [{"closed": branch.closed, "places": branch.points} for branch in branches]


def design(params: MotionFourBarParams) -> MotionFourBar:
    """All four-bars of the poses, or the most promising ones where they are a family.

    Raises ParameterError where a whole family of links takes the poses.
    """
    poses, ranges = params.task(), params.pivot_ranges()
    curve, guides, few = _guides(params, poses)
    inside = [one for one in guides if _inside(one.pivot, ranges)]
    pairs = [(one, other) for one in inside for other in inside if one is not other]
    if not few:
        ratio = params.link_ratio_max or np.inf
        pairs = list(promising(inside, *poses, most=JUDGED, link_ratio=ratio, full_turn=params.full_turn))
    task = PrecisionTask(points=poses.points, coupler=poses.angles)
    options, other = [], []
    for crank, rocker in pairs:
        joined = pair(crank, rocker, complex(poses.points[0]))
        if joined.four_bar is None:
            other.append(joined.description)
        else:
            made = _numbers(guides, crank, rocker) if few else "curve"
            options.append(FourBarOption(judge(joined.four_bar, task), made))
    other += _unused(guides, inside, few, bool(pairs))
    return MotionFourBar(
        choice=choose(options, tuple(dict.fromkeys(other)), params),
        params=params,
        poses=poses,
        curve=curve,
        guides=guides if few else (),
        judged=len(pairs),
        judged_links=len(inside),
    )


def _guides(params: MotionFourBarParams, poses: BodyPoses) -> tuple[BurmesterCurve | None, tuple[Guide, ...], bool]:
    """The curve of four poses, the links, and whether they are few: then each has a number."""
    if len(poses.points) == 5:
        return None, arms_through_five_poses(*poses), True
    if len(poses.points) == 4:
        return burmester_curve(*poses), burmester_curve(*poses, params.samples).guides(), False
    pivots, pins = params.both("pivots"), params.both("pins")
    if pivots is not None:
        return None, arms_of_pivots(*poses, pivots), True
    if pins is not None:
        return None, arms_of_pins(*poses, pins), True
    return None, arms_of_pivots(*poses, _grid(poses.points, params.pivot_ranges())), False


def _unused(guides: Sequence[Guide], inside: Sequence[Guide], few: bool, paired: bool) -> Iterator[str]:
    """Why links are in no four-bar."""
    outside = len(guides) - len(inside)
    if outside and few:
        yield f"links with a pivot outside pivot_x and pivot_y: {outside}"
    if few or paired:
        return
    odd = Counter(one.kind for one in inside if one.kind is not GuideKind.CRANK)
    for kind, count in odd.items():
        yield f"{count} of {len(inside)} links are no cranks: {kind.words}"
    cranks = len(inside) - odd.total()
    if cranks:
        yield f"of {cranks} cranks no two keep one branch, the order of the poses and link_ratio_max"


def _grid(points: ComplexArray, ranges: tuple[Bounds, Bounds]) -> ComplexArray:
    """Pivots around the poses, within the given bounds."""
    reach = WIDE * (float(np.ptp(points.real)) + float(np.ptp(points.imag)) or 1.0)
    ends = (
        np.clip([values.min() - reach, values.max() + reach], *bounds)
        for values, bounds in zip((points.real, points.imag), ranges, strict=True)
    )
    sides = [np.linspace(start, stop, GRID) for start, stop in ends]
    return np.unique(np.add.outer(sides[0], 1j * sides[1]))


def _inside(pivot: complex, ranges: tuple[Bounds, Bounds]) -> bool:
    (left, right), (low, high) = ranges
    return left <= pivot.real <= right and low <= pivot.imag <= high


def _numbers(guides: Sequence[Guide], crank: Guide, rocker: Guide) -> str:
    """The links of a four-bar by their numbers."""
    numbers = [next(at for at, one in enumerate(guides, 1) if one is link) for link in (crank, rocker)]
    return "links {} (crank) and {}".format(*numbers)
