"""Motion of many crank-rockers at once: against `linkage.solve`, against dense samples, and the circuit check."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.arrays import FloatArray
from ilmek.linkage.fourbar import four_bar
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.synthesis.crank_rocker.circuit import extended, on_one_circuit
from ilmek.synthesis.crank_rocker.dead_centres import (
    LinkRatios,
    beta_of_ratio,
    links_of_ratio,
    ratio_limits,
    rotation_limits,
)
from ilmek.synthesis.crank_rocker.family import CrankRockerFamily, family, link_ratio, size
from ilmek.synthesis.crank_rocker.motion import beat_acceleration, moved, rocker_extremes, sharp_angles
from ilmek.units import deg

unit = st.floats(0.02, 0.98)
swings = st.floats(5 * deg, 150 * deg)


@st.composite
def families(draw: st.DrawFn) -> CrankRockerFamily:
    swing = draw(swings)
    low, high = rotation_limits(swing)
    return family(swing, float(low + draw(unit) * (high - low)), 40)


def one(links: LinkRatios, place: int) -> LinkRatios:
    return LinkRatios(*(float(np.asarray(link)[place]) for link in links))


@settings(max_examples=20)
@given(families(), st.integers(0, 39), st.floats(0, 6.28))
def test_moves_as_the_solved_linkage(members: CrankRockerFamily, place: int, angle: float) -> None:
    links = one(members.links, place)
    motion = solve(plan(four_bar(1.0, *links, branch=+1)), np.array([angle]), 1.0)
    at = moved(links, angle)
    assert complex(at.rocker) == pytest.approx(complex(motion.direction("rocker")[0]) * links.rocker, abs=1e-12)
    for rates, name in zip((at.omega, at.alpha), ("omega", "alpha"), strict=True):
        for rate, body in zip(rates, ("coupler", "rocker"), strict=True):
            assert float(rate) == pytest.approx(float(getattr(motion, name)(body)[0]), rel=1e-8, abs=1e-9)


def dense(links: LinkRatios) -> FloatArray:
    """Angles ever closer to those where the motion is sharp."""
    near = np.geomspace(1e-7, 1, 3000)
    close = [centre + sign * near for centre in sharp_angles(links) for sign in (-1, 1)]
    return np.concatenate([np.linspace(0, 2 * np.pi, 10_001), *close])


@settings(max_examples=10)
@given(families())
def test_greatest_speed_and_acceleration_are_not_missed_by_dense_samples(members: CrankRockerFamily) -> None:
    most = rocker_extremes(members.links)
    for place in (0, 3, 20, 36, 39):
        at = moved(one(members.links, place), dense(one(members.links, place)))
        for greatest, rate in ((most.speed, at.omega[1]), (most.acceleration, at.alpha[1])):
            sampled = float(np.max(np.abs(rate)))
            assert sampled * (1 - 1e-5) <= greatest[place] <= sampled * (1 + 1e-5)


@settings(max_examples=20)
@given(families())
def test_the_acceleration_at_the_beat_is_that_of_the_motion_at_beta(members: CrankRockerFamily) -> None:
    at = moved(members.links, members.beta)
    np.testing.assert_allclose(at.omega[1], 0, atol=1e-6)
    np.testing.assert_allclose(beat_acceleration(members.links), at.alpha[1], rtol=1e-6)
    kinematics = members.kinematics(-2.0)
    assert (kinematics["rocker_acceleration_at_beat"] <= kinematics["rocker_acceleration_max"] * (1 + 1e-8)).all()
    assert (kinematics["rocker_speed_max"] > 0).all()


@settings(max_examples=30)
@given(families())
def test_every_member_passes_the_circuit_check_and_is_what_the_two_equations_give(members: CrankRockerFamily) -> None:
    at = extended(members.swing, members.rotation, members.ratio)
    assert on_one_circuit(members.swing, at.rocker).all()
    np.testing.assert_allclose(np.abs(at.crank), members.links.crank, rtol=1e-8)
    np.testing.assert_allclose(np.abs(at.rocker), members.links.rocker, rtol=1e-8)
    np.testing.assert_allclose(np.angle(at.crank), np.angle(np.exp(1j * members.beta)), atol=1e-8)


@given(swings, unit, unit)
def test_ratios_below_the_family_fail_the_circuit_check_or_turn_no_crank(
    swing: float, turned: float, part: float
) -> None:
    low, high = rotation_limits(swing)
    rotation = float(low + turned * (high - low))
    ratio = part * float(ratio_limits(swing, rotation).low)
    at = extended(swing, rotation, ratio)
    # The joint's two places lie on both sides of the ground line: at the family's end one of them is on it.
    assert ratio < 1e-9 or not on_one_circuit(swing, at.rocker)


@settings(max_examples=20)
@given(families(), st.integers(0, 39), st.floats(0.3, 2.0))
def test_size_is_the_greatest_distance_of_places_over_a_turn(
    members: CrankRockerFamily, place: int, reach: float
) -> None:
    links, beta = one(members.links, place), float(members.beta[place])
    at = moved(links, np.linspace(0, 2 * np.pi, 721))
    far = reach * np.asarray(at.rocker) / links.rocker
    places = np.concatenate([np.array([0, 1]), np.asarray(at.pin), 1 + np.asarray(at.rocker), 1 + far])
    greatest = np.max(np.abs(places[:, None] - places[None, ::7]))
    assert greatest <= float(size(links, beta, reach)) * (1 + 1e-9)
    assert greatest == pytest.approx(float(size(links, beta, reach)), rel=5e-3)
    lengths = (1.0, *links)
    assert float(link_ratio(links)) == max(lengths) / min(lengths)


@pytest.mark.parametrize("rotation", [106, 150, 180, 195, 210, 211, 284])
def test_a_family_covers_its_whole_open_interval(rotation: float) -> None:
    swing = 30 * deg
    members = family(swing, rotation * deg, 500)
    low, high = ratio_limits(swing, rotation * deg)
    assert members.ratio[0] - low == pytest.approx((high - low) / 1000)
    assert high - members.ratio[-1] == pytest.approx((high - low) / 1000)
    geometry = members.geometry()
    assert all(np.isfinite(values).all() for values in geometry.values())
    assert (geometry["grashof_margin"] > 0).all()
    assert (geometry["transmission_angle_min"] > 0).all()
    np.testing.assert_allclose(members.beta, beta_of_ratio(swing, rotation * deg, members.ratio))
    np.testing.assert_array_equal(members.links, links_of_ratio(swing, rotation * deg, members.ratio))
