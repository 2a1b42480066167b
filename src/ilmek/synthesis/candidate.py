"""Judging a four-bar against its task: does it really do it, in one piece, in order, and how well.

Circuits and branches come in closed form (`circuit_loops`), the errors by moving the four-bar through `linkage`.
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
from ilmek.synthesis.circuit_loops import CircuitLoop, circuit_loops
from ilmek.synthesis.four_bar import TRACER, FourBar
from ilmek.synthesis.precision import PositionMatch, order, position_matches
from ilmek.synthesis.task import PrecisionTask

SWEEP = 72
"""Crank angles at which size and transmission angle are looked at."""


@dataclass(frozen=True, slots=True)
class PositionResult:
    """How a precision position is met.

    crank_angle [rad, world; NaN where the linkage does not get there]
    circuit  1 or 2; 0 where it does not get there      branch  +1, -1; 0 in a dead centre of the crank
    point_error [m], coupler_error, rocker_error [rad]  by forward simulation; NaN where not asked, or not reached
    """

    crank_angle: float
    circuit: int
    branch: int
    point_error: float
    coupler_error: float
    rocker_error: float

    @property
    def reached(self) -> bool:
        """Whether the linkage closes there."""
        return self.circuit > 0


@dataclass(frozen=True, slots=True)
class CircuitSegment:
    """A part of a circuit: crank angles from `low` to `high` [rad] on a branch, or with branch 0 the whole of it."""

    loop: CircuitLoop
    low: float
    high: float
    branch: int

    @property
    def samples(self) -> FloatArray:
        """Parameters of the circuit along the stretch."""
        if not self.branch:
            return np.linspace(0, 2 * np.pi, SWEEP, endpoint=False)
        ends = [float(np.max(self.loop.places(end))) for end in (self.low, self.high)]
        return np.linspace(ends[0], ends[1], SWEEP) * self.branch

    @property
    def cosines(self) -> tuple[float, float]:
        """Least and greatest cosine of the crank's angle off the ground link."""
        drawn = self.loop.four_bar
        low, high = (end - cmath.phase(drawn.b0 - drawn.a0) for end in (self.low, self.high))
        cosines = [math.cos(low), math.cos(high)]
        # A multiple of pi within: the crank passes the ground line.
        cosines += [(-1.0) ** k for k in range(math.ceil(low / math.pi), math.floor(high / math.pi) + 1)]
        return min(cosines), max(cosines)


@dataclass(frozen=True, slots=True)
class Candidate:
    """A four-bar, its task, and what was found.

    positions     how each precision position is met
    circuits      number of circuits that the four-bar has (0: it does not close anywhere, 1 or 2)
    order         positions, counted from 1, as the crank meets them turning one way; () where not on one circuit
    in_order      whether that is the order of the task
    transmission  least and greatest angle of coupler against rocker [rad]: over the turn of a crank that turns fully,
                  else between its first and last position
    link_ratio    longest link by shortest      size  greatest distance of places that pins, tracer reach [m], roughly
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
        """Whether the crank turns fully."""
        return self.grashof.crank_turns

    @property
    def reached(self) -> bool:
        """Whether the linkage closes at every position."""
        return all(one.reached for one in self.positions)

    @property
    def one_circuit(self) -> bool:
        """Whether all positions that it gets to are on one circuit."""
        return len({one.circuit for one in self.positions} - {0}) <= 1

    @property
    def one_branch(self) -> bool:
        """Whether all positions that it gets to are on one branch of one circuit."""
        return self.one_circuit and len({one.branch for one in self.positions} - {0}) <= 1

    @property
    def point_error(self) -> float:
        """Greatest error of a point [m]; NaN where none is asked."""
        return _greatest([one.point_error for one in self.positions])

    @property
    def angle_error(self) -> float:
        """Greatest error of an angle of coupler or rocker [rad]; NaN where none is asked."""
        return _greatest([error for one in self.positions for error in (one.coupler_error, one.rocker_error)])

    @property
    def met(self) -> bool:
        """Whether every position is met within the task's tolerances."""
        within = (self.point_error, self.task.near), (self.angle_error, self.task.angle_tolerance)
        return self.reached and not any(error > most for error, most in within)

    @property
    def least_transmission(self) -> float:
        """Least acute transmission angle [rad]: of mu and pi - mu over the motion."""
        return min(self.transmission[0], math.pi - self.transmission[1])


