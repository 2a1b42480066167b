"""Check of a four-bar against its task: positions, circuit, branch, order, transmission angle, size.

Circuits and branches are in closed form (`circuit_loops`); the errors are computed by forward simulation (`linkage`).
[Chase and Mirth, Circuits and branches of single-degree-of-freedom planar linkages, 1993; Waldron on order and branch.]
"""

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Float, FloatArray
from ilmek.errors import ParameterError
from ilmek.linkage.quality import Grashof
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.records import value_record
from ilmek.synthesis.circuit_loops import CircuitLoop, LoopConfigurations, circuit_loops
from ilmek.synthesis.four_bar import TRACER, FourBar
from ilmek.synthesis.precision import PositionMatch, order, position_matches
from ilmek.synthesis.task import PrecisionTask

SAMPLES = 72
"""Configurations of a circuit at which the size is computed."""


@dataclass(frozen=True, slots=True)
class PositionResult:
    """How a precision position is met.

    crank_angle   in the ground frame [rad]; NaN where the position is not reached
    circuit       1 or 2; 0 where the position is not reached
    branch        +1, -1; 0 at a dead centre of the crank
    point_error [m], coupler_error, rocker_error [rad]   by forward simulation; NaN where not required or not reached
    """

    crank_angle: float
    circuit: int
    branch: int
    point_error: float
    coupler_error: float
    rocker_error: float

    @property
    def reached(self) -> bool:
        """Whether the linkage closes at this position."""
        return self.circuit > 0


@dataclass(frozen=True, slots=True)
class CircuitSegment:
    """A part of a circuit: crank angles from `low` to `high` [rad] on a branch; with branch 0 the whole circuit."""

    loop: CircuitLoop
    low: float
    high: float
    branch: int

    @property
    def samples(self) -> FloatArray:
        """Parameters u of the circuit along the segment, shape (samples,)."""
        if not self.branch:
            return np.linspace(0, 2 * np.pi, SAMPLES, endpoint=False)
        ends = [float(np.max(self.loop.parameters_at(end))) for end in (self.low, self.high)]
        return np.linspace(ends[0], ends[1], SAMPLES) * self.branch

    @property
    def cosines(self) -> tuple[float, float]:
        """Least and greatest cosine of the angle between crank and ground link."""
        linkage = self.loop.four_bar
        low, high = (end - cmath.phase(linkage.b0 - linkage.a0) for end in (self.low, self.high))
        cosines = [math.cos(low), math.cos(high)]
        # At a multiple of pi in the range the crank passes the ground line.
        cosines += [(-1.0) ** k for k in range(math.ceil(low / math.pi), math.floor(high / math.pi) + 1)]
        return min(cosines), max(cosines)


