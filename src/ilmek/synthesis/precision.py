"""Where a four-bar meets its precision positions: the configuration nearest to each, on which circuit and branch.

With timing the crank angle is given, and the assemblies there are compared. Without, every circuit is searched for
configurations in which what is asked misses least, by Gauss and Newton's steps from the least of its samples.

The drawn branch is preferred, then the drawn circuit, then any other: a position is said to lie elsewhere only where it
is met there and not nearer home. Where a curve passes twice through a place, the pass that keeps the order is taken.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from ilmek.arrays import Float, FloatArray, IntArray
from ilmek.synthesis.circuit_loops import CircuitLoop
from ilmek.synthesis.four_bar import FourBar
from ilmek.synthesis.task import PrecisionTask

SAMPLES = 360
"""Configurations of each circuit among which nearest ones are looked for."""

STEPS, ENOUGH = 16, 1e-13
"""Steps of the polish, and a step that is no more worth taking; few are needed where the position is met."""

ASIDE = np.array([[0.0], [1e-6], [-1e-6]])
"""Where rates are taken: central differences are enough for the steps of a polish."""

LEAN = 1e-7
"""|sin u| below which a configuration stands in a dead centre of the crank and belongs to both branches."""

CHOICES = 512
"""Combinations of passes that are tried for one that keeps the order."""

SAME_TURN = 1e-7
"""Turn of the crank between positions below which they are met at once [rad]."""

ROUND = 2 * math.pi


@dataclass(frozen=True, slots=True)
class PositionMatch:
    """A configuration chosen for a precision position: index of the circuit, its parameter, and by how much it misses.

    branch  +1, -1, or 0 in a dead centre of the crank      miss  the largest error, in units of what counts as met
    """

    loop: int
    u: float
    crank: float
    branch: int
    miss: float


def position_matches(
    four_bar: FourBar, task: PrecisionTask, loops: Sequence[CircuitLoop]
) -> tuple[PositionMatch | None, ...]:
    """For each precision position the configuration that is taken for it; None where the linkage does not get there."""
    if not loops:
        return (None,) * task.count
    found = _all_places(four_bar, task, loops)
    home = _home(four_bar, loops)
    preferred = [_preferred(ways, home) for ways in found]
    if any(not ways for ways in preferred):
        return tuple(ways[0] if ways else None for ways in preferred)
    for k, chosen in enumerate(product(*preferred)):
        if k == CHOICES:
            break
        way = order(chosen, loops)
        if way and way.kept:
            return chosen
    return tuple(ways[0] for ways in preferred)


class PositionOrder(NamedTuple):
    """How far the crank has to go from the first position to each, and whether it rocks.

    A crank that rocks on one branch: its turn [rad], with a sign. Else the way round the circuit, from 0 to 2 pi.
    """

    way: Float[np.ndarray, " positions"]
    rocks: bool

    @property
    def kept(self) -> bool:
        """Whether the crank, going one way, meets all positions in the order of the task."""
        if self.rocks:
            return _rises(self.way) or _rises(-self.way)
        return _rises(_closed(self.way)) or _rises(_closed(np.mod(-self.way, ROUND)))

    @property
    def numbers(self) -> tuple[int, ...]:
        """Positions, counted from 1, as they are met going the way in which the second comes before the last."""
        met = [int(k) + 1 for k in np.argsort(self.way, kind="stable")]
        if self.rocks:
            return tuple(met if met.index(1) <= met.index(len(met)) else met[::-1])
        if len(met) > 2 and met.index(2) > met.index(len(met)):
            return (met[0], *met[:0:-1])
        return tuple(met)


def order(chosen: Sequence[PositionMatch], loops: Sequence[CircuitLoop]) -> PositionOrder | None:
    """The order in which the crank meets configurations; None where they are not on one circuit."""
    if len({one.loop for one in chosen}) != 1:
        return None
    if not loops[chosen[0].loop].branch and len({one.branch for one in chosen} - {0}) <= 1:
        return PositionOrder(np.array([one.crank - chosen[0].crank for one in chosen]), rocks=True)
    way = np.mod([one.u - chosen[0].u for one in chosen], ROUND)
    way[way > ROUND - SAME_TURN] = 0.0
    return PositionOrder(way, rocks=False)


def misses(four_bar: FourBar, task: PrecisionTask, loop: CircuitLoop, u: FloatArray, which: IntArray) -> FloatArray:
    """What is asked of positions `which`, missed in the configurations at u: components on a leading axis.

    Points in units of what counts as met, and so angles: chords of unit vectors.
    """
    pose, parts = loop.at(u), []
    if task.points is not None:
        parts.append((pose.tracer - task.points[which]) / task.near)
    for turns, drawn, direction in (
        (task.coupler_turns, four_bar.coupler_angle, pose.coupler),
        (task.rocker_turns, four_bar.rocker_angle, pose.rocker),
    ):
        if turns is not None:
            parts.append((direction - np.exp(1j * (drawn + turns[which]))) / task.angle_tolerance)
    return np.stack([component for part in parts for component in (part.real, part.imag)])


def _all_places(four_bar: FourBar, task: PrecisionTask, loops: Sequence[CircuitLoop]) -> list[list[PositionMatch]]:
    found: list[list[PositionMatch]] = [[] for _ in range(task.count)]
    for index, loop in enumerate(loops):
        for position, u in _looked_at(four_bar, task, loop):
            miss = float(np.max(np.abs(misses(four_bar, task, loop, np.array([u]), np.array([position])))))
            crank = float(loop.crank(np.array(u)))
            branch = loop.branch or (0 if abs(math.sin(u)) < LEAN else int(loop.branches(np.array(u))))
            found[position].append(PositionMatch(index, u, crank, branch, miss))
    return found


def _looked_at(four_bar: FourBar, task: PrecisionTask, loop: CircuitLoop) -> Iterator[tuple[int, float]]:
    """Positions and the parameters at which this circuit may meet them."""
    if task.crank_turns is not None:
        for position, turn in enumerate(task.crank_turns):
            for u in loop.places(four_bar.crank_angle + turn):
                yield position, float(u)
        return
    grid = np.linspace(0, ROUND, SAMPLES, endpoint=False)
    square = np.stack([_square(four_bar, task, loop, grid, np.full(SAMPLES, j)) for j in range(task.count)])
    least = (square <= np.roll(square, 1, axis=1)) & (square < np.roll(square, -1, axis=1))
    which, at = np.nonzero(least)
    yield from zip(which.tolist(), _polished(four_bar, task, loop, grid[at], which).tolist(), strict=True)


def _square(four_bar: FourBar, task: PrecisionTask, loop: CircuitLoop, u: FloatArray, which: IntArray) -> FloatArray:
    return np.asarray(np.sum(misses(four_bar, task, loop, u, which) ** 2, axis=0))


def _polished(four_bar: FourBar, task: PrecisionTask, loop: CircuitLoop, u: FloatArray, which: IntArray) -> FloatArray:
    """The parameters at which positions `which` are missed least, from u: Gauss and Newton's steps, cut where worse."""

    def near(at: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The square of what is missed, and the next step."""
        missed, right, left = misses(four_bar, task, loop, at + ASIDE, which).swapaxes(0, 1)
        rate = (right - left) / (2 * ASIDE[1])
        slope, steep = np.sum(rate * missed, axis=0), np.sum(rate * rate, axis=0)
        step = np.clip(-slope / np.maximum(steep, 1e-300), -ROUND / SAMPLES, ROUND / SAMPLES)
        return np.sum(missed * missed, axis=0), step

    best, move = near(u)
    for _ in range(STEPS):
        value, further = near(u + move)
        better = value < best
        u, best = np.where(better, u + move, u), np.where(better, value, best)
        move = np.where(better, further, 0.25 * move)
        if np.max(np.abs(move), initial=0.0) < ENOUGH:
            break
    return u


def _home(four_bar: FourBar, loops: Sequence[CircuitLoop]) -> tuple[int, int]:
    """The circuit and branch in which the four-bar is drawn."""
    gaps = []
    for loop in loops:
        u = loop.places(four_bar.crank_angle, 1e-6)
        gaps.append(float(np.min(np.abs(loop.at(u).b - four_bar.b), initial=np.inf)))
    return int(np.argmin(gaps)), four_bar.branch


def _preferred(ways: list[PositionMatch], home: tuple[int, int]) -> list[PositionMatch]:
    """Configurations that will do for a position, the best kind only, those that miss least first."""
    ways = sorted(ways, key=lambda one: one.miss)
    circuit = [one for one in ways if one.loop == home[0]]
    branch = [one for one in circuit if one.branch in (home[1], 0)]
    for kind in (branch, circuit, ways):
        met = [one for one in kind if one.miss <= 1]
        if met:
            return met
    return (branch or circuit or ways)[:1]


def _rises(way: FloatArray) -> bool:
    return bool(np.all(np.diff(way) >= -SAME_TURN))


def _closed(way: FloatArray) -> FloatArray:
    """The last position at the place of the first is met after a full round."""
    way = np.where(way > ROUND - SAME_TURN, 0.0, way)
    if len(way) > 2 and way[-1] < SAME_TURN:
        way[-1] = ROUND
    return way
