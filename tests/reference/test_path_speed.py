"""The quickest motion along a path, against closed forms and against other methods."""

import math

import numpy as np
import pytest
from scipy.optimize import linprog

from ilmek.arrays import FloatArray
from ilmek.timing.path_speed.path import rise
from ilmek.timing.path_speed.solve import AxesLimits, JointPath, quickest_motion
from ilmek.timing.s_curve import AxisLimits, move_time


def straight(distance: float = 1.0, nodes: int = 9, direction: tuple[float, ...] = (1.0,)) -> JointPath:
    s = np.linspace(0.0, distance, nodes)
    one = np.broadcast_to(direction, (nodes, len(direction))).astype(float)
    return JointPath(s, s[:, None] * one, one, 0 * one)


def arc(turn: float = math.pi / 2, nodes: int = 121) -> JointPath:
    """A circle's arc of length 1 by two axes."""
    s = np.linspace(0.0, 1.0, nodes)
    angle, radius = turn * s, 1 / turn
    across, along = np.stack([np.sin(angle), -np.cos(angle)], 1), np.stack([np.cos(angle), np.sin(angle)], 1)
    return JointPath(s, radius * across, along, -across / radius)


def wave(nodes: int = 241) -> JointPath:
    """Two axes that go to and fro at different paces."""
    s = np.linspace(0.0, 1.0, nodes)
    k = np.array([3.0, 5.0])
    phase = s[:, None] * k + np.array([0.3, 1.0])
    return JointPath(s, np.sin(phase) / k, np.cos(phase), -k * np.sin(phase))


def equal(axes: int, speed: float, acceleration: float, jerk: float) -> AxesLimits:
    return AxesLimits(*(np.full(axes, limit) for limit in (speed, acceleration, jerk)))


@pytest.mark.parametrize(
    ("speed", "acceleration", "jerk"),
    [
        (math.inf, math.inf, 1.0),  # four phases
        (math.inf, 0.3, 1.0),  # six, no cruising
        (0.3, math.inf, 1.0),  # five, acceleration not reached
        (0.3, 0.3, 1.0),  # all seven
        (0.05, 0.1, 1.0),  # a long way
        (0.5, 0.5, 10.0),
        (0.01, 1.0, 1e3),
        (math.inf, 1.0, 1e5),  # nearly without a limit of jerk: 2 sqrt(L / A)
    ],
)
def test_one_axis_takes_the_time_of_the_seven_phases(speed: float, acceleration: float, jerk: float) -> None:
    found = quickest_motion(straight(), equal(1, speed, acceleration, jerk)).duration
    exact = move_time(1.0, AxisLimits(speed, acceleration, jerk))
    assert exact * (1 - 1e-4) <= found <= exact * 1.0015


def test_the_slowest_axis_sets_the_time_of_a_straight_way() -> None:
    limits = AxesLimits(np.array([0.3, 1.0]), np.array([0.5, 1.0]), np.array([2.0, 9.0]))
    found = quickest_motion(straight(1.0, 9, (1.0, -0.25)), limits).duration
    assert found == pytest.approx(move_time(1.0, AxisLimits(0.3, 0.5, 2.0)), rel=1.5e-3)


def phase_plane_time(path: JointPath, acceleration: FloatArray, count: int = 1500) -> float:
    """Time with limits of acceleration alone: the largest b = s'² by a pass back and one forth.

    |q' b_s / 2 + q'' b| <= A [Bobrow and others, 1985; in steps of b: Pham and Pham, TOPP-RA, 2018, two constraints
    in (b, b_s) at each node].
    """
    s = np.linspace(0.0, 1.0, count + 1)
    step = s[1] - s[0]
    q1, q2 = path.at(s, 1), path.at(s, 2)

    def range_of(k: int, low: float, high: float) -> float:
        """Largest b at node k from which the next node's b can be brought into [low, high]."""
        # |q1 a + q2 b| <= A with the next b = b + 2 step a: a polygon in (a, b), of which b is sought as large.
        rows, bounds = [], []
        for slope, bend, most in zip(q1[k], q2[k], acceleration, strict=True):
            rows += [[slope, bend], [-slope, -bend]]
            bounds += [most, most]
        rows += [[2 * step, 1.0], [-2 * step, -1.0]]
        bounds += [high, -low]
        A, c = np.array(rows), np.array(bounds)
        best = 0.0
        for i in range(len(A)):
            for j in range(i):
                det = A[i, 0] * A[j, 1] - A[i, 1] * A[j, 0]
                if abs(det) > 1e-14:
                    a = (c[i] * A[j, 1] - A[i, 1] * c[j]) / det
                    b = (A[i, 0] * c[j] - c[i] * A[j, 0]) / det
                    if b > best and (A @ [a, b] <= c + 1e-9).all():
                        best = b
        return best

    top = np.zeros(count + 1)
    for k in range(count - 1, -1, -1):
        top[k] = range_of(k, 0.0, top[k + 1])
    b = np.zeros(count + 1)
    for k in range(count):
        with np.errstate(divide="ignore"):
            most = np.min((acceleration - np.sign(q1[k]) * q2[k] * b[k]) / np.abs(q1[k]))
        b[k + 1] = min(top[k + 1], b[k] + 2 * step * most)
    speed = np.sqrt(b)
    return float(np.sum(2 * step / (speed[1:] + speed[:-1])))


