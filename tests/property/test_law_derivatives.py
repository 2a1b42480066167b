"""Every motion law: derivatives against differences, ends, symmetry, one formula for values and arrays."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from ilmek.cams.laws import LAWS, SMOOTH_LAWS

laws = st.sampled_from([LAWS[name] for name in SMOOTH_LAWS])
places = st.floats(1e-3, 1 - 1e-3)
H = 1e-5


@given(law=laws, u=places)
def test_each_derivative_is_the_difference_of_the_one_above(law, u) -> None:
    assume(all(abs(u - at) > 3 * H for at in law.breaks))
    for function, derivative in ((law.s, law.v), (law.v, law.a), (law.a, law.j)):
        four = (function(u - 2 * H) - function(u + 2 * H) + 8 * (function(u + H) - function(u - H))) / (12 * H)
        assert float(four) == pytest.approx(float(derivative(u)), abs=2e-8)


@pytest.mark.parametrize("name", ["harmonic", "cycloidal", "3-4-5"])
@given(u=places)
def test_analytic_laws_by_the_complex_step(name, u) -> None:
    law = LAWS[name]
    step = 1e-30
    for function, derivative in ((law.s, law.v), (law.v, law.a), (law.a, law.j)):
        exact = np.imag(function(np.array([u + 1j * step])))[0] / step
        assert float(exact) == pytest.approx(float(derivative(u)), rel=1e-12, abs=1e-12)


@given(law=laws, u=st.floats(0, 1))
def test_a_rise_is_its_own_fall_turned_about_the_middle(law, u) -> None:
    assert float(law.s(u)) + float(law.s(1 - u)) == pytest.approx(1.0, abs=1e-14)
    assert float(law.v(u)) == pytest.approx(float(law.v(1 - u)), abs=1e-13)
    assert float(law.a(u)) == pytest.approx(-float(law.a(1 - u)), abs=1e-12)
    assert float(law.j(u)) == pytest.approx(float(law.j(1 - u)), abs=1e-11)


@given(law=laws, first=st.floats(0, 1), second=st.floats(0, 1))
def test_a_rise_never_turns_back(law, first, second) -> None:
    low, high = sorted((first, second))
    assert float(law.s(low)) <= float(law.s(high)) + 1e-15
    assert float(law.v(first)) >= -2e-14


@pytest.mark.parametrize("name", SMOOTH_LAWS)
def test_goes_from_rest_at_0_to_rest_at_1(name) -> None:
    law = LAWS[name]
    ends = np.array([0.0, 1.0])
    np.testing.assert_allclose(law.s(ends), ends, atol=1e-15)
    np.testing.assert_allclose(law.v(ends), 0.0, atol=2e-14)


@pytest.mark.parametrize("name", SMOOTH_LAWS)
def test_an_array_is_its_values(name) -> None:
    law = LAWS[name]
    u = np.linspace(0, 1, 33).reshape(3, 11)
    for function in (law.s, law.v, law.a, law.j):
        whole = np.asarray(function(u))
        assert whole.shape == u.shape
        np.testing.assert_allclose(whole.ravel(), [float(function(float(x))) for x in u.ravel()], atol=1e-13)
