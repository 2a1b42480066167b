"""Limits of a four-bar for a motion, in SI, and as the arrays of a search in the task's frame.

A new limit is one record of `LIMITS`, with its measure and how it is loosened, beside its field of `MotionLimits` and
its margin in the search (`measures`).
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import field, replace

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.params.text_lists import Bounds
from ilmek.records import JsonObject, record
from ilmek.synthesis.burmester.constant_distance import TaskFrame
from ilmek.synthesis.candidate import Candidate, task_rotation
from ilmek.synthesis.filters import Filters, defects
from ilmek.synthesis.motion import measures, regions
from ilmek.units import deg, format_quantity, mm

NOWHERE = np.zeros(0, dtype=complex)
"""No polygon."""

PLANE: tuple[Bounds, Bounds] = ((-math.inf, math.inf), (-math.inf, math.inf))
"""Bounds on x and y that hold everywhere."""

TURN: Bounds = (0.0, math.inf)


@record
class MotionLimits:
    """What a four-bar must fulfil besides taking its poses.

    filters       against defects, and limits of every four-bar
    boxes         bounds on x and y of the pivots of crank and rocker [m]
    crank_region, rocker_region   polygons of these pivots [m]; empty: anywhere
    keep_out      polygon that crank, coupler and rocker must not touch during the motion [m]; empty: none
    crank_swing   least and greatest rotation of the crank from the first to the last pose [rad]
    rocker_swing  least and greatest swing of the rocker over the motion [rad]
    task_only     whether the transmission angle is that from the first to the last pose, also of a crank that turns
                  fully; else that of its whole turn
    """

    filters: Filters
    boxes: tuple[tuple[Bounds, Bounds], tuple[Bounds, Bounds]] = (PLANE, PLANE)
    crank_region: ComplexArray = field(default_factory=lambda: NOWHERE)
    rocker_region: ComplexArray = field(default_factory=lambda: NOWHERE)
    keep_out: ComplexArray = field(default_factory=lambda: NOWHERE)
    crank_swing: Bounds = TURN
    rocker_swing: Bounds = TURN
    task_only: bool = False

    @property
    def same_regions(self) -> bool:
        """Whether both pivots have one region, so that every link can be crank and rocker."""
        same = self.crank_region is self.rocker_region or np.array_equal(self.crank_region, self.rocker_region)
        return self.boxes[0] == self.boxes[1] and same

    @property
    def polygons(self) -> tuple[ComplexArray, ComplexArray]:
        """Polygons of the pivots of crank and rocker [m]."""
        return self.crank_region, self.rocker_region

    @property
    def scale(self) -> float:
        """Size of a task whose body only turns [m]: a third of the greatest size, else 0.1 m."""
        return (self.filters.size_max or 0.3) / 3

    def in_frame(self, frame: TaskFrame, extent: float) -> measures.SearchBounds:
        """The arrays of a search; extent  of the poses in sizes of the frame [1]."""
        filters, limits = self.filters, np.zeros(measures.LIMITS)
        limits[measures.EVEN_RATIO] = filters.link_ratio_max or math.inf
        limits[measures.ONE_BRANCH] = filters.one_branch
        limits[measures.ONE_CIRCUIT] = filters.one_circuit
        limits[measures.IN_ORDER] = filters.in_order
        limits[measures.FULL_TURN] = filters.full_turn
        limits[measures.LEAST_SINE] = math.sin(filters.least_transmission)
        limits[measures.TASK_ONLY] = self.task_only
        limits[measures.SIZE_MAX] = (filters.size_max or math.inf) / frame.size
        limits[measures.EXTENT] = extent
        limits[measures.CRANK_LOW], limits[measures.CRANK_HIGH] = self.crank_swing
        limits[measures.ROCKER_LOW], limits[measures.ROCKER_HIGH] = self.rocker_swing
        polygons = (frame.to_frame(one) for one in (self.crank_region, self.rocker_region, self.keep_out))
        return measures.SearchBounds(limits, np.array([_box(box, frame) for box in self.boxes]), *polygons)


def _box(box: tuple[Bounds, Bounds], frame: TaskFrame) -> Sequence[float]:
    """Least and greatest x, then y, in the frame."""
    origins = (frame.origin.real, frame.origin.imag)
    return [(end - origin) / frame.size for bounds, origin in zip(box, origins, strict=True) for end in bounds]


KEPT = 1e-9
"""Distance outside a region, relative to the four-bar's size, that counts as rounding."""

