"""Task of path synthesis: points to be met by a coupler point, and limits."""

import math
from collections.abc import Mapping
from dataclasses import field

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, NumberArray, RealField
from ilmek.errors import ParameterError
from ilmek.records import record
from ilmek.synthesis.path.links import random_links
from ilmek.synthesis.path.model import NAMES, SIZE, START, TURN
from ilmek.units import counted

FEWEST, MOST = 4, 200
"""Least and greatest number of points of a path."""

KINDS = {"crank-rocker": +1, "double-crank": -1}

SHORTEST, LONGEST = 1e-2, 10.0
"""Default bounds of a link, in sizes of the path; LONGEST also limits tracer and pivot."""

MIN_LINK = 1e-6
"""Least lower bound of a link, in sizes of the path: a link has a length."""

MAX_ROTATION = 2 * math.pi * (1 + 1e-9)
"""Greatest rotation of the crank over the points [rad]."""


@record
class PathTask:
    """Points to be met by the tracer of a four-bar, in this order.

    points        [m], complex, shape (points,), 4 to 200 points
    timing        crank angles at the points [rad]; their differences count; default: free crank
    closed        whether the path continues from the last point to the first, once per turn of the crank
    ordered       whether the crank must meet the points in order within one turn; always so with a timing
    bounds        name -> (low, high): ground, crank, coupler, rocker [m]; tracer in the coupler's frame along, across
                  [m] (from pin A, x to pin B); pivot of the crank x, y [m]; angle of the ground link turn [rad]; start
                  [rad], added to the timing ((0, 0): timing relative to the ground link). Equal bounds fix a number.
                  Defaults: links 0.01 to 10 sizes of the path (its greatest extent), tracer and pivot within 10 sizes,
                  turn and start free
    kind          crank-rocker (crank shortest) or double-crank (ground shortest); the crank rotates fully in both
    transmission  least angle between coupler and rocker, or its supplement, over the whole turn [rad]
    link_ratio    greatest ratio of the longest to the shortest link [1]; default: none
    size_max      greatest distance of two positions of pins and tracer over the whole turn [m]; default: none. The
                  search keeps 1 % free of it

    Raises ParameterError for another number of points, points that are not finite or coincide, a timing that is not
    monotonic or longer than a turn, and for bounds or limits that are unknown or exclude each other.
    """

    points: NumberArray
    timing: NumberArray | None = None
    closed: bool = False
    ordered: bool = True
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    kind: str = "crank-rocker"
    transmission: float = 0.0
    link_ratio: float = math.inf
    size_max: float = math.inf

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", np.asarray(self.points, dtype=complex))
        _check_points(self.points, self.timing is not None)
        if self.timing is not None:
            object.__setattr__(self, "timing", np.asarray(self.timing, dtype=float))
            _check_timing(np.asarray(self.timing), len(self.points))
        if self.kind not in KINDS:
            raise ParameterError(f"kind of four-bar {self.kind!r}", allowed="there are: " + ", ".join(KINDS))
        if not 0 <= self.transmission < math.pi / 2:
            raise ParameterError(
                f"least transmission angle {self.transmission:g} rad",
                allowed="0 to below pi/2 (90 deg), in radians",
                do=_degrees(self.transmission),
            )
        if not self.link_ratio >= 1:
            raise ParameterError(f"greatest ratio of links {self.link_ratio:g}", allowed="1 or more")
        if not self.size_max >= self.size:
            given = f"greatest size of the four-bar {self.size_max:g} m"
            raise ParameterError(given, allowed=f"the path alone extends over {self.size:g} m", do="set it higher")
        _check_bounds(self.bounds)
        _check_crank(self)

    @property
    def size(self) -> float:
        """Greatest extent of the points in x or y [m]."""
        return max(float(np.ptp(self.points.real)), float(np.ptp(self.points.imag)))

    @property
    def sign(self) -> int:
        """+1 for crank-rockers, -1 for double-cranks."""
        return KINDS[self.kind]

    @property
    def kappa(self) -> float:
        """Cosine of the least transmission angle."""
        return math.cos(self.transmission)

    def limits(self) -> tuple[FloatArray, FloatArray]:
        """Lower and upper bounds of the ten numbers [m; rad], in the order of `path.model.NAMES`."""
        middle, reach = self.points.mean(), LONGEST * self.size
        low, high = np.full(SIZE, -reach), np.full(SIZE, reach)
        low[:4] = SHORTEST * self.size
        for index, centre in ((6, middle.real), (7, middle.imag)):
            low[index], high[index] = centre - reach, centre + reach
        low[START - 1 :], high[START - 1 :] = -np.inf, np.inf
        for name, (least, most) in self.bounds.items():
            low[NAMES.index(name)], high[NAMES.index(name)] = least, most
        if self.timing is None:
            low[START] = high[START] = 0.0
        low[:4] = np.maximum(low[:4], MIN_LINK * self.size)
        return low, high


