"""Parameters of a four-bar for a path."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray
from ilmek.errors import ParameterError
from ilmek.params.kind import choice, count, flag, length, text
from ilmek.params.text_lists import Bounds, read_angles, read_angles_or_free, read_bounds, read_points, read_two_points
from ilmek.synthesis.alt_burmester.task import PosesAndPoints
from ilmek.synthesis.path.task import FEWEST, KINDS, MOST, PathTask
from ilmek.synthesis.selection import FourBarTaskParams, ratio_limit
from ilmek.units import counted

LINE = "(20mm,20mm) (20mm,25mm) (20mm,30mm) (20mm,35mm) (20mm,40mm) (20mm,45mm)"
"""Case 1 of the literature's benchmarks: six points of a vertical line."""

EITHER = "either"

ANGLES = ("turn", "start")
LENGTHS = ("ground", "crank", "coupler", "rocker")

NAMED = {
    **{name: name for name in (*LENGTHS, *ANGLES)},
    "tracer_along": "along",
    "tracer_across": "across",
    "pivot_x": "x",
    "pivot_y": "y",
}
"""Bounds: their parameters, and their names in `PathTask.bounds`."""

EXACT = (3, 4, 5)
"""Timed points that are met exactly."""

NINE = 9
"""Points that are met exactly without timing."""


def _bounds(of: str, how: str = "like 10mm..60mm, ..60mm, or 60mm alone") -> Any:
    return text(None, doc=f"bounds on {of}, {how}")


@dataclass(frozen=True, slots=True)
class PathFourBarParams(FourBarTaskParams):
    """Task of a four-bar for a path: points, and limits."""

    points: str = text(LINE, doc="points in the order in which they are met: 4 to 200, or 3 to 5 where exact")
    timing: str | None = text(
        None, doc="crank angles at the points, like 30deg 45deg …; their differences count; default: free"
    )
    closed: bool = flag(False, doc="the path goes on from the last point to the first, once a turn of the crank")
    ordered: bool = flag(True, doc="the crank meets the points in their order, within one turn")
    exact: bool = flag(False, doc="all four-bars that meet 3 to 5 timed points, or nine points without timing, exactly")
    coupler_angles: str | None = text(
        None, doc="coupler's angle at each point where exact, or free: 0deg free 20deg …; 5, or 4 of 6, 3 of 7, 2 of 8"
    )
    pivots: str | None = text(
        None, doc="pivots of crank and rocker where 3 timed points are met exactly: (0,0) (9mm,0)"
    )
    kind: str = choice(
        "crank-rocker", (*KINDS, EITHER), doc="class that is searched, its crank turns; exact takes every class"
    )
    ground: str | None = _bounds("the ground link")
    crank: str | None = _bounds("the crank")
    coupler: str | None = _bounds("the coupler")
    rocker: str | None = _bounds("the rocker")
    tracer_along: str | None = _bounds("the tracer along the coupler, from A towards B")
    tracer_across: str | None = _bounds("the tracer across the coupler, to the left of A to B")
    pivot_x: str | None = _bounds("x of the crank's pivot")
    pivot_y: str | None = _bounds("y of the crank's pivot")
    turn: str | None = _bounds("the direction of the ground link", "like -20deg..20deg")
    start: str | None = _bounds("what is added to the timing to give crank angles against the ground link", "like 0")
    error_max: float | None = length(None, above=0.0, at_most=1e3, doc="greatest distance from a point")
    link_ratio_max: float | None = ratio_limit(None)
    cognates: bool = flag(False, doc="also the two other four-bars that trace the same curve as the chosen one")
    starts: int | None = count(
        None,
        at_least=1,
        at_most=10000,
        doc="random starts, exactly so many; default: 768 to 3072, until a nearer four-bar was missed with at most 5 %",
    )
    seed: int = count(0, at_least=0, at_most=10**9, doc="seed of the random starts: the same seed, the same answers")

    def check_together(self) -> None:
        """Raise ParameterError where the task cannot be read, or its method does not take it."""
        if self.coupler_angles is not None and (self.timing is not None or not self.exact):
            given = "coupler_angles are for points that are met exactly without timing"
            raise ParameterError(given, do="set exact=yes, leave timing out")
        if self.exact:
            _check_exact(self)
        else:
            self.tasks()

    def positions(self) -> ComplexArray:
        """The points [m]."""
        return read_points("points", self.points)

    def poses_and_points(self) -> PosesAndPoints:
        """The task of complete synthesis. Raises ParameterError where it does not determine four-bars."""
        points = self.positions()
        if self.coupler_angles is None:
            return PosesAndPoints(points, np.full(len(points), np.nan))
        return PosesAndPoints(points, read_angles_or_free("coupler_angles", self.coupler_angles))

    def angles(self) -> FloatArray | None:
        """The timing [rad]."""
        return None if self.timing is None else read_angles("timing", self.timing)

    def both_pivots(self) -> tuple[complex, complex] | None:
        """Pivots of crank and rocker [m], where they are given."""
        if self.pivots is None:
            return None
        crank, rocker = read_two_points("pivots", self.pivots)
        return complex(crank), complex(rocker)

    def tasks(self) -> tuple[PathTask, ...]:
        """The tasks of the search, one for each class. Raises ParameterError where the search does not take them."""
        points = self.positions()
        if not FEWEST <= len(points) <= MOST:
            given = f"a path of {counted(len(points), 'point')}"
            raise ParameterError(given, allowed=f"{FEWEST} to {MOST} are searched", do=_instead(len(points)))
        if self.pivots is not None:
            raise ParameterError(
                "pivots are for 3 timed points with exact=yes", do="fix the crank's with pivot_x=5mm, pivot_y=…"
            )
        timing, limits = self.angles(), self.limits()
        if timing is None and self.start is not None:
            raise ParameterError("start is given without a timing", do="set timing, or leave start out")
        kinds = tuple(KINDS) if self.kind == EITHER else (self.kind,)
        return tuple(
            PathTask(
                points,
                timing,
                self.closed,
                self.ordered,
                limits,
                kind,
                self.filters().least_transmission,
                math.inf if self.link_ratio_max is None else self.link_ratio_max,
                math.inf if self.size_max is None else self.size_max,
            )
            for kind in kinds
        )

    def limits(self) -> dict[str, Bounds]:
        """Bounds that are set, by the names of `PathTask.bounds` [m, rad]."""
        units, least = dict.fromkeys(ANGLES, "deg"), dict.fromkeys(LENGTHS, 0.0)
        return {
            name: read_bounds(parameter, given, units.get(parameter, "mm"), least=least.get(parameter, -math.inf))
            for parameter, name in NAMED.items()
            if (given := getattr(self, parameter)) is not None
        }


