"""Angle of a body against another, counted through full turns: a function of the inputs, not of a motion's samples.

    theta = constant + Σ factor · input      where inputs, couplings and slides alone fix it [see `groups.winding`]

Any other angle is followed on the mechanism itself, along a way through the values of the inputs, so that two samples
may be many turns of the inputs apart. A way is divided until the angle in each cell agrees with the rate in its middle:

    |theta(m) - theta(a)|, |theta(b) - theta(m)|, |theta(b) - theta(a) - (b - a) theta'(m)| <= LARGEST   [midpoint rule]

The turn that counts: with all inputs at 0 the angle is within half a turn, (-pi, pi]. Where the mechanism does not
close on the way from there, it is within half a turn at the place nearest to it at which the mechanism closes. The way
of one moving input is its own line from 0, of several the straight line to their first values, then the samples.
Limit: a whole turn of the angle within a cell, between two directions with a small rate between, is not seen.
"""

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from ilmek.arrays import ComplexArray, FloatArray, IntArray
from ilmek.errors import MechanismError
from ilmek.linkage.groups.group import InputMotion
from ilmek.linkage.groups.winding import LinearRelation, linear_relations, relation_between
from ilmek.linkage.model import Mechanism, Rotation
from ilmek.linkage.solution import local_starts, solved_steps
from ilmek.linkage.structure import Plan
from ilmek.records import record, value_record
from ilmek.units import turn

CELLS = 360
"""First cells of a way in a turn of an input, or in the mechanism's length of a slide."""

HALVINGS = 30
"""Most halvings of a cell."""

LARGEST = math.pi / 6
"""Greatest change of an angle in half a cell, and greatest misfit of the midpoint rule [rad]."""

MOST_CELLS = 1_000_000
"""Most cells of a way: about 2,700 turns of an input between two samples, or from 0."""

MOST_PERIODS = 64
"""Most turns of an input after which a geared mechanism repeats."""

BLOCK = 4096
"""Places of a way that are solved at a time."""

HALF = 1e-9
"""An angle that far above -pi [rad] counts as pi: half a turn is the same from both sides, rounding aside."""

Drives: TypeAlias = Mapping[str, InputMotion]


@value_record
class _Pair:
    """A body of a plan, and the body against which its angle counts."""

    plan: Plan
    body: str
    against: str

    def turned(self, values: Mapping[str, FloatArray], rates: Mapping[str, FloatArray]) -> "_Turned":
        """The relative direction and the rate of the angle, at values and rates of the inputs."""
        count = len(next(iter(values.values())))
        direction, rate = np.empty(count, complex), np.empty(count)
        for start in range(0, count, BLOCK):
            part = slice(start, start + BLOCK)
            drives = {name: InputMotion(value[part], rates[name][part], 0.0) for name, value in values.items()}
            direction[part], rate[part] = self._of(drives)
        return _Turned(direction, rate)

    def _of(self, drives: Drives) -> tuple[ComplexArray, FloatArray]:
        plan = self.plan
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            bodies, solved = solved_steps(plan, drives, local_starts(plan, drives))
            located = {**bodies, **plan.steps[-1].locate(bodies, solved[-1].columns)}
            body, against = located[self.body], located[self.against]
            return np.asarray(body.direction * np.conj(against.direction)), np.asarray(body.omega - against.omega)


@record
class _Turned:
    """Relative directions, and rates of the angle along a way; NaN where the mechanism does not close."""

    direction: ComplexArray
    rate: FloatArray


@record
class _Way:
    """A way through the values of the inputs: straight between its stops, one unit of the parameter each.

    pair  whose angle is followed      stops  input -> values at the stops [rad; m]
    """

    pair: _Pair
    stops: Mapping[str, FloatArray]

    def places(self, at: FloatArray) -> _Turned:
        """Directions and rates at parameters of the way."""
        last = len(next(iter(self.stops.values()))) - 1
        leg = np.minimum(at.astype(int), last - 1)
        values = {name: stop[leg] + (at - leg) * np.diff(stop)[leg] for name, stop in self.stops.items()}
        return self.pair.turned(values, {name: np.diff(stop)[leg] for name, stop in self.stops.items()})


@record
class _Trace:
    """Places of a way in order: parameter, direction, and change of the angle to the next; NaN across a gap."""

    at: FloatArray
    direction: ComplexArray
    change: FloatArray

    def angles(self, distance: FloatArray) -> FloatArray:
        """The angle at each place [rad]: in each piece without a gap within half a turn where `distance` is least."""
        raw = np.append(0.0, np.cumsum(np.nan_to_num(self.change)))
        piece = np.append(0, np.cumsum(np.isnan(self.change)))
        angle = np.full(len(raw), np.nan)
        closed = np.flatnonzero(np.isfinite(self.direction))
        for rows in np.split(closed, np.flatnonzero(np.diff(piece[closed])) + 1):
            if len(rows):
                first = rows[np.argmin(distance[rows])]
                angle[rows] = raw[rows] - raw[first] + _principal(self.direction[first])
        return angle


