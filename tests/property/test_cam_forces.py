"""Forces of a cam: virtual work, friction's power, and springs that just hold the follower."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.cams import profile
from ilmek.cams.contact import ContactPoint, FollowerLoad, contact_force
from ilmek.cams.laws import LAWS
from ilmek.cams.programme import CamProgramme, dwell, fall, rise
from ilmek.cams.return_spring import doubling_spring, least_force, least_preload, least_rate, lift_off
from ilmek.errors import ParameterError
from ilmek.num.piecewise import infimum
from ilmek.units import deg

LIFT, PRIME = 0.02, 0.05
RESTING = [name for name in ("harmonic", "cycloidal", "3-4-5", "modified-sine", "parabolic") if name in LAWS]
laws = st.sampled_from(RESTING)
held = st.builds(FollowerLoad, speed=st.floats(5.0, 60.0), mass=st.floats(0.1, 3.0), load=st.floats(0.0, 20.0))


def programme(law: str, span: float = 80 * deg) -> CamProgramme:
    motion = LAWS[law]
    return CamProgramme(
        (rise(span, LIFT, motion), dwell(0.4), fall(1.3 * span, LIFT, motion), dwell(2 * math.pi - 0.4 - 2.3 * span))
    )


def touch(angle, at, offset: float, roller: float) -> ContactPoint:
    """The roller on the cam, in the frame of the cam."""
    centre = profile.pitch_point(angle, at.s, PRIME, offset)
    normal = profile.normal(angle, at.s, at.ds, PRIME, offset)
    return ContactPoint(centre - roller * normal, normal, np.exp(-1j * angle))


@given(law=laws, offset=st.floats(-0.01, 0.01), roller=st.floats(0.0, 0.01), held=held)
@settings(max_examples=12)
def test_torque_is_virtual_work(law, offset, roller, held) -> None:
    angle = np.linspace(0.01, 6.2, 97)
    at = programme(law).at(angle)
    force = held.force(at.s, at.dds)
    found = contact_force(touch(angle, at, offset, roller), at.ds, force)
    assert found.torque == pytest.approx(force * at.ds, abs=1e-9)
    assert found.normal * np.cos(profile.pressure_angle(at.s, at.ds, PRIME, offset)) == pytest.approx(force, abs=1e-9)


@given(law=laws, sliding=st.floats(0.01, 0.2), guide=st.floats(0.0, 0.2))
@settings(max_examples=12)
def test_friction_takes_the_power_that_is_missing(law, sliding, guide) -> None:
    """T - F s' is what rubs: mu N |slip| on the cam and mu_g |side force| |s'| in the guide, per unit of speed."""
    angle = np.linspace(0.01, 6.2, 97)
    at = programme(law).at(angle)
    force = np.full(97, 40.0)
    place = touch(angle, at, 0.004, 0.006)
    found = contact_force(place, at.ds, force, sliding=sliding, guide=guide)
    tangent = 1j * place.normal
    slip = np.real(np.conj(1j * place.point - at.ds * place.velocity) * tangent)
    push = found.normal * (place.normal + sliding * np.sign(slip) * tangent)
    side = np.abs(np.imag(np.conj(place.velocity) * push))
    rubbed = sliding * found.normal * np.abs(slip) + guide * side * np.abs(at.ds)
    assert np.all(rubbed >= 0)
    assert found.torque == pytest.approx(force * at.ds + rubbed, rel=1e-10, abs=1e-10)


def test_follower_jams_where_friction_is_too_large() -> None:
    steep = ContactPoint(0.05 + 0j, np.exp(1j * np.array([20 * deg, 80 * deg])), 1.0 + 0j)
    found = contact_force(steep, np.array([0.02, 0.02]), 10.0, guide=0.3)
    assert np.isfinite(found.normal[0])
    assert np.isnan(found.normal[1])


@given(law=laws, held=held, rate=st.floats(10.0, 5e3), preload=st.floats(1.0, 200.0))
@settings(max_examples=12)
def test_lift_off_begins_at_its_speed(law, held, rate, preload) -> None:
    motion, spring = programme(law), replace(held, rate=rate, preload=preload)
    begins = lift_off(motion, spring)
    scale = preload + held.load
    assert least_force(motion, replace(spring, speed=begins.speed)).value == pytest.approx(0.0, abs=1e-6 * scale)
    assert least_force(motion, replace(spring, speed=0.99 * begins.speed)).value > 0
    assert least_force(motion, replace(spring, speed=1.01 * begins.speed)).value < 0


@given(law=laws, held=held, rate=st.floats(10.0, 500.0))
@settings(max_examples=12)
def test_springs_hold_and_no_weaker_one_does(law, held, rate) -> None:
    motion = programme(law)
    by_preload = replace(held, rate=rate, preload=least_preload(motion, replace(held, rate=rate)))
    for spring in (by_preload, doubling_spring(motion, held)):
        least = least_force(motion, spring).value
        assert least >= -1e-7
        if spring.preload > 0:
            assert least == pytest.approx(0.0, abs=1e-6 * spring.preload + 1e-9)
            assert lift_off(motion, spring).speed == pytest.approx(held.speed, rel=1e-6)
    stiff = replace(by_preload, rate=least_rate(motion, replace(by_preload, preload=by_preload.preload + 1.0)))
    assert stiff.rate <= rate * (1 + 1e-9)


def test_lift_off_of_the_harmonic_cam_by_hand() -> None:
    """At the top s'' = -L/2 (pi/beta)^2 is most negative and s largest: w^2 = (k L + P) / (m L/2 (pi/beta)^2)."""
    span = 90 * deg
    motion = CamProgramme((rise(span, LIFT, LAWS["harmonic"]), fall(span, LIFT, LAWS["harmonic"]), dwell(math.pi)))
    spring = FollowerLoad(speed=0.0, mass=0.5, rate=200.0, preload=60.0)
    found = lift_off(motion, spring)
    push = [(60.0 + 200.0 * s, -s2) for s, s2 in [(LIFT, -LIFT / 2 * 4)]]
    assert found.speed == pytest.approx(math.sqrt(push[0][0] / (0.5 * push[0][1])), rel=1e-9)
    assert found.at == pytest.approx(span, abs=1e-6)
    assert infimum(lambda angle: motion.at(angle).dds, motion.knots).value == pytest.approx(-LIFT / 2 * 4)


def test_no_spring_holds_a_follower_whose_velocity_drops() -> None:
    motion = programme("uniform")
    assert lift_off(motion, FollowerLoad(1.0, 1.0, 10.0, 10.0)).speed == 0
    with pytest.raises(ParameterError, match="velocity jumps down at 80 deg"):
        doubling_spring(motion, FollowerLoad(1.0, 1.0))


def test_rate_cannot_do_what_the_preload_must() -> None:
    short = CamProgramme((fall(math.pi, LIFT, LAWS["parabolic"]), rise(math.pi, LIFT, LAWS["parabolic"])))
    with pytest.raises(ParameterError, match="is too small at displacement 0"):
        least_rate(short.shifted(0.0), FollowerLoad(30.0, 1.0))
