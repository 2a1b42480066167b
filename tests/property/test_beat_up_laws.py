"""The beat-up over random designs: it does what was asked, and obeys the laws of scale."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.linkage.solve import solve
from ilmek.machines.beat_up import BeatUp, BeatUpParams, design
from ilmek.machines.beat_up.use_params import CastLinkParams, TravelParams
from ilmek.synthesis.crank_rocker.dead_centres import beta_limits, rotation_limits
from ilmek.units import deg

swings = st.floats(8 * deg, 120 * deg)
parts = st.floats(0.05, 0.95)
scales = st.floats(0.2, 5.0)


def made(swing: float, turned: float, where: float, **further: float) -> BeatUp:
    low, high = rotation_limits(swing)
    rotation = float(low + turned * (high - low))
    rotation += 0.01 if abs(rotation - np.pi - swing) < 0.01 else 0.0
    low, high = beta_limits(swing, rotation)
    return design(BeatUpParams(swing=swing, crank_rotation=rotation, beta=float(low + where * (high - low)), **further))


@settings(max_examples=20)
@given(swings, parts, parts)
def test_solved_linkage_swings_and_dwells_as_asked(swing: float, turned: float, where: float) -> None:
    beat_up = made(swing, turned, where)
    asked = beat_up.params
    assert asked.beta is not None
    motion = solve(beat_up.plan, asked.beta + np.array([0.0, asked.crank_rotation]), 1.0)
    # The rocker stands still at beta and at beta + phi, and has turned by +psi between them.
    np.testing.assert_allclose(motion.omega("rocker"), 0.0, atol=1e-6)
    first, second = motion.direction("rocker")
    assert float(np.angle(second / first)) == pytest.approx(swing, abs=1e-8)
    turned_by = beat_up.state.motion.angle("rocker")
    assert np.ptp(turned_by) <= swing + 1e-8
    assert np.ptp(turned_by) == pytest.approx(swing, abs=1e-2)


@settings(max_examples=20)
@given(swings, parts, parts)
def test_least_transmission_angle_is_that_of_the_solved_linkage(swing: float, turned: float, where: float) -> None:
    beat_up = made(swing, turned, where)
    motion = solve(beat_up.plan, np.array([0.0, np.pi]))
    across = motion.direction("coupler") / motion.direction("rocker")
    acute = np.arctan2(np.abs(across.imag), np.abs(across.real))
    assert beat_up.transmission_angle_min == pytest.approx(np.min(acute), abs=1e-7)
    everywhere = beat_up.state.motion.direction("coupler") / beat_up.state.motion.direction("rocker")
    assert np.min(np.arctan2(np.abs(everywhere.imag), np.abs(everywhere.real))) >= np.min(acute) - 1e-9


@settings(max_examples=8)
@given(scales)
def test_without_weight_forces_grow_with_the_square_of_the_speed(scale: float) -> None:
    pins = CastLinkParams(pin_diameter=0.006)
    slow, fast = (design(BeatUpParams(speed=speed, strength=pins)) for speed in (15.5, 15.5 * scale))
    for name, power in (("beater_velocity", 1), ("beater_acceleration", 2), ("drive_torque", 2), ("C", 2), ("A", 2)):
        assert fast.peaks[name].value == pytest.approx(slow.peaks[name].value * scale**power, rel=1e-9)


@settings(max_examples=8)
@given(scales)
def test_a_loom_of_another_size(scale: float) -> None:
    small = design(BeatUpParams())
    large = design(
        BeatUpParams(
            ground=0.3 * scale,
            width=0.03 * scale,
            thickness=0.01 * scale,
            beater_mass=2.5 * scale**3,
            strength=CastLinkParams(pin_diameter=0.006 * scale),
            travel=TravelParams(bar_distance=0.02 * scale),
        )
    )
    for name, power in (("beater_acceleration", 1), ("beater_force", 4), ("B", 4), ("drive_torque", 5)):
        assert large.peaks[name].value == pytest.approx(small.peaks[name].value * scale**power, rel=1e-9)


@settings(max_examples=20)
@given(st.integers(-180, 180), swings, parts)
def test_power_balances_and_the_mean_torque_is_zero(direction: int, swing: float, where: float) -> None:
    beat_up = made(swing, 0.5, where, gravity=9.81, gravity_direction=direction * deg)
    assert beat_up.state.forces.power_error < 1e-9
    torque = beat_up.state.torque[:-1]
    assert abs(np.mean(torque)) < 1e-9 * np.max(np.abs(torque))
