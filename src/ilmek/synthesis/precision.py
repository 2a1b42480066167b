"""Configurations in which a four-bar meets its precision positions, with circuit and branch.

With timing the crank angle is given and the configurations at this angle are compared. Without timing each circuit is
searched for the configurations of least deviation, by Gauss-Newton steps from the minima among its samples.

The drawn branch is preferred, then the drawn circuit, then any other circuit: another one is reported only where the
position is met there and not on a preferred one. Where a curve passes a point twice, the pass that keeps the order is
taken.                              [search derived here; circuit, branch and order: Chase and Mirth, see `candidate`]
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
"""Samples of each circuit among which the least deviations are sought."""

MAX_STEPS, MIN_STEP = 16, 1e-13
"""Greatest number of Gauss-Newton steps, and the step [rad] below which they end."""

OFFSETS = np.array([[0.0], [1e-6], [-1e-6]])
"""Offsets of the central differences [rad]; their accuracy suffices for the steps."""

DEAD_CENTRE = 1e-7
"""|sin u| below which a configuration is at a dead centre of the crank and belongs to both branches."""

MAX_COMBINATIONS = 512
"""Greatest number of combinations of matches that are tried for one in order."""

SAME_TURN = 1e-7
"""Rotation of the crank between positions below which they are met at the same time [rad]."""

FULL_TURN = 2 * math.pi


@dataclass(frozen=True, slots=True)
class PositionMatch:
    """A configuration matched to a precision position.

    loop       index of the circuit              u      its parameter [rad]
    crank      crank angle [rad]                 branch  +1, -1, or 0 at a dead centre of the crank
    deviation  greatest error, relative to its tolerance [1]
    """

    loop: int
    u: float
    crank: float
    branch: int
    deviation: float


def position_matches(
    four_bar: FourBar, task: PrecisionTask, loops: Sequence[CircuitLoop]
) -> tuple[PositionMatch | None, ...]:
    """The configuration matched to each precision position; None where the linkage does not reach it.

    loops  the circuits of the four-bar, see `circuit_loops`
    Positions in [m] and [rad]; deviations are relative to the tolerances of the task [1].
    """
    if not loops:
        return (None,) * task.count
    drawn = _drawn_branch(four_bar, loops)
    preferred = [_preferred(matches, drawn) for matches in _all_matches(four_bar, task, loops)]
    if any(not matches for matches in preferred):
        return tuple(matches[0] if matches else None for matches in preferred)
    for k, chosen in enumerate(product(*preferred)):
        if k == MAX_COMBINATIONS:
            break
        found = order(chosen, loops)
        if found and found.kept:
            return chosen
    return tuple(matches[0] for matches in preferred)


class PositionOrder(NamedTuple):
    """Distances from the first position to each, and whether the crank rocks.

    travel  of a crank that rocks on one branch: its rotation [rad] with sign; otherwise the change of the circuit's
            parameter, from 0 to 2 pi
    """

    travel: Float[np.ndarray, " positions"]
    rocks: bool

    @property
    def kept(self) -> bool:
        """Whether the crank meets all positions in the order of the task when it moves in one direction."""
        if self.rocks:
            return _rises(self.travel) or _rises(-self.travel)
        return _rises(_with_last_after_turn(self.travel)) or _rises(
            _with_last_after_turn(np.mod(-self.travel, FULL_TURN))
        )

    @property
    def numbers(self) -> tuple[int, ...]:
        """Positions, counted from 1, in the direction in which the second one comes before the last."""
        met = [int(k) + 1 for k in np.argsort(self.travel, kind="stable")]
        if self.rocks:
            return tuple(met if met.index(1) <= met.index(len(met)) else met[::-1])
        if len(met) > 2 and met.index(2) > met.index(len(met)):
            return (met[0], *met[:0:-1])
        return tuple(met)


def order(chosen: Sequence[PositionMatch], loops: Sequence[CircuitLoop]) -> PositionOrder | None:
    """Order in which the crank meets the chosen configurations; None where they are not on one circuit."""
    if len({one.loop for one in chosen}) != 1:
        return None
    if not loops[chosen[0].loop].branch and len({one.branch for one in chosen} - {0}) <= 1:
        return PositionOrder(np.array([one.crank - chosen[0].crank for one in chosen]), rocks=True)
    travel = np.mod([one.u - chosen[0].u for one in chosen], FULL_TURN)
    travel[travel > FULL_TURN - SAME_TURN] = 0.0
    return PositionOrder(travel, rocks=False)


def deviations(four_bar: FourBar, task: PrecisionTask, loop: CircuitLoop, u: FloatArray, which: IntArray) -> FloatArray:
    """Deviations from the positions `which` in the configurations at u [rad], both of one shape.

    Components along a leading axis, relative to the tolerances: x and y of points; of angles the chord between unit
    vectors.
    """
    pose, parts = loop.at(u), []
    if task.points is not None:
        parts.append((pose.tracer - task.points[which]) / task.point_limit)
    for turns, drawn, direction in (
        (task.coupler_turns, four_bar.coupler_angle, pose.coupler),
        (task.rocker_turns, four_bar.rocker_angle, pose.rocker),
    ):
        if turns is not None:
            parts.append((direction - np.exp(1j * (drawn + turns[which]))) / task.angle_tolerance)
    return np.stack([component for part in parts for component in (part.real, part.imag)])


def _all_matches(four_bar: FourBar, task: PrecisionTask, loops: Sequence[CircuitLoop]) -> list[list[PositionMatch]]:
    all_matches: list[list[PositionMatch]] = [[] for _ in range(task.count)]
    for index, loop in enumerate(loops):
        for position, u in _trial_parameters(four_bar, task, loop):
            deviation = float(np.max(np.abs(deviations(four_bar, task, loop, np.array([u]), np.array([position])))))
            crank = float(loop.crank(np.array(u)))
            branch = loop.branch or (0 if abs(math.sin(u)) < DEAD_CENTRE else int(loop.branches(np.array(u))))
            all_matches[position].append(PositionMatch(index, u, crank, branch, deviation))
    return all_matches


def _trial_parameters(four_bar: FourBar, task: PrecisionTask, loop: CircuitLoop) -> Iterator[tuple[int, float]]:
    """Positions and the parameters u at which this circuit may meet them."""
    if task.crank_turns is not None:
        for position, turn in enumerate(task.crank_turns):
            for u in loop.parameters_at(four_bar.crank_angle + turn):
                yield position, float(u)
        return
    grid = np.linspace(0, FULL_TURN, SAMPLES, endpoint=False)
    square = np.stack([_square(four_bar, task, loop, grid, np.full(SAMPLES, j)) for j in range(task.count)])
    least = (square <= np.roll(square, 1, axis=1)) & (square < np.roll(square, -1, axis=1))
    which, at = np.nonzero(least)
    yield from zip(which.tolist(), _refined(four_bar, task, loop, grid[at], which).tolist(), strict=True)


def _square(four_bar: FourBar, task: PrecisionTask, loop: CircuitLoop, u: FloatArray, which: IntArray) -> FloatArray:
    return np.asarray(np.sum(deviations(four_bar, task, loop, u, which) ** 2, axis=0))


def _refined(four_bar: FourBar, task: PrecisionTask, loop: CircuitLoop, u: FloatArray, which: IntArray) -> FloatArray:
    """Parameters u of least deviation from positions `which`: Gauss-Newton steps, shortened if they do not improve."""

    def near(at: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Squared deviation and the next step [rad]."""
        deviation, right, left = deviations(four_bar, task, loop, at + OFFSETS, which).swapaxes(0, 1)
        rate = (right - left) / (2 * OFFSETS[1])
        slope, steep = np.sum(rate * deviation, axis=0), np.sum(rate * rate, axis=0)
        step = np.clip(-slope / np.maximum(steep, 1e-300), -FULL_TURN / SAMPLES, FULL_TURN / SAMPLES)
        return np.sum(deviation * deviation, axis=0), step

    best, move = near(u)
    for _ in range(MAX_STEPS):
        value, further = near(u + move)
        better = value < best
        u, best = np.where(better, u + move, u), np.where(better, value, best)
        move = np.where(better, further, 0.25 * move)
        if np.max(np.abs(move), initial=0.0) < MIN_STEP:
            break
    return u


