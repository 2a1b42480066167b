"""Where no four-bar keeps all limits: which single limit, loosened how far, gives one.

One limit is dropped first. Where the family then has four-bars, the limit is loosened by a share t of its value only,
and t falls in small steps, each beginning from the four-bars of the step before, down to the least that is reached.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ilmek.arrays import ComplexArray
from ilmek.params.text_lists import Bounds
from ilmek.progress import SILENT, Progress
from ilmek.records import record
from ilmek.synthesis.candidate import Candidate
from ilmek.synthesis.motion.limits import NOWHERE, PLANE, TURN, MotionLimits, breaches
from ilmek.synthesis.motion.search import MotionSpace, PairPool, PairSearch, feasible, reached, search_pairs
from ilmek.units import deg, format_quantity, mm

FIRST, COARSEST, FINEST = 0.02, 1.1, 1.003
"""First share t that is tried, doubled until it gives four-bars; greatest and least factor by which it then falls."""

SETS = 3
"""Sets of links of three poses among which four-bars without the limit are sought."""

BASINS = 1200
"""Four-bars without the limit from which the steps begin."""

GREATEST = 64.0
"""Greatest share by which a limit is loosened without being dropped."""

FLAGS = ("full_turn", "in_order", "one_branch", "one_circuit")
"""Requirements that are dropped altogether."""

AXES, SWINGS = ("pivot_x", "pivot_y"), ("crank_swing", "rocker_swing")
"""Limits that are bounds."""


@record
class Cure:
    """A single limit, loosened just so far that there are four-bars.

    name   of the parameter      setting  its new value, as it is set      instead  the value given
    found  four-bars within all other limits then                          share    by which it was loosened [1]
    """

    name: str
    setting: str
    instead: str
    found: int
    share: float

    @property
    def words(self) -> str:
        """The cure as a phrase."""
        return f"{self.setting} instead of {self.instead} gives {self.found}"


def cures(
    space: MotionSpace, judged: Callable[[ComplexArray], Candidate], progress: Progress = SILENT
) -> tuple[Cure, ...]:
    """Every single limit that gives a four-bar if it is loosened, the least change first. Raises Cancelled.

    judged  pivots and pins [m] -> the four-bar's check
    """
    names = active(space.limits)
    found = []
    for number, name in enumerate(names):
        part = progress.part(number / len(names), (number + 1) / len(names), "loosen")
        found += _cure(space, judged, name, part)
    return tuple(sorted(found, key=lambda one: one.share))


def active(limits: MotionLimits) -> tuple[str, ...]:
    """Names of the limits that are given, and of the flags that are set."""
    filters, given = limits.filters, []
    given += ["size_max"] if filters.size_max is not None else []
    given += ["link_ratio_max"] if filters.link_ratio_max is not None else []
    given += ["transmission_min"] if filters.transmission_min else []
    given += [name for at, name in enumerate(AXES) if any(box[at] != PLANE[0] for box in limits.boxes)]
    given += [name for name in ("crank_region", "rocker_region", "keep_out") if len(getattr(limits, name))]
    given += [name for name in SWINGS if getattr(limits, name) != TURN]
    return (*given, *(name for name in FLAGS if getattr(filters, name)))


def loosened(limits: MotionLimits, name: str, share: float, size: float) -> MotionLimits:
    """The limits with one of them loosened by a share of its value; inf drops it. size  of the task [m]."""
    filters = limits.filters
    if name in FLAGS:
        return _with_filter(limits, name, False)
    if name in ("size_max", "link_ratio_max"):
        value = None if math.isinf(share) else min(getattr(filters, name) * (1 + share), 1e3)
        return _with_filter(limits, name, value)
    if name == "transmission_min":
        least = filters.transmission_min * max(0.0, 1 - share)
        return _with_filter(limits, name, least)
    return _more_room(limits, name, share, size)


def _more_room(limits: MotionLimits, name: str, share: float, size: float) -> MotionLimits:
    """The limits with bounds, or a region, loosened."""
    if name in AXES:
        by = share * size
        boxes = tuple((_wider(x, by), y) if name == AXES[0] else (x, _wider(y, by)) for x, y in limits.boxes)
        return replace(limits, boxes=(boxes[0], boxes[1]))
    if name in SWINGS:
        low, high = _wider(getattr(limits, name), share)
        return _with(limits, name, (max(0.0, low), high))
    corners = getattr(limits, name)
    if math.isinf(share) or (name == "keep_out" and share >= 1):
        return _with(limits, name, NOWHERE)
    factor = 1 - share if name == "keep_out" else 1 + share
    return _with(limits, name, np.mean(corners) + factor * (corners - np.mean(corners)))


def _with(limits: MotionLimits, name: str, value: object) -> MotionLimits:
    """The limits with one of another value."""
    changed: dict[str, Any] = {name: value}
    return replace(limits, **changed)


def _with_filter(limits: MotionLimits, name: str, value: object) -> MotionLimits:
    """The limits with a filter of another value."""
    changed: dict[str, Any] = {name: value}
    return replace(limits, filters=replace(limits.filters, **changed))


def _wider(bounds: Bounds, by: float) -> Bounds:
    return bounds[0] - by, bounds[1] + by


def _cure(space: MotionSpace, judged: Callable[[ComplexArray], Candidate], name: str, progress: Progress) -> list[Cure]:
    """The cure by one limit; [] where none is found."""
    size = space.extent or space.frame.size
    without = MotionSpace(space.poses, space.curve, loosened(space.limits, name, math.inf, size), space.most)
    seeds = SETS if len(space.family.forms) == 2 and name not in FLAGS else 1
    pool, _, _, _ = without.sampled(without.bounds, 0, progress.part(0.0, 0.3))
    for seed in range(1, seeds):
        pool = pool.joined(without.sampled(without.bounds, seed, progress)[0])
    pool = pool.only(np.argsort(pool.scores, kind="stable"))
    near, _ = reached(without, pool, without.bounds, progress.part(0.3, 0.5))
    if not len(near.scores):
        return []
    if name in FLAGS:
        search = search_pairs(without, 1, progress.part(0.5, 1.0))
        return [Cure(name, f"{name}=no", "yes", search.found, 1.0)] if search.pairs else []
    # Those that miss the given limit least come first.
    missed = space.repaired(near, space.bounds, 0, progress)
    near = near.only(np.argsort(missed.scores, kind="stable")[:BASINS])
    least = _least_share(space, near, name, progress)
    return [] if least is None else _stated(space, judged, name, least)


def _least_share(space: MotionSpace, near: PairPool, name: str, progress: Progress) -> float | None:
    """The least share by which a limit must be loosened, followed down from the pairs found without it."""
    share, factor, reached_at = FIRST, 2.0, math.inf
    while factor > FINEST and share <= GREATEST:
        progress(0.6)
        limits = loosened(space.limits, name, share, space.extent or space.frame.size)
        trial = MotionSpace(space.poses, space.curve, limits, space.most)
        good = feasible(trial.repaired(near, trial.bounds, 25, progress))
        if len(good.scores):
            reached_at, near = share, good
            factor = min(factor, COARSEST)
            share = reached_at / factor
        elif math.isinf(reached_at):
            share *= factor
        else:
            factor = math.sqrt(factor)
            share = reached_at / factor
        if reached_at < 1e-3 * FIRST:
            break
    return None if math.isinf(reached_at) else reached_at


def _stated(space: MotionSpace, judged: Callable[[ComplexArray], Candidate], name: str, share: float) -> list[Cure]:
    """The cure with its value rounded to what can be typed, and the four-bars that it gives."""
    limits = loosened(space.limits, name, share * 1.002 + 1e-4, space.extent or space.frame.size)
    setting, instead, limits = in_words(space.limits, limits, name, share)
    trial = MotionSpace(space.poses, space.curve, limits, space.most)
    search: PairSearch = search_pairs(trial, 3)
    good = [pair for pair in search.pairs if not breaches(judged(pair.pins), limits)]
    return [Cure(name, setting, instead, search.found, share)] if good else []


def in_words(given: MotionLimits, loose: MotionLimits, name: str, share: float) -> tuple[str, str, MotionLimits]:
    """Setting and given value of a loosened limit as texts, and the limits with exactly this value."""
    filters, before = loose.filters, given.filters
    after, setting, instead = loose, f"{name} {'reduced' if name == 'keep_out' else 'enlarged'}", "the one given"
    if name == "size_max":
        value = _rounded_up(filters.size_max or 0.0, mm)
        setting, instead = f"{name}={value / mm:.4g}mm", format_quantity(before.size_max or 0.0, "mm")
        after = _with_filter(loose, name, value)
    elif name == "link_ratio_max":
        value = _rounded_up(filters.link_ratio_max or 1.0, 1.0)
        setting, instead = f"{name}={value:.4g}", f"{before.link_ratio_max:g}"
        after = _with_filter(loose, name, value)
    elif name == "transmission_min":
        value = math.floor(10 * filters.transmission_min / deg) / 10 * deg
        setting, instead = f"{name}={value / deg:.4g}deg", format_quantity(before.transmission_min, "deg")
        after = _with_filter(loose, name, value)
    elif name in AXES:
        at = AXES.index(name)
        setting, instead = f"{name}={_span(loose.boxes[0][at], mm, 'mm')}", _span(given.boxes[0][at], mm, "mm")
    elif name in SWINGS:
        setting, instead = (_span(getattr(one, name), deg, "deg") for one in (loose, given))
        setting = f"{name}={setting}"
    else:
        setting = f"{setting} by {100 * share:.3g} % about its middle"
    return setting, instead, after


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
