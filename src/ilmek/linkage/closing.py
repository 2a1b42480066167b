"""Closing ranges of an input: where the mechanism closes, exactly to rounding; dead centres and change points.

Groups with a closed form close where their formulas have a solution: each group in turn is examined on the ranges in
which those before it close. The samples of a range are denser towards its ends (Chebyshev's abscissae), where the
configurations change with the root of the distance; between samples the least and greatest closeness are searched, so
that gaps and ranges far smaller than a step of the samples are found. Groups without a closed form close along the
branch of the mechanism's pose (`pose_branch`). At a dead centre det J = 0: the input reverses there.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ilmek.arrays import FloatArray
from ilmek.linkage.body_motion import STILL, BodyMotion
from ilmek.linkage.groups.group import GroupSolution, InputMotion, Known, Step
from ilmek.linkage.groups.winding import linear_relations
from ilmek.linkage.initial_pose import newton_steps
from ilmek.linkage.model import GROUND
from ilmek.linkage.newton_starts import acting_inputs, branch_over, starts
from ilmek.linkage.one_input import OneInput
from ilmek.linkage.pose_branch import PoseBranch
from ilmek.linkage.status import TOUCHING
from ilmek.linkage.structure import Plan
from ilmek.num.brackets import bracketed_minima, bracketed_roots
from ilmek.records import record
from ilmek.units import deg, mm, turn

LEAST_SAMPLES, SAMPLES = 64, 360
"""Samples of a range: at least, and for each turn of the fastest angle that follows from the inputs alone."""

CLOSER = 0.5 ** np.arange(1, 13)
"""Samples next to the ends of a range, relative to the distance of the next one, in the phase of Chebyshev's abscissae:
the last at rounding."""

MOST_SAMPLES = 200_000
"""Samples of a range at most."""

STEEP = 4.0
"""An extreme between samples is searched where the closeness is less than so many times its change to a neighbour."""

FLAT = 1e-7
"""Sine of a transmission angle, or its like, below which the links are in line within rounding between samples."""

SAME_PHASE = 1e-6
"""Least distance of two change points, relative to half the range."""

PAD = 0.02
"""Part of the required range by which it is examined beyond its ends, to find short ranges next to them."""

SHOWN = 4
"""Number of ranges listed in a message."""

BESIDE = 1e-10
"""Distance from a dead centre [rad, m] at which the bodies in line are determined."""


@dataclass(frozen=True, slots=True)
class Closing:
    """The ranges of an input in which a mechanism closes.

    ranges         (from, to) [rad, m], ascending; the ends are exact to rounding
    dead_centres   ends of ranges at which the input reverses [rad, m], and the bodies in line there
    change_points  values inside of ranges [rad, m] at which two assemblies meet: the motion is uncertain there
    """

    ranges: tuple[tuple[float, float], ...]
    dead_centres: tuple[tuple[float, tuple[str, ...]], ...]
    change_points: tuple[float, ...]


def closing(moved: OneInput, start: float, stop: float) -> Closing:
    """Where the mechanism closes from `start` to `stop` of an input [rad, m].

    With the branches of the closed forms and, for other groups, on the branch of the pose. A single value at
    which links just reach is no range. Raises MechanismError for a geared group without repetition too far from its
    pose.

    >>> import math
    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.structure import plan
    >>> found = closing(one_input(plan(four_bar(0.300, 0.200, 0.200, 0.230, branch=+1))), 0.0, 2 * math.pi)
    >>> [[round(math.degrees(end), 3) for end in ends] for ends in found.ranges]
    [[0.0, 117.226], [242.774, 360.0]]
    >>> found.dead_centres[0][1]
    ('coupler', 'rocker')
    """
    return _closing(moved.plan, moved.name, tuple(sorted(moved.locked.items())), float(start), float(stop))


def closing_words(moved: OneInput) -> str:
    """The ranges in which a mechanism closes over a turn, or its reach, for messages; "" for none.

    >>> from ilmek.linkage.fourbar import four_bar
    >>> from ilmek.linkage.one_input import one_input
    >>> from ilmek.linkage.structure import plan
    >>> closing_words(one_input(plan(four_bar(0.300, 0.200, 0.200, 0.230, branch=+1))))
    '-117.226°..117.226°'
    """
    if moved.turns:
        reach, unit, sign = np.pi, deg, "°"
    else:
        bodies = moved.plan.mechanism.bodies
        reach, unit, sign = sum(abs(point) for body in bodies for point in body.points.values()), mm, " mm"
    ranges = closing(moved, -reach, reach).ranges
    words = [f"{low / unit:.3f}{sign}..{high / unit:.3f}{sign}" for low, high in ranges[:SHOWN]]
    return ", ".join(words) + (f" and {len(ranges) - SHOWN} further ranges" if len(ranges) > SHOWN else "")


@lru_cache(maxsize=64)
def _closing(plan: Plan, name: str, locked: tuple[tuple[str, float], ...], start: float, stop: float) -> Closing:
    search, pad = _Search(plan, name, dict(locked), _fastest(plan, name)), PAD * (stop - start)
    wide, points = search.within(len(newton_steps(plan)), search.first_ranges(start - pad, stop + pad))
    ranges = [(max(low, start), min(high, stop)) for low, high in wide if low < stop and high > start]
    points = [point for point in points if start <= point <= stop]
    ends = sorted({end for ends in ranges for end in ends if start < end < stop})
    dead = tuple(zip(ends, search.in_line(np.array(ends)), strict=True)) if ends else ()
    return Closing(tuple(ranges), dead, tuple(sorted(points)))


def _fastest(plan: Plan, name: str) -> float:
    """Greatest ratio of an angle that follows from the inputs alone to the input, at least 1."""
    if not plan.mechanism.couplings:
        return 1.0
    relations = linear_relations(plan.mechanism)
    shares = [abs(one.shares.get(name, 0.0)) for (kind, _), one in relations.items() if kind == "angle"]
    return max(1.0, *shares)


@record
class _Search:
    """The search over one input of a plan, the others locked.

    fastest  ratio of the fastest angle to the input
    """

    plan: Plan
    name: str
    locked: Mapping[str, float]
    fastest: float

    def first_ranges(self, start: float, stop: float) -> tuple[list[tuple[float, float]], list[float]]:
        """Ranges in which the groups without a closed form and those before them close, and their change points."""
        branch = self._branch(start, stop)
        if not isinstance(branch, PoseBranch):
            return ([(start, stop)] if branch else []), []
        if self.name != branch.free.name:
            return [(start, stop)], []
        found = branch.ranges(start, stop)
        shifts = np.arange(-1, 2) if not np.isfinite(branch.period) else _shifts(branch, start, stop)
        period = branch.period if np.isfinite(branch.period) else 0.0
        points = {float(point + k * period) for point in branch.crossings for k in shifts}
        return found, [point for point in points if any(low < point < high for low, high in found)]

    def _branch(self, start: float, stop: float) -> PoseBranch | bool:
        """The branch of the pose; True if all groups have a closed form, False if the pose cannot be assembled."""
        acting = acting_inputs(self.plan)
        if not newton_steps(self.plan) or not acting:
            return True
        values = {name: np.array([value, value]) for name, value in self.locked.items()}
        values[self.name] = np.array([start, stop])
        over = self.name if self.name in acting else acting[0]
        return branch_over(self.plan, over, values) or False

    def within(
        self, first: int, given: tuple[list[tuple[float, float]], list[float]]
    ) -> tuple[list[tuple[float, float]], list[float]]:
        """The parts of ranges in which all steps from `first` on close, and the change points in them."""
        ranges, points = given
        for number in range(first, len(self.plan.steps)):
            parts = [self._parts(number, low, high) for low, high in ranges]
            ranges = [part for found, _ in parts for part in found]
            points += [point for _, found in parts for point in found]
        return ranges, [point for point in points if any(low < point < high for low, high in ranges)]

    def _parts(self, number: int, low: float, high: float) -> tuple[list[tuple[float, float]], list[float]]:
        """The parts of a range in which a step closes, and the change points in them."""
        turned = (high - low) / turn if self.turns else 1.0
        count = int(np.clip(SAMPLES * self.fastest * turned, LEAST_SAMPLES, MOST_SAMPLES))
        middle, half = 0.5 * (low + high), 0.5 * (high - low)

        def closeness(phases: FloatArray) -> FloatArray:
            return self._closeness(number, middle - half * np.cos(phases))

        inner = np.pi * (np.arange(count) + 0.5) / count
        phases = np.concatenate([inner[0] * CLOSER[::-1], inner, np.pi - inner[0] * CLOSER])
        found = closeness(phases)
        if not np.isfinite(found).any():  # a step that cannot fail
            return [(low, high)], []
        phases, signs, touched = _with_extremes(closeness, phases, found)
        (changed,) = np.nonzero(signs[:-1] != signs[1:])
        ends = np.empty(0)
        if len(changed):
            ends = bracketed_roots(closeness, phases[changed], phases[changed + 1])
            ends = np.where(np.isnan(ends), phases[changed], ends)
        edges = [low, *(middle - half * np.cos(ends)).tolist(), high]
        sides = [signs[0], *signs[changed + 1]]
        both = self.plan.steps[number].both_sides
        spans = zip(edges[:-1], edges[1:], sides, strict=True)
        kept = [(one, other) for one, other, side in spans if (both or side > 0) and one < other]
        return kept, (middle - half * np.cos(touched)).tolist()

    def _closeness(self, number: int, values: FloatArray) -> FloatArray:
        """Above 0 where a step closes, 0 at its dead centre, below 0 where it does not; NaN if it cannot fail.

        The squared sine of the transmission angle, or its like; the gap relative to the links. Lines that cross close
        on both sides of their dead centre: the sine itself.
        """
        step, known, solved = self._solved(number, values)
        if solved.margin is None:
            return np.full(values.shape, np.nan)
        margin = np.broadcast_to(np.asarray(solved.margin, dtype=float) / solved.best, values.shape)
        if step.both_sides:
            return margin
        with np.errstate(invalid="ignore", divide="ignore"):
            gap = np.broadcast_to(np.abs(step.gap(known)) / (step.size or 1.0), values.shape)
        return np.where(np.isnan(margin), -np.nan_to_num(gap), margin * margin)

    def _solved(self, number: int, values: FloatArray) -> tuple[Step, Known, GroupSolution]:
        """A step, the known bodies, and its solution at values of the input."""
        drives = {name: InputMotion(np.full(values.shape, value), 0.0, 0.0) for name, value in self.locked.items()}
        drives[self.name] = InputMotion(values, 0.0, 0.0)
        known: dict[str, BodyMotion] = {GROUND: STILL, **starts(self.plan, drives)}
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            for step in self.plan.steps[:number]:
                known.update(step.locate(known, step.solve(known, drives).columns))
            step = self.plan.steps[number]
            return step, known, step.solve(known, drives)

    def in_line(self, ends: FloatArray) -> list[tuple[str, ...]]:
        """The bodies of the step that is nearest to its dead centre next to each of some values of the input."""
        values = (ends + BESIDE * np.array([[-1.0], [1.0]])).ravel()
        least, nearest = np.full(ends.shape, np.inf), np.zeros(ends.shape, dtype=int)
        for number in range(len(self.plan.steps)):
            _, _, solved = self._solved(number, values)
            if solved.margin is not None:
                margin = np.broadcast_to(np.abs(np.asarray(solved.margin, dtype=float)) / solved.best, values.shape)
                beside = np.min(np.where(np.isfinite(margin), margin, np.inf).reshape(2, -1), axis=0)
                nearest = np.where(beside < least, number, nearest)
                least = np.minimum(beside, least)
        return [self.plan.steps[number].bodies for number in nearest]

    @property
    def turns(self) -> bool:
        """Whether the input is an angle."""
        return OneInput(self.plan, self.name, self.locked).turns


def _with_extremes(
    closeness: Callable[[FloatArray], FloatArray], phases: FloatArray, found: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Samples and their signs, completed by extremes of the other sign between them; phases of change points.

    A sample, or an extreme, at 0 within rounding has the sign of its neighbour.
    """
    signs = np.where(found > TOUCHING, 1.0, np.where(found < -TOUCHING, -1.0, 0.0))
    signs = np.where(np.isnan(found), 0.0, signs)
    (zero,) = np.nonzero(signs == 0)
    for k in zero:
        signs[k] = signs[k - 1] if k else next((sign for sign in signs if sign), 1.0)
    size = np.abs(found)
    left, middle, right = size[:-2], size[1:-1], size[2:]
    least = (middle <= left) & (middle <= right) & (signs[:-2] == signs[1:-1]) & (signs[1:-1] == signs[2:])
    (at,) = np.nonzero(least & (middle <= STEEP * np.maximum(left - middle, right - middle)))
    if not len(at):
        return phases, signs, np.empty(0)
    side = signs[at + 1]

    def root(x: FloatArray) -> FloatArray:
        value = closeness(x)
        return np.asarray(side * np.sign(value) * np.sqrt(np.abs(value)))

    where, value = bracketed_minima(root, phases[at], phases[at + 2])
    crossed = value < -np.sqrt(TOUCHING)
    touched = where[~crossed & (value < FLAT) & (side > 0)]
    touched = touched[np.diff(touched, prepend=-1.0) > SAME_PHASE]
    merged = np.concatenate([phases, where[crossed]])
    order = np.argsort(merged)
    return merged[order], np.concatenate([signs, -side[crossed]])[order], touched


def _shifts(branch: PoseBranch, start: float, stop: float) -> FloatArray:
    """Numbers of periods by which a branch is repeated from `start` to `stop`."""
    first, last = (start - branch.stop) / branch.period, (stop - branch.start) / branch.period
    return np.arange(np.floor(first), np.ceil(last) + 1)