@record
class _Followed:
    """Places of a way with their angles [rad], and the turns of the angle after which the way repeats.

    period  [rad] of the input; 0: the way does not repeat      turns  of the angle in a period
    """

    at: FloatArray
    direction: ComplexArray
    angle: FloatArray
    period: float = 0.0
    turns: int = 0

    def at_values(self, values: FloatArray, direction: ComplexArray) -> FloatArray:
        """The angle [rad] at values of the way's input, where the direction is as given."""
        whole = np.floor((values - self.at[0]) / self.period) if self.period else np.zeros(len(values))
        near = self._nearest(values - whole * self.period)
        beside = np.angle(direction * np.conj(self.direction[near]))
        return np.asarray(self.angle[near] + beside + turn * self.turns * whole)

    def _nearest(self, values: FloatArray) -> IntArray:
        """The place nearest to each value at which the mechanism closes."""
        closed = np.flatnonzero(np.isfinite(self.angle))
        if not len(closed):
            return np.zeros(len(values), dtype=int)
        right = np.clip(np.searchsorted(self.at[closed], values), 1, max(len(closed) - 1, 1))
        left = right - 1
        right = np.minimum(right, len(closed) - 1)
        nearer = np.abs(self.at[closed[left]] - values) <= np.abs(self.at[closed[right]] - values)
        return np.asarray(closed[np.where(nearer, left, right)])


def followed_angle(plan: Plan, drives: Drives, body: str, against: str) -> FloatArray:
    """Angle of a body's frame against another's [rad], counted through full turns, (samples,).

    drives  motions of the inputs, of which only the values count, (samples,)
    NaN where the mechanism does not close. Raises MechanismError for an unknown body, and for inputs that move through
    more than `MOST_CELLS` cells between two samples or from 0.
    """
    relation = _relation(plan.mechanism, body, against)
    samples = np.shape(next(iter(drives.values())).value)
    if relation is not None:
        return np.array(np.broadcast_to(relation.drive(drives).value, samples), dtype=float)
    pair = _Pair(plan, body, against)
    values = {name: np.asarray(np.broadcast_to(drive.value, samples), dtype=float) for name, drive in drives.items()}
    moving = [name for name, value in values.items() if np.ptp(value) > 0]
    if len(moving) > 1 or (not moving and len(values) > 1):
        return _along_samples(pair, values)
    name = (moving or list(values))[0]
    held = tuple((other, float(value[0])) for other, value in values.items() if other != name)
    direction = pair.turned(values, dict.fromkeys(values, np.zeros(samples))).direction
    return _line(pair, name, held, values[name]).at_values(values[name], direction)


@lru_cache(maxsize=64)
def _relation(mechanism: Mechanism, body: str, against: str) -> LinearRelation | None:
    return relation_between(mechanism, body, against)


def _along_samples(pair: _Pair, values: Mapping[str, FloatArray]) -> FloatArray:
    """The angle at samples of several moving inputs [rad]: from 0 to the first, then from sample to sample."""
    way = _Way(pair, {name: np.append(0.0, value) for name, value in values.items()})
    units = _units(pair.plan.mechanism)
    parts = sum(np.ceil(CELLS * np.abs(np.diff(stop)) / units[name]) for name, stop in way.stops.items())
    cells = np.maximum(np.asarray(parts), 1.0)
    _check_cells(pair, float(np.sum(cells)))
    grid = np.concatenate([leg + np.arange(count) / count for leg, count in enumerate(cells)] + [[len(cells)]])
    trace = _traced(way, grid)
    samples = np.searchsorted(trace.at, np.arange(1, len(cells) + 1))
    return np.asarray(trace.angles(trace.at)[samples])


def _line(pair: _Pair, name: str, held: tuple[tuple[str, float], ...], values: FloatArray) -> _Followed:
    """The way of one input through all that its values need; a whole period where the mechanism repeats."""
    mechanism = pair.plan.mechanism
    period = _period(mechanism, name)
    if period:
        return _cycle(pair, name, held, period)
    unit = _units(mechanism)[name]
    reach = max(float(np.max(np.abs(values))) / unit, 1.0)
    _check_cells(pair, 2 * CELLS * reach)
    return _both_ways(pair, name, held, unit * 2.0 ** math.ceil(math.log2(reach)))


@lru_cache(maxsize=64)
def _cycle(pair: _Pair, name: str, held: tuple[tuple[str, float], ...], periods: int) -> _Followed:
    """A whole period of a turning input; where it does not close all over, from a gap to the next."""
    length = periods * turn
    trace = _line_trace(pair, name, held, np.array([0.0, length]), CELLS * periods)
    at, direction, change = length * trace.at, trace.direction, trace.change
    gaps = np.flatnonzero(np.isnan(change))
    if not len(gaps):
        return _Followed(
            at, direction, trace.angles(at) + _base(pair, name, held), length, round(np.sum(change) / turn)
        )
    first = gaps[0] + 1
    at = np.append(at[first:-1], at[:first] + length)
    direction = np.append(direction[first:-1], direction[:first])
    change = np.append(change[first:], change[: first - 1])
    distance = np.abs(at - length * np.round(at / length))
    angle = _Trace(at, direction, change).angles(distance) + _base(pair, name, held)
    return _Followed(at, direction, angle, length)


