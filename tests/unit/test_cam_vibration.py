"""Residual vibration and springy followers: closed forms, an independent integration, energy, limits of two masses."""

import itertools
import math

import numpy as np
import pytest
from examples.draw_laws import spectrum_plot
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from ilmek.cams.follower_dynamics import (
    FollowerModel,
    Stage,
    one_mass,
    residual_of,
    rise_response,
    steady_response,
)
from ilmek.cams.laws import LAWS, SMOOTH_LAWS
from ilmek.cams.programme import TURN, CamProgramme, dwell, fall, rise
from ilmek.cams.vibration import least_ratio, residual
from ilmek.errors import ParameterError

PI = math.pi
RATIOS = np.array([0.11, 0.5, 0.77, 1.3, 2.45, 6.2, 25.3])
CLOSED = {
    "uniform": lambda n: np.abs(np.sin(PI * n)) / (PI * n),
    "parabolic": lambda n: 4 * np.sin(PI * n / 2) ** 2 / (PI * n) ** 2,
    "harmonic": lambda n: np.abs(np.cos(PI * n)) / np.abs(4 * n**2 - 1),
    "cycloidal": lambda n: np.abs(np.sin(PI * n)) / (PI * n * np.abs(n**2 - 1)),
    # By parts: |F| = |12/W (2 sin(W/2)/W - cos(W/2))| with a = 6 - 12 u and W = 2 pi n.
    "cubic": lambda n: 12 / (2 * PI * n) ** 2 * np.abs(np.sin(PI * n) / (PI * n) - np.cos(PI * n)),
}
smooth = st.sampled_from([LAWS[name] for name in SMOOTH_LAWS])


@pytest.mark.parametrize("name", CLOSED)
def test_residual_vibration_in_closed_form(name) -> None:
    ratios = RATIOS[RATIOS != 0.5] if name == "harmonic" else RATIOS
    np.testing.assert_allclose(residual(LAWS[name], ratios), CLOSED[name](ratios), rtol=1e-11, atol=1e-14)


@pytest.mark.parametrize("name", SMOOTH_LAWS)
def test_residual_is_the_fourier_transform_of_the_acceleration(name) -> None:
    """By the trapezoidal rule on a fine even grid with breaks on it: another rule, slower, the same number."""
    law = LAWS[name]
    u = (np.arange(20_000) + 0.5) / 20_000
    for n in (0.4, 1.9, 7.3):
        w = 2 * PI * n
        transform = np.mean(np.asarray(law.a(u)) * np.exp(1j * w * u)) / w
        assert float(residual(law, n)) == pytest.approx(abs(transform), abs=1e-7)


@given(law=smooth, ratio=st.floats(0.2, 6.0), damping=st.floats(0.0, 0.9))
@settings(max_examples=10)
def test_residual_is_what_an_integrator_of_the_motion_leaves(law, ratio, damping) -> None:
    w, swing = 2 * PI * ratio, math.sqrt(1 - damping**2)
    state = np.zeros(2)
    edges = [0.0, *law.breaks, 1.0]
    for low, high in itertools.pairwise(edges):
        inside = lambda t, a=low, b=high: min(max(t, a + 1e-12), b - 1e-12)  # noqa: E731
        run = solve_ivp(
            lambda t, x, at=inside: (x[1], -2 * damping * w * x[1] - w**2 * x[0] - float(law.a(at(t)))),
            (low, high), state, "DOP853", rtol=1e-10, atol=1e-12,
        )  # fmt: skip
        state = run.y[:, -1]
    amplitude = math.hypot(state[0], (state[1] + damping * w * state[0]) / (w * swing))
    assert float(residual(law, ratio, damping)) == pytest.approx(amplitude, abs=1e-8)


@given(law=smooth, ratio=st.floats(0.1, 8.0), damping=st.floats(0.0, 0.95))
@settings(max_examples=25)
def test_a_follower_of_one_mass_leaves_the_residual_of_its_law(law, ratio, damping) -> None:
    follower = one_mass(3.0, 3.0 * (2 * PI * 40) ** 2, damping)
    assert residual_of(follower, law, ratio / 40)[0] == pytest.approx(float(residual(law, ratio, damping)), abs=1e-12)