def _instead(count: int) -> str:
    """What to do with so many points."""
    if count > MOST:
        return "leave points out: a hand-drawn curve needs no more than 60"
    if count == 3:
        return "3 timed points are met exactly: set timing, pivots and exact=yes"
    return "give more points; a body that takes two or three poses: motion-four-bar"


def _check_exact(params: PathFourBarParams) -> None:
    """Raise ParameterError where the exact methods do not take the task."""
    points, timing = params.positions(), params.angles()
    _check_search_alone(params)
    if timing is None:
        _check_complete(params)
        return
    if len(points) not in EXACT:
        more = f"{FEWEST} to {MOST} points are searched for the nearest four-bar: leave exact out"
        given, allowed = f"exact=yes with {counted(len(points), 'point')}", "3 to 5 timed points are met exactly"
        raise ParameterError(given, allowed=allowed, do=more if len(points) > max(EXACT) else "give more points")
    if len(timing) != len(points):
        raise ParameterError(
            f"{counted(len(points), 'point')} and {counted(len(timing), 'angle')}", allowed="one angle for each point"
        )
    if (params.both_pivots() is None) == (len(points) == 3):
        what = "need both pivots" if len(points) == 3 else "leave no pivot free to give"
        do = "set pivots=(0,0) (9mm,0)" if len(points) == 3 else "leave pivots out"
        raise ParameterError(f"{len(points)} timed points {what}", do=do)


def _check_complete(params: PathFourBarParams) -> None:
    """Raise ParameterError where points without timing do not determine four-bars."""
    if params.pivots is not None:
        raise ParameterError("pivots are for 3 timed points with exact=yes", do="leave pivots out, or set timing")
    count = len(params.positions())
    if params.coupler_angles is None and count != NINE:
        allowed = "nine points, fewer with coupler_angles, or 3 to 5 points with a timing"
        do = "give nine points; or set coupler_angles, 0deg free 20deg …; or timing, 30deg 45deg …"
        raise ParameterError(f"exact=yes without a timing, with {counted(count, 'point')}", allowed=allowed, do=do)
    params.poses_and_points()


def _check_search_alone(params: PathFourBarParams) -> None:
    """Raise ParameterError where bounds of the search are given."""
    searched = [name for name in NAMED if getattr(params, name) is not None]
    if searched:
        given = f"{searched[0]} and exact=yes: bounds are for the search, exact four-bars leave nothing free"
        raise ParameterError(given, do=f"leave {' and '.join(searched)} out, or exact")