@value_record
class Candidate:
    """A four-bar, its task, and the results of the check.

    positions     how each precision position is met
    circuits      number of circuits of the four-bar: 1 or 2; 0 where it closes nowhere
    order         positions, counted from 1, as the crank meets them in one direction; () where not on one circuit
    in_order      whether this is the order of the task
    transmission  least and greatest angle between coupler and rocker [rad]: over the turn of a crank that rotates
                  fully, otherwise between its first and last position
    link_ratio    longest link / shortest link [1]
    size          greatest distance between two positions of pins and tracer [m], from samples
    """

    four_bar: FourBar
    task: PrecisionTask
    grashof: Grashof
    positions: tuple[PositionResult, ...]
    circuits: int
    order: tuple[int, ...]
    in_order: bool
    transmission: tuple[float, float]
    link_ratio: float
    size: float

    @property
    def crank_turns(self) -> bool:
        """Whether the crank rotates fully."""
        return self.grashof.crank_turns

    @property
    def reached(self) -> bool:
        """Whether the linkage closes at every position."""
        return all(position.reached for position in self.positions)

    @property
    def one_circuit(self) -> bool:
        """Whether all positions that are reached are on one circuit."""
        return len({position.circuit for position in self.positions} - {0}) <= 1

    @property
    def one_branch(self) -> bool:
        """Whether all positions that are reached are on one branch of one circuit."""
        return self.one_circuit and len({position.branch for position in self.positions} - {0}) <= 1

    @property
    def point_error(self) -> float:
        """Greatest error of a point [m]; NaN where the task has no points."""
        return _greatest([position.point_error for position in self.positions])

    @property
    def angle_error(self) -> float:
        """Greatest error of an angle of coupler or rocker [rad]; NaN where the task has no such angles."""
        return _greatest(
            [error for position in self.positions for error in (position.coupler_error, position.rocker_error)]
        )

    @property
    def met(self) -> bool:
        """Whether every position is met within the task's tolerances."""
        within = (self.point_error, self.task.point_limit), (self.angle_error, self.task.angle_tolerance)
        return self.reached and not any(error > most for error, most in within)

    @property
    def least_transmission(self) -> float:
        """Least transmission angle [rad]: minimum of mu and pi - mu over the motion."""
        return min(self.transmission[0], math.pi - self.transmission[1])

    def motion(self, count: int) -> LoopConfigurations:
        """`count` positions of the motion: the turn of a crank that turns fully, else from the first to the last pose.

        Only of a candidate whose positions are all reached, on one circuit.
        """
        loop = circuit_loops(self.four_bar)[self.positions[0].circuit - 1]
        if loop.branch:
            return loop.at(np.linspace(-np.pi, np.pi, count))
        cranks = [met.crank_angle for met in self.positions]
        branch = next((met.branch for met in self.positions if met.branch), +1)
        ends = [float(np.max(loop.parameters_at(end))) for end in (min(cranks), max(cranks))]
        return loop.at(branch * np.linspace(ends[0], ends[1], count))

    def transmission_over(self, *, task_only: bool) -> float:
        """Least transmission angle over the motion [rad], or from the first to the last position alone.

        NaN where the task alone is required and a position is not reached, or on another circuit.
        """
        if not task_only or not self.crank_turns:
            return self.least_transmission
        cosines = working_cosines(self)
        if cosines is None:
            return math.nan
        low, high = _transmission_angles(self.four_bar, cosines)
        return min(low, math.pi - high)


def judge(four_bar: FourBar, task: PrecisionTask) -> Candidate:
    """Check a four-bar against a task.

    four_bar  as drawn at the first position [m]      task  precision positions [m, rad]

    Defects of the four-bar do not raise: they are reported in the candidate. Raises ParameterError where the task has
    points and the four-bar has no tracer.

    >>> drawn = FourBar(0j, 4 + 0j, 1j, 3 + 3j, tracer=2 + 3j)
    >>> found = judge(drawn, PrecisionTask(points=np.array([2 + 3j, 0.9 + 2.1j]), point_tolerance=0.2))
    >>> found.grashof.kind, found.circuits, found.one_branch, found.met
    ('crank-rocker', 2, True, True)
    """
    if task.points is not None and four_bar.tracer is None:
        raise ParameterError("the task has points, the four-bar has no tracer", do="give the tracer of the four-bar")
    loops = circuit_loops(four_bar)
    chosen = position_matches(four_bar, task, loops)
    reached = [one for one in chosen if one is not None]
    met_order = order(reached, loops) if len(reached) == len(chosen) else None
    segments = _segments(reached, loops)
    lengths = four_bar.lengths
    return Candidate(
        four_bar,
        task,
        four_bar.grashof,
        _position_results(four_bar, task, chosen),
        len(loops),
        met_order.numbers if met_order else (),
        met_order is not None and (met_order.kept or task.crank is not None),
        _transmission(four_bar, segments),
        max(lengths) / min(lengths),
        _size(four_bar, segments),
    )


def working_cosines(one: Candidate) -> tuple[float, float] | None:
    """Least and greatest cosine of the angle between crank and ground link, from the first to the last position.

    None where a position is not reached. A crank that turns fully moves in the direction of the order; where the
    positions are out of order it is the whole turn.
    """
    if not one.reached or not one.one_circuit:
        return None
    cranks = [met.crank_angle for met in one.positions]
    loop = circuit_loops(one.four_bar)[one.positions[0].circuit - 1]
    if not loop.branch:
        return CircuitSegment(loop, min(cranks), max(cranks), one.positions[0].branch).cosines
    low, high = task_rotation(cranks)
    return CircuitSegment(loop, low, high, loop.branch).cosines


def task_rotation(cranks: Sequence[float]) -> tuple[float, float]:
    """Crank angles from the first to the last position of a crank that turns fully, low to high [rad].

    The whole turn where no direction meets the positions in order.
    """
    onward = np.mod(np.subtract(cranks, cranks[0]), 2 * np.pi)
    back = np.mod(-onward, 2 * np.pi)
    if np.all(np.diff(onward) > 0):
        return cranks[0], cranks[0] + float(onward[-1])
    if np.all(np.diff(back) > 0):
        return cranks[0] - float(back[-1]), cranks[0]
    return cranks[0] - np.pi, cranks[0] + np.pi