def _drawn_branch(four_bar: FourBar, loops: Sequence[CircuitLoop]) -> tuple[int, int]:
    """Index of the circuit and branch on which the four-bar is drawn."""
    gaps = []
    for loop in loops:
        u = loop.parameters_at(four_bar.crank_angle, 1e-6)
        gaps.append(float(np.min(np.abs(loop.at(u).b - four_bar.b), initial=np.inf)))
    return int(np.argmin(gaps)), four_bar.branch


def _preferred(matches: list[PositionMatch], drawn: tuple[int, int]) -> list[PositionMatch]:
    """Acceptable configurations for a position, of the preferred kind only, the least deviation first."""
    matches = sorted(matches, key=lambda one: one.deviation)
    circuit = [one for one in matches if one.loop == drawn[0]]
    branch = [one for one in circuit if one.branch in (drawn[1], 0)]
    for kind in (branch, circuit, matches):
        met = [one for one in kind if one.deviation <= 1]
        if met:
            return met
    return (branch or circuit or matches)[:1]


def _rises(travel: FloatArray) -> bool:
    return bool(np.all(np.diff(travel) >= -SAME_TURN))


def _with_last_after_turn(travel: FloatArray) -> FloatArray:
    """A last position equal to the first is met after a full turn."""
    travel = np.where(travel > FULL_TURN - SAME_TURN, 0.0, travel)
    if len(travel) > 2 and travel[-1] < SAME_TURN:
        travel[-1] = FULL_TURN
    return travel