@lru_cache(maxsize=4)
def _both_ways(pair: _Pair, name: str, held: tuple[tuple[str, float], ...], reach: float) -> _Followed:
    """The line of an input from -reach to reach [rad; m]."""
    cells = 2 * CELLS * max(round(reach / _units(pair.plan.mechanism)[name]), 1)
    trace = _line_trace(pair, name, held, np.array([-reach, reach]), cells)
    at = reach * (2 * trace.at - 1)
    return _Followed(at, trace.direction, trace.angles(np.abs(at)) + _base(pair, name, held))


def _line_trace(pair: _Pair, name: str, held: tuple[tuple[str, float], ...], ends: FloatArray, cells: int) -> _Trace:
    stops = {other: np.full(2, value) for other, value in held} | {name: ends}
    return _traced(_Way(pair, stops), np.linspace(0.0, 1.0, cells + 1))


def _base(pair: _Pair, name: str, held: tuple[tuple[str, float], ...]) -> float:
    """Whole turns [rad] of the angle with one input at 0 and the others held, followed from all inputs at 0."""
    if not any(value for _, value in held):
        return 0.0
    values = {name: np.zeros(1)} | {other: np.array([value]) for other, value in held}
    angle = _along_samples(pair, values)[0]
    return turn * round(angle / turn) if math.isfinite(angle) else 0.0


def _traced(way: _Way, grid: FloatArray) -> _Trace:
    """The way's places with the changes of the angle between them, its cells halved where that is needed."""
    ends = way.places(grid).direction
    a, b, start, end = grid[:-1], grid[1:], ends[:-1], ends[1:]
    cells: list[tuple[np.ndarray, ...]] = []
    for halving in range(HALVINGS + 1):
        middle = (a + b) / 2
        passed = way.places(middle)
        first, second = (np.angle(v * np.conj(u)) for u, v in ((start, passed.direction), (passed.direction, end)))
        with np.errstate(invalid="ignore", over="ignore"):
            misfit = np.abs((b - a) * passed.rate - first - second)
            smooth = (np.maximum(np.abs(first), np.abs(second)) <= LARGEST) & (misfit <= LARGEST)
        closed = [np.isfinite(direction) for direction in (start, passed.direction, end)]
        split = ~smooth & np.logical_or.reduce(closed) & (halving < HALVINGS)
        first, second = (np.where(smooth | (np.abs(step) < np.pi / 2), step, np.nan) for step in (first, second))
        cells.append(tuple(one[~split] for one in (a, middle, start, passed.direction, first, second)))
        if not split.any():
            break
        _check_cells(way.pair, len(grid) + 2 * int(np.count_nonzero(split)))
        a, b = np.append(a[split], middle[split]), np.append(middle[split], b[split])
        start, end = (np.append(start[split], passed.direction[split]), np.append(passed.direction[split], end[split]))
    at, middle, start, between, first, second = (np.concatenate(rows) for rows in zip(*cells, strict=True))
    order = np.argsort(at, kind="stable")
    at, middle, start, between, first, second = (row[order] for row in (at, middle, start, between, first, second))
    return _Trace(
        np.append(np.ravel(np.column_stack((at, middle))), grid[-1]),
        np.append(np.ravel(np.column_stack((start, between))), ends[-1]),
        np.ravel(np.column_stack((first, second))),
    )


def _check_cells(pair: _Pair, count: float) -> None:
    if count > MOST_CELLS:
        raise MechanismError(
            f"the angle of {pair.body} in {pair.plan.mechanism.name} needs {count:.3g} cells to be followed",
            allowed=f"at most {MOST_CELLS}",
            do="give more steps, or values nearer to 0",
        )


def _units(mechanism: Mechanism) -> dict[str, float]:
    """Input -> a turn [rad], or the mechanism's length [m]."""
    length = max((abs(point) for body in mechanism.bodies for point in body.points.values()), default=0.0) or 1.0
    return {entry.name: turn if isinstance(entry, Rotation) else length for entry in mechanism.inputs}


def _period(mechanism: Mechanism, name: str) -> int:
    """Turns of an input after which the mechanism is in the same position, the other inputs held; 0: never."""
    if not any(entry.name == name and isinstance(entry, Rotation) for entry in mechanism.inputs):
        return 0
    if not mechanism.couplings:
        return 1
    factors = {key: relation.shares.get(name, 0.0) for key, relation in linear_relations(mechanism).items()}
    if any(factor for (kind, _), factor in factors.items() if kind == "travel"):
        return 0
    for periods in range(1, MOST_PERIODS + 1):
        whole = all(abs(periods * factor - round(periods * factor)) < periods * HALF for factor in factors.values())
        if whole and not any(pair.law is not None and periods % pair.law.turns for pair in mechanism.couplings):
            return periods
    return 0


def _principal(direction: complex) -> float:
    """Angle of a direction [rad], in (-pi, pi]; within rounding of -pi it is pi."""
    angle = math.atan2(direction.imag, direction.real)
    return angle + turn if angle < HALF - math.pi else angle