def test_with_little_need_of_jerk_it_is_the_phase_planes_time() -> None:
    path, limit = arc(), np.array([1.0, 1.0])
    found = quickest_motion(path, AxesLimits(np.full(2, math.inf), limit, np.full(2, 1e5)))
    assert found.duration == pytest.approx(phase_plane_time(path, limit, 400), rel=3e-3)


def by_linear_programmes(path: JointPath, limits: AxesLimits, count: int) -> float:
    """Time of the same problem by sequential linear programmes in w = u'² at nodes, with differences for derivatives.

    The jerk's J / sqrt(w) is taken by its tangent, the objective by its own, within a region of trust.
    """
    u = np.linspace(0.0, 1.0, count + 1)
    h = u[1]
    q1, q2, q3 = (one[1:-1] for one in path.derivatives(u))
    eye = np.eye(count + 1)
    mid, first, second = eye[1:-1], (eye[2:] - eye[:-2]) / (2 * h), (eye[2:] - 2 * eye[1:-1] + eye[:-2]) / h**2
    bends, jerks, w = [], [], np.full(count + 1, 1e-3)
    for axis in range(2):
        p1, p2, p3 = (one[:, axis, None] for one in (q1, q2, q3))
        bends.append((p2 * mid + p1 * first / 2) / limits.acceleration[axis])
        jerks.append((p3 * mid + 1.5 * p2 * first + p1 * second / 2) / limits.jerk[axis])
    quick = np.max((np.stack([q1[:, 0], q1[:, 1]], 1) / limits.speed) ** 2, axis=1)
    ends = np.max(np.cbrt(np.abs(path.derivatives(u[[0, -1]])[2]) / limits.jerk), axis=1) ** -2  # there Q' = Q'' = 0
    top = np.r_[ends[0], 1 / quick, ends[1]]
    weight = np.full(count + 1, h)
    weight[[0, -1]] = h / 2
    for trust in 1 + 0.8 ** np.maximum(np.arange(30) - 12, 0):
        root = w[1:-1, None] ** -0.5
        tangent = -0.5 * mid * root**3
        signs = (1, -1)
        rows = [
            *(sign * one for one in bends for sign in signs),
            *(sign * one - tangent for one in jerks for sign in signs),
        ]
        right = [np.ones(count - 1)] * 4 + [1.5 * root[:, 0]] * 4
        bounds = np.stack([w / trust, np.minimum(w * trust, np.maximum(top, w / trust))], 1)
        answer = linprog(-weight * w**-1.5, np.concatenate(rows), np.concatenate(right), bounds=bounds, method="highs")
        w = answer.x
    return float(weight @ w**-0.5)


@pytest.mark.parametrize("path", [arc(), wave()], ids=["arc", "wave"])
@pytest.mark.parametrize("limits", [(1.0, 3.0, 30.0), (5.0, 20.0, 100.0)])
def test_linear_programmes_find_no_quicker_motion(path: JointPath, limits: tuple[float, float, float]) -> None:
    both = equal(2, *limits)
    found = quickest_motion(path, both).duration
    other = by_linear_programmes(path, both, 80)
    assert found == pytest.approx(other, rel=1e-3)


def test_the_rise_ends_at_rest_at_both_ends() -> None:
    ends = np.array([0.0, 1.0])
    values, slopes, bends, _ = rise(ends)
    assert values.tolist() == [0.0, 1.0]
    assert not slopes.any()
    assert not bends.any()