def _check_points(points: ComplexArray, timed: bool) -> None:
    """Raise ParameterError where the points do not define a path."""
    if points.ndim != 1 or not FEWEST <= len(points) <= MOST:
        few = "use exact synthesis for two or three points, with timing for up to five (dyads, timed paths)"
        do = few if points.size < FEWEST else "give fewer points: 60 suffice for a hand-drawn curve"
        raise ParameterError(f"a path of {counted(points.size, 'point')}", allowed=f"{FEWEST} to {MOST} points", do=do)
    bad = np.flatnonzero(~np.isfinite(points))
    if len(bad):
        raise ParameterError(f"point {bad[0] + 1} of the path is {points[bad[0]]}", allowed="finite points")
    if np.all(points == points[0]):
        raise ParameterError("all points of the path are the same", do="give different points")
    same = np.flatnonzero(points[1:] == points[:-1])
    if len(same) and not timed:
        given = f"points {same[0] + 1} and {same[0] + 2} of the path are the same"
        raise ParameterError(given, do="remove one of them, or give a timing for a dwell of the tracer")


def _check_timing(timing: FloatArray, count: int) -> None:
    """Raise ParameterError unless the crank angles are a valid timing."""
    if timing.shape != (count,) or not np.isfinite(timing).all():
        raise ParameterError(
            f"timing of {counted(timing.size, 'angle')} for {counted(count, 'point')}",
            allowed="one finite angle per point",
        )
    steps = np.diff(timing)
    if not ((steps > 0).all() or (steps < 0).all()):
        raise ParameterError("the crank angles of the timing are not monotonic", allowed="ascending or descending")
    turned = abs(timing[-1] - timing[0])
    if turned > MAX_ROTATION:
        given = f"the crank rotates by {turned:.4g} rad over the timing"
        raise ParameterError(given, allowed="at most one turn (6.283 rad)", do=_degrees(turned))


def _check_bounds(bounds: Mapping[str, tuple[float, float]]) -> None:
    """Raise ParameterError for bounds of unknown names, and for bounds in the wrong order or out of range."""
    for name, (low, high) in bounds.items():
        if name not in NAMES:
            raise ParameterError(f"bound of {name!r}", allowed="bounds of: " + ", ".join(NAMES))
        if not low <= high:
            raise ParameterError(f"{name} from {low:g} to {high:g}", allowed="lower bound first, then upper bound")
        if name in NAMES[:4] and not (low >= 0 and high > 0):
            raise ParameterError(f"{name} from {low:g} m to {high:g} m", allowed="a length is above 0")
        angle = max((abs(end) for end in (low, high) if math.isfinite(end)), default=0.0)
        if name in NAMES[TURN:] and angle > 2 * MAX_ROTATION:
            given = f"{name} from {low:g} rad to {high:g} rad"
            raise ParameterError(given, allowed="within two turns (12.57 rad)", do=_degrees(angle))


def _check_crank(task: PathTask) -> None:
    """Raise ParameterError where no lengths within the bounds meet the crank's limits; names those that clash."""
    low, high = (ends[:4] / task.size for ends in task.limits())
    if _possible(low, high, task):
        return
    clash = []
    for index, name in enumerate(NAMES[:4]):
        free_low, free_high = low.copy(), high.copy()
        free_low[index], free_high[index] = MIN_LINK, np.inf
        if _possible(free_low, free_high, task):
            clash.append(f"{name} {low[index] * task.size:.6g} m to {high[index] * task.size:.6g} m")
    if task.kappa < 1 and _possible(low, high, task, kappa=1.0):
        clash.append(f"a transmission angle of {math.degrees(task.transmission):.4g} deg")
    if task.link_ratio < math.inf and _possible(low, high, task, ratio=math.inf):
        clash.append(f"a ratio of links of {task.link_ratio:.4g}")
    named = " and ".join(clash) or "several bounds of its links"
    raise ParameterError(f"no {task.kind} is within the limits: {named} clash", do="widen one of them")


def _possible(
    low: FloatArray, high: FloatArray, task: PathTask, *, kappa: float | None = None, ratio: float | None = None
) -> bool:
    """Whether there are lengths within the bounds for the limits of a task, or for another kappa or ratio."""
    limits = {"kappa": task.kappa if kappa is None else kappa, "ratio": task.link_ratio if ratio is None else ratio}
    return len(random_links(np.random.default_rng(0), 64, (low, high), kind=task.sign, **limits)) > 0


def _degrees(angle: RealField) -> str:
    """Hint that an angle was probably given in degrees."""
    return f"if {angle:.4g} deg was meant, convert: {angle:.4g} * pi / 180"
