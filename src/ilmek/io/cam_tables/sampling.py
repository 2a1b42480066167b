"""Points for a cam table: where they must stand so that the controller keeps the course within a tolerance.

A table begins at position 0 whatever the axis' place, since a controller that is coupled relatively jumps by what the
first point says; the offset is told beside it. The last point is the first, a turn and its gain later.
"""

import math
from dataclasses import dataclass

import numpy as np

from ilmek.arrays import Float, Int
from ilmek.errors import OutputError
from ilmek.io.cam_tables.interpolation import INTERPOLATIONS, Interpolation, Nodes
from ilmek.report import CamTable
from ilmek.units import format_quantity, turn

_SIDE = 1e-9
"""How far from a joint its one-sided values are taken [rad]."""

_INSIDE, _FINE, _LEAST_FINE = 8, 20000, 33
"""Places of an interval at which the error is looked at while points are added; of the turn, at the end, and then of
each interval at least.
"""

_SPARE = 0.95
"""Share of the tolerance that points are placed by, since the fine grid at the end finds a little more."""

_LEAST_STEP = math.radians(1e-3)
"""Intervals are not divided below this [rad]: a controller's clock does not resolve them."""

_ROUNDS, _CUTS = 24, 16


@dataclass(frozen=True, slots=True)
class SamplingRule:
    """What a controller asks of its table.

    interpolation  how it goes from point to point      even   points equally far apart
    least, most    how many points it takes
    """

    interpolation: str
    even: bool = False
    least: int = 2
    most: int = 10_000


@dataclass(frozen=True, slots=True)
class SampledTable:
    """A table's points, and what a controller makes of them.

    nodes   from position 0       offset  position of the course at the master angle 0, which the nodes are less by [SI]
    error   largest distance of the controller's course from the exact one, on a fine grid between all points [SI]
    at      master angle of it [rad]
    """

    nodes: Nodes
    interpolation: str
    offset: float
    error: float
    at: float
    tolerance: float

    @property
    def kept(self) -> bool:
        """Whether the tolerance is kept."""
        return self.error <= self.tolerance


def stroke(table: CamTable) -> float:
    """Largest less least position over the turn [SI], or what it gains."""
    angle = np.concatenate([np.linspace(0.0, turn, 1441), np.clip(table.knots, 0.0, turn)])
    return max(float(np.ptp(table.course(angle)[0])), abs(table.revolves))


