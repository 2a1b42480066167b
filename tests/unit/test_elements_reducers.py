"""Classes of reducers: they ascend, their screws hold their torque, and a check fails beyond the largest."""

from itertools import pairwise
from math import pi

import pytest

from ilmek.elements.machine_screws import SOCKET_SCREWS
from ilmek.elements.motors import MOTORS
from ilmek.elements.reducers import PLANETARY, REDUCER_FLANGES, Reducer, flange_for, reducer_check


def test_classes_ascend_in_torque_size_and_mass():
    for smaller, larger in pairwise(REDUCER_FLANGES):
        assert smaller.torque < larger.torque
        assert smaller.face < larger.face
        assert smaller.mass < larger.mass


@pytest.mark.parametrize("row", REDUCER_FLANGES, ids=lambda row: f"{row.torque:g} Nm")
def test_screws_of_a_class_hold_its_torque_by_friction_and_have_room_on_its_face(row):
    # Preload 0.7 f_ub A_s of 8.8 less a sixth of tightening, friction 0.2, over 1.25; stress area by the thread alone.
    screw = SOCKET_SCREWS[row.thread]
    area = pi / 4 * (screw.diameter - 0.9382 * screw.pitch) ** 2
    held = row.number * 0.2 * (0.7 * 800e6 * area / 1.2) / 1.25 * row.circle / 2
    assert held > row.torque
    assert row.circle / 2**0.5 + 2 * 0.8 * screw.diameter < row.face * (1 if row.number == 4 else 2)
    assert row.circle + screw.diameter < row.face * (2**0.5 if row.number == 4 else 1)


def test_every_planetary_stage_with_the_strongest_motor_has_a_class():
    most = max(by.output_torque(motor.torque) for by in PLANETARY for motor in MOTORS)
    assert flange_for(most).torque >= most


def test_a_load_beyond_the_largest_class_fails_the_check():
    by, most = Reducer(1000.0, 0.45), REDUCER_FLANGES[-1].torque
    assert reducer_check("reducer", by, 10.0, 0.99 * most, "reducer").ok
    assert not reducer_check("reducer", by, 10.0, 1.01 * most, "reducer").ok
