"""Limits of a four-bar for a motion, in SI, and as the arrays of a search in the task's frame."""

import math
from collections.abc import Sequence
from dataclasses import field

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.params.text_lists import Bounds
from ilmek.records import record
from ilmek.synthesis.burmester.constant_distance import TaskFrame
from ilmek.synthesis.candidate import Candidate, task_rotation
from ilmek.synthesis.filters import Filters, defects
from ilmek.synthesis.motion import measures, regions
from ilmek.units import format_quantity

NOWHERE = np.zeros(0, dtype=complex)
"""No polygon."""

PLANE: tuple[Bounds, Bounds] = ((-math.inf, math.inf), (-math.inf, math.inf))
"""Bounds on x and y that hold everywhere."""

TURN: Bounds = (0.0, math.inf)


KEPT = 1e-9
"""Distance outside a region, relative to the four-bar's size, that counts as rounding."""

SWING = 1e-4
"""Difference from a limit of a swing [rad] that counts as rounding of its samples."""

FINE = 1081
"""Positions at which swing and clearance are computed."""


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


def breaches(one: Candidate, limits: MotionLimits) -> dict[str, str]:
    """Every limit and filter that a candidate does not keep -> reason as a sentence."""
    breaches = defects(one, limits.filters, task_only=limits.task_only)
    pivots = (one.four_bar.a0, one.four_bar.b0)
    for name, pivot, box, corners in zip(
        ("crank_region", "rocker_region"), pivots, limits.boxes, limits.polygons, strict=True
    ):
        sides = np.array([end for bounds in box for end in bounds])
        outside = -float(regions.region_margin(pivot, sides, corners))
        if outside > KEPT * one.size:
            breaches[name] = f"{name.split('_')[0]}'s pivot {format_quantity(outside, 'mm')} outside its region"
    for name, bounds, swing in (
        ("crank_swing", limits.crank_swing, crank_swing),
        ("rocker_swing", limits.rocker_swing, rocker_swing),
    ):
        if bounds != TURN and one.reached and one.one_circuit:
            angle = swing(one)
            if not bounds[0] - SWING <= angle <= bounds[1] + SWING:
                allowed = f"{format_quantity(bounds[0], 'deg')} to {format_quantity(bounds[1], 'deg')}"
                breaches[name] = f"{name.replace('_', ' ')} {format_quantity(angle, 'deg')}, allowed {allowed}"
    if len(limits.keep_out) and one.reached and one.one_circuit and not clear_of(one, limits.keep_out):
        breaches["keep_out"] = "a link touches the region to keep clear"
    return breaches


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