def sample(table: CamTable, rule: SamplingRule, tolerance: float) -> SampledTable:
    """The points that keep the tolerance [SI], or come nearest to it with as many as the controller takes.

    Raises OutputError for a course that jumps from the end of the turn to its beginning.
    """
    _require_closed(table, tolerance)
    interpolation = INTERPOLATIONS[rule.interpolation]
    place = _even if rule.even else _where_needed
    nodes = place(table, rule, interpolation, _SPARE * tolerance)
    angle = _between(nodes.angle, max(_LEAST_FINE, _FINE // len(nodes.angle)))
    wrong = _errors(table, nodes, interpolation, angle)
    worst = int(np.argmax(wrong))
    return SampledTable(
        nodes, interpolation.name, _position(table, 0.0), float(wrong.flat[worst]), float(angle.flat[worst]), tolerance
    )


def _require_closed(table: CamTable, tolerance: float) -> None:
    gap = _position(table, turn - _SIDE) - _position(table, 0.0) - table.revolves
    if abs(gap) > max(tolerance, 1e-9 * stroke(table)):
        raise OutputError(
            f"{table.name} ends a turn {format_quantity(gap, table.unit)} from where it began",
            allowed="a cam table runs on into its next turn without a jump",
        )


def _position(table: CamTable, angle: float) -> float:
    return float(table.course(np.array([angle]))[0, 0])


def _nodes(table: CamTable, angle: Float[np.ndarray, " nodes"]) -> Nodes:
    """The course at these angles, from position 0; at a joint the mean of both sides, both ends of the turn alike."""
    before = np.where(angle <= 0, turn - _SIDE, angle - _SIDE)
    after = np.where(angle >= turn, _SIDE, angle + _SIDE)
    rows = 0.5 * (table.course(before) + table.course(after))
    s = table.course(angle)[0] - _position(table, 0.0)
    s[0], s[-1] = 0.0, table.revolves
    return Nodes(angle, s, _settled(rows[1]), _settled(rows[2]))


def _settled(values: Float[np.ndarray, " nodes"]) -> Float[np.ndarray, " nodes"]:
    """The values, those at 0 that are rounding, or half of what a nanoradian makes of the jerk."""
    return np.where(np.abs(values) > 1e-7 * np.abs(values).max(initial=0.0), values, 0.0)


def _even(table: CamTable, rule: SamplingRule, interpolation: Interpolation, tolerance: float) -> Nodes:
    """The fewest even points that keep the tolerance; the most there are where none does."""
    counts = [count for count in _EVEN if rule.least - 1 <= count < rule.most] or [_EVEN[0]]
    for count in counts:
        nodes = _nodes(table, np.arange(count + 1) * (turn / count))
        if _errors(table, nodes, interpolation, _between(nodes.angle, _INSIDE)).max() <= tolerance:
            break
    return nodes


_EVEN = (36, 72, 120, 180, 240, 360, 450, 720, 900, 1440, 1800, 2400, 3600, 7200)
"""Numbers of even steps."""


def _where_needed(table: CamTable, rule: SamplingRule, interpolation: Interpolation, tolerance: float) -> Nodes:
    """Points at all joints, and between them where the error asks for more."""
    nodes = _nodes(table, _first(table, rule))
    for _ in range(_ROUNDS):
        wrong = _errors(table, nodes, interpolation, _between(nodes.angle, _INSIDE)).max(axis=1)
        wide = np.diff(nodes.angle) > 2 * _LEAST_STEP
        room = rule.most - len(nodes.angle)
        if not (wide & (wrong > tolerance)).any() or room < 1:
            break
        with np.errstate(over="ignore"):
            parts = np.ceil((wrong / tolerance) ** (1 / interpolation.order))
        parts = np.where(wide, np.clip(parts, 1, _CUTS), 1).astype(int)
        nodes = _nodes(table, _divided(nodes.angle, _within(parts, wrong, room)))
    return nodes


def _first(table: CamTable, rule: SamplingRule) -> Float[np.ndarray, " nodes"]:
    """The joints of the course and both ends of the turn; more where the controller wants more, even ones if fewer."""
    joints = np.unique(np.concatenate([[0.0], np.mod(table.knots, turn), [turn]]))
    joints = joints[np.append(True, np.diff(joints) > _LEAST_STEP)]
    joints[-1] = turn
    if len(joints) > rule.most:
        return np.linspace(0.0, turn, rule.most)
    while len(joints) < rule.least:
        joints = _divided(joints, np.full(len(joints) - 1, 2))
    return joints


def _within(
    parts: Int[np.ndarray, " steps"], wrong: Float[np.ndarray, " steps"], room: int
) -> Int[np.ndarray, " steps"]:
    """The same division, the worst intervals only, where there is no room for all."""
    if np.sum(parts - 1) <= room:
        return parts
    halved = np.ones(len(parts), dtype=int)
    worst = np.argsort(-wrong)[:room]
    halved[worst[parts[worst] > 1]] = 2
    return halved


def _divided(angle: Float[np.ndarray, " nodes"], parts: Int[np.ndarray, " steps"]) -> Float[np.ndarray, " more"]:
    """The angles, and those that part each step evenly into so many."""
    steps = zip(angle[:-1], np.diff(angle), parts, strict=True)
    pieces = [low + step * np.arange(count) / count for low, step, count in steps]
    return np.append(np.concatenate(pieces), angle[-1])


def _between(angle: Float[np.ndarray, " nodes"], count: int) -> Float[np.ndarray, "a b"]:
    """So many places inside of each step."""
    shares = (np.arange(count) + 0.5) / count
    return np.asarray(angle[:-1, None] + np.diff(angle)[:, None] * shares)


def _errors(
    table: CamTable, nodes: Nodes, interpolation: Interpolation, angle: Float[np.ndarray, "a b"]
) -> Float[np.ndarray, "a b"]:
    exact = table.course(angle)[0] - _position(table, 0.0)
    return np.asarray(np.abs(interpolation.at(nodes, angle) - exact))
