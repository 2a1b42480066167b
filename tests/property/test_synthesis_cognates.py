"""Roberts and Chebyshev's cognates draw one curve: shown by moving all three through `linkage`."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ilmek.errors import MechanismError
from ilmek.linkage.motion import Motion
from ilmek.linkage.quality import transmission_angle
from ilmek.linkage.solve import solve
from ilmek.linkage.structure import plan
from ilmek.synthesis.cognates import cognates
from ilmek.synthesis.four_bar import FourBar, LinkLengths, from_lengths


@st.composite
def traced(draw: st.DrawFn, on_line: bool = False) -> FourBar:
    """A crank-rocker with room to move, its tracer anywhere, or on the line of the coupler's pins."""
    ground, crank = 1.0, draw(st.floats(0.1, 0.35))
    coupler, rocker = draw(st.floats(0.8, 1.1)), draw(st.floats(0.8, 1.1))
    tracer = complex(draw(st.floats(0.1, 0.7)), 0.0 if on_line else draw(st.floats(-1, 1)))
    links = LinkLengths(ground, crank, coupler, rocker)
    drawn = from_lengths(links, draw(st.floats(-3, 3)), branch=draw(st.sampled_from([1, -1])), tracer=tracer)
    return drawn.turned(draw(st.floats(-3, 3))).moved(0.3 - 0.2j)


def moved(four_bar: FourBar, turns: np.ndarray, branch: int | None = None) -> Motion:
    return solve(plan(four_bar.mechanism(branch)), four_bar.crank_angle + turns)


def path(motion: Motion) -> np.ndarray:
    return motion.point("coupler", "P").position


@settings(max_examples=15)
@given(st.one_of(traced(), traced(on_line=True)))
def test_three_cognates_draw_one_curve(four_bar: FourBar) -> None:
    found = cognates(four_bar)
    assert found.timed is not None
    assert found.other is not None
    turns = np.linspace(0, 2 * np.pi, 61)
    original = moved(four_bar, turns).require()
    np.testing.assert_allclose(path(moved(found.timed, turns).require()), path(original), atol=1e-12)
    coupler = original.angle("coupler") - four_bar.coupler_angle
    both = [moved(found.other, coupler, branch) for branch in (+1, -1)]
    far = np.min([np.abs(path(one) - path(original)) for one in both], axis=0)
    sine = np.sin(transmission_angle(both[0], "B"))  # its own dead centre: there the pose loses digits by the margin
    assert np.nanmax(far * np.minimum(sine, 1.0)) < 1e-12
    assert np.count_nonzero(sine > 1e-3) > 50


@settings(max_examples=25)
@given(traced())
def test_cognates_are_the_original_in_other_sizes(four_bar: FourBar) -> None:
    original, timed, other, third = cognates(four_bar)
    assert timed is not None
    assert other is not None
    ground, crank, coupler, rocker = original.lengths
    z = abs(original.tracer - original.a) / coupler
    w = abs(original.tracer - original.b) / coupler
    assert timed.lengths == pytest.approx((w * ground, w * crank, w * rocker, w * coupler))
    assert other.lengths == pytest.approx((z * ground, z * coupler, z * crank, z * rocker))
    again = cognates(timed)
    assert again.timed is not None
    assert abs(again.third - original.a0) < 1e-12
    assert abs(again.timed.a - original.a) + abs(again.timed.b - original.b) < 1e-9
    assert abs((third - original.a0) / (original.b0 - original.a0)) == pytest.approx(z)


def test_a_tracer_in_a_moving_pin_leaves_a_cognate_that_is_a_point() -> None:
    drawn = from_lengths(LinkLengths(1.0, 0.3, 0.9, 0.8), 0.4, branch=+1, tracer=0j)
    found = cognates(drawn)
    assert found.other is None
    assert found.timed is not None
    turns = np.linspace(0, 6, 13)
    np.testing.assert_allclose(path(moved(found.timed, turns)), path(moved(drawn, turns)), atol=1e-12)
    at_b = cognates(FourBar(drawn.a0, drawn.b0, drawn.a, drawn.b, drawn.b))
    assert at_b.timed is None
    assert at_b.other is not None


def test_a_four_bar_without_a_tracer_has_no_cognates() -> None:
    with pytest.raises(MechanismError, match="has no tracer"):
        cognates(FourBar(0j, 4 + 0j, 1j, 3 + 3j))
