"""A four-bar for a motion: the links that guide the body, and the four-bars made of two of them, judged and sieved."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.machines.four_bars.choice import FourBarOption, FourBarSelection, choose
from ilmek.machines.four_bars.filter_params import filters
from ilmek.machines.motion_four_bar.params import Bounds, MotionFourBarParams
from ilmek.machines.text_lists import BodyPoses
from ilmek.synthesis.burmester.curve import BurmesterCurve, burmester_curve
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
from ilmek.synthesis.task import PrecisionTask

JUDGED = 24
"""Pairs of links that are judged where there are curves or a plane of them."""

GRID, WIDE = 15, 1.5
"""Pivots of a grid along x and along y, and how far it reaches beyond the poses, in their greatest extent."""


@dataclass(frozen=True, slots=True, eq=False)
class MotionFourBar:
    """Four-bars for a motion.

    poses   what the body takes            curve   pivots and pins of four poses
    guides  the links that guide the body where they are few: of five poses, or those given      choice  the four-bars
    judged  how many pairs were judged, of how many links
    """

    params: MotionFourBarParams
    poses: BodyPoses
    curve: BurmesterCurve | None
    guides: tuple[Guide, ...]
    choice: FourBarSelection
    judged: tuple[int, int]

    @property
    def extent(self) -> float:
        """Greatest distance of two poses' points [m]; of a body that only turns, of its pins."""
        points = self.poses.points
        most = float(np.max(np.abs(points[:, None] - points)))
        best = self.choice.best
        return most or (best.candidate.size if best else 0.0) or 1.0


def design(params: MotionFourBarParams) -> MotionFourBar:
    """All four-bars of the poses, or the most promising ones where they are a family.

    Raises ParameterError where a whole family of links takes the poses.
    """
    poses = params.task()
    curve, guides, few = _guides(params, poses)
    inside = [one for one in guides if _inside(one.pivot, params.room())]
    pairs = [(one, other) for one in inside for other in inside if one is not other]
    if not few:
        ratio = params.link_ratio_max or np.inf
        pairs = list(promising(inside, *poses, most=JUDGED, link_ratio=ratio, full_turn=params.full_turn))
    task = PrecisionTask(points=poses.points, coupler=poses.angles)
    options, other = [], []
    for crank, rocker in pairs:
        joined = pair(crank, rocker, complex(poses.points[0]))
        if joined.four_bar is None:
            other.append(joined.said)
        else:
            options.append(
                FourBarOption(judge(joined.four_bar, task), _made(guides, crank, rocker) if few else "curve")
            )
    other += _unused(guides, inside, few, bool(pairs))
    other = list(dict.fromkeys(other))
    choice = choose(options, filters(params), number=params.chosen, count=params.count, other=other)
    return MotionFourBar(params, poses, curve, guides if few else (), choice, (len(pairs), len(inside)))


def _guides(params: MotionFourBarParams, poses: BodyPoses) -> tuple[BurmesterCurve | None, tuple[Guide, ...], bool]:
    """The curve of four poses, the links, and whether they are few: each with a number of its own."""
    if len(poses.points) == 5:
        return None, arms_through_five_poses(*poses), True
    if len(poses.points) == 4:
        return burmester_curve(*poses), burmester_curve(*poses, params.samples).guides(), False
    pivots, pins = params.given("pivots"), params.given("pins")
    if pivots is not None:
        return None, arms_of_pivots(*poses, pivots), True
    if pins is not None:
        return None, arms_of_pins(*poses, pins), True
    return None, arms_of_pivots(*poses, _grid(poses.points, params.room())), False


def _unused(guides: Sequence[Guide], inside: Sequence[Guide], few: bool, paired: bool) -> Iterator[str]:
    """Why links are in no four-bar, in words."""
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


def _grid(points: ComplexArray, room: tuple[Bounds, Bounds]) -> ComplexArray:
    """Pivots around the poses, within the room that is given."""
    reach = WIDE * (float(np.ptp(points.real)) + float(np.ptp(points.imag)) or 1.0)
    sides = [
        np.linspace(max(least, min(most, values.min() - reach)), min(most, max(least, values.max() + reach)), GRID)
        for values, (least, most) in zip((points.real, points.imag), room, strict=True)
    ]
    return np.unique(np.add.outer(sides[0], 1j * sides[1]))


def _inside(pivot: complex, room: tuple[Bounds, Bounds]) -> bool:
    (left, right), (low, high) = room
    return left <= pivot.real <= right and low <= pivot.imag <= high


def _made(guides: Sequence[Guide], crank: Guide, rocker: Guide) -> str:
    """Which links, by their numbers."""
    numbers = [next(at for at, one in enumerate(guides, 1) if one is wanted) for wanted in (crank, rocker)]
    return "links {} (crank) and {}".format(*numbers)


def spread(guide: Guide, poses: BodyPoses) -> float:
    """By how much what must be constant changes over the poses: of a crank its length [m]."""
    return float(np.ptp(guide.reach(*poses))) if guide.kind is not GuideKind.FREE else float("nan")