@pytest.mark.parametrize("damping", [0.0, 0.1, 1.0, 2.0])
@pytest.mark.parametrize("name", ["uniform", "parabolic", "modified-sine"])
def test_rise_of_one_mass_against_the_integrated_equation(name, damping) -> None:
    """m x'' = k (y - x) + c (y' - x') - r x, critical and more damping among it."""
    law, mass, stiffness, back, lift, time = LAWS[name], 2.0, 8e4, 5e3, 0.02, 0.05
    follower = one_mass(mass, stiffness, damping, back, preload=300.0)
    c = follower.stages[0].damping
    got = rise_response(follower, law, lift, time, after=0.5, count=61)

    def rate(t, x, inside):
        u = min(max(t / time, inside[0]), inside[1])
        y, dy = lift * float(law.s(min(u, 1.0))), lift / time * float(law.v(u)) if u <= 1 else 0.0
        return x[1], (stiffness * (y - x[0]) + c * (dy - x[1]) - back * x[0]) / mass

    state, edges = np.zeros(2), np.array([0.0, *law.breaks, 1.0, 1.5])
    for low, high in itertools.pairwise(edges):
        inside = (low + 1e-12, high - 1e-12)
        here = (got.at >= (low - 1e-9) * time) & (got.at <= (high + 1e-9) * time)
        at = np.clip(got.at[here], low * time, high * time)
        run = solve_ivp(rate, (low * time, high * time), state, "DOP853", at, args=(inside,), rtol=1e-10, atol=1e-13)
        np.testing.assert_allclose(got.displacement[0, here], run.y[0], atol=1e-9 * lift)
        np.testing.assert_allclose(got.velocity[0, here][1:-1], run.y[1][1:-1], atol=1e-8 * lift / time)
        state = run.y[:, -1]
    moving = got.at < time
    cam_speed = lift / time * np.asarray(law.v(got.at / time)) * moving
    force = 300 - stiffness * got.lag[0] - c * (got.velocity[0] - cam_speed)
    np.testing.assert_allclose(got.contact[2:-2], force[2:-2], atol=1e-9 * np.max(np.abs(force)))


@given(ratio=st.floats(0.3, 4.0), law=smooth)
@settings(max_examples=8)
def test_two_masses_are_one_where_the_second_is_nothing(ratio, law) -> None:
    single = one_mass(2.0, 2.0 * (2 * PI * 30) ** 2)
    double = FollowerModel((*single.stages, Stage(1e-5, 1e4)))
    near, far = residual_of(double, law, ratio / 30)
    assert near == pytest.approx(float(residual_of(single, law, ratio / 30)[0]), abs=1e-4)
    assert far == pytest.approx(near, abs=1e-4)


def test_frequencies_of_two_equal_masses_on_equal_springs() -> None:
    """w^2 = k/m (3 -+ sqrt 5)/2."""
    pair = FollowerModel((Stage(2.0, 800.0), Stage(2.0, 800.0)))
    expected = np.sqrt(400 * (3 + np.array([-1, 1]) * math.sqrt(5)) / 2)
    np.testing.assert_allclose(pair.frequencies, expected, rtol=1e-13)


@given(law=smooth, time=st.floats(0.02, 0.3), damped=st.booleans())
@settings(max_examples=8)
def test_energy_of_two_masses_is_what_the_cam_gives_less_what_the_dampers_take(law, time, damped) -> None:
    stages = (Stage(1.5, 2e4, 10.0 * damped, 300.0), Stage(0.4, 8e3, 6.0 * damped))
    follower = FollowerModel(stages)
    got = rise_response(follower, law, 0.01, time, after=0.0, count=2001)
    cam_speed = 0.01 / time * np.asarray(law.v(got.at / time))
    stretch = np.array([got.displacement[0] - got.cam, got.displacement[1] - got.displacement[0]])
    rates = np.array([got.velocity[0] - cam_speed, got.velocity[1] - got.velocity[0]])
    stiff, damp = (np.array([getattr(stage, what) for stage in stages])[:, None] for what in ("stiffness", "damping"))
    energy = 0.5 * (follower.masses[:, None] * got.velocity**2 + stiff * stretch**2).sum(axis=0)
    energy += 0.5 * 300.0 * got.displacement[0] ** 2
    given_power, lost = got.contact * cam_speed, (damp * rates**2).sum(axis=0)
    step = np.diff(got.at)
    work = np.sum(0.5 * step * ((given_power - lost)[1:] + (given_power - lost)[:-1]))
    assert energy[-1] - energy[0] == pytest.approx(work, abs=1e-3 * np.max(energy))


