"""Laws with parameters: made again from name and parameters, boundary values met, and what they cannot be."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import interpolate

from ilmek.cams.laws import FAMILIES, LAWS, law_of
from ilmek.errors import ParameterError

places = st.lists(st.floats(0.05, 0.95), min_size=1, max_size=6, unique=True).map(sorted)


@pytest.mark.parametrize("name", LAWS)
def test_a_law_is_made_again_from_its_name_and_parameters(name) -> None:
    law = LAWS[name]
    assert law_of(law.name, law.parameters) is law
    assert set(law.parameters) == set(FAMILIES[name].defaults)


@pytest.mark.parametrize("name", LAWS)
def test_all_at_once_are_the_four_curves(name) -> None:
    law = LAWS[name]
    for u in (np.linspace(0, 1, 77), np.linspace(0, 1, 12).reshape(3, 4), np.array(0.3)):
        for whole, curve in zip(law.motion(u), (law.s, law.v, law.a, law.j), strict=True):
            assert np.shape(whole) == u.shape
            np.testing.assert_allclose(whole, curve(u), rtol=1e-12, atol=1e-12)


def test_values_may_come_from_a_file() -> None:
    assert law_of("spline", {"u": [0.5], "s": [0.4], "degree": 3}).parameters["degree"] == 3.0
    assert law_of("spline", {"u": 0.5, "s": 0.4}) is law_of("spline", {"u": (0.5,), "s": [0.4]})
    assert law_of("scca", {"b": 0, "c": 1, "d": 0}) is law_of("scca", {"b": 0.0, "c": np.float64(1), "d": 0})


@settings(max_examples=25)
@given(
    start=st.lists(st.floats(-5, 5), min_size=1, max_size=4),
    end=st.lists(st.floats(-5, 5), min_size=1, max_size=4),
)
def test_a_polynomial_meets_its_boundary_values(start, end) -> None:
    law = law_of("polynomial", {"start": start, "end": end})
    for u, row in ((0.0, start), (1.0, end)):
        for curve, value in zip((law.s, law.v, law.a, law.j), row, strict=False):
            assert float(curve(u)) == pytest.approx(value, abs=1e-9)


@settings(max_examples=25)
@given(u=places, data=st.data())
def test_a_polynomial_goes_through_its_points_and_its_bounds_are_true(u, data) -> None:
    s = data.draw(st.lists(st.floats(-1, 2), min_size=len(u), max_size=len(u)))
    if min(np.diff([0.0, *u, 1.0])) < 0.04:
        return
    law = law_of("polynomial", {"u": u, "s": s})
    size = max(law.highest, -law.lowest)
    np.testing.assert_allclose(law.s(np.array(u)), s, atol=1e-9 * size)
    grid = np.linspace(0, 1, 20_001)
    for peak, curve in ((law.highest, law.s), (-law.lowest, lambda x: -np.asarray(law.s(x)))):
        top = float(np.max(curve(grid)))
        assert top <= peak + 1e-10 * size
        assert peak <= top + 1e-6 * law.acceleration_peak
    assert float(np.max(np.abs(law.v(grid)))) == pytest.approx(law.velocity_peak, rel=1e-4)


@settings(max_examples=25)
@given(u=places, degree=st.sampled_from([3, 5, 7]), data=st.data())
def test_a_spline_goes_through_its_points_smoothly(u, degree, data) -> None:
    s = data.draw(st.lists(st.floats(0, 1), min_size=len(u), max_size=len(u)))
    if min(np.diff([0.0, *u, 1.0])) < 0.04:
        return
    m = (degree - 1) // 2
    start, end = ([0.7, -2.0, 3.0][:m], [0.3, 1.0, -4.0][:m])
    law = law_of("spline", {"u": u, "s": s, "start": start, "end": end, "degree": degree})
    np.testing.assert_allclose(law.s(np.array([0.0, *u, 1.0])), [0.0, *s, 1.0], atol=1e-10)
    for at, row in ((0.0, start), (1.0, end)):
        for curve, value in zip((law.v, law.a, law.j), row, strict=False):
            assert float(curve(at)) == pytest.approx(value, abs=1e-6)
    curve = law.s
    for _ in range(degree):
        assert np.max(np.abs(curve.steps())) <= 1e-8 * curve.peak()
        curve = curve.derivative()


def test_the_cubic_spline_is_that_of_an_independent_solution() -> None:
    u, s = (0.2, 0.45, 0.8), (0.1, 0.6, 0.8)
    law = law_of("spline", {"u": u, "s": s, "start": (0.5,), "end": (-0.25,), "degree": 3})
    other = interpolate.CubicSpline([0, *u, 1], [0, *s, 1], bc_type=((1, 0.5), (1, -0.25)))
    x = np.linspace(0, 1, 201)
    for order, curve in enumerate((law.s, law.v, law.a, law.j)):
        np.testing.assert_allclose(curve(x), other(x, order), atol=1e-9)
    quintic = law_of("spline", {"u": u, "s": s})
    ends = [(1, 0.0), (2, 0.0)]
    spline = interpolate.make_interp_spline([0, *u, 1], [0, *s, 1], k=5, bc_type=(ends, ends))
    np.testing.assert_allclose(quintic.s(x), spline(x), atol=1e-11)
    np.testing.assert_allclose(quintic.j(x), spline(x, 3), atol=1e-7)


def test_an_overshooting_law_knows_its_true_bounds() -> None:
    """s = 7 u^2 - 6 u^3, whose top is at the root u = 7/9 of its derivative and not on a grid."""
    law = law_of("polynomial", {"start": (0, 0), "end": (1, -4.0)})
    root = 7 / 9
    assert law.highest == pytest.approx(7 * root**2 - 6 * root**3, rel=1e-14)
    assert law.highest > 1.4
    assert math.isinf(law.acceleration_peak)


@pytest.mark.parametrize(
    ("name", "parameters", "said"),
    [
        ("cycloidl", {}, "there is no law 'cycloidl'; uniform, .*; perhaps 'cycloidal'"),
        ("cycloidal", {"b1": 0.2}, "law cycloidal has no 'b1'; none"),
        ("modified-sine", {"constant_velocty": 0.2}, "has no .*; constant_velocity; perhaps 'constant_velocity'"),
        ("modified-sine", {"constant_velocity": 1.0}, "constant_velocity=1; 0 to below 1"),
        ("modified-sine", {"constant_velocity": "much"}, "constant_velocity is 'much'; a number"),
        ("modified-sine", {"constant_velocity": math.inf}, "inf; a finite number"),
        ("modified-sine", {"constant_velocity": 10**400}, "has too many digits"),
        ("modified-uniform", {"b1": 0.7, "b2": 0.4}, "b1=0.7, b2=0.4; above 0, together at most 1"),
        ("scca", {"b": 0.7, "c": 0.4, "d": 0.1}, "their sum above 0 and at most 1"),
        ("scca", {"b": -0.1, "c": 0.4, "d": 0.1}, "each at least 0"),
        ("spline", {"u": (0.5, 0.4), "s": (0.1, 0.2)}, "u = 0.5, 0.4; ascending between 0 and 1"),
        ("spline", {"u": (0.5,), "s": (0.1, 0.2)}, "1 points u, 2 values s"),
        ("spline", {"u": 0.5}, "1 points u, 3 values s"),
        ("spline", {"u": "half"}, "u is 'half'; a number"),
        ("spline", {"degree": 4}, "degree=4; 3, 5 or 7"),
        ("spline", {"degree": 3, "start": (0, 0)}, "2 values at an end; for this degree s'"),
        ("polynomial", {"start": (0, 0, 0, 0, 0)}, "start has 5 values; at most s, s', s'', s'''"),
        ("polynomial", {"u": (0.0,), "s": (0.5,)}, r"s\(0\) = 0 and s\(0\) = 0.5 contradict each other; give one"),
        ("polynomial", {"u": (0.5, 0.5), "s": (0.5, 0.5)}, "given twice"),
        ("polynomial", {"u": (1.5,), "s": (0.5,)}, "at u=1.5; u from 0 to 1"),
        ("polynomial", {"u": (0.5,), "s": (math.inf,)}, r"s\(0.5\) = inf; a finite number"),
        ("polynomial", {"start": (math.nan, 0), "end": (math.nan, 0)}, r"no polynomial of degree 1 meets s'\(0\) = 0"),
        ("polynomial", {"start": (0,), "end": (1,), "u": (0.5,), "s": (1,), "orders": (1,)}, "or more than one does"),
        ("polynomial", {"u": tuple(np.arange(1, 12) / 12), "s": (0.5,) * 11}, "17 conditions; 1 to 16; use a spline"),
    ],
)
def test_what_a_law_cannot_be(name, parameters, said) -> None:
    with pytest.raises(ParameterError, match=said):
        law_of(name, parameters)
