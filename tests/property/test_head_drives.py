"""The drives of a head: pins stay in the slots of levers, twisted bars in their nut, springs press as the cam's."""

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ilmek.machines.weaver import MACHINE, Weaver, WeaverParams
from ilmek.machines.weaver.cam_belt import cam_belt
from ilmek.machines.weaver.levers import FollowerLever
from ilmek.machines.weaver.return_springs import SEATS, spring_of
from ilmek.machines.weaver.tool_parts import LEFT, RIGHT
from ilmek.machines.weaver.tree import head_tree
from ilmek.part.twisted import TwistedBar
from ilmek.plane.solids import is_closed, volume
from ilmek.units import mm

_LENGTHS = st.floats(5e-3, 0.1)


@cache
def _head() -> Weaver:
    made: Weaver = MACHINE.design(WeaverParams())
    return made


@given(_LENGTHS, st.floats(0.5, 6.0), st.floats(1e-3, 0.02), st.booleans(), st.floats(0.0, 1.0))
def test_both_pins_stay_in_their_slots_while_the_tool_moves_by_the_ratio(
    arm: float, ratio: float, lift: float, straight: bool, share: float
) -> None:
    lever = FollowerLever(0.1 + 0.2j, arm, ratio, lift, straight)
    up = (share - 0.5) * lift
    back = np.exp(-1j * float(lever.turned(share * lift)))
    follower = (arm + 1j * up) * back
    moved = -1j * ratio * up if straight else -ratio * up
    tool = (lever.pin - lever.pivot + moved) * back * (-1 if straight else -1j)
    for pin, length in ((follower, arm), (tool, ratio * arm)):
        near, far = lever.slot(length)
        assert abs(pin.imag) < 1e-12
        assert near - 1e-12 <= pin.real <= far + 1e-12


@given(st.floats(1e-3, 0.01), st.floats(0.01, 0.1), st.floats(-3.0, 3.0))
def test_a_twisted_bar_is_closed_and_keeps_its_volume(side: float, length: float, angle: float) -> None:
    bar = TwistedBar(side, (0.0, length / 3, length), (0.0, 0.0, angle))
    solid = bar.mesh()
    assert is_closed(solid)
    assert volume(solid) == pytest.approx(side**2 * length, rel=0.01)
    assert bar.moments.zeroth == pytest.approx(bar.volume)
    ends = solid.points[np.isclose(solid.points[:, 2], length)]
    turned = (ends[:, 0] + 1j * ends[:, 1]) * np.exp(-1j * angle)
    assert np.allclose(np.sort(np.abs(turned.real)), side / 2)


def test_the_section_of_a_twisted_bar_in_the_nut_is_level_at_every_travel() -> None:
    made = _head()
    tree, by = head_tree(made), made.grippers
    nut = made.shape.partition + 6.5 * mm
    for name, hand in ((LEFT, -1), (RIGHT, 1)):
        occurrence = next(one for one in tree.body(name).occurrences if isinstance(one.part.shape, TwistedBar))
        bar, tip = occurrence.part.shape, made.tool_bodies.tip(name)
        assert isinstance(bar, TwistedBar)
        for travel in np.linspace(-made.params.pull_back, by.opening + by.crossing, 23):
            z = nut - (tip - travel + occurrence.positions[0].origin[2])
            assert 0 < z < bar.length
            level = float(np.interp(z, bar.stations, bar.angles)) + hand * float(by.turned(travel))
            assert math.sin(2 * level) == pytest.approx(0.0, abs=1e-9)


def test_the_springs_at_the_tools_press_the_followers_as_the_cams_ask() -> None:
    made = _head()
    for cam in made.cams:
        spring, seat = spring_of(made, cam.name), SEATS[cam.name]
        assert spring is not None
        ratio = cam.ratio if seat.at_tool else 1.0
        assert seat.number * spring.rate * ratio**2 == pytest.approx(cam.rate)
        assert spring.solid_stress <= spring.allowed
        assert seat.inner <= spring.diameter - spring.wire_diameter
        assert spring.diameter + spring.wire_diameter <= seat.outer


@given(st.floats(1.0, 25.0), st.sampled_from((0.010, 0.016)))
def test_the_belt_bears_its_torque_where_the_cams_leave_room(torque: float, width: float) -> None:
    belt = cam_belt(torque, 0.09, width, 15e-3)
    assert 1.25 * belt.pull <= 42.0e3 * width * (1 + 1e-9)
    assert belt.radii[0] <= 0.09
    assert belt.ratio >= 1