def _position_results(
    four_bar: FourBar, task: PrecisionTask, chosen: Sequence[PositionMatch | None]
) -> tuple[PositionResult, ...]:
    """Errors of each position, by forward simulation at its crank angle."""
    count = len(chosen)
    errors = {name: np.full(count, np.nan) for name in ("point", "coupler", "rocker")}
    for branch in (+1, -1):
        which = np.array([k for k, one in enumerate(chosen) if one and (one.branch or +1) == branch], dtype=int)
        if len(which):
            cranks = np.array([one.crank for one in chosen if one and (one.branch or +1) == branch])
            for name, values in _errors(four_bar, task, branch, cranks, which).items():
                errors[name][which] = values
    return tuple(
        PositionResult(
            one.crank if one else math.nan,
            one.loop + 1 if one else 0,
            one.branch if one else 0,
            *(float(errors[name][k]) for name in ("point", "coupler", "rocker")),
        )
        for k, one in enumerate(chosen)
    )


def _errors(
    four_bar: FourBar, task: PrecisionTask, branch: int, cranks: FloatArray, which: np.ndarray
) -> dict[str, Float[np.ndarray, " positions"]]:
    """Errors of the positions `which` at crank angles [rad], by forward simulation."""
    motion = solve(plan(four_bar.mechanism(branch)), cranks)
    errors = {}
    if task.points is not None:
        errors["point"] = np.abs(motion.point("coupler", TRACER).position - task.points[which])
    for name, turns, drawn in (
        ("coupler", task.coupler_turns, four_bar.coupler_angle),
        ("rocker", task.rocker_turns, four_bar.rocker_angle),
    ):
        if turns is not None:
            errors[name] = np.abs(np.angle(motion.direction(name) * np.exp(-1j * (drawn + turns[which]))))
    return errors


def _segments(reached: Sequence[PositionMatch], loops: Sequence[CircuitLoop]) -> list[CircuitSegment]:
    """Working range: between the positions on one branch of a crank that rocks, otherwise the whole circuit."""
    segments = []
    for index in sorted({one.loop for one in reached}):
        loop, here = loops[index], [one for one in reached if one.loop == index]
        branches = {one.branch for one in here} - {0}
        if not loop.branch and len(branches) <= 1:
            cranks = [one.crank for one in here]
            segments.append(CircuitSegment(loop, min(cranks), max(cranks), next(iter(branches), +1)))
        else:
            segments.append(CircuitSegment(loop, loop.low, loop.high, 0))
    return segments


def _transmission(four_bar: FourBar, segments: Sequence[CircuitSegment]) -> tuple[float, float]:
    """Least and greatest transmission angle [rad]; it grows with |A B0|, so with the angle from ground to crank."""
    if not segments:
        return math.nan, math.nan
    cosines = [cosine for segment in segments for cosine in segment.cosines]
    return _transmission_angles(four_bar, (min(cosines), max(cosines)))


def _transmission_angles(four_bar: FourBar, cosines: tuple[float, float]) -> tuple[float, float]:
    """Least and greatest transmission angle [rad] between a least and a greatest cosine of the crank's angle."""
    ground, crank, coupler, rocker = four_bar.lengths
    squares = [ground**2 + crank**2 - 2 * ground * crank * cosine for cosine in reversed(cosines)]
    mu = [(coupler**2 + rocker**2 - square) / (2 * coupler * rocker) for square in squares]
    return math.acos(min(1.0, max(-1.0, mu[0]))), math.acos(min(1.0, max(-1.0, mu[1])))


def _size(four_bar: FourBar, segments: Sequence[CircuitSegment]) -> float:
    """Greatest distance between two positions of pins and tracer [m]."""
    positions = [np.array([four_bar.a0, four_bar.b0, four_bar.a, four_bar.b])]
    for segment in segments:
        pose = segment.loop.at(segment.samples)
        positions += [pose.a, pose.b] + ([] if four_bar.tracer is None else [pose.tracer])
    points = np.concatenate(positions)
    return float(np.max(np.abs(points[:, None] - points[None, :])))


def _greatest(errors: list[float]) -> float:
    known = [error for error in errors if not math.isnan(error)]
    return max(known, default=math.nan)
