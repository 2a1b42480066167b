"""Proof of a real four-bar of a task: its exact dimensions lie within a stated distance of the computed ones.

    |d_j + T_j x - A|² = |x - A|² for both links,    T_j = c_j + i s_j,    c_j² + s_j² = 1 at points

in the unknowns A, x, B, y and, of each point, c and s. Of a pose c and s are intervals that contain the exact values
for its angle, so that the proof holds for the task as given in floating-point numbers.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ilmek.arrays import Bool, Complex, Float
from ilmek.num.intervals import Intervals, stacked
from ilmek.num.krawczyk import certified_roots
from ilmek.records import record
from ilmek.synthesis.alt_burmester.task import PosesAndPoints

ANGLE_ULPS = 4
"""Units in the last place by which a cosine or sine may be wrong."""

PINS = "AxBy"
"""Complex unknowns that are not rotations."""


@record
class Certificate:
    """Proof of four-bars, with improved numbers: see `certify`.

    certified  whether each is proven      pins, turns  improved
    pin_error, turn_error  distances of the exact pins [unit_length] and turns [1] from them; NaN if not proven
    """

    certified: Bool[np.ndarray, " four_bars"]
    pins: Complex[np.ndarray, "four_bars 4"]
    turns: Complex[np.ndarray, "four_bars others"]
    pin_error: Float[np.ndarray, " four_bars"]
    turn_error: Float[np.ndarray, " four_bars"]


def certify(
    task: PosesAndPoints, pins: Complex[np.ndarray, "four_bars 4"], turns: Complex[np.ndarray, "four_bars others"]
) -> Certificate:
    """Prove four-bars by Krawczyk's operator.

    pins   A, x, B, y in lengths of `unit_length`, relative to the tracer at the reference
    turns  T of the other positions, in the order of `task.others`
    """
    if not len(pins):
        return Certificate(np.zeros(0, dtype=bool), pins, turns, np.zeros(0), np.zeros(0))
    free = np.flatnonzero(~task.pose)
    numbers = np.concatenate([pins, turns[:, free]], axis=1)
    near = np.stack([numbers.real, numbers.imag], -1).reshape(len(pins), -1)
    roots = certified_roots(_System(task), near)
    improved = roots.roots[:, ::2] + 1j * roots.roots[:, 1::2]
    errors = np.hypot(roots.radius[:, ::2], roots.radius[:, 1::2])
    turned = turns.copy()
    turned[:, free] = improved[:, len(PINS) :]
    pin_error, turn_error = errors[:, : len(PINS)].max(axis=1), errors[:, len(PINS) :].max(axis=1, initial=0.0)
    return Certificate(roots.certified, improved[:, : len(PINS)], turned, pin_error, turn_error)


def unit_length(task: PosesAndPoints) -> float:
    """The power of two next to the size of the task [m]: division by it is exact."""
    return float(2.0 ** np.round(np.log2(task.size)))


class _System:
    """The equations in intervals."""

    def __init__(self, task: PosesAndPoints) -> None:
        points = (task.points / unit_length(task)).astype(np.clongdouble)
        others, reference = points[task.others], points[task.reference]
        self.x = Intervals.of(others.real) - reference.real
        self.y = Intervals.of(others.imag) - reference.imag
        angles = np.where(task.pose, task.angles[task.others], 0.0).astype(np.longdouble)
        self.turns = Intervals.of(angles) - np.where(task.pose, task.angles[task.reference], 0.0)
        self.pose = task.pose

    def __call__(self, X: Intervals) -> tuple[Intervals, Intervals]:
        values, rows, at = [], [], 2 * len(PINS)
        for j, pose in enumerate(self.pose):
            if pose:
                turn = known_turn(self.turns[j], X.low.dtype)
            else:
                turn = Turn(X[:, at], X[:, at + 1], at)
                values.append(turn.c.square + turn.s.square - 1.0)
                rows.append(_row(X, {at: turn.c * 2.0, at + 1: turn.s * 2.0}))
                at += 2
            for link in range(2):
                value, row = link_equation(X, 4 * link, (self.x[j], self.y[j]), turn)
                values.append(value)
                rows.append(row)
        return stacked(values, -1), stacked(rows, -2)


class Turn(NamedTuple):
    """Cosine and sine of the coupler's rotation, and the column of the cosine where they are unknown."""

    c: Intervals
    s: Intervals
    column: int | None


def link_equation(X: Intervals, at: int, shift: tuple[Intervals, Intervals], turn: Turn) -> tuple[Intervals, Intervals]:
    """|d + T x - A|² - |x - A|² of a link at a position, and its derivatives.

    X      unknowns (..., n); those of the link are A and x, four real numbers from column `at`
    shift  displacement d of the body's point, x and y      turn  T
    """
    c, s, column = turn
    ax, ay, px, py = (X[:, at + k] for k in range(4))
    kind = X.low.dtype
    turned_x, turned_y = c * px - s * py, s * px + c * py
    qx, qy = turned_x + shift[0].rounded(kind) - ax, turned_y + shift[1].rounded(kind) - ay
    rx, ry = px - ax, py - ay
    slopes = {
        at: (rx - qx) * 2.0,
        at + 1: (ry - qy) * 2.0,
        at + 2: (c * qx + s * qy - rx) * 2.0,
        at + 3: (c * qy - s * qx - ry) * 2.0,
    }
    if column is not None:
        slopes |= {column: (qx * px + qy * py) * 2.0, column + 1: (qy * px - qx * py) * 2.0}
    return qx.square + qy.square - rx.square - ry.square, _row(X, slopes)


def _row(X: Intervals, slopes: dict[int, Intervals]) -> Intervals:
    zero = Intervals.of(np.zeros(X.low.shape[0], X.low.dtype))
    return stacked([slopes.get(column, zero) for column in range(X.low.shape[1])], -1)


def known_turn(angle: Intervals, kind: np.dtype[Any]) -> Turn:
    """Cosine and sine of an angle that lies in an interval [rad], in numbers of a kind."""
    c, s = (_enclosed(function, angle).rounded(kind) for function in (np.cos, np.sin))
    return Turn(c, s, None)


def _enclosed(function: Callable[[np.ndarray], np.ndarray], angle: Intervals) -> Intervals:
    """Cosine or sine of an angle that lies in an interval: its slope is at most 1."""
    spread = angle.radius + ANGLE_ULPS * np.finfo(angle.low.dtype).eps
    return Intervals.around(function(angle.middle), spread)
