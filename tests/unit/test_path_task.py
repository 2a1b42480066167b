"""What is no task of a path, and what is said about it."""

import math

import numpy as np
import pytest

from ilmek.errors import ParameterError
from ilmek.synthesis.path.order import in_order, pooled
from ilmek.synthesis.path.search import path_four_bars
from ilmek.synthesis.path.task import PathTask

SQUARE = np.array([0j, 1, 1 + 1j, 1j])
QUARTERS = np.radians([0.0, 60, 120, 180])


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (dict(points=SQUARE[:3]), "4 to 200 points.*dyads"),
        (dict(points=np.arange(201.0) + 0j), "4 to 200 points.*give fewer points"),
        (dict(points=np.array([0, 1, math.nan, 2])), "point 3"),
        (dict(points=np.ones(5) + 0j), "all points of the path are the same"),
        (dict(points=np.array([0j, 1, 1, 2])), "points 2 and 3 of the path are the same; remove one"),
        (dict(points=SQUARE, timing=np.zeros(3)), "3 angles for 4 points"),
        (dict(points=SQUARE, timing=np.array([0.0, 1, 0.5, 2])), "not monotonic"),
        (dict(points=SQUARE, timing=np.array([0.0, 60, 120, 180])), "180 deg was meant"),
        (dict(points=SQUARE, kind="triple-rocker"), "crank-rocker, double-crank"),
        (dict(points=SQUARE, transmission=45.0), "45 deg was meant"),
        (dict(points=SQUARE, bounds={"link": (0.0, 1.0)}), "bounds of: ground, crank"),
        (dict(points=SQUARE, bounds={"crank": (2.0, 1.0)}), "crank from 2 to 1"),
        (dict(points=SQUARE, bounds={"crank": (-1.0, 1.0)}), "above 0"),
        (dict(points=SQUARE, bounds={"turn": (0.0, 90.0)}), "90 deg was meant"),
    ],
)
def test_what_is_no_task_is_refused_in_words(given, said):
    with pytest.raises(ParameterError, match=said):
        PathTask(**given)


def test_limits_that_clash_are_named():
    with pytest.raises(ParameterError, match=r"ground 0.01 m to 1 m and crank 2 m to 3 m clash"):
        PathTask(SQUARE, bounds={"ground": (0.01, 1.0), "crank": (2.0, 3.0)})


def test_a_transmission_angle_that_clashes_with_lengths_is_named():
    lengths = {"ground": (1.0, 1.0), "crank": (0.5, 0.5)}
    PathTask(SQUARE, bounds=lengths, transmission=math.radians(30))
    with pytest.raises(ParameterError, match=r"crank 0.5 m to 0.5 m and a transmission angle of 75 deg clash"):
        PathTask(SQUARE, bounds=lengths, transmission=math.radians(75))


@pytest.mark.parametrize("name", ["count", "starts", "threads"])
def test_a_search_without_starts_is_refused(name):
    with pytest.raises(ParameterError, match=f"{name} 0"):
        path_four_bars(PathTask(SQUARE), **{name: 0})


def test_a_rest_is_a_point_twice_with_a_timing():
    assert PathTask(np.array([0j, 1, 1, 2]), timing=QUARTERS).size == 2


def test_a_task_has_bounds_where_none_are_given():
    low, high = PathTask(2 * SQUARE, bounds={"x": (5.0, 6.0)}).limits()
    np.testing.assert_allclose(low, [0.02, 0.02, 0.02, 0.02, -20, -20, 5, -19, -math.inf, 0])
    np.testing.assert_allclose(high, [20, 20, 20, 20, 20, 20, 6, 21, math.inf, 0])


def test_order_is_one_turn_either_way():
    rows = np.array([[0.0, 1, 2, 6.2], [3.0, 1, 0, -3.2], [0.0, 2, 1, 3], [0.0, 1, 2, 6.4]])
    assert in_order(rows).tolist() == [True, True, False, False]


def test_points_beyond_a_turn_share_the_angle_of_the_first():
    angles, blocks = pooled(np.array([0.0, 2.0, 4.0, 6.5]), np.arange(4))
    assert blocks.tolist() == [0, 1, 2, 0]
    assert angles[3] - angles[0] == pytest.approx(2 * math.pi)
    assert angles[0] == pytest.approx((6.5 - 2 * math.pi) / 2)


def test_falling_angles_are_pooled_too_and_stay_pooled():
    angles, blocks = pooled(np.array([3.0, 1.0, 2.0, 0.0]), np.array([0, 1, 1, 2]))
    assert blocks.tolist() == [0, 1, 1, 2]
    np.testing.assert_allclose(angles, [3.0, 1.5, 1.5, 0.0])