SWING = 1e-4
"""Difference from a limit of a swing [rad] that counts as rounding of its samples."""

FINE = 1081
"""Positions at which swing and clearance are computed."""


Stated = tuple[str, str, MotionLimits]
"""Setting of a loosened limit and the value given, as texts, and the limits with exactly this value."""


@record
class MotionLimit(ABC):
    """A limit, by the name of its parameter; `Filters` judge those that they have themselves."""

    name: str

    @abstractmethod
    def is_given(self, limits: MotionLimits) -> bool:
        """Whether it is given."""

    @abstractmethod
    def loosened(self, limits: MotionLimits, share: float, size: float) -> MotionLimits:
        """The limits with this one loosened by a share of its value; inf drops it. size  of the task [m]."""

    def breach(self, one: Candidate, limits: MotionLimits) -> str:  # noqa: ARG002
        """Why a candidate does not keep it, as a sentence; "": it does."""
        return ""

    def stated(self, given: MotionLimits, loose: MotionLimits, share: float) -> Stated:  # noqa: ARG002
        """The loosened limit in words, rounded to what can be typed."""
        return f"{self.name} enlarged by {100 * share:.3g} % about its middle", "the one given", loose

    def among(self, limits: MotionLimits, value: object) -> MotionLimits:
        """The limits with this one of another value."""
        if hasattr(limits.filters, self.name):
            return replace(limits, filters=replace(limits.filters, **{self.name: value}))  # type: ignore[arg-type]
        changed: JsonObject = {self.name: value}
        return replace(limits, **changed)


@record
class FlagLimit(MotionLimit):
    """A requirement that is dropped altogether."""

    def is_given(self, limits: MotionLimits) -> bool:
        """Whether the flag is set."""
        return bool(getattr(limits.filters, self.name))

    def loosened(self, limits: MotionLimits, share: float, size: float) -> MotionLimits:  # noqa: ARG002
        """The limits without it."""
        return self.among(limits, False)


@record
class GreatestLimit(MotionLimit):
    """A greatest size or ratio; unit  in which it is shown, "" for a ratio."""

    unit: str = ""

    def is_given(self, limits: MotionLimits) -> bool:
        """Whether there is a value."""
        return getattr(limits.filters, self.name) is not None

    def loosened(self, limits: MotionLimits, share: float, size: float) -> MotionLimits:  # noqa: ARG002
        """A greater value, of at most 1000."""
        value = getattr(limits.filters, self.name)
        return self.among(limits, None if math.isinf(share) else min(value * (1 + share), 1e3))

    def stated(self, given: MotionLimits, loose: MotionLimits, share: float) -> Stated:  # noqa: ARG002
        """Rounded up to four digits."""
        factor, before = mm if self.unit else 1.0, getattr(given.filters, self.name)
        value = _rounded_up(getattr(loose.filters, self.name), factor)
        instead = format_quantity(before, self.unit) if self.unit else f"{before:g}"
        return f"{self.name}={value / factor:.4g}{self.unit}", instead, self.among(loose, value)


@record
class TransmissionLimit(MotionLimit):
    """The least transmission angle."""

    def is_given(self, limits: MotionLimits) -> bool:
        """Whether it is above 0."""
        return bool(limits.filters.transmission_min)

    def loosened(self, limits: MotionLimits, share: float, size: float) -> MotionLimits:  # noqa: ARG002
        """A smaller angle."""
        return self.among(limits, limits.filters.transmission_min * max(0.0, 1 - share))

    def stated(self, given: MotionLimits, loose: MotionLimits, share: float) -> Stated:  # noqa: ARG002
        """Rounded down to a tenth of a degree."""
        value = math.floor(10 * loose.filters.transmission_min / deg) / 10 * deg
        instead = format_quantity(given.filters.transmission_min, "deg")
        return f"{self.name}={value / deg:.4g}deg", instead, self.among(loose, value)


