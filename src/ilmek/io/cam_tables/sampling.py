"""Points of a cam table such that the controller follows the motion within a tolerance.

A table begins at position 0 whatever the position of the axis, because a relatively coupled controller jumps by the
first point; the offset is reported. The last point is the first one, a turn and its advance later.
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
"""Distance from a joint at which its one-sided values are evaluated [rad]."""

_INSIDE, _FINE, _LEAST_FINE = 8, 20000, 33
"""Points at which the error is evaluated: per interval while points are added; per turn at the end;
at least per interval at the end.
"""

_SPARE = 0.95
"""Share of the tolerance used to place points, because the fine grid at the end finds a slightly larger error."""

_LEAST_STEP = math.radians(1e-3)
"""Smallest interval that is divided [rad]; a controller's clock does not resolve smaller ones."""

_ROUNDS, _CUTS = 24, 16


@dataclass(frozen=True, slots=True)
class SamplingRule:
    """Requirements of a controller on its table.

    interpolation  of the controller's default setting, a name of `INTERPOLATIONS`
    better         that of a better setting; "": none
    even           equidistant points
    least, most    number of points that it accepts
    """

    interpolation: str
    better: str = ""
    even: bool = False
    least: int = 2
    most: int = 10_000


@dataclass(frozen=True, slots=True)
class SampledTable:
    """A table's points, and the error of a controller that interpolates them.

    nodes      points from position 0
    offset     position of the motion at master angle 0, subtracted from the nodes [SI]
    error      largest error of the controller's motion in its default setting, on a fine grid between all points [SI]
    at         master angle of the largest error [rad]
    better     largest error in the better setting [SI]; None: there is none
    tolerance  allowed error [SI]
    """

    nodes: Nodes
    interpolation: str
    offset: float
    error: float
    at: float
    tolerance: float
    better: float | None = None

    @property
    def kept(self) -> bool:
        """Whether the error is within the tolerance."""
        return self.error <= self.tolerance


def stroke(table: CamTable) -> float:
    """Range of positions over the turn [SI], or the advance per turn if larger."""
    angle = np.concatenate([np.linspace(0.0, turn, 1441), np.clip(table.knots, 0.0, turn)])
    return max(float(np.ptp(table.motion(angle)[0])), abs(table.revolves))


def sample(table: CamTable, rule: SamplingRule, tolerance: float) -> SampledTable:
    """The points that satisfy the tolerance [SI], or the best that the controller accepts.

    Raises OutputError for a motion that jumps from the end of the turn to its beginning.
    """
    _require_closed(table, tolerance)
    interpolation = INTERPOLATIONS[rule.interpolation]
    distribute = _even if rule.even else _adaptive
    nodes = distribute(table, rule, interpolation, _SPARE * tolerance)
    angle = _between(nodes.angle, max(_LEAST_FINE, _FINE // len(nodes.angle)))
    wrong = _errors(table, nodes, interpolation, angle)
    worst = int(np.argmax(wrong))
    better = float(_errors(table, nodes, INTERPOLATIONS[rule.better], angle).max()) if rule.better else None
    return SampledTable(
        nodes=nodes,
        interpolation=interpolation.name,
        offset=_position(table, 0.0),
        error=float(wrong.flat[worst]),
        at=float(angle.flat[worst]),
        tolerance=tolerance,
        better=better,
    )


def _require_closed(table: CamTable, tolerance: float) -> None:
    gap = _position(table, turn - _SIDE) - _position(table, 0.0) - table.revolves
    if abs(gap) > max(tolerance, 1e-9 * stroke(table)):
        given = f"{table.name} ends a turn {format_quantity(gap, table.unit)} from its beginning"
        raise OutputError(given, allowed="a cam table continues into its next turn without a jump")


def _position(table: CamTable, angle: float) -> float:
    return float(table.motion(np.array([angle]))[0, 0])


def _nodes(table: CamTable, angle: Float[np.ndarray, " nodes"]) -> Nodes:
    """The motion at these angles [rad], from position 0; at joints and ends of the turn the mean of both sides."""
    before = np.where(angle <= 0, turn - _SIDE, angle - _SIDE)
    after = np.where(angle >= turn, _SIDE, angle + _SIDE)
    rows = 0.5 * (table.motion(before) + table.motion(after))
    s = table.motion(angle)[0] - _position(table, 0.0)
    s[0], s[-1] = 0.0, table.revolves
    return Nodes(angle, s, _without_noise(rows[1]), _without_noise(rows[2]))


def _without_noise(values: Float[np.ndarray, " nodes"]) -> Float[np.ndarray, " nodes"]:
    """The values, with 0 for those below 1e-7 of the largest: rounding, or the jerk over a nanoradian."""
    return np.where(np.abs(values) > 1e-7 * np.abs(values).max(initial=0.0), values, 0.0)


def _even(table: CamTable, rule: SamplingRule, interpolation: Interpolation, tolerance: float) -> Nodes:
    """The fewest equidistant points that satisfy the tolerance; the largest number if none does."""
    counts = [count for count in _EVEN if rule.least - 1 <= count < rule.most] or [_EVEN[0]]
    for count in counts:
        nodes = _nodes(table, np.arange(count + 1) * (turn / count))
        if _errors(table, nodes, interpolation, _between(nodes.angle, _INSIDE)).max() <= tolerance:
            break
    return nodes


_EVEN = (36, 72, 120, 180, 240, 360, 450, 720, 900, 1440, 1800, 2400, 3600, 7200)
"""Numbers of even steps."""


def _adaptive(table: CamTable, rule: SamplingRule, interpolation: Interpolation, tolerance: float) -> Nodes:
    """Points at all joints, and more between them until the error is within the tolerance."""
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
    """Joints of the motion and ends of the turn; more if the controller needs more, equidistant if fewer."""
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
    """The same division; only of the worst intervals if the number of points is limited."""
    if np.sum(parts - 1) <= room:
        return parts
    halved = np.ones(len(parts), dtype=int)
    worst = np.argsort(-wrong)[:room]
    halved[worst[parts[worst] > 1]] = 2
    return halved


def _divided(angle: Float[np.ndarray, " nodes"], parts: Int[np.ndarray, " steps"]) -> Float[np.ndarray, " more"]:
    """The angles, with each step divided evenly into the given number of parts."""
    steps = zip(angle[:-1], np.diff(angle), parts, strict=True)
    pieces = [low + step * np.arange(count) / count for low, step, count in steps]
    return np.append(np.concatenate(pieces), angle[-1])


def _between(angle: Float[np.ndarray, " nodes"], count: int) -> Float[np.ndarray, "a b"]:
    """`count` angles inside each step."""
    shares = (np.arange(count) + 0.5) / count
    return np.asarray(angle[:-1, None] + np.diff(angle)[:, None] * shares)


def _errors(
    table: CamTable, nodes: Nodes, interpolation: Interpolation, angle: Float[np.ndarray, "a b"]
) -> Float[np.ndarray, "a b"]:
    exact = table.motion(angle)[0] - _position(table, 0.0)
    return np.asarray(np.abs(interpolation.at(nodes, angle) - exact))