def judge(four_bar: FourBar, task: PrecisionTask) -> Candidate:
    """Everything that is to be known of a four-bar before it is built for a task.

    Never fails for a four-bar that is bad: what is wrong is said in the candidate.
    Raises ParameterError where the task asks for points and the four-bar has no tracer.

    >>> drawn = FourBar(0j, 4 + 0j, 1j, 3 + 3j, tracer=2 + 3j)
    >>> found = judge(drawn, PrecisionTask(points=np.array([2 + 3j, 0.9 + 2.1j]), point_tolerance=0.2))
    >>> found.grashof.kind, found.circuits, found.one_branch, found.met
    ('crank-rocker', 2, True, True)
    """
    if task.points is not None and four_bar.tracer is None:
        raise ParameterError("the task asks for points, the four-bar has no tracer", do="say which point draws them")
    loops = circuit_loops(four_bar)
    chosen = position_matches(four_bar, task, loops)
    reached = [one for one in chosen if one is not None]
    met_in = order(reached, loops) if len(reached) == len(chosen) else None
    stretches = _stretches(reached, loops)
    lengths = four_bar.lengths
    return Candidate(
        four_bar,
        task,
        four_bar.grashof,
        _met(four_bar, task, chosen),
        len(loops),
        met_in.numbers if met_in else (),
        met_in is not None and (met_in.kept or task.crank is not None),
        _transmission(four_bar, stretches),
        max(lengths) / min(lengths),
        _size(four_bar, stretches),
    )


def _met(four_bar: FourBar, task: PrecisionTask, chosen: Sequence[PositionMatch | None]) -> tuple[PositionResult, ...]:
    """Each position by forward simulation at the crank angle chosen for it."""
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
    """Errors of positions `which` at crank angles: the four-bar moved through `linkage`."""
    motion = solve(plan(four_bar.mechanism(branch)), cranks)
    found = {}
    if task.points is not None:
        found["point"] = np.abs(motion.point("coupler", TRACER).position - task.points[which])
    for name, turns, drawn in (
        ("coupler", task.coupler_turns, four_bar.coupler_angle),
        ("rocker", task.rocker_turns, four_bar.rocker_angle),
    ):
        if turns is not None:
            found[name] = np.abs(np.angle(motion.direction(name) * np.exp(-1j * (drawn + turns[which]))))
    return found


def _stretches(reached: Sequence[PositionMatch], loops: Sequence[CircuitLoop]) -> list[CircuitSegment]:
    """Where the four-bar works: between the positions of one branch of a crank that rocks, else on all the circuit."""
    found = []
    for index in sorted({one.loop for one in reached}):
        loop, here = loops[index], [one for one in reached if one.loop == index]
        branches = {one.branch for one in here} - {0}
        if not loop.branch and len(branches) <= 1:
            cranks = [one.crank for one in here]
            found.append(CircuitSegment(loop, min(cranks), max(cranks), next(iter(branches), +1)))
        else:
            found.append(CircuitSegment(loop, loop.low, loop.high, 0))
    return found


def _transmission(four_bar: FourBar, stretches: Sequence[CircuitSegment]) -> tuple[float, float]:
    """Least and greatest transmission angle [rad]: it grows with |A B0|, so with the crank's angle off the ground."""
    if not stretches:
        return math.nan, math.nan
    ground, crank, coupler, rocker = four_bar.lengths
    cosines = [cosine for one in stretches for cosine in one.cosines]
    squares = [ground**2 + crank**2 - 2 * ground * crank * cosine for cosine in (max(cosines), min(cosines))]
    mu = [(coupler**2 + rocker**2 - square) / (2 * coupler * rocker) for square in squares]
    return math.acos(min(1.0, max(-1.0, mu[0]))), math.acos(min(1.0, max(-1.0, mu[1])))


def _size(four_bar: FourBar, stretches: Sequence[CircuitSegment]) -> float:
    """Greatest distance between two of the places that pins and tracer get to [m]."""
    spots = [np.array([four_bar.a0, four_bar.b0, four_bar.a, four_bar.b])]
    for one in stretches:
        pose = one.loop.at(one.samples)
        spots += [pose.a, pose.b] + ([] if four_bar.tracer is None else [pose.tracer])
    every = np.concatenate(spots)
    return float(np.max(np.abs(every[:, None] - every[None, :])))


def _greatest(errors: list[float]) -> float:
    known = [error for error in errors if not math.isnan(error)]
    return max(known, default=math.nan)