@record
class PivotLimit(MotionLimit):
    """Bounds of both pivots along an axis: 0 for x, 1 for y."""

    axis: int = 0

    def is_given(self, limits: MotionLimits) -> bool:
        """Whether one box is bounded along the axis."""
        return any(box[self.axis] != PLANE[0] for box in limits.boxes)

    def loosened(self, limits: MotionLimits, share: float, size: float) -> MotionLimits:
        """Bounds that are wider by a share of the task's size."""
        by = share * size
        boxes = tuple((x, _wider(y, by)) if self.axis else (_wider(x, by), y) for x, y in limits.boxes)
        return replace(limits, boxes=(boxes[0], boxes[1]))

    def stated(self, given: MotionLimits, loose: MotionLimits, share: float) -> Stated:  # noqa: ARG002
        """Rounded outward to a tenth of a millimetre."""
        setting, instead = (_span(limits.boxes[0][self.axis], mm, "mm") for limits in (loose, given))
        return f"{self.name}={setting}", instead, loose


@record
class RegionLimit(MotionLimit):
    """The region of a pivot, with its box: 0 of the crank, 1 of the rocker."""

    pivot: int = 0

    def is_given(self, limits: MotionLimits) -> bool:
        """Whether there is a polygon."""
        return len(limits.polygons[self.pivot]) > 0

    def loosened(self, limits: MotionLimits, share: float, size: float) -> MotionLimits:  # noqa: ARG002
        """A greater polygon about the same middle."""
        corners = limits.polygons[self.pivot]
        return self.among(limits, NOWHERE if math.isinf(share) else _scaled(corners, 1 + share))

    def breach(self, one: Candidate, limits: MotionLimits) -> str:
        """The distance of the pivot outside box and polygon."""
        sides = np.array([end for bounds in limits.boxes[self.pivot] for end in bounds])
        pivot = (one.four_bar.a0, one.four_bar.b0)[self.pivot]
        outside = -float(regions.region_margin(pivot, sides, limits.polygons[self.pivot]))
        link = self.name.split("_")[0]
        return (
            f"{link}'s pivot {format_quantity(outside, 'mm')} outside its region" if outside > KEPT * one.size else ""
        )


@record
class SwingLimit(MotionLimit):
    """Bounds of a swing [rad]; measure  the swing of a candidate that reaches all poses on one circuit."""

    measure: Callable[[Candidate], float]

    def is_given(self, limits: MotionLimits) -> bool:
        """Whether it is bounded."""
        return bool(getattr(limits, self.name) != TURN)

    def loosened(self, limits: MotionLimits, share: float, size: float) -> MotionLimits:  # noqa: ARG002
        """Bounds that are wider by the share [rad]."""
        low, high = _wider(getattr(limits, self.name), share)
        return self.among(limits, (max(0.0, low), high))

    def breach(self, one: Candidate, limits: MotionLimits) -> str:
        """The swing and its bounds."""
        low, high = getattr(limits, self.name)
        if not (self.is_given(limits) and one.reached and one.one_circuit):
            return ""
        angle = self.measure(one)
        if low - SWING <= angle <= high + SWING:
            return ""
        allowed = f"{format_quantity(low, 'deg')} to {format_quantity(high, 'deg')}"
        return f"{self.name.replace('_', ' ')} {format_quantity(angle, 'deg')}, allowed {allowed}"

    def stated(self, given: MotionLimits, loose: MotionLimits, share: float) -> Stated:  # noqa: ARG002
        """Rounded outward to a tenth of a degree."""
        setting, instead = (_span(getattr(limits, self.name), deg, "deg") for limits in (loose, given))
        return f"{self.name}={setting}", instead, loose