def test_the_motion_that_repeats_is_what_a_damped_follower_settles_to() -> None:
    law = LAWS["modified-trapezoid"]
    made = CamProgramme((rise(1.2, 0.02, law), dwell(0.7), fall(1.5, 0.02, law), dwell(TURN - 3.4)), start=0.4)
    follower = one_mass(2.0, 2.0 * 90.0**2, 0.1, preload=200.0)
    got = steady_response(follower, made, 11.0, 181)
    for row in (got.displacement, got.velocity, got.acceleration):
        np.testing.assert_allclose(row[:, 0], row[:, -1], atol=1e-10 * np.max(np.abs(row)))
    c, k = follower.stages[0].damping, follower.stages[0].stiffness

    def rate(t, x):
        at = made.at(np.array(0.4 + 11.0 * t))
        return x[1], (k * (float(at.s) - x[0]) + c * (11.0 * float(at.ds) - x[1])) / 2.0

    start = (got.displacement[0, 0], got.velocity[0, 0])
    run = solve_ivp(rate, (0, TURN / 11), start, "DOP853", t_eval=(got.at - 0.4)[::20] / 11, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(run.y[0], got.displacement[0, ::20], atol=2e-9)


def test_a_stiff_follower_does_what_the_cam_says() -> None:
    law = LAWS["4-5-6-7"]
    made = CamProgramme((rise(2.0, 0.02, law), fall(2.0, 0.02, law), dwell(TURN - 4.0)))
    got = steady_response(one_mass(1.0, 1e8, 0.01, preload=50.0), made, 20.0)
    course = made.at(got.at)
    np.testing.assert_allclose(got.displacement[0], course.s, atol=1e-6)
    np.testing.assert_allclose(got.contact, 50.0 + 400 * course.dds, atol=0.2)


def test_uniform_motion_kicks_a_follower_every_turn() -> None:
    """Without damping the mass takes the step of the velocity as its own: the lag turns by it at the first moment."""
    law = LAWS["uniform"]
    made = CamProgramme((rise(1.0, 0.02, law), dwell(1.0), fall(1.0, 0.02, law), dwell(TURN - 3.0)))
    got = steady_response(one_mass(1.0, 1e4, 0.2), made, 5.0, 4001)
    slope = np.diff(got.lag[0]) / np.diff(got.at / 5.0)
    first = int(np.searchsorted(got.at, 1.0))
    assert slope[first] - slope[first - 1] == pytest.approx(5.0 * 0.02, rel=0.02)


@pytest.mark.matrix(light=5)
@pytest.mark.parametrize("name", ["parabolic", "harmonic", "cycloidal", "modified-sine", "4-5-6-7"])
@pytest.mark.parametrize(("share", "damping"), [(0.1, 0.0), (0.01, 0.0), (0.01, 0.05)])
def test_the_least_time_ratio_is_met_and_all_above_are_below(name, share, damping) -> None:
    law = LAWS[name]
    least = least_ratio(law, share, damping)
    assert float(residual(law, least, damping)) == pytest.approx(share, rel=1e-9)
    above = np.linspace(least, 3 * least + 3, 3000)[1:]
    assert np.max(residual(law, above, damping)) <= share


def test_smoother_laws_ask_for_more_time_at_first_and_less_in_the_end() -> None:
    rough, fine = LAWS["harmonic"], LAWS["4-5-6-7"]
    assert least_ratio(rough, 0.1) < least_ratio(fine, 0.1)
    assert least_ratio(rough, 0.001) > 2 * least_ratio(fine, 0.001)


def test_plots_hold_what_was_asked() -> None:
    spectra = spectrum_plot({"cycloidal": LAWS["cycloidal"]}, 3.0, 0.02, 31)
    assert spectra.series[0].y[-1] == pytest.approx(float(residual(LAWS["cycloidal"], 3.0, 0.02)))


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: residual(LAWS["cubic"], 1.0, 1.0), "damping=1 of the critical; 0 to below 1"),
        (lambda: residual(LAWS["cubic"], np.array([1.0, 0.0])), "time ratio of 0; above 0"),
        (lambda: least_ratio(LAWS["cubic"], 0.6), "residual share 0.6 of the lift; 1e-05 to 0.5"),
        (lambda: least_ratio(LAWS["uniform"], 0.1), "law uniform: its velocity jumps; a law of finite acceleration"),
        (lambda: one_mass(0.0, 1.0), "a follower of mass 0 kg"),
        (lambda: FollowerModel(()), "a follower without a mass"),
        (lambda: rise_response(one_mass(1.0, 1.0), LAWS["cubic"], 0.01, 0.0), "a rise in 0 s; above 0"),
        (lambda: rise_response(one_mass(1.0, 1e14), LAWS["cubic"], 0.01, 1.0), "model the follower as rigid"),
    ],
)
def test_refuses(call, said) -> None:
    with pytest.raises(ParameterError, match=said):
        call()


def test_an_undamped_follower_in_tune_with_the_cam_is_refused() -> None:
    law = LAWS["cycloidal"]
    made = CamProgramme((rise(2.0, 0.02, law), fall(2.0, 0.02, law), dwell(TURN - 4.0)))
    with pytest.raises(ParameterError, match="the follower resonates: .* give damping, or another speed"):
        steady_response(one_mass(1.0, 30.0**2), made, 10.0)
    assert np.all(np.isfinite(steady_response(one_mass(1.0, 31.0**2), made, 10.0).displacement))