@record
class ClearanceLimit(MotionLimit):
    """The region that no link may touch."""

    def is_given(self, limits: MotionLimits) -> bool:
        """Whether there is a polygon."""
        return len(limits.keep_out) > 0

    def loosened(self, limits: MotionLimits, share: float, size: float) -> MotionLimits:  # noqa: ARG002
        """A smaller polygon about the same middle."""
        return self.among(limits, NOWHERE if share >= 1 else _scaled(limits.keep_out, 1 - share))

    def breach(self, one: Candidate, limits: MotionLimits) -> str:
        """Whether a link touches it over the motion."""
        touches = self.is_given(limits) and one.reached and one.one_circuit and not clear_of(one, limits.keep_out)
        return "a link touches the region to keep clear" if touches else ""

    def stated(self, given: MotionLimits, loose: MotionLimits, share: float) -> Stated:  # noqa: ARG002
        """By how much it is reduced."""
        return f"{self.name} reduced by {100 * share:.3g} % about its middle", "the one given", loose


def crank_swing(one: Candidate) -> float:
    """Rotation of the crank from the first to the last position of a candidate that reaches all [rad]."""
    cranks = [met.crank_angle for met in one.positions]
    low, high = task_rotation(cranks) if one.crank_turns else (min(cranks), max(cranks))
    return high - low


def rocker_swing(one: Candidate) -> float:
    """Swing of the rocker over the motion [rad]: over the turn of a crank that turns fully, else over the task."""
    angles = np.unwrap(np.angle(one.motion(FINE).rocker))
    return float(np.ptp(angles))


def clear_of(one: Candidate, keep_out: ComplexArray) -> bool:
    """Whether crank, coupler with its tracer, and rocker stay clear of a polygon [m] over the motion.

    Between two positions the distance of a link from a corner changes smoothly, so that it is less than at both by a
    part of the second order of a joint's step: `measures.SAGITTA` of the step is required at `FINE` positions.
    """
    at, pivots = one.motion(FINE), np.array([one.four_bar.a0, one.four_bar.b0])
    step = max(float(np.max(np.abs(np.diff(joint)))) for joint in (at.a, at.b, at.tracer))
    clear = float(regions.swept_clearance(pivots, at.a, at.b, at.tracer, keep_out))
    return clear > measures.SAGITTA * step


def _rounded_up(value: float, unit: float) -> float:
    """A value rounded up to four digits in a unit."""
    number = value / unit
    step = 10.0 ** (math.floor(math.log10(number)) - 3)
    return math.ceil(number / step - 1e-9) * step * unit


def _span(bounds: Bounds, unit: float, name: str) -> str:
    """Bounds as they are set, such as `-20.1mm..60mm`: the least rounded down, the greatest up."""
    low = "" if math.isinf(bounds[0]) else f"{math.floor(10 * bounds[0] / unit) / 10:g}{name}"
    high = "" if math.isinf(bounds[1]) else f"{math.ceil(10 * bounds[1] / unit) / 10:g}{name}"
    return f"{low}..{high}"


def _wider(bounds: Bounds, by: float) -> Bounds:
    return bounds[0] - by, bounds[1] + by


def _scaled(corners: ComplexArray, factor: float) -> ComplexArray:
    """A polygon scaled about the mean of its corners."""
    scaled: ComplexArray = np.mean(corners) + factor * (corners - np.mean(corners))
    return scaled


LIMITS: tuple[MotionLimit, ...] = (
    GreatestLimit("size_max", "mm"),
    GreatestLimit("link_ratio_max"),
    TransmissionLimit("transmission_min"),
    PivotLimit("pivot_x", 0),
    PivotLimit("pivot_y", 1),
    RegionLimit("crank_region", 0),
    RegionLimit("rocker_region", 1),
    SwingLimit("crank_swing", crank_swing),
    SwingLimit("rocker_swing", rocker_swing),
    ClearanceLimit("keep_out"),
    *(FlagLimit(name) for name in ("full_turn", "in_order", "one_branch", "one_circuit")),
)
"""All limits that can be loosened."""


def breaches(one: Candidate, limits: MotionLimits) -> dict[str, str]:
    """Every limit and filter that a candidate does not keep -> reason as a sentence."""
    found = defects(one, limits.filters, task_only=limits.task_only)
    return found | {limit.name: words for limit in LIMITS if (words := limit.breach(one, limits))}
